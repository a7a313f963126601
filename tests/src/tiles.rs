//! Scenes cut to what a tile of a picture can see, so that full-size pictures of large scenes can be compared in
//! seconds.

use glam::DVec3;
use gsdf_nostd::{Bounds, Node, Raster, RayError, Solid};

/// An operand of the unions at the top of a program.
#[derive(Clone, Copy, Debug)]
pub struct Part<'a> {
    nodes: &'a [Node],
    /// A ball around it, if it is bounded.
    ball: Option<(DVec3, f64)>,
}

impl<'a> Part<'a> {
    fn new(nodes: &'a [Node]) -> Self {
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
        Self { nodes, ball }
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
        found.push(Part::new(&operands[start..]));
        rest = &operands[..start];
    }
    found.push(Part::new(rest));
    found.reverse();
    found
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
    let direction = |x: f32, y: f32| Ok(raster.ray_through(x, y)?.direction().as_dvec3().normalize());
    let (left, top, right, bottom) = (from.0 as f32, from.1 as f32, to.0 as f32, to.1 as f32);
    let axis = direction((left + right) / 2.0, (top + bottom) / 2.0)?;
    let mut angle: f64 = 0.0;
    for (x, y) in [(left, top), (right, top), (left, bottom), (right, bottom)] {
        angle = angle.max(axis.angle_between(direction(x, y)?));
    }
    let eye = raster.camera().eye().as_dvec3();
    let mut nodes = Vec::new();
    for part in parts.iter().filter(|part| part.is_in_cone(eye, axis, angle)) {
        let first = nodes.is_empty();
        nodes.extend_from_slice(part.nodes);
        if !first {
            nodes.push(Node::Union);
        }
    }
    Ok(nodes)
}
