//! A program without the leaves that the rays at hand cannot meet.

use gsdf_nostd::Node;

/// What the rays see of a subtree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Known {
    /// They are outside, all the way.
    Outside,
    /// They are inside, all the way.
    Inside,
    /// It has leaves that they may meet.
    Open,
}

/// An operand that waits for its operator: what is known of it, and where its nodes and its leaves start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Waiting {
    known: Known,
    nodes: usize,
    leaves: usize,
}

/// A reduced program in the making.
#[derive(Debug)]
pub(crate) struct Reduced<'w, L> {
    /// Its nodes, in postfix order.
    pub(crate) nodes: &'w mut Vec<Node<L>>,
    /// The places of its leaves.
    pub(crate) places: &'w mut Vec<u32>,
    pub(crate) waiting: &'w mut Vec<Waiting>,
}

impl<L: Copy> Reduced<'_, L> {
    /// Reduces the program of these nodes to the leaves that are open; of the others it is `known` where the rays are.
    /// `places` are those of all leaves, in order.
    pub(crate) fn reduce(&mut self, nodes: &[Node<L>], places: &[u32], known: &[Known]) -> Known {
        self.nodes.clear();
        self.places.clear();
        self.waiting.clear();
        let mut leaves = places.iter().zip(known);
        for node in nodes {
            match node {
                Node::Leaf { .. } => {
                    let (place, known) = leaves.next().unwrap_or((&0, &Known::Outside));
                    let known = *known;
                    if known == Known::Open {
                        self.places.push(*place);
                    }
                    let leaves = self.places.len() - usize::from(known == Known::Open);
                    self.waiting.push(Waiting {
                        known,
                        nodes: self.nodes.len(),
                        leaves,
                    });
                    if known == Known::Open {
                        self.nodes.push(*node);
                    }
                }
                Node::Complement => {
                    if let Some(operand) = self.waiting.last_mut() {
                        operand.known = operand.known.complement();
                        if operand.known == Known::Open {
                            self.nodes.push(Node::Complement);
                        }
                    }
                }
                Node::Union | Node::Intersection | Node::Difference => {
                    let second = self.waiting.pop().map_or(Known::Outside, |operand| operand.known);
                    if let Some(first) = self.waiting.pop() {
                        self.join(first, node, second);
                    }
                }
            }
        }
        self.waiting.pop().map_or(Known::Outside, |whole| whole.known)
    }

    /// Joins the last two operands, the second of which ends the nodes.
    fn join(&mut self, first: Waiting, operator: &Node<L>, second: Known) {
        use Known::{Inside, Open, Outside};
        let known = match (first.known, operator, second) {
            (Open, _, Open) => {
                self.nodes.push(*operator);
                Open
            }
            (Inside, Node::Union, _) | (_, Node::Union, Inside) => Inside,
            (known, Node::Union, Outside) | (Outside, Node::Union, known) => known,
            (Outside, Node::Intersection, _) | (_, Node::Intersection, Outside) => Outside,
            (known, Node::Intersection, Inside) | (Inside, Node::Intersection, known) => known,
            (Outside, _, _) | (_, _, Inside) => Outside,
            (known, _, Outside) => known,
            (Inside, _, Open) => {
                self.nodes.push(Node::Complement);
                Open
            }
        };
        if known != Open {
            self.nodes.truncate(first.nodes);
            self.places.truncate(first.leaves);
        }
        self.waiting.push(Waiting { known, ..first });
    }
}

impl Known {
    pub(crate) fn complement(self) -> Self {
        match self {
            Self::Outside => Self::Inside,
            Self::Inside => Self::Outside,
            Self::Open => Self::Open,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Known, Reduced};
    use glam::Vec3;
    use gsdf_nostd::{Leaf, Node, Sphere};

    fn reduced(nodes: &[Node], live: &[bool]) -> (Known, Vec<Node>, Vec<u32>) {
        let known = live.iter().map(|&live| if live { Known::Open } else { Known::Outside });
        reduced_to(nodes, &known.collect::<Vec<_>>())
    }

    fn reduced_to(nodes: &[Node], leaves: &[Known]) -> (Known, Vec<Node>, Vec<u32>) {
        let (mut made, mut places, mut waiting) = (Vec::new(), Vec::new(), Vec::new());
        let known = Reduced {
            nodes: &mut made,
            places: &mut places,
            waiting: &mut waiting,
        }
        .reduce(nodes, &[0, 1, 2], leaves);
        (known, made, places)
    }

    fn leaf(radius: f32) -> Node {
        Node::leaf(Leaf::Sphere(Sphere::new(Vec3::ZERO, radius).unwrap()))
    }

    #[test]
    fn dead_leaves_vanish_with_the_operators_they_decide() {
        let [a, b, c] = [leaf(1.0), leaf(2.0), leaf(3.0)];
        // (a + b) - c
        let nodes = [a, b, Node::Union, c, Node::Difference];
        assert_eq!(reduced(&nodes, &[true; 3]), (Known::Open, nodes.to_vec(), vec![0, 1, 2]));
        assert_eq!(
            reduced(&nodes, &[true, false, true]),
            (Known::Open, vec![a, c, Node::Difference], vec![0, 2])
        );
        assert_eq!(reduced(&nodes, &[false, true, false]), (Known::Open, vec![b], vec![1]));
        assert_eq!(reduced(&nodes, &[false, false, true]), (Known::Outside, vec![], vec![]));
        // a & not (b - c)
        let nodes = [a, b, c, Node::Difference, Node::Complement, Node::Intersection];
        assert_eq!(reduced(&nodes, &[true, false, true]), (Known::Open, vec![a], vec![0]));
        assert_eq!(reduced(&nodes, &[false, true, true]), (Known::Outside, vec![], vec![]));
        // not a - b, not (a - b), and their sum with everything.
        let nodes = [a, Node::Complement, b, Node::Difference, c, Node::Union];
        assert_eq!(
            reduced(&nodes, &[false, true, true]),
            (Known::Open, vec![b, Node::Complement, c, Node::Union], vec![1, 2])
        );
        assert_eq!(reduced(&nodes, &[false, false, true]), (Known::Inside, vec![], vec![]));
        assert_eq!(
            reduced(&nodes, &[true, false, false]),
            (Known::Open, vec![a, Node::Complement], vec![0])
        );
    }

    /// Every program of three leaves and two operators, with complements anywhere, under every choice of what is known of
    /// the leaves: what is left of it has the membership of the whole.
    #[test]
    fn membership_stays() {
        let operators = [Node::Union, Node::Intersection, Node::Difference];
        for choice in 0..9 * 32 * 27_usize {
            let (first, second) = (operators[choice % 3], operators[choice / 3 % 3]);
            let (turned, known) = (choice / 9 % 32, choice / 9 / 32);
            let mut nodes = Vec::new();
            for (turn, node) in [leaf(1.0), leaf(2.0), first, leaf(3.0), second].into_iter().enumerate() {
                nodes.push(node);
                if turned >> turn & 1 == 1 {
                    nodes.push(Node::Complement);
                }
            }
            let leaves = [known % 3, known / 3 % 3, known / 9].map(|known| [Known::Outside, Known::Inside, Known::Open][known]);
            let (known, made, places) = reduced_to(&nodes, &leaves);
            for inside in 0..8_usize {
                let within = |leaf: usize| match leaves[leaf] {
                    Known::Open => inside >> leaf & 1 == 1,
                    known => known == Known::Inside,
                };
                let expected = member(&nodes, &[within(0), within(1), within(2)]);
                let found = match known {
                    Known::Open => member(&made, &places.iter().map(|&place| within(place as usize)).collect::<Vec<_>>()),
                    known => known == Known::Inside,
                };
                assert_eq!(found, expected, "{nodes:?} with {leaves:?}");
            }
        }
    }

    fn member(nodes: &[Node], inside: &[bool]) -> bool {
        let mut leaves = inside.iter();
        let mut stack: Vec<bool> = Vec::new();
        for node in nodes {
            let made = match node {
                Node::Leaf { .. } => *leaves.next().unwrap(),
                Node::Complement => !stack.pop().unwrap(),
                binary => {
                    let (second, first) = (stack.pop().unwrap(), stack.pop().unwrap());
                    match binary {
                        Node::Union => first | second,
                        Node::Intersection => first & second,
                        _ => first & !second,
                    }
                }
            };
            stack.push(made);
        }
        stack.pop().unwrap()
    }
}
