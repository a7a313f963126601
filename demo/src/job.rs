//! What a command line asks for, and doing it.

use crate::command_line::{Command, CommandLine, Options};
use crate::commands::Settings;
use crate::commands::bench::Bench;
use crate::commands::cast::Cast;
use crate::commands::export::Export;
use crate::commands::info::Info;
use crate::commands::render::Render;
use crate::commands::trade::Trade;
use crate::gallery::Gallery;
use crate::paper::command::Paper;
use crate::shapes::Shapes;
use clap::CommandFactory;
use clap::error::{Error, ErrorKind};
use gsdf_simd::Level;
use std::path::{Path, PathBuf};

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
    /// What it costs.
    Bench(Bench),
}

impl OfModel {
    /// What of the options it does not take: by name, and why.
    const fn ignored(&self) -> &'static [&'static str] {
        match self {
            Self::Info(_) => &["--scene", "--size", "--out", "--threads", "--level"],
            Self::Render(_) => &["--scene"],
            Self::Cast(_) => &["--scene", "--size"],
            Self::Export(_) => &["--scene", "--size", "--threads", "--level"],
            Self::Bench(_) => &["--scene", "--out", "--threads"],
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
            Self::Model(OfModel::Bench(bench), settings) => bench.run(settings),
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

impl TryFrom<CommandLine> for Job {
    type Error = Error;

    /// What no single option shows to be wrong.
    fn try_from(line: CommandLine) -> Result<Self, Error> {
        let options = line.options;
        match line.command.unwrap_or(Command::Gallery) {
            Command::Gallery => {
                let directory = options.out.clone().unwrap_or_else(|| DIRECTORY.into());
                // Some scenes alone are not the sheet of all.
                let sheet = options.scene.is_empty().then(|| directory.join(SHEET));
                gallery(options, Some(directory), sheet)
            }
            Command::Sheet => {
                let sheet = options.out.clone().unwrap_or_else(|| in_gallery(SHEET));
                gallery(options, None, Some(sheet))
            }
            Command::Shapes { each } => shapes(options, each),
            Command::Paper => paper(options),
            Command::Trade(trade) => {
                options.refuse(&["--scene", "--size", "--out", "--threads"])?;
                Ok(Self::Trade(trade, options.level()?))
            }
            Command::Info(info) => of_model(OfModel::Info(info), options),
            Command::Render(render) => of_model(OfModel::Render(render), options),
            Command::Cast(cast) => of_model(OfModel::Cast(cast), options),
            Command::Export(export) => of_model(OfModel::Export(export), options),
            Command::Bench(bench) => of_model(OfModel::Bench(bench), options),
        }
    }
}

fn in_gallery(name: &str) -> PathBuf {
    Path::new(DIRECTORY).join(name)
}

fn gallery(options: Options, directory: Option<PathBuf>, sheet: Option<PathBuf>) -> Result<Job, Error> {
    Ok(Job::Gallery(Gallery {
        size: options.square()?.unwrap_or(512),
        threads: options.threads(),
        level: options.level()?,
        scenes: options.scene,
        directory,
        sheet,
    }))
}

fn shapes(options: Options, each: Option<PathBuf>) -> Result<Job, Error> {
    options.refuse(&["--scene"])?;
    Ok(Job::Shapes(Shapes {
        size: options.square()?.unwrap_or(512),
        threads: options.threads(),
        level: options.level()?,
        sheet: options.out.unwrap_or_else(|| in_gallery(SHAPES)),
        each,
    }))
}

fn paper(options: Options) -> Result<Job, Error> {
    // It has shapes of its own, and casts their rays one by one.
    options.refuse(&["--scene", "--level"])?;
    let size = options.square()?.unwrap_or(256);
    if !Paper::SIZES.contains(&size) {
        let (least, most) = (Paper::SIZES.start(), Paper::SIZES.end());
        let message = format!("the paper's sheet takes a --size from {least} to {most}");
        return Err(CommandLine::command().error(ErrorKind::ValueValidation, message));
    }
    Ok(Job::Paper(Paper {
        size,
        threads: options.threads(),
        sheet: options.out.unwrap_or_else(|| in_gallery(PAPER)),
    }))
}

fn of_model(asked: OfModel, options: Options) -> Result<Job, Error> {
    options.refuse(asked.ignored())?;
    let settings = Settings {
        size: options.size,
        threads: options.threads(),
        level: options.level()?,
        out: options.out,
    };
    Ok(Job::Model(asked, settings))
}

#[cfg(test)]
mod tests {
    use super::{Job, OfModel};
    use crate::command_line::{CommandLine, in_one_line};
    use crate::commands::size::Size;
    use crate::gallery::Gallery;
    use crate::paper::command::Paper;
    use clap::Parser;
    use gsdf_simd::Level;

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
        assert!(matches!(job(&["bench", "a.csg"]), Ok(Job::Model(OfModel::Bench(bench), _)) if bench.rounds == 15 && !bench.json));
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
            (&["cast", "a", "--tier", "double"], "--tier"),
            (&["render", "a", "--tier", "best"], "--tier"),
            (&["bench"], "MODEL"),
            (&["bench", "a", "--rounds", "5"], "--rounds"),
            (&["bench", "a", "--size", "0"], "--size"),
            (&["bench", "a", "--out", "b"], "--out"),
            (&["bench", "a", "--threads", "2"], "--threads"),
            (&["bench", "a", "--scene", "s1"], "--scene"),
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
