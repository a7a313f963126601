//! A frame buffer of the demo's own: what the ray of every pixel meets, with the face, which a ray that goes on from there wants to know.

use glam::Vec3;
use gsdf_nostd::Hit;
use gsdf_simd::{Pixel, TILE_SIDE, Target, Tile, Wants};
use rayon::prelude::*;

/// What one ray met.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// The parameter of the ray.
    pub t: f32,
    /// The unit normal, outward from the solid.
    pub normal: Vec3,
    /// The leaf whose surface it is.
    pub leaf: u32,
    /// The face of that leaf.
    pub face: u8,
}

impl From<Hit> for Met {
    fn from(hit: Hit) -> Self {
        Self {
            t: hit.t,
            normal: hit.normal,
            leaf: hit.leaf,
            face: hit.face,
        }
    }
}

/// The pixels of a picture, row by row from the top.
#[derive(Clone, Debug)]
pub struct Frame {
    width: usize,
    pixels: Vec<Option<Met>>,
}

impl Frame {
    /// A frame that shows nothing yet.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        let width = width as usize;
        Self {
            width,
            pixels: vec![None; width * height as usize],
        }
    }

    /// A row, counted from the top.
    #[must_use]
    pub fn row(&self, y: u32) -> &[Option<Met>] {
        self.pixels.chunks_exact(self.width.max(1)).nth(y as usize).unwrap_or_default()
    }
}

impl Frame {
    /// The rows, from the top, for threads to fill.
    pub fn rows_mut(&mut self) -> impl IndexedParallelIterator<Item = &mut [Option<Met>]> {
        self.pixels.par_chunks_exact_mut(self.width.max(1))
    }

    /// The frame as the target of a renderer.
    pub fn as_target(&mut self) -> FrameRows<'_> {
        FrameRows {
            width: self.width,
            pixels: &mut self.pixels,
        }
    }
}

/// Some rows of a [`Frame`].
#[derive(Debug, Default)]
pub struct FrameRows<'f> {
    width: usize,
    pixels: &'f mut [Option<Met>],
}

impl FrameRows<'_> {
    /// The pixels in a row, and the rows.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.pixels.len() / self.width.max(1)]
    }
}

impl Target for FrameRows<'_> {
    fn wants(&self) -> Wants {
        Wants::NORMALS_AND_FACES
    }

    fn split_at(self, row: u32) -> (Self, Self) {
        let start = (row as usize * self.width).min(self.pixels.len());
        let (above, below) = self.pixels.split_at_mut(start);
        let of = |pixels| FrameRows { width: self.width, pixels };
        (of(above), of(below))
    }

    fn put(&mut self, x: u32, y: u32, tile: &Tile) {
        let rows = self.pixels.chunks_exact_mut(self.width.max(1)).skip(y as usize).take(TILE_SIDE);
        for (y, row) in rows.enumerate() {
            for (x, pixel) in row.iter_mut().skip(x as usize).take(TILE_SIDE).enumerate() {
                let shown = tile.pixel(x, y);
                *pixel = (shown.leaf != Pixel::NO_LEAF).then(|| Met {
                    t: shown.distance,
                    normal: shown.normal.into(),
                    leaf: shown.leaf,
                    face: tile.face[Tile::index(x, y)] as u8,
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Frame;
    use crate::scenes::s3;
    use anyhow::Result;
    use gsdf_nostd::Span;
    use gsdf_simd::{Renderer, Scene};

    #[test]
    fn every_pixel_shows_what_its_ray_hits_by_itself() -> Result<()> {
        let scene = s3();
        let (program, raster) = (scene.program()?, scene.camera.raster(37, 21));
        let mut frame = Frame::new(37, 21);
        let scene = Scene::new(program);
        let effort = Renderer::new(&scene, raster).render(frame.as_target());
        let mut spans = vec![Span::EMPTY; program.leaves()];
        let mut hits = 0;
        for y in 0..21 {
            assert_eq!(frame.row(y).len(), 37);
            for (x, seen) in (0..).zip(frame.row(y)) {
                let hit = program.along(raster.ray(x, y)?, &mut spans)?.cast();
                assert_eq!(
                    seen.map(|met| (met.t, met.normal, met.leaf, met.face)),
                    hit.map(|hit| (hit.t, hit.normal, hit.leaf, hit.face))
                );
                hits += u64::from(hit.is_some());
            }
        }
        assert_eq!(effort.hits, hits);
        assert!(frame.row(21).is_empty());
        Ok(())
    }
}
