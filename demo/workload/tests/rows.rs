//! The rows, computed ray by ray on the host, have the committed hashes: run it with any profile.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gsdf_nostd::{ProgramError, Span};
use gsdf_workload::bits::{LARGE, LARGE_SPANS, MEDIUM, MEDIUM_SPANS, Row, SMALL, SMALL_SPANS};
use std::collections::BTreeSet;

fn rows() -> impl Iterator<Item = &'static Row> {
    SMALL.iter().chain(&MEDIUM).chain(&LARGE)
}

fn check(rows: &[Row], spans: usize) {
    let mut scratch = vec![Span::EMPTY; spans];
    for row in rows {
        let (found, golden) = (row.compute(&mut scratch).unwrap(), row.golden);
        assert_eq!(found, golden, "{}: {found:#018x}, not {golden:#018x}", row.name);
    }
}

#[test]
fn small_rows_are_golden() {
    check(&SMALL, SMALL_SPANS);
}

#[test]
fn medium_rows_are_golden() {
    check(&MEDIUM, MEDIUM_SPANS);
}

#[test]
fn large_rows_are_golden() {
    check(&LARGE, LARGE_SPANS);
}

#[test]
fn names_and_hashes_are_all_different() {
    assert_eq!(rows().map(|row| row.name).collect::<BTreeSet<_>>().len(), rows().count());
    assert_eq!(rows().map(|row| row.golden).collect::<BTreeSet<_>>().len(), rows().count());
}

/// What was in the scratch memory before does not matter, nor that there is more of it.
#[test]
fn scratch_need_not_be_clean() {
    let dirty = Span {
        enter: f32::NEG_INFINITY,
        exit: f32::INFINITY,
    };
    for row in &SMALL {
        assert_eq!(row.compute(&mut vec![dirty; row.spans + 3]), Ok(row.golden), "{}", row.name);
    }
}

#[test]
fn scratch_that_is_too_short_is_refused() {
    for row in rows() {
        for length in [0, row.spans - 1] {
            let refused = row.compute(&mut vec![Span::EMPTY; length]);
            assert!(
                matches!(refused, Err(ProgramError::ScratchTooShort(found, _)) if found == length),
                "{} in {length} spans: {refused:?}",
                row.name
            );
        }
    }
}
