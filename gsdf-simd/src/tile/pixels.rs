//! What the rays of a tile have met.

use crate::prefetch::Ahead;
use crate::target::Wants;
use core::mem::offset_of;

/// The side of a tile, in pixels.
pub const TILE_SIDE: usize = 16;

/// The pixels of a tile.
pub const TILE_PIXELS: usize = TILE_SIDE * TILE_SIDE;

/// The side of a block of a tile, in pixels: packets of four by two and of four by four rays are whole in one.
pub(crate) const BLOCK_SIDE: usize = 4;

/// The pixels of a square of 16 by 16, plane by plane, each in blocks of four by four: the order in which packets find
/// them, of any width, and thus the order that costs nothing.
///
/// Block by block in reading order, and so within each block; see [`index`](Tile::index).
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct Tile {
    /// The parameters of the rays: depth, for the cameras of `gsdf_nostd`. Infinite where they hit nothing.
    pub distance: [f32; TILE_PIXELS],
    /// The components of the unit normals, outward from the program; zero where a ray hits nothing. Meaningless where
    /// the target wants none.
    pub normal: [[f32; TILE_PIXELS]; 3],
    /// The numbers of the leaves; [`Pixel::NO_LEAF`] where a ray hits nothing.
    pub leaf: [u32; TILE_PIXELS],
    /// The numbers of the leaves' faces, where the target wants them.
    pub face: [u32; TILE_PIXELS],
}

impl Tile {
    /// A tile that shows nothing.
    pub const NOTHING: Self = Self {
        distance: [f32::INFINITY; TILE_PIXELS],
        normal: [[0.0; TILE_PIXELS]; 3],
        leaf: [Pixel::NO_LEAF; TILE_PIXELS],
        face: [0; TILE_PIXELS],
    };

    /// One pixel as a record; column and row are taken modulo 16.
    #[inline(always)]
    #[must_use]
    pub fn pixel(&self, x: usize, y: usize) -> Pixel {
        let index = Self::index(x, y);
        Pixel {
            distance: self.distance[index],
            normal: [self.normal[0][index], self.normal[1][index], self.normal[2][index]],
            leaf: self.leaf[index],
        }
    }

    /// Says of a tile that is written next, and in which this is wanted, that from this pixel on it is.
    #[inline(always)]
    pub(crate) fn fetch(next: Ahead, pixel: usize, wants: Wants) {
        let plane = |plane: usize| next.fetch(plane + pixel * size_of::<f32>());
        plane(offset_of!(Self, distance));
        plane(offset_of!(Self, leaf));
        if wants.normals | wants.faces {
            for component in 0..3 {
                plane(offset_of!(Self, normal) + component * size_of::<[f32; TILE_PIXELS]>());
            }
        }
        if wants.faces {
            plane(offset_of!(Self, face));
        }
    }

    /// How many pixels show something among those in the first `width` columns and `height` rows.
    #[inline(always)]
    pub(crate) fn hits(&self, width: u32, height: u32) -> u32 {
        let (width, height) = (width as usize, height as usize);
        let mut hits = 0;
        for y in 0..height.min(TILE_SIDE) {
            for x in 0..width.min(TILE_SIDE) {
                hits += u32::from(self.distance[Self::index(x, y)] < f32::INFINITY);
            }
        }
        hits
    }

    /// The column and the row of the pixel in a place of the planes.
    #[must_use]
    pub(crate) const fn place_of(index: usize) -> [usize; 2] {
        let (block, within) = (index / (BLOCK_SIDE * BLOCK_SIDE), index % (BLOCK_SIDE * BLOCK_SIDE));
        let across = TILE_SIDE / BLOCK_SIDE;
        [
            block % across * BLOCK_SIDE + within % BLOCK_SIDE,
            block / across * BLOCK_SIDE + within / BLOCK_SIDE,
        ]
    }

    /// Where in each plane the pixel in column `x` and row `y` of the tile is; both are taken modulo 16.
    #[inline(always)]
    #[must_use]
    pub const fn index(x: usize, y: usize) -> usize {
        let (x, y) = (x % TILE_SIDE, y % TILE_SIDE);
        let block = y / BLOCK_SIDE * (TILE_SIDE / BLOCK_SIDE) + x / BLOCK_SIDE;
        block * BLOCK_SIDE * BLOCK_SIDE + y % BLOCK_SIDE * BLOCK_SIDE + x % BLOCK_SIDE
    }
}

/// One pixel as a record of 20 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Pixel {
    /// The parameter of the ray: depth, for the cameras of `gsdf_nostd`. Infinite where it hits nothing.
    pub distance: f32,
    /// The unit normal, outward from the program; zero where the ray hits nothing.
    pub normal: [f32; 3],
    /// The number of the leaf; [`Pixel::NO_LEAF`] where the ray hits nothing.
    pub leaf: u32,
}

impl Pixel {
    /// The leaf of a pixel that shows nothing.
    pub const NO_LEAF: u32 = u32::MAX;

    /// A pixel that shows nothing.
    pub const NOTHING: Self = Self {
        distance: f32::INFINITY,
        normal: [0.0; 3],
        leaf: Self::NO_LEAF,
    };
}

#[cfg(test)]
mod tests {
    use super::{TILE_PIXELS, TILE_SIDE, Tile};

    #[test]
    fn every_pixel_has_its_place() {
        let mut taken = [false; TILE_PIXELS];
        for y in 0..TILE_SIDE {
            for x in 0..TILE_SIDE {
                let index = Tile::index(x, y);
                assert!(!core::mem::replace(&mut taken[index], true));
                assert_eq!(Tile::place_of(index), [x, y]);
                // Four neighbours in a row of a block are one after the other.
                assert_eq!(index % 4, x % 4);
            }
        }
        assert_eq!((Tile::index(4, 0), Tile::index(0, 1), Tile::index(0, 4)), (16, 4, 64));
    }
}
