//! The quadratic inequality `A t² + 2 B t + C < 0` whose discriminant is known better than its coefficients tell.

use crate::real::Real;

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
