//! The duties of an arithmetic: in every lane the bits of plain scalar arithmetic, whatever the other lanes hold.

use super::lanes::{Lanes, bits_of, mask_of};
use super::values::{Plain, pairs};
use gsdf_nostd::Mask;
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// An operation on two numbers, by its name.
type Binary<N> = (&'static str, fn(N, N) -> N);

/// Calls `check` with packets of two operands each, so that every pair of numbers comes to lie in every lane; and the
/// lanes' operands.
fn for_packets<T: Lanes>(mut check: impl FnMut(T, T, &dyn Fn(usize) -> (T::Scalar, T::Scalar))) {
    let pairs = pairs::<T::Scalar>(&mut Pcg64::seed_from_u64(1));
    // Each packet starts one pair after the one before: every lane has seen every pair in the end.
    for start in 0..pairs.len() {
        let pair = |lane: usize| pairs[(start + lane) % pairs.len()];
        check(T::from_lanes(|lane| pair(lane).0), T::from_lanes(|lane| pair(lane).1), &pair);
    }
}

/// Holds operations to what the same ones give on plain numbers.
fn check_binary<T: Lanes>(operations: &[Binary<T>], plain: &[Binary<T::Scalar>]) {
    for_packets::<T>(|a, b, pair| {
        for ((name, operation), (_, oracle)) in operations.iter().zip(plain) {
            let found = operation(a, b);
            for lane in 0..T::LANES {
                let (a, b) = pair(lane);
                let (found, expected) = (found.lane(lane), oracle(a, b));
                assert_eq!(
                    found.bits(),
                    expected.bits(),
                    "{name} of {a:?} and {b:?} in lane {lane}: {found:?}, not {expected:?}"
                );
            }
        }
    });
}

/// `+ - * /` and the square of a number.
///
/// # Panics
/// Where the type fails this duty.
pub fn sums_differences_products_and_quotients_round_once<T: Lanes>() {
    check_binary::<T>(
        &[
            ("sum", |a, b| a + b),
            ("difference", |a, b| a - b),
            ("product", |a, b| a * b),
            ("quotient", |a, b| a / b),
            ("square", |a, _| a.squared()),
        ],
        &[
            ("", |a, b| a + b),
            ("", |a, b| a - b),
            ("", |a, b| a * b),
            ("", |a, b| a / b),
            ("", |a, _| a * a),
        ],
    );
}

/// Square roots are those of the processor: correctly rounded, NaN below zero, -0 at -0.
///
/// # Panics
/// Where the type fails this duty.
pub fn square_roots_round_once<T: Lanes>() {
    check_binary::<T>(&[("root", |a, _| a.sqrt())], &[("", |a, _| a.std_sqrt())]);
}

/// Negation, magnitude and the sign of another number change the sign bit and nothing else, also of zeros.
///
/// # Panics
/// Where the type fails this duty.
pub fn signs_are_bits<T: Lanes>() {
    check_binary::<T>(
        &[
            ("negation", |a, _| -a),
            ("magnitude", |a, _| a.abs()),
            ("copysign", |a, b| a.copysign(b)),
        ],
        &[
            ("", |a, _| a.signed(!a.is_negative())),
            ("", |a, _| a.signed(false)),
            ("", |a, b| a.signed(b.is_negative())),
        ],
    );
}

/// The next number is the least greater one; infinity and NaN have none.
///
/// # Panics
/// Where the type fails this duty.
pub fn the_next_number_is_the_least_greater_one<T: Lanes>() {
    check_binary::<T>(&[("next", |a, _| a.next_up())], &[("", |a, _| a.std_next_up())]);
}

/// A comparison, by its name.
type Comparison<N, M> = (&'static str, fn(N, N) -> M);

/// The same comparison of plain numbers.
type Oracle<N> = fn(&N, &N) -> bool;

/// `< <= = >`, with both zeros equal and nothing true of a NaN.
///
/// # Panics
/// Where the type fails this duty.
pub fn comparisons_are_false_with_nan<T: Lanes>() {
    let comparisons: [Comparison<T, T::Mask>; 4] = [("<", T::lt), ("<=", T::le), ("=", T::eq), (">", T::gt)];
    let plain: [Oracle<T::Scalar>; 4] = [
        <T::Scalar as PartialOrd>::lt,
        <T::Scalar as PartialOrd>::le,
        <T::Scalar as PartialEq>::eq,
        <T::Scalar as PartialOrd>::gt,
    ];
    for_packets::<T>(|a, b, pair| {
        for ((name, comparison), oracle) in comparisons.iter().zip(plain) {
            let found = bits_of::<T>(comparison(a, b));
            for lane in 0..T::LANES {
                let (a, b) = pair(lane);
                assert_eq!(found >> lane & 1 == 1, oracle(&a, &b), "{a:?} {name} {b:?} in lane {lane}");
            }
        }
    });
}

/// The contract of x86's `minps` and `maxps`, everywhere.
///
/// # Panics
/// Where the type fails this duty.
pub fn minima_and_maxima_return_the_second_operand_on_ties_and_nan<T: Lanes>() {
    check_binary::<T>(
        &[("minimum", T::min), ("maximum", T::max)],
        &[("", |a, b| if a < b { a } else { b }), ("", |a, b| if b < a { a } else { b })],
    );
}

/// Selection takes each lane from one operand or the other, NaNs and zeros unharmed, for every mask of up to eight lanes
/// and thousands of wider ones.
///
/// # Panics
/// Where the type fails this duty.
pub fn selection_goes_lane_by_lane<T: Lanes>() {
    let mut bits = 0_u32;
    for_packets::<T>(|a, b, pair| {
        bits = (bits + 257) % (1 << T::LANES);
        let found = T::select(mask_of::<T>(|lane| bits >> lane & 1 == 1), a, b);
        for lane in 0..T::LANES {
            let (yes, no) = pair(lane);
            let expected = if bits >> lane & 1 == 1 { yes } else { no };
            assert_eq!(
                found.lane(lane).bits(),
                expected.bits(),
                "mask {bits:b}, lane {lane} of {yes:?} and {no:?}"
            );
        }
    });
}

/// Constants are the same number in every lane, whatever value they are made like.
///
/// # Panics
/// Where the type fails this duty.
pub fn constants_fill_every_lane<T: Lanes>() {
    for like in <T::Scalar as Plain>::specials() {
        let like = T::from_lanes(|_| like);
        for number in <f32 as Plain>::specials() {
            let made = like.splat_like(number);
            let expected = T::Scalar::from(number).bits();
            assert!(
                (0..T::LANES).all(|lane| made.lane(lane).bits() == expected),
                "{number} in every lane"
            );
        }
        for number in <T::Scalar as Plain>::specials() {
            let made = like.lift_like(number);
            assert!(
                (0..T::LANES).all(|lane| made.lane(lane).bits() == number.bits()),
                "{number:?} in every lane"
            );
        }
    }
}

/// And, or, not, difference, any, all and constants, for every pair of masks of up to eight lanes, and a million pairs of
/// wider ones.
///
/// # Panics
/// Where the type fails this duty.
pub fn masks_are_truth_values_lane_by_lane<T: Lanes>() {
    let every = (1_u32 << T::LANES) - 1;
    let mask = |bits: u32| mask_of::<T>(|lane| bits >> lane & 1 == 1);
    // Every mask with every other, up to eight lanes; of more lanes every seventeenth with 256 others.
    for first in (0..=every).step_by(if T::LANES > 8 { 17 } else { 1 }) {
        let a = mask(first);
        assert_eq!(bits_of::<T>(a), first);
        assert_eq!(bits_of::<T>(!a), first ^ every, "not {first:b}");
        assert_eq!(bits_of::<T>(a.splat_like(true)), every);
        assert_eq!(bits_of::<T>(a.splat_like(false)), 0);
        for step in 0..=every.min(255) {
            let second = (first + 257 * step) & every;
            let b = mask(second);
            assert_eq!(bits_of::<T>(a & b), first & second, "{first:b} and {second:b}");
            assert_eq!(bits_of::<T>(a | b), first | second, "{first:b} or {second:b}");
            assert_eq!(bits_of::<T>(a.differs_from(b)), first ^ second, "{first:b} differs from {second:b}");
        }
    }
}
