//! The infinite cone: a single nappe.

use super::conical_side::{Profile, SeenCone};
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Fault, Invalid, length, point, unit};
use crate::range::{MIN_LENGTH, larger, max_norm, unit_scale};
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// One nappe of an infinite cone: the points whose direction from `apex` makes less than the half-angle with `axis`.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/nappe.md"))]
///
/// - Standard: with `q = (|y|, z)` the point in the half-plane through the axis and `g` the unit generatrix, `|q - g
///   max(q.g, 0)|` with the sign of the side, exact. (The paper's lacks the sign, and measures from the world's
///   origin.)
/// - Along a ray: see the module's source for the derivation. (The paper prints a root for both nappes with a factor
///   of 2 too many; its standard form means one nappe.) A ray parallel to a generatrix is no special case.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: five cross products, one square
///   root, three divisions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nappe {
    apex: Vec3,
    axis: Vec3,
    /// Sine and cosine of the half-angle, times a common factor that brings the larger into [1, 2).
    sine: f32,
    cosine: f32,
}

impl Nappe {
    /// The nappe from `apex` that opens along the unit vector `axis` and has `radius` at the height `height`.
    ///
    /// Radius and height are a slope, not an angle: an angle near 0 or 90 degrees would lose it.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `axis` is not of unit length, or the radius or the height is
    /// not from 2^-20 to 2^30, or one is more than 2^20 times the other.
    pub const fn new(apex: Vec3, axis: Vec3, radius: f32, height: f32) -> Result<Self, Invalid> {
        match (
            point("nappe apex", apex),
            unit("nappe axis", axis),
            length("nappe radius", radius),
            length("nappe height", height),
        ) {
            (Ok(apex), Ok(axis), Ok(radius), Ok(height)) => {
                if radius > height * 1_048_576.0 || height > radius * 1_048_576.0 {
                    return Err(Invalid::new("nappe radius : height", radius / height, Fault::NotAcute));
                }
                let scale = unit_scale(larger(radius, height));
                Ok(Self {
                    apex,
                    axis,
                    sine: radius * scale,
                    cosine: height * scale,
                })
            }
            (Err(error), ..) | (_, Err(error), ..) | (_, _, Err(error), _) | (.., Err(error)) => Err(error),
        }
    }

    /// The nappe with a half-angle in radians, from 2^-20 to π/2 - 2^-20; not `const`, because of the sine and
    /// cosine.
    ///
    /// # Errors
    /// As for [`new`](Self::new), or where the angle is out of its range.
    pub fn with_angle(apex: Vec3, axis: Vec3, half_angle: f32) -> Result<Self, Invalid> {
        if !half_angle.is_finite() {
            return Err(Invalid::new("nappe half-angle", half_angle, Fault::NotFinite));
        }
        if !(MIN_LENGTH..=core::f32::consts::FRAC_PI_2 - MIN_LENGTH).contains(&half_angle) {
            return Err(Invalid::new("nappe half-angle", half_angle, Fault::NotAcute));
        }
        let (sine, cosine) = libm::sincosf(half_angle);
        Self::new(apex, axis, sine, cosine)
    }

    /// The tip.
    #[must_use]
    pub const fn apex(&self) -> Vec3 {
        self.apex
    }

    /// The direction in which it opens.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.axis
    }

    /// The tangent of the half-angle.
    #[must_use]
    pub const fn slope(&self) -> f32 {
        self.sine / self.cosine
    }

    #[inline(always)]
    pub(super) fn profile<T: Real>(&self, like: T) -> Profile<T> {
        Profile {
            axis: V3::splat(like, self.axis),
            r: like.splat_like(0.0),
            s: like.splat_like(self.sine),
            k: like.splat_like(self.cosine),
        }
    }
}

impl Solid for Nappe {
    type Seen<T: Real> = SeenCone<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let Profile { axis, s, k, .. } = self.profile(p.x);
        let w = p - V3::splat(p.x, self.apex);
        let (across, along) = (w.cross(axis).norm(), w.dot(axis));
        let per_slant = s.splat_like(1.0) / (s.squared() + k.squared()).sqrt();
        let (s, k) = (s * per_slant, k * per_slant);
        // How far up the generatrix the nearest point is.
        let up = (across * s + along * k).max(s.splat_like(0.0));
        let distance = ((across - s * up).squared() + (along - k * up).squared()).sqrt();
        distance.copysign(across * k - along * s)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        SeenCone::new(origin - V3::splat(origin.x, self.apex), &self.profile(origin.x))
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenCone::lift(seen, like)
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let extent = ground.face.splat_like(max_norm(self.apex));
        seen.grounded(&self.profile(ground.face), ground, 0.0, extent)
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        seen.span(&self.profile(toward.vv), toward)
    }

    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        Surface {
            normal: seen.normal(&self.profile(t), toward, t),
            face: t.splat_like(0.0),
        }
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn bounds(&self) -> Option<Bounds> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::Nappe;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let funnel = Nappe::new(Vec3::ZERO, Vec3::Z, 1.0, 1.0).unwrap();
        // Beside the tip the nearest point is the tip; inside, the side.
        assert_eq!(funnel.sdf(vec3(0.0, 0.0, -2.0)), 2.0);
        assert!((funnel.sdf(Vec3::Z) + 0.5_f32.sqrt()).abs() < 1e-6);
        assert_eq!(funnel.gsdf(vec3(-2.0, 0.0, 1.0), Vec3::X), 1.0);
        assert_eq!(funnel.gsdf(vec3(0.0, 0.0, 2.0), Vec3::X), -2.0);
        // The other nappe, which the double cone has at 1, is not there.
        assert_eq!(funnel.gsdf(vec3(-2.0, 0.0, -1.0), Vec3::X), f32::INFINITY);
        // Steeper than the side: in for ever. Parallel to a generatrix: one root.
        assert_eq!(funnel.gsdf(vec3(0.0, 0.0, -3.0), Vec3::Z), 3.0);
        assert_eq!(funnel.gsdf(Vec3::Z, Vec3::Z), f32::NEG_INFINITY);
        assert_eq!(funnel.gsdf(vec3(-2.0, 0.0, 0.0), vec3(1.0, 0.0, 1.0)), 1.0);
    }
}
