//! Rays that have nothing in common, in arrays: as many as one likes.

mod hits;
mod rays;

pub use hits::RayHits;
pub use rays::{Leaving, LengthsDiffer, Rays};

use crate::lanes::Lanes;
use crate::level::{Level, Work};
use crate::scene::{Scene, View};
use crate::tile::{Query, Workspace, cast_packet, is_together};
use crate::vectorized::Vectorized;
use core::marker::PhantomData;
use gsdf_nostd::Solid;
use hits::Hits;
use rays::same_length;
use std::sync::{Mutex, PoisonError};

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
    let (any, wants) = (matches!(hits, Hits::Any(_)), hits.wants());
    let mut first = 0;
    let (extent, many) = (view.scene.extent(), view.scene.program().leaves() > FEW_LEAVES);
    // How many rays of those at hand are taken one by one.
    let mut alone = 0;
    while first < rays.len() {
        let (packet, leaving) = rays.split_at(first).1.packet::<T>(token);
        if many && alone == 0 && !is_together(&packet, extent) {
            alone = T::LANES;
        }
        let mut query = Query {
            packet,
            leaving,
            any,
            wants,
            alone: false,
        };
        if alone > 0 {
            query = query.of_first();
        }
        let found = cast_packet(token, view, &query, work);
        let count = if alone > 0 { 1 } else { T::LANES };
        hits.put(first, count, &query.packet, &found);
        first += count;
        alone = alone.saturating_sub(1);
    }
}
