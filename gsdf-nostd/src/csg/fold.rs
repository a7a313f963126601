//! The one walk over a program that both readings share.

use super::check::MAX_DEPTH;
use super::node::Node;
use crate::real::Real;

/// What the operators of a program act on.
pub(super) trait Operand: Copy {
    fn union(self, other: Self) -> Self;
    fn intersection(self, other: Self) -> Self;
    fn complement(self) -> Self;
}

/// A signed number, negative inside: a distance, or a crossing along a ray.
#[derive(Clone, Copy)]
pub(super) struct Signed<T>(pub(super) T);

impl<T: Real> Operand for Signed<T> {
    #[inline(always)]
    fn union(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }
    #[inline(always)]
    fn intersection(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
    #[inline(always)]
    fn complement(self) -> Self {
        Self(-self.0)
    }
}

/// What each leaf contributes, in the order of the leaves. A trait and not a closure: closures are outlined from
/// functions compiled for a wider instruction set.
pub(super) trait Reading<L> {
    type Operand: Operand;
    fn leaf(&mut self, solid: &L, frame: u16) -> Self::Operand;
}

/// Evaluates a checked program; `filler` is any operand.
#[inline(always)]
pub(super) fn fold<L, R: Reading<L>>(nodes: &[Node<L>], filler: R::Operand, reading: &mut R) -> R::Operand {
    // Filling a deep stack takes longer than walking a small program, and it is most of what a cast takes of a small
    // processor's stack. A program of 15 nodes has at most 8 leaves.
    if nodes.len() < 16 {
        fold_within::<8, L, R>(nodes, filler, reading)
    } else {
        fold_within::<MAX_DEPTH, L, R>(nodes, filler, reading)
    }
}

/// Evaluates a program that never has more than `DEPTH` operands waiting.
///
/// Indices into the stack wrap there, so that no access needs a check and none can panic.
#[inline(always)]
fn fold_within<const DEPTH: usize, L, R: Reading<L>>(nodes: &[Node<L>], filler: R::Operand, reading: &mut R) -> R::Operand {
    const { assert!(DEPTH.is_power_of_two()) };
    let wrap = DEPTH - 1;
    let mut stack = [filler; DEPTH];
    let mut top = wrap;
    for node in nodes {
        let last = stack[top & wrap];
        let below = top.wrapping_sub(1) & wrap;
        match node {
            Node::Leaf { solid, frame } => {
                top = top.wrapping_add(1) & wrap;
                stack[top] = reading.leaf(solid, *frame);
            }
            Node::Union => {
                stack[below] = stack[below].union(last);
                top = below;
            }
            Node::Intersection => {
                stack[below] = stack[below].intersection(last);
                top = below;
            }
            Node::Difference => {
                stack[below] = stack[below].intersection(last.complement());
                top = below;
            }
            Node::Complement => stack[top & wrap] = last.complement(),
        }
    }
    stack[top & wrap]
}
