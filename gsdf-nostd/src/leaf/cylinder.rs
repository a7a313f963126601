//! The infinite cylinder, and the side it lends to the finite one and the capsule.

use super::solid::{Bounds, Ground, Solid, Surface, nowhere};
use crate::invalid::{Invalid, length, point, unit};
use crate::quadratic::{Chord, roots};
use crate::range::{PARALLEL_TILT_SQUARED, max_norm};
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// The infinite cylinder of the points nearer to an axis than `radius`.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/cylinder.md"))]
///
/// - Standard: `|(p - c) x a| - r`, exact. (The paper's takes the perpendicular of the ray instead of the point.)
/// - Along a ray, with `w = p - c`, `W = w x a` and `V = v x a`: `A = V.V`, `B = W.V`, `C = W.W - r² a.a` and, with
///   `L = W - (B/A) V`, `D = A (r² a.a - L.L)`, which is the sphere's discriminant in the plane across the axis.
///   Cross products, because an axis that is not quite of unit length then does no harm. A ray that tilts less than
///   2^-32 against the axis is taken as parallel to it: inside all the way or never.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: two cross products, one square
///   root, two divisions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    point: Vec3,
    axis: Vec3,
    radius: f32,
}

impl Cylinder {
    /// The cylinder around the line through `point` along the unit vector `axis`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `axis` is not of unit length (to 2^-21 of its square), or
    /// the radius is not from 2^-20 to 2^30.
    pub const fn new(at: Vec3, axis: Vec3, radius: f32) -> Result<Self, Invalid> {
        match (
            point("cylinder point", at),
            unit("cylinder axis", axis),
            length("cylinder radius", radius),
        ) {
            (Ok(point), Ok(axis), Ok(radius)) => Ok(Self::from_valid(point, axis, radius)),
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
        }
    }

    /// The cylinder of parameters that were checked under other names.
    pub(super) const fn from_valid(point: Vec3, axis: Vec3, radius: f32) -> Self {
        Self { point, axis, radius }
    }

    /// A point of the axis.
    #[must_use]
    pub const fn point(&self) -> Vec3 {
        self.point
    }

    /// The direction of the axis.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.axis
    }

    /// The radius.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }
}

/// A cylinder's side seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenSide<T> {
    /// From the axis to the origin, turned by the cross product with the axis.
    w: V3<T>,
    /// `r² a.a`.
    r2: T,
    /// `W.W - r² a.a`: positive outside, zero where the origin lies on the side.
    c: T,
}

impl<T: Real> SeenSide<T> {
    /// The side of radius `radius` around `axis`, seen from the point at `w` from a point of the axis.
    #[inline(always)]
    pub(super) fn new(w: V3<T>, axis: V3<T>, radius: T) -> Self {
        let w = w.cross(axis);
        let r2 = radius.squared() * axis.norm_squared();
        Self {
            w,
            r2,
            c: w.norm_squared() - r2,
        }
    }

    /// The side whose offset was taken, and perhaps settled, before.
    #[inline(always)]
    pub(super) fn with_offset(self, c: T) -> Self {
        Self { c, ..self }
    }

    /// `W.W - r² a.a`.
    #[inline(always)]
    pub(super) fn offset(&self) -> T {
        self.c
    }

    #[inline(always)]
    pub(super) fn lift(seen: &SeenSide<T::Scalar>, like: T) -> Self {
        Self {
            w: V3::lift(like, seen.w),
            r2: like.lift_like(seen.r2),
            c: like.lift_like(seen.c),
        }
    }

    /// The side seen from a point that may lie on it; `size` is `radius |axis|²`, half of what the gradient of `c` is
    /// on the surface.
    #[inline(always)]
    pub(super) fn grounded(self, ground: &Ground<T>, face: f32, size: T, extent: T) -> Self {
        Self {
            c: ground.settle(face, self.c, size + size, extent),
            ..self
        }
    }

    #[inline(always)]
    pub(super) fn span(&self, axis: V3<T>, toward: &Toward<T>) -> Span<T> {
        let zero = self.c.splat_like(0.0);
        let v = toward.v.cross(axis);
        let a = v.norm_squared();
        let parallel = a.lt(toward.vv * axis.norm_squared() * a.splat_like(PARALLEL_TILT_SQUARED));
        let per_a = a.splat_like(1.0) / a;
        let chord = Chord {
            w: self.w,
            v,
            a,
            per_a,
            c: self.c,
            r2: self.r2,
        };
        let (b, d) = chord.terms();
        // Far away it may cross the side all the same.
        let tilted = parallel & !a.eq(zero);
        let inside = self.c.unknown_where(tilted).lt(zero);
        let met = (parallel & inside) | (!parallel & zero.lt(d));
        if nowhere(met) {
            return Span::empty_like(zero);
        }
        let (enter, exit) = roots(per_a, b, self.c, d);
        Span::between_where(
            met,
            T::select(parallel, zero.splat_like(f32::NEG_INFINITY), enter).unknown_where(tilted),
            T::select(parallel, zero.splat_like(f32::INFINITY), exit).unknown_where(tilted),
        )
    }

    /// The outward unit normal at `t`.
    #[inline(always)]
    pub(super) fn normal(&self, axis: V3<T>, toward: &Toward<T>, t: T) -> V3<T> {
        let turned = self.w + toward.v.cross(axis).scaled(t);
        toward.unit_normal(axis.cross(turned))
    }
}

impl Solid for Cylinder {
    type Seen<T: Real> = SeenSide<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let w = p - V3::splat(p.x, self.point);
        w.cross(V3::splat(p.x, self.axis)).norm() - p.x.splat_like(self.radius)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let like = origin.x;
        SeenSide::new(
            origin - V3::splat(like, self.point),
            V3::splat(like, self.axis),
            like.splat_like(self.radius),
        )
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenSide::lift(seen, like)
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let radius = seen.c.splat_like(self.radius);
        let extent = radius + radius.splat_like(max_norm(self.point));
        seen.grounded(ground, 0.0, radius, extent)
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        seen.span(V3::splat(toward.vv, self.axis), toward)
    }

    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        Surface {
            normal: seen.normal(V3::splat(t, self.axis), toward, t),
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
    use super::Cylinder;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let pipe = Cylinder::new(vec3(0.0, 7.0, 0.0), Vec3::Y, 2.0).unwrap();
        assert_eq!(pipe.sdf(vec3(3.0, -5.0, 4.0)), 3.0);
        assert_eq!(pipe.sdf(vec3(0.5, 9.0, 0.0)), -1.5);
        // The height along the axis does not matter (as printed in the paper it did).
        assert_eq!(pipe.gsdf(vec3(5.0, 1.0, 0.0), Vec3::NEG_X), 3.0);
        assert_eq!(pipe.gsdf(vec3(5.0, 2.0, 0.0), vec3(-0.6, 0.8, 0.0)), 5.0);
        assert_eq!(pipe.gsdf(Vec3::ZERO, Vec3::X), -2.0);
        // Along the axis: inside all the way, outside all the way, and on the side, which is not inside.
        assert_eq!(pipe.gsdf(vec3(1.0, 0.0, 0.0), Vec3::Y), f32::NEG_INFINITY);
        assert_eq!(pipe.gsdf(vec3(3.0, 0.0, 0.0), Vec3::Y), f32::INFINITY);
        assert_eq!(pipe.gsdf(vec3(2.0, 0.0, 0.0), Vec3::Y), f32::INFINITY);
    }
}
