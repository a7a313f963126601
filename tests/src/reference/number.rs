//! Exact binary numbers.
//!
//! Every finite `f32` and `f64` is an integer times a power of two. Sums, differences and products of such numbers
//! are again such numbers, so they are carried without any rounding; only a quotient or a square root has to be cut
//! somewhere, and those two say in their arguments after how many bits.

use core::cmp::Ordering;
use core::fmt;
use core::ops::{Add, Mul, Neg, Sub};

use dashu_float::round::mode::HalfEven;
use dashu_float::{Context, FBig};

/// Base 2, and ties to even where a quotient or a root has to be rounded.
type Float = FBig<HalfEven, 2>;

/// The nearest number of a machine format, ties to even.
///
/// `dashu` converts exactly what a format holds, but not everything at the ends of its range as IEEE 754 rounds it.
/// So the number is first rounded to the width of the format, and only then converted.
macro_rules! nearest {
    ($number:expr, $format:ident, $convert:ident) => {{
        let least_normal = Exact::from($format::MIN_POSITIVE);
        let digits = $format::MANTISSA_DIGITS as usize;
        let convert = |number: Exact| number.0.repr().$convert().value();
        let magnitude = $number.abs();
        let nearest = if magnitude < least_normal {
            // Subnormal numbers have the last place of the least normal one. Their sum with it is rounded in that
            // place, and what was added is taken away without error.
            convert((magnitude + least_normal).rounded(digits)) - $format::MIN_POSITIVE
        } else {
            let rounded = magnitude.rounded(digits);
            if rounded > Exact::from($format::MAX) {
                $format::INFINITY
            } else {
                convert(rounded)
            }
        };
        if $number.sign().is_lt() { -nearest } else { nearest }
    }};
}

/// An exact number: an integer of any length times a power of two.
///
/// The wrapped float always has unlimited precision. That invariant is why the type exists: a float converted from
/// `f32` by `dashu` itself carries a precision of 24 bits, and arithmetic on it would round silently.
#[derive(Clone)]
pub struct Exact(Float);

impl Exact {
    /// Zero.
    pub const ZERO: Self = Self(Float::ZERO);
    /// One.
    pub const ONE: Self = Self(Float::ONE);

    /// How the number compares with zero.
    #[must_use]
    pub fn sign(&self) -> Ordering {
        self.0.cmp(&Float::ZERO)
    }

    /// Whether the number is zero.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.sign().is_eq()
    }

    /// The magnitude.
    #[must_use]
    pub fn abs(&self) -> Self {
        if self.sign().is_lt() { -self } else { self.clone() }
    }

    /// The square, exact.
    #[must_use]
    pub fn square(&self) -> Self {
        Self(self.0.sqr())
    }

    /// The number times `2^power`, exact.
    #[must_use]
    pub fn scaled(&self, power: isize) -> Self {
        Self(self.0.clone() << power)
    }

    /// The number rounded to `bits` significant bits.
    #[must_use]
    pub fn rounded(&self, bits: usize) -> Self {
        Self::unlimited(self.0.clone().with_precision(bits).value())
    }

    /// The quotient, rounded to `bits` significant bits.
    ///
    /// # Panics
    ///
    /// If the divisor is zero.
    #[must_use]
    pub fn quotient(&self, divisor: &Self, bits: usize) -> Self {
        assert!(
            !divisor.is_zero(),
            "the reference divides by leading coefficients only, which are not zero"
        );
        if self.is_zero() {
            return Self::ZERO;
        }
        let quotient = Context::<HalfEven>::new(bits)
            .div(self.0.repr(), divisor.0.repr())
            .expect("finite numbers with a divisor other than zero have a quotient");
        Self::unlimited(quotient.value())
    }

    /// The square root, rounded to `bits` significant bits; exact where the root has no more bits than that.
    ///
    /// # Panics
    ///
    /// If the number is negative.
    #[must_use]
    pub fn sqrt(&self, bits: usize) -> Self {
        let root = Context::<HalfEven>::new(bits)
            .sqrt(self.0.repr())
            .expect("the caller has seen that the number is not negative");
        Self::unlimited(root.value())
    }

    /// The nearest `f64`, ties to even; infinite from half a last place beyond its range.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        nearest!(self, f64, to_f64)
    }

    /// The nearest `f32`, ties to even; infinite from half a last place beyond its range.
    #[must_use]
    pub fn to_f32(&self) -> f32 {
        nearest!(self, f32, to_f32)
    }

    /// Lifts the limit on precision, which changes no bit of the number itself.
    fn unlimited(number: Float) -> Self {
        Self(number.with_precision(0).value())
    }
}

impl From<f64> for Exact {
    /// # Panics
    ///
    /// If the number is infinite or not a number.
    fn from(number: f64) -> Self {
        assert!(number.is_finite(), "{number} is not a number the reference can take exactly");
        if number == 0.0 {
            return Self::ZERO;
        }
        Self::unlimited(Float::try_from(number).expect("every finite number converts"))
    }
}

impl From<f32> for Exact {
    /// # Panics
    ///
    /// If the number is infinite or not a number.
    fn from(number: f32) -> Self {
        // Widening changes nothing, subnormal numbers included.
        Self::from(f64::from(number))
    }
}

impl From<i32> for Exact {
    fn from(number: i32) -> Self {
        Self::from(f64::from(number))
    }
}

impl PartialEq for Exact {
    fn eq(&self, other: &Self) -> bool {
        // By order, not by representation: a product may be a negative zero, which is zero all the same.
        self.cmp(other).is_eq()
    }
}

impl Eq for Exact {}

impl PartialOrd for Exact {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Exact {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.cmp(&other.0)
    }
}

impl fmt::Debug for Exact {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Hundreds of binary digits help nobody who reads a failed assertion.
        write!(formatter, "≈{:e}", self.to_f64())
    }
}

impl Neg for &Exact {
    type Output = Exact;

    fn neg(self) -> Exact {
        &Exact::ZERO - self
    }
}

impl Neg for Exact {
    type Output = Exact;

    fn neg(self) -> Exact {
        -&self
    }
}

macro_rules! exact_operator {
    ($operator:ident, $method:ident) => {
        impl $operator<&Exact> for &Exact {
            type Output = Exact;

            fn $method(self, other: &Exact) -> Exact {
                Exact($operator::$method(&self.0, &other.0))
            }
        }

        impl $operator for Exact {
            type Output = Exact;

            fn $method(self, other: Exact) -> Exact {
                Exact($operator::$method(self.0, other.0))
            }
        }
    };
}

exact_operator!(Add, add);
exact_operator!(Sub, sub);
exact_operator!(Mul, mul);

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn finite() -> impl Strategy<Value = f32> {
        any::<u32>()
            .prop_map(f32::from_bits)
            .prop_filter("finite", |number| number.is_finite())
    }

    proptest! {
        /// Exponents differ by up to 276 here, so any rounding to a fixed width would show.
        #[test]
        fn sums_and_products_lose_nothing(a in finite(), b in finite(), c in finite()) {
            let [a, b, c] = [a, b, c].map(Exact::from);
            prop_assert_eq!(&(&a + &b) - &b, a.clone());
            prop_assert_eq!(&(&a - &b) + &b, a.clone());
            prop_assert_eq!(&(&a + &b) * &c, &(&a * &c) + &(&b * &c));
            prop_assert_eq!(&(&a + &b).square() - &(&a - &b).square(), (&a * &b).scaled(2));
            prop_assert_eq!((&a.square() * &b.square()).sqrt(96), (&a * &b).abs());
            prop_assert_eq!((&a - &b).sign(), a.cmp(&b));
        }

        #[test]
        fn integers_agree_with_machine_integers(a in any::<i32>(), b in any::<i32>()) {
            let product = i128::from(a) * i128::from(b) * i128::from(b);
            let [a, b] = [a, b].map(Exact::from);
            prop_assert_eq!((&(&a * &b) * &b).to_f64(), product as f64);
        }

        #[test]
        fn conversions_return_what_came_in(bits in any::<u64>()) {
            let double = f64::from_bits(bits);
            prop_assume!(double.is_finite());
            prop_assert_eq!(Exact::from(double).to_f64(), double);
            prop_assert_eq!(Exact::from(double).to_f32(), double as f32);
        }

        /// A tail far below the last bit decides a tie, and nothing else.
        #[test]
        fn conversions_round_to_nearest(number in finite()) {
            let next = if number.abs() == f32::MAX { number } else { number.next_up() };
            let tie = (Exact::from(number) + Exact::from(next)).scaled(-1);
            let tail = Exact::ONE.scaled(-600);
            prop_assert_eq!((&tie + &tail).to_f32(), next);
            prop_assert_eq!((&tie - &tail).to_f32(), number);
            let even = if number.to_bits() & 1 == 0 { number } else { next };
            prop_assert_eq!(tie.to_f32(), even);
        }

        #[test]
        fn quotients_and_roots_are_as_good_as_asked(a in finite(), b in finite()) {
            let [a, b] = [a, b].map(Exact::from);
            let tolerance = Exact::ONE.scaled(-320);
            if !b.is_zero() {
                let quotient = a.quotient(&b, 320);
                prop_assert!((&(&quotient * &b) - &a).abs() <= &a.abs() * &tolerance);
            }
            let root = a.abs().sqrt(321);
            prop_assert!((&root.square() - &a.abs()).abs() <= &a.abs() * &tolerance);
        }
    }

    #[test]
    fn conversions_round_at_the_ends_of_the_range() {
        for eighths in -40..=40_i32 {
            let subnormal = f64::from(eighths) * f64::powi(2.0, -152);
            assert_eq!(Exact::from(subnormal).to_f32(), subnormal as f32);
            // The same number of eighths of the least f64, which only the exact number can hold.
            let units = (f64::from(eighths) / 8.0).round_ties_even();
            let expected = units * f64::from_bits(1);
            assert_eq!(Exact::from(eighths).scaled(-1077).to_f64(), expected);
        }
        let half_ulp = Exact::ONE.scaled(103);
        let tie = &Exact::from(f32::MAX) + &half_ulp;
        assert_eq!(tie.to_f32(), f32::INFINITY);
        assert_eq!((&tie - &Exact::ONE).to_f32(), f32::MAX);
        assert_eq!((-tie).to_f32(), f32::NEG_INFINITY);
        assert_eq!(Exact::ONE.scaled(2000).to_f64(), f64::INFINITY);
    }

    #[test]
    fn every_zero_is_zero() {
        let negative = Exact::from(-0.0_f32) * Exact::from(-1);
        assert!(negative.is_zero() && (&negative * &Exact::from(-1)) == Exact::ZERO);
        assert_eq!(Exact::ZERO.sqrt(10), Exact::ZERO);
        assert_eq!(Exact::ZERO.quotient(&Exact::from(-3), 10), Exact::ZERO);
    }
}
