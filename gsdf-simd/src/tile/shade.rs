//! From what the rays of a tile met first to its pixels.

use super::leaf;
use super::rays::{Rays, packets, start_of};
use super::state::Workspace;
use crate::lanes::{LaneMask, Lanes, MOST_LANES};
use crate::scene::View;
use gsdf_nostd::{Solid, V3};

/// Writes the pixels of a tile; the normals only where they are wanted.
#[inline(always)]
pub(crate) fn shade<T: Lanes, L: Solid>(token: T::Token, view: &View<'_, '_, L>, normals: bool, work: &mut Workspace<T, L>) {
    let nothing = T::splat(token, f32::INFINITY);
    let zero = T::splat(token, 0.0);
    for packet in 0..packets::<T>() {
        let (_, scale, _) = work.rays.packet(packet);
        let (t, leaf) = work.met.packet(packet);
        let along = t * scale;
        let hit = along.lt(nothing);
        let start = start_of::<T>(packet);
        let pixels = start..start + T::LANES;
        T::select(hit, along, nothing).store(&mut work.tile.distance[pixels.clone()]);
        let mut numbers = [f32::INFINITY; MOST_LANES];
        T::select(hit, leaf, nothing).store(&mut numbers);
        for (place, number) in work.tile.leaf[pixels.clone()].iter_mut().zip(numbers) {
            // What is infinite becomes `Tile::NO_LEAF`.
            *place = number as u32;
        }
        if normals {
            let mut normal = V3::new(zero, zero, zero);
            // Each leaf that is met is asked once.
            let mut waiting = hit.to_bits();
            while waiting != 0 {
                let number = numbers[waiting.trailing_zeros() as usize % MOST_LANES];
                let here = leaf.eq(T::splat(token, number));
                waiting &= !here.to_bits();
                let own = normal_of(token, view, number as u32, packet, &mut work.rays, t);
                normal = V3::select(here & hit, own, normal);
            }
            let [x, y, z] = &mut work.tile.normal;
            normal.x.store(&mut x[pixels.clone()]);
            normal.y.store(&mut y[pixels.clone()]);
            normal.z.store(&mut z[pixels]);
        }
    }
}

/// The normals of the leaf of a number, outward from the program, where the rays of a packet hit it.
#[inline(always)]
fn normal_of<T: Lanes, L: Solid>(token: T::Token, view: &View<'_, '_, L>, number: u32, packet: usize, rays: &mut Rays<T>, t: T) -> V3<T> {
    let Some((place, literal)) = view.scene.literal(number) else { return V3::new(t, t, t) };
    let outward = leaf::normals(token, view, place, packet, rays, t);
    if literal.negative { -outward } else { outward }
}
