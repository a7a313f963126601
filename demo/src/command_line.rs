//! The command line, and what it asks for.

use crate::commands::Settings;
use crate::commands::cast::Cast;
use crate::commands::export::Export;
use crate::commands::info::Info;
use crate::commands::render::Render;
use crate::commands::size::Size;
use crate::commands::trade::Trade;
use crate::gallery::Gallery;
use crate::paper::command::Paper;
use crate::scenes;
use crate::shapes::Shapes;
use clap::builder::PossibleValuesParser;
use clap::error::{Error, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand, value_parser};
use gsdf_simd::Level;
use std::path::{Path, PathBuf};

/// Pictures of CSG solids, ray-cast in closed form, and answers about them.
///
/// Without a command it renders the gallery.
#[derive(Debug, Parser)]
// A command ends the names after `--scene`.
#[command(name = "gsdf", version, subcommand_precedence_over_arg = true)]
pub struct CommandLine {
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
}

/// They may stand before the command or after it.
#[derive(Args, Debug)]
struct Options {
    /// Pixels along each side of a picture, N or, of a model, also `WxH`; on a sheet half of them [default: 512, paper: 256]
    #[arg(long, global = true, value_name = "N")]
    size: Option<Size>,
    /// Directory of the pictures, or file of the sheet, picture, answers or text [default: gallery, gallery/sheet.png,
    /// gallery/shapes.png, gallery/paper.png, the model's name, standard output]
    #[arg(long, global = true, value_name = "PATH")]
    out: Option<PathBuf>,
    /// Scenes to render [default: all]
    #[arg(long, global = true, value_name = "NAME", num_args = 1.., value_parser = PossibleValuesParser::new(scenes::names()))]
    scene: Vec<String>,
    /// Threads to work on [default: one per core]
    #[arg(long, global = true, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Vectors to cast primary rays in: portable, avx2 or avx512, as far as this machine has them [default: `GSDF_LEVEL`, or the widest]
    #[arg(long, global = true, value_name = "NAME")]
    level: Option<Level>,
}

impl Options {
    /// Refuses those of these options that are given.
    fn refuse(&self, names: &[&str]) -> Result<(), Error> {
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

    /// The pixels along each side of pictures that are squares.
    fn square(&self) -> Result<Option<u32>, Error> {
        let wrong = |size| {
            let message = format!("--size {size}: only pictures of models need not be squares");
            CommandLine::command().error(ErrorKind::ValueValidation, message)
        };
        self.size.map(|size| size.square().ok_or_else(|| wrong(size))).transpose()
    }

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
pub enum Job {
    /// Pictures of the gallery's scenes.
    Gallery(Gallery),
    /// Pictures of shapes.
    Shapes(Shapes),
    /// The readings of the paper.
    Paper(Paper),
    /// What accuracy costs, in vectors of a level.
    Trade(Trade, Level),
    /// Something of a model.
    Model(OfModel, Settings),
}

/// What is asked of a model.
pub enum OfModel {
    /// What it is made of.
    Info(Info),
    /// A picture.
    Render(Render),
    /// What rays cross.
    Cast(Cast),
    /// Source text.
    Export(Export),
}

impl OfModel {
    /// What of the options it does not take: by name, and why.
    const fn ignored(&self) -> &'static [&'static str] {
        match self {
            Self::Info(_) => &["--scene", "--size", "--out", "--threads", "--level"],
            Self::Render(_) => &["--scene"],
            Self::Cast(_) => &["--scene", "--size"],
            Self::Export(_) => &["--scene", "--size", "--threads", "--level"],
        }
    }
}

impl Job {
    /// Does it.
    ///
    /// # Errors
    /// Where it cannot be done.
    pub fn run(&self) -> anyhow::Result<()> {
        match self {
            Self::Gallery(gallery) => gallery.render(),
            Self::Shapes(shapes) => shapes.render(),
            Self::Paper(paper) => paper.run(),
            Self::Trade(trade, level) => trade.run(*level),
            Self::Model(OfModel::Info(info), _) => info.run(),
            Self::Model(OfModel::Render(render), settings) => render.run(settings),
            Self::Model(OfModel::Cast(cast), settings) => cast.run(settings),
            Self::Model(OfModel::Export(export), settings) => export.run(settings),
        }
    }

    /// The status with which the process ends where it cannot be done: 2 where that is in what was given, which is all
    /// that commands take which read a model.
    #[must_use]
    pub const fn status_of_failure(&self) -> u8 {
        match self {
            Self::Model(..) => 2,
            _ => 1,
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

impl TryFrom<CommandLine> for Job {
    type Error = Error;

    /// What no single option shows to be wrong.
    fn try_from(line: CommandLine) -> Result<Self, Error> {
        let options = line.options;
        let threads = options.threads.map(usize::from);
        let level = options.level();
        let in_gallery = |name| Path::new(DIRECTORY).join(name);
        let command = match line.command {
            Some(Command::Trade(trade)) => {
                options.refuse(&["--scene", "--size", "--out", "--threads"])?;
                return Ok(Self::Trade(trade, level?));
            }
            other => other,
        };
        let of_model = match command {
            Some(Command::Info(info)) => Ok(OfModel::Info(info)),
            Some(Command::Render(render)) => Ok(OfModel::Render(render)),
            Some(Command::Cast(cast)) => Ok(OfModel::Cast(cast)),
            Some(Command::Export(export)) => Ok(OfModel::Export(export)),
            other => Err(other),
        };
        let command = match of_model {
            Ok(of_model) => {
                options.refuse(of_model.ignored())?;
                let settings = Settings {
                    size: options.size,
                    level: level?,
                    out: options.out,
                    threads,
                };
                return Ok(Self::Model(of_model, settings));
            }
            Err(command) => command.unwrap_or(Command::Gallery),
        };
        let size = options.square()?;
        let refuse = |kind, message: &str| Err(CommandLine::command().error(kind, message));
        let (directory, sheet) = match command {
            Command::Sheet => (None, Some(options.out.unwrap_or_else(|| in_gallery(SHEET)))),
            Command::Shapes { each } => {
                if !options.scene.is_empty() {
                    return refuse(ErrorKind::ArgumentConflict, "shapes are no scenes: the command takes no --scene");
                }
                return Ok(Self::Shapes(Shapes {
                    size: size.unwrap_or(512),
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
                let size = size.unwrap_or(256);
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
            // The others are gone above.
            Command::Gallery | Command::Trade(_) | Command::Info(_) | Command::Render(_) | Command::Cast(_) | Command::Export(_) => {
                let directory = options.out.unwrap_or_else(|| DIRECTORY.into());
                // Some scenes alone are not the sheet of all.
                let sheet = options.scene.is_empty().then(|| directory.join(SHEET));
                (Some(directory), sheet)
            }
        };
        Ok(Self::Gallery(Gallery {
            scenes: options.scene,
            size: size.unwrap_or(512),
            directory,
            sheet,
            threads,
            level: level?,
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::{CommandLine, Job, OfModel, Paper, in_one_line};
    use crate::commands::size::Size;
    use crate::gallery::Gallery;
    use crate::scenes;
    use clap::{CommandFactory, Parser};
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

    #[test]
    fn models_have_commands_of_their_own() {
        let Ok(Job::Model(OfModel::Render(render), settings)) = job(&[
            "render",
            "a.csg",
            "--eye",
            "-1,2,3",
            "--size",
            "64x48",
            "--aov",
            "depth",
            "--samples",
            "4",
        ]) else {
            panic!("it is a picture of a model")
        };
        assert_eq!(render.model.path.to_str(), Some("a.csg"));
        assert_eq!(settings.size, Some(Size { width: 64, height: 48 }));
        assert!(matches!(job(&["info", "a.csg", "--json"]), Ok(Job::Model(OfModel::Info(info), _)) if info.json));
        assert!(matches!(job(&["cast", "a.csg", "--all"]), Ok(Job::Model(OfModel::Cast(cast), _)) if cast.all));
        assert!(matches!(job(&["export", "a.csg", "--rust"]), Ok(Job::Model(OfModel::Export(_), _))));
    }

    #[test]
    fn wrong_use_of_models_is_one_line_that_names_it() {
        for (arguments, named) in [
            (&["render"][..], "MODEL"),
            (&["render", "a", "--eye", "1,2"], "--eye"),
            (&["render", "a", "--samples", "5"], "--samples"),
            (&["render", "a", "--size", "3x"], "--size"),
            (&["render", "a", "--scene", "s1"], "--scene"),
            (&["info", "a", "--level", "portable"], "--level"),
            (&["cast", "a", "--size", "3"], "--size"),
            (&["export", "a"], "--rust"),
            (&["export", "a", "--rust", "--facets", "some"], "--facets"),
            (&["--size", "3x4"], "3 x 4"),
            (&["rendre", "a"], "rendre"),
        ] {
            let Err(error) = job(arguments) else {
                panic!("{arguments:?} is taken")
            };
            assert_eq!(error.exit_code(), 2);
            let line = in_one_line(&error).expect("it is no help");
            assert!(
                line.starts_with("error: ") && line.contains(named) && !line.contains('\n'),
                "{line}"
            );
        }
        let Err(help) = job(&["--help"]) else { panic!("help is no job") };
        assert_eq!(in_one_line(&help), None);
    }
}
