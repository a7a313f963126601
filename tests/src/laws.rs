//! Random scenes for the laws: solids of all kinds at rest and in two frames, some of them twice, and rays at them.

use crate::conformance::packet::bits;
use crate::corpus;
use crate::poses::{random_affine, random_motion};
use crate::shape::{KINDS, Shape};
use crate::trees::{Number, Tree};
use glam::Mat3;
use gsdf_nostd::{Crossing, Hit, Node, Program, Ray, Span, Transform};
use gsdf_simd::{Packet, scratch};
use rand::{Rng, RngExt};

/// Some solids, and an expression over them.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The solids with their frames; one in four repeats an earlier one, so that surfaces coincide.
    pub solids: Vec<(Shape, u16)>,
    /// The expression; leaf `i` is solid `i`.
    pub tree: Tree,
    /// The poses of the frames 1 and 2: a motion and an affine map.
    pub poses: [Transform; 2],
}

impl Scene {
    /// A random scene of so many solids; `posed` puts half of them into frames.
    pub fn random<R: Rng>(rng: &mut R, leaves: usize, posed: bool) -> Self {
        let mut solids: Vec<(Shape, u16)> = Vec::new();
        for _ in 0..leaves {
            let solid = if !solids.is_empty() && rng.random_range(0..4) == 0 {
                solids[rng.random_range(0..solids.len())]
            } else {
                let kind = rng.random_range(0..KINDS.len());
                let frame = if posed && rng.random() { rng.random_range(1..=2) } else { 0 };
                (Shape::random(rng, kind, 1.0, 1.5), frame)
            };
            solids.push(solid);
        }
        Self {
            solids,
            tree: Tree::random(rng, leaves),
            poses: [random_motion(rng), random_affine(rng, 4.0)],
        }
    }

    /// The program of an expression over the solids.
    ///
    /// # Panics
    /// Where the library refuses a solid, which generators do not make.
    #[must_use]
    pub fn nodes(&self, tree: &Tree) -> Vec<Node> {
        let leaves = self
            .solids
            .iter()
            .map(|(shape, _)| shape.leaf().expect("generators make valid shapes"));
        let mut nodes = tree.postfix(&leaves.collect::<Vec<_>>());
        let mut order = tree.order().into_iter();
        for node in &mut nodes {
            if let Node::Leaf { frame, .. } = node
                && let Some(number) = order.next()
            {
                *frame = self.solids[number].1;
            }
        }
        nodes
    }

    /// A ray at one of the solids, of any of the corpus's classes.
    ///
    /// # Panics
    /// Never: moderate numbers make a ray.
    pub fn ray(&self, rng: &mut impl Rng) -> Ray {
        let (shape, frame) = self.solids[rng.random_range(0..self.solids.len())];
        let (_, trial) = corpus::ray(rng, &shape, 1.0, 1e2);
        let (origin, direction) = match usize::from(frame).checked_sub(1).map(|index| self.poses[index]) {
            None => (trial.origin, trial.direction),
            Some(pose) => {
                let [x, y, z] = pose.to_local();
                let to_world = Mat3::from_cols(x, y, z).transpose().inverse();
                (to_world * trial.origin + pose.origin(), to_world * trial.direction)
            }
        };
        Ray::new(origin, direction).expect("moderate numbers make a ray")
    }

    /// Whether the start is inside, and the crossings, of a program over the scene's frames.
    ///
    /// # Panics
    /// Where the nodes are no program.
    #[must_use]
    pub fn crossings<T: Number>(&self, nodes: &[Node], ray: Ray) -> (bool, Vec<Crossing<T>>) {
        let program = self.program(nodes);
        let mut scratch = vec![Span::empty_like(T::from(0.0)); program.leaves()];
        let sight = program.along(ray, &mut scratch).expect("there is room");
        (sight.march::<T>().inside, sight.crossings().collect())
    }

    /// Every hit along the ray, each cast for from the one before, alone and in a packet.
    ///
    /// # Panics
    /// Where the nodes are no program, or a packet finds anything else.
    #[must_use]
    pub fn hits(&self, nodes: &[Node], ray: Ray) -> Vec<Hit> {
        let program = self.program(nodes);
        let (mut scratch, mut lanes) = (vec![Span::EMPTY; program.leaves()], scratch(program.leaves()));
        let mut hits: Vec<Hit> = Vec::new();
        let mut rest = Some(ray);
        while let Some(hit) = rest.and_then(|rest| {
            let alone = program.along(rest, &mut scratch).expect("there is room").cast();
            let packet = Packet::new(&[rest]).cast(&program, &mut lanes).expect("there is room");
            let found = packet.lane(0, &rest);
            assert_eq!(found.as_ref().map(bits), alone.as_ref().map(bits), "along {rest:?}: {nodes:?}");
            alone
        }) {
            assert!(hits.last().is_none_or(|last| last.t < hit.t), "{hit:?} after {hits:?}");
            hits.push(hit);
            rest = ray.within(hit.t..ray.range().end).ok();
        }
        hits
    }

    /// The posed program of these nodes.
    ///
    /// # Panics
    /// Where the nodes are no program.
    #[must_use]
    pub fn program<'a>(&'a self, nodes: &'a [Node]) -> Program<'a> {
        let program = Program::new(nodes).and_then(|program| program.posed(&self.poses));
        program.expect("trees make programs, and every frame has a pose")
    }
}

impl Shape {
    /// Whether some face of the solid is curved.
    #[must_use]
    pub fn is_round(&self) -> bool {
        match self {
            Self::HalfSpace { .. }
            | Self::Cuboid { .. }
            | Self::HexagonalPrism { .. }
            | Self::TriangularPrism { .. }
            | Self::Octahedron { .. }
            | Self::Pyramid { .. }
            | Self::Triangle { .. }
            | Self::Quad { .. } => false,
            Self::Rhombus { rounding, .. } => *rounding > 0.0,
            _ => true,
        }
    }
}
