//! Programs in postfix order: owned arrays and borrowed slices.

use super::check::{Checked, ProgramError, check};
use super::node::Node;
use crate::leaf::Leaf;
use crate::transform::Transform;

/// A CSG program of `N` nodes with leaves of type `L`, checked when it is made, fit to lie in flash.
///
/// Written by [`csg!`](crate::csg!) at compile time, or by a [`Draft`](super::Draft) at run time. Its leaves are
/// numbered from 0 in the order in which they stand; where surfaces coincide, the lowest number wins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Csg<const N: usize, L = Leaf> {
    nodes: [Node<L>; N],
    checked: Checked,
}

impl<const N: usize, L> Csg<N, L> {
    /// The most sweeps over the program that any ray can take to its first crossing: one per distinct leaf root and
    /// one to confirm. (Of `N` nodes at most `(N + 1) / 2` are leaves joined by binary operators, with two roots
    /// each.)
    pub const MAX_SWEEPS: usize = N + 2;

    /// The program of these nodes, in postfix order.
    ///
    /// # Errors
    /// Where an operator lacks operands, operands are left over, or more than 32 wait at once.
    pub const fn new(nodes: [Node<L>; N]) -> Result<Self, ProgramError>
    where
        L: Copy,
    {
        match check(&nodes) {
            Ok(checked) => Ok(Self { nodes, checked }),
            Err(error) => Err(error),
        }
    }

    /// The program of nodes that are known to make one: leaves in the world and binary operators on them.
    pub(crate) const fn from_binary(nodes: [Node<L>; N]) -> Self {
        let checked = Checked {
            leaves: N.div_ceil(2),
            last_frame: 0,
        };
        Self { nodes, checked }
    }

    /// The nodes, in postfix order.
    #[must_use]
    pub const fn nodes(&self) -> &[Node<L>] {
        &self.nodes
    }

    /// The number of leaves.
    #[must_use]
    pub const fn leaves(&self) -> usize {
        self.checked.leaves
    }

    /// The program as a slice, which all longer programs are too.
    #[must_use]
    pub const fn program(&self) -> Program<'_, L> {
        Program {
            nodes: &self.nodes,
            poses: &[],
            checked: self.checked,
        }
    }
}

/// A program of any length, borrowed, with the poses of its frames.
///
/// A frame without a pose is at rest: its solids stand in the world as they are.
#[derive(Debug)]
pub struct Program<'a, L = Leaf> {
    pub(super) nodes: &'a [Node<L>],
    pub(super) poses: &'a [Transform],
    checked: Checked,
}

impl<L> Clone for Program<'_, L> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<L> Copy for Program<'_, L> {}

impl<'a, L> Program<'a, L> {
    /// The program of these nodes, in postfix order.
    ///
    /// # Errors
    /// Where an operator lacks operands, operands are left over, or more than 32 wait at once.
    pub const fn new(nodes: &'a [Node<L>]) -> Result<Self, ProgramError> {
        match check(nodes) {
            Ok(checked) => Ok(Self {
                nodes,
                poses: &[],
                checked,
            }),
            Err(error) => Err(error),
        }
    }

    /// The same program with its frames posed: frame `k` by `poses[k - 1]`.
    ///
    /// # Errors
    /// Where a leaf names a frame beyond the poses.
    pub const fn posed(self, poses: &'a [Transform]) -> Result<Self, ProgramError> {
        if self.checked.last_frame as usize <= poses.len() {
            Ok(Self { poses, ..self })
        } else {
            Err(ProgramError::MissingPose(self.checked.last_frame, poses.len()))
        }
    }

    /// The nodes, in postfix order.
    #[must_use]
    pub const fn nodes(&self) -> &'a [Node<L>] {
        self.nodes
    }

    /// The poses of its frames, that of frame 1 first.
    #[must_use]
    pub const fn poses(&self) -> &'a [Transform] {
        self.poses
    }

    /// The number of leaves, and of spans its scratch memory must hold.
    #[must_use]
    pub const fn leaves(&self) -> usize {
        self.checked.leaves
    }

    /// The most sweeps over the program that any ray can take to its first crossing: one per distinct leaf root and
    /// one to confirm.
    #[must_use]
    pub const fn max_sweeps(&self) -> usize {
        2 * self.checked.leaves + 1
    }

    /// The pose of a frame, `None` for one at rest.
    #[inline(always)]
    #[must_use]
    pub fn pose(&self, frame: u16) -> Option<&'a Transform> {
        usize::from(frame).checked_sub(1).and_then(|index| self.poses.get(index))
    }
}
