//! Numbers of 106 bits that know how wrong they may be.

use super::double::Double;
use crate::reference::Exact;
use core::cmp::Ordering;
use core::ops::{Add, Mul, Neg, Sub};

/// What one operation on double-doubles may be off by, relative to its result: 2^-100.
///
/// Quotients and roots are right to 2^-102, sums and products to better than that; the rest covers the roundings of the
/// bounds themselves.
const ROUNDING: f64 = 1.0 / (1_u128 << 100) as f64;

/// What is lost below the range of `f64`, absolutely.
const LEAST: f64 = f64::MIN_POSITIVE;

/// A number somewhere within `error` of `middle`.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    middle: Double,
    error: f64,
}

impl Ball {
    /// Zero, exactly.
    pub const ZERO: Self = Self {
        middle: Double { high: 0.0, low: 0.0 },
        error: 0.0,
    };

    /// The result of an operation whose operands were off by so much that the result is off by `error`.
    fn rounded(middle: Double, error: f64) -> Self {
        let own = middle.high.abs() * ROUNDING;
        Self {
            middle,
            // What is below the range is lost from a product of numbers, but not from one with zero.
            error: if own + error == 0.0 && middle.high == 0.0 {
                0.0
            } else {
                own + error * (1.0 + ROUNDED_UP)
            },
        }
    }

    /// The product of two machine numbers, exactly.
    #[must_use]
    pub fn product(a: f64, b: f64) -> Self {
        let middle = Double::product(a, b);
        let is_lost = middle.high.abs() < SMALL && a != 0.0 && b != 0.0;
        Self {
            middle,
            error: if is_lost { LEAST } else { 0.0 },
        }
    }

    /// The nearest `f64`.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        self.middle.high
    }

    /// By how much the number may be off.
    #[must_use]
    pub fn error(self) -> f64 {
        self.error
    }

    /// `value - self`, to the precision of `f64`.
    #[must_use]
    pub fn distance_to(self, value: f64) -> f64 {
        (value - self.middle.high) - self.middle.low
    }

    /// The sign, if it is certain.
    #[must_use]
    pub fn sign(self) -> Option<Ordering> {
        let middle = self.middle.high;
        if middle.abs() > self.error {
            middle.partial_cmp(&0.0)
        } else {
            (middle == 0.0 && self.error == 0.0).then_some(Ordering::Equal)
        }
    }

    /// Whether the number is certainly zero.
    fn is_zero(self) -> bool {
        self.middle.high == 0.0 && self.error == 0.0
    }

    /// The number times a power of two, exactly.
    #[must_use]
    pub fn scaled(self, power: f64) -> Self {
        Self {
            middle: self.middle.scaled(power),
            error: self.error * power,
        }
    }

    /// The quotient; the divisor must have a certain sign, and not be zero.
    #[must_use]
    pub fn quotient(self, divisor: Self) -> Self {
        let middle = self.middle / divisor.middle;
        let least = divisor.middle.high.abs() - divisor.error;
        Self::rounded(
            middle,
            (self.error + middle.high.abs() * divisor.error) / least * (1.0 + ROUNDED_UP),
        )
    }

    /// The square root of a number that is certainly positive.
    #[must_use]
    pub fn sqrt(self) -> Self {
        let middle = self.middle.sqrt();
        // The root's slope is least at the far end.
        let least = (self.middle.high - self.error).max(0.0).sqrt();
        Self::rounded(middle, self.error / (least + middle.high) * (1.0 + ROUNDED_UP))
    }
}

/// By what the bounds themselves may be rounded down, generously: 2^-40.
const ROUNDED_UP: f64 = 1.0 / (1_u64 << 40) as f64;

/// Below this the low word of a product falls out of the range of `f64`.
const SMALL: f64 = f64::MIN_POSITIVE / ROUNDING;

impl From<f64> for Ball {
    fn from(number: f64) -> Self {
        Self {
            middle: Double::from(number),
            error: 0.0,
        }
    }
}

impl From<&Exact> for Ball {
    fn from(number: &Exact) -> Self {
        let high = number.to_f64();
        let rest = number - &Exact::from(high);
        let low = rest.to_f64();
        let is_exact = (&rest - &Exact::from(low)).is_zero();
        Self {
            middle: Double::sum(high, low),
            error: if is_exact { 0.0 } else { low.abs() * f64::EPSILON + LEAST },
        }
    }
}

impl Add for Ball {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if other.is_zero() {
            return self;
        }
        if self.is_zero() {
            return other;
        }
        Self::rounded(self.middle + other.middle, self.error + other.error)
    }
}

impl Sub for Ball {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Ball {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let middle = self.middle * other.middle;
        let (a, b) = (self.middle.high.abs(), other.middle.high.abs());
        let inherited = a * other.error + b * self.error + self.error * other.error;
        let is_lost = middle.high.abs() < SMALL && a != 0.0 && b != 0.0;
        Self::rounded(middle, if is_lost { inherited + LEAST } else { inherited })
    }
}

impl Neg for Ball {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            middle: -self.middle,
            error: self.error,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Ball;
    use crate::reference::Exact;
    use proptest::prelude::*;

    /// How far a ball is from a number, in shares of what it admits.
    fn is_in(ball: Ball, number: &Exact) -> bool {
        let middle = &Exact::from(ball.middle.high) + &Exact::from(ball.middle.low);
        (&middle - number).abs() <= Exact::from(ball.error)
    }

    /// A ball around a number that three words are needed for.
    fn number(words: [f64; 3]) -> (Ball, Exact) {
        let [a, b, c] = words;
        let exact = &(&Exact::from(a) + &Exact::from(b * 1e-16)) + &Exact::from(c * 1e-32);
        (Ball::from(&exact), exact)
    }

    fn words() -> impl Strategy<Value = [f64; 3]> {
        let word = || prop_oneof![-1e6..1e6_f64, -1e-6..1e-6_f64, (-4..=4_i8).prop_map(f64::from)];
        [word(), word(), word()]
    }

    proptest! {
        /// What comes of any operation is within the bound that comes with it, and the bound is no more than 2^-96.
        #[test]
        fn no_operation_is_worse_than_its_bound(a in words(), b in words()) {
            let ((a, exact_a), (b, exact_b)) = (number(a), number(b));
            prop_assert!(is_in(a, &exact_a) && is_in(b, &exact_b));
            prop_assert!(is_in(a + b, &(&exact_a + &exact_b)));
            prop_assert!(is_in(a - b, &(&exact_a - &exact_b)));
            prop_assert!(is_in(a * b, &(&exact_a * &exact_b)));
            prop_assert!(is_in(Ball::product(a.to_f64(), b.to_f64()), &(Exact::from(a.to_f64()) * Exact::from(b.to_f64()))));
            prop_assert!((a * b).error() <= (a * b).to_f64().abs() * 2e-29);
            if !exact_b.is_zero() {
                prop_assert!(is_in(a.quotient(b), &exact_a.quotient(&exact_b, 200)));
                prop_assert!(a.quotient(b).error() <= a.quotient(b).to_f64().abs() * 2e-29);
            }
            if exact_a.sign().is_gt() {
                prop_assert!(is_in(a.sqrt(), &exact_a.sqrt(200)));
            }
            if let Some(sign) = (a - b).sign() {
                prop_assert_eq!(sign, exact_a.cmp(&exact_b));
            }
        }
    }

    #[test]
    fn what_is_exact_has_no_error() {
        let third = Ball::from(1.0).quotient(Ball::from(3.0));
        assert!(third.error() > 0.0);
        assert_eq!((third - third).sign(), None);
        assert_eq!((Ball::from(3.0) - Ball::from(3.0)).sign(), Some(core::cmp::Ordering::Equal));
        assert_eq!(Ball::ZERO.sign(), Some(core::cmp::Ordering::Equal));
    }
}
