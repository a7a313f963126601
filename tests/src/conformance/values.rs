//! Numbers that once broke some arithmetic, and what plain scalar arithmetic makes of them.

use core::fmt::Debug;
use gsdf_nostd::Lane;
use gsdf_parts::Fpu;
use rand::{Rng, RngExt};

/// A primitive number: the oracle of every arithmetic with this scalar, by the compiler's own operators and the
/// standard library alone.
pub trait Plain: Lane + Debug {
    /// The bits, as wide as those of `f64`; all NaNs alike, since a payload is nobody's promise.
    fn bits(self) -> u64;
    /// The number of these bits, or of the lower half of them.
    fn from_bits(bits: u64) -> Self;
    /// The standard library's square root: the processor's instruction.
    fn std_sqrt(self) -> Self;
    /// The standard library's next number above.
    fn std_next_up(self) -> Self;
    /// The number with its sign bit as told.
    fn signed(self, negative: bool) -> Self;
    /// The sign bit.
    fn is_negative(self) -> bool;
    /// Numbers at which formats end and conventions part.
    fn specials() -> Vec<Self>;
}

macro_rules! plain {
    ($float:ty, $bits:ty) => {
        impl Plain for $float {
            fn bits(self) -> u64 {
                let number = if self.is_nan() { <$float>::NAN } else { self };
                number.to_bits().into()
            }
            #[allow(clippy::cast_possible_truncation, reason = "the lower half is wanted")]
            fn from_bits(bits: u64) -> Self {
                <$float>::from_bits(bits as $bits)
            }
            fn std_sqrt(self) -> Self {
                self.sqrt()
            }
            fn std_next_up(self) -> Self {
                <$float>::next_up(self)
            }
            fn signed(self, negative: bool) -> Self {
                let sign = 1 << (<$bits>::BITS - 1);
                let magnitude = self.to_bits() & !sign;
                <$float>::from_bits(if negative { magnitude | sign } else { magnitude })
            }
            fn is_negative(self) -> bool {
                self.to_bits() >> (<$bits>::BITS - 1) == 1
            }
            fn specials() -> Vec<Self> {
                let tiny = <$float>::from_bits(1);
                let around = |number: $float| [number.next_down(), number, number.next_up()];
                let mut found = vec![
                    0.0,
                    <$float>::INFINITY,
                    <$float>::NAN,
                    tiny,
                    <$float>::from_bits(12_345),
                    <$float>::MAX,
                ];
                found.extend(around(<$float>::MIN_POSITIVE));
                found.extend(around(1.0));
                found.extend(around(3.0));
                found.extend([
                    <$float>::EPSILON,
                    0.1,
                    1e-20,
                    1e20,
                    <$float>::MAX / 2.0,
                    <$float>::MIN_POSITIVE * 7.0,
                ]);
                let negative: Vec<$float> = found.iter().map(|number| -number).collect();
                found.extend(negative);
                found
            }
        }
    };
}

plain!(f32, u32);
plain!(f64, u64);

/// Its oracle is that of `f32`, whose bits it promises.
impl Plain for Fpu {
    fn bits(self) -> u64 {
        self.0.bits()
    }
    fn from_bits(bits: u64) -> Self {
        Self(<f32 as Plain>::from_bits(bits))
    }
    fn std_sqrt(self) -> Self {
        Self(self.0.std_sqrt())
    }
    fn std_next_up(self) -> Self {
        Self(self.0.std_next_up())
    }
    fn signed(self, negative: bool) -> Self {
        Self(self.0.signed(negative))
    }
    fn is_negative(self) -> bool {
        self.0.is_negative()
    }
    fn specials() -> Vec<Self> {
        <f32 as Plain>::specials().into_iter().map(Self).collect()
    }
}

/// How many pairs of random bits go with the special ones.
const RANDOM_PAIRS: usize = 20_000;

/// Every special number with every other one, and random bits with random bits and with their own neighbours.
pub fn pairs<P: Plain>(rng: &mut impl Rng) -> Vec<(P, P)> {
    let specials = P::specials();
    let mut pairs: Vec<(P, P)> = specials.iter().flat_map(|&a| specials.iter().map(move |&b| (a, b))).collect();
    for _ in 0..RANDOM_PAIRS {
        let bits: u64 = rng.random();
        // Random bits are mostly far apart in size; near ones, where sums cancel and comparisons are close, are made.
        let near = bits.wrapping_add(rng.random_range(0..4));
        let other = if rng.random() { near } else { rng.random() };
        pairs.push((P::from_bits(bits), P::from_bits(other)));
    }
    pairs
}
