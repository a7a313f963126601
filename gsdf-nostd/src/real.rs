//! The arithmetic every formula of this crate is written in.
//!
//! A formula is written once, over [`Real`], and compiled for `f32`, for `f64` and for whatever lane type a packet
//! crate brings. To give the same bits everywhere the trait holds only operations that IEEE 754 rounds correctly, or
//! that only pick or flip bits: no fused multiply-add, no estimates of reciprocals, no sums across lanes.

use crate::quadratic::Chord;
use crate::root;
use crate::vec3::V3;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// The outcome of a comparison: `bool` for a scalar, one truth value per lane for a packet.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Whether any lane is true.
    fn any(self) -> bool;
    /// Whether every lane is true.
    fn all(self) -> bool;
    /// The same truth value in every lane, in the shape of `self`.
    #[must_use]
    fn splat_like(self, value: bool) -> Self;
    /// Where the truth values are certain: everywhere, but for comparisons of numbers that know their errors.
    #[inline(always)]
    #[must_use]
    fn certain(self) -> Self {
        self.splat_like(true)
    }
    /// Whether the truth values differ, lane by lane.
    #[inline(always)]
    #[must_use]
    fn differs_from(self, other: Self) -> Self {
        (self & !other) | (!self & other)
    }
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
    #[inline(always)]
    fn splat_like(self, value: bool) -> Self {
        value
    }
}

/// A real number, or a packet of them.
///
/// Every operation is correctly rounded (`+ - * /`, [`sqrt`](Real::sqrt)) or exact (the rest), so that all
/// implementations give the same bits for the same inputs, NaN payloads aside. Comparisons with NaN are false.
///
/// Constants are made *like* an existing value ([`splat_like`](Real::splat_like)), because some lane types carry a
/// proof of the processor's abilities that cannot be conjured from nothing.
pub trait Real: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self> {
    /// The result of comparing two values.
    type Mask: Mask;
    /// How many numbers a value holds.
    const LANES: usize;
    /// Whether formulas go out of their way so that nothing large cancels; only [`Plain`](crate::Plain) does without.
    const ROBUST: bool = true;
    /// Whether formulas have to become part of whatever asks for them, because only that is compiled for the instructions
    /// that the arithmetic is made of. Others may share one copy of a formula, so that flash stays small.
    const INLINED: bool = false;

    /// The unit roundoff: the most that an operation can be off by, relative to its result.
    const ROUNDOFF: f32 = f32::EPSILON / 2.0;

    /// The arithmetic of one lane: `f32` for `f32` and its packets, `f64` for `f64`.
    type Scalar: Real<Scalar = Self::Scalar>;

    /// Does work in a function of its own that is compiled for the same instructions as whatever asks for it, where these are
    /// not those of the whole program; just does it elsewhere.
    #[inline(always)]
    fn apart<R>(self, work: impl FnOnce() -> R) -> R {
        work()
    }

    /// `value` in every lane; exact, since every arithmetic here contains the `f32` numbers.
    #[must_use]
    fn splat_like(self, value: f32) -> Self;
    /// A value of one lane's arithmetic in every lane.
    #[must_use]
    fn lift_like(self, value: Self::Scalar) -> Self;
    /// The square root, correctly rounded; NaN below zero.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The value with its sign bit cleared.
    #[must_use]
    fn abs(self) -> Self;
    /// The magnitude of `self` with the sign bit of `sign`.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// The next number after the value: the least one that is greater. Infinity after infinity; NaN after NaN.
    #[must_use]
    fn next_up(self) -> Self;
    /// `self < other`, false where either is NaN.
    fn lt(self, other: Self) -> Self::Mask;
    /// `self <= other`, false where either is NaN.
    fn le(self, other: Self) -> Self::Mask;
    /// `self == other`, false where either is NaN; both zeros are equal.
    fn eq(self, other: Self) -> Self::Mask;
    /// `yes` where the mask is true, `no` elsewhere.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// `self > other`, false where either is NaN.
    #[inline(always)]
    fn gt(self, other: Self) -> Self::Mask {
        other.lt(self)
    }
    /// `self < other ? self : other`: the second operand where they are equal or either is NaN, as x86's `minps` has
    /// it.
    #[inline(always)]
    #[must_use]
    fn min(self, other: Self) -> Self {
        Self::select(self.lt(other), self, other)
    }
    /// `other < self ? self : other`: the second operand where they are equal or either is NaN, as x86's `maxps` has
    /// it.
    #[inline(always)]
    #[must_use]
    fn max(self, other: Self) -> Self {
        Self::select(other.lt(self), self, other)
    }
    /// The product with itself.
    #[inline(always)]
    #[must_use]
    fn squared(self) -> Self {
        self * self
    }

    /// The product with a power of two, which is exact.
    #[inline(always)]
    #[must_use]
    fn times_power(self, power: Self) -> Self {
        self * power
    }

    // What follows makes a difference to arithmetics alone that bound their errors: `Bounded`.

    /// The scalar product, `(x x' + y y') + z z'`.
    #[inline(always)]
    #[must_use]
    fn dot(a: V3<Self>, b: V3<Self>) -> Self {
        (a.x * b.x + a.y * b.y) + a.z * b.z
    }
    /// The vector product; each coordinate is a difference of two products.
    #[inline(always)]
    #[must_use]
    fn cross(a: V3<Self>, b: V3<Self>) -> V3<Self> {
        V3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
    }
    /// The discriminant of a chord whose `B` is known.
    #[inline(always)]
    #[must_use]
    fn discriminant(chord: &Chord<Self>, b: Self) -> Self {
        chord.own_discriminant(b)
    }

    /// The value as it is, right or not: for a number of which a formula only asks to be near to another one.
    #[inline(always)]
    #[must_use]
    fn given(self) -> Self {
        self
    }
    /// By how much the value may be off; zero where nobody knows.
    #[inline(always)]
    #[must_use]
    fn doubt(self) -> Self {
        self.splat_like(0.0)
    }
    /// The value, which may be off by so much more than its operations tell.
    #[inline(always)]
    #[must_use]
    fn off_by(self, _doubt: Self) -> Self {
        self
    }
    /// The value, of which nothing is known unless this is known to be false: where a formula leaves out what cannot be
    /// computed.
    #[inline(always)]
    #[must_use]
    fn unknown_where(self, lost: Self::Mask) -> Self {
        let nothing = self.splat_like(0.0);
        self.off_by(Self::select(lost, self.splat_like(f32::INFINITY), nothing))
    }
    /// The ends of a span where it is inhabited; elsewhere +inf and -inf.
    #[inline(always)]
    #[must_use]
    fn ends_where(inhabited: Self::Mask, enter: Self, exit: Self) -> (Self, Self) {
        (
            Self::select(inhabited, enter, enter.splat_like(f32::INFINITY)),
            Self::select(inhabited, exit, enter.splat_like(f32::NEG_INFINITY)),
        )
    }
}

/// The arithmetic of a single lane: `f32`, `f64`, or a newtype over one of them.
pub trait Lane: Real<Scalar = Self, Mask = bool> + PartialOrd + From<f32> {
    /// The nearest `f32`.
    fn to_f32(self) -> f32;
    /// The integer part of a number from 0 to 2^24; saturates beyond `u32`, and 0 for NaN.
    fn to_index(self) -> u32;
}

macro_rules! real_scalar {
    ($float:ty, $sqrt:path, $roundoff:expr) => {
        impl Real for $float {
            const LANES: usize = 1;
            const ROUNDOFF: f32 = $roundoff;
            type Mask = bool;
            type Scalar = $float;

            #[inline(always)]
            fn splat_like(self, value: f32) -> Self {
                Self::from(value)
            }
            #[inline(always)]
            fn lift_like(self, value: Self) -> Self {
                value
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }
            #[inline(always)]
            fn abs(self) -> Self {
                <$float>::abs(self)
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                <$float>::copysign(self, sign)
            }
            #[inline(always)]
            fn next_up(self) -> Self {
                <$float>::next_up(self)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> bool {
                self < other
            }
            #[inline(always)]
            fn le(self, other: Self) -> bool {
                self <= other
            }
            #[inline(always)]
            fn eq(self, other: Self) -> bool {
                self == other
            }
            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }
        }

        impl Lane for $float {
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "rounding to f32 is what is asked for")]
            fn to_f32(self) -> f32 {
                self as f32
            }
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "`as` saturates")]
            fn to_index(self) -> u32 {
                self as u32
            }
        }
    };
}

real_scalar!(f32, root::single, f32::EPSILON / 2.0);
real_scalar!(f64, root::double, f32::EPSILON * f32::EPSILON / 128.0);

#[cfg(test)]
mod tests {
    use super::{Mask, Real};

    #[test]
    fn min_and_max_return_the_second_operand_on_ties_and_nan() {
        assert!(Real::min(0.0_f32, -0.0).is_sign_negative());
        assert!(Real::max(-0.0_f32, 0.0).is_sign_positive());
        assert_eq!(Real::min(f32::NAN, 1.0), 1.0);
        assert_eq!(Real::max(f64::NAN, 1.0), 1.0);
        assert!(Real::min(1.0_f32, f32::NAN).is_nan());
        assert!(Real::max(1.0_f64, f64::NAN).is_nan());
    }

    #[test]
    fn the_next_number_is_a_bit_above() {
        assert_eq!(Real::next_up(1.0_f32), 1.0 + f32::EPSILON);
        assert_eq!(Real::next_up(-1.0_f64), -1.0 + f64::EPSILON / 2.0);
        assert_eq!(Real::next_up(-0.0_f32), f32::from_bits(1));
        assert_eq!(Real::next_up(f32::INFINITY), f32::INFINITY);
        assert!(Real::next_up(f64::NAN).is_nan());
    }

    #[test]
    fn masks_differ_where_exactly_one_is_true() {
        for (a, b) in [(false, false), (false, true), (true, false), (true, true)] {
            assert_eq!(a.differs_from(b), a != b);
        }
    }
}
