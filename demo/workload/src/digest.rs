//! One number for many results: a hash over their bits.

use gsdf_nostd::Hit;

/// The 64-bit FNV-1a hash of a stream of words, each as four bytes, the least significant first.
///
/// FNV because it is five lines that anyone can write down again in any language, and a crate's hash would be one more
/// thing that may change; it need not withstand anyone. Zeros of both signs differ, as they should. Source: G. Fowler,
/// L. Noll, K.-P. Vo, D. Eastlake, The FNV Non-Cryptographic Hash Algorithm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Self {
        Self::new()
    }
}

impl Digest {
    /// The leaf of a ray that hits nothing.
    const NO_LEAF: u32 = u32::MAX;

    /// What stands for a question that was refused: no leaf's number, and not that of none.
    const REFUSED: u32 = u32::MAX - 1;

    /// The hash of nothing.
    #[must_use]
    pub const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// Adds 32 bits.
    pub fn word(&mut self, word: u32) {
        for byte in word.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        }
    }

    /// Adds a number, bit by bit. All NaN count as one: which one an operation returns, IEEE 754 leaves open.
    pub fn number(&mut self, number: f32) {
        self.word(if number.is_nan() { f32::NAN.to_bits() } else { number.to_bits() });
    }

    /// Adds what a pixel shows: distance, normal and leaf. None of them is ever NaN.
    pub fn hit(&mut self, distance: f32, normal: [f32; 3], leaf: u32) {
        for number in [distance, normal[0], normal[1], normal[2]] {
            self.word(number.to_bits());
        }
        self.word(leaf);
    }

    /// Adds the result of a cast; a miss as a pixel shows it, infinitely far and without a normal.
    pub fn cast(&mut self, found: Option<&Hit>) {
        match found {
            Some(hit) => self.hit(hit.t, hit.normal.to_array(), hit.leaf),
            None => self.hit(f32::INFINITY, [0.0; 3], Self::NO_LEAF),
        }
    }

    /// Adds that there was no ray to ask about.
    pub fn refused(&mut self) {
        self.word(Self::REFUSED);
    }

    /// The hash of all that was added.
    #[must_use]
    pub const fn finish(&self) -> u64 {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::Digest;
    use core::f32::consts::PI;

    fn of(add: impl FnOnce(&mut Digest)) -> u64 {
        let mut digest = Digest::new();
        add(&mut digest);
        digest.finish()
    }

    /// The offset basis that the algorithm's authors chose, and the hash they published of the bytes "foob".
    #[test]
    fn the_authors_examples() {
        assert_eq!(of(|_| ()), 0xcbf2_9ce4_8422_2325);
        assert_eq!(of(|digest| digest.word(u32::from_le_bytes(*b"foob"))), 0xdd12_0e79_0c25_12af);
    }

    #[test]
    fn zeros_of_both_signs_differ_and_all_nan_are_one() {
        assert_ne!(of(|digest| digest.number(0.0)), of(|digest| digest.number(-0.0)));
        let other = f32::from_bits(0xff80_0001);
        assert!(other.is_nan());
        assert_eq!(of(|digest| digest.number(f32::NAN)), of(|digest| digest.number(other)));
        assert_ne!(of(|digest| digest.number(PI)), of(|digest| digest.number(PI.next_up())));
    }

    #[test]
    fn a_miss_is_no_refusal_and_no_nothing() {
        let [miss, refusal] = [of(|digest| digest.cast(None)), of(Digest::refused)];
        assert_ne!(miss, refusal);
        assert_ne!(miss, of(|_| ()));
        assert_ne!(refusal, of(|_| ()));
    }
}
