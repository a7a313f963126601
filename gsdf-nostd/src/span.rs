//! What one ray sees of one solid: a half-open span of its parameter.

use crate::bounded::WithError;
use crate::real::{Mask, Real};

/// The part of a ray inside a convex solid: the parameters `enter <= t < exit`.
///
/// Half-open spans form a Boolean algebra without isolated points: spans that touch merge, a tangent ray and a ray in
/// a face miss, and coincident faces need no epsilon. An empty span always reads `enter = +inf, exit = -inf`, and no
/// bound is ever NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span<T> {
    /// Where the ray enters, possibly -inf.
    pub enter: T,
    /// Where the ray leaves, possibly +inf.
    pub exit: T,
}

impl Span<f32> {
    /// The span without points; what scratch memory is filled with.
    pub const EMPTY: Self = Self {
        enter: f32::INFINITY,
        exit: f32::NEG_INFINITY,
    };
}

impl<T: Real> Span<T> {
    /// The span from `enter` to `exit`, empty unless `enter < exit` (so also where either is NaN).
    #[inline(always)]
    pub fn between(enter: T, exit: T) -> Self {
        Self::between_where(enter.lt(exit), enter, exit)
    }

    /// The span from `enter` to `exit` in the lanes where `condition` holds and `enter < exit`, empty elsewhere.
    #[inline(always)]
    pub fn between_where(condition: T::Mask, enter: T, exit: T) -> Self {
        let (enter, exit) = T::ends_where(condition & enter.lt(exit), enter, exit);
        Self { enter, exit }
    }

    /// The span without points.
    #[inline(always)]
    pub fn empty_like(like: T) -> Self {
        Self {
            enter: like.splat_like(f32::INFINITY),
            exit: like.splat_like(f32::NEG_INFINITY),
        }
    }

    /// The points in both spans.
    #[inline(always)]
    #[must_use]
    pub fn intersection(self, other: Self) -> Self {
        Self::between(self.enter.max(other.enter), self.exit.min(other.exit))
    }

    /// The least span around both; their union where that is known to be convex.
    #[inline(always)]
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        // Of a span that may be empty the ends say nothing.
        let known = self.enter.lt(self.exit).certain() & other.enter.lt(other.exit).certain();
        Self {
            enter: self.enter.min(other.enter).unknown_where(!known),
            exit: self.exit.max(other.exit).unknown_where(!known),
        }
    }

    /// The next boundary after `t >= 0`, with the sign of the side on which `t` lies: `+enter` ahead of the span,
    /// `-exit` in it, +inf behind it.
    ///
    /// Positive outside, negative inside, like every signed distance; but absolute along the ray, so that taking
    /// minima and maxima of several solids only ever selects one of the numbers computed once per leaf.
    #[inline(always)]
    pub fn signed_crossing(self, t: T) -> T {
        let ahead = T::select(t.lt(self.exit), -self.exit, t.splat_like(f32::INFINITY));
        T::select(t.lt(self.enter), self.enter, ahead)
    }

    /// Whether the ray enters or leaves at `t`.
    #[inline(always)]
    pub(crate) fn ends_at(self, t: T) -> T::Mask {
        self.enter.eq(t) | self.exit.eq(t)
    }

    /// Whether the ray is inside just before `t`.
    #[inline(always)]
    pub fn contains_before(self, t: T) -> T::Mask {
        self.enter.lt(t) & t.le(self.exit)
    }

    /// Whether the ray is inside at `t` and just after it.
    #[inline(always)]
    pub fn contains_after(self, t: T) -> T::Mask {
        self.enter.le(t) & t.lt(self.exit)
    }
}

impl<T: Real, const ALWAYS: bool> Span<WithError<T, ALWAYS>> {
    /// A span of which is known that it is held by one span and holds another: its ends are in between. Where the inner one is
    /// empty it may be as well, and its ends reach to each other.
    #[inline(always)]
    pub fn within(outer: Span<T>, inner: Span<T>) -> Self {
        let (inhabited, sure) = (outer.enter.lt(outer.exit), inner.enter.lt(inner.exit));
        let length = rounded_up(outer.exit - outer.enter, outer.enter.abs() + outer.exit.abs());
        let error = T::select(inhabited, length, length.splat_like(0.0));
        let enter = WithError { value: outer.enter, error };
        let exit = WithError { value: outer.exit, error };
        Self {
            enter: Self::end_between(sure, outer.enter, inner.enter, enter),
            exit: Self::end_between(sure, outer.exit, inner.exit, exit),
        }
    }

    /// What is between two numbers, where that is sure.
    #[inline(always)]
    fn end_between(sure: T::Mask, outer: T, inner: T, otherwise: WithError<T, ALWAYS>) -> WithError<T, ALWAYS> {
        let half = outer.splat_like(0.5);
        let middle = (outer + inner) * half;
        let apart = rounded_up((inner - outer).abs() * half, middle.abs());
        WithError {
            value: T::select(sure, middle, otherwise.value),
            error: T::select(sure, apart, otherwise.error),
        }
    }

    /// The ends as they were computed.
    #[inline(always)]
    pub(crate) fn values(self) -> Span<T> {
        Span {
            enter: self.enter.value,
            exit: self.exit.value,
        }
    }
}

/// Where an end of the span of a solid is known to lie between what was computed of two in `f32` ([`Solid::between`]), the end
/// that is computed of it in `f64` is off by at most this much of half of what is between: a little more than 2^-28.
///
/// The signed distance from a convex solid is a convex function, so the parameter at which a ray enters the solid as it is moved
/// outward is a convex function of by how much, and it descends the less the farther out. Between what is as much smaller than
/// the solid as rounding in `f32` makes it and the solid itself there is less than between the two ends. Rounding in `f64` moves
/// it by 2^-29 of that, and its end by no larger share.
///
/// [`Solid::between`]: crate::Solid::between
pub const IN_DOUBLES: f32 = 1.01 / (1_u32 << 28) as f32;

/// A difference of numbers of this size, and what they were rounded by.
#[inline(always)]
fn rounded_up<T: Real>(difference: T, size: T) -> T {
    difference + size * size.splat_like(4.0 * T::ROUNDOFF)
}

#[cfg(test)]
mod tests {
    use super::Span;
    use crate::bounded::Bounded;
    use crate::real::Real;

    #[test]
    fn ends_lie_between_those_of_two_spans() {
        let within = |outer, inner| -> Span<Bounded<f32>> { Span::within(outer, inner) };
        let span = within(Span::between(1.0, 4.0), Span::between(1.5, 3.5));
        let ((enter, entered), (exit, exited)) = (span.enter.ends(), span.exit.ends());
        assert!((0.999..=1.0).contains(&enter) && (1.5..1.501).contains(&entered), "{span:?}");
        assert!((3.499..=3.5).contains(&exit) && (4.0..4.001).contains(&exited), "{span:?}");
        // It may be empty, and is around all that may be in it.
        let thin = within(Span::between(2.0, 2.125), Span::EMPTY);
        assert!(
            !thin.enter.lt(thin.exit).sure && thin.enter.ends().1 >= 2.125 && thin.exit.ends().0 <= 2.0,
            "{thin:?}"
        );
        let nothing = within(Span::EMPTY, Span::EMPTY);
        assert_eq!(nothing, Span::empty_like(Bounded::exact(0.0)));
    }

    #[test]
    fn touching_ends_make_an_empty_span() {
        assert_eq!(Span::between(1.0_f32, 1.0), Span::EMPTY);
        assert_eq!(Span::between(f32::NAN, 1.0), Span::EMPTY);
        assert_eq!(Span::between(0.0, f32::NAN), Span::EMPTY);
        let (left, right) = (Span::between(0.0_f32, 1.0), Span::between(1.0, 2.0));
        assert_eq!(left.intersection(right), Span::EMPTY);
        assert_eq!(left.hull(right), Span::between(0.0, 2.0));
        assert_eq!(left.hull(Span::EMPTY), left);
    }

    #[test]
    fn crossing_is_signed_by_the_side() {
        let span = Span::between(1.0_f32, 3.0);
        assert_eq!(span.signed_crossing(0.0), 1.0);
        assert_eq!(span.signed_crossing(1.0), -3.0);
        assert_eq!(span.signed_crossing(2.0), -3.0);
        assert_eq!(span.signed_crossing(3.0), f32::INFINITY);
        assert_eq!(Span::EMPTY.signed_crossing(0.0), f32::INFINITY);
    }

    #[test]
    fn both_sides_of_a_boundary() {
        let span = Span::between(1.0_f32, 3.0);
        assert!(!span.contains_before(1.0) && span.contains_after(1.0));
        assert!(span.contains_before(3.0) && !span.contains_after(3.0));
    }
}
