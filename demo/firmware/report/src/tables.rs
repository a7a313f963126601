//! The figures as tables that a person reads, in Markdown whose columns are aligned as plain text, too.

use std::collections::{BTreeMap, BTreeSet};

use crate::guards::MEASURED;
use crate::ledger::{Key, Ledger, Rows};
use crate::measure::{BOARDS, BY_SOURCE, ESTIMATED, IMAGES_BY_SOURCE};
use crate::tiers;

/// What a division or a square root in hardware takes on a Cortex-M4F, beyond the one cycle of an instruction: VDIV.F32
/// and VSQRT.F32 take 14 cycles. Source: Arm, Cortex-M4 Processor Technical Reference Manual, FPU instruction set.
const SLOW: f64 = 13.0;

/// Everything in `ledger`.
pub(crate) fn render(ledger: &Ledger) -> String {
    let figures = Figures(&ledger.rows);
    let mut text = format!(
        "# What it costs on a microcontroller\n\nWritten by `demo/firmware/run --record` from `costs.csv`, with {}.\n",
        ledger.origin
    );
    let mut add = |title: &str, note: &str, table: Vec<Vec<String>>| {
        if table.len() > 1 {
            text += &format!("\n## {title}\n\n{note}\n\n{}", align(&table));
        }
    };
    add(
        "Instructions per distance",
        "Of one leaf, means over 64 queries. `gsdf`: along a ray, the checks of the ray included; some hit, some miss;\n\
         `sdf`: to the nearest surface, as sphere tracing asks at every step; `-fpu`: with the square root of the FPU.",
        figures.by_board("leaf/"),
    );
    add(
        "Instructions per ray",
        "Means over 64 rays of a picture. `closed`: distance, normal and leaf in closed form; `traced`: the distance by sphere\n\
         tracing the same rays, to 1e-4 or for 128 steps, and no farther than the scene reaches; `-fpu`: as above.",
        figures.by_board("scene/"),
    );
    add(
        "Sphere tracing against closed form",
        "How many times the instructions of the closed form it takes.",
        figures.ratios(),
    );
    add("Tiers", &tiers::costs_note(), tiers::costs(&figures));
    add("How far off the tiers are", &tiers::accuracy_note(), tiers::accuracy(&figures));
    add(
        "Cycles on a Cortex-M4F: an estimate",
        "Not measured: the instructions, and 13 more for each division and for each square root in hardware, which take 14\n\
         cycles. It leaves out wait states of the flash, branches taken, and loads. Divisions are counted as written: of the\n\
         four that a ray's direction takes the compiler drops what no leaf of the scene uses (all but one for a half-space).",
        figures.cycles(),
    );
    add(
        "Pay for what you use: bytes per image",
        "`flash`: code, constants and initial values, of `baseline` all, of the others beyond `baseline`; `ram`: variables,\n\
         without the stack; `stack`: the deepest it was, measured by painting it. `spheres`, `everything` and `distance` ask\n\
         about the same ray and four balls: `spheres` for distance, normal and leaf with a leaf type of spheres,\n\
         `everything` with that of all solids, `distance` for the distance alone, with the square root of the FPU.",
        figures.images(),
    );
    add(
        "Bytes of flash by source file on a Cortex-M4F",
        "Each byte of code counts for the source file of the innermost function that was inlined there, so arithmetic is\n\
         found under `real.rs` and `core`. With the start-up code.",
        figures.sources(),
    );
    text
}

/// The first row is the head. Columns of figures, which are all but the first, are flush right.
pub(crate) fn align(table: &[Vec<String>]) -> String {
    let width = |column: usize| {
        table
            .iter()
            .filter_map(|row| row.get(column))
            .map(|cell| cell.chars().count())
            .max()
    };
    let widths: Vec<usize> = (0..table[0].len()).map(|column| width(column).unwrap_or(0).max(2)).collect();
    let mut text = String::new();
    for (index, row) in table.iter().enumerate() {
        for (column, (cell, width)) in row.iter().zip(&widths).enumerate() {
            text += &if column == 0 {
                format!("| {cell:width$} |")
            } else {
                format!(" {cell:>width$} |")
            };
        }
        text.push('\n');
        if index == 0 {
            for (column, width) in widths.iter().enumerate() {
                text += &if column == 0 {
                    format!("|{}|", "-".repeat(width + 2))
                } else {
                    format!("{}:|", "-".repeat(width + 1))
                };
            }
            text.push('\n');
        }
    }
    text
}

/// All figures, to be looked up.
pub(crate) struct Figures<'a>(pub(crate) &'a Rows);

impl<'a> Figures<'a> {
    pub(crate) fn get(&self, board: &str, item: &str, unit: &str) -> Option<f64> {
        self.0
            .get(&Key {
                board: board.to_owned(),
                item: item.to_owned(),
                unit: unit.to_owned(),
            })
            .copied()
    }

    /// The items of this unit on any board whose names start so.
    pub(crate) fn items(&self, prefix: &str, unit: &str) -> BTreeSet<&'a str> {
        self.0
            .keys()
            .filter(|key| key.unit == unit && key.item.starts_with(prefix))
            .map(|key| key.item.as_str())
            .collect()
    }

    fn by_board(&self, prefix: &str) -> Vec<Vec<String>> {
        self.of_items(prefix, self.items(prefix, "instructions"))
    }

    /// The instructions of these items, whose names start so, on each board.
    pub(crate) fn of_items<'i>(&self, prefix: &str, items: impl IntoIterator<Item = &'i str>) -> Vec<Vec<String>> {
        let mut table = vec![head(&BOARDS)];
        for item in items {
            let figures = BOARDS.iter().map(|board| cell(self.get(board, item, "instructions")));
            table.push([item[prefix.len()..].to_owned()].into_iter().chain(figures).collect());
        }
        table
    }

    fn ratios(&self) -> Vec<Vec<String>> {
        let mut table = vec![head(&BOARDS)];
        for traced in self.items("scene/", "instructions") {
            // With or without the processor's own square root, but the same for both.
            let closed = traced.replace("/traced", "/closed");
            if closed == traced {
                continue;
            }
            let ratio = |board: &&str| {
                let of = |item: &str| self.get(board, item, "instructions");
                cell(
                    of(traced)
                        .zip(of(&closed))
                        .map(|(traced, closed)| traced / closed)
                        .filter(|ratio| ratio.is_finite()),
                )
            };
            table.push(
                [traced["scene/".len()..].to_owned()]
                    .into_iter()
                    .chain(BOARDS.iter().map(ratio))
                    .collect(),
            );
        }
        table
    }

    fn cycles(&self) -> Vec<Vec<String>> {
        let mut table = vec![head(&["instructions", "divisions", "roots in hardware", "cycles, estimated"])];
        for key in self.0.keys().filter(|key| key.board == ESTIMATED && key.unit == "instructions") {
            // The same divisions are done and the same roots are taken, whoever takes them.
            let plain = key.item.strip_suffix("-fpu").unwrap_or(&key.item);
            let of = |unit: &str| self.get(ESTIMATED, &key.item, unit).or_else(|| self.get(ESTIMATED, plain, unit));
            let (Some(divisions), Some(roots)) = (of("divisions"), of("roots")) else {
                continue;
            };
            let instructions = self.0[key];
            let in_hardware = if plain == key.item { 0.0 } else { roots };
            let cycles = instructions + SLOW * (divisions + in_hardware);
            let figures = [instructions, divisions, in_hardware, cycles].map(|figure| cell(Some(figure)));
            table.push([key.item.clone()].into_iter().chain(figures).collect());
        }
        table
    }

    fn images(&self) -> Vec<Vec<String>> {
        let mut table = vec![head(&BOARDS)];
        let stacks = self.items("stack/", "bytes");
        let stacks = stacks.iter().map(|item| (*item).to_owned());
        let sizes = ["flash", "ram"]
            .iter()
            .flat_map(|kind| MEASURED.iter().map(move |image| format!("{kind}/{image}")));
        for item in sizes.chain(stacks) {
            let figures: Vec<_> = BOARDS.iter().map(|board| self.get(board, &item, "bytes")).collect();
            if figures.iter().any(Option::is_some) {
                table.push([item].into_iter().chain(figures.into_iter().map(cell)).collect());
            }
        }
        table
    }

    fn sources(&self) -> Vec<Vec<String>> {
        let mut rooms: BTreeMap<&str, [Option<f64>; 2]> = BTreeMap::new();
        for (column, image) in IMAGES_BY_SOURCE.iter().enumerate() {
            let prefix = format!("source/{image}/");
            for (key, figure) in self.0.iter().filter(|(key, _)| key.board == BY_SOURCE) {
                if let Some(room) = key.item.strip_prefix(&prefix) {
                    rooms.entry(room).or_default()[column] = Some(*figure);
                }
            }
        }
        let mut table = vec![head(&IMAGES_BY_SOURCE)];
        for (room, figures) in rooms {
            table.push([room.to_owned()].into_iter().chain(figures.map(cell)).collect());
        }
        table
    }
}

/// The first row of a table, whose first column has no title.
pub(crate) fn head(columns: &[&str]) -> Vec<String> {
    [""].iter().chain(columns).map(|&title| title.to_owned()).collect()
}

/// With one decimal where there is one.
pub(crate) fn cell(figure: Option<f64>) -> String {
    figure.map_or_else(|| "-".to_owned(), |figure| ((figure * 10.0).round() / 10.0).to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ledger(rows: &[(&str, &str, &str, f64)]) -> Ledger {
        let row = |&(board, item, unit, figure): &(&str, &str, &str, f64)| {
            (
                Key {
                    board: board.into(),
                    item: item.into(),
                    unit: unit.into(),
                },
                figure,
            )
        };
        Ledger {
            origin: "rustc 1".into(),
            rows: rows.iter().map(row).collect(),
        }
    }

    fn has(text: &str, cells: &[&str]) -> bool {
        text.lines()
            .any(|line| line.trim_matches('|').split('|').map(str::trim).eq(cells.iter().copied()))
    }

    #[test]
    fn what_is_absent_has_no_table() {
        assert!(!render(&ledger(&[])).contains("##"));
        assert!(!render(&ledger(&[("cortex-m4f", "leaf/a/gsdf", "instructions", 1.0)])).contains("estimate"));
    }

    #[test]
    fn the_ratio_is_traced_to_closed_form_with_the_same_root() {
        let text = render(&ledger(&[
            ("cortex-m3", "scene/s/closed", "instructions", 100.0),
            ("cortex-m3", "scene/s/traced", "instructions", 250.0),
            ("cortex-m3", "scene/s/closed-fpu", "instructions", 10.0),
            ("cortex-m3", "scene/s/traced-fpu", "instructions", 40.0),
        ]));
        assert!(has(&text, &["s/traced", "-", "2.5", "-", "-", "-"]), "{text}");
        assert!(has(&text, &["s/traced-fpu", "-", "4", "-", "-", "-"]), "{text}");
    }

    #[test]
    fn cycles_count_divisions_always_and_roots_in_hardware() {
        let text = render(&ledger(&[
            ("cortex-m4f", "leaf/a/gsdf", "instructions", 100.0),
            ("cortex-m4f", "leaf/a/gsdf-fpu", "instructions", 50.0),
            ("cortex-m4f", "leaf/a/gsdf", "divisions", 2.0),
            ("cortex-m4f", "leaf/a/gsdf", "roots", 1.0),
            ("cortex-m3", "leaf/a/gsdf", "instructions", 999.0),
        ]));
        assert!(has(&text, &["leaf/a/gsdf", "100", "2", "0", "126"]), "{text}");
        assert!(has(&text, &["leaf/a/gsdf-fpu", "50", "2", "1", "89"]), "{text}");
    }

    #[test]
    fn columns_are_aligned() {
        let row = |cells: [&str; 2]| cells.map(str::to_owned).to_vec();
        let text = align(&[row(["", "wide"]), row(["name", "1"])]);
        assert_eq!(text, "|      | wide |\n|------|-----:|\n| name |    1 |\n");
    }
}
