//! A place on a line where a polynomial vanishes, or an infinite end of the line.

use core::cmp::Ordering;

use super::number::Exact;

/// Two roots whose difference is at most `2^-EQUAL_RELATIVE` of the larger one are one root.
const EQUAL_RELATIVE: isize = 250;
/// Two roots whose difference is at most `2^-EQUAL_ABSOLUTE` are one root, so that zero can have company.
const EQUAL_ABSOLUTE: isize = 400;

/// A parameter `t` along a line, right to more than 300 bits, or one of the two ends of the line.
///
/// Two roots that agree to 250 bits count as one place. This is the one limit of the reference: it could not tell
/// apart two crossings which are nearer than that without being equal. For coordinates which are ordinary `f32` that
/// does not happen by chance, as such roots are numbers of far fewer bits or square roots of them.
#[derive(Clone, Debug)]
pub enum Root {
    /// The line comes from infinitely far.
    NegativeInfinity,
    /// A finite parameter.
    Finite(Exact),
    /// The line goes on for ever.
    PositiveInfinity,
}

impl Root {
    /// The order along the line; roots that agree to 250 bits are equal.
    ///
    /// Not `Ord`, as this equality is not transitive.
    #[must_use]
    pub fn compare(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Finite(a), Self::Finite(b)) if agree(a, b) => Ordering::Equal,
            (Self::Finite(a), Self::Finite(b)) => a.cmp(b),
            _ => self.rank().cmp(&other.rank()),
        }
    }

    /// Where among the two ends and the finite parameters between them.
    fn rank(&self) -> i8 {
        match self {
            Self::NegativeInfinity => -1,
            Self::Finite(_) => 0,
            Self::PositiveInfinity => 1,
        }
    }

    /// The parameter, unless this is an end of the line.
    #[must_use]
    pub fn finite(&self) -> Option<&Exact> {
        match self {
            Self::Finite(t) => Some(t),
            Self::NegativeInfinity | Self::PositiveInfinity => None,
        }
    }

    /// The nearest `f64`, ties to even.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        match self {
            Self::NegativeInfinity => f64::NEG_INFINITY,
            Self::Finite(t) => t.to_f64(),
            Self::PositiveInfinity => f64::INFINITY,
        }
    }

    /// The nearest `f32`, ties to even.
    #[must_use]
    pub fn to_f32(&self) -> f32 {
        match self {
            Self::NegativeInfinity => f32::NEG_INFINITY,
            Self::Finite(t) => t.to_f32(),
            Self::PositiveInfinity => f32::INFINITY,
        }
    }

    /// `value - self`: positive where the value lies beyond the root.
    ///
    /// Subtracted exactly and rounded once. An infinite value is infinitely far from any root but the same infinity.
    #[must_use]
    pub fn signed_error(&self, value: f32) -> f64 {
        self.error_in_units(value, 0)
    }

    /// The distance of the value from the root in units of the last place of the `f32` nearest to the root.
    ///
    /// The unit is the gap between that `f32` and the next larger magnitude; around zero it is the least subnormal
    /// number, and beyond the largest finite number it stays what it is there.
    #[must_use]
    pub fn error_ulps(&self, value: f32) -> f64 {
        self.error_in_units(value, ulp_exponent(self.to_f32())).abs()
    }

    /// `(value - self) / 2^exponent`.
    fn error_in_units(&self, value: f32, exponent: isize) -> f64 {
        match self {
            Self::Finite(t) if value.is_finite() => (&Exact::from(value) - t).scaled(-exponent).to_f64(),
            // Both sides are now infinite in at least one place, so machine arithmetic is exact, but for ∞ - ∞.
            _ if f64::from(value) == self.to_f64() && self.finite().is_none() => 0.0,
            Self::Finite(_) => f64::from(value),
            Self::NegativeInfinity | Self::PositiveInfinity => f64::from(value) - self.to_f64(),
        }
    }
}

impl From<f64> for Root {
    /// # Panics
    ///
    /// If the number is not a number.
    fn from(number: f64) -> Self {
        match number {
            f64::NEG_INFINITY => Self::NegativeInfinity,
            f64::INFINITY => Self::PositiveInfinity,
            finite => Self::Finite(Exact::from(finite)),
        }
    }
}

/// Whether two finite roots are one place.
pub(super) fn agree(a: &Exact, b: &Exact) -> bool {
    let difference = (a - b).abs();
    difference <= Exact::ONE.scaled(-EQUAL_ABSOLUTE) || {
        let larger = a.abs().max(b.abs());
        difference <= larger.scaled(-EQUAL_RELATIVE)
    }
}

/// The exponent of the unit in the last place of a number.
fn ulp_exponent(number: f32) -> isize {
    const SMALLEST: u32 = 1;
    const LARGEST: u32 = 254;
    let biased = (number.to_bits() >> 23) & 0xff;
    // At most 254, so the cast is exact.
    biased.clamp(SMALLEST, LARGEST) as isize - 150
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_counted_in_last_places() {
        let one = Root::from(1.0);
        assert_eq!(one.error_ulps(1.0), 0.0);
        assert_eq!(one.error_ulps(1.0_f32.next_up()), 1.0);
        assert_eq!(one.error_ulps(1.0_f32.next_down()), 0.5);
        assert_eq!(one.signed_error(1.0_f32.next_down()), -f64::powi(2.0, -24));
        assert_eq!(one.error_ulps(f32::INFINITY), f64::INFINITY);
        assert!(one.error_ulps(f32::NAN).is_nan());

        let third = Root::Finite(Exact::ONE.quotient(&Exact::from(3), 320));
        assert_eq!(third.to_f64(), 1.0 / 3.0);
        assert_eq!(third.to_f32(), 1.0 / 3.0);
        assert_eq!(third.error_ulps(1.0 / 3.0), 1.0 / 3.0);
        assert!(third.signed_error(1.0 / 3.0) > 0.0);

        let zero = Root::from(0.0);
        assert_eq!(zero.error_ulps(-0.0), 0.0);
        assert_eq!(zero.error_ulps(f32::from_bits(3)), 3.0);

        assert_eq!(Root::from(f64::from(f32::MAX)).error_ulps(f32::MAX.next_down()), 1.0);
        assert_eq!(Root::from(1e39).error_ulps(f32::INFINITY), f64::INFINITY);
        assert_eq!(Root::PositiveInfinity.error_ulps(f32::INFINITY), 0.0);
        assert_eq!(Root::NegativeInfinity.error_ulps(f32::INFINITY), f64::INFINITY);
        assert_eq!(Root::NegativeInfinity.signed_error(3.0), f64::INFINITY);
        assert_eq!(Root::PositiveInfinity.signed_error(3.0), f64::NEG_INFINITY);
    }

    #[test]
    fn order_along_the_line() {
        let third = Exact::ONE.quotient(&Exact::from(3), 320);
        let other = Exact::from(2).quotient(&Exact::from(6), 310);
        assert!(Root::Finite(third.clone()).compare(&Root::Finite(other)).is_eq());
        let beyond = &third + &Exact::ONE.scaled(-240);
        assert!(Root::Finite(third).compare(&Root::Finite(beyond)).is_lt());
        assert!(Root::from(0.0).compare(&Root::Finite(Exact::ONE.scaled(-401))).is_eq());
        assert!(Root::from(0.0).compare(&Root::Finite(Exact::ONE.scaled(-300))).is_lt());
        assert!(Root::NegativeInfinity.compare(&Root::from(-1e300)).is_lt());
        assert!(Root::PositiveInfinity.compare(&Root::from(1e300)).is_gt());
        assert!(Root::PositiveInfinity.compare(&Root::from(f64::INFINITY)).is_eq());
    }
}
