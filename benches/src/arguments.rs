//! The command line of the race.

use crate::race::Rules;
use crate::scenes;
use clap::builder::PossibleValuesParser;
use clap::{Parser, value_parser};
use gsdf_simd::Level;
use std::path::PathBuf;

/// Closed form against sphere tracing, tiles against brute force, packets against rays, threads against one: by turns in one process.
#[derive(Debug, Parser)]
#[command(name = "race", version)]
pub struct Arguments {
    /// Rounds, each of one turn of A and one of B [default: 31]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=10_000))]
    rounds: Option<u32>,
    /// Pixels along each side of a picture in tiles; half of them where the marcher is one side, and an eighth or less where brute force is, by the number of leaves [default: 1024]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(8..=4096))]
    size: Option<u32>,
    /// Scenes to race on, separated by commas
    #[arg(
        long,
        value_name = "NAMES",
        value_delimiter = ',',
        default_value = "s1,s2,s3,s4,s5,s7",
        value_parser = PossibleValuesParser::new(scenes::NAMES)
    )]
    pub scenes: Vec<String>,
    /// Threads whose worth is measured against one; 1 to leave that out
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = value_parser!(u16).range(1..=1024))]
    threads: u16,
    /// Vectors of the packets on both sides: portable, avx2 or avx512, as far as this machine has them [default: the widest]
    #[arg(long, value_name = "NAME")]
    level: Option<Level>,
    /// Also write the table to this file, as CSV
    #[arg(long, value_name = "FILE")]
    pub csv: Option<PathBuf>,
    /// Three rounds of 128 x 128 pixels or fewer, unless said otherwise: to see that it runs, not to quote
    #[arg(long)]
    quick: bool,
    /// What cargo says to benchmarks.
    #[arg(long, hide = true)]
    bench: bool,
}

impl Arguments {
    /// How the race is to be run.
    #[must_use]
    pub fn rules(&self) -> Rules {
        let (rounds, size) = if self.quick { (3, 128) } else { (31, 1024) };
        Rules {
            rounds: self.rounds.unwrap_or(rounds),
            size: self.size.unwrap_or(size),
            threads: self.threads.into(),
            level: self.level.unwrap_or_else(Level::best),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Arguments;
    use clap::{CommandFactory, Parser};
    use gsdf_simd::Level;

    fn parsed(arguments: &[&str]) -> Result<Arguments, clap::Error> {
        Arguments::try_parse_from(["race"].iter().chain(arguments))
    }

    #[test]
    fn the_command_line_is_sound() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn what_is_not_said_has_a_default() -> Result<(), clap::Error> {
        let bare = parsed(&["--bench"])?;
        assert_eq!(bare.scenes, ["s1", "s2", "s3", "s4", "s5", "s7"]);
        assert_eq!((bare.rules().rounds, bare.rules().size, bare.rules().threads), (31, 1024, 2));
        let quick = parsed(&["--quick", "--rounds", "5", "--scenes", "s2,s1"])?;
        assert_eq!((quick.rules().rounds, quick.rules().size), (5, 128));
        assert_eq!(quick.scenes, ["s2", "s1"]);
        assert_eq!(bare.rules().level, Level::best());
        assert_eq!(parsed(&["--level", "portable"])?.rules().level, Level::PORTABLE);
        Ok(())
    }

    #[test]
    fn bad_values_are_refused_and_named() {
        for (arguments, named) in [
            (["--rounds", "0"], "1..=10000"),
            (["--size", "7"], "8..=4096"),
            (["--scenes", "s1,s9"], "s9"),
            (["--threads", "none"], "none"),
            (["--level", "mmx"], "portable"),
            (["--turns", "3"], "--turns"),
        ] {
            let error = parsed(&arguments).expect_err("a bad value");
            assert_eq!(error.exit_code(), 2);
            assert!(error.to_string().contains(named), "{error}");
        }
    }
}
