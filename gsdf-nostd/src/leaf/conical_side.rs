//! The side of a cone, shared by the infinite, the finite and the capped one: a cylinder whose radius grows along its
//! axis.

use super::solid::{Ground, nowhere};
use crate::quadratic::roots;
use crate::range::PARALLEL_TILT_SQUARED;
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;

/// The solid of the points `x` with `k |y| < r + s z`, where `z = (x - b) . a` is the height over a reference point
/// `b` along the axis and `y` the part across it: one nappe of a cone, opening towards `a` where `s > 0`.
///
/// `s : k` is the tangent of the half-angle; the two may have any common factor. `r / k` is the radius at the
/// reference point, 0 where that is the apex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Profile<T> {
    pub(super) axis: V3<T>,
    pub(super) r: T,
    pub(super) s: T,
    pub(super) k: T,
}

/// The side of a cone seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenCone<T> {
    /// From the reference point to the origin.
    w: V3<T>,
    /// `k² |w x a|² - (r + s w.a)²`: zero where the origin lies on the side.
    c: T,
}

/// A cone is nearly a plane where the square of the tangent of its half-angle is more than this: within a thirtieth of a
/// right one.
const FLAT: f32 = 1024.0;

/// A ray is steep to a side where the square of its slope is so many times that of the side.
const STEEP: f32 = 16.0;

impl<T: Real> SeenCone<T> {
    /// The side seen from the point at `w` from the reference point.
    #[inline(always)]
    pub(super) fn new(w: V3<T>, profile: &Profile<T>) -> Self {
        let across = w.cross(profile.axis).scaled(profile.k);
        let radius = profile.r + profile.s * w.dot(profile.axis);
        Self {
            w,
            c: across.norm_squared() - radius.squared(),
        }
    }

    #[inline(always)]
    pub(super) fn lift(seen: &SeenCone<T::Scalar>, like: T) -> Self {
        Self {
            w: V3::lift(like, seen.w),
            c: like.lift_like(seen.c),
        }
    }

    /// The side seen from a point that may lie on it.
    #[inline(always)]
    pub(super) fn grounded(self, profile: &Profile<T>, ground: &Ground<T>, face: f32, extent: T) -> Self {
        // The gradient of `c` on the surface: 2 k |y| sqrt(k² + s²).
        let slant = (profile.k.squared() + profile.s.squared()).sqrt();
        let across = self.w.cross(profile.axis).scaled(profile.k).norm();
        let gradient = (across + across) * slant;
        Self {
            c: ground.settle(face, self.c, gradient, extent),
            ..self
        }
    }

    /// The span of one nappe.
    ///
    /// The ray is first re-centred at its point nearest the reference point, where nothing far away is left to
    /// cancel. With `W`, `V` the cross products of `w`, `v` with the axis and `R = r + s w.a`, `G = s v.a` the radius
    /// there and its growth along the ray: `A = k² V.V - G²`, `B = k² W.V - G R`, `C = k² W.W - R²` and `D = B² - A C
    /// = k² (|R V - G W|² - k² |W x V|²)`, in which no large terms cancel either. (Where `A C <= 0` the first form is
    /// a sum.)
    ///
    /// Of a cone that is nearly a plane the apex is no place to go to: it may be far from where a steep ray crosses the side,
    /// and the way there and back costs roundings of its length. There nothing cancels from where the ray comes.
    ///
    /// A ray steeper than the side (`A < 0`) meets both nappes once, a shallower one meets one of them twice; one
    /// parallel to a generatrix has `A = 0`, which sends one root to infinity by itself. What lies on the other nappe
    /// is cut off where `R` vanishes. A ray along the axis of a side that hardly widens sees no change at all.
    #[inline(always)]
    pub(super) fn span(&self, profile: &Profile<T>, toward: &Toward<T>) -> Span<T> {
        let zero = self.c.splat_like(0.0);
        let infinity = zero.splat_like(f32::INFINITY);
        let v = toward.v.cross(profile.axis);
        let growth = profile.s * toward.v.dot(profile.axis);
        let k2 = profile.k.squared();
        let (across2, growth2) = (k2 * v.norm_squared(), growth.squared());
        let (shift, near) = if T::ROBUST {
            let flat = (k2 * zero.splat_like(FLAT)).lt(profile.s.squared()) & (across2 * zero.splat_like(STEEP)).lt(growth2);
            let shift = T::select(flat, zero, -(self.w.dot(toward.v) * toward.per_vv)).given();
            (shift, self.w + toward.v.scaled(shift))
        } else {
            (zero, self.w)
        };

        let w = near.cross(profile.axis);
        let radius = profile.r + profile.s * near.dot(profile.axis);
        let a = across2 - growth2;
        let b = k2 * w.dot(v) - growth * radius;
        let c = k2 * w.norm_squared() - radius.squared();
        let plain = b.squared() - a * c;
        let d = if T::ROBUST {
            let skew = v.scaled(radius) - w.scaled(growth);
            let cancelled = k2 * (skew.norm_squared() - k2 * w.cross(v).norm_squared());
            T::select((a * c).le(zero), plain, cancelled)
        } else {
            plain
        };

        let still = k2 * profile.axis.norm_squared() * toward.vv * zero.splat_like(PARALLEL_TILT_SQUARED);
        let constant = (across2 + growth2).lt(still);
        // Far away it may cross the side all the same.
        let tilted = constant & !(across2 + growth2).eq(zero);
        let within = constant & c.unknown_where(tilted).lt(zero) & zero.lt(radius);
        let steep = a.lt(zero) & !constant;
        let shallow = !steep & !constant & zero.lt(d);
        if nowhere(steep | shallow | within) {
            return Span::empty_like(zero);
        }
        // A steep ray always meets the cone; through the apex both roots coincide, and a least positive number keeps
        // them numbers.
        let least = zero.splat_like(f32::MIN_POSITIVE);
        let least = plain.max(least).off_by(least);
        let d = T::select(steep & d.le(zero), least, d);
        let (first, last) = roots(zero.splat_like(1.0) / a, b, c, d);
        let widening = zero.lt(growth);
        let enter = T::select(steep, T::select(widening, last, -infinity), first);
        let exit = T::select(steep, T::select(widening, infinity, first), last);

        // Our nappe is where the radius is positive: beyond the tip, before it, or everywhere or nowhere.
        let tip = -(radius / growth);
        let flat = growth.eq(zero);
        let enter = T::select(widening, enter.max(tip), enter);
        let exit = T::select(widening | flat, exit, exit.min(tip));
        let ours = !flat | zero.lt(radius);

        let (enter, exit) = (enter + shift, exit + shift);
        // From a point of the side one of the roots is 0: the entry if the ray goes inward there, the exit if
        // outward.
        let on = self.c.eq(zero) & zero.lt(profile.r + profile.s * self.w.dot(profile.axis));
        let inward = T::select(steep, -growth, b - a * shift).lt(zero);
        let enter = T::select(on & inward, zero, enter);
        let exit = T::select(on & !inward, zero, exit);
        Span::between_where(
            (steep | shallow | within) & ours,
            T::select(within, -infinity, enter).unknown_where(tilted),
            T::select(within, infinity, exit).unknown_where(tilted),
        )
    }

    /// The outward unit normal at `t`; at the apex, straight away from the cone.
    #[inline(always)]
    pub(super) fn normal(&self, profile: &Profile<T>, toward: &Toward<T>, t: T) -> V3<T> {
        let zero = t.splat_like(0.0);
        let x = self.w + toward.v.scaled(t);
        let across = profile.axis.cross(x.cross(profile.axis));
        let around = across.normalized_or(V3::new(zero, zero, zero));
        let away = -profile.axis.scaled(profile.s);
        toward.unit_normal(around.scaled(profile.k) + away)
    }
}

/// The standard signed distance to a capped cone, in the half-plane through its axis.
///
/// `across` is the distance from the axis, `up` the height over the first cap and `height` that of the second; the
/// caps have radii `first` and `second`. The nearer of two segments, the cap's and the side's. Source: I. Quilez,
/// Distance functions (capped cone).
#[inline(always)]
pub(super) fn frustum_distance<T: Real>(across: T, up: T, height: T, first: T, second: T) -> T {
    let (zero, one) = (across.splat_like(0.0), across.splat_like(1.0));
    let beyond = up - height;
    let low = up.lt(-beyond);
    let over_cap = T::select(low, -up, beyond);
    let past_rim = (across - T::select(low, first, second)).max(zero);
    // From the rim of the second cap to the point, and to the rim of the first.
    let (x, y) = (across - second, beyond);
    let (side_x, side_y) = (second - first, height);
    let along = -((x * side_x + y * side_y) / (side_x.squared() + side_y.squared()));
    let along = along.max(zero).min(one);
    let (off_x, off_y) = (x + side_x * along, y + side_y * along);
    let to_cap = past_rim.squared() + over_cap.squared();
    let to_side = off_x.squared() + off_y.squared();
    let distance = to_cap.min(to_side).sqrt();
    // Within the side's line by a turn: of a flat cone `off_x` is lost in the rounding of its radius.
    let inside = (x * side_y).lt(y * side_x) & over_cap.lt(zero);
    T::select(inside, -distance, distance)
}
