//! What contenders fill, and how two of them are told apart.

use crate::contender::Contender;
use gsdf_nostd::Raster;
use gsdf_simd::{Pixel, TILE_PIXELS, TILE_SIDE, Tile, Tiles};

/// A picture: records from the closed form, which finds normals and leaves too, and depths from the marcher, which need not. Who works in tiles fills tiles; they become records
/// when they are compared.
#[derive(Clone, Debug)]
pub struct Frame {
    /// What the closed form fills.
    pub pixels: Vec<Pixel>,
    /// What the marcher fills: infinite where it hits nothing.
    pub depths: Vec<f32>,
    /// What the closed form fills tile by tile.
    pub tiles: Tiles,
    /// What the marcher fills tile by tile, in the order of [`Tile::distance`].
    pub traced: Vec<[f32; TILE_PIXELS]>,
    width: u32,
    height: u32,
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
    /// A picture none of whose pixels shows anything.
    #[must_use]
    pub fn new(raster: &Raster) -> Self {
        let (width, height) = (raster.width(), raster.height());
        let pixels = width as usize * height as usize;
        let tiles = Tiles::new(width, height);
        Self {
            pixels: vec![Pixel::NOTHING; pixels],
            depths: vec![f32::INFINITY; pixels],
            traced: vec![[f32::INFINITY; TILE_PIXELS]; tiles.tiles().len()],
            tiles,
            width,
            height,
        }
    }

    /// Lays out row by row what a contender has filled tile by tile.
    pub fn settle(&mut self, contender: Contender) {
        let places = (0..self.height).flat_map(|y| (0..self.width).map(move |x| (x, y)));
        match contender {
            Contender::ClosedTiles | Contender::ClosedTilesBare => {
                for (pixel, (x, y)) in self.pixels.iter_mut().zip(places) {
                    *pixel = self.tiles.pixel(x, y).unwrap_or(Pixel::NOTHING);
                }
            }
            Contender::TracedTiles => {
                let columns = (self.width as usize).div_ceil(TILE_SIDE);
                for (depth, (x, y)) in self.depths.iter_mut().zip(places) {
                    let (x, y) = (x as usize, y as usize);
                    *depth = self.traced[y / TILE_SIDE * columns + x / TILE_SIDE][Tile::index(x, y)];
                }
            }
            Contender::ClosedPackets | Contender::ClosedRays | Contender::TracedPackets | Contender::TracedRays => {}
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
    use glam::Vec3;
    use gsdf_nostd::Camera;
    use gsdf_simd::Pixel;

    #[test]
    fn each_kind_of_wrong_pixel_is_told() {
        let camera = Camera::pinhole(Vec3::Z, Vec3::ZERO, Vec3::Y, 0.5).expect("a camera");
        let mut frame = Frame::new(&camera.raster(6, 1));
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
