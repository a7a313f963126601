//! As many `f64` as a packet has rays.

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};
use gsdf_nostd::{Mask, Real};

/// Several `f64` as one number, for the tier [`Double`](crate::Double): as many as there are `f32` in a type of
/// [`Lanes`](crate::Lanes).
///
/// An array, and loops over it: where the processor has wide vectors of `f64` the compiler makes vectors of them.
#[derive(Clone, Copy, Debug)]
pub struct F64s<const N: usize>([f64; N]);

/// As many truth values.
#[derive(Clone, Copy, Debug)]
pub struct Truths<const N: usize>([bool; N]);

impl<const N: usize> F64s<N> {
    /// These numbers, first to last.
    #[inline(always)]
    #[must_use]
    pub fn from_singles(lanes: &[f32]) -> Self {
        let mut doubles = [0.0; N];
        for (double, single) in doubles.iter_mut().zip(lanes) {
            *double = f64::from(*single);
        }
        Self(doubles)
    }

    /// The nearest `f32` numbers, first to last.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::cast_possible_truncation, reason = "rounding to f32 is what is asked for")]
    pub fn to_singles(self) -> [f32; N] {
        let mut singles = [0.0; N];
        for (single, double) in singles.iter_mut().zip(self.0) {
            *single = double as f32;
        }
        singles
    }
}

macro_rules! by_lane {
    ($type:ident: $($operator:ident $method:ident $symbol:tt),+) => {$(
        impl<const N: usize> $operator for $type<N> {
            type Output = Self;
            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for (lane, other) in self.0.iter_mut().zip(other.0) {
                    *lane $symbol other;
                }
                self
            }
        }
    )+};
}

by_lane! { F64s: Add add +=, Sub sub -=, Mul mul *=, Div div /= }
by_lane! { Truths: BitAnd bitand &=, BitOr bitor |= }

impl<const N: usize> Neg for F64s<N> {
    type Output = Self;
    #[inline(always)]
    fn neg(mut self) -> Self {
        for lane in &mut self.0 {
            *lane = -*lane;
        }
        self
    }
}

impl<const N: usize> Not for Truths<N> {
    type Output = Self;
    #[inline(always)]
    fn not(mut self) -> Self {
        for lane in &mut self.0 {
            *lane = !*lane;
        }
        self
    }
}

impl<const N: usize> Mask for Truths<N> {
    #[inline(always)]
    fn any(self) -> bool {
        let mut any = false;
        for lane in self.0 {
            any |= lane;
        }
        any
    }
    #[inline(always)]
    fn all(self) -> bool {
        !(!self).any()
    }
    #[inline(always)]
    fn splat_like(self, value: bool) -> Self {
        Self([value; N])
    }
}

/// What `f64` itself does with two numbers, lane by lane.
macro_rules! compared {
    ($($name:ident $symbol:tt),+) => {$(
        #[inline(always)]
        fn $name(self, other: Self) -> Truths<N> {
            let mut truths = [false; N];
            for ((truth, a), b) in truths.iter_mut().zip(self.0).zip(other.0) {
                *truth = a $symbol b;
            }
            Truths(truths)
        }
    )+};
}

impl<const N: usize> Real for F64s<N> {
    type Mask = Truths<N>;
    const LANES: usize = N;
    const ROUNDOFF: f32 = <f64 as Real>::ROUNDOFF;
    const INLINED: bool = true;
    type Scalar = f64;

    #[inline(always)]
    fn splat_like(self, value: f32) -> Self {
        Self([f64::from(value); N])
    }
    #[inline(always)]
    fn lift_like(self, value: f64) -> Self {
        Self([value; N])
    }
    #[inline(always)]
    fn sqrt(mut self) -> Self {
        for lane in &mut self.0 {
            *lane = Real::sqrt(*lane);
        }
        self
    }
    #[inline(always)]
    fn abs(mut self) -> Self {
        for lane in &mut self.0 {
            *lane = lane.abs();
        }
        self
    }
    #[inline(always)]
    fn copysign(mut self, sign: Self) -> Self {
        for (lane, sign) in self.0.iter_mut().zip(sign.0) {
            *lane = lane.copysign(sign);
        }
        self
    }
    #[inline(always)]
    fn next_up(mut self) -> Self {
        for lane in &mut self.0 {
            *lane = lane.next_up();
        }
        self
    }
    compared! { lt <, le <=, eq == }
    #[inline(always)]
    fn select(mask: Truths<N>, yes: Self, mut no: Self) -> Self {
        for ((lane, yes), mask) in no.0.iter_mut().zip(yes.0).zip(mask.0) {
            *lane = if mask { yes } else { *lane };
        }
        no
    }
}

#[cfg(test)]
mod tests {
    use super::F64s;
    use gsdf_nostd::{Mask, Real};

    #[test]
    fn lanes_are_numbers_of_their_own() {
        let numbers = F64s::<4>::from_singles(&[1.0, -4.0, 0.25, f32::INFINITY]);
        assert_eq!(numbers.abs().sqrt().to_singles(), [1.0, 2.0, 0.5, f32::INFINITY]);
        let positive = numbers.splat_like(0.0).lt(numbers);
        assert!(positive.any() && !positive.all());
        assert_eq!(
            F64s::select(positive, numbers, -numbers).to_singles(),
            [1.0, 4.0, 0.25, f32::INFINITY]
        );
        // What `f32` would lose.
        assert_eq!((numbers + numbers.splat_like(1e-9) - numbers).to_singles()[0], 1e-9);
    }
}
