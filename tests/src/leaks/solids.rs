//! Solids that share edges and faces, each beside what they are together.

use crate::shape::{across, log_uniform, unit};
use glam::{DVec3, Vec3};
use gsdf_nostd::{
    CappedCylinder, Cone, Cuboid, HalfSpace, HexagonalPrism, Invalid, Leaf, Line, Node, Pyramid, Quad, Rhombus, Solid, Span, Sphere,
    Triangle, TriangularPrism,
};
use rand::RngExt;
use rand_pcg::Pcg64;

/// The kinds of arrangements.
pub const KINDS: [&str; 4] = [
    "boxes side by side",
    "wedges around an edge",
    "solids on each other",
    "closed meshes",
];

/// Some solids and what they share.
pub(super) struct Shared {
    /// The union.
    pub(super) nodes: Vec<Node>,
    /// The same as one solid, where there is one of the same faces.
    pub(super) whole: Option<Vec<Node>>,
    /// Whether the solids are a surface around nothing.
    pub(super) is_hollow: bool,
    /// A point deep inside, and how deep.
    pub(super) middle: DVec3,
    pub(super) depth: f64,
    pub(super) size: f64,
    /// How far from the origin the numbers reach.
    pub(super) extent: f64,
    /// The edge that more than two planes have in common: a point and a direction.
    pub(super) edge: Option<(DVec3, DVec3)>,
    /// The edges to aim at.
    edges: Vec<[DVec3; 2]>,
    /// The rims to aim at: center, axis, radius.
    rims: Vec<(DVec3, DVec3, f64)>,
    /// Coordinates that faces lie on.
    faces: [Vec<f32>; 3],
    walls: Vec<HalfSpace>,
}

/// The union of all these, each a list of nodes.
fn union(parts: impl IntoIterator<Item = Vec<Node>>) -> Vec<Node> {
    let mut nodes = Vec::new();
    for (number, part) in parts.into_iter().enumerate() {
        nodes.extend(part);
        if number > 0 {
            nodes.push(Node::Union);
        }
    }
    nodes
}

fn leaf<S: Into<Leaf>>(made: Result<S, Invalid>) -> Vec<Node> {
    vec![Node::leaf(made.expect("generators make valid solids").into())]
}

/// Some numbers in ascending order, in tenths, at least one tenth apart.
fn cuts(rng: &mut Pcg64, pieces: usize) -> Vec<f32> {
    let mut at = rng.random_range(-30..30);
    let mut cuts = vec![at as f32 * 0.1];
    for _ in 0..pieces {
        at += rng.random_range(1..15);
        cuts.push(at as f32 * 0.1);
    }
    cuts
}

impl Shared {
    /// A random arrangement, in frame 1.
    pub(super) fn random(rng: &mut Pcg64, kind: usize) -> Self {
        let mut shared = match kind {
            0 => Self::boxes(rng),
            1 => Self::wedges(rng),
            2 => Self::stack(rng),
            _ => Self::mesh(rng),
        };
        for node in shared.nodes.iter_mut().chain(shared.whole.iter_mut().flatten()) {
            if let Node::Leaf { frame, .. } = node {
                *frame = 1;
            }
        }
        shared
    }

    fn new(nodes: Vec<Node>, middle: DVec3, depth: f64, size: f64) -> Self {
        Self {
            nodes,
            whole: None,
            is_hollow: false,
            middle,
            depth,
            size,
            extent: middle.length() + 2.0 * size,
            edge: None,
            edges: Vec::new(),
            rims: Vec::new(),
            faces: [const { Vec::new() }; 3],
            walls: Vec::new(),
        }
    }

    /// A box cut into up to twelve.
    fn boxes(rng: &mut Pcg64) -> Self {
        let pieces = [[2, 1, 1], [1, 2, 2], [2, 2, 2], [3, 2, 2], [1, 3, 2], [1, 1, 4]][rng.random_range(0..6)];
        let faces = pieces.map(|pieces| cuts(rng, pieces));
        let corner = |at: [usize; 3]| Vec3::new(faces[0][at[0]], faces[1][at[1]], faces[2][at[2]]);
        let cells: Vec<[usize; 3]> = (0..pieces[0])
            .flat_map(|x| (0..pieces[1]).flat_map(move |y| (0..pieces[2]).map(move |z| [x, y, z])))
            .collect();
        let parts = cells
            .iter()
            .map(|&cell| leaf(Cuboid::new(corner(cell), corner(cell.map(|at| at + 1)))));
        let (min, max) = (corner([0; 3]), corner(pieces));
        let size = f64::from((max - min).length());
        let (low, high) = (min.as_dvec3(), max.as_dvec3());
        let mut shared = Self::new(union(parts), low.midpoint(high), 0.4 * (high - low).min_element(), size);
        shared.whole = Some(leaf(Cuboid::new(min, max)));
        // An edge of a random cell, or one that only cells of a whole row share.
        for cell in cells {
            let (from, to) = (corner(cell).as_dvec3(), corner(cell.map(|at| at + 1)).as_dvec3());
            for axis in 0..3 {
                let mut end = from;
                end[axis] = to[axis];
                shared.edges.push([from, end]);
                let mut start = to;
                start[axis] = from[axis];
                shared.edges.push([start, to]);
            }
        }
        shared.faces = faces;
        shared
    }

    /// A solid cut by planes through a line within it.
    fn wedges(rng: &mut Pcg64) -> Self {
        let size = log_uniform(rng, 0.1, 10.0);
        let point = (unit(rng) * size * rng.random_range(0.0..3.0)).as_vec3();
        let axis = unit(rng);
        let middle = point.as_dvec3();
        let radius = size as f32;
        let up = axis.as_vec3().normalize();
        let body = match rng.random_range(0..3) {
            0 => leaf(Sphere::new(point, radius)),
            1 => leaf(Cuboid::new(point - Vec3::splat(radius), point + Vec3::splat(radius))),
            _ => leaf(CappedCylinder::new(point - up * radius, point + up * radius, up, radius)),
        };
        let count = rng.random_range(3..=6);
        let (u, v) = axis.any_orthonormal_pair();
        let turn = rng.random_range(0.0..1.0);
        let walls: Vec<[HalfSpace; 2]> = (0..count)
            .map(|number| {
                let angle = core::f64::consts::TAU * (f64::from(number) + turn + rng.random_range(0.0..0.3)) / f64::from(count);
                let normal = (v * angle.cos() - u * angle.sin()).as_vec3().normalize();
                [normal, -normal].map(|normal| HalfSpace::new(point, normal).expect("a plane"))
            })
            .collect();
        // Ahead of one plane, in the sense of the turn, and behind the next.
        let parts = (0..count as usize).map(|number| {
            let (ahead, behind) = (walls[number][1], walls[(number + 1) % count as usize][0]);
            [
                body.clone(),
                vec![
                    Node::leaf(ahead.into()),
                    Node::Intersection,
                    Node::leaf(behind.into()),
                    Node::Intersection,
                ],
            ]
            .concat()
        });
        let mut shared = Self::new(union(parts), middle, 0.5 * size, 2.0 * size);
        shared.whole = Some(body);
        shared.edge = Some((middle, axis));
        shared.edges.push([middle - axis * size, middle + axis * size]);
        shared.walls = walls.into_iter().flatten().collect();
        shared
    }

    /// Two solids, the one on the other's top.
    fn stack(rng: &mut Pcg64) -> Self {
        let mut tenths = |least: i32, most: i32| rng.random_range(least..=most) as f32 * 0.1;
        let (foot, low, high, radius, depth) = (
            Vec3::new(tenths(-30, 30), tenths(-30, 30), tenths(-30, 30)),
            tenths(5, 20),
            tenths(5, 20),
            tenths(5, 15),
            tenths(5, 15),
        );
        let (waist, tip) = (foot.y + low, foot.y + low + high);
        let (center, size) = (foot.with_y(waist).as_dvec3(), f64::from(low + high + 2.0 * (radius + depth)));
        let middle = |share: f64| center + DVec3::Y * share;
        let square = [(1.0, 1.0), (1.0, -1.0), (-1.0, -1.0), (-1.0, 1.0)];
        let kind = rng.random_range(0..5);
        let parts = match kind {
            0 => {
                let corner = Vec3::new(radius, 0.0, radius);
                [
                    leaf(Cuboid::new(foot - corner, foot.with_y(waist) + corner)),
                    leaf(Pyramid::new(foot.with_y(waist), radius, high)),
                ]
            }
            1 => [
                leaf(CappedCylinder::new(foot, foot.with_y(waist), Vec3::Y, radius)),
                leaf(Cone::new(foot.with_y(tip), foot.with_y(waist), Vec3::NEG_Y, radius)),
            ],
            2 => [
                leaf(HexagonalPrism::new(foot, waist, radius)),
                leaf(HexagonalPrism::new(foot.with_y(waist), tip, radius)),
            ],
            3 => [
                leaf(TriangularPrism::new(foot, waist, radius)),
                leaf(TriangularPrism::new(foot.with_y(waist), tip, radius)),
            ],
            _ => [
                leaf(Rhombus::new(foot, waist, radius, depth, 0.0)),
                leaf(Rhombus::new(foot.with_y(waist), tip, radius, depth, 0.0)),
            ],
        };
        let mut shared = Self::new(union(parts), center, 0.1, size);
        shared.extent = foot.as_dvec3().length() + size;
        let (r, d) = (f64::from(radius), f64::from(depth));
        let around: Vec<DVec3> = match kind {
            0 => square.iter().map(|&(x, z)| DVec3::new(x * r, 0.0, z * r)).collect(),
            1 => {
                shared.rims.push((middle(0.0), DVec3::Y, r));
                Vec::new()
            }
            // The corners of a hexagon whose sides are across x, of a triangle with a side across -z, of a rhombus.
            2 => (0..6)
                .map(|corner| turned(r / 0.75_f64.sqrt(), 30.0 + 60.0 * f64::from(corner)))
                .collect(),
            3 => [90.0, 210.0, 330.0].map(|degrees| turned(2.0 * r, degrees)).into(),
            _ => vec![DVec3::X * r, DVec3::Z * d, DVec3::NEG_X * r, DVec3::NEG_Z * d],
        };
        for (number, corner) in around.iter().enumerate() {
            shared
                .edges
                .push([middle(0.0) + *corner, middle(0.0) + around[(number + 1) % around.len()]]);
        }
        shared.faces[1] = vec![waist];
        shared
    }

    /// A tetrahedron or a prism, of triangles and quads.
    fn mesh(rng: &mut Pcg64) -> Self {
        let size = log_uniform(rng, 0.1, 100.0);
        let center = unit(rng) * size * rng.random_range(0.0..4.0);
        let mut corner = |direction: [f64; 3]| (center + (DVec3::from(direction) + unit(rng) * 0.2) * size).as_vec3();
        let triangle = |corners: [Vec3; 3]| leaf(Triangle::new(corners[0], corners[1], corners[2]));
        let (parts, edges): (Vec<Vec<Node>>, Vec<[Vec3; 2]>) = if center.x > 0.0 {
            let [a, b, c, d] = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(&mut corner);
            let faces = [[a, b, c], [d, a, b], [c, a, d], [b, d, c]].map(triangle);
            (faces.into(), vec![[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]])
        } else {
            let low = [[1.0, -1.0, 0.0], [-0.6, -1.0, 0.9], [-0.6, -1.0, -0.9]].map(&mut corner);
            let shift = (DVec3::Y * 2.0 * size).as_vec3();
            let high = low.map(|corner| corner + shift);
            let mut parts = vec![triangle(low), triangle(high)];
            let mut edges = Vec::new();
            for side in 0..3 {
                let next = (side + 1) % 3;
                // Where rounding has bent a side it is two triangles.
                match Quad::new(low[side], low[next], high[next], high[side]) {
                    Ok(quad) => parts.push(vec![Node::leaf(quad.into())]),
                    Err(_) => parts.extend([
                        triangle([low[side], low[next], high[next]]),
                        triangle([low[side], high[next], high[side]]),
                    ]),
                }
                edges.extend([[low[side], low[next]], [high[side], high[next]], [low[side], high[side]]]);
            }
            (parts, edges)
        };
        let mut shared = Self::new(union(parts), center, 0.2 * size, 2.0 * size);
        shared.is_hollow = true;
        shared.edges = edges.into_iter().map(|edge| edge.map(Vec3::as_dvec3)).collect();
        shared
    }

    /// A point of an edge, now and then its end or as near to it as makes no difference.
    pub(super) fn edge_point(&self, rng: &mut Pcg64) -> DVec3 {
        if !self.rims.is_empty() {
            let (center, axis, radius) = self.rims[rng.random_range(0..self.rims.len())];
            return center + across(rng, axis) * radius;
        }
        let [from, to] = self.edges[rng.random_range(0..self.edges.len())];
        let at = from.lerp(to, rng.random_range(0.0..1.0));
        match rng.random_range(0..8) {
            0 => from,
            1 => to,
            2 => at + unit(rng) * self.size * log_uniform(rng, 1e-9, 3e-7),
            _ => at,
        }
    }

    /// How far a point of the frame is from the edge that more than two planes share, or from the nearest.
    pub(super) fn distance_to_edge(&self, p: DVec3) -> f64 {
        if let Some((at, axis)) = self.edge {
            return (p - at).cross(axis).length();
        }
        let to_rim = self.rims.iter().map(|&(center, axis, radius)| {
            let from = p - center;
            let along = from.dot(axis);
            along.hypot((from - axis * along).length() - radius)
        });
        let to_edge = self.edges.iter().map(|&[from, to]| {
            let (along, edge) = (p - from, to - from);
            (along - edge * (along.dot(edge) / edge.length_squared()).clamp(0.0, 1.0)).length()
        });
        to_rim.chain(to_edge).fold(f64::INFINITY, f64::min)
    }

    /// Whether a line lies in a plane that the solids share, to the bit.
    pub(super) fn has_in_plane(&self, line: &Line<f32>) -> bool {
        let (origin, v): (Vec3, Vec3) = (line.origin.into(), line.toward.v.into());
        let on_face = (0..3).any(|axis| v[axis].abs() < 1e-30 && self.faces[axis].contains(&origin[axis]));
        let empty = Span::EMPTY;
        on_face || self.walls.iter().any(|wall| wall.span_along(line) == empty)
    }
}

/// A point around the y axis.
fn turned(radius: f64, degrees: f64) -> DVec3 {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    DVec3::new(cosine, 0.0, sine) * radius
}
