//! A membership function along a line: a polynomial of degree at most two, and its real roots.

use core::cmp::Ordering;

use super::number::Exact;

/// How many significant bits of a root are computed.
///
/// The square root and the quotient are each rounded once at this width, and nothing cancels between them, so more
/// than 300 of these bits are right, however close the two roots lie.
const ROOT_BITS: usize = 320;

/// The polynomial `square t² + linear t + constant`, with exact coefficients.
#[derive(Clone, Debug)]
pub(super) struct Quadratic {
    square: Exact,
    linear: Exact,
    constant: Exact,
}

impl Quadratic {
    /// The polynomial with these values at `t = -1`, `0` and `1`.
    ///
    /// Halving is exact in binary, so nothing is lost, and nobody has to expand the membership function by hand.
    pub(super) fn through(before: &Exact, at_zero: &Exact, after: &Exact) -> Self {
        Self {
            square: &(after + before).scaled(-1) - at_zero,
            linear: (after - before).scaled(-1),
            constant: at_zero.clone(),
        }
    }

    /// The exact sign of the polynomial at `t`.
    pub(super) fn sign_at(&self, t: &Exact) -> Ordering {
        let slope = &(&self.square * t) + &self.linear;
        (&(&slope * t) + &self.constant).sign()
    }

    /// Adds the distinct real roots to `roots`, in no particular order.
    ///
    /// A polynomial that is zero everywhere adds none: it changes its sign nowhere.
    pub(super) fn push_roots(&self, roots: &mut Vec<Exact>) {
        if self.square.is_zero() {
            if !self.linear.is_zero() {
                roots.push((-&self.constant).quotient(&self.linear, ROOT_BITS));
            }
            return;
        }
        let discriminant = &self.linear.square() - &(&self.square * &self.constant).scaled(2);
        match discriminant.sign() {
            Ordering::Less => {}
            Ordering::Equal => {
                roots.push((-&self.linear).quotient(&self.square.scaled(1), ROOT_BITS));
            }
            Ordering::Greater => {
                let root = discriminant.sqrt(ROOT_BITS);
                // The sum of two numbers of one sign: the difference would lose the bits the two have in common. The
                // other root follows from the product of the two, `constant / square`.
                let sum = if self.linear.sign().is_lt() {
                    &root - &self.linear
                } else {
                    -(&root + &self.linear)
                };
                roots.push(sum.quotient(&self.square.scaled(1), ROOT_BITS));
                roots.push(self.constant.scaled(1).quotient(&sum, ROOT_BITS));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn quadratic(square: f64, linear: f64, constant: f64) -> Quadratic {
        let [square, linear, constant] = [square, linear, constant].map(Exact::from);
        Quadratic { square, linear, constant }
    }

    fn roots(square: f64, linear: f64, constant: f64) -> Vec<f64> {
        let mut roots = Vec::new();
        quadratic(square, linear, constant).push_roots(&mut roots);
        roots.sort();
        roots.iter().map(Exact::to_f64).collect()
    }

    #[test]
    fn roots_by_hand() {
        assert_eq!(roots(1.0, -3.0, 2.0), [1.0, 2.0]);
        assert_eq!(roots(-1.0, 0.0, 4.0), [-2.0, 2.0]);
        assert_eq!(roots(1.0, -5.0, 0.0), [0.0, 5.0]);
        assert_eq!(roots(1.0, 5.0, 0.0), [-5.0, 0.0]);
        assert_eq!(roots(4.0, -4.0, 1.0), [0.5]);
        assert_eq!(roots(3.0, 0.0, 0.0), [0.0]);
        assert_eq!(roots(1.0, 0.0, 1e-300), [0.0; 0]);
        assert_eq!(roots(0.0, 4.0, -1.0), [0.25]);
        assert_eq!(roots(0.0, 0.0, 1.0), [0.0; 0]);
        assert_eq!(roots(0.0, 0.0, 0.0), [0.0; 0]);
        // The smaller root of t² - 2¹⁰⁰ t + 1 would vanish in a difference.
        assert_eq!(roots(1.0, -f64::powi(2.0, 100), 1.0), [f64::powi(2.0, -100), f64::powi(2.0, 100)]);
    }

    #[test]
    fn three_values_make_the_polynomial() {
        let value = |t: f64| Exact::from(3.0 * t * t - 5.0 * t + 7.0);
        let polynomial = Quadratic::through(&value(-1.0), &value(0.0), &value(1.0));
        let expected = quadratic(3.0, -5.0, 7.0);
        assert_eq!(polynomial.square, expected.square);
        assert_eq!(polynomial.linear, expected.linear);
        assert_eq!(polynomial.constant, expected.constant);
    }

    fn coefficient() -> impl Strategy<Value = f64> {
        prop_oneof![
            any::<u32>()
                .prop_map(f32::from_bits)
                .prop_filter("finite", |number| number.is_finite())
                .prop_map(f64::from),
            -1e3..1e3_f64,
            (-4..=4_i32).prop_map(f64::from),
        ]
    }

    proptest! {
        /// A simple root is one if the exact sign differs on its two sides; 300 bits say how near the two sides are.
        #[test]
        fn the_sign_changes_within_300_bits_of_a_simple_root(
            square in coefficient(), linear in coefficient(), constant in coefficient(),
        ) {
            let polynomial = quadratic(square, linear, constant);
            let mut roots = Vec::new();
            polynomial.push_roots(&mut roots);
            prop_assert!(roots.len() <= 2);
            let double = square != 0.0 && roots.len() == 1;
            for root in &roots {
                let margin = if root.is_zero() { Exact::ONE.scaled(-600) } else { root.abs().scaled(-300) };
                let before = polynomial.sign_at(&(root - &margin));
                let after = polynomial.sign_at(&(root + &margin));
                prop_assert!(before.is_ne() && after.is_ne());
                prop_assert_eq!(before == after, double);
            }
        }
    }
}
