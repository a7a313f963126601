//! Everything that is known of the boards in a folder: their images and what they printed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};

use crate::attribution::{self, Rooms};
use crate::guards::{self, CONTROL, MEASURED};
use crate::image::Image;
use crate::ledger::{Key, Rows};
use crate::operations;
use crate::records::{self, Records};

/// The boards there are, in the order of the tables.
pub(crate) const BOARDS: [&str; 5] = ["cortex-m4f", "cortex-m3", "cortex-m0", "riscv32imac", "riscv32imafc"];

/// The board whose code is told by source file.
pub(crate) const BY_SOURCE: &str = "cortex-m4f";

/// The board whose cycles are estimated.
pub(crate) const ESTIMATED: &str = "cortex-m4f";

/// The images whose code is told by source file.
pub(crate) const IMAGES_BY_SOURCE: [&str; 2] = ["spheres", "everything"];

/// What was measured.
#[derive(Default)]
pub(crate) struct Measured {
    /// Of [`BOARDS`], those that have a folder.
    pub(crate) boards: BTreeSet<String>,
    pub(crate) rows: Rows,
    /// What each image printed, by board and the image's name.
    pub(crate) printed: BTreeMap<(String, String), Records>,
    /// What the images must not hold but do, or the guards fail to see.
    pub(crate) failures: Vec<String>,
    /// The compiler of the images.
    pub(crate) compiler: Option<String>,
}

/// Measures the boards in `root`: `<board>/<image>.elf`, and `<board>/<image>.txt` for what was printed.
pub(crate) fn measure(root: &Path) -> Result<Measured> {
    let mut measured = Measured::default();
    for board in BOARDS {
        let folder = root.join(board);
        if folder.is_dir() {
            images(&mut measured, board, &folder)?;
            printed(&mut measured, board, &folder)?;
            measured.boards.insert(board.to_owned());
        }
    }
    if measured.boards.contains(ESTIMATED) {
        measured.rows.extend(operations::rows(ESTIMATED)?);
    }
    let known = BOARDS.join(", ");
    ensure!(
        !measured.boards.is_empty(),
        "{}: no folder of a board there, none of {known}",
        root.display()
    );
    Ok(measured)
}

fn images(measured: &mut Measured, board: &str, folder: &Path) -> Result<()> {
    let read = |name: &str| Image::read(&folder.join(format!("{name}.elf")));
    let control = read(CONTROL)?;
    measured.failures.extend(guards::broken(&control));
    let mut by_source: BTreeMap<&str, Rooms> = BTreeMap::new();
    let mut runtime = 0;
    for name in MEASURED {
        let image = read(name)?;
        measured.failures.extend(guards::forbidden_in(&image));
        // The first is the run-time alone, which the others are measured against.
        let beyond = if name == MEASURED[0] {
            image.flash
        } else {
            image.flash.saturating_sub(runtime)
        };
        if name == MEASURED[0] {
            runtime = image.flash;
        }
        for (kind, bytes) in [("flash", beyond), ("ram", image.ram)] {
            let key = Key {
                board: board.to_owned(),
                item: format!("{kind}/{name}"),
                unit: "bytes".to_owned(),
            };
            measured.rows.insert(key, bytes as f64);
        }
        if IMAGES_BY_SOURCE.contains(&name) {
            let rooms = attribution::rooms(&image)?;
            if board == BY_SOURCE {
                let constants = ("constants and vectors".to_owned(), image.flash - image.code);
                for (room, bytes) in rooms.clone().into_iter().chain([constants]) {
                    let item = format!("source/{name}/{room}");
                    measured.rows.insert(
                        Key {
                            board: board.to_owned(),
                            item,
                            unit: "bytes".to_owned(),
                        },
                        bytes as f64,
                    );
                }
            }
            by_source.insert(name, rooms);
        }
        measured.compiler = measured.compiler.take().or(image.compiler);
    }
    measured.failures.extend(guards::leaves_beside_spheres(
        board,
        &by_source["spheres"],
        &by_source["everything"],
    ));
    Ok(())
}

fn printed(measured: &mut Measured, board: &str, folder: &Path) -> Result<()> {
    let entries = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
    let paths: Vec<PathBuf> = entries.map(|entry| Ok(entry?.path())).collect::<Result<_>>()?;
    for path in paths
        .iter()
        .filter(|path| path.extension().is_some_and(|extension| extension == "txt"))
    {
        let image = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let bytes = fs::read(path).with_context(|| path.display().to_string())?;
        let records = records::parse(board, &path.display().to_string(), &String::from_utf8_lossy(&bytes))?;
        // A build without optimisation has no costs worth knowing.
        if !image.ends_with("-debug") {
            for (key, figure) in &records.rows {
                let twice = measured.rows.insert(key.clone(), *figure);
                ensure!(twice.is_none(), "{}: {} is printed by two images", path.display(), key.item);
            }
        }
        measured.printed.insert((board.to_owned(), image), records);
    }
    Ok(())
}
