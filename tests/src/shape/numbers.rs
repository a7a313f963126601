//! The numbers a shape is given by, one by one.

use super::Shape;
use glam::{DVec3, Vec3};

/// The numbers a shape is given by.
struct Numbers<'a> {
    points: Vec<&'a mut Vec3>,
    directions: Vec<&'a mut Vec3>,
    /// Coordinates that stand alone, and sizes.
    lengths: Vec<&'a mut f32>,
}

impl<'a> Numbers<'a> {
    fn new(points: Vec<&'a mut Vec3>, directions: Vec<&'a mut Vec3>, lengths: Vec<&'a mut f32>) -> Self {
        Self {
            points,
            directions,
            lengths,
        }
    }
}

impl Shape {
    /// Calls `each` with every number the shape is given by, always in the same order.
    pub fn for_each_number(&mut self, mut each: impl FnMut(&mut f32)) {
        let Numbers {
            points,
            directions,
            lengths,
        } = self.numbers();
        for vector in points.into_iter().chain(directions) {
            each(&mut vector.x);
            each(&mut vector.y);
            each(&mut vector.z);
        }
        lengths.into_iter().for_each(each);
    }

    /// The shape with each of its coordinates and lengths replaced; its directions have no unit.
    #[must_use]
    pub fn measured(mut self, length: impl Fn(f32) -> f32) -> Self {
        let Numbers { points, lengths, .. } = self.numbers();
        for point in points {
            *point = point.map(&length);
        }
        for number in lengths {
            *number = length(*number);
        }
        self
    }

    fn numbers(&mut self) -> Numbers<'_> {
        match self {
            Self::HalfSpace { point, normal } => Numbers::new(vec![point], vec![normal], vec![]),
            Self::Sphere { center, radius } | Self::Octahedron { center, radius } => Numbers::new(vec![center], vec![], vec![radius]),
            Self::Cylinder { point, axis, radius } => Numbers::new(vec![point], vec![axis], vec![radius]),
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => Numbers::new(vec![apex], vec![axis], vec![radius, height]),
            Self::Cuboid { min, max } => Numbers::new(vec![min, max], vec![], vec![]),
            Self::CappedCylinder { bottom, top, axis, radius } => Numbers::new(vec![bottom, top], vec![axis], vec![radius]),
            Self::Cone { apex, base, axis, radius } => Numbers::new(vec![apex, base], vec![axis], vec![radius]),
            Self::CappedCone {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
            } => Numbers::new(vec![bottom, top], vec![axis], vec![bottom_radius, top_radius]),
            Self::Capsule { a, b, radius } => Numbers::new(vec![a, b], vec![], vec![radius]),
            Self::HexagonalPrism { bottom, top, apothem } => Numbers::new(vec![bottom], vec![], vec![top, apothem]),
            Self::TriangularPrism { bottom, top, inradius } => Numbers::new(vec![bottom], vec![], vec![top, inradius]),
            Self::Pyramid { base, half_width, height } => Numbers::new(vec![base], vec![], vec![half_width, height]),
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } => Numbers::new(vec![bottom], vec![], vec![top, half_x, half_z, rounding]),
            Self::RoundedCone { a, b, a_radius, b_radius } => Numbers::new(vec![a, b], vec![], vec![a_radius, b_radius]),
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => Numbers::new(vec![apex], vec![axis], vec![reach, radius, height]),
            Self::Triangle { corners } => Numbers::new(corners.iter_mut().collect(), vec![], vec![]),
            Self::Quad { corners } => Numbers::new(corners.iter_mut().collect(), vec![], vec![]),
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
