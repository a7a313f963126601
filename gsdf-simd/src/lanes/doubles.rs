//! Eight `f64` in whatever vectors the target has: what a packet of eight becomes in the tier
//! [`Double`](crate::Double).

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use gsdf_nostd::{Mask, Real};
use wide::f64x8;

/// Eight `f64`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct F64x8(f64x8);

/// Eight truth values: lanes of all ones or all zeros.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct WideMask8(f64x8);

impl F64x8 {
    /// These numbers, exactly.
    #[inline(always)]
    #[must_use]
    pub fn from_singles(lanes: [f32; 8]) -> Self {
        Self(f64x8::new(lanes.map(f64::from)))
    }

    /// The nearest `f32` numbers.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "rounding to f32 is what is asked for")]
    pub fn to_singles(self) -> [f32; 8] {
        self.0.to_array().map(|lane| lane as f32)
    }
}

macro_rules! by_lane {
    ($type:ident: $($operator:ident $method:ident $symbol:tt),+) => {$(
        impl $operator for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0 $symbol other.0)
            }
        }
    )+};
}

by_lane! { F64x8: Add add +, Sub sub -, Mul mul *, Div div / }
by_lane! { WideMask8: BitAnd bitand &, BitOr bitor | }

impl Neg for F64x8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(self.0 ^ f64x8::splat(-0.0))
    }
}

#[inline(always)]
fn ones() -> f64x8 {
    f64x8::splat(f64::from_bits(u64::MAX))
}

impl Not for WideMask8 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0 ^ ones())
    }
}

impl Mask for WideMask8 {
    #[inline(always)]
    fn any(self) -> bool {
        self.0.any()
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.0.all()
    }
    #[inline(always)]
    fn splat_like(self, value: bool) -> Self {
        if value { Self(ones()) } else { Self(f64x8::splat(0.0)) }
    }
}

impl Real for F64x8 {
    const LANES: usize = 8;
    const ROUNDOFF: f32 = <f64 as Real>::ROUNDOFF;
    type Mask = WideMask8;
    type Scalar = f64;

    #[inline(always)]
    fn splat_like(self, value: f32) -> Self {
        Self(f64x8::splat(f64::from(value)))
    }
    #[inline(always)]
    fn lift_like(self, value: f64) -> Self {
        Self(f64x8::splat(value))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0 & f64x8::splat(f64::from_bits(u64::MAX >> 1)))
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.abs().0 | (sign.0 & f64x8::splat(-0.0)))
    }
    #[inline(always)]
    fn next_up(self) -> Self {
        Self(f64x8::new(self.0.to_array().map(f64::next_up)))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> WideMask8 {
        WideMask8(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn le(self, other: Self) -> WideMask8 {
        WideMask8(self.0.simd_le(other.0))
    }
    #[inline(always)]
    fn eq(self, other: Self) -> WideMask8 {
        WideMask8(self.0.simd_eq(other.0))
    }
    #[inline(always)]
    fn select(mask: WideMask8, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }
}

#[cfg(test)]
mod tests {
    use super::F64x8;
    use gsdf_nostd::{Mask, Real};

    #[test]
    fn lanes_are_numbers_of_their_own() {
        let numbers = F64x8::from_singles([1.0, -4.0, 0.25, f32::INFINITY, 9.0, 16.0, 0.0, -0.0]);
        let roots = [1.0, 2.0, 0.5, f32::INFINITY, 3.0, 4.0, 0.0, 0.0];
        assert_eq!(numbers.abs().sqrt().to_singles(), roots);
        let positive = numbers.splat_like(0.0).lt(numbers);
        assert!(positive.any() && !positive.all() && (positive | !positive).all());
        assert_eq!(F64x8::select(positive, numbers, -numbers).to_singles()[1], 4.0);
        assert_eq!((-numbers).copysign(numbers), numbers);
        // What `f32` would lose.
        assert_eq!(
            (numbers + numbers.splat_like(1e-9) - numbers).to_singles()[0],
            (1.0 + f64::from(1e-9_f32) - 1.0) as f32
        );
    }
}
