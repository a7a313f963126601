//! The prism over a rhombus, with sharp or rounded edges.

use super::cylinder::SeenSide;
use super::polyhedron::{Caps, Crossed, SeenSlab, Within, from_segment};
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, length};
use crate::range::{larger, unit_scale};
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The upright prism over a rhombus whose diagonals are along x and z, grown by a rounding that leaves its vertical
/// edges round and its caps plain; turn it with a [`Transform`](crate::Transform).
///
#[cfg_attr(doc, doc = include_str!("../../pictures/rhombus.md"))]
#[cfg_attr(doc, doc = include_str!("../../pictures/rounded_rhombus.md"))]
///
/// It stores the heights of its caps, so that a cap shared with a neighbour is one and the same number.
///
/// - Standard: the prism over the distance to the rhombus, which is that to the side in the point's quadrant, less the
///   rounding, exact. Source: I. Quilez, Distance functions (rhombus).
/// - Along a ray: if sharp, the last entry into and the first exit from three slabs. If rounded, the outline is the
///   convex union of four discs around the rhombus's corners and of the octagon of the points where the sides touch
///   them, so the least entry and the last exit of the five, cut by the caps.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: seventeen products and two divisions
///   if sharp, one more division belonging to the ray; if rounded also four [`Cylinder`](super::Cylinder)s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rhombus {
    caps: Caps,
    half_x: f32,
    half_z: f32,
    rounding: f32,
    /// The power of two that brings the larger half diagonal into [1, 2).
    scale: f32,
}

/// A [`Rhombus`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenRhombus<T> {
    caps: SeenSlab<T>,
    /// Between opposite sides, in the order of the faces.
    sides: [SeenSlab<T>; 2],
    round: Option<SeenRound<T>>,
}

/// What rounding adds.
#[derive(Clone, Copy, Debug)]
struct SeenRound<T> {
    /// Between the chords across x, and across z, that lead from one side's end to the next one's.
    chords: [SeenSlab<T>; 2],
    /// From the middle line to the origin, along x and z.
    w: [T; 2],
    /// The offsets from the cylinders around the edges, in the order of the faces; the rest of these follows from `w`.
    offsets: [T; 4],
}

impl Rhombus {
    /// The prism from the rhombus around `bottom`, at its height, up to the height `top`, with corners `half_x` away
    /// along x and `half_z` away along z, grown outward by `rounding`; 0 leaves it sharp.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `top` is not above `bottom.y` by at least 2^-20, a half
    /// diagonal is not from 2^-20 to 2^30, or the rounding neither is nor is 0.
    pub const fn new(bottom: Vec3, top: f32, half_x: f32, half_z: f32, rounding: f32) -> Result<Self, Invalid> {
        const NAMES: [&str; 3] = ["rhombus bottom", "rhombus top", "rhombus top - bottom.y"];
        let caps = match Caps::new(NAMES, bottom, top) {
            Ok(caps) => caps,
            Err(error) => return Err(error),
        };
        let rounding = if rounding == 0.0 {
            Ok(0.0)
        } else {
            length("rhombus rounding", rounding)
        };
        match (length("rhombus half x", half_x), length("rhombus half z", half_z), rounding) {
            (Ok(half_x), Ok(half_z), Ok(rounding)) => Ok(Self {
                caps,
                half_x,
                half_z,
                rounding,
                scale: unit_scale(larger(half_x, half_z)),
            }),
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
        }
    }

    /// The middle of the bottom.
    #[must_use]
    pub const fn bottom(&self) -> Vec3 {
        self.caps.bottom()
    }

    /// The height of the top: a coordinate.
    #[must_use]
    pub const fn top(&self) -> f32 {
        self.caps.top()
    }

    /// Half the diagonal along x, without the rounding.
    #[must_use]
    pub const fn half_x(&self) -> f32 {
        self.half_x
    }

    /// Half the diagonal along z, without the rounding.
    #[must_use]
    pub const fn half_z(&self) -> f32 {
        self.half_z
    }

    /// By how much the rhombus is grown; 0 if its edges are sharp.
    #[must_use]
    pub const fn rounding(&self) -> f32 {
        self.rounding
    }

    /// The components of the sides' normals along x and z: the half diagonals along z and x, scaled.
    #[inline(always)]
    fn normal<T: Real>(&self, like: T) -> (T, T) {
        let scale = like.splat_like(self.scale);
        (like.splat_like(self.half_z) * scale, like.splat_like(self.half_x) * scale)
    }

    /// The length of the sides' normals.
    #[inline(always)]
    fn normal_length<T: Real>(&self, like: T) -> T {
        let (x, z) = self.normal(like);
        (x.squared() + z.squared()).sqrt()
    }

    /// The products of a vector with the normals of two sides, towards +x and +z and towards +x and -z.
    #[inline(always)]
    fn across<T: Real>(&self, v: V3<T>) -> (T, T) {
        let (along_x, along_z) = self.normal(v.x);
        let (x, z) = (v.x * along_x, v.z * along_z);
        (x + z, x - z)
    }

    /// The axis of the cylinders.
    #[inline(always)]
    fn axis<T: Real>(like: T) -> V3<T> {
        V3::splat(like, Vec3::Y)
    }

    /// The cylinders around the edges, in the order of the faces, seen from the point at `w` from the middle line.
    #[inline(always)]
    fn edges<T: Real>(&self, [x, z]: [T; 2]) -> [SeenSide<T>; 4] {
        let (half_x, half_z) = (x.splat_like(self.half_x), x.splat_like(self.half_z));
        let (zero, radius, axis) = (x.splat_like(0.0), x.splat_like(self.rounding), Self::axis(x));
        [
            SeenSide::new(V3::new(x + half_x, zero, z), axis, radius),
            SeenSide::new(V3::new(x - half_x, zero, z), axis, radius),
            SeenSide::new(V3::new(x, zero, z + half_z), axis, radius),
            SeenSide::new(V3::new(x, zero, z - half_z), axis, radius),
        ]
    }

    /// The same, with their offsets as they were settled.
    #[inline(always)]
    fn settled_edges<T: Real>(&self, round: &SeenRound<T>) -> [SeenSide<T>; 4] {
        let ([a, b, c, d], offsets) = (self.edges(round.w), round.offsets);
        [
            a.with_offset(offsets[0]),
            b.with_offset(offsets[1]),
            c.with_offset(offsets[2]),
            d.with_offset(offsets[3]),
        ]
    }

    #[inline(always)]
    fn round_seen_from<T: Real>(&self, w: V3<T>) -> SeenRound<T> {
        let (half_x, half_z) = (w.x.splat_like(self.half_x), w.x.splat_like(self.half_z));
        let (along_x, along_z) = self.normal(w.x);
        let share = w.x.splat_like(self.rounding) / self.normal_length(w.x);
        let [a, b, c, d] = self.edges([w.x, w.z]);
        SeenRound {
            chords: [
                SeenSlab::around(w.x, half_x + along_x * share),
                SeenSlab::around(w.z, half_z + along_z * share),
            ],
            w: [w.x, w.z],
            offsets: [a.offset(), b.offset(), c.offset(), d.offset()],
        }
    }

    /// The edges touch the sides smoothly, so an origin on the surface may be near several of them: each is settled by
    /// itself. The chords are no faces.
    #[inline(always)]
    fn grounded_round<T: Real>(&self, seen: SeenRound<T>, ground: &Ground<T>, extent: T) -> SeenRound<T> {
        let rounding = extent.splat_like(self.rounding);
        let [a, b, c, d] = self.settled_edges(&seen);
        SeenRound {
            offsets: [
                a.grounded(ground, 6.0, rounding, extent).offset(),
                b.grounded(ground, 7.0, rounding, extent).offset(),
                c.grounded(ground, 8.0, rounding, extent).offset(),
                d.grounded(ground, 9.0, rounding, extent).offset(),
            ],
            ..seen
        }
    }
}

impl<T: Real> SeenRound<T> {
    #[inline(always)]
    fn lift(seen: &SeenRound<T::Scalar>, like: T) -> Self {
        let ([x, z], [a, b, c, d]) = (&seen.chords, seen.offsets);
        Self {
            chords: [SeenSlab::lift(x, like), SeenSlab::lift(z, like)],
            w: [like.lift_like(seen.w[0]), like.lift_like(seen.w[1])],
            offsets: [like.lift_like(a), like.lift_like(b), like.lift_like(c), like.lift_like(d)],
        }
    }
}

impl Solid for Rhombus {
    type Seen<T: Real> = SeenRhombus<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let w = self.caps.to(p);
        let (half_x, half_z) = (p.x.splat_like(self.half_x), p.x.splat_like(self.half_z));
        let (along_x, along_z) = self.normal(p.x);
        // Mirrored to the side towards +x and +z, and from its corner on the axis x.
        let (x, z) = (w.x.abs() - half_x, w.z.abs());
        let (off_x, off_z) = from_segment((x, z), (-half_x, half_z));
        let away = (off_x.squared() + off_z.squared()).sqrt();
        let inside = (x * along_x + z * along_z).lt(p.x.splat_like(0.0));
        let across = T::select(inside, -away, away) - p.x.splat_like(self.rounding);
        self.caps.distance(across, p.y)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let like = origin.x;
        let w = self.caps.to(origin);
        let (rising, falling) = self.across(w);
        let (_, along_z) = self.normal(like);
        let sharp = along_z * like.splat_like(self.half_z);
        let (half, round) = if self.rounding == 0.0 {
            (sharp, None)
        } else {
            let grown = sharp + like.splat_like(self.rounding) * self.normal_length(like);
            (grown, Some(self.round_seen_from(w)))
        };
        SeenRhombus {
            caps: self.caps.seen_from(origin),
            sides: [SeenSlab::around(rising, half), SeenSlab::around(falling, half)],
            round,
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        let [rising, falling] = &seen.sides;
        SeenRhombus {
            caps: SeenSlab::lift(&seen.caps, like),
            sides: [SeenSlab::lift(rising, like), SeenSlab::lift(falling, like)],
            round: match &seen.round {
                Some(round) => Some(SeenRound::lift(round, like)),
                None => None,
            },
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        let scale = self.normal_length(one);
        let extent = one.splat_like(self.caps.extent(larger(self.half_x, self.half_z) + self.rounding));
        let [rising, falling] = seen.sides;
        SeenRhombus {
            caps: seen.caps.grounded(ground, 0.0, one, extent),
            sides: [
                rising.grounded(ground, 2.0, scale, extent),
                falling.grounded(ground, 4.0, scale, extent),
            ],
            round: match seen.round {
                Some(round) => Some(self.grounded_round(round, ground, extent)),
                None => None,
            },
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let (rising, falling) = self.across(toward.v);
        let per = toward.per_component;
        let caps = Within::slab(&seen.caps, per.y);
        let sides = Within::slab(&seen.sides[0], reciprocal_speed(rising)).and_slab(&seen.sides[1], reciprocal_speed(falling));
        let Some(round) = &seen.round else {
            return caps.and(sides).span();
        };
        let axis = Self::axis(toward.vv);
        let [a, b, c, d] = self.settled_edges(round);
        sides
            .and_slab(&round.chords[0], per.x)
            .and_slab(&round.chords[1], per.z)
            .span()
            .hull(a.span(axis, toward))
            .hull(b.span(axis, toward))
            .hull(c.span(axis, toward))
            .hull(d.span(axis, toward))
            // No more than the sides allow: a ray that leaves one beside its edge must not meet the edge by rounding.
            .intersection(sides.span())
            .intersection(caps.span())
    }

    /// Faces 0 and 1 are the bottom and the top, 2 and 3 the sides towards -x and -z and the opposite, 4 and 5 those
    /// towards -x and +z and the opposite; 6 to 9 are the rounded edges towards -x, +x, -z and +z. On a sharp edge and
    /// a seam the first of the faces that meet there.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let zero = t.splat_like(0.0);
        let (rising, falling) = self.across(toward.v);
        let (along_x, along_z) = self.normal(t);
        let per_length = t.splat_like(1.0) / self.normal_length(t);
        let (along_x, along_z) = (along_x * per_length, along_z * per_length);
        let mut last = Surface {
            normal: V3::new(along_x, zero, -along_z),
            face: t.splat_like(5.0),
        };
        if let Some(round) = &seen.round {
            let axis = Self::axis(t);
            let [first, second, third, fourth] = self.settled_edges(round);
            let ([a, b], [c, d]) = (
                round.chords[0].crossings(toward.per_component.x),
                round.chords[1].crossings(toward.per_component.z),
            );
            // From the last to the first, which stays.
            let around = [(9.0_f32, fourth, d), (8.0, third, c), (7.0, second, b), (6.0, first, a)];
            // Where a side goes over into an edge, rounding may leave it to the chord to bound the ray: the edge
            // beyond it is what is there.
            for (number, edge, chord) in &around {
                last = Surface::of_face(*number, edge.normal(axis, toward, t)).or_else(chord.eq(t), last);
            }
            for (number, edge, _) in &around {
                let ends = edge.span(axis, toward).ends_at(t);
                last = Surface::of_face(*number, edge.normal(axis, toward, t)).or_else(ends, last);
            }
        }
        let crossed = Crossed::at(t, last)
            .slab(4.0, V3::new(along_x, zero, -along_z), &seen.sides[1], reciprocal_speed(falling))
            .slab(2.0, V3::new(along_x, zero, along_z), &seen.sides[0], reciprocal_speed(rising));
        Caps::crossed(crossed, &seen.caps, toward)
    }

    fn grown(&self, by: f32) -> Option<Self> {
        let (bottom, top) = (self.bottom() - Vec3::Y * by, self.top() + by);
        if self.rounding > 0.0
            && let Ok(rounder) = Self::new(bottom, top, self.half_x, self.half_z, self.rounding + by)
        {
            return Some(rounder);
        }
        let side = by * libm::sqrtf(self.half_x * self.half_x + self.half_z * self.half_z);
        let (half_x, half_z) = (self.half_x + side / self.half_z, self.half_z + side / self.half_x);
        Self::new(bottom, top, half_x, half_z, self.rounding).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        // One more unit in the last place for the rounding of the sum.
        let reach = |half: f32| {
            if self.rounding == 0.0 {
                half
            } else {
                (half + self.rounding).next_up()
            }
        };
        let (x, z) = (reach(self.half_x), reach(self.half_z));
        Some(self.caps.bounds([-x, -z], [x, z]))
    }
}

#[cfg(test)]
mod tests {
    use super::Rhombus;
    use crate::leaf::Solid;
    use crate::ray::Ray;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        // The sides fall by 3 over 4: their normals are (3, 4) / 5, and they are 2.4 away.
        for rounding in [0.0, 1.0] {
            let tile = Rhombus::new(vec3(1.0, -1.0, 0.0), 3.0, 4.0, 3.0, rounding).unwrap();
            let near = |found: f32, wanted: f32| assert!((found - wanted).abs() < 1e-6, "{found} {wanted}");
            // Beyond each edge, over the sides and the caps, over a cap's rim, and inside.
            near(tile.sdf(vec3(8.0, 0.0, 0.0)), 3.0 - rounding);
            near(tile.sdf(vec3(1.0, 0.0, -5.0)), 2.0 - rounding);
            near(tile.sdf(vec3(1.0, 5.0, 1.0)), 2.0);
            near(tile.sdf(vec3(-6.0 - rounding, 7.0, 0.0)), 5.0);
            near(tile.sdf(vec3(1.0, 1.0, 0.0)), -2.0);
            near(tile.sdf(vec3(2.5, 1.0, 1.5)), (-0.3 - rounding).max(-2.0));
            for (x, z) in [(0.6, 0.8), (-0.6, 0.8), (0.6, -0.8), (-0.6, -0.8)] {
                let out = vec3(x, 0.0, z);
                near(tile.sdf(vec3(1.0, 1.0, 0.0) + 4.4 * out), 2.0 - rounding);
                near(tile.gsdf(vec3(1.0, 1.0, 0.0) + 4.4 * out, -out), 2.0 - rounding);
                near(tile.gsdf(vec3(1.0, 1.0, 0.0), out), -2.4 - rounding);
            }
            // At each edge, through the caps, over them, and past an edge.
            near(tile.gsdf(vec3(9.0, 0.0, 0.0), Vec3::NEG_X), 4.0 - rounding);
            near(tile.gsdf(vec3(-9.0, 0.0, 0.0), Vec3::X), 6.0 - rounding);
            near(tile.gsdf(vec3(1.0, 0.0, 9.0), Vec3::NEG_Z), 6.0 - rounding);
            near(tile.gsdf(vec3(1.0, 0.0, -9.0), Vec3::Z), 6.0 - rounding);
            near(tile.gsdf(vec3(1.0, 9.0, 2.0), Vec3::NEG_Y), 6.0);
            near(tile.gsdf(vec3(1.0, 0.0, 0.0), Vec3::NEG_Y), -1.0);
            assert_eq!(tile.gsdf(vec3(9.0, 3.0, 0.0), Vec3::NEG_X), f32::INFINITY);
            assert_eq!(tile.gsdf(vec3(9.0, 0.0, 3.0 + rounding), Vec3::NEG_X), f32::INFINITY);
            assert_eq!(tile.gsdf(vec3(5.0 + rounding, 0.0, 9.0), Vec3::NEG_Z), f32::INFINITY);
        }
        let round = Rhombus::new(Vec3::ZERO, 3.0, 4.0, 3.0, 1.0).unwrap();
        // Down through the round edge, and beside it.
        assert_eq!(round.gsdf(vec3(4.5, 9.0, 0.5), Vec3::NEG_Y), 6.0);
        assert_eq!(round.gsdf(vec3(4.75, 9.0, 0.75), Vec3::NEG_Y), f32::INFINITY);
    }

    #[test]
    fn seams_have_the_normal_of_both_their_sides() {
        let tile = Rhombus::new(vec3(1.0, -1.0, 0.5), 3.0, 4.0, 3.0, 1.0).unwrap();
        for (x, z) in [(0.6, 0.8), (-0.6, 0.8), (0.6, -0.8), (-0.6, -0.8)] {
            let out = vec3(x, 0.0, z);
            for corner in [vec3(4.0_f32.copysign(x), 0.0, 0.0), vec3(0.0, 0.0, 3.0_f32.copysign(z))] {
                let seam = vec3(1.0, -1.0, 0.5) + corner + out;
                for step in 0..2_000_u16 {
                    let share = f32::from(step) / 2_000.0;
                    let target = seam + Vec3::Y * (0.5 + 3.0 * share);
                    let away = out + vec3(z, 0.0, -x) * (1.4 * (97.0 * share).sin()) + Vec3::Y * (31.0 * share).cos();
                    let line = Ray::new(target + away * (1.0 + 7.0 * share), -away).unwrap().line(0.0_f32);
                    let seen = tile.seen_from(line.origin);
                    let enter = tile.span(&seen, &line.toward).enter;
                    let normal = Vec3::from(tile.surface(&seen, &line.toward, enter).normal);
                    assert!(normal.dot(out) > 0.999, "{normal} and not {out} at {target} towards {away}");
                }
            }
        }
    }
}
