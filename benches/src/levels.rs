//! Levels by turns: each in this build, beside the same and the portable one in a build for the native processor.

use crate::arena::Arena;
use crate::contender::Contender;
use crate::frame::Frame;
use crate::scenes::Scene;
use crate::stats::Estimate;
use anyhow::{Context, Result, bail, ensure};
use clap::{Parser, value_parser};
use gsdf_simd::Level;
use rayon::ThreadPool;
use std::fmt;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::str::FromStr;
use std::time::{Duration, Instant};

/// Levels of this build against those of a native one, by turns, on one thread.
#[derive(Debug, Parser)]
#[command(name = "levels", version)]
pub struct Arguments {
    /// Rounds, each of one turn of either build
    #[arg(long, value_name = "N", default_value_t = 31, value_parser = value_parser!(u32).range(1..=10_000))]
    pub rounds: u32,
    /// Three rounds of small pictures: to see that it runs, not to quote
    #[arg(long)]
    pub quick: bool,
    /// Take the turns that are asked for on standard input: what one build has the other do.
    #[arg(long, hide = true)]
    pub serve: bool,
    /// What cargo says to benchmarks.
    #[arg(long, hide = true)]
    bench: bool,
}

/// How long a turn lasts at least.
const LEAST_TURN: Duration = Duration::from_millis(4);

/// A picture to be cast over and over: on the command line, or in a line to another process, its four words.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    /// The name of the scene.
    pub scene: String,
    /// The pixels along each side.
    pub size: u32,
    /// The level.
    pub level: Level,
    /// How many times it is cast.
    pub repeats: u32,
}

impl fmt::Display for Turn {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {} {}", self.scene, self.size, self.level, self.repeats)
    }
}

impl FromStr for Turn {
    type Err = anyhow::Error;

    fn from_str(line: &str) -> Result<Self> {
        let [scene, size, level, repeats] = line.split_whitespace().collect::<Vec<_>>()[..] else {
            bail!("not a turn: '{line}'");
        };
        Ok(Self {
            scene: scene.to_owned(),
            size: size.parse()?,
            level: level.parse()?,
            repeats: repeats.parse()?,
        })
    }
}

/// The nanoseconds per pixel of a turn of tiles in closed form, in this process.
///
/// # Errors
/// Where there is no such scene.
pub fn take(turn: &Turn, pool: &ThreadPool) -> Result<f64> {
    let scene = Scene::by_name(&turn.scene)?;
    let arena = Arena::new(&scene, turn.size)?.at_level(turn.level);
    let mut frame = Frame::new(&arena.raster);
    let mut paint = Contender::ClosedTiles.ready(&arena);
    let elapsed = pool.install(|| {
        let begin = Instant::now();
        for _ in 0..turn.repeats {
            paint(&mut frame);
            std::hint::black_box(&mut frame);
        }
        begin.elapsed()
    });
    Ok(elapsed.as_secs_f64() * 1e9 / (f64::from(turn.repeats) * arena.pixels() as f64))
}

/// Takes the turns that are asked for line by line, and answers with their times, until there are no more.
///
/// # Errors
/// Where a line is no turn, or nobody listens.
pub fn serve(pool: &ThreadPool, asked: impl BufRead, mut answers: impl Write) -> Result<()> {
    for line in asked.lines() {
        writeln!(answers, "{}", take(&line?.parse()?, pool)?)?;
        answers.flush()?;
    }
    Ok(())
}

/// The same program of another build, which takes turns when asked.
#[derive(Debug)]
pub struct Peer {
    process: Child,
    asked: Option<ChildStdin>,
    answers: BufReader<ChildStdout>,
}

impl Peer {
    /// Starts it.
    ///
    /// # Errors
    /// Where it does not start.
    pub fn start(program: &Path) -> Result<Self> {
        let mut process = (Command::new(program).arg("--serve"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .with_context(|| format!("cannot start {}", program.display()))?;
        let asked = process.stdin.take();
        let answers = process.stdout.take().context("it has no output")?;
        Ok(Self {
            process,
            asked,
            answers: BufReader::new(answers),
        })
    }

    /// The nanoseconds per pixel of a turn there.
    ///
    /// # Errors
    /// Where it is gone.
    pub fn take(&mut self, turn: &Turn) -> Result<f64> {
        let asked = self.asked.as_mut().context("it has no input")?;
        writeln!(asked, "{turn}")?;
        let mut answer = String::new();
        self.answers.read_line(&mut answer)?;
        answer
            .trim()
            .parse()
            .with_context(|| format!("{turn}: the other build answered '{answer}'"))
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // The end of its input ends it; how it ended is nobody's question any more.
        self.asked = None;
        let _ = self.process.wait();
    }
}

/// Builds this bench for the native processor, and says where it is.
///
/// # Errors
/// Where it does not build.
pub fn build_native() -> Result<PathBuf> {
    let build = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["bench", "--package", "gsdf-benches", "--bench", "levels", "--no-run"])
        .args(["--message-format", "json-render-diagnostics"])
        .args(["--target-dir", concat!(env!("CARGO_MANIFEST_DIR"), "/../target/native")])
        .env("RUSTFLAGS", "-C target-cpu=native")
        .stderr(Stdio::inherit())
        .output()
        .context("cannot run cargo")?;
    ensure!(build.status.success(), "the native build failed");
    let messages = String::from_utf8_lossy(&build.stdout);
    // The bench itself is the last that is built, and the only one with an executable that was asked for.
    let path = messages
        .rsplit_once("\"executable\":\"")
        .and_then(|(_, rest)| rest.split_once('"'))
        .context("cargo named no executable")?;
    Ok(path.0.into())
}

/// A level of this build beside one of another.
#[derive(Clone, Copy, Debug)]
pub struct Beside {
    /// Nanoseconds per pixel here.
    pub here: f64,
    /// Nanoseconds per pixel there.
    pub there: f64,
    /// The time there divided by the time here, round by round: the share of the other build's speed that this one has.
    pub share: Estimate,
}

/// Takes rounds of two turns: the first here, the second in the other build; each begins every other round.
///
/// # Errors
/// Where a turn cannot be taken.
pub fn beside(here: &Turn, there: &Turn, rounds: u32, pool: &ThreadPool, peer: &mut Peer) -> Result<Beside> {
    let (here, there) = (lasting(here, |turn| take(turn, pool))?, lasting(there, |turn| peer.take(turn))?);
    let (mut times_here, mut times_there) = (Vec::new(), Vec::new());
    for round in 0..rounds.max(1) {
        if round % 2 == 0 {
            times_here.push(take(&here, pool)?);
            times_there.push(peer.take(&there)?);
        } else {
            times_there.push(peer.take(&there)?);
            times_here.push(take(&here, pool)?);
        }
    }
    let shares: Vec<f64> = times_here.iter().zip(&times_there).map(|(here, there)| there / here).collect();
    let estimate = |sample: &[f64]| Estimate::new(sample).unwrap_or(Estimate::UNKNOWN);
    Ok(Beside {
        here: estimate(&times_here).median,
        there: estimate(&times_there).median,
        share: estimate(&shares),
    })
}

/// The turn with so many repeats that it lasts.
fn lasting(turn: &Turn, mut take: impl FnMut(&Turn) -> Result<f64>) -> Result<Turn> {
    let once = Turn {
        repeats: 1,
        ..turn.clone()
    };
    let picture = take(&once)?.min(take(&once)?) * f64::from(turn.size * turn.size);
    let repeats = (LEAST_TURN.as_nanos() as f64 / picture).ceil().clamp(1.0, 1e6) as u32;
    Ok(Turn { repeats, ..once })
}

#[cfg(test)]
mod tests {
    use super::{Arguments, Turn, serve};
    use anyhow::Result;
    use clap::CommandFactory;
    use gsdf_simd::Level;
    use rayon::ThreadPoolBuilder;

    #[test]
    fn the_command_line_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn turns_are_lines() -> Result<()> {
        for level in Level::available() {
            let turn = Turn {
                scene: "s1".into(),
                size: 24,
                level,
                repeats: 3,
            };
            assert_eq!(turn.to_string().parse::<Turn>()?, turn);
        }
        for line in ["", "s1 24 portable", "s1 24 mmx 3", "s1 x portable 3", "s1 24 portable 3 4"] {
            assert!(line.parse::<Turn>().is_err(), "{line}");
        }
        Ok(())
    }

    #[test]
    fn what_is_asked_for_is_taken_line_by_line() -> Result<()> {
        let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
        let mut answers = Vec::new();
        serve(&pool, "s1 16 portable 2\ns2 8 portable 1\n".as_bytes(), &mut answers)?;
        let answers = String::from_utf8(answers)?;
        let times: Vec<f64> = answers.lines().map(str::parse).collect::<Result<_, _>>()?;
        assert!(times.len() == 2 && times.iter().all(|time| *time > 0.0), "{answers}");
        assert!(serve(&pool, "s9 16 portable 2\n".as_bytes(), Vec::new()).is_err());
        Ok(())
    }
}
