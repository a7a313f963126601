//! The capped cone, or frustum.

use super::cone::scale_of;
use super::conical_side::{Profile, SeenCone, frustum_distance};
use super::plane;
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, axis_between, ends, length};
use crate::range::{larger, max_norm};
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The cone between two discs of different, or equal, radii.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/capped_cone.md"))]
///
/// It stores both caps as positions, so that a cap shared with a neighbour is one and the same plane, to the bit.
///
/// - Standard: the nearer of the caps' and the side's segments in the half-plane through the axis, exact. Source: I.
///   Quilez, Distance functions.
/// - Along a ray: the side's span and the slab's, intersected. The side is taken from the bottom, not from an apex
///   that may be far away or not there at all.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: that of a [`Nappe`](super::Nappe)
///   and one division.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CappedCone {
    bottom: Vec3,
    top: Vec3,
    axis: Vec3,
    bottom_radius: f32,
    top_radius: f32,
    /// The power of two that brings the larger of radii and height into [1, 2), or nearly.
    scale: f32,
}

const NAMES: [&str; 3] = ["capped cone bottom", "capped cone top", "capped cone axis"];

/// A [`CappedCone`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenCappedCone<T> {
    side: SeenCone<T>,
    /// Height over the bottom, along the axis.
    over_bottom: T,
    /// Height over the top, along the axis.
    over_top: T,
}

impl CappedCone {
    /// The cone from the disc of `bottom_radius` around `bottom` to the disc of `top_radius` around `top`, the unit
    /// vector from the one towards the other being `axis`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `axis` is not of unit length or does not lead from `bottom`
    /// to `top`, these are nearer than 2^-20, or a radius is not from 2^-20 to 2^30. (With a radius of zero it is a
    /// [`Cone`](super::Cone).)
    pub const fn new(bottom: Vec3, top: Vec3, axis: Vec3, bottom_radius: f32, top_radius: f32) -> Result<Self, Invalid> {
        match (
            ends(NAMES, bottom, top, axis),
            length("capped cone bottom radius", bottom_radius),
            length("capped cone top radius", top_radius),
        ) {
            (Ok(()), Ok(bottom_radius), Ok(top_radius)) => Ok(Self {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
                scale: scale_of(bottom, top, larger(bottom_radius, top_radius)),
            }),
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
        }
    }

    /// The cone from the disc of `bottom_radius` around `bottom` to the disc of `top_radius` around `top`; not
    /// `const`, because the axis takes a square root.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn between(bottom: Vec3, top: Vec3, bottom_radius: f32, top_radius: f32) -> Result<Self, Invalid> {
        Self::new(bottom, top, axis_between(NAMES, bottom, top)?, bottom_radius, top_radius)
    }

    /// The centre of the cap the axis leads away from.
    #[must_use]
    pub const fn bottom(&self) -> Vec3 {
        self.bottom
    }

    /// The centre of the cap the axis leads to.
    #[must_use]
    pub const fn top(&self) -> Vec3 {
        self.top
    }

    /// The direction from bottom to top.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.axis
    }

    /// The radius of the bottom.
    #[must_use]
    pub const fn bottom_radius(&self) -> f32 {
        self.bottom_radius
    }

    /// The radius of the top.
    #[must_use]
    pub const fn top_radius(&self) -> f32 {
        self.top_radius
    }

    #[inline(always)]
    fn height<T: Real>(&self, like: T) -> T {
        (V3::splat(like, self.top) - V3::splat(like, self.bottom)).dot(V3::splat(like, self.axis))
    }

    #[inline(always)]
    fn profile<T: Real>(&self, like: T) -> Profile<T> {
        let scale = like.splat_like(self.scale);
        let bottom_radius = like.splat_like(self.bottom_radius);
        let k = self.height(like) * scale;
        let axis = V3::splat(like, self.axis);
        // The length of a vector that is nearly of unit length: √(1 + e) up to e³.
        let excess = axis.norm_squared() - like.splat_like(1.0);
        let axis_length = like.splat_like(1.0) + excess * (like.splat_like(0.5) - excess * like.splat_like(0.125));
        Profile {
            axis,
            r: bottom_radius * k * axis_length,
            s: (like.splat_like(self.top_radius) - bottom_radius) * scale,
            k,
        }
    }
}

impl Solid for CappedCone {
    type Seen<T: Real> = SeenCappedCone<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let like = p.x;
        let axis = V3::splat(like, self.axis);
        let w = p - V3::splat(like, self.bottom);
        frustum_distance(
            w.cross(axis).norm(),
            w.dot(axis),
            self.height(like),
            like.splat_like(self.bottom_radius),
            like.splat_like(self.top_radius),
        )
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let like = origin.x;
        let axis = V3::splat(like, self.axis);
        let w = origin - V3::splat(like, self.bottom);
        SeenCappedCone {
            side: SeenCone::new(w, &self.profile(like)),
            over_bottom: w.dot(axis),
            over_top: (origin - V3::splat(like, self.top)).dot(axis),
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenCappedCone {
            side: SeenCone::lift(&seen.side, like),
            over_bottom: like.lift_like(seen.over_bottom),
            over_top: like.lift_like(seen.over_top),
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        let radius = larger(self.bottom_radius, self.top_radius);
        let extent = one.splat_like(max_norm(self.bottom).max(max_norm(self.top)) + radius);
        SeenCappedCone {
            side: seen.side.grounded(&self.profile(one), ground, 0.0, extent),
            over_bottom: ground.settle(1.0, seen.over_bottom, one, extent),
            over_top: ground.settle(2.0, seen.over_top, one, extent),
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let profile = self.profile(toward.vv);
        let per_speed = reciprocal_speed(toward.v.dot(profile.axis));
        let slab = plane::slab(seen.over_bottom, seen.over_top, per_speed);
        seen.side.span(&profile, toward).intersection(slab)
    }

    /// Face 0 is the side, 1 the bottom, 2 the top. On a rim the cap.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let profile = self.profile(t);
        let per_speed = reciprocal_speed(toward.v.dot(profile.axis));
        let at_top = plane::crossing(seen.over_top, per_speed).eq(t);
        let at_bottom = plane::crossing(seen.over_bottom, per_speed).eq(t);
        let side = Surface::of_face(0.0, seen.side.normal(&profile, toward, t));
        let top = Surface::of_face(2.0, profile.axis).or_else(at_top, side);
        Surface::of_face(1.0, -profile.axis).or_else(at_bottom, top)
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn grown(&self, by: f32) -> Option<Self> {
        let height: f32 = self.height(0.0);
        let slope = (self.bottom_radius - self.top_radius) / height;
        // The side moves out across itself, and each cap is where it then cuts it.
        let out = by * libm::sqrtf(1.0 + slope * slope);
        let (bottom, top) = (self.bottom - self.axis * by, self.top + self.axis * by);
        Self::new(
            bottom,
            top,
            self.axis,
            self.bottom_radius + out + slope * by,
            self.top_radius + out - slope * by,
        )
        .ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        let bottom = Bounds::of_disc(self.bottom, self.axis, self.bottom_radius);
        Some(bottom.joined(Bounds::of_disc(self.top, self.axis, self.top_radius)))
    }
}

#[cfg(test)]
mod tests {
    use super::CappedCone;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let cup = CappedCone::new(Vec3::ZERO, vec3(0.0, 2.0, 0.0), Vec3::Y, 1.0, 3.0).unwrap();
        assert_eq!(cup.sdf(vec3(2.0, 5.0, 0.0)), 3.0);
        assert_eq!(cup.sdf(vec3(0.0, 0.25, 0.0)), -0.25);
        assert_eq!(cup.gsdf(vec3(5.0, 1.0, 0.0), Vec3::NEG_X), 3.0);
        assert_eq!(cup.gsdf(vec3(2.5, -1.0, 0.0), Vec3::Y), 2.5);
        assert_eq!(cup.gsdf(vec3(0.5, 1.0, 0.0), Vec3::NEG_Y), -1.0);
        assert_eq!(cup.gsdf(vec3(5.0, 2.5, 0.0), Vec3::NEG_X), f32::INFINITY);
    }

    #[test]
    fn with_equal_radii_it_is_a_cylinder() {
        let drum = CappedCone::new(Vec3::ZERO, vec3(0.0, 2.0, 0.0), Vec3::Y, 1.0, 1.0).unwrap();
        assert_eq!(drum.gsdf(vec3(5.0, 1.0, 0.0), Vec3::NEG_X), 4.0);
        assert_eq!(drum.gsdf(vec3(0.5, 5.0, 0.0), Vec3::NEG_Y), 3.0);
        assert_eq!(drum.gsdf(vec3(1.5, 5.0, 0.0), Vec3::NEG_Y), f32::INFINITY);
    }
}
