//! A program taken apart: at its unions into parts, and each part into what must be inside and what must not.

use core::ops::Range;
use gsdf_nostd::Node;

/// A range of nodes that make a solid, with the numbers of its leaves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Subtree {
    pub(crate) nodes: Range<usize>,
    pub(crate) leaves: Range<usize>,
}

/// Where the subtree that ends at each node starts.
pub(crate) struct Starts {
    starts: Vec<Start>,
}

#[derive(Clone, Copy)]
struct Start {
    node: u32,
    leaf: u32,
}

impl Starts {
    /// Runs a program, which must be a valid one, on the places of its operands alone.
    pub(crate) fn of<L>(nodes: &[Node<L>]) -> Self {
        let mut waiting: Vec<Start> = Vec::new();
        let mut leaf = 0;
        let starts = (0..)
            .zip(nodes)
            .map(|(node, made)| {
                match made {
                    Node::Leaf { .. } => {
                        waiting.push(Start { node, leaf });
                        leaf += 1;
                    }
                    Node::Complement => {}
                    Node::Union | Node::Intersection | Node::Difference => {
                        waiting.pop();
                    }
                }
                waiting.last().copied().unwrap_or(Start { node, leaf: 0 })
            })
            .collect();
        Self { starts }
    }

    /// Of each leaf of a whole program, whether the program lies on the outer side of its surface: whether it is under an
    /// odd number of complements and subtrahends.
    pub(crate) fn negative<L>(&self, nodes: &[Node<L>]) -> Vec<bool> {
        let mut negative = vec![false; nodes.len()];
        let mut leaves = Vec::new();
        for (root, node) in nodes.iter().enumerate().rev() {
            let here = negative.get(root).copied().unwrap_or(false);
            if let Node::Leaf { .. } = node {
                leaves.push(here);
                continue;
            }
            let turned = matches!(node, Node::Complement | Node::Difference);
            let second = root.wrapping_sub(1);
            if let Some(place) = negative.get_mut(second) {
                *place = here != turned;
            }
            // The first operand ends before the second starts; a complement has none.
            let start = self.starts.get(second).filter(|_| !matches!(node, Node::Complement));
            let first = start.and_then(|start| negative.get_mut((start.node as usize).wrapping_sub(1)));
            if let Some(place) = first {
                *place = here;
            }
        }
        leaves.reverse();
        leaves
    }

    /// The two operands of the binary operator that ends a subtree.
    fn operands(&self, whole: &Subtree) -> Option<[Subtree; 2]> {
        let root = whole.nodes.end.checked_sub(1)?;
        let second = self.starts.get(root.checked_sub(1)?)?;
        let (node, leaf) = (second.node as usize, second.leaf as usize);
        let first = Subtree {
            nodes: whole.nodes.start..node,
            leaves: whole.leaves.start..leaf,
        };
        let second = Subtree {
            nodes: node..root,
            leaves: leaf..whole.leaves.end,
        };
        Some([first, second])
    }
}

/// The operands of the unions at the top of a program, in order: the parts of which it is the sum.
pub(crate) fn parts<L>(nodes: &[Node<L>], starts: &Starts, whole: Subtree) -> Vec<Subtree> {
    let mut parts = Vec::new();
    let mut waiting = vec![whole];
    while let Some(subtree) = waiting.pop() {
        let operands = match nodes.get(subtree.nodes.end.wrapping_sub(1)) {
            Some(Node::Union) => starts.operands(&subtree),
            _ => None,
        };
        match operands {
            Some([first, second]) => waiting.extend([second, first]),
            None => parts.push(subtree),
        }
    }
    parts
}

/// A leaf of a product: what a point of the product is inside of, or outside of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Factor {
    /// The index of its node.
    pub(crate) node: usize,
    /// The number of the leaf.
    pub(crate) leaf: usize,
    /// Whether it is the outside that counts.
    pub(crate) negative: bool,
}

/// A part as a product: the leaves of which its points are inside, and those of which they are outside. `None` where it
/// is no product.
pub(crate) fn product<L>(nodes: &[Node<L>], starts: &Starts, part: &Subtree) -> Option<Vec<Factor>> {
    let mut factors = Vec::new();
    let mut waiting = vec![(part.clone(), false)];
    while let Some((subtree, negative)) = waiting.pop() {
        let root = subtree.nodes.end.checked_sub(1)?;
        match (nodes.get(root)?, negative) {
            (Node::Leaf { .. }, _) => factors.push(Factor {
                node: root,
                leaf: subtree.leaves.start,
                negative,
            }),
            (Node::Complement, _) => {
                let nodes = subtree.nodes.start..root;
                waiting.push((Subtree { nodes, ..subtree }, !negative));
            }
            (Node::Intersection, false) | (Node::Union, true) => {
                let [first, second] = starts.operands(&subtree)?;
                waiting.extend([(second, negative), (first, negative)]);
            }
            (Node::Difference, false) => {
                let [first, second] = starts.operands(&subtree)?;
                waiting.extend([(second, true), (first, false)]);
            }
            (Node::Intersection | Node::Difference, true) | (Node::Union, false) => return None,
        }
    }
    Some(factors)
}

#[cfg(test)]
mod tests {
    use super::{Factor, Starts, Subtree, parts, product};
    use glam::Vec3;
    use gsdf_nostd::{Leaf, Node, Sphere};

    fn leaf() -> Node {
        Node::leaf(Leaf::Sphere(Sphere::new(Vec3::ZERO, 1.0).unwrap()))
    }

    fn whole(nodes: &[Node]) -> Subtree {
        let leaves = nodes.iter().filter(|node| matches!(node, Node::Leaf { .. })).count();
        Subtree {
            nodes: 0..nodes.len(),
            leaves: 0..leaves,
        }
    }

    #[test]
    fn unions_at_the_top_are_taken_apart_and_no_others() {
        // (a + b) + ((c + d) & e)
        let nodes = [
            leaf(),
            leaf(),
            Node::Union,
            leaf(),
            leaf(),
            Node::Union,
            leaf(),
            Node::Intersection,
            Node::Union,
        ];
        let found = parts(&nodes, &Starts::of(&nodes), whole(&nodes));
        let expected = [(0..1, 0..1), (1..2, 1..2), (3..8, 2..5)].map(|(nodes, leaves)| Subtree { nodes, leaves });
        assert_eq!(found, expected);
    }

    #[test]
    fn products_are_found_through_complements() {
        // a - not(not b - ...) is none; (a & not (b + not c)) - d is one: a, not b, c, not d.
        let nodes = [
            leaf(),
            leaf(),
            leaf(),
            Node::Complement,
            Node::Union,
            Node::Complement,
            Node::Intersection,
            leaf(),
            Node::Difference,
        ];
        let found = product(&nodes, &Starts::of(&nodes), &whole(&nodes)).unwrap();
        let expected =
            [(0, 0, false), (1, 1, true), (2, 2, false), (7, 3, true)].map(|(node, leaf, negative)| Factor { node, leaf, negative });
        assert_eq!(found, expected);

        let union_within = [leaf(), leaf(), leaf(), Node::Union, Node::Intersection];
        assert_eq!(product(&union_within, &Starts::of(&union_within), &whole(&union_within)), None);
        let difference_without = [leaf(), leaf(), leaf(), Node::Difference, Node::Difference];
        assert_eq!(
            product(&difference_without, &Starts::of(&difference_without), &whole(&difference_without)),
            None
        );
    }
}
