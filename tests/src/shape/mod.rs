//! Solids with random numbers: the library's leaf and, beside it, the same solid in exact arithmetic.

mod closest;
pub mod composed;
mod draw;
mod exact;
mod facet;
mod holds;
mod numbers;
mod points;
mod polyhedron;
pub mod profile;

use crate::reference::Expr;
pub use closest::to_triangles;
pub use draw::{across, log_uniform, unit};
use facet::Facet;
use glam::Vec3;
use gsdf_nostd::{
    CappedCone, CappedCylinder, Capsule, Cone, Cuboid, Cylinder, HalfSpace, HexagonalPrism, Invalid, Leaf, Nappe, Octahedron, Pyramid,
    Quad, Rhombus, RoundedCone, SolidAngle, Sphere, Triangle, TriangularPrism,
};
use polyhedron::Polyhedron;

/// The parameters of a leaf.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of the constructors' parameters")]
pub enum Shape {
    HalfSpace {
        point: Vec3,
        normal: Vec3,
    },
    Sphere {
        center: Vec3,
        radius: f32,
    },
    Cylinder {
        point: Vec3,
        axis: Vec3,
        radius: f32,
    },
    Nappe {
        apex: Vec3,
        axis: Vec3,
        radius: f32,
        height: f32,
    },
    Cuboid {
        min: Vec3,
        max: Vec3,
    },
    CappedCylinder {
        bottom: Vec3,
        top: Vec3,
        axis: Vec3,
        radius: f32,
    },
    Cone {
        apex: Vec3,
        base: Vec3,
        axis: Vec3,
        radius: f32,
    },
    CappedCone {
        bottom: Vec3,
        top: Vec3,
        axis: Vec3,
        bottom_radius: f32,
        top_radius: f32,
    },
    Capsule {
        a: Vec3,
        b: Vec3,
        radius: f32,
    },
    HexagonalPrism {
        bottom: Vec3,
        top: f32,
        apothem: f32,
    },
    TriangularPrism {
        bottom: Vec3,
        top: f32,
        inradius: f32,
    },
    Octahedron {
        center: Vec3,
        radius: f32,
    },
    Pyramid {
        base: Vec3,
        half_width: f32,
        height: f32,
    },
    Rhombus {
        bottom: Vec3,
        top: f32,
        half_x: f32,
        half_z: f32,
        rounding: f32,
    },
    RoundedCone {
        a: Vec3,
        b: Vec3,
        a_radius: f32,
        b_radius: f32,
    },
    SolidAngle {
        apex: Vec3,
        axis: Vec3,
        reach: f32,
        radius: f32,
        height: f32,
    },
    Triangle {
        corners: [Vec3; 3],
    },
    Quad {
        corners: [Vec3; 4],
    },
}

/// The kinds of leaves, in the order of [`Shape`]'s variants.
pub const KINDS: [&str; 18] = [
    "half-space",
    "sphere",
    "cylinder",
    "nappe",
    "cuboid",
    "capped cylinder",
    "cone",
    "capped cone",
    "capsule",
    "hexagonal prism",
    "triangular prism",
    "octahedron",
    "pyramid",
    "rhombus",
    "rounded cone",
    "solid angle",
    "triangle",
    "quad",
];

/// How many of the kinds, the first ones, have an inside; the others are facets.
pub const SOLIDS: usize = 16;

impl Shape {
    /// The library's leaf.
    ///
    /// # Errors
    /// Where the library refuses the parameters.
    pub fn leaf(&self) -> Result<Leaf, Invalid> {
        Ok(match *self {
            Self::HalfSpace { point, normal } => HalfSpace::new(point, normal)?.into(),
            Self::Sphere { center, radius } => Sphere::new(center, radius)?.into(),
            Self::Cylinder { point, axis, radius } => Cylinder::new(point, axis, radius)?.into(),
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => Nappe::new(apex, axis, radius, height)?.into(),
            Self::Cuboid { min, max } => Cuboid::new(min, max)?.into(),
            Self::CappedCylinder { bottom, top, axis, radius } => CappedCylinder::new(bottom, top, axis, radius)?.into(),
            Self::Cone { apex, base, axis, radius } => Cone::new(apex, base, axis, radius)?.into(),
            Self::CappedCone {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
            } => CappedCone::new(bottom, top, axis, bottom_radius, top_radius)?.into(),
            Self::Capsule { a, b, radius } => Capsule::new(a, b, radius)?.into(),
            Self::HexagonalPrism { bottom, top, apothem } => HexagonalPrism::new(bottom, top, apothem)?.into(),
            Self::TriangularPrism { bottom, top, inradius } => TriangularPrism::new(bottom, top, inradius)?.into(),
            Self::Octahedron { center, radius } => Octahedron::new(center, radius)?.into(),
            Self::Pyramid { base, half_width, height } => Pyramid::new(base, half_width, height)?.into(),
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } => Rhombus::new(bottom, top, half_x, half_z, rounding)?.into(),
            Self::RoundedCone { a, b, a_radius, b_radius } => RoundedCone::new(a, b, a_radius, b_radius)?.into(),
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => SolidAngle::new(apex, axis, reach, radius, height)?.into(),
            Self::Triangle { corners: [a, b, c] } => Triangle::new(a, b, c)?.into(),
            Self::Quad { corners: [a, b, c, d] } => Quad::new(a, b, c, d)?.into(),
        })
    }

    /// The solid as one with flat faces alone, if it is one.
    fn polyhedron(&self) -> Option<Polyhedron> {
        Some(match *self {
            Self::HexagonalPrism { bottom, top, apothem } => Polyhedron::hexagonal_prism(bottom, top, apothem),
            Self::TriangularPrism { bottom, top, inradius } => Polyhedron::triangular_prism(bottom, top, inradius),
            Self::Octahedron { center, radius } => Polyhedron::octahedron(center, radius),
            Self::Pyramid { base, half_width, height } => Polyhedron::pyramid(base, half_width, height),
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding: 0.0,
            } => Polyhedron::rhombus(bottom, top, half_x, half_z),
            _ => return None,
        })
    }

    /// The solid as a flat piece of surface without an inside, if it is one.
    fn facet(&self) -> Option<Facet<'_>> {
        match self {
            Self::Triangle { corners } => Some(Facet(corners)),
            Self::Quad { corners } => Some(Facet(corners)),
            _ => None,
        }
    }

    /// Whether the shape is a piece of surface without an inside.
    #[must_use]
    pub fn is_facet(&self) -> bool {
        self.facet().is_some()
    }

    /// Whether a line goes through a facet, also if its corners moved by `offset`; false where there is an inside.
    #[must_use]
    pub fn is_pierced(&self, origin: Vec3, direction: Vec3, offset: f64) -> bool {
        self.facet().is_some_and(|facet| facet.is_pierced(origin, direction, offset))
    }

    /// A facet as the points before its plane, and the outline that its crossings lie within; `None` for what has an
    /// inside.
    #[must_use]
    pub fn plane_and_outline(&self) -> Option<(Expr, Expr)> {
        self.facet().map(|facet| facet.plane_and_outline())
    }

    /// The radii, or else how far the solid reaches from its points.
    fn sizes(&self) -> Vec<f32> {
        match *self {
            Self::HalfSpace { .. } | Self::Nappe { .. } | Self::Cuboid { .. } | Self::Triangle { .. } | Self::Quad { .. } => Vec::new(),
            Self::Sphere { radius, .. }
            | Self::Cylinder { radius, .. }
            | Self::CappedCylinder { radius, .. }
            | Self::Cone { radius, .. }
            | Self::Octahedron { radius, .. }
            | Self::HexagonalPrism { apothem: radius, .. }
            | Self::TriangularPrism { inradius: radius, .. }
            | Self::Pyramid { half_width: radius, .. }
            | Self::SolidAngle { reach: radius, .. }
            | Self::Capsule { radius, .. } => vec![radius],
            Self::Rhombus {
                half_x, half_z, rounding, ..
            } => vec![half_x + rounding, half_z + rounding],
            Self::CappedCone {
                bottom_radius, top_radius, ..
            } => vec![bottom_radius, top_radius],
            Self::RoundedCone { a_radius, b_radius, .. } => vec![a_radius, b_radius],
        }
    }

    /// The points the solid is defined by.
    fn points(&self) -> Vec<Vec3> {
        match *self {
            Self::HalfSpace { point, .. } | Self::Cylinder { point, .. } => vec![point],
            Self::Sphere { center, .. } | Self::Octahedron { center, .. } => vec![center],
            Self::Nappe { apex, .. } | Self::SolidAngle { apex, .. } => vec![apex],
            Self::Cuboid { min, max } => vec![min, max],
            Self::CappedCylinder { bottom, top, .. } | Self::CappedCone { bottom, top, .. } => vec![bottom, top],
            Self::Cone { apex, base, .. } => vec![apex, base],
            Self::Capsule { a, b, .. } | Self::RoundedCone { a, b, .. } => vec![a, b],
            Self::HexagonalPrism { bottom, top, .. } | Self::TriangularPrism { bottom, top, .. } | Self::Rhombus { bottom, top, .. } => {
                vec![bottom, bottom.with_y(top)]
            }
            Self::Pyramid { base, height, .. } => vec![base, base + Vec3::Y * height],
            Self::Triangle { corners } => corners.into(),
            Self::Quad { corners } => corners.into(),
        }
    }

    /// The extent of the solid's numbers: its farthest point of definition and its largest size.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let farthest = self.points().iter().map(|point| point.as_dvec3().length()).fold(0.0, f64::max);
        farthest + self.sizes().iter().map(|&size| f64::from(size)).fold(0.0, f64::max)
    }

    /// The axis, or the normal of a face.
    #[must_use]
    pub fn axis(&self) -> Vec3 {
        match *self {
            Self::HalfSpace { normal, .. } => normal,
            Self::Sphere { .. } | Self::Cuboid { .. } => Vec3::Z,
            Self::Cylinder { axis, .. }
            | Self::Nappe { axis, .. }
            | Self::CappedCylinder { axis, .. }
            | Self::Cone { axis, .. }
            | Self::SolidAngle { axis, .. }
            | Self::CappedCone { axis, .. } => axis,
            Self::Capsule { a, b, .. } | Self::RoundedCone { a, b, .. } => (b - a).normalize(),
            Self::HexagonalPrism { .. } | Self::TriangularPrism { .. } | Self::Pyramid { .. } | Self::Rhombus { .. } => Vec3::Y,
            Self::Octahedron { .. } => Vec3::ONE.normalize(),
            Self::Triangle { corners: [a, b, ..] } => (b - a).normalize(),
            Self::Quad { corners: [a, b, ..] } => (b - a).normalize(),
        }
    }
}
