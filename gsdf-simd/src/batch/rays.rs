//! Rays in arrays.

use crate::lanes::{Lanes, MOST_LANES};
use crate::packet::Packet;
use core::fmt;
use gsdf_nostd::{OnSurface, V3};

/// Rays, coordinate by coordinate. All slices are equally long, or the cast is refused.
///
/// Rays that [`Ray`](gsdf_nostd::Ray) would refuse are no error: their distance is NaN.
#[derive(Clone, Copy, Debug)]
pub struct Rays<'r> {
    /// Where they start.
    pub origin: [&'r [f32]; 3],
    /// Where they go; not necessarily of unit length.
    pub direction: [&'r [f32]; 3],
    /// From where to where they look, in units of their directions' lengths; from 0 to infinity where there is none.
    pub range: Option<[&'r [f32]; 2]>,
    /// What they leave, where they start on surfaces that earlier rays have hit.
    pub leaving: Option<Leaving<'r>>,
}

/// The surfaces that rays leave: of each ray what an earlier one has hit where it starts, as [`RayHits`](super::RayHits) tells it.
///
/// A ray that leaves a surface is a [`Departure`](gsdf_nostd::Departure): its root there is 0 exactly, so that shadows and
/// mirrors need no epsilon.
#[derive(Clone, Copy, Debug)]
pub struct Leaving<'r> {
    /// The numbers of the leaves that were hit.
    pub leaf: &'r [u32],
    /// The numbers of those leaves' faces.
    pub face: &'r [u32],
    /// How far each origin may be off its surface by rounding alone: [`OnSurface::slack`]. A ray for which it is negative or
    /// NaN is none.
    pub slack: &'r [f32],
}

/// Why a batch was not cast: the slices are not equally long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LengthsDiffer {
    /// How long the first one is, that of the origins' first coordinates.
    pub expected: usize,
    /// How long another one is.
    pub found: usize,
}

impl fmt::Display for LengthsDiffer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { expected, found } = self;
        write!(
            f,
            "a slice of a batch is {found} long, where the rays' first one is {expected} long: all must be equally long"
        )
    }
}

impl core::error::Error for LengthsDiffer {}

/// Nothing where a slice is as long as the first one.
pub(super) fn same_length(expected: usize, found: usize) -> Result<(), LengthsDiffer> {
    if expected == found {
        Ok(())
    } else {
        Err(LengthsDiffer { expected, found })
    }
}

impl<'r> Rays<'r> {
    /// Rays that start anywhere and look as far as there is.
    #[must_use]
    pub const fn new(origin: [&'r [f32]; 3], direction: [&'r [f32]; 3]) -> Self {
        Self {
            origin,
            direction,
            range: None,
            leaving: None,
        }
    }

    /// How many there are.
    #[must_use]
    pub const fn len(&self) -> usize {
        self.origin[0].len()
    }

    /// Whether there is none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn check(&self) -> Result<(), LengthsDiffer> {
        let coordinates = self.origin.iter().chain(&self.direction).chain(self.range.iter().flatten());
        let left = self
            .leaving
            .iter()
            .flat_map(|left| [left.leaf.len(), left.face.len(), left.slack.len()]);
        let mut lengths = coordinates.map(|slice| slice.len()).chain(left);
        lengths.try_for_each(|found| same_length(self.len(), found))
    }

    /// The rays before one, and those from it on.
    pub(super) fn split_at(&self, middle: usize) -> (Self, Self) {
        let (origin, origin_after) = split(self.origin, middle);
        let (direction, direction_after) = split(self.direction, middle);
        let (range, range_after) = self.range.map(|range| split(range, middle)).unzip();
        let (leaving, leaving_after) = self.leaving.map(|leaving| leaving.split_at(middle)).unzip();
        let of = |origin, direction, range, leaving| Self {
            origin,
            direction,
            range,
            leaving,
        };
        (
            of(origin, direction, range, leaving),
            of(origin_after, direction_after, range_after, leaving_after),
        )
    }

    /// The first rays as a packet, and what they leave.
    #[inline(always)]
    pub(super) fn packet<T: Lanes>(&self, token: T::Token) -> (Packet<T>, Option<OnSurface<T>>) {
        let [x, y, z] = self.origin;
        let origin = V3::new(T::load(token, x), T::load(token, y), T::load(token, z));
        let [x, y, z] = self.direction;
        // Lanes without a ray have a zero direction.
        let direction = V3::new(T::load(token, x), T::load(token, y), T::load(token, z));
        let (mut start, end) = match self.range {
            Some([start, end]) => (T::load(token, start), T::load(token, end)),
            None => (T::splat(token, 0.0), T::splat(token, f32::INFINITY)),
        };
        let leaving = self.leaving.map(|leaving| leaving.lanes(token));
        if let Some(OnSurface { slack, .. }) = leaving {
            let known = T::splat(token, 0.0).le(slack);
            start = T::select(known, start, T::splat(token, f32::NAN));
        }
        (Packet::from_lanes(origin, direction, start, end), leaving)
    }
}

impl Leaving<'_> {
    fn split_at(&self, middle: usize) -> (Self, Self) {
        let (leaf, leaf_after) = self.leaf.split_at(middle);
        let (face, face_after) = self.face.split_at(middle);
        let (slack, slack_after) = self.slack.split_at(middle);
        let of = |leaf, face, slack| Self { leaf, face, slack };
        (of(leaf, face, slack), of(leaf_after, face_after, slack_after))
    }

    #[inline(always)]
    fn lanes<T: Lanes>(&self, token: T::Token) -> OnSurface<T> {
        let mut lanes = [[0.0; MOST_LANES]; 2];
        for (lanes, numbers) in lanes.iter_mut().zip([self.leaf, self.face]) {
            for (lane, number) in lanes.iter_mut().zip(numbers) {
                *lane = *number as f32;
            }
        }
        OnSurface {
            leaf: T::load(token, &lanes[0]),
            face: T::load(token, &lanes[1]),
            slack: T::load(token, self.slack),
        }
    }
}

fn split<const N: usize>(slices: [&[f32]; N], middle: usize) -> ([&[f32]; N], [&[f32]; N]) {
    (
        slices.map(|slice| slice.split_at(middle).0),
        slices.map(|slice| slice.split_at(middle).1),
    )
}
