//! Spherical sectors of any angle: what the narrow and the wide solid angle share.

use super::solid::Bounds;
use crate::real::Real;
use crate::vec3::V3;
use glam::Vec3;

/// The standard signed distance to a ball's part within a cone around `axis` with its tip at the centre.
///
/// `w` is the point from the tip; `sine` and `cosine` are those of the half-angle, from 0 to 180 degrees, times any
/// common factor. Source: I. Quilez, Distance functions (solid angle).
#[inline(always)]
pub(crate) fn sector_distance<T: Real>(w: V3<T>, axis: V3<T>, sine: T, cosine: T, reach: T) -> T {
    let (across, along) = (w.cross(axis).norm(), w.dot(axis));
    let per_slant = sine.splat_like(1.0) / (sine.squared() + cosine.squared()).sqrt();
    let (sine, cosine) = (sine * per_slant, cosine * per_slant);
    // How far up the side the nearest point of it is, which ends in the rim.
    let up = (across * sine + along * cosine).max(sine.splat_like(0.0)).min(reach);
    let to_side = ((across - sine * up).squared() + (along - cosine * up).squared()).sqrt();
    let to_ball = w.norm() - reach;
    to_ball.max(to_side.copysign(across * cosine - along * sine))
}

/// Bounds of the same sector around `apex`.
pub(crate) fn sector_bounds(apex: Vec3, axis: Vec3, sine: f32, cosine: f32, reach: f32) -> Bounds {
    let slant = libm::sqrtf(sine * sine + cosine * cosine);
    let (sine, cosine) = (sine / slant, cosine / slant);
    // How far the sector reaches in a direction that has this part along the axis: all the way where the direction is
    // in the sector, as far as the rim elsewhere. A millionth more makes up for rounding.
    let reach_along = |part: f32| {
        let rim = part * cosine + libm::sqrtf(Real::max(1.000_001 - part * part, 0.0)) * sine;
        let share = if part < cosine { Real::min(rim, 1.0) } else { 1.0 };
        reach * (Real::max(share, 0.0) + 0.000_002)
    };
    let outward = |part: Vec3| Vec3::new(reach_along(part.x), reach_along(part.y), reach_along(part.z));
    let (low, high) = (apex - outward(-axis), apex + outward(axis));
    Bounds {
        min: Vec3::new(low.x.next_down(), low.y.next_down(), low.z.next_down()),
        max: Vec3::new(high.x.next_up(), high.y.next_up(), high.z.next_up()),
    }
}
