//! The command `trade`.

use crate::output::{say, write_whole};
use anyhow::{Context, Result};
use clap::builder::PossibleValuesParser;
use clap::value_parser;
use gsdf_simd::Level;
use gsdf_trade::{Contender, Measured, NAMES, measure, reference, svg};
use serde::Serialize;
use std::path::PathBuf;

/// What accuracy costs: ns per ray against error, of every tier and of sphere tracers.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct Trade {
    /// Scenes, separated by commas [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = PossibleValuesParser::new(NAMES))]
    scenes: Vec<String>,
    /// Pixels along each side of the pictures whose rays are cast
    #[arg(long, value_name = "N", default_value_t = 96, value_parser = value_parser!(u32).range(8..=1024))]
    pixels: u32,
    /// How often each contender is timed
    #[arg(long, value_name = "N", default_value_t = 25, value_parser = value_parser!(u16).range(1..=1000))]
    rounds: u16,
    /// Draw the chart to this SVG file
    #[arg(long, value_name = "FILE")]
    chart: Option<PathBuf>,
    /// Write what was measured to this CSV file
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Write it to this JSON file, with the machine and the rules
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
}

/// What must be known to repeat it.
#[derive(Debug, Serialize)]
struct Report<'a> {
    os: &'static str,
    architecture: &'static str,
    processors: usize,
    level: String,
    version: &'static str,
    rounds: u16,
    pixels: u32,
    seeds: &'static str,
    interval: &'static str,
    measured: &'a [Measured],
}

impl Trade {
    /// Measures, and writes what was asked for.
    ///
    /// # Errors
    /// Where a file cannot be written.
    pub fn run(&self, level: Level) -> Result<()> {
        let asked = |name: &&&str| self.scenes.is_empty() || self.scenes.iter().any(|asked| asked == **name);
        let contenders: Vec<Contender> = Contender::all(level).collect();
        let mut all = Vec::new();
        say(&format!(
            "{:<5} {:<28} {:>9} {:>19} {:>9} {:>9} {:>6} {:>10}",
            "scene", "contender", "ns/ray", "95 % of the median", "p99", "worst", "wrong", "wrong leaf"
        ))?;
        for name in NAMES.iter().filter(asked) {
            let scene = reference(name, self.pixels)?;
            let measured = measure(&scene, &contenders, usize::from(self.rounds), None, || {})?;
            for one in &measured {
                let interval = format!("{:.1}..{:.1}", one.ns_low, one.ns_high);
                let leaf = one.wrong_leaf.map_or_else(|| "-".to_owned(), |wrong| wrong.to_string());
                say(&format!(
                    "{:<5} {:<28} {:>9.1} {interval:>19} {:>9.1e} {:>9.1e} {:>6} {leaf:>10}{}",
                    one.scene,
                    one.contender,
                    one.ns,
                    one.p99,
                    one.worst,
                    one.wrong,
                    if one.is_best { " *" } else { "" }
                ))?;
            }
            all.extend(measured);
        }
        say(&format!(
            "errors are relative to the distance, of {} x {} rays per scene against f64; * no other one is both faster and more accurate",
            self.pixels, self.pixels
        ))?;
        if let Some(path) = &self.chart {
            write_whole(svg(&all)?.as_bytes(), path)?;
        }
        if let Some(path) = &self.csv {
            let mut rows = csv::Writer::from_writer(Vec::new());
            for one in &all {
                rows.serialize(one)?;
            }
            write_whole(&rows.into_inner()?, path)?;
        }
        if let Some(path) = &self.json {
            let report = Report {
                os: std::env::consts::OS,
                architecture: std::env::consts::ARCH,
                processors: std::thread::available_parallelism().map_or(1, usize::from),
                level: level.to_string(),
                version: env!("CARGO_PKG_VERSION"),
                rounds: self.rounds,
                pixels: self.pixels,
                seeds: "none: each ray goes through the middle of its pixel",
                interval: "order statistics, 95 % of the median",
                measured: &all,
            };
            write_whole(&serde_json::to_vec_pretty(&report).context("cannot write JSON")?, path)?;
        }
        Ok(())
    }
}
