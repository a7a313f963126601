//! Numbers of the model as those of its solids: what is one number but for its last digits becomes one literal.

use glam::Vec3;
use std::collections::HashMap;

/// The literals that are taken.
#[derive(Debug, Default)]
pub struct Literals {
    /// By the leading bits of a number's magnitude: the number that came first, and its literal.
    taken: HashMap<u64, (f64, f32)>,
}

/// How much two numbers may differ, relatively, and be one.
const SAME: f64 = 1e-9;

/// The bits of a double beyond those that tell numbers apart that differ by less than [`SAME`]: numbers with the same
/// leading bits differ by at most 2^-30.
const TRAILING_BITS: u32 = 52 - 30;

/// What is less is zero beside any solid: to the library a rounding error is never less than 2^-40.
const NOTHING: f64 = 1.0 / (1_u64 << 40) as f64;

impl Literals {
    /// The literal of a number: that of another one where they are the same but for 1e-9 of them, else the nearest.
    pub fn of(&mut self, number: f64) -> f32 {
        let size = number.abs();
        if size < NOTHING {
            return 0.0;
        }
        if !size.is_finite() {
            return number as f32;
        }
        let cell = size.to_bits() >> TRAILING_BITS;
        let near = [cell, cell - 1, cell + 1].into_iter().filter_map(|cell| self.taken.get(&cell));
        let same = near.copied().find(|(other, _)| (other - size).abs() <= SAME * size);
        let (_, literal) = same.unwrap_or_else(|| *self.taken.entry(cell).or_insert((size, size as f32)));
        // Both signs share a literal: a plane has two sides.
        literal.copysign(number as f32)
    }

    /// The literals of a point or vector.
    pub fn vector(&mut self, vector: [f64; 3]) -> Vec3 {
        Vec3::from(vector.map(|number| self.of(number)))
    }
}

#[cfg(test)]
mod tests {
    use super::Literals;
    use proptest::prelude::*;

    #[test]
    fn numbers_that_straddle_a_rounding_share_a_literal() {
        // Halfway between two neighbours in f32.
        let half = 1.0 + 0.5 * f64::from(f32::EPSILON);
        let (below, above) = (half * (1.0 - 2e-10), half * (1.0 + 2e-10));
        assert_ne!(below as f32, above as f32);
        let mut literals = Literals::default();
        assert_eq!(literals.of(below), literals.of(above));
        assert_eq!(literals.of(-above), -literals.of(below));
        assert_eq!(literals.of(1e-17), 0.0);
    }

    proptest! {
        #[test]
        fn literals_are_within_a_rounding_of_their_numbers(numbers in prop::collection::vec(-1e9..1e9_f64, 1..50)) {
            let mut literals = Literals::default();
            for number in numbers {
                for near in [number, number * (1.0 + 7e-10), number * (1.0 - 7e-10)] {
                    let literal = f64::from(literals.of(near));
                    prop_assert!((literal - near).abs() <= near.abs() * (2.0 * 1e-9 + 6e-8));
                    prop_assert_eq!(literals.of(near), literal as f32);
                }
            }
        }
    }
}
