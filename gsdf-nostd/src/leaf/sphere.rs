//! The sphere.

use super::solid::{Bounds, Ground, Solid, Surface, nowhere};
use crate::invalid::{Invalid, length, point};
use crate::quadratic::{Chord, roots};
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// The ball of the points nearer to `center` than `radius`.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/sphere.md"))]
///
/// - Standard: `|p - c| - r`, exact.
/// - Along a ray, with `w = p - c`: `A = v.v`, `B = w.v`, `C = w.w - r²`, and the discriminant from the part of `w`
///   perpendicular to the ray, `l = w - (B/A) v`, as `D = A (r² - l.l)`: the error of `B/A` lies along `v`, hence
///   enters only to second order. (The paper's `r² + (v.w)² - |w|²` subtracts squares of the distance and loses hits
///   beyond a thousand radii.) Source: E. Haines, J. Günther, T. Akenine-Möller, Precision Improvements for
///   Ray/Sphere Intersection, Ray Tracing Gems, chapter 7 (2019).
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them, whatever the distance. Cost: one square
///   root and one division.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    center: Vec3,
    radius: f32,
}

/// A [`Sphere`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenSphere<T> {
    /// From the centre to the origin.
    w: V3<T>,
    /// `w.w - r²`: positive outside, zero where the origin lies on the surface.
    c: T,
}

impl Sphere {
    /// The sphere around `center` with `radius`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, or the radius is not from 2^-20 to 2^30.
    pub const fn new(center: Vec3, radius: f32) -> Result<Self, Invalid> {
        match (point("sphere center", center), length("sphere radius", radius)) {
            (Ok(center), Ok(radius)) => Ok(Self::from_valid(center, radius)),
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// The sphere of parameters that were checked under other names.
    pub(super) const fn from_valid(center: Vec3, radius: f32) -> Self {
        Self { center, radius }
    }

    /// The centre.
    #[must_use]
    pub const fn center(&self) -> Vec3 {
        self.center
    }

    /// The radius.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }
}

impl Solid for Sphere {
    type Seen<T: Real> = SeenSphere<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        (p - V3::splat(p.x, self.center)).norm() - p.x.splat_like(self.radius)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let w = origin - V3::splat(origin.x, self.center);
        SeenSphere {
            w,
            c: w.norm_squared() - w.x.splat_like(self.radius).squared(),
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenSphere {
            w: V3::lift(like, seen.w),
            c: like.lift_like(seen.c),
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let radius = seen.c.splat_like(self.radius);
        SeenSphere {
            c: ground.settle(0.0, seen.c, radius + radius, radius),
            ..seen
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let zero = seen.c.splat_like(0.0);
        let chord = Chord {
            w: seen.w,
            v: toward.v,
            a: toward.vv,
            per_a: toward.per_vv,
            c: seen.c,
            r2: zero.splat_like(self.radius).squared(),
        };
        let (b, d) = chord.terms();
        let met = zero.lt(d);
        if nowhere(met) {
            return Span::empty_like(zero);
        }
        let (enter, exit) = roots(toward.per_vv, b, seen.c, d);
        Span::between_where(met, enter, exit)
    }

    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let outward = seen.w + toward.v.scaled(t);
        Surface {
            normal: toward.unit_normal(outward),
            face: t.splat_like(0.0),
        }
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn grown(&self, by: f32) -> Option<Self> {
        Self::new(self.center, self.radius + by).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(Bounds::around(self.center, Vec3::splat(self.radius)))
    }
}

#[cfg(test)]
mod tests {
    use super::Sphere;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let ball = Sphere::new(vec3(1.0, 2.0, 3.0), 2.0).unwrap();
        assert_eq!(ball.sdf(vec3(1.0, 2.0, 8.0)), 3.0);
        assert_eq!(ball.sdf(vec3(1.0, 2.0, 3.5)), -1.5);
        // From outside, from inside, away from it, and past it without touching.
        assert_eq!(ball.gsdf(vec3(1.0, 2.0, 8.0), Vec3::NEG_Z), 3.0);
        assert_eq!(ball.gsdf(vec3(1.0, 2.0, 3.5), Vec3::Z), -1.5);
        assert_eq!(ball.gsdf(vec3(1.0, 2.0, 8.0), Vec3::Z), f32::INFINITY);
        assert_eq!(ball.gsdf(vec3(1.0, 4.5, 8.0), Vec3::NEG_Z), f32::INFINITY);
        // A tangent misses.
        assert_eq!(ball.gsdf(vec3(1.0, 4.0, 8.0), Vec3::NEG_Z), f32::INFINITY);
        // From the surface: inward it is the diameter to the exit, outward there is nothing.
        assert_eq!(ball.gsdf(vec3(1.0, 2.0, 5.0), Vec3::NEG_Z), -4.0);
        assert_eq!(ball.gsdf(vec3(1.0, 2.0, 5.0), Vec3::Z), f32::INFINITY);
    }

    #[test]
    fn ten_thousand_radii_away_the_rim_is_still_there() {
        let ball = Sphere::new(vec3(10_000.0, 0.0, 0.0), 1.0).unwrap();
        assert!(ball.gsdf(vec3(0.0, 0.999, 0.0), Vec3::X).is_finite());
        assert!(ball.gsdf(vec3(0.0, 1.001, 0.0), Vec3::X).is_infinite());
    }
}
