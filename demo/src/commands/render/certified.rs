//! Pictures that are certified: what is settled how, pixel by pixel.

use super::alone::Settlements;
use crate::frame::{Frame, FrameRows};
use core::ops::AddAssign;
use gsdf_nostd::{Leaf, Raster};
use gsdf_simd::{Certificates, Level, Renderer, Scene, TILE_SIDE, Target, Tile, Wants};
use std::sync::{Mutex, PoisonError};

/// Casts a ray through the middle of every pixel, certified, and tells how many hit something and how they were settled.
pub fn cast(frame: &mut Frame, scene: &Scene<'_, Leaf>, raster: Raster, level: Level) -> (u64, Settlements) {
    let settled = Mutex::new(Settlements::default());
    let rows = CertifiedRows {
        rows: frame.as_target(),
        own: Settlements::default(),
        all: &settled,
    };
    let hits = Renderer::certified_at_level(scene, raster, level).render(rows).hits;
    (hits, settled.into_inner().unwrap_or_else(PoisonError::into_inner))
}

/// Some rows of a frame, and how their pixels were settled.
struct CertifiedRows<'f> {
    rows: FrameRows<'f>,
    own: Settlements,
    /// Where it is added when all rows are there.
    all: &'f Mutex<Settlements>,
}

impl Drop for CertifiedRows<'_> {
    fn drop(&mut self) {
        self.all
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .add_assign(core::mem::take(&mut self.own));
    }
}

impl Target for CertifiedRows<'_> {
    fn wants(&self) -> Wants {
        self.rows.wants()
    }

    fn split_at(mut self, row: u32) -> (Self, Self) {
        let all = self.all;
        let (above, below) = core::mem::take(&mut self.rows).split_at(row);
        let of = |rows| Self {
            rows,
            own: Settlements::default(),
            all,
        };
        (of(above), of(below))
    }

    fn put(&mut self, x: u32, y: u32, tile: &Tile) {
        self.rows.put(x, y, tile);
    }

    fn certify(&mut self, x: u32, y: u32, certificates: &Certificates) {
        let [width, height] = self.rows.size();
        // A tile may reach beyond the picture.
        let side = |whole: usize, from: u32| whole.saturating_sub(from as usize).min(TILE_SIDE);
        for down in 0..side(height, y) {
            for right in 0..side(width, x) {
                self.own += Settlements::of(certificates.settled[Tile::index(right, down)]);
            }
        }
    }
}
