//! `gsdf bench`: what it costs to cast rays at a model, in every way there is.

use super::render::view::View;
use super::size::Size;
use super::{ModelFile, Settings};
use crate::model::Model;
use crate::model::bounds::Reach;
use crate::output::say;
use crate::progress::progress_bar;
use anyhow::Result;
use clap::{Args, value_parser};
use gsdf_nostd::Camera;
use gsdf_simd::Level;
use gsdf_trade::{Contender, Measured, Subject, measure};
use serde::Serialize;
use std::time::Duration;

/// What `gsdf bench` is told.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct Bench {
    /// Which model.
    #[command(flatten)]
    pub model: ModelFile,
    /// From where.
    #[command(flatten)]
    pub view: View,
    /// How often each contender is timed; fewer than six tell nothing with 95 % confidence
    #[arg(long, value_name = "N", default_value_t = 15, value_parser = value_parser!(u16).range(6..=1000))]
    pub rounds: u16,
    /// Tell it in JSON, with the machine and the rules
    #[arg(long)]
    pub json: bool,
}

/// What was measured, and what must be known to repeat it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The model.
    pub model: String,
    /// Its leaves.
    pub leaves: usize,
    /// The pixels in a row of the picture that was asked for.
    pub asked_width: u32,
    /// The pixels in a column of it.
    pub asked_height: u32,
    /// The pixels in a row of the picture that was taken: smaller where tiles of the other one take too long.
    pub width: u32,
    /// The pixels in a column of it.
    pub height: u32,
    /// How often each contender was timed.
    pub rounds: u16,
    /// For how long a contender may cast in a round, in milliseconds; tiles are those of the whole picture.
    pub limit_ms: u128,
    /// What is measured.
    pub what: &'static str,
    /// What the intervals are.
    pub interval: &'static str,
    /// By what hits are judged.
    pub reference: &'static str,
    /// The operating system.
    pub os: &'static str,
    /// The instruction set.
    pub architecture: &'static str,
    /// The processors.
    pub processors: usize,
    /// The vectors of packets and tiles.
    pub level: &'static str,
    /// The version of this program.
    pub version: &'static str,
    /// The contenders.
    pub measured: Vec<Measured>,
}

/// The pixels along each side if nothing is said.
const SIZE: u32 = 256;

/// For how long a contender may cast in a round. Two dozen of them make a round of seconds, whatever the model.
const LIMIT: Duration = Duration::from_millis(100);

impl Bench {
    /// Measures, and tells on standard output.
    ///
    /// # Errors
    /// Where the model cannot be read or no camera sees it.
    pub fn run(&self, settings: &Settings) -> Result<()> {
        let model = self.model.load()?;
        let report = self.measured(&model, settings.size.unwrap_or(Size::from(SIZE)), settings.level)?;
        say(&if self.json {
            serde_json::to_string_pretty(&report)?
        } else {
            told(&report)
        })
    }

    fn measured(&self, model: &Model, size: Size, level: Level) -> Result<Report> {
        let program = model.solid()?;
        let reach = model.reach();
        let raster = self.view.raster(reach, size)?;
        let name = self.model.path.display().to_string();
        let mut subject = Subject::new(&name, program, raster, far(raster.camera(), reach))?;
        subject.fit(level, LIMIT)?;
        let contenders: Vec<Contender> = Contender::all(level).collect();
        let bar = progress_bar(u64::from(self.rounds));
        let measured = measure(&subject, &contenders, usize::from(self.rounds), Some(LIMIT), || bar.inc(1))?;
        bar.finish_and_clear();
        Ok(Report {
            model: name,
            leaves: program.leaves(),
            asked_width: size.width,
            asked_height: size.height,
            width: subject.raster().width(),
            height: subject.raster().height(),
            rounds: self.rounds,
            limit_ms: LIMIT.as_millis(),
            what: "distance and leaf of a ray through the middle of each pixel, on one thread; sphere tracers: the distance alone",
            interval: "order statistics, 95 % of the median",
            reference: "f64, every leaf along every ray",
            os: std::env::consts::OS,
            architecture: std::env::consts::ARCH,
            processors: std::thread::available_parallelism().map_or(1, usize::from),
            level: level.name(),
            version: env!("CARGO_PKG_VERSION"),
            measured,
        })
    }
}

/// Beyond what distance nothing of a model is to be seen.
fn far(camera: &Camera, reach: Reach) -> f32 {
    /// Of a model without end: in times of how far its camera is from the origin, or of one unit.
    const ENDLESS: f32 = 10_000.0;
    let eye = camera.eye();
    match reach {
        // The farthest corner, and some.
        Reach::Within(bounds) => 1.01 * (eye - bounds.min).abs().max((eye - bounds.max).abs()).length(),
        Reach::Empty | Reach::Endless => ENDLESS * eye.length().max(1.0),
    }
}

/// A report in a table.
fn told(report: &Report) -> String {
    let mut told = format!(
        "{}: {} leaves, {} x {} pixels, packets and tiles in {}, one thread\n\
         {:<22} {:>10} {:>21} {:>8} {:>17} {:>9} {:>7} {:>10} {:>7} {:>7}\n",
        report.model,
        report.leaves,
        report.width,
        report.height,
        report.level,
        "",
        "ns/pixel",
        "95 %",
        "to tiles",
        "95 %",
        "worst",
        "wrong",
        "wrong leaf",
        "judged",
        "pixels",
    );
    for one in &report.measured {
        let leaf = one.wrong_leaf.map_or_else(|| "-".to_owned(), |wrong| wrong.to_string());
        let interval = |low: f64, high: f64| format!("{}..{}", short(low), short(high));
        told += &format!(
            "{:<22} {:>10} {:>21} {:>8} {:>17} {:>9.1e} {:>7} {leaf:>10} {:>7} {:>7}\n",
            one.contender,
            short(one.ns),
            interval(one.ns_low, one.ns_high),
            short(one.ratio),
            interval(one.ratio_low, one.ratio_high),
            one.worst,
            one.wrong,
            one.judged,
            one.rays,
        );
    }
    told += "worst: the largest error of a distance, relative to it, against f64; wrong: hits of what is missed, and misses of \
             what is hit\ntraced: sphere tracers, by their epsilon and most steps; a contender casts no more pixels than take ";
    told += &format!("{} ms, but for tiles: all", report.limit_ms);
    if report.width < report.asked_width {
        let Report {
            asked_width, asked_height, ..
        } = report;
        told += &format!("\nthe picture is smaller than {asked_width} x {asked_height}: tiles of that one would take longer");
    }
    told
}

/// A positive number in three digits or more.
fn short(number: f64) -> String {
    let digits = if number >= 100.0 {
        0
    } else if number >= 10.0 {
        1
    } else {
        2
    };
    format!("{number:.digits$}")
}

#[cfg(test)]
mod tests {
    use super::{far, short};
    use crate::model::bounds::Reach;
    use glam::{Vec3, vec3};
    use gsdf_nostd::{Bounds, Camera};

    #[test]
    fn numbers_have_three_digits() {
        for (number, text) in [(1234.5, "1234"), (123.4, "123"), (12.34, "12.3"), (1.234, "1.23"), (0.01, "0.01")] {
            assert_eq!(short(number), text);
        }
    }

    #[test]
    fn tracers_go_to_the_farthest_corner() {
        let camera = Camera::pinhole(vec3(0.0, 0.0, 10.0), Vec3::ZERO, Vec3::Y, 0.5).expect("there is such a camera");
        let bounds = Bounds {
            min: Vec3::NEG_ONE,
            max: vec3(1.0, 1.0, 2.0),
        };
        let corner = vec3(1.0, 1.0, 11.0).length();
        let far = far(&camera, Reach::Within(bounds));
        assert!((corner..1.02 * corner).contains(&far), "{far}");
    }
}
