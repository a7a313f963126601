//! From a scene to pixels: all primary rays are cast, which is timed; then their hits are lit; then the edges are drawn again, with more rays.

use crate::edges::{Row, bytes, grid};
use crate::frame::{Frame, Met, met};
use crate::leave::Place;
use crate::light::Light;
use crate::palette::to_srgb;
use crate::scenes::Scene;
use crate::shade::{Sample, Shader};
use anyhow::{Context, Result};
use glam::Vec3;
use gsdf_nostd::{March, Program, Raster, Span};
use gsdf_simd::{F32x8, Level, MOST_LANES, Packet, Renderer, scratch};
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
    /// The sweeps over the program that their rays take.
    pub sweeps: u64,
    /// The sweeps of the ray that takes the most.
    pub most_sweeps: u32,
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

    /// The sweeps per ray, on average.
    #[must_use]
    pub fn mean_sweeps(&self) -> f64 {
        self.sweeps as f64 / self.pixels.max(1) as f64
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
    let cost = cast(program, raster, level, &mut frame);

    let painter = || Painter::new(scene, program, raster);
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
fn cast(program: Program<'_>, raster: Raster, level: Level, frame: &mut Frame) -> Cost {
    let prepared = gsdf_simd::Scene::new(program);
    let mut renderer = Renderer::at_level(&prepared, raster, level);
    let (sweeps, most_sweeps) = count_sweeps(program, raster);
    let begin = Instant::now();
    let mut cost = Cost {
        pixels: u64::from(raster.width()) * u64::from(raster.height()),
        hits: 0,
        sweeps,
        most_sweeps,
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

/// All sweeps of all primary rays, and the most of one: ray by ray and untimed, since a packet knows only those of its slowest lane.
fn count_sweeps(program: Program<'_>, raster: Raster) -> (u64, u32) {
    (0..raster.height())
        .into_par_iter()
        .map_init(
            || vec![Span::EMPTY; program.leaves()],
            |spans, y| {
                let sweeps_of = |x| {
                    let ray = raster.ray(x, y).ok()?;
                    let March::<f32> { sweeps, .. } = program.along(ray, spans).ok()?.march();
                    Some(sweeps)
                };
                let counted = (0..raster.width()).filter_map(sweeps_of);
                counted.fold((0, 0), |(all, most): (u64, u32), sweeps| {
                    (all + u64::from(sweeps), most.max(sweeps))
                })
            },
        )
        .reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1.max(b.1)))
}

/// What one thread needs to colour rows.
struct Painter<'a> {
    program: Program<'a>,
    raster: Raster,
    shader: Shader<'a>,
    light: Light,
    spans: Vec<Span<F32x8>>,
}

impl<'a> Painter<'a> {
    fn new(scene: &Scene, program: Program<'a>, raster: Raster) -> Self {
        Self {
            program,
            raster,
            shader: Shader::new(program, scene.look),
            light: scene.look.light,
            spans: scratch(program.leaves()),
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
        let side = if self.program.leaves() < MANY_LEAVES { 4 } else { 2 };
        let share = side * side;
        let places: Vec<_> = pixels
            .iter()
            .flat_map(|&x| {
                grid(side)
                    .zip(0..)
                    .map(move |([right, down], part)| (x, [x as f32 + right, y as f32 + down], part))
            })
            .collect();
        let mut samples = Vec::with_capacity(places.len());
        for chunk in places.chunks(8) {
            let lanes = |axis: usize| F32x8::new(core::array::from_fn(|lane| chunk[lane.min(chunk.len() - 1)].1[axis]));
            let packet = Packet::through(&self.raster, lanes(0), lanes(1));
            // The scratch memory was made for this program.
            let seen = packet
                .cast(&self.program, &mut self.spans)
                .map_or([None; MOST_LANES], |hits| met(&hits));
            for ((x, place, part), met) in chunk.iter().zip(seen) {
                let seed = self.seed(*x as u32, y).wrapping_mul(31).wrapping_add(part + 1);
                samples.push(self.sample(*place, met, seed));
            }
        }
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
            let most = cost.most_sweeps;
            assert!(most as usize <= scene.program()?.max_sweeps(), "{}: {most}", scene.name);
            assert!((1.0..=f64::from(most)).contains(&cost.mean_sweeps()));
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
