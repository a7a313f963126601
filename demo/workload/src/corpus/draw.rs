//! How the rays of the corpus are drawn.

use super::{BLOCK, PROGRAMS, RAYS};
use glam::{Vec3, vec3};
use gsdf_nostd::{MAX_LENGTH, MAX_SPEED, Ray, RayError};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// What a ray was made to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// From outside at a point of the middle.
    Aimed,
    /// From within the middle, anywhere.
    Inside,
    /// From a multiple of a quarter along an axis.
    Axis,
    /// From a multiple of a quarter through another: in faces, along edges, through tips.
    Grid,
    /// As [`Grid`](Self::Grid), with the coordinates of the origin moved by a few units in the last place.
    Grazing,
    /// With a range, which may be none.
    Ranged,
    /// With some components at the ends of what there is.
    Special,
    /// Of random bits.
    Raw,
}

impl Class {
    /// The classes, with the share of each in 256.
    pub const SHARES: [(Self, u32); 8] = [
        (Self::Aimed, 68),
        (Self::Inside, 32),
        (Self::Axis, 32),
        (Self::Grid, 32),
        (Self::Grazing, 28),
        (Self::Ranged, 28),
        (Self::Special, 28),
        (Self::Raw, 8),
    ];

    /// The class a random byte stands for.
    fn of(byte: u32) -> Self {
        let mut left = byte;
        for (class, share) in Self::SHARES {
            if left < share {
                return class;
            }
            left -= share;
        }
        Self::Raw
    }
}

/// A question of the corpus: numbers that may or may not be a ray, and the program they are for.
#[derive(Clone, Copy, Debug)]
pub struct Query {
    /// What the numbers were made to be.
    pub class: Class,
    /// The number of the [`program`](super::program).
    pub program: usize,
    /// Where the ray starts.
    pub origin: Vec3,
    /// Where it points.
    pub direction: Vec3,
    /// The start of its range.
    pub start: f32,
    /// The end of its range.
    pub end: f32,
}

impl Query {
    /// The ray of these numbers.
    ///
    /// # Errors
    /// Where they are none.
    pub fn ray(&self) -> Result<Ray, RayError> {
        Ray::new(self.origin, self.direction)?.within(self.start..self.end)
    }
}

/// The rays of the corpus, in order.
#[derive(Clone, Debug)]
pub struct Queries {
    random: Pcg32,
    number: usize,
}

impl Queries {
    pub(super) fn new() -> Self {
        // The state and the stream of the generator's own reference example.
        Self {
            random: Pcg32::new(42, 54),
            number: 0,
        }
    }

    fn word(&mut self) -> u32 {
        self.random.next_u32()
    }

    /// A number from -1 up to 1, a multiple of 2^-23.
    fn fraction(&mut self) -> f32 {
        (self.word() >> 8) as f32 * (1.0 / 8_388_608.0) - 1.0
    }

    /// A multiple of a quarter from -1 to 1: where a solid may have a face, an edge or a tip.
    fn quarters(&mut self) -> f32 {
        (self.word() % 9) as f32 * 0.25 - 1.0
    }

    /// A power of two from 1/8 to 16.
    fn power(&mut self) -> f32 {
        (1_u32 << (self.word() >> 29)) as f32 * 0.125
    }

    /// A vector of three such numbers.
    fn three(&mut self, mut number: impl FnMut(&mut Self) -> f32) -> Vec3 {
        let (x, y, z) = (number(self), number(self), number(self));
        vec3(x, y, z)
    }

    /// From outside at a point of the middle: neither of unit length nor at right angles to anything.
    fn aimed(&mut self) -> (Vec3, Vec3) {
        let mut origin = self.three(|draw| 4.0 * draw.fraction());
        // One coordinate puts it outside.
        let word = self.word();
        origin[(word % 3) as usize] = if word & 0x100 == 0 { 3.0 } else { -3.0 };
        let target = self.three(|draw| 0.75 * draw.fraction());
        (origin, (target - origin) * self.power())
    }

    fn inside(&mut self) -> (Vec3, Vec3) {
        (self.three(|draw| 0.5 * draw.fraction()), self.three(Self::fraction))
    }

    fn along_axis(&mut self) -> (Vec3, Vec3) {
        let mut origin = self.three(Self::quarters);
        let word = self.word();
        let axis = (word % 3) as usize;
        let speed = if word & 0x100 == 0 { self.power() } else { -self.power() };
        // Some start among the solids, the others before them.
        if word & 0x200 == 0 {
            origin[axis] = if speed < 0.0 { 2.0 } else { -2.0 };
        }
        let mut direction = Vec3::ZERO;
        direction[axis] = speed;
        (origin, direction)
    }

    fn through_grid(&mut self) -> (Vec3, Vec3) {
        let (origin, target) = (self.three(Self::quarters) * 2.0, self.three(Self::quarters));
        let word = self.word();
        let mut direction = (target - origin) * 0.5;
        // Mostly in a plane of the grid.
        if word & 0x300 != 0 {
            direction[(word % 3) as usize] = 0.0;
        }
        (origin, direction)
    }

    fn grazing(&mut self) -> (Vec3, Vec3) {
        let (origin, direction) = self.through_grid();
        (vec3(self.nudged(origin.x), self.nudged(origin.y), self.nudged(origin.z)), direction)
    }

    /// The number, moved by up to three units in the last place.
    fn nudged(&mut self, number: f32) -> f32 {
        let word = self.word();
        (0..word >> 30).fold(
            number,
            |number, _| if word & 1 == 0 { number.next_up() } else { number.next_down() },
        )
    }

    fn aimed_or_along_axis(&mut self) -> (Vec3, Vec3) {
        if self.word() & 1 == 0 { self.aimed() } else { self.along_axis() }
    }

    /// A range that starts at a multiple of a quarter, where a ray along an axis may well have a crossing.
    fn range(&mut self) -> (f32, f32) {
        // The first of these numbers is none to start from, the first of those below no length.
        let start = (self.word() >> 29) as f32 * 0.25 - 0.25;
        let length = if self.word() & 3 == 0 {
            self.special()
        } else {
            (self.word() >> 28) as f32 * 0.25
        };
        (start, start + length)
    }

    /// A ray with some components replaced.
    fn special_line(&mut self) -> (Vec3, Vec3) {
        let (mut origin, mut direction) = self.aimed_or_along_axis();
        let which = self.word();
        for axis in 0..3 {
            if which >> (4 * axis) & 3 == 0 {
                origin[axis] = self.special();
            }
            if which >> (4 * axis + 16) & 3 == 0 {
                direction[axis] = self.special();
            }
        }
        (origin, direction)
    }

    fn raw(&mut self) -> f32 {
        f32::from_bits(self.word())
    }

    /// One of the numbers at which something ends, of either sign.
    fn special(&mut self) -> f32 {
        const MAGNITUDES: [f32; 16] = [
            0.0,
            // The least number, another subnormal and the least normal.
            f32::from_bits(1),
            f32::from_bits(0x0040_0001),
            f32::MIN_POSITIVE,
            // The slowest and the fastest directions, the farthest coordinates, and what is just beyond.
            (1.0 / MAX_SPEED).next_down(),
            1.0 / MAX_SPEED,
            MAX_SPEED,
            MAX_SPEED.next_up(),
            MAX_LENGTH,
            MAX_LENGTH.next_up(),
            f32::MAX,
            f32::INFINITY,
            f32::NAN,
            1.0,
            0.5,
            1.0 / 1_048_576.0,
        ];
        let word = self.word();
        let magnitude = MAGNITUDES[(word >> 28) as usize];
        if word & 1 == 0 { magnitude } else { -magnitude }
    }
}

impl Iterator for Queries {
    type Item = Query;

    fn next(&mut self) -> Option<Query> {
        if self.number == RAYS {
            return None;
        }
        let class = Class::of(self.word() >> 24);
        let (origin, direction) = match class {
            Class::Aimed => self.aimed(),
            Class::Inside => self.inside(),
            Class::Axis => self.along_axis(),
            Class::Grid => self.through_grid(),
            Class::Grazing => self.grazing(),
            Class::Ranged => self.aimed_or_along_axis(),
            Class::Special => self.special_line(),
            Class::Raw => (self.three(Self::raw), self.three(Self::raw)),
        };
        let (start, end) = if class == Class::Ranged {
            self.range()
        } else {
            (0.0, f32::INFINITY)
        };
        let program = self.number / BLOCK % PROGRAMS;
        self.number += 1;
        Some(Query {
            class,
            program,
            origin,
            direction,
            start,
            end,
        })
    }
}
