//! The pixels of a picture, as they are written on a command line.

use core::fmt;
use core::ops::RangeInclusive;
use core::str::FromStr;

/// How many pixels a picture has along each side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// In a row.
    pub width: u32,
    /// In a column.
    pub height: u32,
}

impl Size {
    /// How many there may be.
    const SIDES: RangeInclusive<u32> = 1..=4096;

    /// The sides of a square.
    #[must_use]
    pub fn square(self) -> Option<u32> {
        (self.width == self.height).then_some(self.width)
    }
}

impl From<u32> for Size {
    fn from(side: u32) -> Self {
        Self { width: side, height: side }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x {}", self.width, self.height)
    }
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (width, height) = text.split_once('x').unwrap_or((text, text));
        let side = |side: &str| side.parse().ok().filter(|side| Self::SIDES.contains(side));
        match (side(width), side(height)) {
            (Some(width), Some(height)) => Ok(Self { width, height }),
            _ => Err("it is N or WxH, each from 1 to 4096".to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Size;

    #[test]
    fn sizes_are_one_number_or_two() {
        assert_eq!("7".parse(), Ok(Size::from(7)));
        assert_eq!("640x480".parse(), Ok(Size { width: 640, height: 480 }));
        for wrong in ["0", "4097", "-1", "many", "3x", "x3", "3x4x5", "1x4097", ""] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }
}
