//! Lane types beyond their arithmetic: how numbers get into lanes and out again, on every level the machine has.

use gsdf_nostd::Mask;
use gsdf_simd::{LaneMask, Lanes, Level, MOST_LANES, Work};

/// What a lane type does with the numbers of a slice.
trait Duty {
    fn hold<T: Lanes>(&self, token: T::Token, numbers: &[f32]);
}

struct AtLevel<'d, D>(&'d D, &'d [f32]);

impl<D: Duty> Work for AtLevel<'_, D> {
    type Output = ();

    /// Once as plain code, and once where all is compiled for the level.
    fn run<T: Lanes>(self, token: T::Token) {
        self.0.hold::<T>(token, self.1);
        T::vectorize(token, || self.0.hold::<T>(token, self.1));
    }
}

/// Numbers that lanes can be told apart by, zeros and denormals among them, in slices of every length.
fn on_every_level(duty: &impl Duty) {
    let numbers: [f32; 2 * MOST_LANES] = core::array::from_fn(|index| match index % 7 {
        3 => -0.0,
        5 => f32::from_bits(index as u32 + 1),
        _ => (index as f32 - 11.0) * 1.25,
    });
    for level in Level::available() {
        for length in 0..=numbers.len() {
            level.run(AtLevel(duty, &numbers[..length]));
        }
    }
}

fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|number| number.to_bits()).collect()
}

#[test]
fn loads_take_what_there_is_and_zeros() {
    struct Loads;
    impl Duty for Loads {
        fn hold<T: Lanes>(&self, token: T::Token, numbers: &[f32]) {
            let expected: Vec<f32> = numbers.iter().copied().chain(core::iter::repeat(0.0)).take(T::LANES).collect();
            let value = T::load(token, numbers);
            assert_eq!(bits(value.to_array().as_ref()), bits(&expected));
            let lanes: Vec<_> = (0..T::LANES).filter_map(|lane| value.lane(lane)).collect();
            assert_eq!(bits(&lanes), bits(&expected));
            assert_eq!((value.lane(T::LANES), value.lane(usize::MAX)), (None, None));
            assert!(T::LANES <= MOST_LANES);
        }
    }
    on_every_level(&Loads);
}

#[test]
fn stores_reach_as_far_as_the_slice_and_no_farther_than_the_lanes() {
    struct Stores;
    impl Duty for Stores {
        fn hold<T: Lanes>(&self, token: T::Token, numbers: &[f32]) {
            let value = T::load(token, &[1.0; MOST_LANES]) + T::load(token, &[0.5, 1.5]);
            let mut place = numbers.to_vec();
            value.store(&mut place);
            let held = numbers.len().min(T::LANES);
            assert_eq!(bits(&place[..held]), bits(&value.to_array().as_ref()[..held]));
            assert_eq!(bits(&place[held..]), bits(&numbers[held..]));
        }
    }
    on_every_level(&Stores);
}

#[test]
fn values_are_made_from_the_token_of_another() {
    struct Splats;
    impl Duty for Splats {
        fn hold<T: Lanes>(&self, token: T::Token, numbers: &[f32]) {
            for &number in numbers {
                let value = T::splat(T::splat(token, 7.0).token(), number);
                assert_eq!(bits(value.to_array().as_ref()), bits(&vec![number; T::LANES]));
            }
            assert!(T::detect().is_some());
        }
    }
    on_every_level(&Splats);
}

#[test]
fn powers_of_two_are_the_exponents() {
    struct Powers;
    impl Duty for Powers {
        fn hold<T: Lanes>(&self, token: T::Token, _: &[f32]) {
            let numbers: [f32; MOST_LANES] = [
                1.0,
                1.99,
                2.0,
                3.0,
                1e-30,
                1e30,
                0.75,
                1023.9,
                1024.0,
                5e-7,
                6.5,
                1e9,
                0.1,
                100.0,
                f32::MAX,
                f32::MIN_POSITIVE,
            ];
            let powers = T::load(token, &numbers).power_of_two_below().to_array();
            for (number, power) in numbers.iter().zip(powers.as_ref()) {
                assert!(power <= number && *number / 2.0 < *power, "{power} below {number}");
                assert_eq!(power.to_bits() << 9, 0, "{power} is a power of two");
            }
        }
    }
    on_every_level(&Powers);
}

#[test]
fn least_and_greatest_are_lanes() {
    struct Extremes;
    impl Duty for Extremes {
        fn hold<T: Lanes>(&self, token: T::Token, numbers: &[f32]) {
            let value = T::load(token, numbers);
            let lanes = value.to_array();
            let least = lanes.as_ref().iter().copied().fold(f32::INFINITY, f32::min);
            let greatest = lanes.as_ref().iter().copied().fold(f32::NEG_INFINITY, f32::max);
            assert_eq!((value.least(), value.greatest()), (least, greatest));
            // Wherever they lie, and whatever their signs.
            for lane in 0..T::LANES {
                let mut one = [0.0; MOST_LANES];
                one[lane] = f32::INFINITY;
                assert_eq!(T::load(token, &one).greatest(), f32::INFINITY);
                assert_eq!((-T::load(token, &one)).least(), f32::NEG_INFINITY);
            }
        }
    }
    on_every_level(&Extremes);
}

#[test]
fn bits_of_masks_are_their_lanes() {
    struct Bits;
    impl Duty for Bits {
        fn hold<T: Lanes>(&self, token: T::Token, numbers: &[f32]) {
            let mask = T::splat(token, 0.0).lt(T::load(token, numbers));
            let expected =
                (numbers.iter().take(T::LANES).enumerate()).fold(0, |bits, (lane, number)| bits | u32::from(*number > 0.0) << lane);
            assert_eq!(mask.to_bits(), expected);
            assert_eq!(mask.splat_like(true).to_bits(), (1 << T::LANES) - 1);
            assert_eq!(mask.splat_like(false).to_bits(), 0);
        }
    }
    on_every_level(&Bits);
}
