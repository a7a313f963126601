//! The capsule: a cylinder with round ends.

use super::cylinder::SeenSide;
use super::plane;
use super::solid::{Bounds, Ground, Solid, Surface};
use super::sphere::{SeenSphere, Sphere};
use crate::invalid::{Fault, Invalid, length, point};
use crate::range::{MIN_LENGTH, max_norm, unit_scale};
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The points nearer to a segment than `radius`: the paper's spherical capped cylinder.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/capsule.md"))]
///
/// - Standard: the distance from the nearest point of the segment, less the radius, exact. Source: I. Quilez,
///   Distance functions.
/// - Along a ray: the union of two whole spheres and the cylinder between them is convex, so the least entry and the
///   last exit of the three. Whole spheres overlap the cylinder: there is no seam to miss. (The paper's hemispheres,
///   composed by minimum and maximum, are wrong beyond the end planes.)
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: two spheres and a capped
///   cylinder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Capsule {
    ends: [Sphere; 2],
    /// The power of two that brings the axis from the one end to the other near unit length.
    scale: f32,
}

/// A [`Capsule`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenCapsule<T> {
    ends: [SeenSphere<T>; 2],
    side: SeenSide<T>,
    /// Heights over the planes through the ends, along the axis.
    over: [T; 2],
}

impl Capsule {
    /// The capsule around the segment from `a` to `b`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, the ends are nearer than 2^-20 (then it is a [`Sphere`]), or
    /// the radius is not from 2^-20 to 2^30.
    pub const fn new(a: Vec3, b: Vec3, radius: f32) -> Result<Self, Invalid> {
        match (point("capsule a", a), point("capsule b", b), length("capsule radius", radius)) {
            (Ok(a), Ok(b), Ok(radius)) => {
                let reach = max_norm(Vec3::new(b.x - a.x, b.y - a.y, b.z - a.z));
                if reach < MIN_LENGTH {
                    return Err(Invalid::new("distance between capsule ends", reach, Fault::TooSmall));
                }
                Ok(Self {
                    ends: [Sphere::from_valid(a, radius), Sphere::from_valid(b, radius)],
                    scale: unit_scale(reach),
                })
            }
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
        }
    }

    /// The ends of the segment.
    #[must_use]
    pub const fn ends(&self) -> [Vec3; 2] {
        [self.ends[0].center(), self.ends[1].center()]
    }

    /// The radius.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.ends[0].radius()
    }

    /// The vector from the first end to the second, scaled by a power of two.
    #[inline(always)]
    fn axis<T: Real>(&self, like: T) -> V3<T> {
        let [a, b] = self.ends();
        (V3::splat(like, b) - V3::splat(like, a)).scaled(like.splat_like(self.scale))
    }
}

impl Solid for Capsule {
    type Seen<T: Real> = SeenCapsule<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let like = p.x;
        let [a, b] = self.ends();
        let from_a = p - V3::splat(like, a);
        let segment = V3::splat(like, b) - V3::splat(like, a);
        let along = from_a.dot(segment) / segment.norm_squared();
        let along = along.max(like.splat_like(0.0)).min(like.splat_like(1.0));
        (from_a - segment.scaled(along)).norm() - like.splat_like(self.radius())
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let like = origin.x;
        let [a, b] = self.ends();
        let (from_a, from_b) = (origin - V3::splat(like, a), origin - V3::splat(like, b));
        let axis = self.axis(like);
        SeenCapsule {
            ends: [self.ends[0].seen_from(origin), self.ends[1].seen_from(origin)],
            side: SeenSide::new(from_a, axis, like.splat_like(self.radius())),
            over: [from_a.dot(axis), from_b.dot(axis)],
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenCapsule {
            ends: [Sphere::lift(&seen.ends[0], like), Sphere::lift(&seen.ends[1], like)],
            side: SeenSide::lift(&seen.side, like),
            over: [like.lift_like(seen.over[0]), like.lift_like(seen.over[1])],
        }
    }

    /// The three parts meet smoothly, so an origin on the surface may be near all of them: each is settled by itself.
    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let radius = ground.face.splat_like(self.radius());
        let [a, b] = self.ends();
        let extent = radius + radius.splat_like(max_norm(a).max(max_norm(b)));
        let axis = self.axis(radius);
        SeenCapsule {
            ends: [
                self.ends[0].grounded(seen.ends[0], &ground.of_part(1.0)),
                self.ends[1].grounded(seen.ends[1], &ground.of_part(2.0)),
            ],
            side: seen.side.grounded(ground, 0.0, radius * axis.norm_squared(), extent),
            over: seen.over,
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let axis = self.axis(toward.vv);
        let slab = plane::slab(seen.over[0], seen.over[1], reciprocal_speed(toward.v.dot(axis)));
        let body = seen.side.span(axis, toward).intersection(slab);
        let first = self.ends[0].span(&seen.ends[0], toward);
        let second = self.ends[1].span(&seen.ends[1], toward);
        body.hull(first).hull(second)
    }

    /// Face 0 is the side, 1 the round end around the first point, 2 that around the second.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let at_first = self.ends[0].span(&seen.ends[0], toward).ends_at(t);
        let at_second = self.ends[1].span(&seen.ends[1], toward).ends_at(t);
        let first = Surface::of_face(1.0, self.ends[0].surface(&seen.ends[0], toward, t).normal);
        let second = Surface::of_face(2.0, self.ends[1].surface(&seen.ends[1], toward, t).normal);
        let side = Surface::of_face(0.0, seen.side.normal(self.axis(t), toward, t));
        first.or_else(at_first, second.or_else(at_second, side))
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn grown(&self, by: f32) -> Option<Self> {
        let [a, b] = self.ends();
        Self::new(a, b, self.radius() + by).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        let [first, second] = self.ends.map(|end| end.bounds());
        first.zip(second).map(|(first, second)| first.joined(second))
    }
}

#[cfg(test)]
mod tests {
    use super::Capsule;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let pill = Capsule::new(vec3(0.0, -1.0, 0.0), vec3(0.0, 1.0, 0.0), 0.5).unwrap();
        assert_eq!(pill.sdf(vec3(3.0, 0.5, 0.0)), 2.5);
        assert_eq!(pill.sdf(vec3(0.0, 4.0, 0.0)), 2.5);
        assert_eq!(pill.sdf(vec3(0.0, 0.5, 0.0)), -0.5);
        // The side, a round end, and from end to end.
        assert_eq!(pill.gsdf(vec3(3.0, 0.5, 0.0), Vec3::NEG_X), 2.5);
        assert_eq!(pill.gsdf(vec3(0.0, 4.0, 0.0), Vec3::NEG_Y), 2.5);
        assert_eq!(pill.gsdf(vec3(0.0, 1.25, 0.0), Vec3::NEG_Y), -2.75);
        assert_eq!(pill.gsdf(vec3(3.0, 1.5, 0.0), Vec3::NEG_X), f32::INFINITY);
    }
}
