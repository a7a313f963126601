//! From a scene to pixels: all primary rays are cast, which is timed; then their hits are lit; then the edges are drawn again, with more rays.

use crate::batch::{Batch, Place};
use crate::edges::{Row, bytes, grid};
use crate::frame::{Frame, Met};
use crate::light::Light;
use crate::palette::to_srgb;
use crate::scenes::Scene;
use crate::shade::{Sample, Shader};
use anyhow::{Context, Result};
use glam::Vec3;
use gsdf_nostd::{Leaf, March, Program, Raster, Span};
use gsdf_simd::{Caster, Level, Renderer};
use image::RgbImage;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// A rendered scene.
#[derive(Clone, Debug)]
pub struct Picture {
    /// The pixels, in sRGB.
    pub image: RgbImage,
    /// What its primary rays took.
    pub cost: Cost,
    /// The pixels that more rays went through.
    pub smoothed: u64,
}

/// What the primary rays of a picture took: one per pixel, with its normal, and no light.
#[derive(Clone, Copy, Debug)]
pub struct Cost {
    /// The pixels.
    pub pixels: u64,
    /// Those that show something.
    pub hits: u64,
    /// The sweeps over the program that some of their rays take.
    pub sweeps: Sweeps,
    /// How long it took, on all threads.
    pub time: Duration,
    /// How many threads those were.
    pub threads: usize,
}

impl Cost {
    /// The time from the first pixel to the last, by the pixel.
    #[must_use]
    pub fn nanoseconds(&self) -> f64 {
        self.time.as_secs_f64() * 1e9 / self.pixels.max(1) as f64
    }
}

/// How many sweeps over a program rays take.
#[derive(Clone, Copy, Debug, Default)]
pub struct Sweeps {
    /// How many rays were counted.
    pub rays: u64,
    /// What they take together.
    pub all: u64,
    /// What the one takes that takes the most.
    pub most: u32,
}

impl Sweeps {
    /// Each of how many pixels of a row, and of how many rows, has its sweeps counted: that is done ray by ray and leaf by
    /// leaf, since a packet knows only those of its slowest lane.
    const STEP: u32 = 4;

    /// Those of the rays through every fourth pixel of every fourth row.
    fn of_some(program: Program<'_>, raster: Raster) -> Self {
        let rows = (0..raster.height().div_ceil(Self::STEP)).into_par_iter();
        let spans = || vec![Span::EMPTY; program.leaves()];
        let of_row = |spans: &mut Vec<Span<f32>>, row: u32| {
            let columns = (0..raster.width()).step_by(Self::STEP as usize);
            let marches = columns.filter_map(|x| {
                let ray = raster.ray(x, Self::STEP * row).ok()?;
                Some(program.along(ray, spans).ok()?.march())
            });
            let counted = |March { sweeps, .. }: March<f32>| Self {
                rays: 1,
                all: sweeps.into(),
                most: sweeps,
            };
            marches.map(counted).fold(Self::default(), Self::joined)
        };
        rows.map_init(spans, of_row).reduce(Self::default, Self::joined)
    }

    fn joined(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            all: self.all + other.all,
            most: self.most.max(other.most),
        }
    }

    /// The sweeps per ray, on average.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.all as f64 / self.rays.max(1) as f64
    }
}

/// For how long the casting of small scenes is repeated, to find its least time.
const PATIENCE: Duration = Duration::from_millis(200);

/// From how many leaves on edges get fewer rays.
const MANY_LEAVES: usize = 1000;

/// How many steps [`render`] reports for a picture of this size.
#[must_use]
pub fn steps(size: u32) -> u64 {
    2 * u64::from(size)
}

/// Renders a scene as a square of `size` by `size` pixels on the threads of the current pool, its primary rays at a level, and reports each finished step.
///
/// # Errors
/// Where the scene is not a program.
pub fn render(scene: &Scene, size: u32, level: Level, step_done: impl Fn() + Sync) -> Result<Picture> {
    let program = scene.program().with_context(|| format!("scene {}", scene.name))?;
    let raster = scene.camera.raster(size, size);
    let mut frame = Frame::new(size, size);
    let prepared = gsdf_simd::Scene::new(program);
    let cost = cast(&prepared, raster, level, &mut frame);

    let caster = Caster::at_level(&prepared, level);
    let side = if program.leaves() < MANY_LEAVES { 4 } else { 2 };
    let painter = || Painter::new(scene, &caster, raster, side);
    let bytes_of_rows: Vec<_> = (0..size)
        .into_par_iter()
        .map_init(painter, |painter, y| {
            let colours = painter.lit(frame.row(y), y);
            step_done();
            bytes(&colours)
        })
        .collect();

    let row = |y: u32| {
        let met = frame.row(y);
        bytes_of_rows.get(y as usize).map(|bytes| Row { met, bytes })
    };
    let mut image = RgbImage::new(size, size);
    let smoothed = image
        .par_chunks_mut(3 * size as usize)
        .zip(0..size)
        .map_init(painter, |painter, (pixels, y)| {
            let Some(here) = row(y) else { return 0 };
            let around: Vec<_> = [y.wrapping_sub(1), y + 1].into_iter().filter_map(row).collect();
            let edges: Vec<_> = here.edges(&around).collect();
            pixels.copy_from_slice(here.bytes.as_flattened());
            for (x, colour) in edges.iter().zip(painter.smooth(&edges, y)) {
                pixels[3 * x..3 * x + 3].copy_from_slice(&to_srgb(colour));
            }
            step_done();
            edges.len() as u64
        })
        .sum();
    Ok(Picture { image, cost, smoothed })
}

/// Casts the primary rays, again and again while that takes no time, and tells the least it took.
fn cast(prepared: &gsdf_simd::Scene<'_, Leaf>, raster: Raster, level: Level, frame: &mut Frame) -> Cost {
    let mut renderer = Renderer::at_level(prepared, raster, level);
    let sweeps = Sweeps::of_some(*prepared.program(), raster);
    let begin = Instant::now();
    let mut cost = Cost {
        pixels: u64::from(raster.width()) * u64::from(raster.height()),
        hits: 0,
        sweeps,
        time: Duration::MAX,
        threads: rayon::current_num_threads(),
    };
    while cost.time == Duration::MAX || begin.elapsed() < PATIENCE {
        let begin = Instant::now();
        cost.hits = renderer.render(frame.as_target()).hits;
        cost.time = cost.time.min(begin.elapsed());
    }
    cost
}

/// What one thread needs to colour rows.
struct Painter<'c> {
    raster: Raster,
    caster: &'c Caster<'c, 'c, Leaf>,
    shader: Shader<'c>,
    light: Light,
    /// The square root of how many rays go through a pixel on an edge.
    side: u32,
}

impl<'c> Painter<'c> {
    fn new(scene: &Scene, caster: &'c Caster<'c, 'c, Leaf>, raster: Raster, side: u32) -> Self {
        Self {
            raster,
            caster,
            shader: Shader::new(caster, scene.look),
            light: scene.look.light,
            side,
        }
    }

    /// The colours of row `y`, whose rays met this.
    fn lit(&mut self, row: &[Option<Met>], y: u32) -> Vec<Vec3> {
        let samples: Vec<_> = row
            .iter()
            .zip(0..)
            .map(|(met, x)| self.sample([x as f32 + 0.5, y as f32 + 0.5], *met, self.seed(x, y)))
            .collect();
        self.shader.shade(&samples, 1)
    }

    /// The colours of some pixels of row `y`, each the mean of many rays.
    fn smooth(&mut self, pixels: &[usize], y: u32) -> Vec<Vec3> {
        let share = self.side * self.side;
        let places: Vec<_> = pixels
            .iter()
            .flat_map(|&x| {
                grid(self.side)
                    .zip(0..)
                    .map(move |([right, down], part)| (x, [x as f32 + right, y as f32 + down], part))
            })
            .collect();
        let mut rays = Batch::default();
        for (_, [x, y], _) in &places {
            match self.raster.ray_through(*x, *y) {
                Ok(ray) => rays.push(ray.origin(), ray.direction()),
                Err(_) => rays.push(Vec3::ZERO, Vec3::ZERO),
            }
        }
        let samples: Vec<_> = (places.iter().zip(rays.cast(self.caster)))
            .map(|(&(x, place, part), met)| {
                let seed = self.seed(x as u32, y).wrapping_mul(31).wrapping_add(part + 1);
                self.sample(place, met, seed)
            })
            .collect();
        let colours = self.shader.shade(&samples, share);
        colours
            .chunks(share as usize)
            // What is brighter than the picture can show must not outshine the rest of its pixel.
            .map(|colours| colours.iter().map(|colour| colour.clamp(Vec3::ZERO, Vec3::ONE)).sum::<Vec3>() / share as f32)
            .collect()
    }

    /// What is seen at a place of the picture.
    fn sample(&self, [x, y]: [f32; 2], met: Option<Met>, seed: u32) -> Sample {
        let behind = self.light.behind(y / self.raster.height() as f32);
        match self.raster.ray_through(x, y) {
            Ok(ray) => {
                let place = met.map(|met| Place::on(&ray, met));
                Sample {
                    view: ray.direction().normalize(),
                    distance: place.map_or(0.0, |place| ray.origin().distance(place.point)),
                    place,
                    behind,
                    seed,
                }
            }
            // No scene's camera is so far away.
            Err(_) => Sample {
                view: self.raster.camera().forward(),
                distance: 0.0,
                place: None,
                behind,
                seed,
            },
        }
    }

    fn seed(&self, x: u32, y: u32) -> u32 {
        y.wrapping_mul(self.raster.width()).wrapping_add(x)
    }
}

#[cfg(test)]
mod tests {
    use super::{Cost, render};
    use crate::scenes::{self, Scene};
    use anyhow::Result;
    use gsdf_simd::Level;

    fn cost(scene: &Scene, size: u32) -> Result<Cost> {
        Ok(render(scene, size, Level::best(), || ())?.cost)
    }

    #[test]
    fn as_many_pixels_are_hit_as_independent_programs_hit() -> Result<()> {
        // They count 804070, 481502 and 432812 of 1024 x 1024; every sixteenth pixel both ways is a sample of that.
        for (scene, of_all) in [(scenes::s1(), 804_070), (scenes::s2(), 481_502), (scenes::s3(), 432_812)] {
            let cost = cost(&scene, 64)?;
            assert_eq!(cost.pixels, 64 * 64);
            let expected = f64::from(of_all) / 256.0;
            let hits = cost.hits as f64;
            assert!((hits - expected).abs() < 0.02 * expected, "{}: {hits} hits", scene.name);
        }
        Ok(())
    }

    #[test]
    fn no_ray_takes_more_sweeps_than_the_theorem_allows() -> Result<()> {
        for scene in [scenes::s1(), scenes::s2(), scenes::s3(), scenes::snowcone(), scenes::hollow()] {
            let cost = cost(&scene, 48)?;
            let most = cost.sweeps.most;
            assert!(most as usize <= scene.program()?.max_sweeps(), "{}: {most}", scene.name);
            assert!((1.0..=f64::from(most)).contains(&cost.sweeps.mean()));
        }
        Ok(())
    }

    #[test]
    fn neither_threads_nor_level_change_a_pixel() -> Result<()> {
        let of_threads = |scene: &Scene, threads, level| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
            anyhow::Ok(pool.install(|| render(scene, 40, level, || ()))?.image)
        };
        for scene in [scenes::snowcone(), scenes::planetary()] {
            let image = of_threads(&scene, 1, Level::PORTABLE)?;
            for level in Level::available() {
                assert_eq!(of_threads(&scene, 3, level)?, image, "{}, {level}", scene.name);
            }
        }
        Ok(())
    }

    #[test]
    fn a_picture_of_one_pixel_is_a_picture() -> Result<()> {
        let picture = render(&scenes::s1(), 1, Level::best(), || ())?;
        assert_eq!((picture.image.dimensions(), picture.cost.hits), ((1, 1), 1));
        Ok(())
    }

    #[test]
    fn edges_are_a_small_part_of_a_picture_and_soft() -> Result<()> {
        let picture = render(&scenes::s2(), 128, Level::best(), || ())?;
        assert!((100..128 * 128 / 3).contains(&picture.smoothed), "{}", picture.smoothed);
        Ok(())
    }
}
