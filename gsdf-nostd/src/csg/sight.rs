//! The directional reading of a program: one ray, all its leaf roots computed, ready for questions.

use super::check::ProgramError;
use super::hit::Hit;
use super::march::{March, march};
use super::program::{Csg, Program};
use super::start::Start;
use super::sweep::attribute;
use crate::leaf::Solid;
use crate::ray::Ray;
use crate::real::Lane;
use crate::span::Span;

/// A program as one ray sees it: the spans of all leaves, each computed once.
///
/// What follows are only comparisons of these numbers. `S` is the scratch memory they lie in, whose element type is
/// the arithmetic they were computed in.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a, L, S, R = Ray> {
    program: Program<'a, L>,
    start: R,
    spans: S,
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
                start.spans(self, spans);
                Ok(Sight {
                    program: *self,
                    start,
                    spans,
                })
            }
            None => Err(ProgramError::ScratchTooShort(length, self.leaves())),
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
        start.spans(&program, &mut spans);
        Sight { program, start, spans }
    }

    /// The boundary crossings along a ray, in order. See [`Sight::crossings`].
    pub fn crossings<R: Start>(&self, start: R) -> Crossings<'_, L, f32, [Span<f32>; N], R> {
        self.along(start).crossings()
    }
}

impl<'a, L: Solid, S, R: Start> Sight<'a, L, S, R> {
    /// The first crossing within the ray's range, with its normal.
    ///
    /// Of the arithmetic of the spans a [`Hit`] keeps the nearest `f32` numbers; a crossing beyond all finite ones is
    /// none, and one just before the range's end may be rounded to it.
    #[must_use]
    pub fn cast<T: Lane>(&self) -> Option<Hit>
    where
        S: AsRef<[Span<T>]>,
    {
        let ray = self.ray();
        let found = self.march_from(ray.start_on_line(T::from(0.0)))?;
        let t = ray.parameter_of(found);
        if !t.to_f32().is_finite() {
            return None;
        }
        let met = self.start.surface(&self.program, self.spans.as_ref(), found);
        Some(Hit::new(ray, t, &met))
    }

    /// The ray this is seen along.
    #[must_use]
    pub fn ray(&self) -> &Ray {
        self.start.ray()
    }

    /// The march to the first crossing beyond the start of the ray's range, wherever it is; its parameter is that of
    /// the ray.
    #[must_use]
    pub fn march<T: Lane>(&self) -> March<T>
    where
        S: AsRef<[Span<T>]>,
    {
        let ray = self.ray();
        let start = ray.start_on_line(T::from(0.0));
        let found = march(self.program.nodes, self.spans.as_ref(), start);
        March {
            t: ray.parameter_of(found.t),
            ..found
        }
    }

    /// The generalized signed distance function `φ_G`: the distance to the next crossing, positive outside, negative
    /// inside, infinite where there is none; in units of the direction's length, measured from the ray's origin.
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
        let t = ray.start_on_line(T::from(0.0));
        Crossings { sight: self, t }
    }

    /// The next crossing beyond `t`, both on the ray's [line](Ray::line), if it lies within the ray's range.
    #[inline]
    fn march_from<T: Lane>(&self, t: T) -> Option<T>
    where
        S: AsRef<[Span<T>]>,
    {
        let ray = self.ray();
        let found = march(self.program.nodes, self.spans.as_ref(), t).t;
        ray.parameter_of(found).lt(T::from(ray.range().end)).then_some(found)
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
        self.t = self.sight.march_from(self.t)?;
        let made = attribute(self.sight.program.nodes, self.sight.spans.as_ref(), self.t);
        Some(Crossing {
            t: self.sight.ray().parameter_of(self.t),
            leaf: made.leaf.to_index(),
            entering: made.after,
        })
    }
}
