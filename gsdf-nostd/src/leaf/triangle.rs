//! The triangle.

use super::facet::{self, SeenFacet, across};
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::Invalid;
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// The flat piece of surface between three corners, without thickness, seen from both sides.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/triangle.md"))]
///
/// A ray that crosses it at `t` is in it from `t` to the next number. That makes it a member of unions like any solid,
/// also posed. It holds no volume: its complement is all of space, intersected with a solid it stays a facet where it
/// lies in that solid, and taken from one it leaves a cut of one number's width that is seen from inside alone. A ray
/// within rounding of its plane may miss it.
///
/// - Standard: the distance to the plane over the triangle, to the nearest edge beside it; never negative. Source: I.
///   Quilez, Distance functions (triangle).
/// - Along a ray: watertight: no ray slips through between triangles that share an edge, all seen from the same origin
///   along the same direction, and in the same frame; on the edge both are hit. Source: S. Woop, C. Benthin, I. Wald,
///   Watertight Ray/Triangle Intersection, JCGT 2 (2013).
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: two divisions and 30 products and
///   sums where it is missed, three and about 130 where it is hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    corners: [Vec3; 3],
}

const NAMES: [&str; 4] = ["triangle a", "triangle b", "triangle c", "triangle: longest edge squared"];

impl Triangle {
    /// The triangle with these corners.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, or a corner is nearer than 2^-20 to the line through the
    /// others.
    pub const fn new(a: Vec3, b: Vec3, c: Vec3) -> Result<Self, Invalid> {
        match facet::corner_normal(NAMES, a, b, c) {
            Ok(_) => Ok(Self { corners: [a, b, c] }),
            Err(error) => Err(error),
        }
    }

    /// The corners.
    #[must_use]
    pub const fn corners(&self) -> [Vec3; 3] {
        self.corners
    }

    /// A vector about which the corners turn to the left.
    #[inline(always)]
    fn across<T: Real>(&self, like: T) -> V3<T> {
        let [a, b, c] = self.corners;
        let (a, b, c) = (V3::splat(like, a), V3::splat(like, b), V3::splat(like, c));
        across(b - a, c - a)
    }
}

impl Solid for Triangle {
    type Seen<T: Real> = SeenFacet<T, 3>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        facet::distance(&self.corners, self.across(p.x), p)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        SeenFacet::new(&self.corners, origin)
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenFacet::lift(seen, like)
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        seen.grounded(&self.corners, self.across(ground.face), ground)
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        seen.span(toward)
    }

    /// Face 0 is both sides: the normal is turned against the ray where it enters, and along it where it leaves.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        Surface {
            normal: seen.normal(self.across(t), toward, t),
            face: t.splat_like(0.0),
        }
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn bounds(&self) -> Option<Bounds> {
        let [a, b, c] = self.corners;
        Some(Bounds {
            min: a.min(b).min(c),
            max: a.max(b).max(c),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Triangle;
    use crate::leaf::Solid;
    use crate::ray::Ray;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let sail = Triangle::new(Vec3::ZERO, vec3(4.0, 0.0, 0.0), vec3(0.0, 3.0, 0.0)).unwrap();
        // Over it and under it, beside an edge, beside a corner.
        assert_eq!(sail.sdf(vec3(1.0, 1.0, 2.0)), 2.0);
        assert_eq!(sail.sdf(vec3(1.0, 1.0, -2.0)), 2.0);
        assert_eq!(sail.sdf(vec3(1.0, -3.0, 4.0)), 5.0);
        assert_eq!(sail.sdf(vec3(7.0, 0.0, 4.0)), 5.0);
        assert!((sail.sdf(vec3(2.0 + 0.6, 1.5 + 0.8, 0.0)) - 1.0).abs() < 1e-6);
        // From both sides, away from it, and past each edge.
        assert_eq!(sail.gsdf(vec3(1.0, 1.0, 5.0), Vec3::NEG_Z), 5.0);
        assert_eq!(sail.gsdf(vec3(1.0, 1.0, -5.0), Vec3::Z), 5.0);
        assert_eq!(sail.gsdf(vec3(1.0, 1.0, 5.0), Vec3::Z), f32::INFINITY);
        for (x, y) in [(-0.1, 1.0), (1.0, -0.1), (2.1, 1.6)] {
            assert_eq!(sail.gsdf(vec3(x, y, 5.0), Vec3::NEG_Z), f32::INFINITY);
        }
        // Askew, and in its plane.
        assert_eq!(sail.gsdf(vec3(1.0, -4.0, 5.0), vec3(0.0, 1.0, -1.0)), 5.0);
        assert_eq!(sail.gsdf(vec3(-1.0, 1.0, 0.0), Vec3::X), f32::INFINITY);
    }

    #[test]
    fn the_span_is_one_number_long_and_the_normal_faces_the_ray() {
        let sail = Triangle::new(Vec3::ZERO, vec3(4.0, 0.0, 0.0), vec3(0.0, 3.0, 0.0)).unwrap();
        for side in [-1.0, 1.0] {
            let ray = Ray::new(vec3(1.0, 1.0, 5.0 * side), vec3(0.0, 0.0, -side)).unwrap();
            let line = ray.line(0.0_f32);
            let seen = sail.seen_from(line.origin);
            let span = sail.span(&seen, &line.toward);
            assert_eq!(span.exit, span.enter.next_up());
            let normal_at = |t: f32| Vec3::from(sail.surface(&seen, &line.toward, t).normal);
            assert_eq!(normal_at(span.enter), vec3(0.0, 0.0, side));
            assert_eq!(normal_at(span.exit), vec3(0.0, 0.0, -side));
        }
    }

    #[test]
    fn needles_without_area_are_refused() {
        let far = vec3(1000.0, 2000.0, 3000.0);
        assert!(Triangle::new(Vec3::ZERO, far, far * 0.5).is_err());
        assert!(Triangle::new(far, far, Vec3::ZERO).is_err());
        assert!(Triangle::new(far, far, far).is_err());
        assert!(Triangle::new(Vec3::ZERO, far, far * 0.5 + Vec3::X * 0.001).is_ok());
    }
}
