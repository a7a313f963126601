//! Half-spaces and slabs along a ray, from heights over planes: the one formula every flat face goes through.

use crate::real::Real;
use crate::span::Span;

/// The span, not yet checked for being inhabited, below a plane over which the origin has `height` and the ray gains
/// height at a rate whose reciprocal is `per_speed` (see [`reciprocal_speed`](crate::toward::reciprocal_speed)).
///
/// A plane and its complement get roots of the same bits, since both factors change sign together. A ray in the plane
/// gets NaN: a miss.
#[inline(always)]
pub(super) fn below<T: Real>(height: T, per_speed: T) -> (T, T) {
    let root = crossing(height, per_speed);
    let falling = per_speed.lt(per_speed.splat_like(0.0));
    (
        T::select(falling, root, root.splat_like(f32::NEG_INFINITY)),
        T::select(falling, root.splat_like(f32::INFINITY), root),
    )
}

/// The span, not yet checked for being inhabited, between two parallel planes: above the first, below the second.
#[inline(always)]
pub(super) fn between<T: Real>(over_lower: T, over_upper: T, per_speed: T) -> (T, T) {
    let lower = crossing(over_lower, per_speed);
    let upper = crossing(over_upper, per_speed);
    let falling = per_speed.lt(per_speed.splat_like(0.0));
    (T::select(falling, upper, lower), T::select(falling, lower, upper))
}

/// [`between`], as a span.
#[inline(always)]
pub(super) fn slab<T: Real>(over_lower: T, over_upper: T, per_speed: T) -> Span<T> {
    let (enter, exit) = between(over_lower, over_upper, per_speed);
    Span::between(enter, exit)
}

/// The parameter at which the ray crosses a plane. Relative error at most 2 units roundoff beyond that of its
/// arguments.
#[inline(always)]
pub(super) fn crossing<T: Real>(height: T, per_speed: T) -> T {
    -height * per_speed
}
