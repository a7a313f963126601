//! From what the rays of a tile met first to its pixels.

use super::pixels::Tile;
use super::rays::{Rays, packets, start_of};
use super::state::Met;
use crate::lanes::{LaneMask, Lanes, MOST_LANES};
use crate::scene::View;
use gsdf_nostd::{Line, Mask, Solid, V3};

/// Writes the pixels of a tile; the normals only where they are wanted.
#[inline(always)]
pub(crate) fn shade<T: Lanes, L: Solid>(view: &View<'_, '_, L>, rays: &mut Rays<T>, met: &Met<T>, normals: bool, tile: &mut Tile) {
    for packet in 0..packets::<T>() {
        let (_, scale, _) = rays.packet(packet);
        let (t, leaf) = met.packet(packet);
        let nothing = scale.splat_like(f32::INFINITY);
        let along = t * scale;
        let hit = along.lt(nothing);
        let start = start_of::<T>(packet);
        let pixels = start..start + T::LANES;
        T::select(hit, along, nothing).store(&mut tile.distance[pixels.clone()]);
        let mut lanes = [f32::INFINITY; MOST_LANES];
        T::select(hit, leaf, nothing).store(&mut lanes);
        for (place, number) in tile.leaf[pixels.clone()].iter_mut().zip(lanes) {
            // What is infinite becomes `Tile::NO_LEAF`.
            *place = number as u32;
        }
        if normals {
            let normal = if hit.any() { surface(view, rays, packet, t, leaf, &lanes, hit) } else { zero(scale) };
            let [x, y, z] = &mut tile.normal;
            normal.x.store(&mut x[pixels.clone()]);
            normal.y.store(&mut y[pixels.clone()]);
            normal.z.store(&mut z[pixels]);
        }
    }
}

#[inline(always)]
fn zero<T: Lanes>(like: T) -> V3<T> {
    let zero = like.splat_like(0.0);
    V3::new(zero, zero, zero)
}

/// The normals of a packet, outward from the program, where it hits; zero elsewhere. Each leaf that is met is asked once.
#[inline(always)]
fn surface<T: Lanes, L: Solid>(
    view: &View<'_, '_, L>,
    rays: &mut Rays<T>,
    packet: usize,
    t: T,
    leaf: T,
    numbers: &[f32; MOST_LANES],
    hit: T::Mask,
) -> V3<T> {
    let mut normal = zero(t);
    let mut waiting = hit.to_bits();
    while waiting != 0 {
        let number = numbers[waiting.trailing_zeros() as usize % MOST_LANES];
        let here = leaf.eq(t.splat_like(number));
        waiting &= !here.to_bits();
        let own = leaf_normal(view, rays, packet, number as u32, t);
        normal = V3::select(here, own, normal);
    }
    V3::select(hit, normal, zero(t))
}

/// The normals of the leaf of a number where the rays of a packet hit it, outward from the program.
#[inline(always)]
fn leaf_normal<T: Lanes, L: Solid>(view: &View<'_, '_, L>, rays: &mut Rays<T>, packet: usize, number: u32, t: T) -> V3<T> {
    let scene = view.scene;
    let Some((place, literal)) = scene.literal(number) else { return zero(t) };
    let Some((solid, frame)) = scene.leaf(place) else { return zero(t) };
    let lines = rays.lines_in(frame, scene.program(), 1 << packet);
    let Some(line): Option<&Line<T>> = lines.get(packet) else { return zero(t) };
    let own = if view.shares_origin() {
        solid.surface_lifted(&view.seen(place, solid, frame), &line.toward, t)
    } else {
        solid.surface_along(line, t)
    };
    let outward = match scene.program().pose(frame) {
        Some(pose) => pose.normal_to_world(own.normal),
        None => own.normal,
    };
    if literal.negative { -outward } else { outward }
}
