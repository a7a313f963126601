//! Programs in the making.

use super::check::ProgramError;
use super::node::Node;
use super::program::Csg;
use crate::leaf::Leaf;

/// A program of `N` nodes being written, solid by solid and operator by operator, in `const` or at run time.
///
/// Mistakes are kept and reported by [`finish`](Draft::finish), so that the steps can be chained.
/// [`csg!`](crate::csg!) writes such a chain from a nested expression and counts the nodes.
///
/// ```
/// use gsdf_nostd::{Csg, Draft, Leaf, Node, Sphere};
/// use glam::{Vec3, vec3};
///
/// # fn main() -> Result<(), Box<dyn core::error::Error>> {
/// let radius = 1.5; // known at run time only
/// let ball = Leaf::from(Sphere::new(Vec3::ZERO, radius)?);
/// let bite = Leaf::from(Sphere::new(vec3(0.0, 0.0, radius), 1.0)?);
/// let apple: Csg<3> = Draft::new().leaf(ball).leaf(bite).operator(Node::Difference).finish()?;
/// assert_eq!(apple.gsdf(vec3(0.0, 0.0, 9.0), Vec3::NEG_Z), 8.5);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Draft<const N: usize, L = Leaf> {
    nodes: [Node<L>; N],
    length: usize,
    error: Option<ProgramError>,
}

impl<const N: usize, L: Copy> Default for Draft<N, L> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const N: usize, L: Copy> Draft<N, L> {
    /// Nothing yet.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            // Any node will do: `finish` lets none of these through.
            nodes: [Node::Union; N],
            length: 0,
            error: None,
        }
    }

    /// Appends a solid, in the world.
    #[must_use]
    pub const fn leaf(self, solid: L) -> Self {
        self.node(Node::leaf(solid))
    }

    /// Appends an operator on the last one or two operands; or any other node.
    #[must_use]
    pub const fn operator(self, operator: Node<L>) -> Self {
        self.node(operator)
    }

    /// Appends all of another program, as one operand.
    #[must_use]
    pub const fn program(self, nodes: &[Node<L>]) -> Self {
        let mut draft = self;
        let mut index = 0;
        while index < nodes.len() {
            draft = draft.node(nodes[index]);
            index += 1;
        }
        draft
    }

    /// Puts all leaves of the last operand into `frame`, to be posed at run time.
    #[must_use]
    pub const fn posed(self, frame: u16) -> Self {
        let mut draft = self;
        if draft.length == 0 {
            draft.error = Some(ProgramError::MissingOperand(0));
            return draft;
        }
        if frame == 0 {
            draft.error = Some(ProgramError::PosedInWorld(draft.length - 1));
            return draft;
        }
        // Walks back over the last operand: an operator asks for what precedes it, a leaf gives.
        let mut wanted = 1_u32;
        let mut index = draft.length;
        while wanted > 0_u32 && index > 0 && index <= N {
            index -= 1;
            match draft.nodes[index] {
                Node::Leaf { solid, frame: 0 } => {
                    draft.nodes[index] = Node::Leaf { solid, frame };
                    wanted -= 1;
                }
                Node::Leaf { .. } => {
                    draft.error = Some(ProgramError::PosedTwice(draft.length - 1));
                    wanted -= 1;
                }
                Node::Complement => {}
                Node::Union | Node::Intersection | Node::Difference => wanted += 1,
            }
        }
        draft
    }

    const fn node(self, node: Node<L>) -> Self {
        let mut draft = self;
        if draft.length < N {
            draft.nodes[draft.length] = node;
        }
        draft.length += 1;
        draft
    }

    /// The program.
    ///
    /// # Errors
    /// Where there are not exactly `N` nodes, they do not make one solid, or a leaf was posed twice.
    pub const fn finish(self) -> Result<Csg<N, L>, ProgramError> {
        if self.length != N {
            return Err(ProgramError::WrongSize(self.length, N));
        }
        match self.error {
            Some(error) => Err(error),
            None => Csg::new(self.nodes),
        }
    }
}
