//! Numbers from raw bytes: any bits at all, but also those that make solids coincide, and those at the ends of ranges.

use arbitrary::Unstructured;
use core::ops::Range;
use glam::{DVec3, Mat3, Vec3};
use gsdf_nostd::{MAX_LENGTH, MAX_SPEED, MIN_LENGTH};

/// Numbers at which something ends.
#[rustfmt::skip]
const ENDS: [f32; 24] = [
    0.0, -0.0, 1.0, -1.0, 0.5,
    MIN_LENGTH, -MIN_LENGTH, MAX_LENGTH, -MAX_LENGTH, MAX_SPEED, -MAX_SPEED, 1.0 / MAX_SPEED, 1024.0, 1.0 / 1024.0,
    f32::MIN_POSITIVE, -f32::MIN_POSITIVE, 1e-45, f32::EPSILON, f32::MAX, f32::MIN,
    f32::INFINITY, f32::NEG_INFINITY, f32::NAN, 0.707_106_77,
];

/// Bytes being read; behind their end there are zeros.
pub(super) struct Raw<'a> {
    bytes: Unstructured<'a>,
    /// The number read last, beside which the next may lie.
    last: f32,
}

impl<'a> Raw<'a> {
    /// All of these bytes.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes: Unstructured::new(bytes),
            last: 1.0,
        }
    }

    /// Whether there is nothing left to read.
    pub(super) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    /// The next byte.
    pub(super) fn byte(&mut self) -> u8 {
        self.bytes.arbitrary().unwrap_or_default()
    }

    /// A number below `count`, which is not zero.
    pub(super) fn below(&mut self, count: u8) -> u8 {
        self.byte() % count
    }

    /// Whatever the next four bytes are.
    pub(super) fn bits(&mut self) -> f32 {
        f32::from_bits(self.bytes.arbitrary().unwrap_or_default())
    }

    fn signed(&mut self) -> i8 {
        self.byte().cast_signed()
    }

    /// A number: one in eight of any bits, the others whole ones and fractions, powers of two, ends of ranges, or a few
    /// units in the last place beside the one before.
    pub(super) fn number(&mut self) -> f32 {
        self.last = match self.below(8) {
            0 => self.bits(),
            1 => f32::from(self.signed() % 8),
            2 => f32::from(self.signed()) * 0.0625,
            3 => f32::from(self.signed()) * 0.1,
            4 => f32::from(self.signed()) / 127.0 * f32::from(self.signed()),
            5 => 2.0_f32.powi(i32::from(self.signed()) / 4),
            6 => ENDS[usize::from(self.byte()) % ENDS.len()],
            _ => {
                let steps = self.signed() % 33;
                let mut beside = self.last;
                for _ in 0..steps.unsigned_abs() {
                    beside = if steps < 0 { beside.next_down() } else { beside.next_up() };
                }
                beside
            }
        };
        self.last
    }

    /// A number without its sign, as sizes are; one in sixteen keeps it.
    pub(super) fn size(&mut self) -> f32 {
        if self.below(16) == 0 { self.number() } else { self.number().abs() }
    }

    /// Three numbers.
    pub(super) fn vector(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }

    /// A unit vector as a rule: along a coordinate, or any; one in eight is any vector.
    pub(super) fn unit(&mut self) -> Vec3 {
        let axes = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];
        match self.below(8) {
            0 => self.vector(),
            1..4 => axes[usize::from(self.below(6))],
            _ => {
                let [x, y, z] = [(); 3].map(|()| f64::from(self.signed()));
                DVec3::new(x, y, z).try_normalize().unwrap_or(DVec3::Y).as_vec3()
            }
        }
    }

    /// Two numbers, as a rule in ascending order and none negative.
    pub(super) fn range(&mut self) -> Range<f32> {
        match self.below(4) {
            0 => self.number()..self.number(),
            1 => {
                let start = self.size();
                start..start + self.size()
            }
            _ => 0.0..f32::INFINITY,
        }
    }

    /// A matrix and a translation: a motion, a scaling, a shear, or any.
    pub(super) fn affine(&mut self) -> (Mat3, Vec3) {
        let turned = |raw: &mut Self| {
            let (axis, angle) = (raw.unit(), f32::from(raw.signed()) * 0.025);
            Mat3::from_axis_angle(axis.try_normalize().unwrap_or(Vec3::Z), angle)
        };
        let matrix = match self.below(8) {
            0 => Mat3::from_cols(self.vector(), self.vector(), self.vector()),
            1 => {
                // Turned by quarters: columns are axes.
                let axes = [Vec3::X, Vec3::Y, Vec3::Z];
                let first = usize::from(self.below(3));
                let sign = if self.below(2) == 0 { 1.0 } else { -1.0 };
                Mat3::from_cols(axes[first] * sign, axes[(first + 1) % 3], axes[(first + 2) % 3])
            }
            2 => turned(self) * Mat3::from_diagonal(Vec3::splat(self.size())),
            3 => turned(self) * Mat3::from_diagonal(self.vector()) * turned(self),
            4 => Mat3::from_cols(Vec3::X, Vec3::new(self.number(), 1.0, self.number()), Vec3::Z),
            5 => Mat3::IDENTITY,
            _ => turned(self),
        };
        (matrix, self.vector())
    }
}
