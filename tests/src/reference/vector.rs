//! Points and directions with exact coordinates.

use core::ops::{Add, Neg, Sub};

use glam::Vec3;

use super::number::Exact;

/// A point or a direction with exact coordinates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactVec3([Exact; 3]);

impl ExactVec3 {
    /// The sum of the products of the coordinates, exact.
    #[must_use]
    pub fn dot(&self, other: &Self) -> Exact {
        let [x, y, z] = &self.0;
        let [u, v, w] = &other.0;
        x * u + y * v + z * w
    }

    /// The square of the length, exact.
    #[must_use]
    pub fn length_squared(&self) -> Exact {
        let [x, y, z] = &self.0;
        x.square() + y.square() + z.square()
    }

    /// The vector across both, exact.
    #[must_use]
    pub fn cross(&self, other: &Self) -> Self {
        let [x, y, z] = &self.0;
        let [u, v, w] = &other.0;
        Self([y * w - z * v, z * u - x * w, x * v - y * u])
    }

    /// The coordinates, each rounded to the nearest `f64`.
    #[must_use]
    pub fn to_f64(&self) -> [f64; 3] {
        self.0.each_ref().map(Exact::to_f64)
    }

    /// The vector times a number, exact.
    #[must_use]
    pub fn times(&self, factor: &Exact) -> Self {
        Self(self.0.each_ref().map(|coordinate| coordinate * factor))
    }
}

impl Add for &ExactVec3 {
    type Output = ExactVec3;

    fn add(self, other: &ExactVec3) -> ExactVec3 {
        let [x, y, z] = &self.0;
        let [u, v, w] = &other.0;
        ExactVec3([x + u, y + v, z + w])
    }
}

impl Sub for &ExactVec3 {
    type Output = ExactVec3;

    fn sub(self, other: &ExactVec3) -> ExactVec3 {
        let [x, y, z] = &self.0;
        let [u, v, w] = &other.0;
        ExactVec3([x - u, y - v, z - w])
    }
}

impl Neg for &ExactVec3 {
    type Output = ExactVec3;

    fn neg(self) -> ExactVec3 {
        ExactVec3(self.0.each_ref().map(|coordinate| -coordinate))
    }
}

impl From<[Exact; 3]> for ExactVec3 {
    fn from(coordinates: [Exact; 3]) -> Self {
        Self(coordinates)
    }
}

impl From<[f64; 3]> for ExactVec3 {
    fn from(coordinates: [f64; 3]) -> Self {
        Self(coordinates.map(Exact::from))
    }
}

impl From<[f32; 3]> for ExactVec3 {
    fn from(coordinates: [f32; 3]) -> Self {
        Self(coordinates.map(Exact::from))
    }
}

impl From<Vec3> for ExactVec3 {
    fn from(vector: Vec3) -> Self {
        Self::from(vector.to_array())
    }
}
