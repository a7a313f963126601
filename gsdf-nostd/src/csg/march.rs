//! The exact next crossing of a program: sweeps, each from a leaf root to a later one.

use super::node::Node;
use super::sweep::sweep;
use crate::real::{Mask, Real};
use crate::span::Span;

/// Where a march from some parameter ended.
#[derive(Clone, Copy, Debug)]
pub struct March<T: Real> {
    /// The first parameter beyond the start at which membership changes; infinite where it never does.
    pub t: T,
    /// Whether the ray is inside at the start.
    pub inside: T::Mask,
    /// How many sweeps it took, in the slowest lane.
    pub sweeps: u32,
}

/// Marches from `start >= 0` to the first crossing of the program's boundary, exactly.
///
/// Like sphere tracing it repeats `t <- |Φ(t)|`; but every step lands on a leaf root, none oversteps a boundary, and
/// it ends by the sign of `Φ` turning, not by an epsilon. The result is a leaf root bit for bit. At most one sweep
/// per distinct root ahead and one to confirm: `2 leaves + 1`.
///
/// Lanes in which nothing is asked may start at +inf: they are done at once.
#[inline(always)]
pub fn march<T: Real, L>(nodes: &[Node<L>], spans: &[Span<T>], start: T) -> March<T> {
    let zero = start.splat_like(0.0);
    let infinity = start.splat_like(f32::INFINITY);
    let first = sweep(nodes, spans, start);
    let inside = first.lt(zero);
    let mut t = first.abs();
    let mut sweeps = 1;
    let mut running = t.lt(infinity);
    while running.any() {
        let next = sweep(nodes, spans, t);
        sweeps += 1;
        running = running & !next.lt(zero).differs_from(inside);
        t = T::select(running, next.abs(), t);
        running = running & t.lt(infinity);
    }
    March { t, inside, sweeps }
}
