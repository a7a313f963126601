//! The directional reading of a program: one ray, all its leaf roots computed, ready for questions.

use super::check::ProgramError;
use super::march::{March, march};
use super::program::{Csg, Node, Program};
use super::start::Start;
use super::sweep::attribute;
use crate::leaf::Solid;
use crate::ray::{Line, Ray};
use crate::real::Lane;
use crate::span::Span;

/// A program as one ray sees it: the spans of all leaves, each computed once.
///
/// What follows are only comparisons of these numbers. `S` is the scratch memory they lie in, whose element type is the arithmetic they were computed in.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a, L, S, R = Ray> {
    pub(super) program: Program<'a, L>,
    pub(super) start: R,
    pub(super) spans: S,
}

/// Where a ray crosses the boundary of a program.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing<T> {
    /// The parameter of the ray, in units of its direction's length.
    pub t: T,
    /// The number of the leaf whose surface is crossed.
    pub leaf: u32,
    /// Whether the ray enters the solid there, or leaves it.
    pub entering: bool,
}

impl<'a, L: Solid> Program<'a, L> {
    /// The program as the ray sees it, in the arithmetic of the scratch memory: one span per leaf.
    ///
    /// # Errors
    /// Where `scratch` is shorter than the program has leaves.
    pub fn along<'s, T: Lane, R: Start>(
        &self,
        start: R,
        scratch: &'s mut [Span<T>],
    ) -> Result<Sight<'a, L, &'s mut [Span<T>], R>, ProgramError> {
        let length = scratch.len();
        match scratch.get_mut(..self.leaves()) {
            Some(spans) => {
                self.fill(&start, spans);
                Ok(Sight {
                    program: *self,
                    start,
                    spans,
                })
            }
            None => Err(ProgramError::ScratchTooShort(length, self.leaves())),
        }
    }

    /// Computes the span of every leaf. A ray is taken into a frame once per run of leaves in that frame.
    #[inline(always)]
    fn fill<T: Lane, R: Start>(&self, start: &R, spans: &mut [Span<T>]) {
        let world: Line<T> = start.ray().line(T::from(0.0));
        let mut frame = 0;
        let mut local = world;
        let solids = self.nodes.iter().filter_map(|node| match node {
            Node::Leaf { solid, frame } => Some((solid, *frame)),
            _ => None,
        });
        let mut number = 0;
        for (span, (solid, own)) in spans.iter_mut().zip(solids) {
            let pose = self.pose(own);
            if own != frame {
                frame = own;
                local = pose.map_or(world, |pose| pose.line_to_local(&world));
            }
            *span = start.span(number, solid, &local, pose);
            number += 1;
        }
    }
}

impl<const N: usize, L: Solid> Csg<N, L> {
    /// Scratch memory enough for [`Program::along`].
    #[must_use]
    pub const fn scratch(&self) -> [Span<f32>; N] {
        [Span::EMPTY; N]
    }

    /// The program as the ray sees it.
    #[must_use]
    pub fn along<R: Start>(&self, start: R) -> Sight<'_, L, [Span<f32>; N], R> {
        let mut spans = self.scratch();
        let program = self.program();
        program.fill(&start, &mut spans);
        Sight { program, start, spans }
    }

    /// The boundary crossings along a ray, in order. See [`Sight::crossings`].
    pub fn crossings<R: Start>(&self, start: R) -> Crossings<'_, L, f32, [Span<f32>; N], R> {
        self.along(start).crossings()
    }
}

impl<'a, L: Solid, S, R: Start> Sight<'a, L, S, R> {
    /// The ray this is seen along.
    #[must_use]
    pub fn ray(&self) -> &Ray {
        self.start.ray()
    }

    /// The march to the first crossing beyond the start of the ray's range, wherever it is; its parameter is that of the ray.
    #[must_use]
    pub fn march<T: Lane>(&self) -> March<T>
    where
        S: AsRef<[Span<T>]>,
    {
        let ray = self.ray();
        let start = ray.to_line(T::from(ray.range().start));
        let found = march(self.program.nodes, self.spans.as_ref(), start);
        March {
            t: ray.from_line(found.t),
            ..found
        }
    }

    /// The generalized signed distance function φ_G: the distance to the next crossing, positive outside, negative inside, infinite where there is none; in units of
    /// the direction's length, measured from the ray's origin.
    #[must_use]
    pub fn gsdf<T: Lane>(&self) -> T
    where
        S: AsRef<[Span<T>]>,
    {
        let March { t, inside, .. } = self.march();
        T::select(inside, -t, t)
    }

    /// The boundary crossings within the ray's range, in strictly ascending order, entering and leaving by turns.
    ///
    /// Costs about one sweep more than there are roots; [`Crossing::leaf`] costs one sweep each.
    pub fn crossings<T: Lane>(self) -> Crossings<'a, L, T, S, R>
    where
        S: AsRef<[Span<T>]>,
    {
        let ray = self.ray();
        let t = ray.to_line(T::from(ray.range().start));
        Crossings { sight: self, t }
    }

    /// The next crossing beyond `t`, and its parameter on the ray's [line](Ray::line).
    #[inline]
    pub(super) fn next_beyond<T: Lane>(&self, t: T) -> Option<(Crossing<T>, T)>
    where
        S: AsRef<[Span<T>]>,
    {
        let ray = self.ray();
        let spans = self.spans.as_ref();
        let found = march(self.program.nodes, spans, t);
        let along = ray.from_line(found.t);
        if !along.lt(T::from(ray.range().end)) {
            return None;
        }
        let crossing = Crossing {
            t: along,
            leaf: attribute(self.program.nodes, spans, found.t).leaf.to_index(),
            entering: !found.inside,
        };
        Some((crossing, found.t))
    }
}

/// The boundary crossings along a ray, in order: what [`Sight::crossings`] returns.
#[derive(Clone, Debug)]
pub struct Crossings<'a, L, T, S, R = Ray> {
    sight: Sight<'a, L, S, R>,
    t: T,
}

impl<L: Solid, T: Lane, S: AsRef<[Span<T>]>, R: Start> Iterator for Crossings<'_, L, T, S, R> {
    type Item = Crossing<T>;

    fn next(&mut self) -> Option<Crossing<T>> {
        let (crossing, t) = self.sight.next_beyond(self.t)?;
        self.t = t;
        Some(crossing)
    }
}
