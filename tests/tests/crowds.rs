//! Programs of many parts, near to each other and far apart, for tiles to take apart.

use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCylinder, Cone, Cuboid, Cylinder, HalfSpace, Leaf, Node, Sphere};
use gsdf_tests::shape::unit;
use rand::RngExt;
use rand_pcg::Pcg64;

/// A number on a coarse grid, so that surfaces meet and coincide.
pub(crate) fn coarse(rng: &mut Pcg64, reach: i32) -> f32 {
    rng.random_range(-2 * reach..=2 * reach) as f32 * 0.5
}

fn solid(rng: &mut Pcg64, at: Vec3) -> Leaf {
    let size = rng.random_range(1..=3) as f32 * 0.5;
    match rng.random_range(0..20) {
        0..6 => Sphere::new(at, size).unwrap().into(),
        6..12 => Cuboid::new(at, at + Vec3::splat(size)).unwrap().into(),
        12..16 => {
            let axis = [Vec3::X, Vec3::Y, Vec3::Z][rng.random_range(0..3)];
            CappedCylinder::new(at - axis * size, at + axis * size, axis, 0.5 * size)
                .unwrap()
                .into()
        }
        16..18 => Cone::new(at + Vec3::Y * size, at - Vec3::Y * size, Vec3::NEG_Y, size)
            .unwrap()
            .into(),
        18 => HalfSpace::new(at, unit(rng).as_vec3()).unwrap().into(),
        _ => Cylinder::new(at, Vec3::Z, 0.25 * size).unwrap().into(),
    }
}

/// A scene of many parts on a grid: single solids, products, and what is neither; some in a frame of their own.
pub(crate) fn scattered(rng: &mut Pcg64, parts: usize, reach: i32) -> Vec<Node> {
    let mut nodes = Vec::new();
    let mut earlier = Vec::new();
    for _ in 0..parts {
        let at = vec3(coarse(rng, reach), coarse(rng, reach), coarse(rng, reach));
        let frame = if rng.random_range(0..4) == 0 { rng.random_range(1..=2) } else { 0 };
        let leaf = |rng: &mut Pcg64, earlier: &mut Vec<Leaf>| {
            let near = at + vec3(coarse(rng, 1), coarse(rng, 1), coarse(rng, 1));
            // Every so often one that is there already.
            let solid = match earlier.get(rng.random_range(0..4 * earlier.len().max(1))) {
                Some(solid) => *solid,
                None => solid(rng, near),
            };
            earlier.push(solid);
            Node::Leaf { solid, frame }
        };
        let first = nodes.is_empty();
        nodes.push(leaf(rng, &mut earlier));
        match rng.random_range(0..10) {
            0..4 => {}
            4..8 => {
                // A product, perhaps with more complements than are looked at together.
                let many = rng.random_range(0..20) == 0;
                for _ in 0..if many { rng.random_range(60..150) } else { rng.random_range(1..6) } {
                    nodes.push(leaf(rng, &mut earlier));
                    nodes.push(if rng.random_range(0..6) == 0 {
                        Node::Intersection
                    } else {
                        Node::Difference
                    });
                }
            }
            8 => {
                for _ in 0..rng.random_range(1..4) {
                    nodes.extend([leaf(rng, &mut earlier), leaf(rng, &mut earlier)]);
                    let operator = [Node::Union, Node::Intersection, Node::Difference];
                    nodes.push(operator[rng.random_range(0..3)]);
                    nodes.push(operator[rng.random_range(0..3)]);
                }
                // Not at the top, where a union would be taken apart.
                nodes.extend([leaf(rng, &mut earlier), Node::Difference]);
            }
            _ => {
                nodes.extend([leaf(rng, &mut earlier), Node::Complement, Node::Intersection]);
            }
        }
        if !first {
            nodes.push(Node::Union);
        }
    }
    if rng.random_range(0..12) == 0 {
        nodes.push(Node::Complement);
    }
    nodes
}

/// A block out of which so many balls are taken, each of which opens into others: an entry is pushed from one into the next,
/// whatever their order, and into those that were looked at before.
pub(crate) fn riddled(rng: &mut Pcg64, balls: usize) -> Vec<Node> {
    let mut nodes = vec![Node::leaf(Cuboid::new(Vec3::splat(-4.0), Vec3::splat(4.0)).unwrap().into())];
    for _ in 0..balls {
        let at = vec3(coarse(rng, 4), coarse(rng, 4), coarse(rng, 4));
        let radius = rng.random_range(1..=4) as f32 * 0.4;
        nodes.push(Node::leaf(Sphere::new(at, radius).unwrap().into()));
        nodes.push(Node::Difference);
    }
    nodes
}
