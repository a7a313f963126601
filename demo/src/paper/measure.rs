//! How often a reading is wrong, and what it takes.

use super::cameras::{Side, cameras};
use super::reader::Reader;
use super::reading::Reading;
use super::shapes::Shape;
use anyhow::{Context, Result};
use core::hint::black_box;
use gsdf_nostd::{Camera, Ray};
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// How one reading's pixel compares with the exact one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The same: nothing, or a surface at the same distance, bit for bit.
    Right,
    /// A surface where none is.
    Phantom,
    /// None where there is one.
    Missed,
    /// One at another distance.
    Misplaced,
}

impl Verdict {
    /// Compares how far ahead a surface is seen, and how far it is.
    ///
    /// Every reading selects from the same roots, so that they are equal or not and no tolerance is wanted.
    #[must_use]
    pub fn on(seen: Option<f32>, exact: Option<f32>) -> Self {
        match (seen, exact) {
            (Some(_), None) => Self::Phantom,
            (None, Some(_)) => Self::Missed,
            (Some(seen), Some(exact)) if seen != exact => Self::Misplaced,
            _ => Self::Right,
        }
    }
}

/// The pixels of some pictures, by verdict.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Count {
    /// All of them.
    pub pixels: u64,
    /// Those that show a surface where none is.
    pub phantom: u64,
    /// Those that show none where one is.
    pub missed: u64,
    /// Those that show one at another distance.
    pub misplaced: u64,
}

impl Count {
    /// One pixel more.
    pub fn add(&mut self, verdict: Verdict) {
        self.pixels += 1;
        match verdict {
            Verdict::Right => {}
            Verdict::Phantom => self.phantom += 1,
            Verdict::Missed => self.missed += 1,
            Verdict::Misplaced => self.misplaced += 1,
        }
    }

    /// Both together.
    #[must_use]
    pub const fn joined(self, other: Self) -> Self {
        Self {
            pixels: self.pixels + other.pixels,
            phantom: self.phantom + other.phantom,
            missed: self.missed + other.missed,
            misplaced: self.misplaced + other.misplaced,
        }
    }

    /// All that are not right.
    #[must_use]
    pub const fn wrong(self) -> u64 {
        self.phantom + self.missed + self.misplaced
    }

    /// Some of them, as a percentage of all.
    #[must_use]
    pub fn percent(self, some: u64) -> f64 {
        100.0 * some as f64 / self.pixels.max(1) as f64
    }
}

/// For each reading, in the order of [`Reading::ALL`].
pub type Each<T> = [T; Reading::ALL.len()];

/// How many cameras look at a shape from each side, and the pixels along each side of their pictures.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Cameras.
    pub cameras: u32,
    /// Pixels along each side.
    pub pixels: u32,
}

/// Counts the wrong pixels of each reading in pictures from one side.
///
/// # Errors
/// Where the shape is no program, or has no such side.
pub fn wrong(shape: &Shape, side: Side, effort: Effort) -> Result<Each<Count>> {
    let reader = Reader::new(shape.program()?);
    let counts = cameras(shape, side, effort.cameras, SEED)?
        .into_par_iter()
        .map(|camera| {
            let mut scratch = reader.scratch();
            let mut counts = Each::<Count>::default();
            for ray in rays(camera, effort.pixels)? {
                let view = reader.along(ray, &mut scratch);
                let exact = reader.seen(Reading::Exact, view);
                for (count, reading) in counts.iter_mut().zip(Reading::ALL) {
                    count.add(Verdict::on(reader.seen(reading, view), exact));
                }
            }
            Ok(counts)
        })
        .collect::<Result<Vec<_>>>()?;
    let none = Each::<Count>::default();
    Ok(counts
        .into_iter()
        .fold(none, |all, some| core::array::from_fn(|reading| all[reading].joined(some[reading]))))
}

/// The seed of all cameras.
const SEED: u64 = 5;

/// The rays through the pixels of a square picture.
fn rays(camera: Camera, pixels: u32) -> Result<Vec<Ray>> {
    let raster = camera.raster(pixels, pixels);
    (0..pixels)
        .flat_map(|y| (0..pixels).map(move |x| (x, y)))
        .map(|(x, y)| raster.ray(x, y).context("a pixel without a ray"))
        .collect()
}

/// How often each reading is timed.
const ROUNDS: u32 = 25;

/// The nanoseconds that each reading takes per ray through a picture: the spans of all leaves and their composition, one
/// ray at a time on one thread. The readings take turns, and of each the least time counts.
///
/// # Errors
/// Where the shape is no program.
pub fn nanoseconds(shape: &Shape, camera: Camera, pixels: u32) -> Result<Each<f64>> {
    let reader = Reader::new(shape.program()?);
    let rays = rays(camera, pixels)?;
    let mut scratch = reader.scratch();
    let mut least = [Duration::MAX; Reading::ALL.len()];
    for _ in 0..ROUNDS {
        for (least, reading) in least.iter_mut().zip(Reading::ALL) {
            let begin = Instant::now();
            for ray in &rays {
                let view = reader.along(*ray, &mut scratch);
                black_box(reader.number(reading, view));
            }
            *least = begin.elapsed().min(*least);
        }
    }
    Ok(least.map(|time| time.as_secs_f64() * 1e9 / rays.len().max(1) as f64))
}

#[cfg(test)]
mod tests {
    use super::{Count, Verdict};

    #[test]
    fn verdicts_are_counted_under_their_names() {
        let cases = [
            (None, None, Verdict::Right),
            (Some(2.0), Some(2.0), Verdict::Right),
            (Some(2.0), None, Verdict::Phantom),
            (None, Some(2.0), Verdict::Missed),
            (Some(2.0), Some(3.0), Verdict::Misplaced),
            (Some(4.0), Some(3.0), Verdict::Misplaced),
        ];
        let mut count = Count::default();
        for (seen, exact, verdict) in cases {
            assert_eq!(Verdict::on(seen, exact), verdict);
            count.add(verdict);
        }
        assert_eq!((count.pixels, count.phantom, count.missed, count.misplaced), (6, 1, 1, 2));
        assert_eq!((count.wrong(), count.joined(count).wrong()), (4, 8));
        assert!((count.percent(count.wrong()) - 66.667).abs() < 1e-3);
        assert_eq!(Count::default().percent(0), 0.0);
    }
}
