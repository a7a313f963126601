//! What is known of the place where a line starts.

use crate::leaf::{Ground, Solid};
use crate::range::max_norm;
use crate::ray::Line;
use crate::real::Real;
use crate::span::Span;
use crate::transform::Transform;

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
}

/// The place is on a face of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnSurface {
    pub(super) leaf: u32,
    pub(super) face: u8,
    /// How far the place may be off its surface by rounding alone.
    pub(super) slack: f32,
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
