//! The rows that every target computes, held against their committed hashes.

use gsdf_nostd::{Lane, Span};
use gsdf_workload::bits::{self, Row};

use crate::board::println;

/// Whether there is flash and memory for [`bits::LARGE`].
const ROOMY: bool = cfg!(roomy);

/// The scratch memory for whatever is computed here; the large rows take the most by far.
const SPANS: usize = if ROOMY {
    bits::LARGE_SPANS
} else {
    larger(bits::SMALL_SPANS, bits::MEDIUM_SPANS)
};

const fn larger(a: usize, b: usize) -> usize {
    if a > b { a } else { b }
}

/// Computes the rows that the board has memory for, in an arithmetic that must have the bits of `f32`, and prints a
/// record for each; whether all came out as they must.
pub fn all_are_right<T: Lane>() -> bool {
    let mut scratch = [Span::empty_like(T::from(0.0)); SPANS];
    let mut right = are_right(&Row::small(), &mut scratch);
    right &= are_right(&Row::medium(), &mut scratch);
    if ROOMY {
        right &= are_right(&Row::large(), &mut scratch);
    }
    right
}

fn are_right<T: Lane>(rows: &[Row<T>], scratch: &mut [Span<T>]) -> bool {
    let mut right = true;
    for row in rows {
        match row.compute(scratch) {
            Ok(hash) => {
                let verdict = if hash == row.golden { "ok" } else { "BAD" };
                println!("bits {} {hash:016x} {verdict}", row.name);
                right &= hash == row.golden;
            }
            Err(error) => {
                println!("{}: {error}", row.name);
                right = false;
            }
        }
    }
    right
}
