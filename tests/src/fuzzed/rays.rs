//! Rays and ranges from raw bits: refused for what is wrong with them, or answered, with the same bits one by one and
//! eight at a time.

use super::Tally;
use super::raw::Raw;
use super::solids::shape;
use crate::conformance::packet::{self, Asked};
use glam::Vec3;
use gsdf_nostd::{MAX_LENGTH, MAX_SPEED, Node, Program, Ray, Sphere, Transform};

/// Up to four solids in two frames.
fn program(raw: &mut Raw<'_>, tally: &mut Tally) -> (Vec<Node>, [Transform; 1]) {
    let (matrix, translation) = raw.affine();
    let pose = tally.accept_named(Transform::affine(matrix, translation));
    let mut nodes = vec![Node::leaf(
        Sphere::new(Vec3::ONE, 2.0).unwrap_or_else(|error| panic!("{error}")).into(),
    )];
    for _ in 0..raw.below(4) {
        if let Some(solid) = tally.accept_named(shape(raw).leaf()) {
            let frame = u16::from(raw.below(2));
            nodes.push(Node::Leaf { solid, frame });
            if raw.below(4) == 0 {
                nodes.push(Node::Complement);
            }
            nodes.push([Node::Union, Node::Union, Node::Intersection, Node::Difference][usize::from(raw.below(4))]);
        }
    }
    (nodes, [pose.unwrap_or(Transform::IDENTITY)])
}

/// Eight numbers of rays: each by its own bits, near the one before, or as solids have theirs.
fn asked(raw: &mut Raw<'_>) -> [Asked; 8] {
    let mut last = Asked::new(Vec3::ZERO, Vec3::X);
    core::array::from_fn(|_| {
        last = match raw.below(4) {
            0 => Asked {
                origin: Vec3::new(raw.bits(), raw.bits(), raw.bits()),
                direction: Vec3::new(raw.bits(), raw.bits(), raw.bits()),
                range: raw.bits()..raw.bits(),
            },
            1 => Asked {
                direction: raw.vector(),
                ..last.clone()
            },
            _ => Asked {
                origin: raw.vector(),
                direction: raw.vector(),
                range: raw.range(),
            },
        };
        last.clone()
    })
}

/// Whether a ray is refused is a matter of its numbers; its answers are the same alone and in a packet.
#[must_use]
pub fn rays(bytes: &[u8]) -> Tally {
    let (mut raw, mut tally) = (Raw::new(bytes), Tally::default());
    let (nodes, poses) = program(&mut raw, &mut tally);
    let program = Program::new(&nodes)
        .and_then(|program| program.posed(&poses))
        .unwrap_or_else(|error| panic!("{error}"));
    while {
        let asked = asked(&mut raw);
        for asked in &asked {
            let largest = asked.direction.abs().max_element();
            let is_ray = asked.origin.is_finite()
                && asked.direction.is_finite()
                && asked.origin.abs().max_element() <= MAX_LENGTH
                && (1.0 / MAX_SPEED..=MAX_SPEED).contains(&largest);
            let made = Ray::new(asked.origin, asked.direction);
            assert_eq!(made.is_ok(), is_ray, "{made:?} of {asked:?}");
            if let Some(ray) = tally.accept(made) {
                let range = asked.range.clone();
                let is_range = range.start >= 0.0 && range.start < range.end;
                let ranged = ray.within(range);
                assert_eq!(ranged.is_ok(), is_range, "{ranged:?} of {asked:?}");
                tally.accept(ranged);
            }
        }
        let count = packet::check(&program, &asked);
        tally.answered += (count.hits + count.misses) as u64;
        tally.met += count.hits as u64;
        tally.inside += count.inside as u64;
        !raw.is_empty()
    } {}
    tally
}
