//! What depends on a ray's direction alone.

use crate::bounded::WithError;
use crate::range::{LEAST_SQUARE, PARALLEL_SPEED};
use crate::real::Real;
use crate::vec3::V3;

/// A ray's direction with what every solid wants of it, computed once per ray and frame.
///
/// What a program's solids never look at is dead code to the compiler: a program of spheres pays for no reciprocal of
/// a component.
#[derive(Clone, Copy, Debug)]
pub struct Toward<T> {
    /// The direction `v`; not necessarily of unit length.
    pub v: V3<T>,
    /// `v.v`.
    pub vv: T,
    /// `1 / v.v`.
    pub per_vv: T,
    /// The reciprocals of the components, as [`reciprocal_speed`] gives them.
    pub per_component: V3<T>,
}

impl<T: Real> Toward<T> {
    /// The direction `v`, which must not be zero.
    #[inline(always)]
    pub fn new(v: V3<T>) -> Self {
        Self::without_components(v).with_components()
    }

    /// The same direction with the reciprocals of its components.
    #[inline(always)]
    #[must_use]
    pub fn with_components(self) -> Self {
        let v = self.v;
        Self {
            per_component: V3::new(reciprocal_speed(v.x), reciprocal_speed(v.y), reciprocal_speed(v.z)),
            ..self
        }
    }

    /// The direction `v` for solids that do not [look at the reciprocals of its components]: in their place are the
    /// components.
    ///
    /// [look at the reciprocals of its components]: crate::Solid::divides_by_components
    #[inline(always)]
    pub fn without_components(v: V3<T>) -> Self {
        let vv = v.norm_squared();
        Self {
            v,
            vv,
            per_vv: vv.splat_like(1.0) / vv,
            per_component: v,
        }
    }

    /// The same with bounds on the errors of what was computed from `v`, which is exact.
    #[inline(always)]
    pub(crate) fn bounded<const ALWAYS: bool>(&self) -> Toward<WithError<T, ALWAYS>> {
        let (v, per) = (self.v, self.per_component);
        Toward {
            v: V3::new(WithError::exact(v.x), WithError::exact(v.y), WithError::exact(v.z)),
            vv: rounded(self.vv, 3.0),
            per_vv: rounded(self.per_vv, 5.0),
            per_component: V3::new(
                bounded_reciprocal(v.x, per.x),
                bounded_reciprocal(v.y, per.y),
                bounded_reciprocal(v.z, per.z),
            ),
        }
    }

    /// The unit vector along `outward`; straight against the ray where that is as good as zero, as it is at the centre
    /// of a sphere that rounding has lost.
    #[inline(always)]
    pub(crate) fn unit_normal(&self, outward: V3<T>) -> V3<T> {
        let square = outward.norm_squared();
        let known = square.splat_like(LEAST_SQUARE).le(square);
        let square = T::select(known, square, self.vv);
        V3::select(known, outward, -self.v).scaled(square.splat_like(1.0) / square.sqrt())
    }
}

/// The reciprocal of a ray's speed along a plane's normal, +inf where the ray is parallel to the plane.
///
/// Every plane of every solid divides by this one reciprocal, so that planes which coincide have roots of the same
/// bits, whichever solids they bound. A speed below 2^-100 counts as zero, and zero as positive: with `g` the height
/// over the plane `-g * inf` is then an infinity of the right sign, and NaN, hence a miss, for a ray that lies in the
/// plane.
#[inline(always)]
pub fn reciprocal_speed<T: Real>(speed: T) -> T {
    let parallel = speed.abs().lt(speed.splat_like(PARALLEL_SPEED));
    let zero = speed.splat_like(0.0);
    (speed.splat_like(1.0) / T::select(parallel, zero, speed)).unknown_where(parallel & !speed.eq(zero))
}

/// A number that is off by so many roundoffs at the most.
#[inline(always)]
fn rounded<T: Real, const ALWAYS: bool>(value: T, roundoffs: f32) -> WithError<T, ALWAYS> {
    WithError {
        value,
        error: value.abs() * value.splat_like(roundoffs * T::ROUNDOFF),
    }
}

/// The reciprocal of a speed that is exact.
#[inline(always)]
fn bounded_reciprocal<T: Real, const ALWAYS: bool>(speed: T, per_speed: T) -> WithError<T, ALWAYS> {
    let zero = speed.splat_like(0.0);
    let infinite = per_speed.abs().eq(zero.splat_like(f32::INFINITY));
    let known: WithError<T, ALWAYS> = rounded(per_speed, 1.0);
    WithError {
        value: per_speed,
        // Of a speed that was taken for zero nothing is known.
        error: T::select(infinite & speed.eq(zero), zero, known.error),
    }
}

#[cfg(test)]
mod tests {
    use super::{Toward, V3};
    use glam::{Vec3, vec3};

    #[test]
    fn normals_are_of_unit_length_whatever_is_left_of_a_vector() {
        let direction = vec3(1.5, -0.25, 1.0);
        let toward = Toward::new(V3::<f32>::from(direction));
        for outward in [
            Vec3::ZERO,
            vec3(0.0, 1e-23, -2e-22),
            vec3(3e-20, 0.0, 1e-21),
            vec3(1e-19, 2e-19, 0.0),
            Vec3::X,
            vec3(1e15, 2e14, -1e15),
        ] {
            let normal = Vec3::from(toward.unit_normal(outward.into()));
            assert!((normal.length() - 1.0).abs() < 3e-7, "{normal} of {outward}");
            let expected = if outward.length() < 1e-19 { -direction } else { outward };
            assert!(normal.dot(expected.normalize()) > 0.999_999, "{normal} of {outward}");
        }
    }
}
