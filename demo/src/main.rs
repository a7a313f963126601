//! `gsdf`: renders the gallery.

use clap::builder::PossibleValuesParser;
use clap::{Args, Parser, Subcommand, value_parser};
use gsdf_demo::gallery::Gallery;
use gsdf_demo::scenes;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;

/// Pictures of CSG solids, ray-cast in closed form.
///
/// Without a command it renders the gallery.
#[derive(Debug, Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
struct CommandLine {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    gallery: GalleryArguments,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Render scenes to PNG files, with a table of what each took
    Gallery(GalleryArguments),
}

#[derive(Args, Debug)]
struct GalleryArguments {
    /// Pixels along each side of a picture
    #[arg(long, value_name = "N", default_value_t = 512, value_parser = value_parser!(u32).range(1..=8192))]
    size: u32,
    /// Directory of the pictures, made if need be
    #[arg(long, value_name = "DIR", default_value = "gallery")]
    out: PathBuf,
    /// Scenes to render [default: all]
    #[arg(long, value_name = "NAME", num_args = 1.., value_parser = PossibleValuesParser::new(scenes::names()))]
    scene: Vec<String>,
    /// Threads to render on [default: one per core]
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl From<GalleryArguments> for Gallery {
    fn from(arguments: GalleryArguments) -> Self {
        Self {
            scenes: arguments.scene,
            size: arguments.size,
            directory: arguments.out,
            threads: arguments.threads.map(usize::from),
        }
    }
}

fn main() -> ExitCode {
    let line = CommandLine::parse();
    let gallery = match line.command {
        Some(Command::Gallery(arguments)) => arguments,
        None => line.gallery,
    };
    match Gallery::from(gallery).render() {
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
    use super::{Command, CommandLine};
    use clap::{CommandFactory, Parser};
    use gsdf_demo::scenes;

    #[test]
    fn the_command_line_is_sound() {
        CommandLine::command().debug_assert();
    }

    #[test]
    fn the_gallery_is_what_is_meant_without_a_command() {
        let bare = CommandLine::parse_from(["gsdf", "--size", "7"]);
        assert!(bare.command.is_none());
        assert_eq!((bare.gallery.size, bare.gallery.scene.len()), (7, 0));
        let line = CommandLine::parse_from(["gsdf", "gallery", "--scene", "s1", "hollow"]);
        assert!(matches!(line.command, Some(Command::Gallery(arguments)) if arguments.scene == ["s1", "hollow"] && arguments.size == 512));
    }

    #[test]
    fn bad_values_are_refused_and_good_ones_named() {
        let refusal = |arguments: [&str; 2]| {
            let error = CommandLine::try_parse_from(["gsdf"].into_iter().chain(arguments)).expect_err("a bad value");
            assert_eq!(error.exit_code(), 2);
            error.to_string()
        };
        for size in ["0", "8193", "-1", "many"] {
            assert!(refusal(["--size", size]).contains(size));
        }
        assert!(refusal(["--threads", "0"]).contains("1..=1024"));
        let message = refusal(["--scene", "s9"]);
        assert!(scenes::names().iter().all(|name| message.contains(name)), "{message}");
    }
}
