//! Operations, roots, sweeps and steps per ray. There is no clock in it: it prints the same on every machine.

use anyhow::Result;
use gsdf_benches::counts::{Tally, of_direction, of_leaves, of_scene};
use gsdf_benches::inputs::{COUNT, SEED};
use gsdf_benches::outcome::outcome;
use gsdf_benches::scenes::Scene;
use std::io::{self, Write};
use std::process::ExitCode;

/// Pixels along each side of a picture, and of one of a scene with thousands of leaves.
const SIZE: u32 = 128;
const SIZE_OF_MANY: u32 = 32;

fn columns(what: &str) -> String {
    format!(
        "{what:<34} {:>8} {:>9} {:>10} {:>10} {:>10} {:>10} {:>10} {:>9}",
        "roots", "divisions", "products", "sums", "compared", "selected", "min/max", "signs"
    )
}

/// The means over a tally's queries.
fn line(what: &str, tally: &Tally) -> String {
    let done = &tally.operations;
    let mean = |count: u64| count as f64 / tally.queries.max(1) as f64;
    format!(
        "{what:<34} {:>8.2} {:>9.2} {:>10.2} {:>10.2} {:>10.2} {:>10.2} {:>10.2} {:>9.2}",
        mean(done.square_roots),
        mean(done.divisions),
        mean(done.multiplications),
        mean(done.additions),
        mean(done.comparisons),
        mean(done.selections),
        mean(done.extrema),
        mean(done.signs)
    )
}

fn leaves(out: &mut impl Write) -> Result<()> {
    writeln!(
        out,
        "Leaves: operations per evaluation as written, means of {COUNT} (seed {SEED:#x}); roots are square roots\n"
    )?;
    writeln!(out, "{}", columns("leaf, stage"))?;
    writeln!(out, "{}", line("any: direction, once per ray", &of_direction()))?;
    for leaf in of_leaves() {
        let stages = [
            ("sdf", leaf.sdf),
            ("origin", leaf.seen_from),
            ("span", leaf.span),
            ("normal", leaf.surface),
        ];
        for (stage, tally) in stages {
            writeln!(out, "{}", line(&format!("{}: {stage}", leaf.name), &tally))?;
        }
    }
    Ok(())
}

fn scenes(out: &mut impl Write) -> Result<()> {
    writeln!(
        out,
        "\nScenes: operations per primary ray, brute force, one ray at a time; the closed form with its normal, the marcher without\n"
    )?;
    writeln!(out, "{}", columns("scene, method"))?;
    let mut repeated = Vec::new();
    for name in ["s1", "s2", "s3", "s4", "s5"] {
        let scene = Scene::by_name(name)?;
        let leaves = scene.program()?.leaves();
        let counts = of_scene(&scene, if leaves > 256 { SIZE_OF_MANY } else { SIZE })?;
        let rays = counts.closed.queries as f64;
        writeln!(out, "{}", line(&format!("{}: closed form", counts.name), &counts.closed))?;
        let mut row = format!(
            "{:<6} {:>6} {:>5} {:>6.1} {:>11.2} {:>12.2} {:>11} {:>12}",
            counts.name,
            leaves,
            counts.size,
            100.0 * counts.hits as f64 / rays,
            counts.roots as f64 / rays,
            counts.sweeps.total as f64 / rays,
            counts.sweeps.most,
            2 * leaves + 1
        );
        for (relaxation, steps, tally) in &counts.traced {
            writeln!(
                out,
                "{}",
                line(&format!("{}: marcher, relaxation {relaxation:.1}", counts.name), tally)
            )?;
            row += &format!(" {:>9.2} {:>5}", steps.total as f64 / rays, steps.most);
        }
        repeated.push(row);
    }
    writeln!(
        out,
        "\nScenes: leaf roots found, sweeps of the closed form and steps of the marcher (by relaxation), per ray\n\n\
         {:<6} {:>6} {:>5} {:>6} {:>11} {:>12} {:>11} {:>12} {:>9} {:>5} {:>9} {:>5}",
        "scene", "leaves", "size", "hit %", "leaf roots", "sweeps", "most", "their bound", "steps 1.0", "most", "steps 1.2", "most"
    )?;
    for row in repeated {
        writeln!(out, "{row}")?;
    }
    Ok(())
}

fn main() -> ExitCode {
    let mut out = io::stdout().lock();
    outcome(leaves(&mut out).and_then(|()| scenes(&mut out)))
}
