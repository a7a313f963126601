//! What makes a list of nodes a program.

use super::node::Node;
use core::fmt;

/// How many operands a program may hold at once. Every program of up to 2^32 leaves can be written within it, by
/// putting the heavier operand of each node first.
pub(super) const MAX_DEPTH: usize = 32;

/// The most leaves a program may have: their numbers must be exact in `f32` lanes.
pub(super) const MAX_LEAVES: usize = 1 << 24;

/// Why a list of nodes is not a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum ProgramError {
    /// There are no nodes.
    Empty,
    /// The operator at this index finds too few operands before it.
    MissingOperand(usize),
    /// The list ends with this many operands, where one solid should be left.
    Unjoined(usize),
    /// The node at this index is the 33rd operand waiting for its operator.
    TooDeep(usize),
    /// There are more than 2^24 leaves.
    TooManyLeaves,
    /// There are this many nodes, where the array has room for that many.
    WrongSize(usize, usize),
    /// Leaves name a frame up to this number, but only so many poses were given.
    MissingPose(u16, usize),
    /// A leaf of the subtree that ends at this index already names a frame.
    PosedTwice(usize),
    /// The operand that ends at this index was to be posed in frame 0, which is the world.
    PosedInWorld(usize),
    /// The scratch memory holds this many spans, where the program has that many leaves.
    ScratchTooShort(usize, usize),
}

impl ProgramError {
    /// What is wrong and what would do, without the numbers: all that a `const` panic can print.
    #[must_use]
    pub const fn message(&self) -> &'static str {
        match self {
            Self::Empty => "a program has no nodes: it needs at least one leaf",
            Self::MissingOperand(_) => "an operator has too few operands before it: operators follow their operands",
            Self::Unjoined(_) => "a program ends with several solids: join them with operators",
            Self::TooDeep(_) => "more than 32 operands wait for their operators: put the heavier operand of each operator first",
            Self::TooManyLeaves => "a program has more than 2^24 leaves: split it",
            Self::WrongSize(..) => "the number of nodes differs from the length of the array",
            Self::MissingPose(..) => "leaves name frames for which no pose was given",
            Self::PosedTwice(_) => "a leaf already names a frame: pose it once",
            Self::PosedInWorld(_) => "frame 0 is the world, which has no pose: use a frame from 1 up",
            Self::ScratchTooShort(..) => "the scratch memory is shorter than the program has leaves",
        }
    }
}

impl fmt::Display for ProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.message())?;
        match *self {
            Self::Empty | Self::TooManyLeaves => Ok(()),
            Self::MissingOperand(node) | Self::TooDeep(node) | Self::PosedTwice(node) | Self::PosedInWorld(node) => {
                write!(f, " (node {node})")
            }
            Self::Unjoined(operands) => write!(f, " ({operands} left)"),
            Self::WrongSize(nodes, room) => write!(f, " ({nodes} nodes, room for {room})"),
            Self::MissingPose(frame, poses) => write!(f, " (frame {frame} of {poses})"),
            Self::ScratchTooShort(spans, leaves) => write!(f, " ({spans} spans, {leaves} leaves)"),
        }
    }
}

impl core::error::Error for ProgramError {}

/// What is known of a list of nodes that is a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Checked {
    pub(super) leaves: usize,
    pub(super) last_frame: u16,
}

/// Runs a program on operand counts alone.
pub(super) const fn check<L>(nodes: &[Node<L>]) -> Result<Checked, ProgramError> {
    if nodes.is_empty() {
        return Err(ProgramError::Empty);
    }
    let mut checked = Checked { leaves: 0, last_frame: 0 };
    let mut operands = 0;
    let mut index = 0;
    while index < nodes.len() {
        match &nodes[index] {
            Node::Leaf { frame, .. } => {
                checked.leaves += 1;
                if checked.last_frame < *frame {
                    checked.last_frame = *frame;
                }
                operands += 1;
                if operands > MAX_DEPTH {
                    return Err(ProgramError::TooDeep(index));
                }
            }
            Node::Complement if operands < 1 => return Err(ProgramError::MissingOperand(index)),
            Node::Complement => {}
            Node::Union | Node::Intersection | Node::Difference if operands < 2 => {
                return Err(ProgramError::MissingOperand(index));
            }
            Node::Union | Node::Intersection | Node::Difference => operands -= 1,
        }
        index += 1;
    }
    if operands != 1 {
        Err(ProgramError::Unjoined(operands))
    } else if checked.leaves > MAX_LEAVES {
        Err(ProgramError::TooManyLeaves)
    } else {
        Ok(checked)
    }
}
