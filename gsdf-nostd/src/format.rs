//! What a firmware logs: `defmt::Format`, by hand, because `glam` has none.
//!
//! The texts stay on the host; a device sends numbers. Errors say what is wrong and the number found; what would be right
//! is said by their `Display` alone.

use crate::camera::{Camera, Raster};
use crate::csg::{Crossing, Csg, Departure, Hit, March, Node, Program, Start};
use crate::invalid::Invalid;
use crate::leaf::{
    Bounds, CappedCone, CappedCylinder, Capsule, Cone, Cuboid, Cylinder, HalfSpace, HexagonalPrism, Nappe, Octahedron, Pyramid, Quad,
    Rhombus, RoundedCone, SolidAngle, Sphere, Triangle, TriangularPrism,
};
use crate::ray::{Ray, RayError};
use crate::real::Lane;
use crate::span::Span;
use crate::trace::{SphereTracer, Traced};
use crate::transform::Transform;
use defmt::{Format, Formatter, write};
use glam::Vec3;

/// A point or a vector, as `Display` writes it.
struct Shown(Vec3);

impl Format for Shown {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "[{}, {}, {}]", self.0.x, self.0.y, self.0.z);
    }
}

/// Writes the implementations for types that are one text with some numbers in it.
macro_rules! format {
    ($($type:ty: |$value:ident| $text:literal $(, $part:expr)*;)+) => {$(
        impl Format for $type {
            fn format(&self, f: Formatter<'_>) {
                let $value = self;
                write!(f, $text $(, $part)*);
            }
        }
    )+};
}

format! {
    Ray: |ray| "ray {} + t {}, t in {}..{}",
        Shown(ray.origin()), Shown(ray.direction()), ray.range().start, ray.range().end;
    Departure: |departure| "departure along {}", departure.ray();
    Hit: |hit| "hit t={} point={} normal={} leaf={} face={} entering={}",
        hit.t, Shown(hit.point), Shown(hit.normal), hit.leaf, hit.face, hit.entering;
    Invalid: |invalid| "{} = {}: {}", invalid.parameter(), invalid.found(), invalid.fault();
    Transform: |transform| "transform to_local=[{}, {}, {}] origin={}",
        Shown(transform.to_local()[0]), Shown(transform.to_local()[1]), Shown(transform.to_local()[2]),
        Shown(transform.origin());
    Bounds: |bounds| "bounds {}..{}", Shown(bounds.min), Shown(bounds.max);
    Camera: |camera| "camera {} eye={} forward={}", camera.projection(), Shown(camera.eye()), Shown(camera.forward());
    Raster: |raster| "raster {}x{} {}", raster.width(), raster.height(), raster.camera();
    SphereTracer: |tracer| "sphere tracer epsilon={} max_steps={} relaxation={}",
        tracer.epsilon, tracer.max_steps, tracer.relaxation;
    HalfSpace: |solid| "half-space point={} normal={}", Shown(solid.point()), Shown(solid.normal());
    Sphere: |solid| "sphere center={} radius={}", Shown(solid.center()), solid.radius();
    Cylinder: |solid| "cylinder point={} axis={} radius={}", Shown(solid.point()), Shown(solid.axis()), solid.radius();
    Nappe: |solid| "nappe apex={} axis={} slope={}", Shown(solid.apex()), Shown(solid.axis()), solid.slope();
    Cuboid: |solid| "cuboid {}..{}", Shown(solid.min()), Shown(solid.max());
    CappedCylinder: |solid| "capped cylinder bottom={} top={} radius={}",
        Shown(solid.bottom()), Shown(solid.top()), solid.side().radius();
    Cone: |solid| "cone apex={} base={} radius={}", Shown(solid.apex()), Shown(solid.base()), solid.radius();
    CappedCone: |solid| "capped cone bottom={} top={} radii={},{}",
        Shown(solid.bottom()), Shown(solid.top()), solid.bottom_radius(), solid.top_radius();
    Capsule: |solid| "capsule ends={},{} radius={}", Shown(solid.ends()[0]), Shown(solid.ends()[1]), solid.radius();
    HexagonalPrism: |solid| "hexagonal prism bottom={} top={} apothem={}", Shown(solid.bottom()), solid.top(), solid.apothem();
    TriangularPrism: |solid| "triangular prism bottom={} top={} inradius={}",
        Shown(solid.bottom()), solid.top(), solid.inradius();
    Octahedron: |solid| "octahedron center={} radius={}", Shown(solid.center()), solid.radius();
    Pyramid: |solid| "pyramid base={} half_width={} height={}", Shown(solid.base()), solid.half_width(), solid.height();
    Rhombus: |solid| "rhombus bottom={} top={} half diagonals={},{} rounding={}",
        Shown(solid.bottom()), solid.top(), solid.half_x(), solid.half_z(), solid.rounding();
    RoundedCone: |solid| "rounded cone ends={},{} radii={},{}",
        Shown(solid.ends()[0]), Shown(solid.ends()[1]), solid.radii()[0], solid.radii()[1];
    SolidAngle: |solid| "solid angle apex={} axis={} reach={} slope={}",
        Shown(solid.apex()), Shown(solid.axis()), solid.reach(), solid.slope();
    Triangle: |solid| "triangle {}, {}, {}", Shown(solid.corners()[0]), Shown(solid.corners()[1]), Shown(solid.corners()[2]);
    Quad: |solid| "quad {}, {}, {}, {}",
        Shown(solid.corners()[0]), Shown(solid.corners()[1]), Shown(solid.corners()[2]), Shown(solid.corners()[3]);
}

impl<T: Format> Format for Span<T> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "span {}..{}", self.enter, self.exit);
    }
}

impl<T: Format> Format for Crossing<T> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "crossing t={} leaf={} entering={}", self.t, self.leaf, self.entering);
    }
}

impl<T: Lane + Format> Format for March<T> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "march t={} inside={} sweeps={}", self.t, self.inside, self.sweeps);
    }
}

impl<T: Lane + Format> Format for Traced<T> {
    fn format(&self, f: Formatter<'_>) {
        write!(
            f,
            "traced t={} hit={} undecided={} steps={}",
            self.t, self.hit, self.undecided, self.steps
        );
    }
}

impl Format for RayError {
    fn format(&self, f: Formatter<'_>) {
        match *self {
            Self::OriginNotFinite(found) => write!(f, "OriginNotFinite({})", Shown(found)),
            Self::OriginTooFar(found) => write!(f, "OriginTooFar({})", Shown(found)),
            Self::DirectionNotFinite(found) => write!(f, "DirectionNotFinite({})", Shown(found)),
            Self::DirectionZero(found) => write!(f, "DirectionZero({})", Shown(found)),
            Self::DirectionTooShort(found) => write!(f, "DirectionTooShort({})", Shown(found)),
            Self::DirectionTooLong(found) => write!(f, "DirectionTooLong({})", Shown(found)),
            Self::Range(start, end) => write!(f, "Range({}, {})", start, end),
        }
    }
}

impl<L: Format> Format for Node<L> {
    fn format(&self, f: Formatter<'_>) {
        match self {
            Self::Leaf { solid, frame: 0 } => write!(f, "{}", solid),
            Self::Leaf { solid, frame } => write!(f, "{} in frame {}", solid, frame),
            Self::Union => write!(f, "union"),
            Self::Intersection => write!(f, "intersection"),
            Self::Difference => write!(f, "difference"),
            Self::Complement => write!(f, "complement"),
        }
    }
}

impl<L: Format> Format for Program<'_, L> {
    fn format(&self, f: Formatter<'_>) {
        write!(f, "program of {} leaves: {}", self.leaves(), self.nodes());
    }
}

impl<const N: usize, L: Format> Format for Csg<N, L> {
    fn format(&self, f: Formatter<'_>) {
        self.program().format(f);
    }
}
