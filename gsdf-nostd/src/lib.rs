//! Closed-form ray casting of CSG solids: no iteration to an epsilon, no allocation, no standard library.
//!
//! A solid, seen along one ray, is a set of spans of the ray's parameter. For the solids of this crate each span has
//! a closed form, and those of solids composed from them by union, intersection, difference and complement follow by
//! comparing the numbers: `min`, `max` and negation, as for any signed distance function. Scenes are fixed arrays
//! that can lie in flash; the results have the same bits on a Cortex-M0 and on a server.
//!
//! # A first distance
//! ```
//! use gsdf_nostd::{CappedCylinder, Cuboid, Ray, Sphere, csg};
//! use glam::{Vec3, vec3};
//!
//! csg! {
//!     /// A rounded block with a hole through it.
//!     const BEAD = difference(
//!         intersection(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(Vec3::ZERO, 1.35)),
//!         CappedCylinder::new(vec3(0.0, -1.5, 0.0), vec3(0.0, 1.5, 0.0), Vec3::Y, 0.6)
//!     )
//! }
//!
//! let (eye, forward) = (vec3(0.0, 0.0, -4.0), Vec3::Z);
//! assert_eq!(BEAD.sdf(eye), 3.0);           // to the nearest surface, any direction
//! assert_eq!(BEAD.gsdf(eye, forward), 3.0); // to the next surface, along the ray
//!
//! let hit = BEAD.cast(&Ray::new(eye, forward)?).unwrap();
//! assert_eq!((hit.t, hit.normal, hit.leaf), (3.0, Vec3::NEG_Z, 0));
//! let inside = BEAD.cast_from(&hit, forward)?.unwrap();
//! assert_eq!((inside.t, inside.leaf, inside.entering), (1.0 - 0.6, 2, false)); // into the hole
//! # Ok::<(), gsdf_nostd::RayError>(())
//! ```
//!
//! # One program, two readings
//! A [`Csg`] is a list of solids and operators. Read at a point it is the *standard* signed distance function
//! [`sdf`](Csg::sdf): how far to the nearest surface, as sphere tracing wants it. Read along a ray it is the
//! *generalized* one, [`gsdf`](Csg::gsdf): how far to the next surface in that direction. Both are negative inside,
//! and in both union is the minimum, intersection the maximum and complement the negative.
//!
//! Along a ray the minimum of two next crossings is not always the next crossing of the union (a surface within the
//! other solid is none), so one evaluation is only a bound; but it never oversteps, and it always is the root of some
//! leaf. [`march`] repeats it from root to root until the sign turns: at most `2 leaves + 1` comparisons of the
//! numbers computed once, two on average, and no epsilon. [`cast`](Csg::cast) adds the normal and the leaf,
//! [`crossings`](Csg::crossings) goes on to the end of the ray, and [`cast_from`](Csg::cast_from) starts on a surface
//! without meeting it again.
//!
//! # Boundaries
//! Spans are half-open. A ray that only touches a solid, or lies in one of its faces, misses it; solids that share a
//! face merge into one, and a solid cut away to a shared face leaves no skin, as long as both wrote the face with the
//! same numbers: a transform belongs to a frame ([`Transform`], `posed` in [`csg!`]) and not into the solid's own
//! numbers. Where the surfaces of several leaves coincide, the one with the lowest number is reported, unless the
//! solid does not show it.
//!
//! # Accuracy
//! A *rounding error* is the unit roundoff (2<sup>-24</sup> in `f32`, 2<sup>-53</sup> in `f64`) times the size of the
//! numbers that meet at a crossing: the distance of the ray's origin from the world's, plus the distance of the
//! solid's farthest point of definition, plus its radius, plus the distance travelled; at least 2<sup>-40</sup>, below
//! which squares underflow. For every solid, and every ray
//! in range, a computed crossing, or a computed miss, is the exact one of a surface moved by at most 8 rounding
//! errors (4 in any test so far). It is thus near-silhouette rays alone whose hit or miss can be wrong. A pose adds
//! the errors of mapping the ray. What follows for `t`, why, how it is tested, and what no arithmetic can do, is on the
//! page [`numerics`]. [`Plain`] trades that accuracy for speed, for solids that are near.
//!
//! # Range
//! Coordinates and sizes up to 2<sup>30</sup>, sizes from 2<sup>-20</sup>, transforms that stretch by at most
//! 2<sup>20</sup> either way, and lengths as unequally; directions from 2<sup>-40</sup> to 2<sup>40</sup>. What lies outside is refused with an error that
//! says so, at compile time where a scene is `const`. A scene at 1e-30 or 1e30, and rays of any speed, are measured in a
//! [`Unit`] of their own: exactly, and with the same relative results.
//!
//! # Paying for what you use
//! A program links the formulas of its leaf type's solids and no others: [`leaf_set!`] makes a leaf type of the ones
//! a scene needs, your own among them ([`Solid`]). No function in this crate allocates, recurses or panics.
//!
//! The feature `std` (off by default) takes the square root from the standard library: the same bits, and faster where a
//! build is made for a particular processor. It changes nothing where there is no operating system.
//! The feature `defmt` (off by default) lets a firmware log rays, hits, errors, solids and programs: `defmt::Format`.
//!
//! The guide for microcontrollers is [`embedding`].
//!
//! # Arithmetic
//! Every formula is written once, over [`Real`], and runs in `f32`, in `f64` and in packets of lanes (crate
//! `gsdf-simd`) with the same bits per lane. The functions on slices of nodes and spans ([`sweep`], [`march`],
//! [`attribute`]) are the pieces to build evaluators of your own from.
//!
//! # Sources
//! H. Yamada, Generalized Signed Distance Functions for Raytracing Algorithms (2021), of which this is a repair: most
//! formulas printed there miss a sign, a factor or a case ([`errata`]). S. Roth, Ray Casting for Modeling Solids (1982). I.
//! Quilez, Distance functions. E. Haines, J. Günther, T. Akenine-Möller, Precision Improvements for Ray/Sphere
//! Intersection (2019).
#![no_std]
#![forbid(unsafe_code)]
#![cfg_attr(not(test), warn(clippy::default_numeric_fallback))]

#[cfg(any(doc, doctest))]
#[doc = include_str!("../docs/embedding.md")]
pub mod embedding {}

#[cfg(any(doc, doctest))]
#[doc = include_str!("../docs/errata.md")]
pub mod errata {}

#[cfg(any(doc, doctest))]
#[doc = include_str!("../docs/numerics.md")]
#[doc = include_str!("../docs/accuracy.md")]
///
/// Drawn by `cargo run --release --package gsdf-tests --bin accuracy -- --chart gsdf-nostd/docs/accuracy.svg`.
pub mod numerics {}

mod bounded;
mod camera;
mod csg;
#[cfg(feature = "defmt")]
mod format;
mod invalid;
mod leaf;
mod plain;
mod quadratic;
mod range;
mod ray;
mod real;
mod root;
mod shape;
mod span;
mod toward;
mod trace;
mod transform;
mod unit;
mod vec3;

pub use bounded::{Bounded, Judged, Ordinary, SLACK, WithError};
pub use camera::{Camera, Projection, Raster};
pub use csg::{
    Anywhere, Attribution, Certificate, Certified, CertifiedScratch, Crossing, Crossings, Csg, Departure, Draft, Encounter, Footing, Hit,
    March, Node, OnSurface, Program, ProgramError, SeenFrom, Settled, Sight, Start, attribute, certify, half_ulp, march, sweep,
};
/// The vectors and matrices in this crate's interface are those of this crate.
#[doc(no_inline)]
pub use glam;
pub use invalid::{Fault, Invalid};
pub use leaf::{
    Bounds, CappedCone, CappedCylinder, Capsule, Cone, Cuboid, Cylinder, Ground, HalfSpace, HexagonalPrism, Leaf, Nappe, Octahedron,
    Pyramid, Quad, Rhombus, RoundedCone, Solid, SolidAngle, Sphere, Surface, Triangle, TriangularPrism,
};
pub use plain::Plain;
pub use quadratic::{Chord, roots};
pub use range::{MAX_LENGTH, MAX_SPEED, MAX_STRETCH, MIN_LENGTH, UNIT_TOLERANCE};
pub use ray::{Line, Ray, RayError};
pub use real::{Lane, Mask, Real};
pub use shape::{BoxFrame, DoubleCone, WideSolidAngle};
pub use span::{IN_DOUBLES, Span};
pub use toward::{Toward, reciprocal_speed};
pub use trace::{Field, SphereTracer, Traced};
pub use transform::{LocalLine, Transform};
pub use unit::Unit;
pub use vec3::V3;
