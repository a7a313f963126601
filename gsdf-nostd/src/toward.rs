//! What depends on a ray's direction alone.

use crate::range::PARALLEL_SPEED;
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
        Self {
            per_component: V3::new(reciprocal_speed(v.x), reciprocal_speed(v.y), reciprocal_speed(v.z)),
            ..Self::without_components(v)
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
    speed.splat_like(1.0) / T::select(parallel, speed.splat_like(0.0), speed)
}
