//! Where a query starts: anywhere, or on a surface that an earlier one has hit.

use super::cast::Hit;
use super::lanes::Encounter;
use super::program::Program;
use crate::leaf::{Ground, Solid};
use crate::range::max_norm;
use crate::ray::{Line, Ray, RayError};
use crate::real::{Lane, Real};
use crate::span::Span;
use crate::transform::Transform;
use core::ops::Range;
use glam::Vec3;

/// What is known of the place where a line starts: how the leaves look from there.
pub trait Footing<L: Solid, T: Real>: Copy {
    /// Leaf number `number` as the line sees it from its origin; both are in the leaf's frame, which `pose` puts into the world.
    fn seen(self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> L::Seen<T>;

    /// The span of the same leaf.
    #[inline(always)]
    fn span(self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> Span<T> {
        solid.span(&self.seen(number, solid, line, pose), &line.toward)
    }
}

/// Nothing is known of the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Anywhere;

impl<L: Solid, T: Real> Footing<L, T> for Anywhere {
    #[inline(always)]
    fn seen(self, _: u32, solid: &L, line: &Line<T>, _: Option<&Transform>) -> L::Seen<T> {
        solid.seen_from(line.origin)
    }

    #[inline(always)]
    fn span(self, _: u32, solid: &L, line: &Line<T>, _: Option<&Transform>) -> Span<T> {
        solid.span_along(line)
    }
}

/// The place is the one from which [`Program::seen_from`] has seen all leaves: what depends on the origin alone is done.
#[derive(Debug)]
pub struct SeenFrom<'s, S>(pub &'s [S]);

impl<S> Clone for SeenFrom<'_, S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S> Copy for SeenFrom<'_, S> {}

impl<L: Solid, T: Real> Footing<L, T> for SeenFrom<'_, L::Seen<T::Scalar>> {
    #[inline(always)]
    fn seen(self, number: u32, solid: &L, line: &Line<T>, _: Option<&Transform>) -> L::Seen<T> {
        match self.0.get(number as usize) {
            Some(seen) => L::lift(seen, line.toward.vv),
            None => solid.seen_from(line.origin),
        }
    }
}

/// The place is on a face of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnSurface {
    leaf: u32,
    face: u8,
    /// How far the place may be off its surface by rounding alone.
    slack: f32,
}

impl<L: Solid, T: Real> Footing<L, T> for OnSurface {
    #[inline(always)]
    fn seen(self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> L::Seen<T> {
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
/// There its root is 0 exactly, so that a ray which leaves a solid does not meet it again at a distance of rounding errors, and one which enters it starts inside; no epsilon is asked of the
/// caller. Leaves whose surfaces are as near as rounding can tell are treated alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    ray: Ray,
    footing: OnSurface,
}

impl Departure {
    /// The ray from `hit` along `direction`.
    ///
    /// # Errors
    /// Where `direction` is not finite or zero, or the hit lies beyond ±2^30.
    pub fn new(hit: &Hit, direction: Vec3) -> Result<Self, RayError> {
        let footing = OnSurface {
            leaf: hit.leaf,
            face: hit.face,
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
        program.spans_along(&self.ray.line(T::from(0.0)), self.footing, spans);
    }

    fn surface<L: Solid, T: Lane>(&self, program: &Program<'_, L>, spans: &[Span<T>], t: T) -> Encounter<T> {
        program.surface_at(&self.ray.line(t), self.footing, spans, t)
    }
}
