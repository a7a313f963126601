//! Rays that have nothing in common, in arrays: as many as one likes.

use crate::lanes::Lanes;
use crate::level::{Level, Work};
use crate::packet::Packet;
use crate::scene::{Scene, View};
use crate::tile::{Found, Workspace, cast_packet, is_together};
use crate::vectorized::Vectorized;
use core::fmt;
use core::marker::PhantomData;
use gsdf_nostd::{Solid, V3};
use std::sync::{Mutex, PoisonError};

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
}

/// Where the hits of [`Rays`] go: as long as these.
#[derive(Debug)]
pub struct RayHits<'h> {
    /// The parameters of the rays, in units of their directions' lengths: infinite where a ray hits nothing, NaN where it
    /// is none.
    pub distance: &'h mut [f32],
    /// The components of the unit normals, outward from the program, if they are wanted; zero where a ray hits nothing.
    pub normal: Option<[&'h mut [f32]; 3]>,
    /// The numbers of the leaves, if they are wanted; [`Pixel::NO_LEAF`](crate::Pixel::NO_LEAF) where a ray hits nothing.
    pub leaf: Option<&'h mut [u32]>,
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

impl<'r> Rays<'r> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.origin[0].len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn check(&self) -> Result<(), LengthsDiffer> {
        let slices = self.origin.iter().chain(&self.direction).chain(self.range.iter().flatten());
        slices.map(|slice| slice.len()).try_for_each(|found| same_length(self.len(), found))
    }

    /// The rays before one, and those from it on.
    fn split_at(&self, middle: usize) -> (Self, Self) {
        let (origin, origin_after) = split(self.origin, middle);
        let (direction, direction_after) = split(self.direction, middle);
        let range = self.range.map(|range| split(range, middle));
        let before = Self {
            origin,
            direction,
            range: range.map(|(range, _)| range),
        };
        let after = Self {
            origin: origin_after,
            direction: direction_after,
            range: range.map(|(_, range)| range),
        };
        (before, after)
    }

    /// The first rays as a packet.
    #[inline(always)]
    fn packet<T: Lanes>(&self, token: T::Token) -> Packet<T> {
        let [x, y, z] = self.origin;
        let origin = V3::new(T::load(token, x), T::load(token, y), T::load(token, z));
        let [x, y, z] = self.direction;
        // Lanes without a ray have a zero direction.
        let direction = V3::new(T::load(token, x), T::load(token, y), T::load(token, z));
        let (start, end) = match self.range {
            Some([start, end]) => (T::load(token, start), T::load(token, end)),
            None => (T::splat(token, 0.0), T::splat(token, f32::INFINITY)),
        };
        Packet::from_lanes(origin, direction, start, end)
    }
}

fn same_length(expected: usize, found: usize) -> Result<(), LengthsDiffer> {
    if expected == found {
        Ok(())
    } else {
        Err(LengthsDiffer { expected, found })
    }
}

fn split<const N: usize>(slices: [&[f32]; N], middle: usize) -> ([&[f32]; N], [&[f32]; N]) {
    (
        slices.map(|slice| slice.split_at(middle).0),
        slices.map(|slice| slice.split_at(middle).1),
    )
}

impl RayHits<'_> {
    fn check(&self, expected: usize) -> Result<(), LengthsDiffer> {
        same_length(expected, self.distance.len())?;
        if let Some(leaf) = &self.leaf {
            same_length(expected, leaf.len())?;
        }
        let normals = self.normal.iter().flatten();
        normals.map(|plane| plane.len()).try_for_each(|found| same_length(expected, found))
    }
}

/// Casts rays of any kind at a scene, at a level and on all threads of the current `rayon` pool.
///
/// Neighbours in the arrays that go about the same way from about the same place are taken through the scene together; others,
/// in scenes of more than 64 leaves, one by one, which takes several times as long for each.
pub struct Caster<'s, 'a, L: Solid> {
    view: View<'s, 'a, L>,
    level: Level,
    idle: Mutex<Vec<RayCaster<L>>>,
}

/// Up to how many leaves rays are taken through a scene together wherever they go: it is soon gone through.
const FEW_LEAVES: usize = 64;

/// How many rays a thread takes at a time.
const TOGETHER: usize = 1024;

impl<'s, 'a, L> Caster<'s, 'a, L>
where
    L: Vectorized,
{
    /// Casts at this scene, at the [best level](Level::best) of this machine.
    #[must_use]
    pub fn new(scene: &'s Scene<'a, L>) -> Self {
        Self::at_level(scene, Level::best())
    }

    /// The same at another level; the hits are the same.
    #[must_use]
    pub fn at_level(scene: &'s Scene<'a, L>, level: Level) -> Self {
        Self {
            view: View::of_any_rays(scene),
            level,
            idle: Mutex::new(Vec::new()),
        }
    }

    /// The first crossing of each ray within its range: the bits of [`Program::along`](gsdf_nostd::Program::along) and
    /// `cast`.
    ///
    /// # Errors
    /// Where the slices are not equally long.
    pub fn cast(&self, rays: &Rays<'_>, hits: RayHits<'_>) -> Result<(), LengthsDiffer> {
        rays.check()?;
        hits.check(rays.len())?;
        self.cast_some(*rays, Hits::First(hits));
        Ok(())
    }

    /// Whether each ray crosses anything within its range: as [`cast`](Self::cast), but any crossing will do. False for what
    /// is no ray.
    ///
    /// # Errors
    /// Where the slices are not equally long.
    pub fn any(&self, rays: &Rays<'_>, hits: &mut [bool]) -> Result<(), LengthsDiffer> {
        rays.check()?;
        same_length(rays.len(), hits.len())?;
        self.cast_some(*rays, Hits::Any(hits));
        Ok(())
    }

    fn cast_some(&self, rays: Rays<'_>, hits: Hits<'_>) {
        if rays.len() > TOGETHER {
            let middle = (rays.len() / 2).next_multiple_of(TOGETHER);
            let ((rays, rays_after), (hits, hits_after)) = (rays.split_at(middle), hits.split_at(middle));
            rayon::join(|| self.cast_some(rays, hits), || self.cast_some(rays_after, hits_after));
            return;
        }
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        let worker = idle().pop();
        let mut worker = worker.unwrap_or_else(|| L::ray_caster(self.level));
        worker.0.cast(&self.view, rays, hits);
        idle().push(worker);
    }
}

/// Where hits go.
enum Hits<'h> {
    First(RayHits<'h>),
    Any(&'h mut [bool]),
}

impl Hits<'_> {
    /// Where the hits of the rays before one go, and those from it on.
    fn split_at(self, middle: usize) -> (Self, Self) {
        match self {
            Self::First(RayHits { distance, normal, leaf }) => {
                let (distance, distance_after) = distance.split_at_mut(middle);
                let (normal, normal_after) = match normal {
                    Some([x, y, z]) => {
                        let ((x, x_after), (y, y_after), (z, z_after)) =
                            (x.split_at_mut(middle), y.split_at_mut(middle), z.split_at_mut(middle));
                        (Some([x, y, z]), Some([x_after, y_after, z_after]))
                    }
                    None => (None, None),
                };
                let (leaf, leaf_after) = leaf.map(|leaf| leaf.split_at_mut(middle)).unzip();
                let of = |distance, normal, leaf| Hits::First(RayHits { distance, normal, leaf });
                (of(distance, normal, leaf), of(distance_after, normal_after, leaf_after))
            }
            Self::Any(hits) => {
                let (hits, after) = hits.split_at_mut(middle);
                (Hits::Any(hits), Hits::Any(after))
            }
        }
    }

    /// Puts those of the first so many rays of a packet, the first of which has this number.
    #[inline(always)]
    fn put<T: Lanes>(&mut self, first: usize, count: usize, packet: &Packet<T>, found: &Found<T>) {
        let end = first + count;
        match self {
            Self::First(hits) => {
                let nan = found.t.splat_like(f32::NAN);
                let none = !packet.valid();
                T::select(none, nan, found.t).store(from(hits.distance, first, end));
                if let Some([x, y, z]) = &mut hits.normal {
                    found.normal.x.store(from(x, first, end));
                    found.normal.y.store(from(y, first, end));
                    found.normal.z.store(from(z, first, end));
                }
                if let Some(leaf) = &mut hits.leaf {
                    found.leaf.store_numbers(from(leaf, first, end));
                }
            }
            Self::Any(hits) => {
                let mut numbers = [0; crate::lanes::MOST_LANES];
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

/// What casts rays at a level.
#[doc(hidden)]
pub struct RayCaster<L: Solid>(Box<dyn CastRays<L>>);

impl<L: Solid + Send + Sync + 'static> RayCaster<L> {
    /// One for a level.
    #[must_use]
    pub fn new(level: Level) -> Self {
        level.run(MakeRayCaster(PhantomData))
    }
}

/// What casts rays in lanes of some type.
trait CastRays<L: Solid>: Send {
    /// Casts rays.
    fn cast(&mut self, view: &View<'_, '_, L>, rays: Rays<'_>, hits: Hits<'_>);
}

/// Makes a [`RayCaster`] for the lanes of a level.
struct MakeRayCaster<L>(PhantomData<L>);

impl<L: Solid + Send + Sync + 'static> Work for MakeRayCaster<L> {
    type Output = RayCaster<L>;

    fn run<T: Lanes>(self, token: T::Token) -> RayCaster<L> {
        RayCaster(Box::new(CastIn {
            token,
            work: Workspace::<T, L>::new(token),
        }))
    }
}

struct CastIn<T: Lanes, L> {
    token: T::Token,
    work: Workspace<T, L>,
}

impl<T: Lanes, L: Solid + Send + Sync> CastRays<L> for CastIn<T, L> {
    fn cast(&mut self, view: &View<'_, '_, L>, rays: Rays<'_>, mut hits: Hits<'_>) {
        let Self { token, work } = self;
        let token = *token;
        T::vectorize(
            token,
            #[inline(always)]
            || cast_all(token, view, rays, &mut hits, work),
        );
    }
}

#[inline(always)]
fn cast_all<T: Lanes, L: Solid>(token: T::Token, view: &View<'_, '_, L>, rays: Rays<'_>, hits: &mut Hits<'_>, work: &mut Workspace<T, L>) {
    let (any, normals) = match hits {
        Hits::First(hits) => (false, hits.normal.is_some()),
        Hits::Any(_) => (true, false),
    };
    let mut first = 0;
    let (extent, many) = (view.scene.extent(), view.scene.program().leaves() > FEW_LEAVES);
    // How many rays of those at hand are taken one by one.
    let mut alone = 0;
    while first < rays.len() {
        let mut packet = rays.split_at(first).1.packet::<T>(token);
        if many && alone == 0 && !is_together(&packet, extent) {
            alone = T::LANES;
        }
        if alone > 0 {
            packet = packet.alone();
        }
        let found = cast_packet(token, view, &packet, any, normals, alone > 0, work);
        let count = if alone > 0 { 1 } else { T::LANES };
        hits.put(first, count, &packet, &found);
        first += count;
        alone = alone.saturating_sub(1);
    }
}
