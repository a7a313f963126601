//! One tile of an image: its rays are cast at the parts of the scene that their beam meets, from near to far.

mod leaf;
mod march;
mod pixels;
mod product;
mod rays;
mod reduce;
mod shade;
mod state;

pub use pixels::{Pixel, TILE_PIXELS, TILE_SIDE, Tile};
pub(crate) use reduce::{Known, Reduced, Waiting};
pub(crate) use state::Workspace;

use crate::lanes::Lanes;
use crate::target::Wants;
use crate::scene::{Beam, FANOUT, Form, Nearest, View};
use core::ops::Range;
use gsdf_nostd::Solid;
use rays::packets_within;

/// Casts the rays through the pixels of the tile whose left upper pixel is (`x`, `y`), and tells how many hit something.
#[inline(always)]
pub(crate) fn cast<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    [x, y]: [u32; 2],
    wants: Wants,
    work: &mut Workspace<T, L>,
    tile: &mut Tile,
) -> u32 {
    let scene = view.scene;
    work.rays
        .aim(token, &view.raster, x, y, view.valid, scene.divides_by_components());
    work.met.clear(token);
    let beam = Beam::new(&view.raster, x, y, TILE_SIDE as u32);
    work.walk.begin(scene.tree());
    let mut visits = Visits::new(scene.unbounded());
    while let Some((visit, which)) = visits.next(token, view, &beam, work) {
        let form = match visit {
            Visit::Part(number) => scene.part(number).map(|part| (part.leaves.clone(), &part.form)),
            // Neither the split into parts nor the product holds there.
            Visit::Whole => Some((0..0, &Form::Whole)),
        };
        match form {
            Some((leaves, Form::Product { positives, cuts })) => {
                product::cast(token, view, &beam, leaves, *positives, scene.cuts(*cuts), which, work);
            }
            Some((leaves, form)) => march::cast(token, view, &beam, leaves, form, which, work),
            None => {}
        }
    }
    shade::shade(token, view, wants, work, tile)
}

/// What the rays of some packets are cast at.
#[derive(Clone, Copy, Debug)]
enum Visit {
    /// A part of the scene.
    Part(usize),
    /// The whole program.
    Whole,
}

/// What the rays of a tile have to visit, in the order in which that is least work: the parts with bounds, roughly from
/// near to far; those without; and where rays start inside of a part, the whole program again.
struct Visits {
    /// The first part of the group at hand, and those of the group that are left.
    first: usize,
    nearest: Nearest,
    unbounded: Range<usize>,
    whole: bool,
}

impl Visits {
    #[inline(always)]
    fn new(unbounded: Range<usize>) -> Self {
        Self {
            first: 0,
            nearest: Nearest::NONE,
            unbounded,
            whole: false,
        }
    }

    #[inline(always)]
    fn next<T: Lanes, L: Solid>(
        &mut self,
        token: T::Token,
        view: &View<'_, '_, L>,
        beam: &Beam,
        work: &mut Workspace<T, L>,
    ) -> Option<(Visit, u32)> {
        loop {
            while let Some(place) = self.nearest.next() {
                let place = place % FANOUT;
                let met = &work.walk.met;
                let touched = packets_within::<T>(met.left[place], met.right[place], met.top[place], met.bottom[place]);
                let open = work.met.open(&work.rays, touched, met.near[place]);
                if open != 0 {
                    return Some((Visit::Part(self.first + place), open));
                }
            }
            if work.walk.is_over() {
                break;
            }
            let far = work.met.farthest(&work.rays);
            match work.walk.next::<T>(token, view.scene.tree(), beam, far) {
                Some(first) => {
                    self.first = first;
                    self.nearest = Nearest::new(&work.walk.met);
                }
                None => break,
            }
        }
        if let Some(part) = self.unbounded.next() {
            return Some((Visit::Part(part), every_packet::<T>()));
        }
        if work.met.inside != 0 && !self.whole {
            self.whole = true;
            return Some((Visit::Whole, work.met.inside));
        }
        None
    }
}

/// The bits of all packets of a tile.
fn every_packet<T: Lanes>() -> u32 {
    u32::MAX >> (u32::BITS as usize - rays::packets::<T>())
}
