//! Eight `f32` in whatever vectors the target has: the portable packet.

use super::{F64x8, LaneMask, Lanes, padded, put};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use gsdf_nostd::{Mask, Real};
use wide::f32x8;

/// Eight `f32`: one AVX register, or two of SSE2, NEON or wasm's simd128, or plain numbers elsewhere.
///
/// Only operations that round correctly are taken from `wide`: not its fused or estimated ones, and not its `min` and
/// `max`, which treat NaN and signed zeros by target.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(transparent)]
pub struct F32x8(f32x8);

/// Eight truth values: lanes of all ones or all zeros.
#[derive(Clone, Copy, Debug)]
#[repr(transparent)]
pub struct Mask8(f32x8);

impl F32x8 {
    /// The lanes, first to last.
    #[inline(always)]
    #[must_use]
    pub fn new(lanes: [f32; 8]) -> Self {
        Self(f32x8::new(lanes))
    }

    /// Infinity in every lane.
    pub const INFINITY: Self = Self(f32x8::new([f32::INFINITY; 8]));
    /// Negative infinity in every lane.
    pub const NEG_INFINITY: Self = Self(f32x8::new([f32::NEG_INFINITY; 8]));

    /// The same number in every lane.
    #[inline(always)]
    #[must_use]
    pub fn splat(value: f32) -> Self {
        Self(f32x8::splat(value))
    }

    /// The lanes, first to last.
    #[inline(always)]
    #[must_use]
    pub fn to_array(self) -> [f32; 8] {
        self.0.to_array()
    }
}

impl Mask8 {
    /// Truth values from the bits of a number, the lowest bit for the first lane.
    #[inline(always)]
    #[must_use]
    pub fn from_bits(bits: u8) -> Self {
        let lane = |lane: u32| f32::from(bits >> lane & 1);
        Self(f32x8::new([lane(0), lane(1), lane(2), lane(3), lane(4), lane(5), lane(6), lane(7)]).simd_gt(f32x8::splat(0.5)))
    }

    /// The truth values as the bits of a number, the lowest bit for the first lane.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "eight lanes have eight bits")]
    pub fn to_bits(self) -> u8 {
        self.0.to_bitmask() as u8
    }
}

macro_rules! lane_by_lane {
    ($operator:ident, $method:ident) => {
        impl $operator for F32x8 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self($operator::$method(self.0, other.0))
            }
        }
    };
}

lane_by_lane!(Add, add);
lane_by_lane!(Sub, sub);
lane_by_lane!(Mul, mul);
lane_by_lane!(Div, div);

impl Neg for F32x8 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // The sign bit, flipped: not a subtraction from zero.
        Self(self.0 ^ f32x8::splat(-0.0))
    }
}

impl BitAnd for Mask8 {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl BitOr for Mask8 {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl Not for Mask8 {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(self.0 ^ ones())
    }
}

#[inline(always)]
fn ones() -> f32x8 {
    f32x8::splat(f32::from_bits(u32::MAX))
}

impl Mask for Mask8 {
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
        if value { Self(ones()) } else { Self(f32x8::splat(0.0)) }
    }
    #[inline(always)]
    fn differs_from(self, other: Self) -> Self {
        Self(self.0 ^ other.0)
    }
}

impl Real for F32x8 {
    const LANES: usize = 8;
    type Mask = Mask8;
    type Scalar = f32;

    #[inline(always)]
    fn splat_like(self, value: f32) -> Self {
        Self::splat(value)
    }
    #[inline(always)]
    fn lift_like(self, value: f32) -> Self {
        Self::splat(value)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0 & f32x8::splat(f32::from_bits(0x7fff_ffff)))
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        let bit = f32x8::splat(-0.0);
        Self((self.0 & f32x8::splat(f32::from_bits(0x7fff_ffff))) | (sign.0 & bit))
    }
    #[inline(always)]
    fn next_up(self) -> Self {
        // The bits of positive numbers ascend with them, those of negative ones descend; adding zero leaves no -0.
        let step = |lane: f32| {
            let bits = lane.to_bits().cast_signed();
            f32::from_bits(bits.wrapping_add(1 | bits >> 31).cast_unsigned())
        };
        let next = f32x8::new((self.0 + f32x8::splat(0.0)).to_array().map(step));
        Self::select(self.lt(Self::INFINITY), Self(next), self)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Mask8 {
        Mask8(self.0.simd_lt(other.0))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Mask8 {
        Mask8(self.0.simd_le(other.0))
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Mask8 {
        Mask8(self.0.simd_eq(other.0))
    }
    #[inline(always)]
    fn select(mask: Mask8, yes: Self, no: Self) -> Self {
        Self(mask.0.select(yes.0, no.0))
    }
    // x86's own minimum and maximum are the contract: the second operand where either is NaN or both are equal.
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.fast_min(other.0))
    }
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.fast_max(other.0))
    }
}

impl Lanes for F32x8 {
    type Token = ();
    type Array = [f32; 8];
    type Doubles = F64x8;

    fn detect() -> Option<()> {
        Some(())
    }
    #[inline(always)]
    fn splat((): (), value: f32) -> Self {
        Self(f32x8::splat(value))
    }
    #[inline(always)]
    fn load((): (), lanes: &[f32]) -> Self {
        Self::new(padded(lanes))
    }
    #[inline(always)]
    fn token(self) {}
    #[inline(always)]
    fn to_array(self) -> [f32; 8] {
        Self::to_array(self)
    }
    #[inline(always)]
    fn to_doubles(self) -> F64x8 {
        F64x8::from_singles(self.to_array())
    }
    #[inline(always)]
    fn from_doubles((): (), doubles: F64x8) -> Self {
        Self::new(doubles.to_singles())
    }
    #[inline(always)]
    fn store(self, place: &mut [f32]) {
        put(self.to_array(), place);
    }
    #[inline(always)]
    fn power_of_two_below(self) -> Self {
        Self(self.0 & f32x8::splat(f32::INFINITY))
    }
    #[inline(always)]
    fn per_power_of_two_below(self) -> Self {
        Self::splat(1.0) / self.power_of_two_below()
    }
    #[inline(always)]
    fn store_numbers(self, place: &mut [u32]) {
        // A mask is all ones where it is true: what infinity is to become. Elsewhere the numbers convert exactly.
        let infinite = self.0.simd_eq(f32x8::splat(f32::INFINITY)).to_array();
        let numbers = Self::select(Mask8(f32x8::new(infinite)), Self::splat(0.0), self);
        let numbers = numbers.0.fast_trunc_int().to_array();
        let mut lanes = [0; 8];
        for (lane, (number, infinite)) in lanes.iter_mut().zip(numbers.into_iter().zip(infinite)) {
            *lane = number.cast_unsigned() | infinite.to_bits();
        }
        put(lanes, place);
    }
    #[inline(always)]
    fn least(self) -> f32 {
        let [a, b, c, d, e, f, g, h] = self.to_array();
        a.min(b).min(c.min(d)).min(e.min(f).min(g.min(h)))
    }
    #[inline(always)]
    fn greatest(self) -> f32 {
        let [a, b, c, d, e, f, g, h] = self.to_array();
        a.max(b).max(c.max(d)).max(e.max(f).max(g.max(h)))
    }
    // A function of its own here too: what is asked for in many places, such as the formulas of all solids, stands once.
    #[inline(never)]
    fn vectorize<R>((): (), work: impl FnOnce() -> R) -> R {
        work()
    }
}

impl LaneMask for Mask8 {
    #[inline(always)]
    fn to_bits(self) -> u32 {
        u32::from(Self::to_bits(self))
    }
}
