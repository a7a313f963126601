//! The steps of a program.

use crate::leaf::Leaf;

/// One step of a program in postfix order: a solid, or an operator on what precedes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Node<L = Leaf> {
    /// A solid.
    Leaf {
        /// The solid, in its frame.
        solid: L,
        /// The frame it is in: 0 is the world, `k` the one posed by the `k`-th transform.
        frame: u16,
    },
    /// What is in either of the two operands before it.
    Union,
    /// What is in both of the two operands before it.
    Intersection,
    /// What is in the first of the two operands before it and not in the second.
    Difference,
    /// What is not in the operand before it.
    Complement,
}

impl<L> Node<L> {
    /// The solid, in the world.
    pub const fn leaf(solid: L) -> Self {
        Self::Leaf { solid, frame: 0 }
    }
}
