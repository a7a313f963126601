//! The table of accuracy is whole, and nothing is less accurate than it allows.

use gsdf_tests::accuracy::record::Record;
use gsdf_tests::accuracy::table::{allowed, floors, strays, verdict, write_bounds};
use gsdf_tests::accuracy::{Arithmetic, Backward, Cell, Corpus, PART, Reference, chart};
use gsdf_tests::shape::KINDS;
use std::fs;
use std::path::Path;

#[test]
fn every_cell_has_its_rows_and_no_row_is_without_a_cell() {
    assert_eq!(strays(), Vec::<String>::new());
    for cell in Cell::all() {
        for arithmetic in cell.arithmetics() {
            let name = (KINDS[cell.leaf], cell.corpus.name(), arithmetic.name());
            assert!(allowed(cell, arithmetic).is_some(), "no row for {name:?}");
        }
    }
    // What has no rays says why.
    let missing = |leaf: usize| Corpus::ALL.iter().filter(move |corpus| corpus.missing(leaf).is_some()).count();
    assert_eq!(
        Cell::all().count() + (0..KINDS.len()).map(missing).sum::<usize>(),
        KINDS.len() * Corpus::ALL.len()
    );
}

/// The bounds are what `accuracy --record tests/accuracy.csv --bounds tests/accuracy-bounds.csv` makes of the record.
#[test]
fn the_bounds_follow_from_the_record() {
    let file = |name: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    let mut bounds = Vec::new();
    write_bounds(&Record::read(&file("accuracy.csv")).unwrap(), &mut bounds).unwrap();
    let committed = fs::read(file("accuracy-bounds.csv")).unwrap();
    assert!(bounds == committed, "the committed bounds are not those of the committed record");
}

#[test]
fn nothing_is_less_accurate_than_the_table_allows() {
    let mut breaches = Vec::new();
    let (mut rays, mut asked) = (0, 0);
    for cell in Cell::all() {
        let measured = cell.measure(0..PART, floors(cell));
        rays += PART;
        asked += measured.asked;
        breaches.extend(verdict(cell, &Record::of(cell, &measured)));
    }
    println!("{rays} rays, {asked} of them for the exact reference");
    assert!(rays >= 10_000_000, "{rays}");
    assert!(breaches.is_empty(), "{} breaches:\n{}", breaches.len(), breaches.join("\n"));
}

/// How many rounding errors the numbers may be off for an answer to be right that no forward bound holds.
const EXPLAINED: f64 = 8.0;

/// A hit or miss that is wrong, and a crossing that rounding can make any other, is right for numbers that are off by
/// rounding errors: none is wrong for another reason.
#[test]
fn what_is_wrong_is_so_by_rounding_alone() {
    let mut all = [Backward::default(); 2];
    for cell in Cell::all() {
        for (all, arithmetic) in all.iter_mut().zip([Arithmetic::Robust, Arithmetic::Double]) {
            let found = cell.backward(0..2048, arithmetic);
            let (name, corpus) = (KINDS[cell.leaf], cell.corpus.name());
            if found.roundings.error > EXPLAINED / 2.0 {
                println!("{name} {corpus} {}: {found:?}", arithmetic.name());
            }
            *all = all.joined(found);
        }
    }
    println!("{all:?}");
    assert!(
        all[0].rays > 50_000 && all.iter().all(|found| found.roundings.error <= EXPLAINED),
        "{all:?}"
    );
}

/// Wherever double-double arithmetic answers, it gives the exact answer, within the bound that comes with it.
#[test]
fn the_fast_reference_is_the_exact_one() {
    let (mut answers, mut rays) = (0_u32, 0_u32);
    for cell in Cell::all() {
        for ray in 0..200 {
            // A target for every few rays: the exact answer takes longer than a new solid.
            let trial = cell.trial(ray * 67);
            let reference = Reference::new(trial.solid);
            let exact = reference.slow(trial.origin, trial.direction);
            rays += 1;
            let Some(swift) = reference.swift(trial.origin, trial.direction) else {
                continue;
            };
            answers += 1;
            assert_eq!(swift.is_some(), exact.is_some(), "{trial:?}");
            let Some((swift, exact)) = swift.zip(exact) else { continue };
            let ends = if trial.solid.shape.is_facet() { 1 } else { 2 };
            for (swift, exact) in swift.into_iter().zip(exact).take(ends) {
                assert_eq!(swift.is_some(), exact.is_some(), "{trial:?}");
                let Some((swift, exact)) = swift.zip(exact) else { continue };
                // What is exact is written in two words too: the rest is less than the second one's last place.
                let off = (swift - exact).to_f64().abs();
                let allowed = swift.error() + exact.error() + exact.to_f64().abs() * 1e-31 + 1e-36 * reference_scale(&trial);
                assert!(off <= allowed, "off by {off:e}, not {allowed:e}: {trial:?}");
            }
        }
    }
    println!("{answers} of {rays} rays answered");
    assert!(answers * 10 > rays * 8, "{answers} of {rays}");
}

/// A facet of the exact reference is a little thick, by a share of this.
fn reference_scale(trial: &gsdf_tests::accuracy::Trial) -> f64 {
    let speed = trial.direction.as_dvec3().length();
    if trial.solid.shape.is_facet() {
        1e5 * trial.solid.shape.extent() / speed
    } else {
        0.0
    }
}

/// The chart in the library's documentation is the one this source draws: `accuracy --chart
/// gsdf-nostd/docs/accuracy.svg` draws it.
#[test]
fn the_chart_is_that_of_today() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../gsdf-nostd/docs/accuracy");
    let svg = chart::svg().unwrap();
    assert!(fs::read_to_string(format!("{path}.svg")).unwrap() == svg, "not the chart of today");
    assert_eq!(fs::read_to_string(format!("{path}.md")).unwrap(), chart::markdown(&svg));
}
