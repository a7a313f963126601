//! One tile of an image: its rays are cast at the parts of the scene that their beam meets, from near to far.

mod certified;
mod leaf;
mod march;
mod pixels;
mod product;
mod rays;
mod shade;
mod single;
mod state;

pub use certified::Certificates;
pub(crate) use certified::Certifier;
pub use pixels::{Pixel, TILE_PIXELS, TILE_SIDE, Tile};
pub(crate) use single::{Found, Query, cast_packet, is_together};
pub(crate) use state::Workspace;

use crate::lanes::Lanes;
use crate::prefetch::Ahead;
use crate::scene::{Beam, FANOUT, Form, Grid, Meets, Picture, View};
use crate::target::Wants;
use gsdf_nostd::{Raster, Solid};

/// Casts the rays through the pixels of the tile whose left upper pixel is (`x`, `y`), and tells how many hit something; the
/// `next` one to be written, if it is known, is fetched meanwhile.
#[inline(always)]
pub(crate) fn cast<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    [x, y]: [u32; 2],
    wants: Wants,
    work: &mut Workspace<T, L>,
    tile: &mut Tile,
    next: Option<Ahead>,
) -> u32 {
    work.rays.begin([x, y]);
    work.met.clear();
    if let Some(Picture { raster, .. }) = &view.picture {
        let beam = beam_of::<T>(raster, [x, y]);
        visit(token, view, &beam, None, work);
    }
    shade::shade(token, view, wants, work, tile, next)
}

/// The beam of a tile's rays.
#[inline(always)]
fn beam_of<T: Lanes>(raster: &Raster, [x, y]: [u32; 2]) -> Beam {
    Beam::new(raster, x, y, Grid::SIDE, Grid::new(rays::height::<T>() as u32))
}

/// What it takes to be content with any hit of the rays of a single packet.
#[derive(Clone, Copy)]
struct AnyHit<T: Lanes> {
    /// Where the ranges of the rays end, in the parameter of their lines.
    end: T,
    /// The lanes that hold no ray.
    others: T::Mask,
    /// The latest parameter at which a ray starts. What is met later than that, none of them starts inside of.
    latest_start: f32,
}

/// Casts the rays of a tile at all that they may meet, in the order in which that is least work: the parts with bounds,
/// roughly from near to far; those without; and where rays start inside of a part, the whole program again. Where `any` hit
/// will do it goes on only to what a ray may start in once all have met something.
#[inline(always)]
fn visit<T: Lanes, L: Solid, M: Meets<T>>(
    token: T::Token,
    view: &View<'_, '_, L>,
    rays: &M,
    any: Option<AnyHit<T>>,
    work: &mut Workspace<T, L>,
) {
    let scene = view.scene;
    work.walk.begin(scene.tree());
    // The first part of the group at hand, and the bits of those of the group that are left.
    let (mut first, mut left) = (0, 0_u32);
    let mut unbounded = scene.unbounded();
    let mut at_start = true;
    let mut whole = false;
    let mut settled = false;
    let latest = any.as_ref().map_or(f32::INFINITY, |any| any.latest_start);
    loop {
        // There is one place where something is visited: what is inlined there is compiled once.
        let (which, leaves, form);
        if left != 0 {
            let place = left.trailing_zeros() as usize % FANOUT;
            left &= left - 1;
            let met = &work.walk.met;
            if settled && latest < met.near[place] {
                continue;
            }
            let open = work.met.open(&work.rays, met.touched[place], met.near[place]);
            match scene.part(first + place) {
                Some(part) if open != 0 => (which, leaves, form) = (open, part.leaves.clone(), &part.form),
                _ => continue,
            }
        } else if !work.walk.is_over() {
            let far = if at_start { f32::INFINITY } else { work.met.farthest(&work.rays) };
            let far = if settled { far.min(latest.next_up()) } else { far };
            at_start = false;
            if let Some(item) = work.walk.next::<T, M>(token, scene.tree(), rays, far) {
                (first, left) = (item, work.walk.met.bits);
            }
            continue;
        } else if let Some(part) = unbounded.next().and_then(|number| scene.part(number)) {
            (which, leaves, form) = (work.rays.present(), part.leaves.clone(), &part.form);
        } else if work.met.inside != 0 && !whole {
            // Neither the split into parts nor the product holds there.
            whole = true;
            (which, leaves, form) = (work.met.inside, 0..0, &Form::Whole);
        } else {
            break;
        }
        match form {
            Form::Product { positives, cuts } => {
                if !scene.is_missed(
                    &leaves,
                    leaves.start + positives,
                    #[inline(always)]
                    |border| rays.see(border),
                ) {
                    work.rays.aim(token, view, which);
                    product::cast(token, view, rays, leaves, *positives, scene.cuts(*cuts), which, work);
                }
            }
            form => {
                work.rays.aim(token, view, which);
                march::cast(token, view, rays, leaves, form, which, work);
            }
        }
        if let Some(any) = &any {
            settled = work.met.all_nearer(0, any.end, any.others);
        }
    }
}
