//! Whole formulas whose bounds are simpler than those of their operations one by one.

use super::{UNDERFLOW, WithError};
use crate::quadratic::Chord;
use crate::real::Real;
use crate::vec3::V3;

/// The scalar product. Each of its products is off by what its factors are, and rounded three times at the most.
#[inline(always)]
pub(super) fn dot<T: Real, const ALWAYS: bool>(a: V3<WithError<T, ALWAYS>>, b: V3<WithError<T, ALWAYS>>) -> WithError<T, ALWAYS> {
    let (x, y, z) = (Product::of(a.x, b.x), Product::of(a.y, b.y), Product::of(a.z, b.z));
    let rounding = (x.size + y.size + z.size) * x.size.splat_like(3.0 * T::ROUNDOFF);
    let inherited = x.inherited + y.inherited + z.inherited;
    WithError {
        value: (x.value + y.value) + z.value,
        error: (inherited + rounding) + underflow(x.factor + y.factor + z.factor),
    }
}

/// The vector product. Each of its products is rounded twice.
#[inline(always)]
pub(super) fn cross<T: Real, const ALWAYS: bool>(a: V3<WithError<T, ALWAYS>>, b: V3<WithError<T, ALWAYS>>) -> V3<WithError<T, ALWAYS>> {
    V3::new(
        difference(a.y, b.z, a.z, b.y),
        difference(a.z, b.x, a.x, b.z),
        difference(a.x, b.y, a.y, b.x),
    )
}

#[inline(always)]
fn difference<T: Real, const ALWAYS: bool>(
    a: WithError<T, ALWAYS>,
    b: WithError<T, ALWAYS>,
    c: WithError<T, ALWAYS>,
    d: WithError<T, ALWAYS>,
) -> WithError<T, ALWAYS> {
    let (first, second) = (Product::of(a, b), Product::of(c, d));
    let rounding = (first.size + second.size) * first.size.splat_like(2.0 * T::ROUNDOFF);
    WithError {
        value: first.value - second.value,
        error: (first.inherited + second.inherited + rounding) + underflow(first.factor + second.factor),
    }
}

/// A product and what bounds its error.
struct Product<T> {
    value: T,
    size: T,
    /// What the factors' errors make of it.
    inherited: T,
    /// The lesser factor, zero if the product is nothing for certain.
    factor: T,
}

impl<T: Real> Product<T> {
    #[inline(always)]
    fn of<const ALWAYS: bool>(a: WithError<T, ALWAYS>, b: WithError<T, ALWAYS>) -> Self {
        let value = a.value * b.value;
        let (a_size, b_most) = (a.value.abs(), b.value.abs() + b.error);
        Self {
            value,
            size: value.abs(),
            inherited: a_size * b.error + b_most * a.error,
            factor: (a_size + a.error).min(b_most),
        }
    }
}

/// What products that are not nothing may lose where they underflow.
#[inline(always)]
fn underflow<T: Real>(factors: T) -> T {
    let zero = factors.splat_like(0.0);
    T::select(factors.eq(zero), zero, zero.splat_like(UNDERFLOW))
}

/// A component of `l = W - (B/A) V`, and by how much it may be off, but for what `B/A` is.
#[inline(always)]
fn away<T: Real, const ALWAYS: bool>(w: WithError<T, ALWAYS>, v: WithError<T, ALWAYS>, nearest: T) -> (T, T) {
    let along = v.value * nearest;
    let l = w.value - along;
    let rounding = (along.abs() + l.abs()) * nearest.splat_like(T::ROUNDOFF);
    (l, w.error + nearest.abs() * v.error + rounding)
}

/// The discriminant of a chord.
///
/// With the exact `l = W - (B/A) V` the computed one is `l + δ + ν V`: `δ` comes, component by component, from the errors of `W` and
/// `V` and its own roundings, `ν` from `B/A`. Since `l` is perpendicular to `V`, the square of what was computed, `l'`, is too large
/// by exactly `2 l'.δ - δ² + ν² A`: what is off along the ray counts by its square alone.
#[inline(always)]
pub(super) fn discriminant<T: Real, const ALWAYS: bool>(
    chord: &Chord<WithError<T, ALWAYS>>,
    b: WithError<T, ALWAYS>,
) -> WithError<T, ALWAYS> {
    let zero = b.value.splat_like(0.0);
    let (roundoff, three_roundoffs) = (zero.splat_like(T::ROUNDOFF), zero.splat_like(3.0 * T::ROUNDOFF));
    let Chord { w, v, a, per_a, c, r2 } = chord;
    let nearest = b.value * per_a.value;
    let off_nearest = b.error * (per_a.value + per_a.error) + nearest.abs() * (per_a.error * a.value + roundoff);
    let ((x, off_x), (y, off_y), (z, off_z)) = (away(w.x, v.x, nearest), away(w.y, v.y, nearest), away(w.z, v.z, nearest));
    let l = V3::new(x, y, z);
    let off = V3::new(off_x, off_y, off_z);
    let square = l.norm_squared();
    let first = (x.abs() * off_x + y.abs() * off_y) + z.abs() * off_z;
    let second = off.norm_squared() + off_nearest.squared() * (a.value + a.error);
    let off_square = (first + first) + second + square * three_roundoffs;
    let rest = r2.value - square;
    let away = a.value * rest;
    let off_away = (a.value + a.error) * (off_square + r2.error + rest.abs() * roundoff) + rest.abs() * a.error + away.abs() * roundoff;
    // On the surface `C` is zero.
    let on = c.value.eq(zero);
    let level = b.value.squared();
    let off_level = (b.value.abs() + b.value.abs() + b.error) * b.error + (a.value + a.error) * c.error + level * roundoff;
    WithError {
        value: T::select(on, level, away),
        error: T::select(on, off_level, off_away) + zero.splat_like(UNDERFLOW),
    }
}
