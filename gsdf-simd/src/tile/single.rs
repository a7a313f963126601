//! One packet of any rays: each with an origin, a direction and a range of its own.

use super::leaf::Asked;
use super::shade::surface;
use super::state::Workspace;
use super::{AnyHit, visit};
use crate::lanes::{LaneMask, Lanes, MOST_LANES};
use crate::packet::Packet;
use crate::scene::{FANOUT, Group, Meets, Met, OF_DISTANCE, View};
use crate::target::Wants;
use glam::Vec3;
use gsdf_nostd::{Line, Mask, OnSurface, Solid, Surface, V3};

/// One packet of any rays, and what is asked of them.
#[derive(Clone, Copy)]
pub(crate) struct Query<T: Lanes> {
    /// The rays.
    pub(crate) packet: Packet<T>,
    /// What they leave, if they start on surfaces.
    pub(crate) leaving: Option<OnSurface<T>>,
    /// Whether any crossing within their ranges will do instead of the first.
    pub(crate) any: bool,
    /// What is wanted of the hits, beside where they are and of which leaves.
    pub(crate) wants: Wants,
    /// Whether all rays are the same one.
    pub(crate) alone: bool,
}

impl<T: Lanes> Query<T> {
    /// The same asked of the first ray alone, which is in every lane then.
    #[inline(always)]
    pub(crate) fn of_first(&self) -> Self {
        let first = |lanes: T| lanes.splat_like(first_of(lanes));
        Self {
            packet: self.packet.alone(),
            leaving: self.leaving.map(
                #[inline(always)]
                |OnSurface { leaf, face, slack }| OnSurface {
                    leaf: first(leaf),
                    face: first(face),
                    slack: first(slack),
                },
            ),
            alone: true,
            ..*self
        }
    }
}

/// What the rays of a packet hit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<T: Lanes> {
    /// The parameters of the rays, infinite where they hit nothing.
    pub(crate) t: T,
    /// The numbers of the leaves, infinite where they hit nothing.
    pub(crate) leaf: T,
    /// The unit normals and the faces, zero where the rays hit nothing or neither is wanted.
    pub(crate) met: Surface<T>,
}

/// Whether the rays of a packet go about the same way from about the same place, in a scene of this extent: only then do they
/// meet about the same boxes, and are taken through a tree together.
#[inline(always)]
pub(crate) fn is_together<T: Lanes>(packet: &Packet<T>, extent: f32) -> bool {
    let (Line { origin, toward }, _, _) = packet.into_parts();
    let first = |v: V3<T>| V3::splat(v.x, Vec3::new(first_of(v.x), first_of(v.y), first_of(v.z)));
    let apart = origin - first(origin);
    let near = origin.x.splat_like(extent * NEARBY);
    let (v, w) = (toward.v, first(toward.v));
    let along = v.dot(w);
    let aligned = along.splat_like(0.0).lt(along) & (toward.vv * w.norm_squared() * along.splat_like(ALIGNED)).le(along.squared());
    let close = apart.x.abs().le(near) & apart.y.abs().le(near) & apart.z.abs().le(near);
    (aligned & close | !packet.valid()).all()
}

/// The square of the cosine of the widest angle between rays that are taken together: some 18 degrees.
const ALIGNED: f32 = 0.9;

/// How far their origins may be apart, as a share of the scene's extent.
const NEARBY: f32 = 1.0 / 16.0;

/// The first lane.
#[inline(always)]
fn first_of<T: Lanes>(lanes: T) -> f32 {
    lanes.lane(0).unwrap_or(0.0)
}

/// Casts the rays of a packet: each at the first crossing within its range or, where `any` will do, at some. They are taken
/// through trees together; or alone, if they are all the same one.
#[inline(always)]
pub(crate) fn cast_packet<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    query: &Query<T>,
    work: &mut Workspace<T, L>,
) -> Found<T> {
    let Query { packet, wants, .. } = query;
    let (line, scale, start) = packet.into_parts();
    let (end, valid) = (packet.end(), packet.valid());
    let nothing = T::splat(token, f32::INFINITY);
    work.rays.begin_with(&line, scale, start, query.leaving);
    work.met.clear();
    // What begins beyond the end of a range is as good as not there.
    work.met.replace(0, end / scale, nothing);
    let zero = T::splat(token, 0.0);
    let off = match query.leaving {
        Some(OnSurface { slack, .. }) => T::select(valid, slack * T::splat(token, view.scene.off_per_slack()), zero),
        None => zero,
    };
    let rays = Aimed::new(line, scale, off, query.alone);
    let started = T::select(valid, start * scale, zero);
    let any = query.any.then_some(AnyHit {
        end: end / scale,
        others: !valid,
        latest_start: started.greatest(),
    });
    visit(token, view, &rays, any, work);
    let (t, leaf) = work.met.packet(0);
    let along = t * scale;
    let hit = along.lt(end) & along.lt(nothing) & leaf.lt(nothing);
    let leaf = T::select(hit, leaf, nothing);
    let mut met = Surface {
        normal: V3::new(zero, zero, zero),
        face: zero,
    };
    if (wants.normals | wants.faces) && hit.any() {
        let mut numbers = [0; MOST_LANES];
        leaf.store_numbers(&mut numbers);
        met = surface(token, view, &mut Asked::none(), 0, &numbers, hit, work);
    }
    Found {
        t: T::select(hit, along, nothing),
        leaf,
        met,
    }
}

/// The rays of a packet, as they go through a tree.
struct Aimed<T: Lanes> {
    line: Line<T>,
    scale: T,
    /// How far from the middle of the world they start.
    reach: f32,
    /// By how much what they meet may be off because of where they start.
    off: T,
    /// Whether they are all the same one.
    alone: bool,
}

impl<T: Lanes> Aimed<T> {
    #[inline(always)]
    fn new(line: Line<T>, scale: T, off: T, alone: bool) -> Self {
        let V3 { x, y, z } = line.origin;
        Self {
            line,
            scale,
            reach: (x.abs() + y.abs() + z.abs()).greatest(),
            off,
            alone,
        }
    }

    /// Where each ray is within a box, or one ray within each, widened by a share of how far it is and how large, and by what
    /// its surface may be off: from where on, infinite where it is nowhere.
    #[inline(always)]
    fn enters(&self, center: V3<T>, half: V3<T>) -> T {
        let like = center.x;
        let distance = like.splat_like(self.reach) + (center.x.abs() + center.y.abs() + center.z.abs()) + (half.x + half.y + half.z);
        let margin = distance * like.splat_like(OF_DISTANCE) + self.off;
        let (origin, per) = (self.line.origin, self.line.toward.per_component);
        let (mut enter, mut exit) = (like.splat_like(0.0), like.splat_like(f32::INFINITY));
        for (center, half, origin, per) in [
            (center.x, half.x, origin.x, per.x),
            (center.y, half.y, origin.y, per.y),
            (center.z, half.z, origin.z, per.z),
        ] {
            let half = half + margin;
            let low = (center - half - origin) * per;
            let high = (center + half - origin) * per;
            // A ray in the plane of a side has no number there: it is not held back by it.
            enter = low.min(high).max(enter);
            exit = low.max(high).min(exit);
        }
        T::select(enter.le(exit), enter * self.scale, like.splat_like(f32::INFINITY))
    }

    /// The test of all boxes of a group with one ray, as many at once as there are lanes.
    #[inline(always)]
    fn meet_alone(&self, token: T::Token, group: &Group, met: &mut Met) {
        let mut from = 0;
        while from < FANOUT {
            let some = from..from + T::LANES;
            let load = |[x, y, z]: &[[f32; FANOUT]; 3]| {
                V3::new(
                    T::load(token, &x[some.clone()]),
                    T::load(token, &y[some.clone()]),
                    T::load(token, &z[some.clone()]),
                )
            };
            let near = self.enters(load(&group.center), load(&group.half));
            met.bits |= near.lt(T::splat(token, f32::INFINITY)).to_bits() << from;
            near.store(&mut met.near[some.clone()]);
            met.touched[some].fill(1);
            from += T::LANES;
        }
    }

    /// The test of each box of a group with all rays.
    #[inline(always)]
    fn meet_together(&self, token: T::Token, group: &Group, met: &mut Met) {
        let ([x, y, z], [half_x, half_y, half_z]) = (&group.center, &group.half);
        let splat = |value: f32| T::splat(token, value);
        for place in 0..FANOUT {
            let center = V3::new(splat(x[place]), splat(y[place]), splat(z[place]));
            let half = V3::new(splat(half_x[place]), splat(half_y[place]), splat(half_z[place]));
            let near = self.enters(center, half).least();
            if near < f32::INFINITY {
                met.bits |= 1 << place;
                met.touched[place] = 1;
                met.near[place] = near;
            }
        }
    }
}

impl<T: Lanes> Meets<T> for Aimed<T> {
    #[inline(always)]
    fn meet(&self, token: T::Token, group: &Group, _: bool, met: &mut Met) {
        met.bits = 0;
        if self.alone {
            self.meet_alone(token, group, met);
        } else {
            self.meet_together(token, group, met);
        }
    }
}
