//! One packet of any rays: each with an origin, a direction and a range of its own.

use super::leaf::Asked;
use super::shade::surface;
use super::state::Workspace;
use super::{AnyHit, visit};
use crate::lanes::{Lanes, MOST_LANES};
use crate::packet::Packet;
use crate::scene::{FANOUT, Group, Meets, Met, OF_DISTANCE, View};
use gsdf_nostd::{Line, Mask, Solid, V3};

/// What the rays of a packet hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<T: Lanes> {
    /// The parameters of the rays, infinite where they hit nothing.
    pub(crate) t: T,
    /// The numbers of the leaves, infinite where they hit nothing.
    pub(crate) leaf: T,
    /// The unit normals, zero where they hit nothing or none are wanted.
    pub(crate) normal: V3<T>,
}

/// Casts the rays of a packet: each at the first crossing within its range or, where `any` will do, at some.
#[inline(always)]
pub(crate) fn cast_packet<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    packet: &Packet<T>,
    any: bool,
    normals: bool,
    work: &mut Workspace<T, L>,
) -> Found<T> {
    let (line, scale, start) = packet.into_parts();
    let (end, valid) = (packet.end(), packet.valid());
    let nothing = T::splat(token, f32::INFINITY);
    work.rays.begin_with(&line, scale, start);
    work.met.clear();
    // What begins beyond the end of a range is as good as not there.
    work.met.replace(0, end / scale, nothing);
    let rays = Aimed::new(line, scale);
    let started = T::select(valid, start * scale, T::splat(token, 0.0));
    let any = any.then_some(AnyHit {
        end: end / scale,
        others: !valid,
        latest_start: started.greatest(),
    });
    visit(token, view, &rays, any, work);
    let (t, leaf) = work.met.packet(0);
    let along = t * scale;
    let hit = along.lt(end) & along.lt(nothing) & leaf.lt(nothing);
    let leaf = T::select(hit, leaf, nothing);
    let zero = T::splat(token, 0.0);
    let mut normal = V3::new(zero, zero, zero);
    if normals && hit.any() {
        let mut numbers = [0; MOST_LANES];
        leaf.store_numbers(&mut numbers);
        normal = surface(token, view, &mut Asked::none(), 0, &numbers, hit, work).normal;
    }
    Found {
        t: T::select(hit, along, nothing),
        leaf,
        normal,
    }
}

/// The rays of a packet, as they go through a tree.
struct Aimed<T: Lanes> {
    line: Line<T>,
    scale: T,
    /// How far from the middle of the world they start.
    reach: f32,
}

impl<T: Lanes> Aimed<T> {
    #[inline(always)]
    fn new(line: Line<T>, scale: T) -> Self {
        let V3 { x, y, z } = line.origin;
        Self {
            line,
            scale,
            reach: (x.abs() + y.abs() + z.abs()).greatest(),
        }
    }
}

impl<T: Lanes> Meets<T> for Aimed<T> {
    /// The slab test of each box with all rays.
    #[inline(always)]
    fn meet(&self, token: T::Token, group: &Group, _: bool, met: &mut Met) {
        met.bits = 0;
        let (zero, infinity) = (T::splat(token, 0.0), T::splat(token, f32::INFINITY));
        let (origin, per) = (self.line.origin, self.line.toward.per_component);
        let ([x, y, z], [half_x, half_y, half_z]) = (&group.center, &group.half);
        for place in 0..FANOUT {
            let center = V3::new(x[place], y[place], z[place]);
            let half = V3::new(half_x[place], half_y[place], half_z[place]);
            let distance = self.reach + (center.x.abs() + center.y.abs() + center.z.abs()) + (half.x + half.y + half.z);
            let margin = distance * OF_DISTANCE;
            let (mut enter, mut exit) = (zero, infinity);
            for (center, half, origin, per) in [
                (center.x, half.x, origin.x, per.x),
                (center.y, half.y, origin.y, per.y),
                (center.z, half.z, origin.z, per.z),
            ] {
                let half = half + margin;
                let low = (T::splat(token, center - half) - origin) * per;
                let high = (T::splat(token, center + half) - origin) * per;
                // A ray in the plane of a side has no number there: it is not held back by it.
                enter = low.min(high).max(enter);
                exit = low.max(high).min(exit);
            }
            let meets = enter.le(exit);
            if meets.any() {
                met.bits |= 1 << place;
                met.touched[place] = 1;
                met.near[place] = (T::select(meets, enter, infinity) * self.scale).least();
            }
        }
    }
}
