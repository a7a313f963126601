//! The frames of a model's solids, each made once.

use super::affine::Affine;
use glam::{Mat3, Vec3};
use gsdf_nostd::Transform;
use std::collections::HashMap;

/// The frames that solids stand in, but for the world.
#[derive(Clone, Debug, Default)]
pub struct Frames {
    /// Their numbers, from 1, by the bits of their matrices.
    numbers: HashMap<[u32; 9], u16>,
    matrices: Vec<Mat3>,
    poses: Vec<Transform>,
}

impl Frames {
    /// The number of a frame, whose map must be a matrix alone: 0 for the world.
    ///
    /// # Errors
    /// Where the library has no such transform, or there are too many: what is wrong, and what would do.
    pub fn number(&mut self, frame: &Affine) -> Result<u16, [String; 2]> {
        if *frame == Affine::IDENTITY {
            return Ok(0);
        }
        let column = |column: usize| Vec3::from(frame.linear.map(|row| row[column] as f32));
        let matrix = Mat3::from_cols(column(0), column(1), column(2));
        let bits = matrix.to_cols_array().map(f32::to_bits);
        if let Some(number) = self.numbers.get(&bits) {
            return Ok(*number);
        }
        let pose = Transform::affine(matrix, Vec3::ZERO).map_err(|error| ["a matrix out of range".to_owned(), error.to_string()])?;
        let number = u16::try_from(self.poses.len() + 1)
            .map_err(|_| ["one more turn".to_owned(), "a model may be turned in 65535 ways: leave some out".to_owned()])?;
        self.numbers.insert(bits, number);
        self.matrices.push(matrix);
        self.poses.push(pose);
        Ok(number)
    }

    /// The matrices of which the poses were made: frame 1 first.
    #[must_use]
    pub fn matrices(&self) -> &[Mat3] {
        &self.matrices
    }

    /// The poses, frame 1 first.
    #[must_use]
    pub fn poses(&self) -> &[Transform] {
        &self.poses
    }
}
