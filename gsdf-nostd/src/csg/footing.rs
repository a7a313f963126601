//! What is known of the place where a line starts.

use crate::leaf::{Ground, Solid, Surface, span_unseen, surface_unseen};
use crate::range::max_norm;
use crate::ray::Line;
use crate::real::Real;
use crate::span::Span;
use crate::transform::Transform;
use glam::Vec3;

/// What is known of the place where a line starts: how the leaves look from there.
pub trait Footing<L: Solid, T: Real>: Copy {
    /// Leaf number `number` as the line sees it from its origin; both are in the leaf's frame, which `pose` puts into
    /// the world.
    fn seen(self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> L::Seen<T>;

    /// The span of the same leaf.
    #[inline(always)]
    fn span(self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> Span<T> {
        solid.span(&self.seen(number, solid, line, pose), &line.toward)
    }

    /// Its surface at `t`.
    #[inline(always)]
    fn surface(self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>, t: T) -> Surface<T> {
        solid.surface(&self.seen(number, solid, line, pose), &line.toward, t)
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

    #[inline(always)]
    fn surface(self, _: u32, solid: &L, line: &Line<T>, _: Option<&Transform>, t: T) -> Surface<T> {
        solid.surface_along(line, t)
    }
}

/// The place is the one from which [`Program::seen_from`](super::Program::seen_from) has seen all leaves: what
/// depends on the origin alone is done.
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

    #[inline(always)]
    fn span(self, number: u32, solid: &L, line: &Line<T>, _: Option<&Transform>) -> Span<T> {
        match self.0.get(number as usize) {
            Some(seen) => solid.span_lifted(seen, &line.toward),
            None => span_unseen(solid, line),
        }
    }

    #[inline(always)]
    fn surface(self, number: u32, solid: &L, line: &Line<T>, _: Option<&Transform>, t: T) -> Surface<T> {
        match self.0.get(number as usize) {
            Some(seen) => solid.surface_lifted(seen, &line.toward, t),
            None => surface_unseen(solid, line, t),
        }
    }
}

/// The place is on a face of a leaf: each lane's on one of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnSurface<T> {
    /// The number of the leaf.
    pub leaf: T,
    /// The number of its face.
    pub face: T,
    /// How far the place may be off its surface by rounding alone; see [`slack`](OnSurface::slack).
    pub slack: T,
}

impl OnSurface<f32> {
    /// How far a point may be off the surface by rounding alone, where a ray from `origin` hit it.
    #[must_use]
    pub fn slack(origin: Vec3, point: Vec3) -> f32 {
        (max_norm(origin) + max_norm(point)) * Ground::<f32>::ROUNDING
    }

    /// The same for all lanes of the arithmetic of `like`.
    #[inline(always)]
    pub(super) fn splat_like<T: Real>(self, like: T) -> OnSurface<T> {
        OnSurface {
            leaf: like.splat_like(self.leaf),
            face: like.splat_like(self.face),
            slack: like.splat_like(self.slack),
        }
    }
}

impl<L: Solid, T: Real> Footing<L, T> for OnSurface<T> {
    #[inline(always)]
    fn seen(self, number: u32, solid: &L, line: &Line<T>, pose: Option<&Transform>) -> L::Seen<T> {
        let like = line.toward.vv;
        // Into a frame the start takes the error of the pose's arithmetic along, all stretched by it.
        let (moved, per_stretch) = match pose {
            Some(pose) => (max_norm(pose.origin()), 1.0 / pose.stretch()),
            None => (0.0, 1.0),
        };
        let here = self.leaf.eq(like.splat_like(number as f32));
        let ground = Ground {
            tolerance: (self.slack + like.splat_like(moved * Ground::<f32>::ROUNDING)) * like.splat_like(per_stretch),
            face: T::select(here, self.face, like.splat_like(-1.0)),
        };
        solid.grounded(solid.seen_from(line.origin), &ground)
    }
}
