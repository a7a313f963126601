//! Pairs of machine numbers that add up to one of 106 bits.
//!
//! The algorithms are those of M. Joldes, J.-M. Muller, V. Popescu, Tight and Rigorous Error Bounds for Basic Building
//! Blocks of Double-Word Arithmetic (2017), by their numbers there, with the bounds proved there; the root is A. Karp's and
//! P. Markstein's. Not the crate `twofloat`, which has the same: its comparisons of `f64` with its own type leave
//! `number < other.into()` ambiguous all over a package that depends on it.

use core::ops::{Add, Div, Mul, Neg, Sub};

/// `high + low`, where `low` is at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Double {
    pub(super) high: f64,
    pub(super) low: f64,
}

impl Double {
    /// The sum of two numbers of which the first is the larger, exactly (algorithm 1).
    fn fast_sum(a: f64, b: f64) -> Self {
        let high = a + b;
        Self { high, low: b - (high - a) }
    }

    /// The sum of two numbers, exactly (algorithm 2).
    pub(super) fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let (a_part, b_part) = (high - b, high - (high - b));
        Self {
            high,
            low: (a - a_part) + (b - b_part),
        }
    }

    /// The product of two numbers, exactly (algorithm 3).
    pub(super) fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        Self {
            high,
            low: a.mul_add(b, -high),
        }
    }

    /// The root of a positive number, to about 2^-102.
    pub(super) fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        let rest = self - Self::product(root, root);
        Self::fast_sum(root, rest.high / (2.0 * root))
    }

    /// The number times a power of two, exactly.
    pub(super) fn scaled(self, power: f64) -> Self {
        Self {
            high: self.high * power,
            low: self.low * power,
        }
    }
}

impl From<f64> for Double {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

impl Neg for Double {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Add for Double {
    type Output = Self;

    /// To 3 * 2^-106 (algorithm 6).
    fn add(self, other: Self) -> Self {
        let (s, t) = (Self::sum(self.high, other.high), Self::sum(self.low, other.low));
        let v = Self::fast_sum(s.high, s.low + t.high);
        Self::fast_sum(v.high, t.low + v.low)
    }
}

impl Sub for Double {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;

    /// To 5 * 2^-106 (algorithm 12).
    fn mul(self, other: Self) -> Self {
        let c = Self::product(self.high, other.high);
        let cross = self.low.mul_add(other.high, self.high.mul_add(other.low, self.low * other.low));
        Self::fast_sum(c.high, c.low + cross)
    }
}

impl Div for Double {
    type Output = Self;

    /// To 15 * 2^-106 (algorithm 17).
    fn div(self, other: Self) -> Self {
        let high = self.high / other.high;
        let product = other * Self::from(high);
        let rest = (self.high - product.high) + (self.low - product.low);
        Self::fast_sum(high, rest / other.high)
    }
}
