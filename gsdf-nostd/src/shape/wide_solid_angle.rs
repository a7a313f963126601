//! The wide solid angle: a hemisphere, or more of a ball.

use super::readings;
use crate::csg::{Csg, Node};
use crate::invalid::{Fault, Invalid, coordinate, length, point, unit};
use crate::leaf::{Bounds, HalfSpace, Leaf, Nappe, Sphere, sector_bounds, sector_distance};
use crate::real::Real;
use crate::vec3::V3;
use glam::Vec3;

/// The points nearer to `apex` than `reach` whose direction from there makes less than the half-angle with `axis`, that
/// being from 90 to below 180 degrees: a ball less the opposite cone. Narrower ones are a
/// [`SolidAngle`](crate::SolidAngle).
///
#[cfg_attr(doc, doc = include_str!("../../pictures/wide_solid_angle.md"))]
///
/// - Standard: the nearer of the round end and the side, exact on both sides. Source: I. Quilez, Distance functions
///   (solid angle).
/// - Along a ray: that of the [program](Self::program).
/// - Accuracy: that of [`Sphere`] and [`Nappe`]. Cost: one of each and a difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WideSolidAngle {
    ball: Sphere,
    /// What the ball lacks: a nappe, or a half-space.
    lacking: Leaf,
    axis: Vec3,
    radius: f32,
    height: f32,
}

readings!(WideSolidAngle of 3 nodes);

impl WideSolidAngle {
    /// The part of the ball of radius `reach` around `apex` in the directions from there that are less far from the unit
    /// vector `axis` than one to a point at `radius` from the axis and at the height `height <= 0` along it.
    ///
    /// Radius and height are a slope, not an angle: an angle near 90 or 180 degrees would lose it. At height 0 it is a
    /// hemisphere.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `axis` is not of unit length, the reach or the radius is not
    /// from 2^-20 to 2^30, the height is neither 0 nor from -2^30 to -2^-20, or radius or height is more than 2^20
    /// times the other.
    pub const fn new(apex: Vec3, axis: Vec3, reach: f32, radius: f32, height: f32) -> Result<Self, Invalid> {
        match (
            point("wide solid angle apex", apex),
            unit("wide solid angle axis", axis),
            length("wide solid angle reach", reach),
            length("wide solid angle radius", radius),
        ) {
            (Ok(_), Ok(_), Ok(_), Ok(_)) => {}
            (Err(error), ..) | (_, Err(error), ..) | (_, _, Err(error), _) | (.., Err(error)) => return Err(error),
        }
        let lacking = match coordinate("wide solid angle height", height) {
            Ok(0.0) => half_space(apex, axis),
            Ok(height) if height > 0.0 => Err(Invalid::new("wide solid angle height", height, Fault::NotWide)),
            Ok(height) => opposite_nappe(apex, axis, radius, height),
            Err(error) => Err(error),
        };
        match (Sphere::new(apex, reach), lacking) {
            (Ok(ball), Ok(lacking)) => Ok(Self {
                ball,
                lacking,
                axis,
                radius,
                height,
            }),
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// The tip of what it lacks, and the centre of the ball.
    #[must_use]
    pub const fn apex(&self) -> Vec3 {
        self.ball.center()
    }

    /// The direction in the middle of it.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.axis
    }

    /// The radius of the ball.
    #[must_use]
    pub const fn reach(&self) -> f32 {
        self.ball.radius()
    }

    /// The tangent of the half-angle: negative, or -inf for a hemisphere.
    #[must_use]
    pub const fn slope(&self) -> f32 {
        -self.radius / self.height.abs()
    }

    /// The solid as a program: leaf 0 is the ball, 1 the nappe, or half-space, that is taken from it.
    ///
    /// Its own [`sdf`](Csg::sdf) has the sign of [`sdf`](Self::sdf), and is a lower bound of its magnitude.
    #[must_use]
    pub const fn program(&self) -> Csg<{ Self::NODES }> {
        Csg::from_binary([Node::leaf(Leaf::Sphere(self.ball)), Node::leaf(self.lacking), Node::Difference])
    }

    /// The standard signed distance from `p`, in any arithmetic.
    #[inline(always)]
    pub fn distance<T: Real>(&self, p: V3<T>) -> T {
        let like = p.x;
        let w = p - V3::splat(like, self.apex());
        let (radius, height) = (like.splat_like(self.radius), like.splat_like(self.height));
        sector_distance(w, V3::splat(like, self.axis), radius, height, like.splat_like(self.reach()))
    }

    /// A box around it.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        Some(sector_bounds(self.apex(), self.axis, self.radius, self.height, self.reach()))
    }
}

/// What a hemisphere lacks of its ball.
const fn half_space(apex: Vec3, axis: Vec3) -> Result<Leaf, Invalid> {
    match HalfSpace::new(apex, axis) {
        Ok(half_space) => Ok(Leaf::HalfSpace(half_space)),
        Err(error) => Err(error),
    }
}

/// What more than a hemisphere lacks of its ball.
const fn opposite_nappe(apex: Vec3, axis: Vec3, radius: f32, height: f32) -> Result<Leaf, Invalid> {
    let opposite = Vec3::new(-axis.x, -axis.y, -axis.z);
    match Nappe::new(apex, opposite, radius, -height) {
        Ok(nappe) => Ok(Leaf::Nappe(nappe)),
        // All but height and slope was looked at before.
        Err(error) => Err(Invalid::new("wide solid angle radius : -height", error.found(), error.fault())),
    }
}

#[cfg(test)]
mod tests {
    use super::WideSolidAngle;
    use crate::invalid::Fault;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        // A ball of radius 5 with a cone cut out of it whose rim is at (3, -4).
        let apple = WideSolidAngle::new(Vec3::ZERO, Vec3::Y, 5.0, 3.0, -4.0).unwrap();
        assert_eq!(apple.sdf(vec3(0.0, 7.0, 0.0)), 2.0);
        assert_eq!(apple.sdf(vec3(0.0, 1.0, 0.0)), -1.0);
        assert_eq!(apple.sdf(vec3(0.0, 4.5, 0.0)), -0.5);
        // In the cone, under it, and in the flesh beside it.
        assert!((apple.sdf(vec3(0.0, -2.0, 0.0)) - 1.2).abs() < 1e-6);
        assert!((apple.sdf(vec3(0.0, -8.0, 0.0)) - 5.0).abs() < 1e-6);
        assert!((apple.sdf(vec3(1.5 + 0.4, -2.0 + 0.3, 0.0)) + 0.5).abs() < 1e-6);
        assert_eq!(apple.gsdf(vec3(0.0, -9.0, 0.0), Vec3::Y), 9.0);
        assert_eq!(apple.gsdf(vec3(0.0, 1.0, 0.0), Vec3::NEG_Y), -1.0);
        assert_eq!(apple.gsdf(vec3(0.0, -2.0, 0.0), Vec3::X), 1.5);
        assert_eq!(apple.gsdf(vec3(9.0, 0.0, 0.0), Vec3::NEG_X), 4.0);
    }

    #[test]
    fn a_hemisphere_by_hand() {
        let bowl = WideSolidAngle::new(Vec3::ZERO, Vec3::Y, 5.0, 1.0, 0.0).unwrap();
        assert_eq!(bowl.sdf(vec3(1.0, -2.0, 0.0)), 2.0);
        assert_eq!(bowl.sdf(vec3(1.0, 2.0, 0.0)), -2.0);
        assert_eq!(bowl.sdf(vec3(8.0, -4.0, 0.0)), 5.0);
        assert_eq!(bowl.gsdf(vec3(1.0, -2.0, 0.0), Vec3::Y), 2.0);
        assert_eq!(bowl.gsdf(vec3(0.0, 9.0, 0.0), Vec3::NEG_Y), 4.0);
        assert_eq!(bowl.gsdf(vec3(9.0, -0.5, 0.0), Vec3::NEG_X), f32::INFINITY);
    }

    #[test]
    fn narrow_ones_are_refused() {
        let fault = |height| WideSolidAngle::new(Vec3::ZERO, Vec3::Y, 5.0, 1.0, height).map_err(|error| error.fault());
        assert_eq!(fault(1.0), Err(Fault::NotWide));
        assert_eq!(fault(-1e-7), Err(Fault::TooSmall));
        assert_eq!(fault(-2e6), Err(Fault::NotAcute));
        assert_eq!(fault(f32::NAN), Err(Fault::NotFinite));
        assert!(fault(-1e6).is_ok() && fault(-0.0).is_ok());
    }
}
