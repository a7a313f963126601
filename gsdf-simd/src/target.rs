//! Where the pixels of a picture go: tiles as they are found, records, or planes.

use crate::tile::{Certificates, Pixel, TILE_SIDE, Tile};

/// Takes the tiles of a picture.
///
/// Implemented here by [`TilesMut`], [`Records`] and [`Planes`]; implement it for a frame buffer of yours.
pub trait Target: Send + Sized {
    /// What it wants beside distances and leaves.
    fn wants(&self) -> Wants;

    /// The part above a row and the part from it on, for two threads to fill. The row is a multiple of 16.
    fn split_at(self, row: u32) -> (Self, Self);

    /// The tile whose left upper pixel is in column `x` and row `y`, if the pixels are kept as tiles, to be filled in
    /// place; [`put`](Target::put) is not called for it. What is not wanted is left in it as it is.
    fn tile(&mut self, _x: u32, _y: u32) -> Option<&mut Tile> {
        None
    }

    /// Takes the tile whose left upper pixel is in column `x` and row `y`, counted from its own first row; both are
    /// multiples of 16. A tile may reach beyond the right or the lower edge.
    fn put(&mut self, x: u32, y: u32, tile: &Tile);

    /// Takes the certificates of that tile, after the tile itself, from a renderer that [certifies](crate::Renderer::certified).
    fn certify(&mut self, _x: u32, _y: u32, _certificates: &Certificates) {}
}

/// What a target wants to know of each pixel beside its distance and its leaf. What it does not want is not computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wants {
    /// The normals.
    pub normals: bool,
    /// The faces of the leaves, which a ray that goes on from there wants to know.
    pub faces: bool,
}

impl Wants {
    /// Distances and leaves alone.
    pub const NOTHING_ELSE: Self = Self {
        normals: false,
        faces: false,
    };
    /// Normals too.
    pub const NORMALS: Self = Self {
        normals: true,
        faces: false,
    };
    /// Normals and faces too.
    pub const NORMALS_AND_FACES: Self = Self {
        normals: true,
        faces: true,
    };
}

/// A picture, tile by tile in reading order: the layout that costs least to fill.
#[derive(Clone, Debug)]
pub struct Tiles {
    tiles: Vec<Tile>,
    width: u32,
    height: u32,
}

/// How many tiles cover so many pixels.
fn across(pixels: u32) -> usize {
    (pixels as usize).div_ceil(TILE_SIDE)
}

impl Tiles {
    /// A picture of this size that shows nothing.
    #[must_use]
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            tiles: vec![Tile::NOTHING; across(width) * across(height)],
            width,
            height,
        }
    }

    /// The picture as a target.
    pub fn as_target(&mut self) -> TilesMut<'_> {
        TilesMut {
            columns: across(self.width),
            tiles: &mut self.tiles,
            wants: Wants::NORMALS,
        }
    }

    /// The tiles, in reading order. Pixels beyond the picture's edges are those of a larger one.
    #[must_use]
    pub fn tiles(&self) -> &[Tile] {
        &self.tiles
    }

    /// A pixel; `None` beyond the edges.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> Option<Pixel> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let (x, y) = (x as usize, y as usize);
        let tile = self.tiles.get(y / TILE_SIDE * across(self.width) + x / TILE_SIDE)?;
        Some(tile.pixel(x % TILE_SIDE, y % TILE_SIDE))
    }
}

/// Rows of tiles to be filled.
#[derive(Debug)]
pub struct TilesMut<'t> {
    tiles: &'t mut [Tile],
    columns: usize,
    wants: Wants,
}

impl TilesMut<'_> {
    /// The same with other wants. What is not wanted is left in the tiles as it is.
    #[must_use]
    pub fn wanting(self, wants: Wants) -> Self {
        Self { wants, ..self }
    }
}

impl Target for TilesMut<'_> {
    fn wants(&self) -> Wants {
        self.wants
    }

    fn split_at(self, row: u32) -> (Self, Self) {
        let rows = row as usize / TILE_SIDE * self.columns;
        let (above, below) = self.tiles.split_at_mut(rows.min(self.tiles.len()));
        let of = |tiles| TilesMut {
            tiles,
            columns: self.columns,
            wants: self.wants,
        };
        (of(above), of(below))
    }

    fn tile(&mut self, x: u32, y: u32) -> Option<&mut Tile> {
        self.tiles.get_mut(y as usize / TILE_SIDE * self.columns + x as usize / TILE_SIDE)
    }

    fn put(&mut self, x: u32, y: u32, tile: &Tile) {
        if let Some(place) = self.tile(x, y) {
            place.clone_from(tile);
        }
    }
}

/// Records, row by row.
#[derive(Debug)]
pub struct Records<'p> {
    pixels: &'p mut [Pixel],
    width: usize,
}

impl<'p> Records<'p> {
    /// The records of a picture of this size. Those beyond it, and a last row that is not whole, are left as they are.
    #[must_use]
    pub fn new(pixels: &'p mut [Pixel], width: u32, height: u32) -> Self {
        let width = width as usize;
        let held = width.saturating_mul(height as usize).min(pixels.len());
        Self {
            pixels: pixels.get_mut(..held).unwrap_or_default(),
            width: width.max(1),
        }
    }
}

impl Target for Records<'_> {
    fn wants(&self) -> Wants {
        Wants::NORMALS
    }

    fn split_at(self, row: u32) -> (Self, Self) {
        let start = (row as usize * self.width).min(self.pixels.len());
        let (above, below) = self.pixels.split_at_mut(start);
        let of = |pixels| Records { pixels, width: self.width };
        (of(above), of(below))
    }

    fn put(&mut self, x: u32, y: u32, tile: &Tile) {
        let left = x as usize;
        let rows = self.pixels.chunks_exact_mut(self.width).skip(y as usize).take(TILE_SIDE);
        for (y, row) in rows.enumerate() {
            for (x, pixel) in row.iter_mut().skip(left).take(TILE_SIDE).enumerate() {
                *pixel = tile.pixel(x, y);
            }
        }
    }
}

/// Planes of the caller's, row by row, each row `stride` numbers long; those that are not wanted are left out.
#[derive(Debug)]
pub struct Planes<'p> {
    /// The parameters of the rays, infinite where they hit nothing.
    pub distance: &'p mut [f32],
    /// The components of the normals, zero where a ray hits nothing.
    pub normal: Option<[&'p mut [f32]; 3]>,
    /// The numbers of the leaves, [`Pixel::NO_LEAF`] where a ray hits nothing.
    pub leaf: Option<&'p mut [u32]>,
    /// How far the rows are apart; at least the width of the picture.
    pub stride: usize,
    /// The width of the picture.
    pub width: u32,
    /// The height of the picture.
    pub height: u32,
}

impl Target for Planes<'_> {
    fn wants(&self) -> Wants {
        Wants {
            normals: self.normal.is_some(),
            faces: false,
        }
    }

    fn split_at(self, row: u32) -> (Self, Self) {
        let stride = self.stride.max(1);
        let start = row as usize * stride;
        let cut = |length: usize| start.min(length);
        let (distance, distance_below) = self.distance.split_at_mut(cut(self.distance.len()));
        let (normal, normal_below) = match self.normal {
            Some([x, y, z]) => {
                let (x, x_below) = x.split_at_mut(cut(x.len()));
                let (y, y_below) = y.split_at_mut(cut(y.len()));
                let (z, z_below) = z.split_at_mut(cut(z.len()));
                (Some([x, y, z]), Some([x_below, y_below, z_below]))
            }
            None => (None, None),
        };
        let (leaf, leaf_below) = match self.leaf {
            Some(leaf) => {
                let (leaf, below) = leaf.split_at_mut(cut(leaf.len()));
                (Some(leaf), Some(below))
            }
            None => (None, None),
        };
        let of = |distance, normal, leaf, height| Planes {
            distance,
            normal,
            leaf,
            stride,
            width: self.width,
            height,
        };
        let above = row.min(self.height);
        (
            of(distance, normal, leaf, above),
            of(distance_below, normal_below, leaf_below, self.height - above),
        )
    }

    fn put(&mut self, x: u32, y: u32, tile: &Tile) {
        let count = (self.width as usize).saturating_sub(x as usize).min(TILE_SIDE);
        let stride = self.stride.max(1);
        for row in 0..(self.height.saturating_sub(y) as usize).min(TILE_SIDE) {
            let start = (y as usize + row) * stride + x as usize;
            copy(&tile.distance, row, count, self.distance, start);
            if let Some(planes) = &mut self.normal {
                for (plane, normal) in planes.iter_mut().zip(&tile.normal) {
                    copy(normal, row, count, plane, start);
                }
            }
            if let Some(plane) = &mut self.leaf {
                copy(&tile.leaf, row, count, plane, start);
            }
        }
    }
}

/// Copies a row of a tile's plane, as far as the other plane reaches.
#[inline(always)]
fn copy<N: Copy>(from: &[N], row: usize, count: usize, plane: &mut [N], start: usize) {
    let Some(places) = plane.get_mut(start..) else { return };
    for (x, place) in places.iter_mut().take(count).enumerate() {
        if let Some(number) = from.get(Tile::index(x, row)) {
            *place = *number;
        }
    }
}
