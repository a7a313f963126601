//! Lane types: how several numbers are one.

#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod dispatched;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
mod dispatched_doubles;
mod doubles;
mod wide;

#[cfg(all(feature = "std", target_arch = "x86_64"))]
pub use dispatched::{Avx2Mask, Avx2x8, Avx512Mask, Avx512x16};
#[cfg(all(feature = "std", target_arch = "x86_64"))]
pub use dispatched_doubles::{Avx2Doubles, Avx2WideMask, Avx512Doubles, Avx512WideMask};
pub use doubles::{F64x8, WideMask8};
pub use wide::{F32x8, Mask8};

use gsdf_nostd::{Mask, Real};

/// The most lanes that a type of this crate has: an array that takes those of any type is this long.
pub const MOST_LANES: usize = 16;

/// Several `f32` as one number: what a packet of rays is made of. [`Real::LANES`] says how many.
///
/// Some types can only be made where the processor is known to have their instructions. Their values carry a token
/// that proves it, and new ones are made from that; [`F32x8`] needs none.
pub trait Lanes: Real<Scalar = f32, Mask: LaneMask> + Send + Sync + 'static {
    /// What values are made from.
    type Token: Copy + Send + Sync;
    /// The lanes one by one.
    type Array: AsRef<[f32]>;
    /// As many `f64`.
    type Doubles: Real<Scalar = f64>;

    /// What values are made from, if this machine has the instructions they need. The processor is asked once.
    #[must_use]
    fn detect() -> Option<Self::Token>;
    /// The same number in every lane.
    #[must_use]
    fn splat(token: Self::Token, value: f32) -> Self;
    /// The first numbers of a slice, first to last; zero in the lanes beyond its end.
    #[must_use]
    fn load(token: Self::Token, lanes: &[f32]) -> Self;
    /// What other values can be made from.
    #[must_use]
    fn token(self) -> Self::Token;
    /// The lanes, first to last.
    #[must_use]
    fn to_array(self) -> Self::Array;
    /// The lanes as `f64`.
    #[must_use]
    fn to_doubles(self) -> Self::Doubles;
    /// The nearest numbers to so many `f64`.
    #[must_use]
    fn from_doubles(token: Self::Token, doubles: Self::Doubles) -> Self;
    /// Puts the lanes into a slice, first to last, as far as it reaches.
    fn store(self, place: &mut [f32]);
    /// The power of two at or below each lane, for positive normal numbers: their exponent bits alone.
    #[must_use]
    fn power_of_two_below(self) -> Self;
    /// The inverse of that power of two, for numbers from 2^-126 to 2^126.
    #[must_use]
    fn per_power_of_two_below(self) -> Self;
    /// Puts the lanes into a slice as integers, first to last, as far as it reaches: whole numbers from 0 to 2^24, and
    /// `u32::MAX` for infinity.
    fn store_numbers(self, place: &mut [u32]);
    /// The least lane. Either zero if both are least; some number or NaN if a lane is NaN.
    #[must_use]
    fn least(self) -> f32;
    /// The greatest lane. Either zero if both are greatest; some number or NaN if a lane is NaN.
    #[must_use]
    fn greatest(self) -> f32;

    /// Does work that is compiled for the instructions which the token proves.
    ///
    /// That holds for what is inlined into it: a closure under `#[inline(always)]` and generic functions under it
    /// too. What they call instead is compiled as the rest of the program is.
    fn vectorize<R>(token: Self::Token, work: impl FnOnce() -> R) -> R;

    /// One lane, if there is one of that number.
    #[inline(always)]
    #[must_use]
    fn lane(self, lane: usize) -> Option<f32> {
        self.to_array().as_ref().get(lane).copied()
    }
}

/// The truth values of [`Lanes`].
pub trait LaneMask: Mask {
    /// The truth values as the bits of a number, the lowest bit for the first lane; zeros beyond the last.
    #[must_use]
    fn to_bits(self) -> u32;
}

/// Does work in a function of its own, compiled for some instructions.
///
/// Not only must it not become part of what calls it: a function that is called from one place alone always would.
#[cfg(all(feature = "std", target_arch = "x86_64"))]
#[inline(never)]
fn apart<S: fearless_simd::Simd, R>(simd: S, work: impl FnOnce() -> R) -> R {
    simd.vectorize(work)
}

/// The first numbers of a slice, and zeros after its end.
#[inline(always)]
fn padded<const N: usize>(numbers: &[f32]) -> [f32; N] {
    match numbers.first_chunk() {
        Some(whole) => *whole,
        None => {
            let mut padded = [0.0; N];
            for (place, number) in padded.iter_mut().zip(numbers) {
                *place = *number;
            }
            padded
        }
    }
}

/// Puts numbers into a slice, as far as it reaches.
#[inline(always)]
fn put<N: Copy, const LANES: usize>(numbers: [N; LANES], place: &mut [N]) {
    match place.first_chunk_mut() {
        Some(whole) => *whole = numbers,
        None => {
            for (place, number) in place.iter_mut().zip(numbers) {
                *place = number;
            }
        }
    }
}
