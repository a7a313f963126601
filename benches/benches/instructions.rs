//! Instructions per pixel, counted by callgrind, against those on record: an error where one has grown by more than 5 %. `-- --record` records them anew.

use anyhow::{Context, Result};
use clap::{Parser, value_parser};
use gsdf_benches::instructions::{Change, Figure, Query, Way, record, recorded};
use gsdf_benches::outcome::outcome;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

/// Instructions per pixel against those on record.
#[derive(Debug, Parser)]
#[command(name = "instructions", version)]
struct Arguments {
    /// Record what is counted
    #[arg(long)]
    record: bool,
    /// Compute pictures of this scene instead, which is what callgrind watches.
    #[arg(long, hide = true, requires = "way")]
    scene: Option<String>,
    #[arg(long, hide = true)]
    way: Option<Way>,
    #[arg(long, hide = true, default_value_t = 1, value_parser = value_parser!(u32).range(1..=1000))]
    pictures: u32,
    /// What cargo says to benchmarks.
    #[arg(long, hide = true)]
    bench: bool,
}

/// Where the record is.
const RECORD: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/instructions.csv");

/// Whether no figure has grown.
fn run(arguments: &Arguments) -> Result<bool> {
    if let (Some(scene), Some(way)) = (&arguments.scene, arguments.way) {
        let query = Query::all().into_iter().find(|query| query.scene == scene && query.way == way);
        query.with_context(|| format!("no query of {scene}"))?.compute(arguments.pictures)?;
        return Ok(true);
    }
    let program = std::env::current_exe().context("this program has no name")?;
    let before = if arguments.record {
        String::new()
    } else {
        std::fs::read_to_string(RECORD).with_context(|| RECORD)?
    };
    let mut out = io::stdout().lock();
    writeln!(out, "{:<7} {:<9} {:>12} {:>10}", "scene", "way", "instructions", "on record")?;
    let mut figures = Vec::new();
    let mut grown = 0;
    for query in Query::all() {
        let instructions = query.count(Path::new(&program))?;
        figures.push(Figure { query, instructions });
        write!(out, "{:<7} {:<9} {instructions:>12.1}", query.scene, query.way)?;
        if arguments.record {
            writeln!(out)?;
            continue;
        }
        let recorded = recorded(&before, &query)?;
        let change = Change::between(recorded, instructions);
        grown += u32::from(change == Change::Grown);
        let remark = match change {
            Change::None => "",
            Change::Grown => "  grown by more than 5 %",
            Change::Shrunk => "  shrunk by more than 5 %: record it, with `-- --record`",
        };
        writeln!(out, " {recorded:>10.1}{remark}")?;
    }
    if arguments.record {
        std::fs::write(RECORD, record(&figures)).with_context(|| RECORD)?;
    }
    if grown > 0 {
        writeln!(out, "{grown} figures have grown; if they must, record them with `-- --record`")?;
    }
    Ok(grown == 0)
}

fn main() -> ExitCode {
    outcome(run(&Arguments::parse()))
}
