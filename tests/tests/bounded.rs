//! Numbers that know their errors do.

use core::fmt::Debug;
use glam::DVec3;
use gsdf_nostd::{Bounded, Chord, Mask, Real, V3};
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

/// A number from a range. Not proptest's own for `f32`, which now and then fails an assertion of its own.
fn between(low: f64, high: f64) -> impl Strategy<Value = f32> {
    any::<u32>().prop_map(move |word| (low + (high - low) * f64::from(word) / f64::from(u32::MAX)) as f32)
}

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        between(-1e3, 1e3),
        between(-1e-3, 1e-3),
        between(0.999, 1.001),
        (-8..=8_i8).prop_map(f32::from)
    ]
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

/// A vector and what it stands for: each component within its error.
#[derive(Clone, Debug)]
struct Vector<T> {
    bounded: V3<Bounded<T>>,
    exact: [Exact; 3],
}

/// A component and by how many units roundoff of its value it is off.
fn component() -> impl Strategy<Value = (f32, i8)> {
    let value = prop_oneof![number(), between(-1e-30, 1e-30), between(-1e12, 1e12), Just(0.0), Just(1.0)];
    (value, prop_oneof![Just(0), -8..=8_i8])
}

fn vector<T: Real<Scalar = T, Mask = bool>>(components: [(f32, i8); 3], like: T) -> Vector<T> {
    let off = |(value, off): (f32, i8)| f64::from(value) * f64::from(off) * f64::from(T::ROUNDOFF);
    let bounded = components.map(|(value, steps)| Bounded {
        value: like.splat_like(value),
        // `ROUNDOFF` is a power of two, so that nothing is rounded here but in `f32` what is lost below all numbers.
        error: like.splat_like(value).abs() * like.splat_like(f32::from(steps).abs()) * like.splat_like(T::ROUNDOFF),
    });
    let [x, y, z] = bounded;
    Vector {
        bounded: V3::new(x, y, z),
        exact: components.map(|component| &Exact::from(component.0) + &Exact::from(off(component))),
    }
}

fn exact_dot(a: &[Exact; 3], b: &[Exact; 3]) -> Exact {
    &(&(&a[0] * &b[0]) + &(&a[1] * &b[1])) + &(&a[2] * &b[2])
}

fn exact_cross(a: &[Exact; 3], b: &[Exact; 3]) -> [Exact; 3] {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &(&a[i] * &b[j]) - &(&a[j] * &b[i]))
}

/// Products of vectors, and the discriminant of a chord, which is that of the exact `W`, `V` and radius.
fn products<T: Real<Scalar = T, Mask = bool> + Into<f64> + Debug>(w: [(f32, i8); 3], v: [(f32, i8); 3], radius: f32, like: T) {
    let (w, v) = (vector(w, like), vector(v, like));
    let holds = |what: &str, bounded: Bounded<T>, exact: Exact| {
        assert!(
            is_within(&Both { bounded, exact }),
            "{what} of {w:?} and {v:?}, {radius}: {bounded:?}"
        );
    };
    holds("dot", w.bounded.dot(v.bounded), exact_dot(&w.exact, &v.exact));
    let cross = w.bounded.cross(v.bounded);
    for (bounded, exact) in [cross.x, cross.y, cross.z].into_iter().zip(exact_cross(&w.exact, &v.exact)) {
        holds("cross", bounded, exact);
    }
    let (a, r2) = (v.bounded.norm_squared(), Bounded::exact(like.splat_like(radius)).squared());
    let chord = Chord {
        w: w.bounded,
        v: v.bounded,
        a,
        per_a: Bounded::exact(like.splat_like(1.0)) / a,
        c: w.bounded.norm_squared() - r2,
        r2,
    };
    let (exact_a, exact_b) = (exact_dot(&v.exact, &v.exact), exact_dot(&w.exact, &v.exact));
    let exact_c = &exact_dot(&w.exact, &w.exact) - &Exact::from(radius).square();
    let d = Real::discriminant(&chord, chord.w.dot(chord.v));
    holds("discriminant", d, &exact_b.square() - &(&exact_a * &exact_c));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Where the line passes at any distance, and where it touches the ball.
    #[test]
    fn products_of_vectors_are_within_their_bounds(
        w in [component(), component(), component()],
        v in [component(), component(), component()],
        radius in between(1e-3, 1e3),
    ) {
        products(w, v, radius, 0.0_f32);
        products(w, v, radius, 0.0_f64);
        // The distance of the line from the middle, or nearly so.
        let vector = |of: [(f32, i8); 3]| DVec3::from_array(of.map(|(value, _)| value.into()));
        let (w_exact, v_exact) = (vector(w), vector(v));
        let distance = (w_exact.cross(v_exact).length() / v_exact.length()) as f32;
        if distance.is_finite() {
            for touching in [distance, distance.next_up(), distance * 1.000_01] {
                products(w, v, touching, 0.0_f32);
                products(w, v, touching, 0.0_f64);
            }
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
