//! From what the rays of a tile met first to its pixels.

use super::leaf;
use super::pixels::Tile;
use super::rays::{packets, start_of};
use super::state::Workspace;
use crate::lanes::{LaneMask, Lanes};
use crate::scene::View;
use gsdf_nostd::{Solid, V3};

/// Writes the pixels of a tile, the normals only where they are wanted, and tells how many show something.
#[inline(always)]
pub(crate) fn shade<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    normals: bool,
    work: &mut Workspace<T, L>,
    tile: &mut Tile,
) -> u32 {
    let mut hits = 0;
    let mut asked = leaf::Asked::none();
    let nothing = T::splat(token, f32::INFINITY);
    let zero = T::splat(token, 0.0);
    for packet in 0..packets::<T>() {
        let (_, scale, _) = work.rays.packet(packet);
        let (t, leaf) = work.met.packet(packet);
        let along = t * scale;
        let hit = along.lt(nothing);
        let start = start_of::<T>(packet);
        let pixels = start..start + T::LANES;
        T::select(hit, along, nothing).store(&mut tile.distance[pixels.clone()]);
        // What is infinite becomes `Tile::NO_LEAF`.
        let leaf = T::select(hit, leaf, nothing);
        leaf.store_numbers(&mut tile.leaf[pixels.clone()]);
        let waiting = hit.to_bits();
        hits += waiting.count_ones();
        if normals {
            let mut normal = V3::new(zero, zero, zero);
            // Each leaf that is met is asked once.
            let mut waiting = waiting;
            while waiting != 0 {
                let number = tile.leaf[start + waiting.trailing_zeros() as usize % T::LANES];
                let here = leaf.eq(T::splat(token, number as f32));
                waiting &= !here.to_bits();
                let own = leaf::normals(token, view, &mut asked, number, packet, &mut work.rays, t);
                normal = V3::select(here & hit, own, normal);
            }
            let [x, y, z] = &mut tile.normal;
            normal.x.store(&mut x[pixels.clone()]);
            normal.y.store(&mut y[pixels.clone()]);
            normal.z.store(&mut z[pixels]);
        }
    }
    hits
}
