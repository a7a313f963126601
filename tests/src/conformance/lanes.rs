//! Lanes taken apart and put together: what a suite needs of a lane type beyond its arithmetic.

use super::values::Plain;
use gsdf_nostd::{Mask, Real};
use gsdf_parts::Fpu;
use gsdf_simd::{F32x8, LaneMask, Lanes as SimdLanes};

/// An arithmetic whose lanes can be set and read one by one. One impl of a few lines makes a lane type testable.
pub trait Lanes: Real<Scalar: Plain> {
    /// Whether this machine has the instructions that the type is made of.
    #[must_use]
    fn is_here() -> bool {
        true
    }
    /// The value with these lanes.
    fn from_lanes(lane: impl FnMut(usize) -> Self::Scalar) -> Self;
    /// One lane.
    fn lane(self, lane: usize) -> Self::Scalar;
    /// One lane of a mask.
    fn truth(mask: Self::Mask, lane: usize) -> bool;
}

macro_rules! one_lane {
    ($float:ty) => {
        impl Lanes for $float {
            fn from_lanes(mut lane: impl FnMut(usize) -> Self) -> Self {
                lane(0)
            }
            fn lane(self, _: usize) -> Self {
                self
            }
            fn truth(mask: bool, _: usize) -> bool {
                mask
            }
        }
    };
}

one_lane!(f32);
one_lane!(f64);
one_lane!(Fpu);

macro_rules! lanes_of_packets {
    ($type:ty) => {
        impl Lanes for $type {
            fn is_here() -> bool {
                Self::detect().is_some()
            }
            fn from_lanes(lane: impl FnMut(usize) -> f32) -> Self {
                let lanes: Vec<f32> = (0..Self::LANES).map(lane).collect();
                Self::load(Self::detect().expect("a machine that has them"), &lanes)
            }
            fn lane(self, lane: usize) -> f32 {
                SimdLanes::lane(self, lane).expect("a lane of that number")
            }
            fn truth(mask: Self::Mask, lane: usize) -> bool {
                mask.to_bits() >> lane & 1 == 1
            }
        }
    };
}

lanes_of_packets!(F32x8);
#[cfg(target_arch = "x86_64")]
lanes_of_packets!(gsdf_simd::Avx2x8);
#[cfg(target_arch = "x86_64")]
lanes_of_packets!(gsdf_simd::Avx512x16);

/// The mask of these truth values, made by a comparison as every mask is.
#[must_use]
pub fn mask_of<T: Lanes>(mut truth: impl FnMut(usize) -> bool) -> T::Mask {
    let (zero, one) = (T::Scalar::from(0.0), T::Scalar::from(1.0));
    let numbers = T::from_lanes(|lane| if truth(lane) { one } else { zero });
    numbers.lift_like(zero).lt(numbers)
}

/// The truth values of a mask as the bits of a number, and what `any` and `all` make of them.
///
/// # Panics
/// Where `any` or `all` contradict the lanes.
#[must_use]
pub fn bits_of<T: Lanes>(mask: T::Mask) -> u32 {
    let bits = (0..T::LANES).fold(0, |bits, lane| bits | u32::from(T::truth(mask, lane)) << lane);
    assert_eq!(mask.any(), bits != 0, "any of {bits:b}");
    assert_eq!(mask.all(), bits == (1 << T::LANES) - 1, "all of {bits:b}");
    bits
}
