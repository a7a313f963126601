//! How many instructions a pixel takes, as callgrind counts them: figures that a busy machine does not move.

use crate::arena::Arena;
use crate::contender::Contender;
use crate::frame::Frame;
use crate::scenes::Scene;
use anyhow::{Context, Result, bail, ensure};
use gsdf_simd::Level;
use std::fmt::{self, Write as _};
use std::path::Path;
use std::process::Command;

/// By how much a figure may grow before it is an error, and shrink before it is worth recording.
pub const TOLERANCE: f64 = 0.05;

/// The scenes that are counted.
const SCENES: [&str; 7] = ["s1", "s2", "s3", "s4", "s5", "s6-10", "s7"];

/// How a picture is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Tile by tile, at a level.
    Tiles(Level),
    /// Ray by ray, every leaf along each.
    Rays,
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tiles(level) => level.fmt(f),
            Self::Rays => f.pad("scalar"),
        }
    }
}

impl std::str::FromStr for Way {
    type Err = anyhow::Error;

    fn from_str(name: &str) -> Result<Self> {
        Ok(match name {
            "scalar" => Self::Rays,
            level => Self::Tiles(level.parse()?),
        })
    }
}

/// What is counted: a scene, and a way to compute its picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Query {
    /// The name of the scene.
    pub scene: &'static str,
    /// The way.
    pub way: Way,
}

impl Query {
    /// All that are counted. Callgrind has no AVX-512, and so there is no level beyond AVX2.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let levels = Level::available().filter(|level| level.name() != "avx512").map(Way::Tiles);
        let ways: Vec<_> = levels.chain([Way::Rays]).collect();
        let of = |scene| ways.iter().map(move |way| Self { scene, way: *way });
        SCENES.into_iter().flat_map(of).collect()
    }

    /// The pixels along each side of its picture. Brute force over thousands of leaves takes its time.
    ///
    /// # Errors
    /// Where there is no such scene.
    pub fn size(&self) -> Result<u32> {
        Ok(match (self.way, Scene::by_name(self.scene)?.program()?.leaves()) {
            (Way::Tiles(_), _) => 256,
            (Way::Rays, 0..=8) => 128,
            (Way::Rays, 9..=256) => 32,
            (Way::Rays, _) => 8,
        })
    }

    /// Computes so many pictures: what is done under callgrind, on this thread alone.
    ///
    /// # Errors
    /// Where there is no such scene.
    pub fn compute(&self, pictures: u32) -> Result<()> {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .use_current_thread()
            .build()
            .context("this thread to count on")?;
        let scene = Scene::by_name(self.scene)?;
        let (contender, level) = match self.way {
            Way::Tiles(level) => (Contender::ClosedTiles, level),
            Way::Rays => (Contender::ClosedRays, Level::PORTABLE),
        };
        pool.install(|| {
            let arena = Arena::new(&scene, self.size()?)?.at_level(level);
            let mut frame = Frame::new(&arena.raster);
            let mut paint = contender.ready(&arena);
            for _ in 0..pictures {
                paint(&mut frame);
            }
            Ok(())
        })
    }

    /// The instructions per pixel of the pictures of `program`, which is this bench: the difference between two numbers of them, so that what comes before the first does not
    /// count.
    ///
    /// # Errors
    /// Where callgrind is not installed, or says something else.
    pub fn count(&self, program: &Path) -> Result<f64> {
        let (few, many) = (1, 3);
        let difference = self.collected(program, many)?.saturating_sub(self.collected(program, few)?);
        Ok(difference as f64 / f64::from(many - few) / f64::from(self.size()?).powi(2))
    }

    fn collected(&self, program: &Path, pictures: u32) -> Result<u64> {
        let output = Command::new("valgrind")
            .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
            .arg(program)
            .args([
                "--scene",
                self.scene,
                "--way",
                &self.way.to_string(),
                "--pictures",
                &pictures.to_string(),
            ])
            .output()
            .context("cannot run valgrind, which counts: is it installed?")?;
        let said = String::from_utf8_lossy(&output.stderr);
        ensure!(output.status.success(), "{} {} under valgrind: {said}", self.scene, self.way);
        let count = said.lines().find_map(|line| line.split_once("Collected : "));
        let count = count.with_context(|| format!("valgrind counted nothing: {said}"))?.1;
        Ok(count.trim().parse()?)
    }
}

/// A query with its count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// What was counted.
    pub query: Query,
    /// Instructions per pixel.
    pub instructions: f64,
}

/// The first line of the record.
const HEAD: &str = "scene,way,instructions_per_pixel";

/// The record of some figures, as CSV.
#[must_use]
pub fn record(figures: &[Figure]) -> String {
    let mut lines = format!("{HEAD}\n");
    for Figure { query, instructions } in figures {
        // Writing to a string cannot fail.
        let _ = writeln!(lines, "{},{},{instructions:.1}", query.scene, query.way);
    }
    lines
}

/// The figure of a query in a record.
///
/// # Errors
/// Where the record is none, or has none for the query.
pub fn recorded(record: &str, query: &Query) -> Result<f64> {
    let mut lines = record.lines();
    ensure!(lines.next() == Some(HEAD), "a record begins with '{HEAD}'");
    for line in lines {
        let [scene, way, instructions] = line.split(',').collect::<Vec<_>>()[..] else {
            bail!("not a figure: '{line}'");
        };
        if scene == query.scene && way == query.way.to_string() {
            return instructions.parse().with_context(|| format!("not a number: '{line}'"));
        }
    }
    bail!("{} {} is not recorded", query.scene, query.way)
}

/// How a figure compares with what is recorded of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// Within the tolerance.
    None,
    /// More instructions than before.
    Grown,
    /// Fewer.
    Shrunk,
}

impl Change {
    /// The change from what is recorded to what is found.
    #[must_use]
    pub fn between(recorded: f64, found: f64) -> Self {
        if found > recorded * (1.0 + TOLERANCE) {
            Self::Grown
        } else if found < recorded * (1.0 - TOLERANCE) {
            Self::Shrunk
        } else {
            Self::None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Change, Figure, Query, Way, record, recorded};
    use anyhow::Result;

    #[test]
    fn a_record_is_read_as_it_was_written() -> Result<()> {
        let figures: Vec<_> = (Query::all().into_iter().zip(1_u16..))
            .map(|(query, number)| Figure {
                query,
                instructions: f64::from(number) * 0.5,
            })
            .collect();
        let record = record(&figures);
        for figure in &figures {
            assert_eq!(recorded(&record, &figure.query)?, figure.instructions);
        }
        assert!(recorded("", &figures[0].query).is_err());
        assert!(
            recorded(
                "scene,way,instructions_per_pixel\ns1,scalar,many\n",
                &Query {
                    scene: "s1",
                    way: Way::Rays
                }
            )
            .is_err()
        );
        assert!(recorded("scene,way,instructions_per_pixel\n", &figures[0].query).is_err());
        Ok(())
    }

    #[test]
    fn five_percent_are_a_change() {
        for (found, change) in [
            (100.0, Change::None),
            (104.9, Change::None),
            (105.1, Change::Grown),
            (95.1, Change::None),
            (94.9, Change::Shrunk),
        ] {
            assert_eq!(Change::between(100.0, found), change, "{found}");
        }
    }

    #[test]
    fn every_query_can_be_computed() -> Result<()> {
        for query in Query::all() {
            assert_eq!(query.way.to_string().parse::<Way>()?, query.way);
            if query.scene == "s1" {
                // A thread joins one pool alone.
                let computed = std::thread::scope(|scope| scope.spawn(|| query.compute(1)).join());
                computed.expect("no panic")?;
            }
        }
        Ok(())
    }
}
