//! What no picture can be faster than: the processor's operations, and the way to its memory.

use gsdf_simd::{Lanes, Level, MOST_LANES, TILE_SIDE, Target, Tile, Tiles, TilesMut, Work};
use std::hint::black_box;
use std::time::Instant;

/// What is measured of a processor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// A sum.
    Addition,
    /// A product.
    Multiplication,
    /// A quotient.
    Division,
    /// A square root.
    SquareRoot,
}

impl Operation {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Addition, Self::Multiplication, Self::Division, Self::SquareRoot];

    /// Its name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Addition => "sum",
            Self::Multiplication => "product",
            Self::Division => "quotient",
            Self::SquareRoot => "root",
        }
    }

    /// The nanoseconds that it takes per lane at a level, where nothing waits for anything.
    #[must_use]
    pub fn cost(self, level: Level) -> f64 {
        let mut least = f64::INFINITY;
        for _ in 0..5 {
            let begin = Instant::now();
            level.run(Repeat(self));
            least = least.min(begin.elapsed().as_secs_f64());
        }
        1e9 * least / f64::from(ROUNDS * CHAINS as u32) / level.lanes() as f64
    }
}

/// How many operations depend on none of each other.
const CHAINS: usize = 8;

/// How often each of them is done.
const ROUNDS: u32 = 50_000;

struct Repeat(Operation);

impl Work for Repeat {
    type Output = ();

    fn run<T: Lanes>(self, token: T::Token) {
        T::vectorize(
            token,
            #[inline(always)]
            || repeat::<T>(token, self.0),
        );
    }
}

#[inline(always)]
fn repeat<T: Lanes>(token: T::Token, operation: Operation) {
    // Numbers that stay what they are, so that none becomes slow to work with.
    let (one, zero) = (T::splat(token, black_box(1.0)), T::splat(token, black_box(0.0)));
    let mut chains = [one; CHAINS];
    for _ in 0..ROUNDS {
        for x in &mut chains {
            *x = match operation {
                Operation::Addition => *x + zero,
                Operation::Multiplication => *x * one,
                Operation::Division => *x / one,
                Operation::SquareRoot => x.sqrt(),
            };
        }
    }
    let mut all = zero;
    for x in chains {
        all = all + x;
    }
    let mut lanes = [0.0; MOST_LANES];
    all.store(&mut lanes);
    black_box(lanes);
}

/// The nanoseconds per pixel of storing distance, normal and leaf alone: tiles of a picture of this size, copied from one that is at hand.
#[must_use]
pub fn stores(size: u32) -> f64 {
    let mut tiles = Tiles::new(size, size);
    let mut tile = Tile::NOTHING;
    let mut least = f64::INFINITY;
    for round in 0..5 {
        tile.leaf.fill(black_box(round));
        let begin = Instant::now();
        copy(tiles.as_target(), size, &tile);
        least = least.min(begin.elapsed().as_secs_f64());
        black_box(&mut tiles);
    }
    1e9 * least / f64::from(size * size)
}

fn copy(mut target: TilesMut<'_>, size: u32, from: &Tile) {
    for y in (0..size).step_by(TILE_SIDE) {
        for x in (0..size).step_by(TILE_SIDE) {
            if let Some(tile) = target.tile(x, y) {
                tile.distance = from.distance;
                tile.normal = from.normal;
                tile.leaf = from.leaf;
            }
        }
    }
}
