//! A name beneath a picture.

use crate::palette::{INK, to_srgb};
use crate::sheet::PAPER;
use core::convert::Infallible;
use embedded_graphics::Pixel;
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::ascii::FONT_9X15;
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::{Dimensions, DrawTarget, Drawable, OriginDimensions, Point, Size};
use embedded_graphics::text::{Alignment, Baseline, Text, TextStyleBuilder};
use image::{Rgb, RgbImage, imageops};

/// The height of a caption, in pixels.
pub(super) const HEIGHT: u32 = 22;

/// A picture with its name beneath, in the middle; what does not fit is cut off.
pub(super) fn captioned(picture: &RgbImage, name: &str) -> RgbImage {
    let (width, height) = picture.dimensions();
    let mut tile = RgbImage::from_pixel(width, height + HEIGHT, PAPER);
    imageops::replace(&mut tile, picture, 0, 0);
    let middle = Point::new((width / 2) as i32, (height + HEIGHT / 2) as i32);
    let style = TextStyleBuilder::new()
        .alignment(Alignment::Center)
        .baseline(Baseline::Middle)
        .build();
    let text = Text::with_text_style(name, middle, MonoTextStyle::new(&FONT_9X15, BinaryColor::On), style);
    let Ok(_) = text.draw(&mut Canvas(&mut tile));
    tile
}

/// An image that letters are drawn on.
struct Canvas<'i>(&'i mut RgbImage);

impl OriginDimensions for Canvas<'_> {
    fn size(&self) -> Size {
        Size::new(self.0.width(), self.0.height())
    }
}

impl DrawTarget for Canvas<'_> {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let inside = self.bounding_box();
        for Pixel(place, _) in pixels
            .into_iter()
            .filter(|Pixel(place, color)| color.is_on() && inside.contains(*place))
        {
            self.0.put_pixel(place.x as u32, place.y as u32, Rgb(to_srgb(INK)));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{HEIGHT, captioned};
    use crate::sheet::PAPER;
    use image::{Rgb, RgbImage};

    #[test]
    fn letters_stand_beneath_the_picture_and_in_its_middle() {
        let grey = Rgb([120; 3]);
        let tile = captioned(&RgbImage::from_pixel(60, 40, grey), "box");
        assert_eq!(tile.dimensions(), (60, 40 + HEIGHT));
        assert!((0..40).all(|y| (0..60).all(|x| *tile.get_pixel(x, y) == grey)));
        let inked: Vec<_> = (0..60)
            .filter(|&x| (40..40 + HEIGHT).any(|y| *tile.get_pixel(x, y) != PAPER))
            .collect();
        assert!(inked.len() > 12 && inked[0] >= 15 && inked[inked.len() - 1] < 45, "{inked:?}");
    }

    #[test]
    fn names_longer_than_the_picture_are_cut() {
        assert_eq!(captioned(&RgbImage::new(4, 3), "triangular prism").dimensions(), (4, 3 + HEIGHT));
    }
}
