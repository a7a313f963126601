//! Batches of rays that have nothing in common: the first hit of each, and whether there is any.

use anyhow::{Context, Result};
use clap::builder::PossibleValuesParser;
use clap::{Parser, value_parser};
use glam::Vec3;
use gsdf_benches::machine::Machine;
use gsdf_benches::outcome::outcome;
use gsdf_benches::scenes::{self, Primitive, Scene};
use gsdf_benches::stats::Estimate;
use gsdf_simd::{Caster, Level, Pixel, RayHits, Rays};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::ThreadPoolBuilder;
use std::io::{self, Write};
use std::process::ExitCode;
use std::time::Instant;

/// Rays from all around a scene, each from another place and to another one, in batches on one thread.
#[derive(Debug, Parser)]
#[command(name = "batches", version)]
struct Arguments {
    /// Batches, of which the median counts [default: 9]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    rounds: Option<u32>,
    /// Rays in a batch [default: 1048576]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=1 << 26))]
    rays: Option<u32>,
    /// Scenes, separated by commas
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        default_value = "s4,s5,s6-10,s6-46",
        value_parser = PossibleValuesParser::new(scenes::NAMES)
    )]
    scenes: Vec<String>,
    /// Vectors of the packets: portable, avx2 or avx512, as far as this machine has them [default: the widest]
    #[arg(long, value_name = "NAME")]
    level: Option<Level>,
    /// Three batches of 4096 rays, unless said otherwise: to see that it runs, not to quote
    #[arg(long)]
    quick: bool,
    /// What cargo says to benchmarks.
    #[arg(long, hide = true)]
    bench: bool,
}

/// The seed of the rays.
const SEED: u64 = 0x6261_7463;

/// Rays coordinate by coordinate, three of the origins and three of the directions.
struct Batch([Vec<f32>; 6]);

impl Batch {
    /// Rays from a sphere around the world's origin that holds the cube of this half-extent, to points of that cube.
    fn around(half: f32, count: u32) -> Self {
        let mut rng = Pcg64::seed_from_u64(SEED);
        let mut coordinates: [Vec<f32>; 6] = core::array::from_fn(|_| Vec::with_capacity(count as usize));
        for _ in 0..count {
            let from = direction(&mut rng) * (2.5 * half);
            let to = Vec3::from_array(core::array::from_fn(|_| rng.random_range(-half..half)));
            for (plane, number) in coordinates
                .iter_mut()
                .zip(from.to_array().into_iter().chain((to - from).to_array()))
            {
                plane.push(number);
            }
        }
        Self(coordinates)
    }

    fn rays(&self) -> Rays<'_> {
        let [x, y, z, u, v, w] = &self.0;
        Rays::new([x, y, z], [u, v, w])
    }
}

/// A direction, uniform on the unit sphere.
fn direction(rng: &mut impl Rng) -> Vec3 {
    loop {
        let v = Vec3::from_array(core::array::from_fn(|_| rng.random_range(-1.0_f32..1.0)));
        if (0.01..1.0).contains(&v.length_squared()) {
            return v.normalize();
        }
    }
}

/// The half-extent of the cube that the rays of a scene are aimed into.
fn half_extent(scene: &Scene) -> f32 {
    match scene.name {
        "s4" => 8.0,
        "s5" => 24.0,
        "s7" => 50.0,
        name => match name.strip_prefix("s6-").map(str::parse::<f32>) {
            Some(Ok(edge)) => 0.5 * edge,
            _ => 2.0,
        },
    }
}

/// The median nanoseconds per ray of some batches.
fn measure(rounds: u32, rays: usize, mut batch: impl FnMut() -> Result<()>) -> Result<f64> {
    batch()?;
    let mut times = Vec::new();
    for _ in 0..rounds {
        let begin = Instant::now();
        batch()?;
        times.push(1e9 * begin.elapsed().as_secs_f64() / rays as f64);
    }
    Ok(Estimate::new(&times).unwrap_or(Estimate::UNKNOWN).median)
}

fn run(arguments: &Arguments) -> Result<()> {
    let (rounds, count) = if arguments.quick { (3, 4096) } else { (9, 1 << 20) };
    let (rounds, count) = (arguments.rounds.unwrap_or(rounds), arguments.rays.unwrap_or(count));
    let level = arguments.level.unwrap_or_else(Level::best);
    let pool = ThreadPoolBuilder::new().num_threads(1).build().context("a thread to cast on")?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{}\n\
         level  {level}\n\
         batch  {count} rays from a sphere around the scene to points of its cube, on one thread; the median of {rounds}\n\n\
         {:<7} {:>9} {:>6} {:>20} {:>24} {:>12}",
        Machine::here(),
        "scene",
        "leaves",
        "hits",
        "distance, ns per ray",
        "distance, normal, leaf",
        "any"
    )?;
    for name in &arguments.scenes {
        let scene = Scene::by_name(name)?;
        let prepared = gsdf_simd::Scene::new(scene.program()?);
        let caster: Caster<'_, '_, Primitive> = Caster::at_level(&prepared, level);
        let batch = Batch::around(half_extent(&scene), count);
        let length = count as usize;
        let (mut distance, mut leaf) = (vec![0.0; length], vec![0; length]);
        let mut normal: [Vec<f32>; 3] = core::array::from_fn(|_| vec![0.0; length]);
        let mut hit = vec![false; length];
        let bare = pool.install(|| {
            measure(
                rounds,
                length,
                || Ok(caster.cast(&batch.rays(), RayHits::distances(&mut distance))?),
            )
        })?;
        let whole = pool.install(|| {
            measure(rounds, length, || {
                let [x, y, z] = &mut normal;
                let hits = RayHits {
                    normal: Some([x, y, z]),
                    leaf: Some(&mut leaf),
                    ..RayHits::distances(&mut distance)
                };
                Ok(caster.cast(&batch.rays(), hits)?)
            })
        })?;
        let any = pool.install(|| measure(rounds, length, || Ok(caster.any(&batch.rays(), &mut hit)?)))?;
        let met = leaf.iter().filter(|leaf| **leaf != Pixel::NO_LEAF).count() as f64 / length as f64;
        writeln!(
            out,
            "{:<7} {:>9} {:>5.0}% {bare:>20.1} {whole:>24.1} {any:>12.1}",
            scene.name,
            scene.program()?.leaves(),
            100.0 * met
        )?;
    }
    Ok(())
}

fn main() -> ExitCode {
    outcome(run(&Arguments::parse()))
}
