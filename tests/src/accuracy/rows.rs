//! The rows of the table.

/// A kind of leaf, a corpus and an arithmetic, and what is allowed: the share of wrong rays, p99 and most ulp, and the
/// error in units roundoff of the condition.
pub(super) type Row = (&'static str, &'static str, &'static str, [f64; 4]);

pub(super) const ROWS: &[Row] = &[
];
