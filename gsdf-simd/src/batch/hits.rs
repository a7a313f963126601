//! Where the hits of rays in arrays go.

use super::rays::{LengthsDiffer, same_length};
use crate::lanes::{Lanes, MOST_LANES};
use crate::packet::Packet;
use crate::target::Wants;
use crate::tile::Found;

/// Where the hits of [`Rays`](super::Rays) go: as long as these.
#[derive(Debug)]
pub struct RayHits<'h> {
    /// The parameters of the rays, in units of their directions' lengths: infinite where a ray hits nothing, NaN where it
    /// is none.
    pub distance: &'h mut [f32],
    /// The components of the unit normals, outward from the program, if they are wanted; zero where a ray hits nothing.
    pub normal: Option<[&'h mut [f32]; 3]>,
    /// The numbers of the leaves, if they are wanted; [`Pixel::NO_LEAF`](crate::Pixel::NO_LEAF) where a ray hits nothing.
    pub leaf: Option<&'h mut [u32]>,
    /// The numbers of the leaves' faces, if they are wanted: by rays that go on from there. 0 where a ray hits nothing.
    pub face: Option<&'h mut [u32]>,
}

impl<'h> RayHits<'h> {
    /// Distances alone.
    #[must_use]
    pub const fn distances(distance: &'h mut [f32]) -> Self {
        Self {
            distance,
            normal: None,
            leaf: None,
            face: None,
        }
    }

    pub(super) fn check(&self, expected: usize) -> Result<(), LengthsDiffer> {
        same_length(expected, self.distance.len())?;
        let numbers = self.leaf.iter().chain(&self.face).map(|numbers| numbers.len());
        let normals = self.normal.iter().flatten().map(|plane| plane.len());
        numbers.chain(normals).try_for_each(|found| same_length(expected, found))
    }

    fn split_at(self, middle: usize) -> (Self, Self) {
        let (distance, distance_after) = self.distance.split_at_mut(middle);
        let (normal, normal_after) = self.normal.map(|planes| split(planes, middle)).unzip();
        let (leaf, leaf_after) = self.leaf.map(|leaf| leaf.split_at_mut(middle)).unzip();
        let (face, face_after) = self.face.map(|face| face.split_at_mut(middle)).unzip();
        let of = |distance, normal, leaf, face| Self {
            distance,
            normal,
            leaf,
            face,
        };
        (
            of(distance, normal, leaf, face),
            of(distance_after, normal_after, leaf_after, face_after),
        )
    }
}

/// Planes before a place, and from it on.
fn split([x, y, z]: [&mut [f32]; 3], middle: usize) -> ([&mut [f32]; 3], [&mut [f32]; 3]) {
    let ((x, x_after), (y, y_after), (z, z_after)) = (x.split_at_mut(middle), y.split_at_mut(middle), z.split_at_mut(middle));
    ([x, y, z], [x_after, y_after, z_after])
}

/// What is asked of some rays, and where the answers go.
pub(super) enum Hits<'h> {
    /// What each meets first.
    First(RayHits<'h>),
    /// Whether each meets anything.
    Any(&'h mut [bool]),
}

impl Hits<'_> {
    /// What is wanted of each hit.
    pub(super) fn wants(&self) -> Wants {
        match self {
            Self::First(hits) => Wants {
                normals: hits.normal.is_some(),
                faces: hits.face.is_some(),
            },
            Self::Any(_) => Wants::NOTHING_ELSE,
        }
    }

    /// Where the hits of the rays before one go, and those from it on.
    pub(super) fn split_at(self, middle: usize) -> (Self, Self) {
        match self {
            Self::First(hits) => {
                let (hits, after) = hits.split_at(middle);
                (Hits::First(hits), Hits::First(after))
            }
            Self::Any(hits) => {
                let (hits, after) = hits.split_at_mut(middle);
                (Hits::Any(hits), Hits::Any(after))
            }
        }
    }

    /// Puts those of the first so many rays of a packet, the first of which has this number.
    #[inline(always)]
    pub(super) fn put<T: Lanes>(&mut self, first: usize, count: usize, packet: &Packet<T>, found: &Found<T>) {
        let end = first + count;
        match self {
            Self::First(hits) => {
                let nan = found.t.splat_like(f32::NAN);
                let none = !packet.valid();
                T::select(none, nan, found.t).store(from(hits.distance, first, end));
                if let Some([x, y, z]) = &mut hits.normal {
                    found.met.normal.x.store(from(x, first, end));
                    found.met.normal.y.store(from(y, first, end));
                    found.met.normal.z.store(from(z, first, end));
                }
                if let Some(leaf) = &mut hits.leaf {
                    found.leaf.store_numbers(from(leaf, first, end));
                }
                if let Some(face) = &mut hits.face {
                    found.met.face.store_numbers(from(face, first, end));
                }
            }
            Self::Any(hits) => {
                let mut numbers = [0; MOST_LANES];
                found.leaf.store_numbers(&mut numbers);
                for (hit, number) in from(hits, first, end).iter_mut().zip(numbers) {
                    *hit = number != u32::MAX;
                }
            }
        }
    }
}

/// A slice from a place on, to another one or as far as it reaches.
#[inline(always)]
fn from<N>(slice: &mut [N], place: usize, end: usize) -> &mut [N] {
    let end = end.min(slice.len());
    slice.get_mut(place..end).unwrap_or_default()
}
