//! Lanes in registers that not every x86-64 processor has, for builds that have to run on all of them.
//!
//! The values of these types carry a token, which exists only where the processor was asked and has the instructions.
//! Their operations become single instructions where all of it lands inside one function that is compiled for them:
//! see [`Lanes::vectorize`]. Anywhere else they are right, and slow.
//!
//! Only operations that round correctly are taken from `fearless_simd`: not its fused or estimated ones.

use super::dispatched_doubles::{Avx2Doubles, Avx512Doubles};
use super::{LaneMask, Lanes, padded, put};
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use fearless_simd::prelude::*;
use fearless_simd::x86::{Avx2, Avx512};
use fearless_simd::{Level, f32x8, f32x16, i32x8, i32x16, mask32x8, mask32x16};
use gsdf_nostd::{Mask, Real};

macro_rules! lanes_in_a_register {
    (
        $(#[$about:meta])* $number:ident($floats:ident, $integers:ident), $lanes:literal;
        $(#[$about_mask:meta])* $mask:ident($truths:ident);
        $doubles:ident, $token:ident, $has:ident
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub struct $number($floats<$token>);

        $(#[$about_mask])*
        #[derive(Clone, Copy, Debug)]
        #[repr(transparent)]
        pub struct $mask($truths<$token>);

        lanes_in_a_register! { @by_lane $number: Add add, Sub sub, Mul mul, Div div }
        lanes_in_a_register! { @by_lane $mask: BitAnd bitand, BitOr bitor }

        impl Neg for $number {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0)
            }
        }

        impl Mask for $mask {
            #[inline(always)]
            fn any(self) -> bool {
                self.0.any_true()
            }
            #[inline(always)]
            fn all(self) -> bool {
                self.0.all_true()
            }
            #[inline(always)]
            fn splat_like(self, value: bool) -> Self {
                Self($truths::splat(self.0.token(), value))
            }
            #[inline(always)]
            fn differs_from(self, other: Self) -> Self {
                Self(self.0 ^ other.0)
            }
        }

        impl LaneMask for $mask {
            #[inline(always)]
            #[allow(clippy::cast_possible_truncation, reason = "there are no more bits than lanes")]
            fn to_bits(self) -> u32 {
                self.0.to_bitmask() as u32
            }
        }

        impl Real for $number {
            const LANES: usize = $lanes;
            const INLINED: bool = true;
            type Mask = $mask;
            type Scalar = f32;

            #[inline(always)]
            fn apart<R>(self, work: impl FnOnce() -> R) -> R {
                super::apart(self.0.simd, work)
            }
            #[inline(always)]
            fn splat_like(self, value: f32) -> Self {
                Self::splat(self.0.simd, value)
            }
            #[inline(always)]
            fn lift_like(self, value: f32) -> Self {
                Self::splat(self.0.simd, value)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt())
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self(self.0.abs())
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                Self(self.0.copysign(sign.0))
            }
            #[inline(always)]
            fn next_up(self) -> Self {
                // The bits of positive numbers ascend with them, those of negative ones descend; adding zero leaves no
                // -0.
                let bits: $integers<$token> = (self.0 + 0.0).bitcast();
                let next = (bits + ((bits >> 31) | 1)).bitcast();
                Self::select(self.lt(self.splat_like(f32::INFINITY)), Self(next), self)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                $mask(self.0.simd_lt(other.0))
            }
            #[inline(always)]
            fn le(self, other: Self) -> $mask {
                $mask(self.0.simd_le(other.0))
            }
            #[inline(always)]
            fn eq(self, other: Self) -> $mask {
                $mask(self.0.simd_eq(other.0))
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                Self(mask.0.select(yes.0, no.0))
            }
            // The processor's own minimum and maximum are the contract: the second operand where either is NaN or both
            // are equal.
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(self.0.min(other.0))
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(self.0.max(other.0))
            }
        }

        impl Lanes for $number {
            type Token = $token;
            type Array = [f32; $lanes];
            type Doubles = $doubles;

            fn detect() -> Option<$token> {
                Level::new().$has()
            }
            #[inline(always)]
            fn splat(token: $token, value: f32) -> Self {
                Self($floats::splat(token, value))
            }
            #[inline(always)]
            fn load(token: $token, lanes: &[f32]) -> Self {
                Self($floats::simd_from(token, padded::<$lanes>(lanes)))
            }
            #[inline(always)]
            fn token(self) -> $token {
                self.0.simd
            }
            #[inline(always)]
            fn to_array(self) -> [f32; $lanes] {
                self.0.into()
            }
            #[inline(always)]
            fn to_doubles(self) -> $doubles {
                $doubles::widened(self.0)
            }
            #[inline(always)]
            fn from_doubles(_: $token, doubles: $doubles) -> Self {
                Self(doubles.narrowed())
            }
            #[inline(always)]
            fn store(self, place: &mut [f32]) {
                put(self.to_array(), place);
            }
            #[inline(always)]
            fn power_of_two_below(self) -> Self {
                let bits: $integers<$token> = self.0.bitcast();
                Self((bits & f32::INFINITY.to_bits().cast_signed()).bitcast())
            }
            #[inline(always)]
            fn per_power_of_two_below(self) -> Self {
                let bits: $integers<$token> = self.power_of_two_below().0.bitcast();
                Self(($integers::splat(self.0.simd, 254 << 23) - bits).bitcast())
            }
            #[inline(always)]
            fn store_numbers(self, place: &mut [u32]) {
                let infinite = self.0.simd_eq(f32::INFINITY);
                let numbers: $integers<$token> = self.0.to_int();
                let numbers: [i32; $lanes] = infinite.select($integers::splat(self.0.simd, -1), numbers).into();
                put(numbers.map(i32::cast_unsigned), place);
            }
            #[inline(always)]
            fn least(self) -> f32 {
                self.0.reduce_min()
            }
            #[inline(always)]
            fn greatest(self) -> f32 {
                self.0.reduce_max()
            }
            #[inline(always)]
            fn vectorize<R>(token: $token, work: impl FnOnce() -> R) -> R {
                token.vectorize(work)
            }
        }
    };
    (@by_lane $type:ident: $($operator:ident $method:ident),+) => {$(
        impl $operator for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self($operator::$method(self.0, other.0))
            }
        }
    )+};
}

lanes_in_a_register! {
    /// Eight `f32` in one register of AVX2.
    Avx2x8(f32x8, i32x8), 8;
    /// Eight truth values in one register of AVX2.
    Avx2Mask(mask32x8);
    Avx2Doubles, Avx2, as_avx2
}

lanes_in_a_register! {
    /// Sixteen `f32` in one register of AVX-512.
    Avx512x16(f32x16, i32x16), 16;
    /// Sixteen truth values in one mask register of AVX-512.
    Avx512Mask(mask32x16);
    Avx512Doubles, Avx512, as_avx512
}
