//! From a thousand to a million spheres: the time to prepare them, the memory they take, and the time of a picture on one thread and on all.

use anyhow::{Context, Result};
use clap::{Parser, value_parser};
use gsdf_benches::machine::{self, Machine};
use gsdf_benches::outcome::outcome;
use gsdf_benches::scenes::{Primitive, Scene};
use gsdf_benches::stats::Estimate;
use gsdf_nostd::Node;
use gsdf_simd::{Level, Renderer, Tiles};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::io::{self, Write};
use std::process::ExitCode;
use std::time::Instant;

/// Cubes of spheres, from a thousand to a million of them.
#[derive(Debug, Parser)]
#[command(name = "spheres", version)]
struct Arguments {
    /// Pictures, of which the median counts [default: 21]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    rounds: Option<u32>,
    /// Pixels along each side of a picture [default: 1024]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(16..=4096))]
    size: Option<u32>,
    /// Vectors of the packets: portable, avx2 or avx512, as far as this machine has them [default: the widest]
    #[arg(long, value_name = "NAME")]
    level: Option<Level>,
    /// Three pictures of 128 x 128 pixels, of ten thousand spheres at most: to see that it runs, not to quote
    #[arg(long)]
    quick: bool,
    /// What cargo says to benchmarks.
    #[arg(long, hide = true)]
    bench: bool,
}

/// The milliseconds of the first picture and of the median of those after it.
fn pictures(renderer: &mut Renderer<'_, '_, Primitive>, tiles: &mut Tiles, rounds: u32, pool: &ThreadPool) -> [f64; 2] {
    let mut times: Vec<f64> = (0..=rounds)
        .map(|_| {
            pool.install(|| {
                let begin = Instant::now();
                renderer.render(tiles.as_target());
                1e3 * begin.elapsed().as_secs_f64()
            })
        })
        .collect();
    let first = times.remove(0);
    [first, Estimate::new(&times).unwrap_or(Estimate::UNKNOWN).median]
}

fn run(arguments: &Arguments) -> Result<()> {
    let (rounds, size) = if arguments.quick { (3, 128) } else { (21, 1024) };
    let (rounds, size) = (arguments.rounds.unwrap_or(rounds), arguments.size.unwrap_or(size));
    let level = arguments.level.unwrap_or_else(Level::best);
    let pool = |threads| {
        ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .context("threads to render on")
    };
    let (one, all) = (pool(1)?, pool(0)?);
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{}\n\
         level     {level}\n\
         picture   {size} x {size}, kept as tiles; the first one, and the median of {rounds} after it\n\
         prepared  once for all cameras; bytes per sphere of the program and of what is prepared beside it\n\
         most      resident memory of the process until then, two pictures and the program included\n\n\
         {:>9} {:>12} {:>9} {:>10} {:>9} {:>11} {:>11} {:>8} {:>11} {:>9}",
        Machine::here(),
        "spheres",
        "prepared ms",
        "program",
        "prepared",
        "most MiB",
        "first ms",
        "then ms",
        "ns/px",
        format!("{} threads", all.current_num_threads()),
        "ns/px"
    )?;
    let edges: &[u16] = if arguments.quick { &[10, 22] } else { &[10, 22, 46, 100] };
    for edge in edges {
        let scene = Scene::spheres("spheres", *edge)?;
        let program = scene.program()?;
        let begin = Instant::now();
        let prepared = gsdf_simd::Scene::new(program);
        let preparation = 1e3 * begin.elapsed().as_secs_f64();
        let mut renderer = Renderer::at_level(&prepared, scene.camera.raster(size, size), level);
        let mut tiles = Tiles::new(size, size);
        let [first, then] = pictures(&mut renderer, &mut tiles, rounds, &one);
        let [_, shared] = pictures(&mut renderer, &mut tiles, rounds, &all);
        let per_pixel = 1e6 / f64::from(size * size);
        let spheres = program.leaves() as f64;
        writeln!(
            out,
            "{:>9} {preparation:>12.2} {:>9.0} {:>10.0} {:>9} {first:>11.2} {then:>11.2} {:>8.2} {shared:>11.2} {:>9.2}",
            program.leaves(),
            size_of_val::<[Node<Primitive>]>(&scene.nodes) as f64 / spheres,
            prepared.bytes() as f64 / spheres,
            machine::most_memory().map_or_else(|| "-".into(), |bytes| format!("{:.0}", bytes as f64 / f64::from(1 << 20))),
            then * per_pixel,
            shared * per_pixel
        )?;
    }
    Ok(())
}

fn main() -> ExitCode {
    outcome(run(&Arguments::parse()))
}
