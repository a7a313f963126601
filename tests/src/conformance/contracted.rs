//! The arithmetic of a compiler that contracts a product and a sum to one fused multiply-add: what no lane type may be.
//!
//! Each of its operations, taken alone, is that of `f32`, so that no test of single operations can tell the two apart.
//! Only whole formulas can, and the golden hashes must.

use core::cmp::Ordering;
use core::ops::{Add, Div, Mul, Neg, Sub};
use gsdf_nostd::{Lane, Real};

/// An `f32` that remembers the product it came from, until it is added to something.
#[derive(Clone, Copy, Debug)]
pub struct Contracted {
    value: f32,
    factors: Option<(f32, f32)>,
}

impl From<f32> for Contracted {
    fn from(value: f32) -> Self {
        Self { value, factors: None }
    }
}

impl PartialEq for Contracted {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Contracted {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl Add for Contracted {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        match (self.factors, other.factors) {
            (Some((a, b)), _) => a.mul_add(b, other.value).into(),
            (None, Some((a, b))) => a.mul_add(b, self.value).into(),
            (None, None) => (self.value + other.value).into(),
        }
    }
}

impl Sub for Contracted {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Contracted {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self {
            value: self.value * other.value,
            factors: Some((self.value, other.value)),
        }
    }
}

impl Div for Contracted {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        (self.value / other.value).into()
    }
}

impl Neg for Contracted {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            factors: self.factors.map(|(a, b)| (-a, b)),
        }
    }
}

impl Real for Contracted {
    const LANES: usize = 1;
    type Mask = bool;
    type Scalar = Self;

    fn splat_like(self, value: f32) -> Self {
        value.into()
    }
    fn lift_like(self, value: Self) -> Self {
        value
    }
    fn sqrt(self) -> Self {
        self.value.sqrt().into()
    }
    fn abs(self) -> Self {
        self.value.abs().into()
    }
    fn copysign(self, sign: Self) -> Self {
        self.value.copysign(sign.value).into()
    }
    fn next_up(self) -> Self {
        self.value.next_up().into()
    }
    fn lt(self, other: Self) -> bool {
        self.value < other.value
    }
    fn le(self, other: Self) -> bool {
        self.value <= other.value
    }
    fn eq(self, other: Self) -> bool {
        self.value == other.value
    }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

impl Lane for Contracted {
    fn to_f32(self) -> f32 {
        self.value
    }
    fn to_index(self) -> u32 {
        self.value.to_index()
    }
}
