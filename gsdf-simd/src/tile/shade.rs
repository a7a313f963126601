//! From what the rays of a tile met first to its pixels.

use super::leaf;
use super::pixels::Tile;
use super::rays::{packets, start_of};
use super::state::Workspace;
use crate::lanes::{LaneMask, Lanes};
use crate::prefetch::Ahead;
use crate::scene::View;
use crate::target::Wants;
use core::ops::Range;
use gsdf_nostd::{Solid, Surface, V3};

/// Writes the pixels of a tile, normals and faces only where they are wanted, and tells how many show something.
#[inline(always)]
pub(crate) fn shade<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    wants: Wants,
    work: &mut Workspace<T, L>,
    tile: &mut Tile,
    next: Option<Ahead>,
) -> u32 {
    let mut hits = 0;
    let mut asked = leaf::Asked::none();
    let nothing = T::splat(token, f32::INFINITY);
    let zero = T::splat(token, 0.0);
    for packet in 0..packets::<T>() {
        let start = start_of::<T>(packet);
        let pixels = start..start + T::LANES;
        if let Some(next) = next {
            Tile::fetch(next, start, wants);
        }
        if work.met.touched >> packet & 1 == 0 {
            clear(tile, pixels, wants, nothing, zero);
            continue;
        }
        let (_, scale, _) = work.rays.packet(packet);
        let (t, leaf) = work.met.packet(packet);
        let along = t * scale;
        let hit = along.lt(nothing);
        T::select(hit, along, nothing).store(&mut tile.distance[pixels.clone()]);
        // What is infinite becomes `Pixel::NO_LEAF`.
        let leaf = T::select(hit, leaf, nothing);
        leaf.store_numbers(&mut tile.leaf[pixels.clone()]);
        hits += hit.to_bits().count_ones();
        if wants.normals | wants.faces {
            let numbers = &tile.leaf[pixels.clone()];
            let met = surface(token, view, &mut asked, packet, numbers, hit, work);
            let [x, y, z] = &mut tile.normal;
            met.normal.x.store(&mut x[pixels.clone()]);
            met.normal.y.store(&mut y[pixels.clone()]);
            met.normal.z.store(&mut z[pixels.clone()]);
            if wants.faces {
                met.face.store_numbers(&mut tile.face[pixels]);
            }
        }
    }
    hits
}

/// The surfaces that the rays of a packet hit, those of the leaves of these numbers; zero where they hit none.
#[inline(always)]
pub(crate) fn surface<'v, T: Lanes, L: Solid>(
    token: T::Token,
    view: &'v View<'_, '_, L>,
    asked: &mut leaf::Asked<'v, L>,
    packet: usize,
    numbers: &[u32],
    hit: T::Mask,
    work: &mut Workspace<T, L>,
) -> Surface<T> {
    let zero = T::splat(token, 0.0);
    let (t, leaf) = work.met.packet(packet);
    let mut met = Surface {
        normal: V3::new(zero, zero, zero),
        face: zero,
    };
    // Each leaf that is met is asked once.
    let mut waiting = hit.to_bits();
    while waiting != 0 {
        let number = numbers[waiting.trailing_zeros() as usize % T::LANES];
        let here = leaf.eq(T::splat(token, number as f32)) & hit;
        waiting &= !here.to_bits();
        let own = leaf::surface(token, view, asked, number, packet, &mut work.rays, t);
        met = own.or_else(here, met);
    }
    met
}

/// Writes that some pixels show nothing.
#[inline(always)]
fn clear<T: Lanes>(tile: &mut Tile, pixels: Range<usize>, wants: Wants, nothing: T, zero: T) {
    nothing.store(&mut tile.distance[pixels.clone()]);
    nothing.store_numbers(&mut tile.leaf[pixels.clone()]);
    if wants.normals | wants.faces {
        let [x, y, z] = &mut tile.normal;
        zero.store(&mut x[pixels.clone()]);
        zero.store(&mut y[pixels.clone()]);
        zero.store(&mut z[pixels.clone()]);
    }
    if wants.faces {
        zero.store_numbers(&mut tile.face[pixels]);
    }
}
