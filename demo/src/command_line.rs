//! The command line: its commands and options.

use crate::commands::bench::Bench;
use crate::commands::cast::Cast;
use crate::commands::export::Export;
use crate::commands::info::Info;
use crate::commands::render::Render;
use crate::commands::size::Size;
use crate::commands::trade::Trade;
use crate::scenes;
use clap::builder::PossibleValuesParser;
use clap::error::{Error, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand, value_parser};
use gsdf_simd::Level;
use std::path::PathBuf;

/// Pictures of CSG solids, ray-cast in closed form, and answers about them.
///
/// Without a command it renders the gallery.
#[derive(Debug, Parser)]
// A command ends the names after `--scene`.
#[command(name = "gsdf", version, subcommand_precedence_over_arg = true)]
pub struct CommandLine {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
    #[command(flatten)]
    pub(crate) options: Options,
}

#[derive(Clone, Debug, PartialEq, Subcommand)]
pub(crate) enum Command {
    /// Render scenes to PNG files, with a table of what each took, and all scenes on one sheet
    Gallery,
    /// Render scenes to one PNG file, on which they stand side by side
    Sheet,
    /// Render every shape there is, all on one sheet
    Shapes {
        /// Also render each to a small PNG file in this directory, with Markdown that holds it
        #[arg(long, value_name = "DIRECTORY")]
        each: Option<PathBuf>,
    },
    /// Compare the ways to read the paper's composition with the exact one, on a sheet and in a table
    Paper,
    /// Measure what accuracy costs: tiers and sphere tracers, time against error
    Trade(Trade),
    /// Tell what a model is made of: leaves, bounds, and what it costs
    Info(Info),
    /// Render a model to a PNG file, in colours or as data
    Render(Render),
    /// Cast rays at a model: a line of text for each
    Cast(Cast),
    /// Write a model as source text
    Export(Export),
    /// Measure what it costs to cast rays at a model: tiers and sphere tracers, single rays, packets and tiles, by turns
    Bench(Bench),
}

/// They may stand before the command or after it.
#[derive(Args, Debug)]
pub(crate) struct Options {
    /// Pixels along each side of a picture, N or, of a model, also `WxH`; on a sheet half of them [default: 512, paper: 256]
    #[arg(long, global = true, value_name = "N")]
    pub(crate) size: Option<Size>,
    /// Directory of the pictures, or file of the sheet, picture, answers or text [default: gallery, gallery/sheet.png,
    /// gallery/shapes.png, gallery/paper.png, the model's name, standard output]
    #[arg(long, global = true, value_name = "PATH")]
    pub(crate) out: Option<PathBuf>,
    /// Scenes to render [default: all]
    #[arg(long, global = true, value_name = "NAME", num_args = 1.., value_parser = PossibleValuesParser::new(scenes::names()))]
    pub(crate) scene: Vec<String>,
    /// Threads to work on [default: one per core]
    #[arg(long, global = true, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Vectors to cast primary rays in: portable, avx2 or avx512, as far as this machine has them [default: `GSDF_LEVEL`, or the widest]
    #[arg(long, global = true, value_name = "NAME")]
    pub(crate) level: Option<Level>,
}

impl Options {
    /// Refuses those of these options that are given.
    pub(crate) fn refuse(&self, names: &[&str]) -> Result<(), Error> {
        let given = [
            ("--scene", !self.scene.is_empty()),
            ("--size", self.size.is_some()),
            ("--out", self.out.is_some()),
            ("--threads", self.threads.is_some()),
            ("--level", self.level.is_some()),
        ];
        match given.iter().find(|(name, given)| *given && names.contains(name)) {
            Some((name, _)) => Err(CommandLine::command().error(ErrorKind::ArgumentConflict, format!("the command takes no {name}"))),
            None => Ok(()),
        }
    }

    /// How many threads there may be, if that is said.
    pub(crate) fn threads(&self) -> Option<usize> {
        self.threads.map(usize::from)
    }

    /// The pixels along each side of pictures that are squares.
    pub(crate) fn square(&self) -> Result<Option<u32>, Error> {
        let wrong = |size| {
            let message = format!("--size {size}: only pictures of models need not be squares");
            CommandLine::command().error(ErrorKind::ValueValidation, message)
        };
        self.size.map(|size| size.square().ok_or_else(|| wrong(size))).transpose()
    }

    /// The level that is asked for, here or in the environment.
    pub(crate) fn level(&self) -> Result<Level, Error> {
        match self.level {
            Some(level) => Ok(level),
            None => Level::chosen().map_err(|error| CommandLine::command().error(ErrorKind::InvalidValue, error)),
        }
    }
}

/// An error of the command line in one line; `None` where it is no error but help, which is asked for.
#[must_use]
pub fn in_one_line(error: &Error) -> Option<String> {
    if !error.use_stderr() {
        return None;
    }
    let text = error.render().to_string();
    // What follows an empty line is how the command is used.
    let first = text.split("\n\n").next().unwrap_or_default();
    let words: Vec<_> = first.split_whitespace().collect();
    Some(words.join(" "))
}

#[cfg(test)]
mod tests {
    use super::CommandLine;
    use crate::scenes;
    use clap::{CommandFactory, Parser};

    #[test]
    fn the_command_line_is_sound() {
        CommandLine::command().debug_assert();
    }

    #[test]
    fn bad_values_are_refused_and_good_ones_named() {
        let refusal = |arguments: [&str; 2]| {
            let error = CommandLine::try_parse_from(["gsdf"].into_iter().chain(arguments)).expect_err("a bad value");
            assert_eq!(error.exit_code(), 2);
            error.to_string()
        };
        for size in ["0", "4097", "-1", "many"] {
            assert!(refusal(["--size", size]).contains(size));
        }
        assert!(refusal(["--threads", "0"]).contains("1..=1024"));
        let message = refusal(["--scene", "s9"]);
        assert!(scenes::names().iter().all(|name| message.contains(name)), "{message}");
    }
}
