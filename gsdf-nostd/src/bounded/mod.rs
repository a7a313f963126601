//! Numbers that know how wrong they may be, as an arithmetic.

mod operators;
mod vectors;

use crate::quadratic::Chord;
use crate::real::{Mask, Real};
use crate::vec3::V3;
use core::ops::{BitAnd, BitOr, Not};

/// A number that knows how wrong it may be, whatever it is: see [`WithError`].
pub type Bounded<T> = WithError<T, true>;

/// The same for ordinary numbers alone, without a branch, for many lanes at once: of what underflows, overflows or may be
/// negative under a root nothing is known. What is known has the bounds of [`Bounded`], bit for bit.
pub type Ordinary<T> = WithError<T, false>;

/// A number somewhere within `error` of `value`: any formula computed in this arithmetic bounds its own rounding errors.
///
/// The values are those of `T`, bit for bit, wherever a formula's decisions are certain. Beside each goes a bound on how far
/// it may be from what the same formula gives in exact arithmetic (J. H. Wilkinson's running error analysis, The State of the
/// Art in Error Analysis, 1985): a sum adds what it really lost (D. Knuth's two-sum), a product half a unit in its last
/// place. Scalar and vector products and the discriminants of quadratics are bounded as a whole, which takes fewer operations
/// than theirs one by one. Comparisons know whether the bounds leave room for the other outcome ([`Judged`]).
///
/// Cost: some four times the operations of `T`.
///
/// What a ray meets is computed from such numbers by [`Program::cast_certified`](crate::Program::cast_certified). `ALWAYS` says
/// whether there are bounds for all numbers ([`Bounded`]), or for most and without branches ([`Ordinary`]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithError<T, const ALWAYS: bool> {
    /// The number as `T` has it.
    pub value: T,
    /// By how much it may be off, but for [`SLACK`]; infinite or NaN where nothing is known.
    pub error: T,
}

/// The outcome of a comparison, and whether it is certain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Judged<M> {
    /// The outcome for the values.
    pub yes: M,
    /// Whether it is that for all numbers they may stand for.
    pub sure: M,
}

/// What bounds are multiplied by where they are used: they are sums and products of positive numbers, rounded a few hundred
/// times at the most.
pub const SLACK: f32 = 1.0 + 1.0 / 1024.0;

/// Above it a product has all its digits, and so has what it is off by.
const LEAST_ORDINARY: f32 = 1.0 / (1_u128 << 100) as f32;

/// What a product may lose to underflow, and much more: so much that what is computed from bounds is not itself so small that
/// processors take their time over it.
const UNDERFLOW: f32 = LEAST_ORDINARY;

impl<M: Mask> Judged<M> {
    fn exactly(yes: M) -> Self {
        Self {
            yes,
            sure: yes.splat_like(true),
        }
    }
}

impl<M: Mask> BitAnd for Judged<M> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self {
            yes: self.yes & other.yes,
            sure: (self.sure & other.sure) | (self.sure & !self.yes) | (other.sure & !other.yes),
        }
    }
}

impl<M: Mask> BitOr for Judged<M> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self {
            yes: self.yes | other.yes,
            sure: (self.sure & other.sure) | (self.sure & self.yes) | (other.sure & other.yes),
        }
    }
}

impl<M: Mask> Not for Judged<M> {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self {
            yes: !self.yes,
            sure: self.sure,
        }
    }
}

impl<M: Mask> Mask for Judged<M> {
    /// Whether some lane may be true.
    #[inline(always)]
    fn any(self) -> bool {
        (self.yes | !self.sure).any()
    }
    /// Whether every lane is true for certain.
    #[inline(always)]
    fn all(self) -> bool {
        (self.yes & self.sure).all()
    }
    #[inline(always)]
    fn splat_like(self, value: bool) -> Self {
        Self::exactly(self.yes.splat_like(value))
    }
    #[inline(always)]
    fn certain(self) -> Self {
        Self::exactly(self.sure)
    }
}

impl<T: Real, const ALWAYS: bool> WithError<T, ALWAYS> {
    /// A number that is exactly what it says.
    #[inline(always)]
    pub fn exact(value: T) -> Self {
        Self {
            value,
            error: value.splat_like(0.0),
        }
    }

    /// The least number it may be, and the greatest.
    #[inline(always)]
    pub fn ends(self) -> (T, T) {
        let reach = self.reach();
        // A rounding of the ends themselves must not take them inward.
        let outward = (self.value.abs() + reach) * reach.splat_like(4.0 * T::ROUNDOFF);
        let reach = T::select(reach.eq(reach.splat_like(0.0)), reach, reach + outward);
        (self.value - reach, self.value + reach)
    }

    /// The bound, with all that was lost in computing it.
    #[inline(always)]
    fn reach(self) -> T {
        self.error * self.error.splat_like(SLACK)
    }

    #[inline(always)]
    fn is_exact(self) -> T::Mask {
        self.error.eq(self.error.splat_like(0.0))
    }

    /// Whether it is zero, exactly.
    #[inline(always)]
    fn is_nothing(self) -> T::Mask {
        (self.value.abs() + self.error).eq(self.error.splat_like(0.0))
    }

    /// A value that was computed from operands which are off by `inherited`, with what rounding added to it. What is infinite,
    /// or no number, is exactly so where the operands were, and not where a finite number has overflowed.
    #[inline(always)]
    fn rounded(value: T, inherited: T, rounding: T, endless: T::Mask) -> Self {
        let zero = value.splat_like(0.0);
        let finite = Self::is_finite(value);
        let beyond = T::select(inherited.eq(zero) & endless, zero, zero.splat_like(f32::INFINITY));
        Self {
            value,
            error: T::select(finite, inherited + rounding, beyond),
        }
    }

    /// The number where it is ordinary. Of others nothing is known, unless there are bounds for all: those are made elsewhere.
    #[inline(always)]
    fn where_known(self, ordinary: T::Mask) -> Self {
        if ALWAYS {
            return self;
        }
        let unknown = self.error.splat_like(f32::INFINITY);
        Self {
            value: self.value,
            error: T::select(ordinary, self.error, unknown),
        }
    }

    /// Where a number is far from what underflows or overflows, so that what a product loses is relative to it: the bounds
    /// are then a few operations, and the rest is elsewhere.
    #[inline(always)]
    fn is_ordinary(value: T) -> T::Mask {
        let size = value.abs();
        size.splat_like(LEAST_ORDINARY).lt(size) & size.lt(size.splat_like(f32::INFINITY))
    }

    #[inline(always)]
    fn is_finite(value: T) -> T::Mask {
        value.abs().lt(value.splat_like(f32::INFINITY))
    }

    /// What half a unit in the last place is, at the most.
    #[inline(always)]
    fn half_ulp(value: T) -> T {
        value.abs() * value.splat_like(T::ROUNDOFF)
    }

    /// The lesser, or the greater, of the two, where its value is that of `self` or of `other`.
    #[inline(always)]
    fn one_of(self, other: Self, is_self: T::Mask) -> Self {
        let reach = (self.error + other.error) * self.error.splat_like(SLACK);
        let apart = reach.lt((self.value - other.value).abs());
        let (own, farther) = (T::select(is_self, self.error, other.error), self.error.max(other.error));
        // Of NaN nothing is known, and comparisons do not show it.
        let farther = T::select(reach.eq(reach), farther, reach);
        Self {
            value: T::select(is_self, self.value, other.value),
            error: T::select(apart, own, farther),
        }
    }

    /// The number where a mask is true, and exactly another one elsewhere.
    #[inline(always)]
    fn where_else(self, mask: T::Mask, other: f32) -> Self {
        Self {
            value: T::select(mask, self.value, self.value.splat_like(other)),
            error: T::select(mask, self.error, self.error.splat_like(0.0)),
        }
    }

    /// The number with another bound where a mask is true.
    #[inline(always)]
    fn reaching(self, mask: T::Mask, error: T) -> Self {
        Self {
            value: self.value,
            error: T::select(mask, error, self.error),
        }
    }

    /// How the two compare, where the outcome for the values is `yes`.
    #[inline(always)]
    fn judged(self, other: Self, yes: T::Mask) -> Judged<T::Mask> {
        let apart = (self.value - other.value).abs();
        let reach = (self.error + other.error) * self.error.splat_like(SLACK);
        Judged {
            yes,
            sure: reach.lt(apart) | reach.eq(reach.splat_like(0.0)),
        }
    }
}

impl<T: Real, const ALWAYS: bool> Real for WithError<T, ALWAYS> {
    type Mask = Judged<T::Mask>;
    const LANES: usize = T::LANES;
    const ROBUST: bool = T::ROBUST;
    const ROUNDOFF: f32 = T::ROUNDOFF;
    const INLINED: bool = T::INLINED;
    type Scalar = WithError<T::Scalar, ALWAYS>;

    #[inline(always)]
    fn apart<R>(self, work: impl FnOnce() -> R) -> R {
        self.value.apart(work)
    }
    #[inline(always)]
    fn splat_like(self, value: f32) -> Self {
        Self::exact(self.value.splat_like(value))
    }
    #[inline(always)]
    fn lift_like(self, value: Self::Scalar) -> Self {
        Self {
            value: self.value.lift_like(value.value),
            error: self.value.lift_like(value.error),
        }
    }
    /// Of a number that may be negative, but need not be, the root of what it is at the most is within the bound.
    #[inline(always)]
    fn sqrt(self) -> Self {
        let ordinary = Self::is_ordinary(self.value) & self.reach().lt(self.value);
        if !ALWAYS || ordinary.all() {
            let value = self.value.sqrt();
            // `sqrt(x) - sqrt(x - e)` is at most `e / sqrt(x)`.
            let error = self.error / value + Self::half_ulp(value);
            Self { value, error }.where_known(ordinary)
        } else {
            operators::odd_root(self)
        }
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self {
            value: self.value.abs(),
            error: self.error,
        }
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        let magnitude = self.value.abs();
        let sure = sign.is_exact() | sign.reach().lt(sign.value.abs());
        Self {
            value: self.value.copysign(sign.value),
            error: T::select(sure, self.error, self.error + (magnitude + magnitude)),
        }
    }
    #[inline(always)]
    fn next_up(self) -> Self {
        let value = self.value.next_up();
        Self {
            value,
            error: self.error + (value - self.value),
        }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        self.judged(other, self.value.lt(other.value))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::Mask {
        self.judged(other, self.value.le(other.value))
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Self::Mask {
        self.judged(other, self.value.eq(other.value))
    }
    /// Where it is not certain which is the lesser: no farther off than the one that is farther off.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        let least = self.value.lt(other.value);
        self.one_of(other, least)
    }
    /// As [`min`](Real::min).
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        let greatest = other.value.lt(self.value);
        self.one_of(other, greatest)
    }
    /// Where the mask is not certain: a number whose bound holds for either choice.
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        let value = T::select(mask.yes, yes.value, no.value);
        if ALWAYS && mask.sure.all() {
            let error = T::select(mask.yes, yes.error, no.error);
            return Self { value, error };
        }
        let same = yes.value.eq(no.value);
        let apart = T::select(same, value.splat_like(0.0), (yes.value - no.value).abs());
        Self {
            value,
            error: T::select(mask.sure, T::select(mask.yes, yes.error, no.error), apart + (yes.error + no.error)),
        }
    }
    #[inline(always)]
    fn dot(a: V3<Self>, b: V3<Self>) -> Self {
        vectors::dot(a, b)
    }
    #[inline(always)]
    fn cross(a: V3<Self>, b: V3<Self>) -> V3<Self> {
        vectors::cross(a, b)
    }
    #[inline(always)]
    fn discriminant(chord: &Chord<Self>, b: Self) -> Self {
        vectors::discriminant(chord, b)
    }
    #[inline(always)]
    fn times_power(self, power: Self) -> Self {
        Self {
            value: self.value * power.value,
            error: self.error * power.value.abs(),
        }
    }
    #[inline(always)]
    fn given(self) -> Self {
        Self::exact(self.value)
    }
    #[inline(always)]
    fn doubt(self) -> Self {
        Self::exact(self.reach())
    }
    #[inline(always)]
    fn off_by(self, doubt: Self) -> Self {
        Self {
            value: self.value,
            error: self.error + (doubt.value.abs() + doubt.error),
        }
    }
    /// Where it is not certain whether the span is inhabited its ends stand as if it were, and reach to each other.
    #[inline(always)]
    fn ends_where(inhabited: Self::Mask, enter: Self, exit: Self) -> (Self, Self) {
        let value = enter.value;
        if ALWAYS && inhabited.sure.all() {
            return (
                enter.where_else(inhabited.yes, f32::INFINITY),
                exit.where_else(inhabited.yes, f32::NEG_INFINITY),
            );
        }
        let may_be = inhabited.yes | !inhabited.sure;
        let reach = (exit.value - value).abs() + (enter.error + exit.error);
        let (enter, exit) = (enter.where_else(may_be, f32::INFINITY), exit.where_else(may_be, f32::NEG_INFINITY));
        let doubtful = may_be & !inhabited.sure;
        (enter.reaching(doubtful, reach), exit.reaching(doubtful, reach))
    }
}
