//! The directional reading of a program, one parameter at a time: its leaves are spans of one ray.

use super::fold::{Operand, Reading, Signed, fold};
use super::node::Node;
use crate::bounded::WithError;
use crate::real::{Mask, Real};
use crate::span::Span;
use core::slice::Iter;

/// The signed absolute crossing of a program at `t`: a bound on where the ray next crosses its boundary, positive
/// where `t` is outside, negative inside.
///
/// Minimum for union, maximum for intersection, negation for complement, of the leaves' [signed
/// crossings](Span::signed_crossing). For every program and every `t >= 0` the sign is the true membership at `t`,
/// the ray crosses no boundary between `t` and the magnitude, and the magnitude is a root of some leaf, bit for bit,
/// or infinite. `spans` holds those of the leaves in order.
#[inline(always)]
pub fn sweep<T: Real, L>(nodes: &[Node<L>], spans: &[Span<T>], t: T) -> T {
    let spans = spans.iter();
    fold(nodes, Signed(t), &mut Sweep { spans, t }).0
}

/// [`sweep`] over the values of spans that know their errors.
#[inline(always)]
pub(super) fn sweep_values<T: Real, L, const ALWAYS: bool>(nodes: &[Node<L>], spans: &[Span<WithError<T, ALWAYS>>], t: T) -> T {
    let spans = spans.iter();
    fold(nodes, Signed(t), &mut SweepValues { spans, t }).0
}

struct SweepValues<'a, T, const ALWAYS: bool> {
    spans: Iter<'a, Span<WithError<T, ALWAYS>>>,
    t: T,
}

impl<T: Real, L, const ALWAYS: bool> Reading<L> for SweepValues<'_, T, ALWAYS> {
    type Operand = Signed<T>;
    #[inline(always)]
    fn leaf(&mut self, _: &L, _: u16) -> Signed<T> {
        Signed(match self.spans.next() {
            Some(span) => span.values().signed_crossing(self.t),
            None => self.t.splat_like(f32::INFINITY),
        })
    }
}

struct Sweep<'a, T> {
    spans: Iter<'a, Span<T>>,
    t: T,
}

impl<T: Real, L> Reading<L> for Sweep<'_, T> {
    type Operand = Signed<T>;
    #[inline(always)]
    fn leaf(&mut self, _: &L, _: u16) -> Signed<T> {
        Signed(match self.spans.next() {
            Some(span) => span.signed_crossing(self.t),
            None => self.t.splat_like(f32::INFINITY),
        })
    }
}

/// Who makes a crossing: membership on both sides of it, and the leaf whose surface it is.
#[derive(Clone, Copy, Debug)]
pub struct Attribution<T: Real> {
    /// Whether the ray is inside just before.
    pub before: T::Mask,
    /// Whether the ray is inside just after.
    pub after: T::Mask,
    /// The number of the leaf, +inf where nothing changes.
    pub leaf: T,
}

impl<T: Real> Attribution<T> {
    /// `leaf` where membership changes, nobody where it does not.
    #[inline(always)]
    fn new(before: T::Mask, after: T::Mask, leaf: T) -> Self {
        let nobody = leaf.splat_like(f32::INFINITY);
        Self {
            before,
            after,
            leaf: T::select(before.differs_from(after), leaf, nobody),
        }
    }
}

impl<T: Real> Operand for Attribution<T> {
    #[inline(always)]
    fn union(self, other: Self) -> Self {
        Self::new(self.before | other.before, self.after | other.after, self.leaf.min(other.leaf))
    }
    #[inline(always)]
    fn intersection(self, other: Self) -> Self {
        Self::new(self.before & other.before, self.after & other.after, self.leaf.min(other.leaf))
    }
    #[inline(always)]
    fn complement(self) -> Self {
        Self {
            before: !self.before,
            after: !self.after,
            leaf: self.leaf,
        }
    }
}

/// Which leaf makes the program's crossing at `t`: the one with the lowest number among those whose own crossing
/// there makes the whole one's.
///
/// Not merely a leaf with a root at `t`: a surface that coincides there but is cut away, or lies within another
/// solid, is not seen. The rule depends on the solid alone and not on the order of evaluation: where a union or an
/// intersection changes, all its operands that change do so in its direction, and of those the lowest number is
/// taken.
#[inline(always)]
pub fn attribute<T: Real, L>(nodes: &[Node<L>], spans: &[Span<T>], t: T) -> Attribution<T> {
    let never = t.lt(t);
    let number = t.splat_like(0.0);
    let spans = spans.iter();
    fold(nodes, Attribution::new(never, never, t), &mut Blame { spans, t, number })
}

struct Blame<'a, T> {
    spans: Iter<'a, Span<T>>,
    t: T,
    number: T,
}

impl<T: Real, L> Reading<L> for Blame<'_, T> {
    type Operand = Attribution<T>;
    #[inline(always)]
    fn leaf(&mut self, _: &L, _: u16) -> Attribution<T> {
        let span = self.spans.next().copied().unwrap_or(Span::empty_like(self.t));
        let operand = Attribution::new(span.contains_before(self.t), span.contains_after(self.t), self.number);
        self.number = self.number + self.t.splat_like(1.0);
        operand
    }
}
