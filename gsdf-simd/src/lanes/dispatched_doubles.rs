//! As many `f64` as a [dispatched](super::dispatched) type has `f32`: in two registers of the same width.

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use fearless_simd::prelude::*;
use fearless_simd::x86::{Avx2, Avx512};
use fearless_simd::{f32x8, f32x16, f64x4, f64x8, mask64x4, mask64x8};
use gsdf_nostd::{Mask, Real};

macro_rules! doubles_in_two_registers {
    (
        $(#[$about:meta])* $number:ident($doubles:ident) of $singles:ident, $lanes:literal;
        $(#[$about_mask:meta])* $mask:ident($truths:ident);
        $token:ident
    ) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug)]
        pub struct $number($doubles<$token>, $doubles<$token>);

        $(#[$about_mask])*
        #[derive(Clone, Copy, Debug)]
        pub struct $mask($truths<$token>, $truths<$token>);

        impl $number {
            /// These numbers, exactly.
            #[inline(always)]
            pub(super) fn widened(singles: $singles<$token>) -> Self {
                let (low, high) = singles.widen();
                Self(low, high)
            }

            /// The nearest `f32` numbers.
            #[inline(always)]
            pub(super) fn narrowed(self) -> $singles<$token> {
                self.0.narrow(self.1)
            }
        }

        doubles_in_two_registers! { @by_lane $number: Add add, Sub sub, Mul mul, Div div }
        doubles_in_two_registers! { @by_lane $mask: BitAnd bitand, BitOr bitor }

        impl Neg for $number {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0, -self.1)
            }
        }

        impl Not for $mask {
            type Output = Self;
            #[inline(always)]
            fn not(self) -> Self {
                Self(!self.0, !self.1)
            }
        }

        impl Mask for $mask {
            #[inline(always)]
            fn any(self) -> bool {
                (self.0 | self.1).any_true()
            }
            #[inline(always)]
            fn all(self) -> bool {
                (self.0 & self.1).all_true()
            }
            #[inline(always)]
            fn splat_like(self, value: bool) -> Self {
                let truths = $truths::splat(self.0.token(), value);
                Self(truths, truths)
            }
        }

        impl Real for $number {
            const LANES: usize = $lanes;
            const ROUNDOFF: f32 = <f64 as Real>::ROUNDOFF;
            const INLINED: bool = true;
            type Mask = $mask;
            type Scalar = f64;

            #[inline(always)]
            fn apart<R>(self, work: impl FnOnce() -> R) -> R {
                super::apart(self.0.simd, work)
            }
            #[inline(always)]
            fn splat_like(self, value: f32) -> Self {
                self.lift_like(f64::from(value))
            }
            #[inline(always)]
            fn lift_like(self, value: f64) -> Self {
                let lanes = $doubles::splat(self.0.simd, value);
                Self(lanes, lanes)
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(self.0.sqrt(), self.1.sqrt())
            }
            #[inline(always)]
            fn abs(self) -> Self {
                Self(self.0.abs(), self.1.abs())
            }
            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                Self(self.0.copysign(sign.0), self.1.copysign(sign.1))
            }
            #[inline(always)]
            fn next_up(self) -> Self {
                let mut halves: [[f64; $lanes / 2]; 2] = [self.0.into(), self.1.into()];
                for number in halves.as_flattened_mut() {
                    *number = number.next_up();
                }
                let [low, high] = halves;
                Self($doubles::simd_from(self.0.simd, low), $doubles::simd_from(self.0.simd, high))
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                $mask(self.0.simd_lt(other.0), self.1.simd_lt(other.1))
            }
            #[inline(always)]
            fn le(self, other: Self) -> $mask {
                $mask(self.0.simd_le(other.0), self.1.simd_le(other.1))
            }
            #[inline(always)]
            fn eq(self, other: Self) -> $mask {
                $mask(self.0.simd_eq(other.0), self.1.simd_eq(other.1))
            }
            #[inline(always)]
            fn select(mask: $mask, yes: Self, no: Self) -> Self {
                Self(mask.0.select(yes.0, no.0), mask.1.select(yes.1, no.1))
            }
            #[inline(always)]
            fn min(self, other: Self) -> Self {
                Self(self.0.min(other.0), self.1.min(other.1))
            }
            #[inline(always)]
            fn max(self, other: Self) -> Self {
                Self(self.0.max(other.0), self.1.max(other.1))
            }
        }
    };
    (@by_lane $type:ident: $($operator:ident $method:ident),+) => {$(
        impl $operator for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self($operator::$method(self.0, other.0), $operator::$method(self.1, other.1))
            }
        }
    )+};
}

doubles_in_two_registers! {
    /// Eight `f64` in two registers of AVX2.
    Avx2Doubles(f64x4) of f32x8, 8;
    /// Eight truth values in two registers of AVX2.
    Avx2WideMask(mask64x4);
    Avx2
}

doubles_in_two_registers! {
    /// Sixteen `f64` in two registers of AVX-512.
    Avx512Doubles(f64x8) of f32x16, 16;
    /// Sixteen truth values in two mask registers of AVX-512.
    Avx512WideMask(mask64x8);
    Avx512
}
