//! The quadratic inequality `A t² + 2 B t + C < 0` whose discriminant is known better than its coefficients tell.

use crate::real::Real;
use crate::vec3::V3;

/// The two roots of `A t² + 2 B t + C` in ascending order, from `q = -(B + copysign(√D, B))` as `q / A` and `C / q`.
///
/// `D = B² - A C` is given separately, because near a silhouette it cancels: each solid computes it from lengths that
/// do not. The root that cancellation would spoil is never formed as a difference. `per_a` is `1 / A`. Meaningless
/// unless `D > 0`, which also makes `q` non-zero.
///
/// Relative error about 3 units roundoff where `A`, `B`, `C` and `D` are exact. Source: W. H. Press et al., Numerical
/// Recipes, 5.6; E. Haines, J. Günther, T. Akenine-Möller, Precision Improvements for Ray/Sphere Intersection, Ray
/// Tracing Gems, chapter 7 (2019).
#[inline(always)]
pub fn roots<T: Real>(per_a: T, b: T, c: T, d: T) -> (T, T) {
    // Either sign gives the roots: that of `b` gives them all their digits.
    let q = -(b + d.sqrt().copysign(b.given()));
    let (x, y) = (q * per_a, c / q);
    (x.min(y), x.max(y))
}

/// What a line and a ball, or a line and a cylinder as seen along its axis, have in common: `A t² + 2 B t + C < 0` with `A = v.v`,
/// `B = w.v`, `C = w.w - r²`.
#[derive(Clone, Copy, Debug)]
pub struct Chord<T> {
    /// From the centre to the origin of the line.
    pub w: V3<T>,
    /// The direction of the line.
    pub v: V3<T>,
    /// `A`.
    pub a: T,
    /// `1 / A`.
    pub per_a: T,
    /// `C`, zero where the origin lies on the surface.
    pub c: T,
    /// The square of the radius.
    pub r2: T,
}

impl<T: Real> Chord<T> {
    /// `B`, and the discriminant: positive where the line meets the solid.
    #[inline(always)]
    pub(crate) fn terms(&self) -> (T, T) {
        let b = self.w.dot(self.v);
        (b, T::discriminant(self, b))
    }

    /// From the part of `w` perpendicular to the line, `l = w - (B/A) v`, as `A (r² - l.l)`: the error of `B/A` lies along `v`,
    /// hence enters only to second order.
    #[inline(always)]
    pub(crate) fn own_discriminant(&self, b: T) -> T {
        if T::ROBUST {
            let l = self.w - self.v.scaled(b * self.per_a);
            let away = self.a * (self.r2 - l.norm_squared());
            // On the surface the roots are 0 and -2B/A.
            T::select(self.c.eq(b.splat_like(0.0)), b.squared(), away)
        } else {
            b.squared() - self.a * self.c
        }
    }
}

#[cfg(test)]
mod tests {
    use super::roots;

    #[test]
    fn the_small_root_keeps_its_digits() {
        // t² - 2e6 t + 1: the textbook formula in f32 gives 0 for the small root.
        let (b, c): (f32, f32) = (-1e6, 1.0);
        let (near, far) = roots(1.0, b, c, b * b - c);
        assert_eq!((near, far), (5e-7, 2e6));
    }

    #[test]
    fn roots_ascend_whatever_the_signs() {
        for (a, b, c) in [(1.0_f64, -3.0, 5.0), (1.0, 3.0, 5.0), (-1.0, 2.0, 5.0), (-2.0, -1.0, 1.0)] {
            let (near, far) = roots(1.0 / a, b, c, b * b - a * c);
            assert!(near < far);
            for t in [near, far] {
                assert!((a * t * t + 2.0 * b * t + c).abs() < 1e-12);
            }
        }
    }
}
