//! Three numbers of any arithmetic: what [`glam::Vec3`] becomes inside a formula.

use crate::range::LEAST_SQUARE;
use crate::real::Real;
use core::ops::{Add, Neg, Sub};
use glam::Vec3;

/// A point or a vector in space, in the arithmetic `T`.
///
/// Sums are taken in one written order, x, then y, then z, so that every arithmetic of the same precision gives the
/// same bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct V3<T> {
    /// First coordinate.
    pub x: T,
    /// Second coordinate.
    pub y: T,
    /// Third coordinate.
    pub z: T,
}

impl<T: Real> V3<T> {
    /// The vector of three coordinates.
    #[inline(always)]
    pub fn new(x: T, y: T, z: T) -> Self {
        Self { x, y, z }
    }

    /// `value` in every lane of the arithmetic of `like`; exact.
    #[inline(always)]
    pub fn splat(like: T, value: Vec3) -> Self {
        Self::new(like.splat_like(value.x), like.splat_like(value.y), like.splat_like(value.z))
    }

    /// A vector of one lane's arithmetic in every lane of the arithmetic of `like`.
    #[inline(always)]
    pub fn lift(like: T, value: V3<T::Scalar>) -> Self {
        Self::new(like.lift_like(value.x), like.lift_like(value.y), like.lift_like(value.z))
    }

    /// The scalar product, `(x x' + y y') + z z'`.
    #[inline(always)]
    pub fn dot(self, other: Self) -> T {
        T::dot(self, other)
    }

    /// The vector product; each coordinate is a difference of two products.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        T::cross(self, other)
    }

    /// The vector times a number.
    #[inline(always)]
    #[must_use]
    pub fn scaled(self, factor: T) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }

    /// The vector times a power of two, which is exact.
    #[inline(always)]
    #[must_use]
    pub fn times_power(self, power: T) -> Self {
        Self::new(self.x.times_power(power), self.y.times_power(power), self.z.times_power(power))
    }

    /// The square of the Euclidean norm.
    #[inline(always)]
    pub fn norm_squared(self) -> T {
        self.dot(self)
    }

    /// The Euclidean norm.
    #[inline(always)]
    pub fn norm(self) -> T {
        self.norm_squared().sqrt()
    }

    /// The vector divided by its norm; `otherwise` where it is too short to point anywhere.
    #[inline(always)]
    #[must_use]
    pub fn normalized_or(self, otherwise: Self) -> Self {
        let square = self.norm_squared();
        let unit = self.scaled(square.splat_like(1.0) / square.sqrt());
        Self::select(square.splat_like(LEAST_SQUARE).le(square), unit, otherwise)
    }

    /// `yes` where the mask is true, `no` elsewhere.
    #[inline(always)]
    pub fn select(mask: T::Mask, yes: Self, no: Self) -> Self {
        Self::new(
            T::select(mask, yes.x, no.x),
            T::select(mask, yes.y, no.y),
            T::select(mask, yes.z, no.z),
        )
    }
}

impl<T: Real> Add for V3<T> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<T: Real> Sub for V3<T> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

impl<T: Real> Neg for V3<T> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl From<Vec3> for V3<f32> {
    #[inline(always)]
    fn from(value: Vec3) -> Self {
        Self::new(value.x, value.y, value.z)
    }
}

impl From<Vec3> for V3<f64> {
    #[inline(always)]
    fn from(value: Vec3) -> Self {
        Self::new(value.x.into(), value.y.into(), value.z.into())
    }
}

impl From<V3<f32>> for Vec3 {
    #[inline(always)]
    fn from(value: V3<f32>) -> Self {
        Self::new(value.x, value.y, value.z)
    }
}
