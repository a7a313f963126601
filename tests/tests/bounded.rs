//! Numbers that know their errors do.

use core::fmt::Debug;
use gsdf_nostd::{Bounded, Mask, Real};
use gsdf_tests::reference::Exact;
use proptest::prelude::*;

/// A number and what it stands for.
#[derive(Clone, Debug)]
struct Both<T> {
    bounded: Bounded<T>,
    exact: Exact,
}

/// The precision of quotients and roots that no arithmetic has exactly.
const BITS: usize = 300;

#[derive(Clone, Copy, Debug)]
enum Operation {
    Add,
    Subtract,
    Multiply,
    Divide,
    Root,
    Less,
}

fn operations() -> impl Strategy<Value = Vec<(Operation, f32)>> {
    use Operation::{Add, Divide, Less, Multiply, Root, Subtract};
    let operation = prop::sample::select(vec![Add, Subtract, Multiply, Divide, Root, Less]);
    prop::collection::vec((operation, number()), 1..8)
}

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![-1e3..1e3_f32, -1e-3..1e-3_f32, 0.999..1.001_f32, (-8..=8_i8).prop_map(f32::from)]
}

/// Applies operations in turn; [`None`] where one has no value.
fn applied<T: Real<Scalar = T, Mask = bool> + Debug>(first: f32, operations: &[(Operation, f32)], like: T) -> Option<Both<T>> {
    let number = |value: f32| (Bounded::exact(like.splat_like(value)), Exact::from(f64::from(value)));
    let (mut bounded, mut exact) = number(first);
    for &(operation, operand) in operations {
        let (b, e) = number(operand);
        (bounded, exact) = match operation {
            Operation::Add => (bounded + b, &exact + &e),
            Operation::Subtract => (bounded - b, &exact - &e),
            Operation::Multiply => (bounded * b, &exact * &e),
            Operation::Divide if operand != 0.0 => (bounded / b, exact.quotient(&e, BITS)),
            Operation::Root if exact.sign().is_gt() => (bounded.sqrt(), exact.sqrt(BITS)),
            // What is left is the greater of the two, whether or not that is certain.
            Operation::Less => {
                let is_less = bounded.lt(b);
                let truly = (&e - &exact).sign().is_gt();
                assert!(!is_less.sure || is_less.yes == truly, "{bounded:?} < {b:?} is not {truly}");
                (Real::select(is_less, b, bounded), if truly { e } else { exact })
            }
            Operation::Divide | Operation::Root => return None,
        };
    }
    Some(Both { bounded, exact })
}

fn is_within<T: Real + Into<f64>>(both: &Both<T>) -> bool {
    let (low, high): (f64, f64) = {
        let (low, high) = both.bounded.ends();
        (low.into(), high.into())
    };
    if !(low.is_finite() && high.is_finite()) {
        // Nothing is claimed.
        return true;
    }
    let (below, above) = (&both.exact - &Exact::from(low), &Exact::from(high) - &both.exact);
    // The reference's own quotients and roots are off by a share of 2^-300.
    let least = Exact::from(-1e-80);
    !(&below - &least).sign().is_lt() && !(&above - &least).sign().is_lt()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Whatever is computed from exact numbers, in either precision, the true result is within the bound; comparisons are
    /// right where they are sure; and the values are those of the arithmetic itself.
    #[test]
    fn the_truth_is_within_the_bound(first in number(), operations in operations()) {
        if let Some(both) = applied(first, &operations, 0.0_f32) {
            prop_assert!(is_within(&both), "{:?}", both);
        }
        if let Some(both) = applied(first, &operations, 0.0_f64) {
            prop_assert!(is_within(&both), "{:?}", both);
        }
    }
}

#[test]
fn what_is_exact_stays_so() {
    let (three, four) = (Bounded::exact(3.0_f32), Bounded::exact(4.0));
    assert_eq!((three - four) + four, three);
    assert_eq!((three * four.splat_like(0.0)).error, 0.0);
    assert_eq!(three.times_power(Bounded::exact(0.125)), Bounded::exact(0.375));
    assert!(three.lt(four).sure && three.eq(three).sure && (three.lt(four) | four.lt(three)).all());
    let third = Bounded::exact(1.0_f32) / three;
    assert!(third.error > 0.0 && !third.eq(third).sure && third.lt(four).sure);
}
