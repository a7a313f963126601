//! The command `accuracy`: measured beside allowed.

use super::chart;
use super::corpus::Corpus;
use super::measure::{Cell, Measured};
use super::table::{allowed, floors, verdict};
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
    /// Rays in each cell of the table
    #[arg(long, value_name = "N", default_value_t = 36_901, value_parser = value_parser!(u64).range(1..))]
    rays: u64,
    /// Kinds of leaves, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = PossibleValuesParser::new(KINDS))]
    leaf: Vec<String>,
    /// Corpora, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = PossibleValuesParser::new(Corpus::ALL.iter().map(|corpus| corpus.name())))]
    corpus: Vec<String>,
    /// Also write what was measured to this file, as CSV; every largest error is then known, which takes longer
    #[arg(long, value_name = "FILE")]
    record: Option<PathBuf>,
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
            write(&path.with_extension("md"), &chart::markdown(&svg))?;
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
        self.measure(&cells)
    }

    fn measure(&self, cells: &[Cell]) -> Result<Outcome, Box<dyn Error>> {
        let mut record = self.record.as_ref().map(csv::Writer::from_path).transpose()?;
        let bar = progress(cells.len() as u64);
        let start = Instant::now();
        let mut out = io::stdout().lock();
        let mut breaches = Vec::new();
        let mut rays = 0;
        for (number, &cell) in cells.iter().enumerate() {
            let floors = if record.is_some() { [0.0; 3] } else { floors(cell) };
            let measured = cell.measure(0..self.rays, floors);
            rays += self.rays;
            bar.suspend(|| print(&mut out, cell, &measured))?;
            if let Some(record) = &mut record {
                write_record(record, cell, &measured)?;
            }
            breaches.extend(verdict(cell, &measured));
            bar.inc(1);
            if (number + 1) % CHECKPOINT == 0 {
                let (seconds, count) = (start.elapsed().as_secs(), breaches.len());
                bar.suspend(|| {
                    eprintln!(
                        "checkpoint: {} of {} cells, {rays} rays, {seconds} s, {count} breaches",
                        number + 1,
                        cells.len()
                    );
                });
            }
        }
        bar.finish_and_clear();
        for cell in missing(&self.leaf, &self.corpus) {
            writeln!(out, "{cell}")?;
        }
        for breach in &breaches {
            writeln!(out, "BREACH {breach}")?;
        }
        let seconds = start.elapsed().as_secs();
        writeln!(
            out,
            "{rays} rays in {} cells, {seconds} s: {} breaches",
            cells.len(),
            breaches.len()
        )?;
        if let Some(record) = &mut record {
            record.flush()?;
        }
        Ok(if breaches.is_empty() { Outcome::Kept } else { Outcome::Breached })
    }
}

/// After how many cells a line says how far it got.
const CHECKPOINT: usize = 16;

fn write(path: &Path, text: &str) -> Result<(), Box<dyn Error>> {
    Ok(fs::write(path, text).map_err(|error| format!("cannot write {}: {error}", path.display()))?)
}

fn progress(cells: u64) -> ProgressBar {
    // Hidden where standard error is no terminal.
    let bar = ProgressBar::with_draw_target(Some(cells), ProgressDrawTarget::stderr());
    match ProgressStyle::with_template("{wide_bar} {pos}/{len} cells, {eta} left") {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
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

fn print(out: &mut impl Write, cell: Cell, measured: &Measured) -> io::Result<()> {
    for arithmetic in cell.arithmetics() {
        let found = &measured.statistics[arithmetic as usize];
        let (name, corpus) = (KINDS[cell.leaf], cell.corpus.name());
        let most = allowed(cell, arithmetic).map_or([f64::NAN; 4], |row| [row.wrong, row.p99, row.most, row.conditioned]);
        write!(out, "{name:16} {corpus:16} {:6}", arithmetic.name())?;
        let values = [found.wrong_share(), found.p99(), found.most.error, found.conditioned.error];
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

fn write_record(record: &mut csv::Writer<fs::File>, cell: Cell, measured: &Measured) -> csv::Result<()> {
    for arithmetic in cell.arithmetics() {
        let found = &measured.statistics[arithmetic as usize];
        record.serialize((
            KINDS[cell.leaf],
            cell.corpus.name(),
            arithmetic.name(),
            found.rays,
            found.wrong,
            format!("{:.4e}", found.p99()),
            format!("{:.4e}", found.most.error),
            format!("{:.4e}", found.conditioned.error),
            found.conditioned.ray,
            measured.asked,
        ))?;
    }
    Ok(())
}

/// Everything about one ray.
fn replay(cell: Cell, ray: u64) -> Result<(), Box<dyn Error>> {
    let mut out = io::stdout().lock();
    let trial = cell.trial(ray);
    let (leaf, reference) = (trial.shape.leaf()?, Reference::new(trial.shape, trial.pose));
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
