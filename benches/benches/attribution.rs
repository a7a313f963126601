//! Where the time of a picture goes: rays, walking the tree, spans, products, normals and stores, beside what the processor and its memory can do.
//! `cargo bench --package gsdf-benches --bench attribution -- --help` tells what can be asked of it.

use anyhow::{Context, Result};
use clap::builder::PossibleValuesParser;
use clap::{Parser, value_parser};
use gsdf_benches::attribution::{Operation, stages, stores};
use gsdf_benches::machine::Machine;
use gsdf_benches::outcome::outcome;
use gsdf_benches::scenes::{self, Scene};
use gsdf_simd::Level;
use std::io::{self, Write};
use std::process::ExitCode;

/// Pictures that differ in one stage, by turns, on one thread: what the stage costs is their difference.
#[derive(Debug, Parser)]
#[command(name = "attribution", version)]
struct Arguments {
    /// Rounds, each of one picture of every kind [default: 21]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    rounds: Option<u32>,
    /// Pixels along each side of a picture [default: 1024]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(16..=4096))]
    size: Option<u32>,
    /// Scenes, separated by commas
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        default_value = "s1,s2,s3,s4,s5,s6-46,s7",
        value_parser = PossibleValuesParser::new(scenes::NAMES)
    )]
    scenes: Vec<String>,
    /// Three rounds of 128 x 128 pixels, unless said otherwise: to see that it runs, not to quote
    #[arg(long)]
    quick: bool,
    /// What cargo says to benchmarks.
    #[arg(long, hide = true)]
    bench: bool,
}

const HEAD: &str = "\
rays      a scene of one ball behind the eye, without normals, dropped: making rays, and writing that they hit nothing
parts     + a second, empty copy of every part: walking the tree to what a tile meets, and visiting it
spans     + every span computed twice
cuts      + a second, empty copy of everything that is subtracted: finding the complements that a tile meets, and passing them
rest      what is left of a picture without normals, dropped: joining spans to products, moving entries, keeping the nearest
normals   with normals, dropped - without, dropped
tiles     kept as tiles - dropped; records and planes, row by row: the same, and not part of the whole
whole     rays + parts + spans + cuts + rest + normals + tiles
spans/px  how many spans are computed per pixel, each for a packet of rays
";

fn run(arguments: &Arguments) -> Result<()> {
    let (rounds, size) = if arguments.quick { (3, 128) } else { (21, 1024) };
    let (rounds, size) = (arguments.rounds.unwrap_or(rounds), arguments.size.unwrap_or(size));
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .context("a thread to render on")?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{}\nrules     {rounds} rounds of {size} x {size} pixels on one thread; nanoseconds per pixel, medians of differences within a round\n{HEAD}",
        Machine::here()
    )?;
    writeln!(out, "The walls: nanoseconds per lane, where nothing waits for anything\n")?;
    for level in Level::available() {
        write!(out, "{level:<9}")?;
        for operation in Operation::ALL {
            write!(out, "  {} {:.3}", operation.name(), operation.cost(level))?;
        }
        writeln!(out)?;
    }
    writeln!(
        out,
        "storing distance, normal and leaf of a pixel, copied tile by tile: {:.2}\n",
        stores(size)
    )?;
    writeln!(
        out,
        "{:<7} {:<9} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>7} {:>8} {:>7} {:>9}",
        "scene", "level", "whole", "rays", "parts", "spans", "cuts", "rest", "normals", "tiles", "records", "planes", "spans/px"
    )?;
    for name in &arguments.scenes {
        let scene = Scene::by_name(name)?;
        for level in Level::available() {
            let found = pool.install(|| stages(&scene, level, size, rounds))?;
            writeln!(
                out,
                "{name:<7} {level:<9} {:>7.2} {:>7.2} {:>7.2} {:>7.2} {:>7.2} {:>7.2} {:>7.2} {:>7.2} {:>8.2} {:>7.2} {:>9.2}",
                found.whole,
                found.rays,
                found.parts,
                found.spans,
                found.cuts,
                found.rest,
                found.normals,
                found.stores,
                found.records,
                found.planes,
                found.spans_per_pixel
            )?;
        }
    }
    Ok(())
}

fn main() -> ExitCode {
    outcome(run(&Arguments::parse()))
}
