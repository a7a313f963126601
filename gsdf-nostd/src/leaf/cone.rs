//! The finite cone.

use super::conical_side::{Profile, SeenCone, frustum_distance};
use super::plane;
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, axis_between, ends, length};
use crate::range::{larger, max_norm, unit_scale};
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The cone between its tip and a base: the part of a nappe before the plane through `base` across its axis.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/cone.md"))]
///
/// It stores the base as a position, so that a base shared with a neighbour is one and the same plane, to the bit.
///
/// - Standard: the nearer of the base's and the side's segment in the half-plane through the axis, exact. Source: I.
///   Quilez, Distance functions.
/// - Along a ray: the nappe's span and the half-space's, intersected. (The paper calls it a union; it is the
///   intersection, and of a single nappe.)
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: that of a [`Nappe`](super::Nappe)
///   and one division.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    apex: Vec3,
    base: Vec3,
    axis: Vec3,
    radius: f32,
    /// The power of two that brings the larger of radius and height into [1, 2), or nearly.
    scale: f32,
}

const NAMES: [&str; 3] = ["cone apex", "cone base", "cone axis"];

/// A [`Cone`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenFiniteCone<T> {
    side: SeenCone<T>,
    /// Height over the base, along the axis: negative towards the apex.
    over_base: T,
}

impl Cone {
    /// The cone from `apex` to the disc of `radius` around `base`, the unit vector from the one towards the other
    /// being `axis`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `axis` is not of unit length or does not lead from `apex` to
    /// `base`, these are nearer than 2^-20, or the radius is not from 2^-20 to 2^30.
    pub const fn new(apex: Vec3, base: Vec3, axis: Vec3, radius: f32) -> Result<Self, Invalid> {
        match (ends(NAMES, apex, base, axis), length("cone radius", radius)) {
            (Ok(()), Ok(radius)) => Ok(Self {
                apex,
                base,
                axis,
                radius,
                scale: scale_of(apex, base, radius),
            }),
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// The cone from `apex` to the disc of `radius` around `base`; not `const`, because the axis takes a square root.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn between(apex: Vec3, base: Vec3, radius: f32) -> Result<Self, Invalid> {
        Self::new(apex, base, axis_between(NAMES, apex, base)?, radius)
    }

    /// The tip.
    #[must_use]
    pub const fn apex(&self) -> Vec3 {
        self.apex
    }

    /// The centre of the base.
    #[must_use]
    pub const fn base(&self) -> Vec3 {
        self.base
    }

    /// The direction from the tip to the base.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.axis
    }

    /// The radius of the base.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    #[inline(always)]
    fn height<T: Real>(&self, like: T) -> T {
        (V3::splat(like, self.base) - V3::splat(like, self.apex)).dot(V3::splat(like, self.axis))
    }

    #[inline(always)]
    fn profile<T: Real>(&self, like: T) -> Profile<T> {
        let scale = like.splat_like(self.scale);
        Profile {
            axis: V3::splat(like, self.axis),
            r: like.splat_like(0.0),
            s: like.splat_like(self.radius) * scale,
            k: self.height(like) * scale,
        }
    }
}

/// The power of two that brings the sizes of a cone near one.
pub(super) const fn scale_of(from: Vec3, to: Vec3, radius: f32) -> f32 {
    let reach = Vec3::new(to.x - from.x, to.y - from.y, to.z - from.z);
    unit_scale(larger(max_norm(reach), radius))
}

impl Solid for Cone {
    type Seen<T: Real> = SeenFiniteCone<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let like = p.x;
        let axis = V3::splat(like, self.axis);
        let w = p - V3::splat(like, self.base);
        let radius = like.splat_like(self.radius);
        let zero = like.splat_like(0.0);
        frustum_distance(w.cross(axis).norm(), -w.dot(axis), self.height(like), radius, zero)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let like = origin.x;
        SeenFiniteCone {
            side: SeenCone::new(origin - V3::splat(like, self.apex), &self.profile(like)),
            over_base: (origin - V3::splat(like, self.base)).dot(V3::splat(like, self.axis)),
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenFiniteCone {
            side: SeenCone::lift(&seen.side, like),
            over_base: like.lift_like(seen.over_base),
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        let extent = one.splat_like(max_norm(self.apex).max(max_norm(self.base)) + self.radius);
        SeenFiniteCone {
            side: seen.side.grounded(&self.profile(one), ground, 0.0, extent),
            over_base: ground.settle(1.0, seen.over_base, one, extent),
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let profile = self.profile(toward.vv);
        let (enter, exit) = plane::below(seen.over_base, reciprocal_speed(toward.v.dot(profile.axis)));
        seen.side.span(&profile, toward).intersection(Span::between(enter, exit))
    }

    /// Face 0 is the side, 1 the base. On the rim the base.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let profile = self.profile(t);
        let at_base = plane::crossing(seen.over_base, reciprocal_speed(toward.v.dot(profile.axis))).eq(t);
        let side = Surface {
            normal: seen.side.normal(&profile, toward, t),
            face: t.splat_like(0.0),
        };
        let base = Surface {
            normal: profile.axis,
            face: t.splat_like(1.0),
        };
        base.or_else(at_base, side)
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn grown(&self, by: f32) -> Option<Self> {
        let height: f32 = self.height(0.0);
        let side = libm::sqrtf(self.radius * self.radius + height * height);
        // The tip recedes until the side is as far as it should be.
        let tip = by * side / self.radius;
        let radius = self.radius * (height + tip + by) / height;
        Self::new(self.apex - self.axis * tip, self.base + self.axis * by, self.axis, radius).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        let tip = Bounds::around(self.apex, Vec3::ZERO);
        Some(tip.joined(Bounds::of_disc(self.base, self.axis, self.radius)))
    }
}

#[cfg(test)]
mod tests {
    use super::Cone;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let hat = Cone::new(vec3(0.0, 2.0, 0.0), Vec3::ZERO, Vec3::NEG_Y, 2.0).unwrap();
        assert_eq!(hat.sdf(vec3(0.0, 5.0, 0.0)), 3.0);
        assert_eq!(hat.sdf(vec3(1.0, -3.0, 0.0)), 3.0);
        assert_eq!(hat.sdf(vec3(0.0, 0.25, 0.0)), -0.25);
        assert_eq!(hat.gsdf(vec3(5.0, 1.0, 0.0), Vec3::NEG_X), 4.0);
        assert_eq!(hat.gsdf(vec3(1.0, -3.0, 0.0), Vec3::Y), 3.0);
        assert_eq!(hat.gsdf(vec3(1.0, 0.5, 0.0), Vec3::Y), -0.5);
        // Over the tip, where the other nappe would be, and under the base.
        assert_eq!(hat.gsdf(vec3(5.0, 3.0, 0.0), Vec3::NEG_X), f32::INFINITY);
        assert_eq!(hat.gsdf(vec3(5.0, -1.0, 0.0), Vec3::NEG_X), f32::INFINITY);
    }
}
