//! One command that interleaves A and B in one process: ratios with confidence intervals. `cargo bench --bench race -- --help` tells what can be asked of it.

use anyhow::{Context, Result};
use clap::Parser;
use gsdf_benches::arguments::Arguments;
use gsdf_benches::machine::Machine;
use gsdf_benches::outcome::outcome;
use gsdf_benches::race::{Pools, race, thread_ceiling};
use gsdf_benches::report;
use gsdf_benches::scenes::Scene;
use std::fs::File;
use std::io::{self, Write};
use std::process::ExitCode;

fn run(arguments: &Arguments) -> Result<()> {
    let (machine, rules) = (Machine::here(), arguments.rules());
    // Before the first turn: a race is long, and a file that cannot be written should be known at its start.
    let mut csv = match &arguments.csv {
        Some(path) => Some(File::create(path).with_context(|| format!("cannot write {}", path.display()))?),
        None => None,
    };
    if let Some(csv) = &mut csv {
        writeln!(csv, "{}", report::CSV_HEAD).context("CSV")?;
    }
    let mut out = io::stdout().lock();
    let pools = Pools::new(rules.threads)?;
    let ceiling = thread_ceiling(&pools);
    writeln!(out, "{}\n{}", report::head(&machine, &rules, ceiling), report::columns())?;
    for name in &arguments.scenes {
        let scene = Scene::by_name(name)?;
        race(&scene, &rules, &pools, &mut |outcome| {
            writeln!(out, "{}", report::line(outcome))?;
            if let Some(csv) = &mut csv {
                writeln!(csv, "{}", report::csv_line(&machine, ceiling, outcome)).context("CSV")?;
            }
            Ok(())
        })?;
    }
    Ok(())
}

fn main() -> ExitCode {
    outcome(run(&Arguments::parse()))
}
