//! `gsdf`: renders the gallery and the shapes, and measures the paper's reading.

use clap::builder::PossibleValuesParser;
use clap::error::{Error, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand, value_parser};
use gsdf_demo::gallery::Gallery;
use gsdf_demo::paper::command::Paper;
use gsdf_demo::scenes;
use gsdf_demo::shapes::Shapes;
use gsdf_simd::Level;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Pictures of CSG solids, ray-cast in closed form.
///
/// Without a command it renders the gallery.
#[derive(Debug, Parser)]
// A command ends the names after `--scene`.
#[command(name = "gsdf", version, subcommand_precedence_over_arg = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    options: Options,
}

#[derive(Clone, Debug, PartialEq, Subcommand)]
enum Command {
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
}

/// They may stand before the command or after it.
#[derive(Args, Debug)]
struct Options {
    /// Pixels along each side of a picture; on a sheet half of them [default: 512, paper: 256]
    #[arg(long, global = true, value_name = "N", value_parser = value_parser!(u32).range(1..=4096))]
    size: Option<u32>,
    /// Directory of the pictures, or file of the sheet [default: gallery, gallery/sheet.png, gallery/shapes.png, gallery/paper.png]
    #[arg(long, global = true, value_name = "PATH")]
    out: Option<PathBuf>,
    /// Scenes to render [default: all]
    #[arg(long, global = true, value_name = "NAME", num_args = 1.., value_parser = PossibleValuesParser::new(scenes::names()))]
    scene: Vec<String>,
    /// Threads to render on [default: one per core]
    #[arg(long, global = true, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Vectors to cast primary rays in: portable, avx2 or avx512, as far as this machine has them [default: `GSDF_LEVEL`, or the widest]
    #[arg(long, global = true, value_name = "NAME")]
    level: Option<Level>,
}

impl Options {
    /// The level that is asked for, here or in the environment.
    fn level(&self) -> Result<Level, Error> {
        match self.level {
            Some(level) => Ok(level),
            None => Level::chosen().map_err(|error| CommandLine::command().error(ErrorKind::InvalidValue, error)),
        }
    }
}

/// Where pictures and sheet lie if nothing else is said.
const DIRECTORY: &str = "gallery";
const SHEET: &str = "sheet.png";
const SHAPES: &str = "shapes.png";
const PAPER: &str = "paper.png";

/// What a command line asks for.
enum Job {
    Gallery(Gallery),
    Shapes(Shapes),
    Paper(Paper),
}

impl TryFrom<CommandLine> for Job {
    type Error = Error;

    /// What no single option shows to be wrong.
    fn try_from(line: CommandLine) -> Result<Self, Error> {
        let options = line.options;
        let threads = options.threads.map(usize::from);
        let level = options.level();
        let in_gallery = |name| Path::new(DIRECTORY).join(name);
        let refuse = |kind, message: &str| Err(CommandLine::command().error(kind, message));
        let (directory, sheet) = match line.command.unwrap_or(Command::Gallery) {
            Command::Gallery => {
                let directory = options.out.unwrap_or_else(|| DIRECTORY.into());
                // Some scenes alone are not the sheet of all.
                let sheet = options.scene.is_empty().then(|| directory.join(SHEET));
                (Some(directory), sheet)
            }
            Command::Sheet => (None, Some(options.out.unwrap_or_else(|| in_gallery(SHEET)))),
            Command::Shapes { each } => {
                if !options.scene.is_empty() {
                    return refuse(ErrorKind::ArgumentConflict, "shapes are no scenes: the command takes no --scene");
                }
                return Ok(Self::Shapes(Shapes {
                    size: options.size.unwrap_or(512),
                    sheet: options.out.unwrap_or_else(|| in_gallery(SHAPES)),
                    each,
                    threads,
                    level: level?,
                }));
            }
            Command::Paper => {
                if !options.scene.is_empty() {
                    return refuse(ErrorKind::ArgumentConflict, "the paper has shapes of its own: it takes no --scene");
                }
                if options.level.is_some() {
                    return refuse(
                        ErrorKind::ArgumentConflict,
                        "the paper's rays are cast one by one: it takes no --level",
                    );
                }
                let size = options.size.unwrap_or(256);
                if !Paper::SIZES.contains(&size) {
                    let message = format!(
                        "the paper's sheet takes a --size from {} to {}",
                        Paper::SIZES.start(),
                        Paper::SIZES.end()
                    );
                    return refuse(ErrorKind::ValueValidation, &message);
                }
                return Ok(Self::Paper(Paper {
                    size,
                    sheet: options.out.unwrap_or_else(|| in_gallery(PAPER)),
                    threads,
                }));
            }
        };
        Ok(Self::Gallery(Gallery {
            scenes: options.scene,
            size: options.size.unwrap_or(512),
            directory,
            sheet,
            threads,
            level: level?,
        }))
    }
}

fn main() -> ExitCode {
    let done = match Job::try_from(CommandLine::parse()) {
        Ok(Job::Gallery(gallery)) => gallery.render(),
        Ok(Job::Shapes(shapes)) => shapes.render(),
        Ok(Job::Paper(paper)) => paper.run(),
        // With status 2, like all wrong usage.
        Err(error) => error.exit(),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // The whole chain of causes in one line. If nobody can read it, the status still tells.
            let _ = writeln!(io::stderr(), "error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{CommandLine, Job, Paper};
    use clap::{CommandFactory, Parser};
    use gsdf_demo::gallery::Gallery;
    use gsdf_demo::scenes;
    use gsdf_simd::Level;

    #[test]
    fn the_command_line_is_sound() {
        CommandLine::command().debug_assert();
    }

    fn job(arguments: &[&str]) -> Result<Job, clap::Error> {
        Job::try_from(CommandLine::try_parse_from(["gsdf"].iter().chain(arguments))?)
    }

    fn gallery(arguments: &[&str]) -> Gallery {
        match job(arguments) {
            Ok(Job::Gallery(gallery)) => gallery,
            _ => panic!("{arguments:?} is no gallery"),
        }
    }

    #[test]
    fn shapes_are_a_sheet_and_pictures_if_asked_for() {
        let shapes = |arguments: &[&str]| match job(arguments) {
            Ok(Job::Shapes(shapes)) => shapes,
            _ => panic!("{arguments:?} is no sheet of shapes"),
        };
        let bare = shapes(&["shapes"]);
        assert_eq!((bare.sheet, bare.each, bare.size), ("gallery/shapes.png".into(), None, 512));
        let told = shapes(&["shapes", "--each", "here", "--out", "all.png", "--threads", "3", "--size", "64"]);
        assert_eq!((told.sheet, told.each), ("all.png".into(), Some("here".into())));
        assert_eq!((told.size, told.threads), (64, Some(3)));
        assert!(job(&["shapes", "--scene", "s1"]).is_err());
    }

    #[test]
    fn the_paper_is_a_sheet_of_its_own() {
        let paper = |arguments: &[&str]| match job(arguments) {
            Ok(Job::Paper(paper)) => paper,
            _ => panic!("{arguments:?} is no paper"),
        };
        let bare = Paper {
            size: 256,
            sheet: "gallery/paper.png".into(),
            threads: None,
        };
        assert_eq!(paper(&["paper"]), bare);
        let told = Paper {
            size: 300,
            sheet: "here.png".into(),
            threads: Some(1),
        };
        assert_eq!(paper(&["paper", "--size", "300", "--out", "here.png", "--threads", "1"]), told);
    }

    #[test]
    fn what_the_paper_does_not_take_is_refused() {
        for arguments in [
            ["paper", "--scene", "s1"],
            ["paper", "--level", "portable"],
            ["paper", "--size", "191"],
            ["paper", "--size", "1025"],
        ] {
            let Err(error) = job(&arguments) else {
                panic!("{arguments:?} is taken")
            };
            assert_eq!(error.exit_code(), 2);
            assert!(error.to_string().contains(arguments[1]), "{error}");
        }
    }

    #[test]
    fn the_gallery_is_what_is_meant_without_a_command() {
        let bare = gallery(&["--size", "7"]);
        assert_eq!((bare.size, bare.scenes.len(), bare.threads), (7, 0, None));
        assert_eq!(bare.directory, Some("gallery".into()));
        assert_eq!(bare.sheet, Some("gallery/sheet.png".into()));
    }

    #[test]
    fn options_stand_before_the_command_or_after_it() {
        for arguments in [["--size", "9", "gallery"], ["gallery", "--size", "9"]] {
            assert_eq!(gallery(&arguments).size, 9);
        }
        assert_eq!(gallery(&["--scene", "s1", "hollow", "sheet"]).scenes.len(), 2);
        let some = gallery(&["--out", "here", "gallery", "--scene", "s1", "hollow"]);
        assert_eq!((some.directory, some.sheet), (Some("here".into()), None));
        assert_eq!(some.scenes, ["s1", "hollow"]);
    }

    #[test]
    fn a_sheet_is_one_file() {
        let sheet = gallery(&["sheet", "--out", "all.png"]);
        assert_eq!((sheet.directory, sheet.sheet), (None, Some("all.png".into())));
        assert_eq!(gallery(&["sheet"]).sheet, Some("gallery/sheet.png".into()));
    }

    #[test]
    fn rays_are_cast_at_the_level_that_is_named() {
        for level in Level::available() {
            assert_eq!(gallery(&["--level", level.name()]).level, level);
        }
        let Err(error) = job(&["--level", "mmx"]) else {
            panic!("no machine has it")
        };
        let message = error.to_string();
        assert!(Level::available().all(|level| message.contains(level.name())), "{message}");
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
