//! Where a query starts: anywhere, or on a surface that an earlier one has hit.

use super::footing::{Anywhere, OnSurface};
use super::hit::Hit;
use super::lanes::Encounter;
use super::program::Program;
use crate::leaf::Solid;
use crate::ray::{Ray, RayError};
use crate::real::Lane;
use crate::span::Span;
use core::ops::Range;
use glam::Vec3;

/// A start of a query: a [`Ray`], or a [`Departure`] from a hit.
pub trait Start: sealed::Sealed {
    /// The ray to follow.
    fn ray(&self) -> &Ray;

    /// The spans of all leaves.
    #[doc(hidden)]
    fn spans<L: Solid, T: Lane>(&self, program: &Program<'_, L>, spans: &mut [Span<T>]);

    /// The surface at a crossing.
    #[doc(hidden)]
    fn surface<L: Solid, T: Lane>(&self, program: &Program<'_, L>, spans: &[Span<T>], t: T) -> Encounter<T>;
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

    fn spans<L: Solid, T: Lane>(&self, program: &Program<'_, L>, spans: &mut [Span<T>]) {
        program.spans_along(&self.line(T::from(0.0)), Anywhere, spans);
    }

    fn surface<L: Solid, T: Lane>(&self, program: &Program<'_, L>, spans: &[Span<T>], t: T) -> Encounter<T> {
        program.surface_at(&self.line(t), Anywhere, spans, t)
    }
}

/// A ray that leaves a surface: it knows the leaf and the face it starts on.
///
/// There its root is 0 exactly, so that a ray which leaves a solid does not meet it again at a distance of rounding
/// errors, and one which enters it starts inside; no epsilon is asked of the caller. Leaves whose surfaces are as
/// near as rounding can tell are treated alike.
///
/// Within rounding of a cone's tip no normal tells outward from inward, and a ray that leaves may meet the tip again at
/// a distance of rounding errors. Within rounding of an edge a point lies on the faces on both sides of it, so that a
/// ray inward from the one may at once be outside through the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    ray: Ray,
    footing: OnSurface<f32>,
}

impl Departure {
    /// The ray from `hit` along `direction`.
    ///
    /// # Errors
    /// Where `direction` is no [`Ray`]'s, or the hit lies beyond ±2^30.
    pub fn new(hit: &Hit, direction: Vec3) -> Result<Self, RayError> {
        let footing = OnSurface {
            leaf: hit.leaf as f32,
            face: f32::from(hit.face),
            slack: hit.slack,
        };
        let ray = Ray::new(hit.point, direction)?;
        Ok(Self { ray, footing })
    }

    /// The same start over another range of the parameter.
    ///
    /// # Errors
    /// Unless `0 <= range.start < range.end`.
    pub fn within(self, range: Range<f32>) -> Result<Self, RayError> {
        let ray = self.ray.within(range)?;
        Ok(Self { ray, ..self })
    }
}

impl Start for Departure {
    fn ray(&self) -> &Ray {
        &self.ray
    }

    fn spans<L: Solid, T: Lane>(&self, program: &Program<'_, L>, spans: &mut [Span<T>]) {
        let like = T::from(0.0);
        program.spans_along(&self.ray.line(like), self.footing.splat_like(like), spans);
    }

    fn surface<L: Solid, T: Lane>(&self, program: &Program<'_, L>, spans: &[Span<T>], t: T) -> Encounter<T> {
        program.surface_at(&self.ray.line(t), self.footing.splat_like(t), spans, t)
    }
}
