//! From a scene to pixels, row by row: first all of a row's rays are cast, which is timed, then they are counted, then their hits are lit.

use crate::palette::to_srgb;
use crate::scenes::{Look, Scene};
use crate::shade::{backdrop, shade};
use anyhow::{Context, Result};
use gsdf_nostd::{Hit, March, Program, Raster, Ray, Span};
use image::RgbImage;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// A rendered scene.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The pixels, in sRGB.
    pub image: RgbImage,
    /// What they took.
    pub tally: Tally,
}

/// What the primary rays of some pixels met, and the work they were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// The rays: one per pixel.
    pub rays: u64,
    /// Those that met something.
    pub hits: u64,
    /// The time spent on making the rays and casting them, added up over the threads; neither light nor counting is in it.
    pub casting: Duration,
    /// The sweeps over the program that they took.
    pub sweeps: u64,
    /// The sweeps of the ray that took the most.
    pub most_sweeps: u32,
}

impl Tally {
    /// This and another one, of other pixels.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            hits: self.hits + other.hits,
            casting: self.casting + other.casting,
            sweeps: self.sweeps + other.sweeps,
            most_sweeps: self.most_sweeps.max(other.most_sweeps),
        }
    }

    /// The time of one thread per ray.
    #[must_use]
    pub fn nanoseconds_per_ray(&self) -> f64 {
        self.casting.as_secs_f64() * 1e9 / self.rays.max(1) as f64
    }

    /// The sweeps per ray, on average.
    #[must_use]
    pub fn mean_sweeps(&self) -> f64 {
        self.sweeps as f64 / self.rays.max(1) as f64
    }
}

/// Renders a scene as a square of `size` by `size` pixels on the threads of the current pool, and reports each finished row.
///
/// # Errors
/// Where the scene is not a program.
pub fn render(scene: &Scene, size: u32, row_done: impl Fn() + Sync) -> Result<Picture> {
    let program = scene.program().with_context(|| format!("scene {}", scene.name))?;
    let raster = scene.camera.raster(size, size);
    let mut image = RgbImage::new(size, size);
    let tally = image
        .par_chunks_mut(3 * size as usize)
        .zip(0..size)
        .map_init(
            || Row::new(program, raster),
            |row, (pixels, y)| {
                let tally = row.render(y, &scene.look, pixels);
                row_done();
                tally
            },
        )
        .try_reduce(Tally::default, |a, b| Ok(a.joined(b)))
        .with_context(|| format!("scene {}", scene.name))?;
    Ok(Picture { image, tally })
}

/// What one thread needs to render rows: memory for the leaves along one ray, and for one row of rays and hits.
struct Row<'a> {
    program: Program<'a>,
    raster: Raster,
    spans: Vec<Span<f32>>,
    seen: Vec<(Ray, Option<Hit>)>,
}

impl<'a> Row<'a> {
    fn new(program: Program<'a>, raster: Raster) -> Self {
        Self {
            program,
            raster,
            spans: vec![Span::EMPTY; program.leaves()],
            seen: Vec::with_capacity(raster.width() as usize),
        }
    }

    /// Renders row `y` into its bytes.
    fn render(&mut self, y: u32, look: &Look, pixels: &mut [u8]) -> Result<Tally> {
        let begin = Instant::now();
        self.cast(y)?;
        let casting = begin.elapsed();
        let mut tally = Tally {
            rays: self.seen.len() as u64,
            hits: self.seen.iter().filter(|(_, hit)| hit.is_some()).count() as u64,
            casting,
            ..Tally::default()
        };
        self.count(&mut tally)?;
        self.light(y, look, pixels);
        Ok(tally)
    }

    /// Casts the ray of every pixel of row `y`: what is timed.
    fn cast(&mut self, y: u32) -> Result<()> {
        self.seen.clear();
        for x in 0..self.raster.width() {
            let ray = self.raster.ray(x, y)?;
            let hit = self.program.along(ray, &mut self.spans)?.cast();
            self.seen.push((ray, hit));
        }
        Ok(())
    }

    /// Sends the same rays again, for the number of sweeps, which a cast does not tell.
    fn count(&mut self, tally: &mut Tally) -> Result<()> {
        for (ray, _) in &self.seen {
            let March::<f32> { sweeps, .. } = self.program.along(*ray, &mut self.spans)?.march();
            tally.sweeps += u64::from(sweeps);
            tally.most_sweeps = tally.most_sweeps.max(sweeps);
        }
        Ok(())
    }

    /// Lights what was hit.
    fn light(&mut self, y: u32, look: &Look, pixels: &mut [u8]) {
        let behind = backdrop((y as f32 + 0.5) / self.raster.height() as f32);
        for ((ray, hit), pixel) in self.seen.iter().zip(pixels.chunks_exact_mut(3)) {
            let colour = match hit {
                Some(hit) => shade(&self.program, &mut self.spans, look, ray, hit, behind),
                None => behind,
            };
            pixel.copy_from_slice(&to_srgb(colour));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Tally, render};
    use crate::scenes::{self, Scene};
    use anyhow::Result;

    fn tally(scene: &Scene, size: u32) -> Result<Tally> {
        Ok(render(scene, size, || ())?.tally)
    }

    #[test]
    fn as_many_pixels_are_hit_as_independent_programs_hit() -> Result<()> {
        // They count 804070, 481502 and 432812 of 1024 x 1024; every sixteenth pixel both ways is a sample of that.
        for (scene, of_all) in [(scenes::s1(), 804_070), (scenes::s2(), 481_502), (scenes::s3(), 432_812)] {
            let tally = tally(&scene, 64)?;
            assert_eq!(tally.rays, 64 * 64);
            let expected = f64::from(of_all) / 256.0;
            assert!(
                (tally.hits as f64 - expected).abs() < 0.02 * expected,
                "{}: {} hits",
                scene.name,
                tally.hits
            );
        }
        Ok(())
    }

    #[test]
    fn no_ray_takes_more_sweeps_than_the_theorem_allows() -> Result<()> {
        for scene in [scenes::s1(), scenes::s2(), scenes::s3(), scenes::snowcone(), scenes::hollow()] {
            let tally = tally(&scene, 48)?;
            let bound = scene.program()?.max_sweeps();
            assert!(tally.most_sweeps as usize <= bound, "{}: {}", scene.name, tally.most_sweeps);
            assert!((1.0..=f64::from(tally.most_sweeps)).contains(&tally.mean_sweeps()));
        }
        Ok(())
    }

    #[test]
    fn the_number_of_threads_changes_no_pixel() -> Result<()> {
        let of_threads = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            anyhow::Ok(pool.install(|| render(&scenes::snowcone(), 40, || ()))?.image)
        };
        assert_eq!(of_threads(1)?, of_threads(3)?);
        Ok(())
    }

    #[test]
    fn a_picture_of_one_pixel_is_a_picture() -> Result<()> {
        let picture = render(&scenes::s1(), 1, || ())?;
        assert_eq!((picture.image.dimensions(), picture.tally.hits), ((1, 1), 1));
        Ok(())
    }
}
