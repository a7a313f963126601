//! The command `accuracy`: measured beside allowed.

use super::chart;
use super::corpus::Corpus;
use super::measure::{Cell, PART};
use super::record::Record;
use super::table::{allowed, verdict, write_bounds};
use super::trial::{Arithmetic, Reference};
use crate::shape::KINDS;
use clap::builder::PossibleValuesParser;
use clap::{Parser, value_parser};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::error::Error;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// How accurate every leaf is along rays of every corpus, in f32, in f32 with textbook formulas and in f64, beside what
/// is allowed.
///
/// Columns: rays whose hit or miss is wrong; ulps that one crossing in a hundred exceeds; most ulps of a well-conditioned
/// crossing; most units roundoff of the condition. Each is followed by what is allowed.
#[derive(Debug, Parser)]
#[command(name = "accuracy", version)]
pub struct Arguments {
    /// Rays in each cell of the table, those included that a record already has
    #[arg(long, value_name = "N", default_value_t = PART, value_parser = value_parser!(u64).range(1..))]
    rays: u64,
    /// Kinds of leaves, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = PossibleValuesParser::new(KINDS))]
    leaf: Vec<String>,
    /// Corpora, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = PossibleValuesParser::new(Corpus::ALL.iter().map(|corpus| corpus.name())))]
    corpus: Vec<String>,
    /// Go on with the record in this CSV file, or begin it: measure the rays that it lacks, and write the largest errors of
    /// all to it. It may be ended at any time, and gone on with later. What was measured by other code is not to be gone on
    /// with: delete it
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
    /// Write the bounds that follow from the record to this CSV file, instead
    #[arg(long, value_name = "FILE", requires = "record", conflicts_with_all = ["replay", "chart"])]
    bounds: Option<PathBuf>,
    /// Show one ray, by its number, of one leaf and corpus, instead
    #[arg(long, value_name = "NUMBER")]
    replay: Option<u64>,
    /// Draw the chart of error against distance to this SVG file, and to Markdown beside it that holds it, instead
    #[arg(long, value_name = "FILE", conflicts_with = "replay")]
    chart: Option<PathBuf>,
}

/// How the command ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Nothing is more than allowed.
    Kept,
    /// Something is.
    Breached,
}

impl Arguments {
    fn cells(&self) -> Vec<Cell> {
        let named = |names: &[String], name: &str| names.is_empty() || names.iter().any(|other| other == name);
        let asked = |cell: &Cell| named(&self.leaf, KINDS[cell.leaf]) && named(&self.corpus, cell.corpus.name());
        Cell::all().filter(asked).collect()
    }

    /// Does what was asked.
    ///
    /// # Errors
    /// Where a file cannot be written, or there is no such cell.
    pub fn run(&self) -> Result<Outcome, Box<dyn Error>> {
        if let Some(path) = &self.chart {
            let svg = chart::svg()?;
            write(path, &svg)?;
            write(&path.with_extension("md"), chart::markdown(&svg))?;
            return Ok(Outcome::Kept);
        }
        if let (Some(bounds), Some(record)) = (&self.bounds, &self.record) {
            let mut text = Vec::new();
            write_bounds(&Record::read(record)?, &mut text)?;
            write(bounds, &text)?;
            return Ok(Outcome::Kept);
        }
        let cells = self.cells();
        if let Some(ray) = self.replay {
            let [cell] = cells[..] else {
                return Err("--replay takes one --leaf and one --corpus".into());
            };
            replay(cell, ray)?;
            return Ok(Outcome::Kept);
        }
        if cells.is_empty() {
            let (leaf, corpus) = (self.leaf.join(","), self.corpus.join(","));
            return Err(format!("there are no rays of the corpus {corpus} at {leaf}").into());
        }
        match &self.record {
            Some(path) => self.extend(&cells, path),
            None => self.measure(&cells),
        }
    }

    /// Measures rays that no file knows of, and holds them to the table.
    fn measure(&self, cells: &[Cell]) -> Result<Outcome, Box<dyn Error>> {
        let progress = Progress::new(cells.len() as u64);
        let mut out = io::stdout().lock();
        let mut breaches = Vec::new();
        for &cell in cells {
            let mut record = Record::default();
            for first in (0..self.rays).step_by(PART as usize) {
                record.add(cell, &cell.measure(first..(first + PART).min(self.rays), record.floors(cell)));
            }
            progress.suspend(|| print(&mut out, cell, &record))?;
            breaches.extend(verdict(cell, &record));
            progress.step(self.rays, breaches.len());
        }
        self.conclude(&mut out, &progress, &breaches)
    }

    /// Goes on with a record until it holds all the rays, and holds what it then says to the table.
    ///
    /// The file is written after every cell, and all cells are as far as the others but for one part: so a run may end at
    /// any time, and the next one goes on where it was.
    fn extend(&self, cells: &[Cell], path: &Path) -> Result<Outcome, Box<dyn Error>> {
        let mut record = Record::read(path)?;
        let ends = || (1..=self.rays.div_ceil(PART)).map(|part| (part * PART).min(self.rays));
        let missing: Vec<(Cell, u64)> = ends()
            .flat_map(|end| cells.iter().map(move |&cell| (cell, end)))
            .filter(|&(cell, end)| record.rays(cell) < end)
            .collect();
        let progress = Progress::new(missing.len() as u64);
        let mut breaches = 0;
        for (cell, end) in missing {
            let rays = record.rays(cell)..end;
            let count = end - rays.start;
            let measured = cell.measure(rays, record.floors(cell));
            record.add(cell, &measured);
            record.write(path)?;
            // At once: a long run that breaks the table need not be waited for.
            for breach in verdict(cell, &Record::of(cell, &measured)) {
                breaches += 1;
                progress.suspend(|| eprintln!("BREACH {breach}"));
            }
            progress.step(count, breaches);
        }
        let mut out = io::stdout().lock();
        let mut breaches = Vec::new();
        for &cell in cells {
            print(&mut out, cell, &record)?;
            breaches.extend(verdict(cell, &record));
        }
        self.conclude(&mut out, &progress, &breaches)
    }

    fn conclude(&self, out: &mut impl Write, progress: &Progress, breaches: &[String]) -> Result<Outcome, Box<dyn Error>> {
        progress.bar.finish_and_clear();
        for cell in missing(&self.leaf, &self.corpus) {
            writeln!(out, "{cell}")?;
        }
        for breach in breaches {
            writeln!(out, "BREACH {breach}")?;
        }
        let (rays, seconds) = (progress.rays.get(), progress.start.elapsed().as_secs());
        writeln!(out, "{rays} rays, {seconds} s: {} breaches", breaches.len())?;
        Ok(if breaches.is_empty() { Outcome::Kept } else { Outcome::Breached })
    }
}

/// After how many cells a line says how far it got.
const CHECKPOINT: u64 = 16;

/// How far a run is.
struct Progress {
    bar: ProgressBar,
    start: Instant,
    rays: std::cell::Cell<u64>,
}

impl Progress {
    fn new(cells: u64) -> Self {
        // Hidden where standard error is no terminal.
        let bar = ProgressBar::with_draw_target(Some(cells), ProgressDrawTarget::stderr());
        let bar = match ProgressStyle::with_template("{wide_bar} {pos}/{len} cells, {eta} left") {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        };
        Self {
            bar,
            start: Instant::now(),
            rays: std::cell::Cell::new(0),
        }
    }

    /// Writes something where the bar is not in the way.
    fn suspend<R>(&self, write: impl FnOnce() -> R) -> R {
        self.bar.suspend(write)
    }

    /// One cell more, of so many rays, after which there were so many breaches.
    fn step(&self, rays: u64, breaches: usize) {
        self.rays.set(self.rays.get() + rays);
        self.bar.inc(1);
        let (done, all) = (self.bar.position(), self.bar.length().unwrap_or_default());
        if done.is_multiple_of(CHECKPOINT) {
            let (rays, seconds) = (self.rays.get(), self.start.elapsed().as_secs());
            self.suspend(|| eprintln!("checkpoint: {done} of {all} cells, {rays} rays, {seconds} s, {breaches} breaches"));
        }
    }
}

fn write(path: &Path, text: impl AsRef<[u8]>) -> Result<(), Box<dyn Error>> {
    Ok(fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))?)
}

/// Lines on the cells that have no rays, and why.
fn missing(leaves: &[String], corpora: &[String]) -> Vec<String> {
    let asked = |names: &[String], name: &str| names.is_empty() || names.iter().any(|other| other == name);
    let pairs = (0..KINDS.len()).flat_map(|leaf| Corpus::ALL.iter().map(move |&corpus| (leaf, corpus)));
    pairs
        .filter(|&(leaf, corpus)| asked(leaves, KINDS[leaf]) && asked(corpora, corpus.name()))
        .filter_map(|(leaf, corpus)| {
            Some(format!(
                "{:16} {:16} none: it {}",
                KINDS[leaf],
                corpus.name(),
                corpus.missing(leaf)?
            ))
        })
        .collect()
}

fn print(out: &mut impl Write, cell: Cell, record: &Record) -> io::Result<()> {
    for arithmetic in cell.arithmetics() {
        let Some(found) = record.get(cell, arithmetic) else { continue };
        let (name, corpus) = (KINDS[cell.leaf], cell.corpus.name());
        let most = allowed(cell, arithmetic).map_or([f64::NAN; 4], |row| [row.wrong, row.p99, row.most, row.conditioned]);
        write!(out, "{name:16} {corpus:16} {:6}", arithmetic.name())?;
        let values = [found.wrong_share, found.p99, found.most.error, found.conditioned.error];
        for (value, most) in values.iter().zip(most) {
            write!(out, "  {:>8} /{:>8}", short(*value), short(most))?;
        }
        writeln!(out)?;
    }
    Ok(())
}

/// A number in few characters.
fn short(value: f64) -> String {
    if value == 0.0 || (0.01..1e4).contains(&value) {
        format!("{value:.2}")
    } else {
        format!("{value:.1e}")
    }
}

/// Everything about one ray.
fn replay(cell: Cell, ray: u64) -> Result<(), Box<dyn Error>> {
    let mut out = io::stdout().lock();
    let trial = cell.trial(ray);
    let (leaf, reference) = (trial.solid.leaf()?, Reference::new(trial.solid));
    let line = (trial.origin, trial.direction);
    writeln!(out, "{trial:#?}")?;
    let swift = reference.swift(trial.origin, trial.direction);
    writeln!(out, "double-double: {swift:?}")?;
    let exact = reference.slow(trial.origin, trial.direction);
    writeln!(out, "exact: {exact:?}")?;
    for arithmetic in Arithmetic::ALL {
        let computed = trial.computed(&leaf, arithmetic);
        writeln!(out, "{}: {computed:?}", arithmetic.name())?;
        let Some((found, ends)) = computed.zip(exact) else { continue };
        for (found, t) in found.into_iter().zip(ends).filter_map(|(found, end)| Some((found, end?))) {
            let (error, roundoff) = (t.distance_to(found), arithmetic.roundoff());
            let condition = reference.condition(line, t, found, roundoff);
            let (ulps, roundings) = (error / arithmetic.ulp(t.to_f64()), error.abs() / condition / roundoff);
            writeln!(
                out,
                "  {found:e} is off by {error:e}, {ulps:.3} ulp, {roundings:.3} u * {condition:e}"
            )?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::Arguments;
    use clap::{CommandFactory, Parser};

    #[test]
    fn the_command_line_is_well_formed() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn nonsense_is_refused() {
        for nonsense in [
            &["--rays", "0"][..],
            &["--leaf", "teapot"],
            &["--corpus", "x"],
            &["--replay", "1", "--chart", "a.svg"],
        ] {
            let arguments = ["accuracy"].iter().chain(nonsense);
            assert!(Arguments::try_parse_from(arguments).is_err(), "{nonsense:?}");
        }
    }

    #[test]
    fn cells_are_picked_by_name() {
        let picked = Arguments::parse_from(["accuracy", "--leaf", "sphere,capped cone", "--corpus", "far,apex"]).cells();
        assert_eq!(picked.len(), 2);
    }
}
