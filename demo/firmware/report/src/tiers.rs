//! What each tier costs, and how far off its answers are: two tables, and a guard that all boards find the same.

use std::collections::BTreeMap;

use crate::ledger::{Key, Rows};
use crate::measure::BOARDS;
use crate::tables::{Figures, cell, head};

use gsdf_workload::tiers::{AWAY, SIDE, TIERS};

/// What the names of the items begin with.
const PREFIX: &str = "tier/";

/// The units of the table of accuracy, and what its columns are called. None depends on the board.
const ACCURACY: [(&str, &str); 3] = [
    ("wrong", "rays wrong"),
    ("ulps", "largest error, ulps"),
    ("doubtful", "rays in doubt"),
];

/// The instructions of each tier of each picture, by board.
pub(crate) fn costs(figures: &Figures<'_>) -> Vec<Vec<String>> {
    figures.of_items(PREFIX, in_order(figures, "instructions"))
}

/// What is under the table of costs.
pub(crate) fn costs_note() -> String {
    let rays = SIDE * SIDE;
    format!(
        "Instructions of a ray, distance, normal and leaf: means over {rays} rays of a picture, in a leaf type of the scene's own\n\
         solids. `fast`: textbook formulas, spans of `Plain<f32>`; `robust`: spans of `f32`; `f64`: spans of `f64`, in software\n\
         on all of these boards; `certified`: `cast_certified`, which bounds every error in `f32`, looks again in `f64` where\n\
         these bounds leave a doubt, and takes the distance to the leaf that is hit from `f64`; `s2-far`: s2 from {AWAY} times as\n\
         far; `-fpu`: as above. On a Cortex-M0 neither `f64` nor `certified` is affordable but for single readings: at 16 MHz a\n\
         ray at s2 takes 6 ms in `f64` and 12 ms certified, if no instruction takes more than a cycle."
    )
}

/// How far off each tier is of each picture.
pub(crate) fn accuracy(figures: &Figures<'_>) -> Vec<Vec<String>> {
    let mut table = vec![head(&ACCURACY.map(|(_, title)| title))];
    for item in in_order(figures, "wrong") {
        let of = |(unit, _)| BOARDS.iter().find_map(|board| figures.get(board, item, unit));
        let cells = ACCURACY.into_iter().map(of).map(cell);
        table.push([item[PREFIX.len()..].to_owned()].into_iter().chain(cells).collect());
    }
    table
}

/// What is under the table of accuracy.
pub(crate) fn accuracy_note() -> String {
    let rays = SIDE * SIDE;
    format!(
        "Of the {rays} rays, held against spans of `f64` by the boards themselves, which all find the same. Wrong: a hit instead\n\
         of a miss, a miss instead of a hit, or another leaf. The error is that of the distances of the others, of which half\n\
         an ulp is what rounding to `f32` takes. In doubt: not settled by `f32` with its bounds."
    )
}

/// Where boards disagree about accuracy, which the same bits cannot: each a sentence.
pub(crate) fn disagreements(rows: &Rows) -> Vec<String> {
    let mut first: BTreeMap<(&str, &str), (&str, f64)> = BTreeMap::new();
    let mut failures = Vec::new();
    let accuracies = rows.iter().filter(|(key, _)| ACCURACY.iter().any(|(unit, _)| *unit == key.unit));
    for (Key { board, item, unit }, figure) in accuracies {
        let (other, known) = *first.entry((item, unit)).or_insert((board, *figure));
        if known != *figure {
            failures.push(format!("{board}, {item}: {figure} {unit}, but {known} on {other}"));
        }
    }
    failures
}

/// The items of this unit, by picture, then from fast to accurate, with an FPU's root after without.
fn in_order<'a>(figures: &Figures<'a>, unit: &str) -> Vec<&'a str> {
    let mut items: Vec<&str> = figures.items(PREFIX, unit).into_iter().collect();
    items.sort_by_key(|item| {
        let (picture, tier) = item.rsplit_once('/').unwrap_or((item, ""));
        let place = TIERS.iter().position(|name| tier.split('-').next() == Some(name));
        (picture, place, tier)
    });
    items
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(rows: &[(&str, &str, &str, f64)]) -> Rows {
        let key = |(board, item, unit): (&str, &str, &str)| Key {
            board: board.into(),
            item: item.into(),
            unit: unit.into(),
        };
        rows.iter()
            .map(|&(board, item, unit, figure)| (key((board, item, unit)), figure))
            .collect()
    }

    #[test]
    fn tiers_stand_from_fast_to_accurate() {
        let names = [
            "s1/certified",
            "s1/f64",
            "s1/fast",
            "s1/fast-fpu",
            "s1/robust",
            "s2-far/robust",
            "s2/fast",
        ];
        let items = names.map(|name| format!("{PREFIX}{name}"));
        let rows = rows(&items.each_ref().map(|item| ("cortex-m3", item.as_str(), "instructions", 7.0)));
        let first: Vec<_> = costs(&Figures(&rows)).iter().map(|row| row[0].clone()).collect();
        let expected = [
            "",
            "s1/fast",
            "s1/fast-fpu",
            "s1/robust",
            "s1/f64",
            "s1/certified",
            "s2/fast",
            "s2-far/robust",
        ];
        assert_eq!(first, expected);
    }

    #[test]
    fn accuracy_is_of_whichever_board_has_it() {
        let rows = rows(&[
            ("cortex-m0", "tier/s1/fast", "wrong", 0.0),
            ("cortex-m0", "tier/s1/fast", "ulps", 12.5),
        ]);
        assert_eq!(accuracy(&Figures(&rows))[1], ["s1/fast", "0", "12.5", "-"]);
    }

    #[test]
    fn boards_that_disagree_about_accuracy_fail() {
        let same = [
            ("cortex-m0", "tier/s1/fast", "ulps", 1.5),
            ("cortex-m3", "tier/s1/fast", "ulps", 1.5),
        ];
        assert!(disagreements(&rows(&same)).is_empty());
        let mut other = same;
        other[1].3 = 1.4;
        assert_eq!(
            disagreements(&rows(&other)),
            ["cortex-m3, tier/s1/fast: 1.4 ulps, but 1.5 on cortex-m0"]
        );
        other[1].2 = "instructions";
        assert!(disagreements(&rows(&other)).is_empty());
    }
}
