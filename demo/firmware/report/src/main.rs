//! What an image for a microcontroller holds, and what its queries cost: tables, and a guard against growth.
//!
//! Reads the images and what they printed, as `demo/firmware/run` leaves them; compares with the recorded figures. Exit
//! status 0 if all is well, 1 if it is not or cannot be known, 2 if called wrongly.

mod attribution;
mod bits;
mod guards;
mod image;
mod ledger;
mod measure;
mod operations;
mod records;
mod tables;
mod tiers;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use anyhow::{Context as _, Result, ensure};
use clap::Parser;

use crate::ledger::Ledger;
use crate::measure::{BOARDS, Measured};

/// Prints what the images of all boards hold and what their queries cost, and fails if any of it grew by more than 5 %.
#[derive(Parser)]
struct Options {
    /// The folder of `<board>/<image>.elf` and, printed by it, `<board>/<image>.txt`.
    #[arg(long, value_name = "FOLDER")]
    root: PathBuf,
    /// The folder of the recorded figures, costs.csv, and their tables, COSTS.md.
    #[arg(long, value_name = "FOLDER", default_value = "demo/firmware")]
    recorded: PathBuf,
    /// Record the figures instead of comparing them.
    #[arg(long)]
    record: bool,
}

fn main() -> ExitCode {
    match run(&Options::parse()) {
        Ok(failures) if failures.is_empty() => ExitCode::SUCCESS,
        Ok(failures) => {
            failures.iter().for_each(|failure| eprintln!("FAILED: {failure}"));
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// What failed, each a sentence.
fn run(options: &Options) -> Result<Vec<String>> {
    let measured = measure::measure(&options.root)?;
    let (mut hashes, wrong) = bits::check(&measured.boards, &measured.printed);
    hashes.insert(0, ["board", "image", "rows with the same bits", ""].map(str::to_owned).to_vec());
    let mut failures = [measured.failures.as_slice(), &wrong, &tiers::disagreements(&measured.rows)].concat();
    let ledger = Ledger {
        origin: origin(&measured),
        rows: measured.rows.clone(),
    };
    let verdict = if wrong.is_empty() { "equal" } else { "NOT equal" };
    println!("{}\n## The same bits\n\n{}", tables::render(&ledger), tables::align(&hashes));
    println!("Of {} boards the bits are {verdict}.\n", measured.boards.len());
    let missing: Vec<&str> = BOARDS.into_iter().filter(|board| !measured.boards.contains(*board)).collect();
    if options.record {
        ensure!(missing.is_empty(), "nothing recorded: {} not measured", missing.join(", "));
        if failures.is_empty() {
            record(&options.recorded, &ledger)?;
        } else {
            failures.push("nothing recorded".to_owned());
        }
        return Ok(failures);
    }
    if !missing.is_empty() {
        println!("Not measured: {}.", missing.join(", "));
    }
    failures.extend(check(&options.recorded, &measured)?);
    Ok(failures)
}

fn record(folder: &Path, ledger: &Ledger) -> Result<()> {
    for (name, text) in [("costs.csv", ledger.write()?), ("COSTS.md", tables::render(ledger))] {
        let path = folder.join(name);
        fs::write(&path, text).with_context(|| path.display().to_string())?;
        println!("Recorded in {}.", path.display());
    }
    Ok(())
}

fn check(folder: &Path, measured: &Measured) -> Result<Vec<String>> {
    let read = |name: &str| {
        let path = folder.join(name);
        let text = fs::read_to_string(&path);
        text.with_context(|| format!("nothing recorded in {}: run demo/firmware/run --record", path.display()))
    };
    let path = folder.join("costs.csv");
    let recorded = Ledger::parse(&path.display().to_string(), &read("costs.csv")?)?;
    let changes = ledger::compare(&recorded.rows, &measured.rows, &measured.boards);
    changes.gains.iter().for_each(|gain| println!("Worth recording: {gain}."));
    let mut failures = changes.failures;
    if read("COSTS.md")? != tables::render(&recorded) {
        failures.push(format!(
            "COSTS.md is not what {} says: run demo/firmware/run --record",
            path.display()
        ));
    }
    Ok(failures)
}

/// What the figures were taken with.
fn origin(measured: &Measured) -> String {
    let compiler = measured.compiler.as_deref().unwrap_or("an unknown compiler");
    let version = Command::new("qemu-system-arm").arg("--version").output();
    let version = version
        .ok()
        .and_then(|output| String::from_utf8(output.stdout).ok())
        .unwrap_or_default();
    let emulator = version.lines().next().unwrap_or("an unknown emulator");
    format!("{compiler} and {emulator}")
}
