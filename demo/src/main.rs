//! `gsdf`: renders the gallery, and the shapes.

use anyhow::Result;
use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, value_parser};
use gsdf_demo::gallery::Gallery;
use gsdf_demo::scenes;
use gsdf_demo::shapes::Shapes;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Pictures of CSG solids, ray-cast in closed form.
///
/// Without a command it renders the gallery.
#[derive(Debug, Parser)]
// A command ends the names after `--scene`.
#[command(version, subcommand_precedence_over_arg = true)]
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
}

/// They may stand before the command or after it.
#[derive(Args, Debug)]
struct Options {
    /// Pixels along each side of a picture; on the sheet half of them
    #[arg(long, global = true, value_name = "N", default_value_t = 512, value_parser = value_parser!(u32).range(1..=4096))]
    size: u32,
    /// Directory of the pictures, or file of the sheet [default: gallery, gallery/sheet.png, gallery/shapes.png]
    #[arg(long, global = true, value_name = "PATH")]
    out: Option<PathBuf>,
    /// Scenes to render [default: all]
    #[arg(long, global = true, value_name = "NAME", num_args = 1.., value_parser = PossibleValuesParser::new(scenes::names()))]
    scene: Vec<String>,
    /// Threads to render on [default: one per core]
    #[arg(long, global = true, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

/// Where pictures and sheet lie if nothing else is said.
const DIRECTORY: &str = "gallery";
const SHEET: &str = "sheet.png";
const SHAPES: &str = "shapes.png";

/// What is asked for.
#[derive(Debug)]
enum Work {
    Gallery(Gallery),
    Shapes(Shapes),
}

impl Work {
    fn render(&self) -> Result<()> {
        match self {
            Self::Gallery(gallery) => gallery.render(),
            Self::Shapes(shapes) => shapes.render(),
        }
    }
}

impl From<CommandLine> for Work {
    fn from(line: CommandLine) -> Self {
        let options = line.options;
        let (directory, sheet) = match line.command.unwrap_or(Command::Gallery) {
            Command::Shapes { each } => {
                return Self::Shapes(Shapes {
                    size: options.size,
                    sheet: options.out.unwrap_or_else(|| Path::new(DIRECTORY).join(SHAPES)),
                    each,
                    threads: options.threads.map(usize::from),
                });
            }
            Command::Gallery => {
                let directory = options.out.unwrap_or_else(|| DIRECTORY.into());
                // Some scenes alone are not the sheet of all.
                let sheet = options.scene.is_empty().then(|| directory.join(SHEET));
                (Some(directory), sheet)
            }
            Command::Sheet => (None, Some(options.out.unwrap_or_else(|| Path::new(DIRECTORY).join(SHEET)))),
        };
        Self::Gallery(Gallery {
            scenes: options.scene,
            size: options.size,
            directory,
            sheet,
            threads: options.threads.map(usize::from),
        })
    }
}

fn main() -> ExitCode {
    match Work::from(CommandLine::parse()).render() {
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
    use super::{CommandLine, Work};
    use clap::{CommandFactory, Parser};
    use gsdf_demo::gallery::Gallery;
    use gsdf_demo::scenes;

    #[test]
    fn the_command_line_is_sound() {
        CommandLine::command().debug_assert();
    }

    fn work(arguments: &[&str]) -> Work {
        CommandLine::parse_from(["gsdf"].iter().chain(arguments)).into()
    }

    fn gallery(arguments: &[&str]) -> Gallery {
        match work(arguments) {
            Work::Gallery(gallery) => gallery,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn shapes_are_a_sheet_and_pictures_if_asked_for() {
        let shapes = |arguments: &[&str]| match work(arguments) {
            Work::Shapes(shapes) => shapes,
            other => panic!("{other:?}"),
        };
        let bare = shapes(&["shapes"]);
        assert_eq!((bare.sheet, bare.each, bare.size), ("gallery/shapes.png".into(), None, 512));
        let told = shapes(&["shapes", "--each", "here", "--out", "all.png", "--threads", "3", "--size", "64"]);
        assert_eq!((told.sheet, told.each), ("all.png".into(), Some("here".into())));
        assert_eq!((told.size, told.threads), (64, Some(3)));
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
