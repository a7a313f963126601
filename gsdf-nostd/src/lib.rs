//! Closed-form ray casting of CSG solids, without allocation and without a standard library.
#![no_std]
#![forbid(unsafe_code)]
#![warn(clippy::default_numeric_fallback)]

mod camera;
mod csg;
mod invalid;
mod leaf;
mod quadratic;
mod range;
mod ray;
mod real;
mod span;
mod toward;
mod trace;
mod transform;
mod vec3;

pub use camera::{Camera, Projection, Raster};
pub use csg::{
    Attribution, Crossing, Crossings, Csg, Departure, Draft, Hit, March, Node, Program, ProgramError, Sight, Start, attribute, march, sweep,
};
pub use invalid::{Fault, Invalid};
pub use leaf::{
    Bounds, CappedCone, CappedCylinder, Capsule, Cone, Cuboid, Cylinder, Ground, HalfSpace, Leaf, Nappe, Solid, Sphere, Surface,
};
pub use quadratic::roots;
pub use range::{MAX_LENGTH, MAX_STRETCH, MIN_LENGTH, UNIT_TOLERANCE};
pub use ray::{Line, Ray, RayError};
pub use real::{Lane, Mask, Real};
pub use span::Span;
pub use toward::{Toward, reciprocal_speed};
pub use trace::{Field, SphereTracer, Traced};
pub use transform::Transform;
pub use vec3::V3;
