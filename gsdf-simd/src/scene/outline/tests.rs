//! What outlines leave of programs, beside a walk over all nodes and the crossings of the whole.

use super::{Outline, Remainder};
use crate::scene::reduce::{Known, Reduced};
use glam::Vec3;
use gsdf_nostd::{Leaf, Node, Program, Span, Sphere, attribute, march};

fn leaf(radius: f32) -> Node {
    Node::leaf(Leaf::Sphere(Sphere::new(Vec3::ZERO, radius).unwrap()))
}

fn reduced(nodes: &[Node], known: &[Known]) -> (Known, Vec<Node>, Vec<u32>) {
    let (mut made, mut leaves, mut open) = (Vec::new(), Vec::new(), Vec::new());
    let own: Vec<Node> = nodes.iter().filter(|node| matches!(node, Node::Leaf { .. })).copied().collect();
    let marked: Vec<(u32, Known)> = (0..)
        .zip(known.iter().copied())
        .filter(|(_, known)| *known != Known::Outside)
        .collect();
    let mut remainder = Remainder {
        nodes: &mut made,
        leaves: &mut leaves,
        open: &mut open,
    };
    let found = Outline::new(nodes)
        .unwrap()
        .reduce(&marked, &mut remainder, |number| own.get(number as usize).copied());
    (found, made, leaves)
}

/// Numbers that look random: D. Knuth's generator.
struct Choices(u64);

impl Choices {
    fn choose(&mut self, count: u64) -> u64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % count
    }
}

/// A program of so many leaves.
fn any_program(leaves: u32, choices: &mut Choices) -> Vec<Node> {
    let (mut nodes, mut waiting, mut made) = (Vec::new(), 0, 0);
    while made < leaves || waiting > 1 {
        if made < leaves && (waiting < 2 || choices.choose(2) == 0) {
            nodes.push(leaf(1.0 + made as f32));
            made += 1;
            waiting += 1;
        } else {
            nodes.push([Node::Union, Node::Intersection, Node::Difference][choices.choose(3) as usize]);
            waiting -= 1;
        }
        if choices.choose(5) == 0 {
            nodes.push(Node::Complement);
        }
    }
    nodes
}

fn any_known(choices: &mut Choices) -> Known {
    [Known::Outside, Known::Open, Known::Inside, Known::Open][choices.choose(4) as usize]
}

fn member(nodes: &[Node], mut inside: impl Iterator<Item = bool>) -> bool {
    let mut stack: Vec<bool> = Vec::new();
    for node in nodes {
        let made = match node {
            Node::Leaf { .. } => inside.next().unwrap(),
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

/// Whatever the program and whatever is known of its leaves: what is left is a program with the membership of the whole
/// and its leaves in order, and nothing is left that a walk over all nodes leaves out.
#[test]
fn what_is_left_has_the_membership_of_the_whole() {
    let (mut left, mut settled) = (0, 0);
    let mut choices = Choices(1);
    for leaves in (1..8).cycle().take(20_000) {
        let nodes = any_program(leaves, &mut choices);
        let places: Vec<u32> = (0..leaves).collect();
        let known: Vec<Known> = (0..leaves).map(|_| any_known(&mut choices)).collect();
        let (found, made, numbers) = reduced(&nodes, &known);
        let (mut by_nodes, mut by_places, mut waiting) = (Vec::new(), Vec::new(), Vec::new());
        let by_walk = Reduced {
            nodes: &mut by_nodes,
            places: &mut by_places,
            waiting: &mut waiting,
        }
        .reduce(&nodes, &places, &known);
        assert_eq!((found, &numbers), (by_walk, &by_places), "{nodes:?} with {known:?}");
        if found != Known::Open {
            assert!(made.is_empty() && numbers.is_empty());
            settled += 1;
            continue;
        }
        left += 1;
        assert!(numbers.is_sorted());
        assert_eq!(Program::new(&made).unwrap().leaves(), numbers.len());
        for inside in 0..1_u32 << leaves {
            let within = |leaf: u32| match known[leaf as usize] {
                Known::Open => inside >> leaf & 1 == 1,
                known => known == Known::Inside,
            };
            let expected = member(&nodes, (0..leaves).map(within));
            assert_eq!(
                member(&made, numbers.iter().map(|leaf| within(*leaf))),
                expected,
                "{nodes:?} with {known:?}"
            );
        }
    }
    assert!(left > 3000 && settled > 3000, "{left} left, {settled} settled");
}

/// The crossings of a program: their parameters and leaves.
fn crossings(nodes: &[Node], spans: &[Span<f32>], leaf: impl Fn(f32) -> u32) -> Vec<(u32, u32)> {
    let (mut t, mut found) = (0.5, Vec::new());
    loop {
        t = march(nodes, spans, t).t;
        if t == f32::INFINITY {
            return found;
        }
        found.push((t.to_bits(), leaf(attribute(nodes, spans, t).leaf)));
    }
}

/// However many solids touch and coincide, crossings stay where they are, and are those of the same leaves.
#[test]
fn crossings_and_their_leaves_stay() {
    let (mut choices, mut crossed) = (Choices(2), 0);
    for leaves in (1..10).cycle().take(20_000) {
        let nodes = any_program(leaves, &mut choices);
        let known: Vec<Known> = (0..leaves).map(|_| any_known(&mut choices)).collect();
        let (found, made, numbers) = reduced(&nodes, &known);
        let mut span = |known: &Known| {
            let (enter, exit) = match known {
                Known::Outside => (f32::INFINITY, f32::NEG_INFINITY),
                Known::Inside => (f32::NEG_INFINITY, f32::INFINITY),
                Known::Open => {
                    let enter = choices.choose(6) as f32;
                    (enter, enter + choices.choose(5) as f32)
                }
            };
            Span { enter, exit }
        };
        let spans: Vec<Span<f32>> = known.iter().map(&mut span).collect();
        let whole = crossings(&nodes, &spans, |leaf| leaf as u32);
        if found != Known::Open {
            assert_eq!(whole, []);
            continue;
        }
        let own: Vec<Span<f32>> = numbers.iter().map(|leaf| spans[*leaf as usize]).collect();
        let left = crossings(&made, &own, |leaf| numbers[leaf as usize]);
        assert_eq!(left, whole, "{nodes:?} along {spans:?}");
        crossed += whole.len();
    }
    assert!(crossed > 5000, "{crossed}");
}

#[test]
fn long_unions_are_one_joint_however_they_lean() {
    let leaves = 1000_u32;
    let mut chain = vec![leaf(1.0)];
    let mut balanced = vec![Vec::from([leaf(1.0)]); 1024];
    for _ in 1..leaves {
        chain.extend([leaf(1.0), Node::Union]);
    }
    while balanced.len() > 1 {
        let pairs = balanced.chunks(2);
        balanced = pairs.map(|pair| [&pair[0][..], &pair[1][..], &[Node::Union]].concat()).collect();
    }
    for nodes in [chain, balanced.remove(0)] {
        let cut = [&nodes[..], &[leaf(2.0), Node::Difference, leaf(3.0), Node::Difference]].concat();
        let outline = Outline::new(&cut).unwrap();
        let used = outline.joints.iter().filter(|joint| !joint.operands.is_empty()).count();
        assert_eq!(used, 2);
    }
}
