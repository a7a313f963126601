//! The solids of a model as a program in postfix order, in which few operands wait at once.

use super::evaluate::{Colored, Operator, Shape};
use gsdf_nostd::Node;

/// The nodes of a solid, and its leaves in the order in which they are numbered.
#[must_use]
pub fn postfix(shapes: &[Shape], root: usize) -> (Vec<Node>, Vec<Colored>) {
    let waiting = waiting(shapes);
    let heavy = |solid: &usize| waiting.get(*solid).copied().unwrap_or(1);
    let (mut nodes, mut leaves) = (Vec::new(), Vec::new());
    let mut steps = vec![Step::Solid(root)];
    while let Some(step) = steps.pop() {
        let solid = match step {
            Step::Operator(operator) => {
                nodes.push(operator);
                continue;
            }
            Step::Solid(solid) => solid,
        };
        match shapes.get(solid) {
            None => {}
            Some(Shape::Leaf(leaf)) => {
                let piece = leaf.piece;
                nodes.push(Node::Leaf {
                    solid: piece.solid,
                    frame: piece.frame,
                });
                leaves.push(*leaf);
            }
            Some(Shape::Joined(operator, operands)) => {
                let first = steps.len();
                steps.extend(chain(*operator, operands, &heavy));
                // The last step is the first one to be taken.
                if let Some(added) = steps.get_mut(first..) {
                    added.reverse();
                }
            }
        }
    }
    (nodes, leaves)
}

#[derive(Clone, Copy)]
enum Step {
    Solid(usize),
    Operator(Node),
}

/// The operands one after the other, each joined as soon as it is there: the heaviest first, so that only one operand waits
/// for the others, and the others in their order.
fn chain(operator: Operator, operands: &[usize], heavy: &impl Fn(&usize) -> u32) -> Vec<Step> {
    let heaviest = heaviest(operands, heavy);
    let mut steps = Vec::with_capacity(2 * operands.len() + 1);
    let others = |skipped: usize| operands.iter().enumerate().filter(move |(place, _)| *place != skipped).map(|(_, solid)| *solid);
    let node = match operator {
        Operator::Union => Node::Union,
        Operator::Intersection => Node::Intersection,
        Operator::Difference => Node::Difference,
    };
    let Some(first) = operands.get(heaviest) else { return steps };
    steps.push(Step::Solid(*first));
    if operator == Operator::Difference && heaviest != 0 {
        // What is cut away is heavier than what it is cut from: a - b is not b and a.
        steps.push(Step::Operator(Node::Complement));
        for (place, solid) in others(heaviest).enumerate() {
            let joined = if place == 0 { Node::Intersection } else { Node::Difference };
            steps.extend([Step::Solid(solid), Step::Operator(joined)]);
        }
    } else {
        steps.extend(others(heaviest).flat_map(|solid| [Step::Solid(solid), Step::Operator(node)]));
    }
    steps
}

/// The place of the first of the operands that need most operands to wait.
fn heaviest(operands: &[usize], heavy: &impl Fn(&usize) -> u32) -> usize {
    let mut heaviest = 0;
    for (place, operand) in operands.iter().enumerate() {
        if operands.get(heaviest).is_none_or(|most| heavy(operand) > heavy(most)) {
            heaviest = place;
        }
    }
    heaviest
}

/// For each solid, how many operands wait at most while it is computed.
fn waiting(shapes: &[Shape]) -> Vec<u32> {
    let mut waiting: Vec<u32> = Vec::with_capacity(shapes.len());
    for shape in shapes {
        let most = match shape {
            Shape::Leaf(_) => 1,
            Shape::Joined(_, operands) => {
                let of = |operand: &usize| waiting.get(*operand).copied().unwrap_or(1);
                let first = heaviest(operands, &of);
                let of_place = |(place, operand): (usize, &usize)| of(operand) + u32::from(place != first);
                operands.iter().enumerate().map(of_place).max().unwrap_or(1)
            }
        };
        waiting.push(most);
    }
    waiting
}

/// How many operands wait at most while a program runs.
#[must_use]
pub fn stack_depth(nodes: &[Node]) -> usize {
    let (mut depth, mut most) = (0_usize, 0);
    for node in nodes {
        match node {
            Node::Leaf { .. } => depth += 1,
            Node::Complement => {}
            Node::Union | Node::Intersection | Node::Difference => depth = depth.saturating_sub(1),
        }
        most = most.max(depth);
    }
    most
}
