//! The numbers a shape is given by, one by one.

use super::Shape;
use glam::{DVec3, Vec3};

impl Shape {
    /// Calls `each` with every number the shape is given by, always in the same order.
    pub fn for_each_number(&mut self, mut each: impl FnMut(&mut f32)) {
        let (points, sizes) = self.numbers();
        for point in points {
            each(&mut point.x);
            each(&mut point.y);
            each(&mut point.z);
        }
        sizes.into_iter().for_each(each);
    }

    /// The points and directions, and the other numbers.
    fn numbers(&mut self) -> (Vec<&mut Vec3>, Vec<&mut f32>) {
        match self {
            Self::HalfSpace { point, normal } => (vec![point, normal], vec![]),
            Self::Sphere { center, radius } | Self::Octahedron { center, radius } => (vec![center], vec![radius]),
            Self::Cylinder { point, axis, radius } => (vec![point, axis], vec![radius]),
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => (vec![apex, axis], vec![radius, height]),
            Self::Cuboid { min, max } => (vec![min, max], vec![]),
            Self::CappedCylinder { bottom, top, axis, radius } => (vec![bottom, top, axis], vec![radius]),
            Self::Cone { apex, base, axis, radius } => (vec![apex, base, axis], vec![radius]),
            Self::CappedCone {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
            } => (vec![bottom, top, axis], vec![bottom_radius, top_radius]),
            Self::Capsule { a, b, radius } => (vec![a, b], vec![radius]),
            Self::HexagonalPrism { bottom, top, apothem } => (vec![bottom], vec![top, apothem]),
            Self::TriangularPrism { bottom, top, inradius } => (vec![bottom], vec![top, inradius]),
            Self::Pyramid { base, half_width, height } => (vec![base], vec![half_width, height]),
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } => (vec![bottom], vec![top, half_x, half_z, rounding]),
            Self::RoundedCone { a, b, a_radius, b_radius } => (vec![a, b], vec![a_radius, b_radius]),
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => (vec![apex, axis], vec![reach, radius, height]),
            Self::Triangle { corners } => (corners.iter_mut().collect(), vec![]),
            Self::Quad { corners } => (corners.iter_mut().collect(), vec![]),
        }
    }
}

impl Shape {
    /// The middle of the points the shape is defined by, and how far it reaches from there; at least `least`.
    #[must_use]
    pub fn middle_and_reach(&self, least: f64) -> (DVec3, f64) {
        let points = self.points();
        let middle = points.iter().map(|point| point.as_dvec3()).sum::<DVec3>() / points.len() as f64;
        let apart = points.iter().map(|point| (point.as_dvec3() - middle).length()).fold(0.0, f64::max);
        let size = match *self {
            Self::Nappe { radius, height, .. } => f64::from(radius.max(height)),
            _ => self.sizes().iter().map(|&size| f64::from(size)).fold(0.0, f64::max),
        };
        (middle, (apart + size).max(least))
    }
}
