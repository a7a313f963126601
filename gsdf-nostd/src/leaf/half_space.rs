//! The half-space: all that lies below a plane.

use super::plane;
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, point, unit};
use crate::range::max_norm;
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The half-space of the points `x` with `(x - point) . normal < 0`: the paper's plane, with the side it leaves open
/// decided.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/half_space.md"))]
///
/// - Standard: `(p - s) . n`, exact.
/// - Along a ray: the root is `t = -(p - s) . n / (v . n)`. (The paper prints it without the minus.) A ray parallel
///   to the plane is inside all the way or never, a ray in the plane never.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: two scalar products, one
///   division.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HalfSpace {
    point: Vec3,
    normal: Vec3,
}

/// A [`HalfSpace`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenHalfSpace<T> {
    /// The height of the origin over the plane.
    height: T,
}

impl HalfSpace {
    /// The half-space below the plane through `point` whose unit `normal` points away from it.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, or `normal` is not of unit length (to 2^-21 of its square).
    pub const fn new(at: Vec3, normal: Vec3) -> Result<Self, Invalid> {
        match (point("half-space point", at), unit("half-space normal", normal)) {
            (Ok(point), Ok(normal)) => Ok(Self { point, normal }),
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// A point of the bounding plane.
    #[must_use]
    pub const fn point(&self) -> Vec3 {
        self.point
    }

    /// The normal of the bounding plane, away from the half-space.
    #[must_use]
    pub const fn normal(&self) -> Vec3 {
        self.normal
    }
}

impl Solid for HalfSpace {
    type Seen<T: Real> = SeenHalfSpace<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        (p - V3::splat(p.x, self.point)).dot(V3::splat(p.x, self.normal))
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        SeenHalfSpace {
            height: self.distance(origin),
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenHalfSpace {
            height: like.lift_like(seen.height),
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = seen.height.splat_like(1.0);
        let extent = one.splat_like(max_norm(self.point));
        SeenHalfSpace {
            height: ground.settle(0.0, seen.height, one, extent),
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let speed = toward.v.dot(V3::splat(toward.vv, self.normal));
        let (enter, exit) = plane::below(seen.height, reciprocal_speed(speed));
        Span::between(enter, exit)
    }

    #[inline(always)]
    fn surface<T: Real>(&self, _: &Self::Seen<T>, _: &Toward<T>, t: T) -> Surface<T> {
        Surface {
            normal: V3::splat(t, self.normal),
            face: t.splat_like(0.0),
        }
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn bounds(&self) -> Option<Bounds> {
        None
    }

    fn as_half_space(&self) -> Option<HalfSpace> {
        Some(*self)
    }
}

#[cfg(test)]
mod tests {
    use super::HalfSpace;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let floor = HalfSpace::new(vec3(5.0, 1.0, -7.0), Vec3::Y).unwrap();
        assert_eq!(floor.sdf(vec3(0.0, 3.0, 0.0)), 2.0);
        assert_eq!(floor.sdf(vec3(0.0, -3.0, 0.0)), -4.0);
        // Down to it, up away from it, and out of it.
        assert_eq!(floor.gsdf(vec3(0.0, 3.0, 0.0), Vec3::NEG_Y), 2.0);
        assert_eq!(floor.gsdf(vec3(0.0, 3.0, 0.0), Vec3::Y), f32::INFINITY);
        assert_eq!(floor.gsdf(vec3(0.0, -3.0, 0.0), Vec3::Y), -4.0);
        // Along it: over, under and in the plane, which is not inside.
        assert_eq!(floor.gsdf(vec3(0.0, 3.0, 0.0), Vec3::X), f32::INFINITY);
        assert_eq!(floor.gsdf(vec3(0.0, -3.0, 0.0), Vec3::X), f32::NEG_INFINITY);
        assert_eq!(floor.gsdf(vec3(0.0, 1.0, 0.0), vec3(1.0, -0.0, 0.0)), f32::INFINITY);
    }
}
