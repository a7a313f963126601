//! Where a query starts: anywhere, or on a surface that an earlier one has hit.

use super::cast::Hit;
use crate::leaf::{Ground, Solid};
use crate::range::max_norm;
use crate::ray::{Line, Ray, RayError};
use crate::real::Real;
use crate::span::Span;
use crate::transform::Transform;
use core::ops::Range;
use glam::Vec3;

/// A start of a query: a [`Ray`], or a [`Departure`] from a hit.
pub trait Start: sealed::Sealed {
    /// The ray to follow.
    fn ray(&self) -> &Ray;

    /// The span of leaf number `number` along the ray, given in the leaf's frame with its pose.
    #[doc(hidden)]
    fn span<L: Solid, T: Real>(&self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> Span<T>;

    /// The leaf as the ray sees it from its start.
    #[doc(hidden)]
    fn seen<L: Solid, T: Real>(&self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> L::Seen<T>;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Ray {}
    impl Sealed for super::Departure {}
}

impl Start for Ray {
    fn ray(&self) -> &Ray {
        self
    }

    #[inline(always)]
    fn span<L: Solid, T: Real>(&self, _: u32, solid: &L, line: &Line<T>, _: Option<&Transform>) -> Span<T> {
        solid.span_along(line)
    }

    #[inline(always)]
    fn seen<L: Solid, T: Real>(&self, _: u32, solid: &L, line: &Line<T>, _: Option<&Transform>) -> L::Seen<T> {
        solid.seen_from(line.origin)
    }
}

/// A ray that leaves a surface: it knows the leaf and the face it starts on.
///
/// There its root is 0 exactly, so that a ray which leaves a solid does not meet it again at a distance of rounding errors, and one which enters it starts inside; no epsilon is asked of the
/// caller. Leaves whose surfaces are as near as rounding can tell are treated alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    ray: Ray,
    leaf: u32,
    face: u8,
    /// How far the start may be off its surface by rounding alone.
    slack: f32,
}

impl Departure {
    /// The ray from `hit` along `direction`.
    ///
    /// # Errors
    /// Where `direction` is not finite or zero, or the hit lies beyond ±2^30.
    pub fn new(hit: &Hit, direction: Vec3) -> Result<Self, RayError> {
        Ok(Self {
            ray: Ray::new(hit.point, direction)?,
            leaf: hit.leaf,
            face: hit.face,
            slack: hit.slack,
        })
    }

    /// The same start over another range of the parameter.
    ///
    /// # Errors
    /// Unless `0 <= range.start < range.end`.
    pub fn within(self, range: Range<f32>) -> Result<Self, RayError> {
        Ok(Self {
            ray: self.ray.within(range)?,
            ..self
        })
    }
}

impl Start for Departure {
    fn ray(&self) -> &Ray {
        &self.ray
    }

    #[inline(always)]
    fn span<L: Solid, T: Real>(&self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> Span<T> {
        solid.span(&self.seen(number, solid, line, pose), &line.toward)
    }

    #[inline(always)]
    fn seen<L: Solid, T: Real>(&self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> L::Seen<T> {
        let like = line.toward.vv;
        // Into a frame the start takes the error of the pose's arithmetic along, all stretched by it.
        let (moved, per_stretch) = match pose {
            Some(pose) => (max_norm(pose.origin()), 1.0 / pose.stretch()),
            None => (0.0, 1.0),
        };
        let face = if number == self.leaf { f32::from(self.face) } else { -1.0 };
        let ground = Ground {
            tolerance: like.splat_like((self.slack + moved * Ground::<f32>::ROUNDING) * per_stretch),
            face: like.splat_like(face),
        };
        solid.grounded(solid.seen_from(line.origin), &ground)
    }
}
