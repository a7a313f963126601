//! Composed shapes against the sum of their parts. `cargo bench --package gsdf-benches --bench sums -- --help` tells what can be asked of it.

use anyhow::{Context, Result};
use clap::{Parser, value_parser};
use gsdf_benches::inputs::{COUNT, SEED};
use gsdf_benches::machine::Machine;
use gsdf_benches::outcome::outcome;
use gsdf_benches::stats::Estimate;
use gsdf_benches::sums::{Composed, Costs, all, costs, counts, inputs_for};
use std::io::{self, Write};
use std::process::ExitCode;

/// Composed shapes against the sum of their parts: by turns in one process.
#[derive(Debug, Parser)]
#[command(name = "sums", version)]
struct Arguments {
    /// Rounds, each of one turn of the parts, of their program and of the span of its own [default: 31]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    rounds: Option<u32>,
    /// Three rounds of 512 rays, unless said otherwise: to see that it runs, not to quote
    #[arg(long)]
    quick: bool,
    /// What cargo says to benchmarks.
    #[arg(long, hide = true)]
    bench: bool,
}

fn ratio(estimate: &Estimate) -> String {
    let Estimate { median, interval, .. } = estimate;
    if median.is_nan() {
        return "-".into();
    }
    format!("{median:.2} ({:.2}..{:.2})", interval.0, interval.1)
}

fn figure(value: f64) -> String {
    if value.is_nan() { "-".into() } else { format!("{value:.1}") }
}

fn timed(shape: &Composed, arithmetic: &str, costs: &Costs) -> String {
    let [a, b, c] = costs.nanoseconds.map(figure);
    format!(
        "{:<17} {arithmetic:<8} {a:>7} {b:>7} {c:>7}  {:<18} {:<18} {:<18} {}",
        shape.name,
        ratio(&costs.program_to_parts),
        ratio(&costs.own_to_parts),
        ratio(&costs.own_to_program),
        shape.of
    )
}

fn run(arguments: &Arguments) -> Result<()> {
    let (rounds, count) = if arguments.quick { (3, 512) } else { (31, COUNT) };
    let rounds = arguments.rounds.unwrap_or(rounds) as usize;
    let shapes = all()?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "{}\n\
         a         the generalized distance by every part, one after the other, each alone\n\
         b         the same by the program of the parts: all spans, then the march\n\
         c         the same by the shape's own span; - where the program is all there is\n\
         rules     {rounds} rounds, a, b and c by turns in one process; medians; intervals of the ratios from order statistics\n\
         rays      {count} per shape, seed {SEED:#x}, half of them hits (of the first part, where there is no c); one call each, or per packet\n\n\
         {:<17} {:<8} {:>7} {:>7} {:>7}  {:<18} {:<18} {:<18} parts",
        Machine::here(),
        "shape",
        "",
        "a ns",
        "b ns",
        "c ns",
        "b/a",
        "c/a",
        "c/b"
    )?;
    let mut counted = Vec::new();
    for shape in &shapes {
        let inputs = inputs_for(shape, count).with_context(|| format!("{} has no parts", shape.name))?;
        let scalar = costs(shape, &inputs.rays, 1, rounds)?;
        let packets = costs(shape, &inputs.packets_of_rays(), 8, rounds)?;
        writeln!(out, "{}\n{}", timed(shape, "scalar", &scalar), timed(shape, "packets", &packets))?;
        counted.push((shape, counts(shape, &inputs.rays)?));
    }
    writeln!(
        out,
        "\nOperations per ray, as written, those of the ray's direction once: all, and of them divisions and square roots\n\n\
         {:<17} {:>7} {:>7} {:>7}  {:>6} {:>6} {:>6}  {:>6} {:>6} {:>6}",
        "shape", "a", "b", "c", "a slow", "b slow", "c slow", "b/a", "c/a", "c/b"
    )?;
    for (shape, counts) in counted {
        let ([a, b, c], slow) = (counts.all, counts.slow);
        let own = |value: f64| if shape.own.is_some() { value } else { f64::NAN };
        let to = |of: f64, to: f64| if of.is_nan() { "-".into() } else { format!("{:.2}", of / to) };
        writeln!(
            out,
            "{:<17} {:>7} {:>7} {:>7}  {:>6} {:>6} {:>6}  {:>6} {:>6} {:>6}",
            shape.name,
            figure(a),
            figure(b),
            figure(own(c)),
            figure(slow[0]),
            figure(slow[1]),
            figure(own(slow[2])),
            to(b, a),
            to(own(c), a),
            to(own(c), b)
        )?;
    }
    Ok(())
}

fn main() -> ExitCode {
    outcome(run(&Arguments::parse()))
}
