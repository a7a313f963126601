//! What contenders fill, and how two of them are told apart.

use gsdf_simd::Pixel;

/// A picture: records from the closed form, which finds normals and leaves too, and depths from the marcher, which need not.
#[derive(Clone, Debug)]
pub struct Frame {
    /// What the closed form fills.
    pub pixels: Vec<Pixel>,
    /// What the marcher fills: infinite where it hits nothing.
    pub depths: Vec<f32>,
}

/// How far depths may differ, relatively, before the marcher's is called wrong.
pub const DEPTH_TOLERANCE: f32 = 1e-3;

/// The pixels the marcher gets wrong.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wrong {
    /// It shows something where there is nothing.
    pub false_hits: u64,
    /// It shows nothing where there is something: it ran out of steps, as a rule.
    pub false_misses: u64,
    /// It shows something at a depth that is off by more than [`DEPTH_TOLERANCE`].
    pub misplaced: u64,
}

impl Wrong {
    /// All of them.
    #[must_use]
    pub fn total(&self) -> u64 {
        self.false_hits + self.false_misses + self.misplaced
    }
}

impl Frame {
    /// A picture of so many pixels, none of which shows anything.
    #[must_use]
    pub fn new(pixels: usize) -> Self {
        Self {
            pixels: vec![Pixel::NOTHING; pixels],
            depths: vec![f32::INFINITY; pixels],
        }
    }

    /// The depth of the farthest pixel of the closed form that shows something.
    #[must_use]
    pub fn farthest(&self) -> Option<f32> {
        let shown = self.pixels.iter().map(|pixel| pixel.distance).filter(|depth| depth.is_finite());
        shown.max_by(f32::total_cmp)
    }

    /// The share of the pixels of the closed form that show something.
    #[must_use]
    pub fn hit_rate(&self) -> f64 {
        let hits = self.pixels.iter().filter(|pixel| pixel.distance.is_finite()).count();
        hits as f64 / self.pixels.len().max(1) as f64
    }

    /// Where the marcher's depths are not those of the closed form.
    #[must_use]
    pub fn wrong(&self) -> Wrong {
        let mut wrong = Wrong::default();
        for (pixel, traced) in self.pixels.iter().zip(&self.depths) {
            match (pixel.distance.is_finite(), traced.is_finite()) {
                (false, true) => wrong.false_hits += 1,
                (true, false) => wrong.false_misses += 1,
                (true, true) if (traced - pixel.distance).abs() > DEPTH_TOLERANCE * pixel.distance => wrong.misplaced += 1,
                _ => {}
            }
        }
        wrong
    }
}

#[cfg(test)]
mod tests {
    use super::{Frame, Wrong};
    use gsdf_simd::Pixel;

    #[test]
    fn each_kind_of_wrong_pixel_is_told() {
        let mut frame = Frame::new(6);
        let nothing = f32::INFINITY;
        let pairs = [
            (nothing, nothing),
            (nothing, 2.0),
            (2.0, nothing),
            (2.0, 2.0),
            (2.0, 1.999),
            (2.0, 1.99),
        ];
        for (index, (exact, traced)) in pairs.into_iter().enumerate() {
            frame.pixels[index] = Pixel {
                distance: exact,
                ..Pixel::NOTHING
            };
            frame.depths[index] = traced;
        }
        let wrong = frame.wrong();
        assert_eq!(
            wrong,
            Wrong {
                false_hits: 1,
                false_misses: 1,
                misplaced: 1
            }
        );
        assert_eq!((wrong.total(), frame.farthest()), (3, Some(2.0)));
        assert_eq!(frame.hit_rate(), 4.0 / 6.0);
    }
}
