//! The range of numbers in which every formula of this crate is free of overflow and of harmful underflow.
//!
//! With coordinates up to 2^30 and ray directions scaled exactly to a largest component in [1, 2) no product of a formula
//! exceeds 2^84, and the discriminant of a solid of the least size keeps its leading bits above the smallest normal number.
//! Transforms that stretch by at most 2^20 either way take coordinates to 2^52, and directions, again scaled exactly
//! ([`LocalLine`](crate::LocalLine)), to a length of at most 4 and a largest component of at least 2^-12: the largest
//! product, of the discriminant of a rounded cone's side, is then below 2^125. What lies outside is refused where it is made
//! ([`Invalid`](crate::Invalid), [`RayError`](crate::RayError)), so that no query has to look, and none returns a
//! silent wrong answer.

use glam::Vec3;

/// The largest magnitude of a coordinate and of a size: 2^30.
pub const MAX_LENGTH: f32 = 1_073_741_824.0;

/// The least size of a solid: 2^-20.
pub const MIN_LENGTH: f32 = 1.0 / 1_048_576.0;

/// By how much the squared length of a unit vector may differ from one: 2^-21, about two units in the last place of
/// its length.
pub const UNIT_TOLERANCE: f64 = 1.0 / 2_097_152.0;

/// The factor by which a transform may stretch a length, its inverse, and how much more one length than another: 2^20.
pub const MAX_STRETCH: f32 = 1_048_576.0;

/// A ray whose speed towards a plane is below this, in units of a direction with components up to 2, is taken as
/// parallel to it: 2^-100.
pub(crate) const PARALLEL_SPEED: f32 = 1.0 / (1_u128 << 100) as f32;

/// A ray is taken as parallel to an axis when the square of its tilt (the sine of the angle between them) is below
/// this: 2^-64.
pub(crate) const PARALLEL_TILT_SQUARED: f32 = 1.0 / (1_u128 << 64) as f32;

/// The square of a vector that is too short to point anywhere is below this: the least normal number, below which squares
/// lose their digits.
pub(crate) const LEAST_SQUARE: f32 = f32::MIN_POSITIVE;

/// The largest magnitude of the largest component of a direction, and the inverse of the smallest: 2^40.
///
/// Parameters along the ray are in units of the direction, and must neither overflow nor lose digits.
pub const MAX_SPEED: f32 = 1_099_511_627_776.0;

/// The power of two that brings a normal number's magnitude into [1, 2); multiplying by it is exact.
pub(crate) const fn unit_scale(value: f32) -> f32 {
    let exponent = (value.to_bits() >> 23_u32) & 0xff;
    match exponent {
        // The inverse of 2^127 is below the normal numbers. (What is not finite has no scale; the caller refuses it.)
        254.. => f32::from_bits(1 << 22),
        _ => f32::from_bits((254 - exponent) << 23),
    }
}

/// The largest magnitude of a component; NaN counts as larger than infinity.
pub(crate) const fn max_norm(v: Vec3) -> f32 {
    f32::from_bits(max_norm_bits(v))
}

/// The bits of [`max_norm`].
///
/// Magnitudes are ordered as their bits are, with NaN beyond infinity: one comparison of integers finds what is out of
/// range and what is no number at all, also on a processor that has no floating point.
pub(crate) const fn max_norm_bits(v: Vec3) -> u32 {
    let (x, y, z) = (v.x.abs().to_bits(), v.y.abs().to_bits(), v.z.abs().to_bits());
    let most = if x < y { y } else { x };
    if most < z { z } else { most }
}

/// The larger of two numbers, in `const`.
pub(crate) const fn larger(a: f32, b: f32) -> f32 {
    if a < b { b } else { a }
}

#[cfg(test)]
mod tests {
    use super::unit_scale;

    #[test]
    fn scaled_numbers_lie_from_one_to_two() {
        for value in [f32::MIN_POSITIVE, 1.0e-20, 0.75, 1.0, 1.999_999_9, 2.0, 3.0e38, f32::MAX, -5.0] {
            let scale = unit_scale(value);
            assert!((1.0..2.0).contains(&(value * scale).abs()), "{value}");
            assert_eq!(value * scale / scale, value);
        }
    }
}
