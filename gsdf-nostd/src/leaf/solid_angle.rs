//! The solid angle: a ball's part within a cone.

use super::conical_side::SeenCone;
use super::nappe::Nappe;
use super::sector::{sector_bounds, sector_distance};
use super::solid::{Bounds, Ground, Solid, Surface};
use super::sphere::{SeenSphere, Sphere};
use crate::invalid::{Invalid, length, point, unit};
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// The points nearer to `apex` than `reach` whose direction from there makes less than the half-angle with `axis`: a
/// spherical sector of less than a hemisphere. Wider ones are a [`WideSolidAngle`](crate::WideSolidAngle).
///
#[cfg_attr(doc, doc = include_str!("../../pictures/solid_angle.md"))]
///
/// - Standard: the nearer of the round end and the side, exact. Source: I. Quilez, Distance functions (solid angle).
/// - Along a ray: the ball's span and the nappe's, intersected.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: that of a [`Nappe`] and a
///   [`Sphere`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolidAngle {
    nappe: Nappe,
    reach: f32,
}

/// A [`SolidAngle`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenSolidAngle<T> {
    side: SeenCone<T>,
    ball: SeenSphere<T>,
}

impl SolidAngle {
    /// The part of the ball of radius `reach` around `apex` that lies in the nappe which opens along the unit vector
    /// `axis` and has `radius` at the height `height`.
    ///
    /// Radius and height are a slope, not an angle: an angle near 0 or 90 degrees would lose it.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `axis` is not of unit length, or the reach, the radius or the
    /// height is not from 2^-20 to 2^30, or radius or height is more than 2^20 times the other.
    pub const fn new(apex: Vec3, axis: Vec3, reach: f32, radius: f32, height: f32) -> Result<Self, Invalid> {
        match (
            point("solid angle apex", apex),
            unit("solid angle axis", axis),
            length("solid angle reach", reach),
        ) {
            (Ok(_), Ok(_), Ok(_)) => {}
            (Err(error), ..) | (_, Err(error), _) | (.., Err(error)) => return Err(error),
        }
        match (length("solid angle radius", radius), length("solid angle height", height)) {
            (Ok(_), Ok(_)) => {}
            (Err(error), _) | (_, Err(error)) => return Err(error),
        }
        match Nappe::new(apex, axis, radius, height) {
            Ok(nappe) => Ok(Self { nappe, reach }),
            // All but the slope was looked at above.
            Err(error) => Err(Invalid::new("solid angle radius : height", error.found(), error.fault())),
        }
    }

    /// The tip, and the centre of the round end.
    #[must_use]
    pub const fn apex(&self) -> Vec3 {
        self.nappe.apex()
    }

    /// The direction in which it opens.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.nappe.axis()
    }

    /// The radius of the round end.
    #[must_use]
    pub const fn reach(&self) -> f32 {
        self.reach
    }

    /// The tangent of the half-angle.
    #[must_use]
    pub const fn slope(&self) -> f32 {
        self.nappe.slope()
    }

    const fn ball(&self) -> Sphere {
        Sphere::from_valid(self.nappe.apex(), self.reach)
    }
}

impl Solid for SolidAngle {
    type Seen<T: Real> = SeenSolidAngle<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let side = self.nappe.profile(p.x);
        let w = p - V3::splat(p.x, self.apex());
        sector_distance(w, side.axis, side.s, side.k, p.x.splat_like(self.reach))
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        SeenSolidAngle {
            side: self.nappe.seen_from(origin),
            ball: self.ball().seen_from(origin),
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenSolidAngle {
            side: Nappe::lift(&seen.side, like),
            ball: Sphere::lift(&seen.ball, like),
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let by_ball = Ground {
            face: ground.face - ground.face.splat_like(1.0),
            ..*ground
        };
        SeenSolidAngle {
            side: self.nappe.grounded(seen.side, ground),
            ball: self.ball().grounded(seen.ball, &by_ball),
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let ball = self.ball().span(&seen.ball, toward);
        self.nappe.span(&seen.side, toward).intersection(ball)
    }

    /// Face 0 is the side, 1 the round end. On the rim the round end.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let ball = self.ball().span(&seen.ball, toward);
        let round = Surface {
            normal: self.ball().surface(&seen.ball, toward, t).normal,
            face: t.splat_like(1.0),
        };
        round.or_else(ball.enter.eq(t) | ball.exit.eq(t), self.nappe.surface(&seen.side, toward, t))
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn bounds(&self) -> Option<Bounds> {
        let side = self.nappe.profile(0.0_f32);
        Some(sector_bounds(self.apex(), self.axis(), side.s, side.k, self.reach))
    }
}

#[cfg(test)]
mod tests {
    use super::SolidAngle;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        // Half-angle with tangent 3 : 4; its rim is at (3, 4).
        let wedge = SolidAngle::new(Vec3::ZERO, Vec3::Y, 5.0, 3.0, 4.0).unwrap();
        assert_eq!(wedge.sdf(vec3(0.0, 7.0, 0.0)), 2.0);
        assert_eq!(wedge.sdf(vec3(0.0, 4.5, 0.0)), -0.5);
        assert_eq!(wedge.sdf(vec3(0.0, -2.0, 0.0)), 2.0);
        assert!((wedge.sdf(vec3(0.0, 1.0, 0.0)) + 0.6).abs() < 1e-6);
        // Beside the side, and beyond the rim.
        assert!((wedge.sdf(vec3(1.5 + 0.8, 2.0 - 0.6, 0.0)) - 1.0).abs() < 1e-6);
        assert!((wedge.sdf(vec3(3.0 + 1.5, 4.0, 0.0)) - 1.5).abs() < 1e-6);
        assert_eq!(wedge.gsdf(vec3(0.0, 9.0, 0.0), Vec3::NEG_Y), 4.0);
        assert_eq!(wedge.gsdf(vec3(9.0, 2.0, 0.0), Vec3::NEG_X), 7.5);
        assert_eq!(wedge.gsdf(vec3(0.0, 2.0, 0.0), Vec3::X), -1.5);
        assert_eq!(wedge.gsdf(vec3(0.0, 1.0, 0.0), Vec3::Y), -4.0);
        // Where the other nappe and the rest of the ball would be.
        assert_eq!(wedge.gsdf(vec3(9.0, -1.0, 0.0), Vec3::NEG_X), f32::INFINITY);
        assert_eq!(wedge.gsdf(vec3(9.0, 5.5, 0.0), Vec3::NEG_X), f32::INFINITY);
    }

    #[test]
    fn bounds_touch_the_round_end_and_the_rim() {
        let wedge = SolidAngle::new(Vec3::ZERO, Vec3::Y, 5.0, 3.0, 4.0).unwrap();
        let bounds = wedge.bounds().unwrap();
        assert!((bounds.max - vec3(3.0, 5.0, 3.0)).abs().max_element() < 1e-4);
        assert!((bounds.min - vec3(-3.0, 0.0, -3.0)).abs().max_element() < 1e-4);
    }
}
