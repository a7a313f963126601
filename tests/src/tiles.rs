//! Scenes cut to what a tile of a picture can see, so that full-size pictures of large scenes can be compared in
//! seconds.

use glam::DVec3;
use gsdf_nostd::{Bounds, Node, Raster, RayError, Solid};

/// An operand of the unions at the top of a program.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    nodes: &'a [Node],
    /// The number of its first leaf in the whole program.
    first_leaf: u32,
    /// A ball around it, if it is bounded.
    ball: Option<(DVec3, f64)>,
}

/// The part of a program that a tile sees.
#[derive(Clone, Debug, Default)]
pub struct Cut {
    /// The program; empty where the tile sees nothing.
    pub nodes: Vec<Node>,
    /// The numbers that its leaves have in the whole program, in order.
    pub leaves: Vec<u32>,
}

impl<'a> Part<'a> {
    /// The operand from node `start` of a program to before node `end`.
    fn new(whole: &'a [Node], start: usize, end: usize) -> Self {
        let nodes = &whole[start..end];
        let bounds = nodes.iter().filter_map(|node| match node {
            Node::Leaf { solid, .. } => Some(solid.bounds()),
            _ => None,
        });
        // A complement may be unbounded whatever its leaves are.
        let closed = !nodes.iter().any(|node| matches!(node, Node::Complement));
        let joined = bounds.reduce(|a, b| Some(a?.joined(b?))).flatten().filter(|_| closed);
        let ball = joined.map(|Bounds { min, max }| {
            let (min, max) = (min.as_dvec3(), max.as_dvec3());
            ((min + max) / 2.0, (max - min).length() / 2.0)
        });
        Self {
            nodes,
            first_leaf: leaves(&whole[..start]),
            ball,
        }
    }

    /// Whether rays from `eye` within `angle` of the unit vector `axis` may meet it.
    fn is_in_cone(&self, eye: DVec3, axis: DVec3, angle: f64) -> bool {
        self.ball.is_none_or(|(center, radius)| {
            let sight = center - eye;
            let distance = sight.length();
            distance <= radius || axis.angle_between(sight) <= angle + (radius / distance).asin() + 1e-6
        })
    }
}

/// The operands of the unions at the top of a program, in order.
#[must_use]
pub fn parts(nodes: &[Node]) -> Vec<Part<'_>> {
    let mut found = Vec::new();
    let mut rest = nodes;
    while let Some((Node::Union, operands)) = rest.split_last() {
        let start = start_of_last(operands);
        found.push(Part::new(nodes, start, operands.len()));
        rest = &operands[..start];
    }
    found.push(Part::new(nodes, 0, rest.len()));
    found.reverse();
    found
}

/// How many leaves there are.
fn leaves(nodes: &[Node]) -> u32 {
    nodes.iter().filter(|node| matches!(node, Node::Leaf { .. })).count() as u32
}

/// Where the last operand of a postfix list starts.
fn start_of_last(nodes: &[Node]) -> usize {
    let mut wanted = 1_usize;
    let mut start = nodes.len();
    while wanted > 0 {
        start -= 1;
        match nodes[start] {
            Node::Leaf { .. } => wanted -= 1,
            Node::Complement => {}
            Node::Union | Node::Intersection | Node::Difference => wanted += 1,
        }
    }
    start
}

/// The program of the parts that rays through the pixels from `from` to before `to` may meet; empty where there is
/// none.
///
/// # Errors
/// Where the camera's rays are none.
pub fn visible(parts: &[Part<'_>], raster: &Raster, from: (u32, u32), to: (u32, u32)) -> Result<Vec<Node>, RayError> {
    Ok(cut(parts, raster, from, to)?.nodes)
}

/// [`visible`], with what its leaves are called in the whole program. Their order is kept, so that the lowest number
/// still wins where surfaces coincide.
///
/// # Errors
/// Where the camera's rays are none.
pub fn cut(parts: &[Part<'_>], raster: &Raster, from: (u32, u32), to: (u32, u32)) -> Result<Cut, RayError> {
    let direction = |x: f32, y: f32| Ok(raster.ray_through(x, y)?.direction().as_dvec3().normalize());
    let (left, top, right, bottom) = (from.0 as f32, from.1 as f32, to.0 as f32, to.1 as f32);
    let axis = direction((left + right) / 2.0, (top + bottom) / 2.0)?;
    let mut angle: f64 = 0.0;
    for (x, y) in [(left, top), (right, top), (left, bottom), (right, bottom)] {
        angle = angle.max(axis.angle_between(direction(x, y)?));
    }
    let eye = raster.camera().eye().as_dvec3();
    let mut cut = Cut::default();
    for part in parts.iter().filter(|part| part.is_in_cone(eye, axis, angle)) {
        let first = cut.nodes.is_empty();
        cut.nodes.extend_from_slice(part.nodes);
        cut.leaves.extend(part.first_leaf..part.first_leaf + leaves(part.nodes));
        if !first {
            cut.nodes.push(Node::Union);
        }
    }
    Ok(cut)
}
