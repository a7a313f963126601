//! What the shapes are made of.

use glam::{Vec3, vec3};
use gsdf_nostd::{Cylinder, HalfSpace, Invalid, Leaf, Nappe, Node, Sphere};
use gsdf_workload::shapes::{BOX_FRAME, DOUBLE_CONE, WIDE_SOLID_ANGLE};
use gsdf_workload::solids::{
    CAPPED_CONE, CAPPED_CYLINDER, CAPSULE, CONE, CUBOID, HEXAGONAL_PRISM, OCTAHEDRON, PYRAMID, RHOMBUS, ROUNDED_CONE, ROUNDED_RHOMBUS,
    SOLID_ANGLE, TRIANGULAR_PRISM,
};

/// A shape, and the program of parts that is the same point set.
#[derive(Clone, Debug)]
pub struct Composed {
    /// Its name.
    pub name: &'static str,
    /// What it is made of, in words.
    pub of: &'static str,
    /// The program of its parts.
    pub nodes: Vec<Node>,
    /// The leaf that has a span of its own for it; `None` where its program is all there is.
    pub own: Option<Leaf>,
}

impl Composed {
    /// Its parts, in the program's order.
    pub fn parts(&self) -> impl Iterator<Item = &Leaf> {
        self.nodes.iter().filter_map(|node| match node {
            Node::Leaf { solid, .. } => Some(solid),
            _ => None,
        })
    }
}

/// The heights of the caps of the workload's upright solids.
const LOW: Vec3 = vec3(0.0, -0.75, 0.0);
const HIGH: Vec3 = vec3(0.0, 0.75, 0.0);
/// The cosine and sine of 60 degrees.
const SIXTY: (f32, f32) = (0.5, 0.866_025_4);

/// All of them: the workload's own solids where there is one.
///
/// # Errors
/// Where a part is refused.
pub fn all() -> Result<Vec<Composed>, Invalid> {
    let bottom = half_space(LOW, Vec3::NEG_Y)?;
    let top = half_space(HIGH, Vec3::Y)?;
    let nappe = |apex, axis, radius, height| Nappe::new(apex, axis, radius, height).map(Leaf::Nappe);
    let sphere = |center, radius| Sphere::new(center, radius).map(Leaf::Sphere);
    let cylinder = |radius| Cylinder::new(Vec3::ZERO, Vec3::Y, radius).map(Leaf::Cylinder);

    let (min, max) = (CUBOID.min(), CUBOID.max());
    let mut cuboid = planes(min, [Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z])?;
    cuboid.extend(planes(max, Vec3::AXES)?);

    let mut hexagon = vec![bottom, top];
    for (x, z) in [(1.0, 0.0), (SIXTY.0, SIXTY.1), (SIXTY.0, -SIXTY.1)] {
        let normal = vec3(x, 0.0, z);
        for normal in [normal, -normal] {
            hexagon.push(half_space(HEXAGONAL_PRISM.apothem() * normal, normal)?);
        }
    }
    let mut triangle = vec![bottom, top];
    for (x, z) in [(0.0, -1.0), (SIXTY.1, SIXTY.0), (-SIXTY.1, SIXTY.0)] {
        let normal = vec3(x, 0.0, z);
        triangle.push(half_space(TRIANGULAR_PRISM.inradius() * normal, normal)?);
    }
    let mut octahedron = Vec::new();
    for signs in 0..8_u32 {
        let sign = |axis: u32| if signs >> axis & 1 == 0 { 1.0 } else { -1.0 };
        let normal = vec3(sign(0), sign(1), sign(2)).normalize();
        octahedron.push(half_space(vec3(sign(0), 0.0, 0.0), normal)?);
    }
    let slant = vec3(PYRAMID.height(), PYRAMID.half_width(), 0.0).normalize();
    let mut pyramid = vec![bottom];
    for (x, z) in [(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
        pyramid.push(half_space(HIGH, vec3(x * slant.x, slant.y, z * slant.x))?);
    }
    let side = vec3(RHOMBUS.half_z(), 0.0, RHOMBUS.half_x()).normalize();
    let mut rhombus = vec![bottom, top];
    for (x, z) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        rhombus.push(half_space(vec3(x * RHOMBUS.half_x(), 0.0, 0.0), vec3(x * side.x, 0.0, z * side.z))?);
    }

    // Where the rounding begins and ends: an octagon, of which four sides are those of the rhombus moved outward.
    let rounding = ROUNDED_RHOMBUS.rounding();
    let (half_x, half_z) = (ROUNDED_RHOMBUS.half_x(), ROUNDED_RHOMBUS.half_z());
    let side = vec3(half_z, 0.0, half_x).normalize();
    let mut octagon = vec![bottom, top];
    for (x, z) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let normal = vec3(x * side.x, 0.0, z * side.z);
        octagon.push(half_space(vec3(x * half_x, 0.0, 0.0) + rounding * normal, normal)?);
    }
    let mut edges = Vec::new();
    for (normal, corner, reach) in [(Vec3::X, half_x, side.x), (Vec3::Z, half_z, side.z)] {
        for sign in [1.0, -1.0] {
            octagon.push(half_space(sign * (corner + rounding * reach) * normal, sign * normal)?);
            let edge = Cylinder::new(sign * corner * normal, Vec3::Y, rounding).map(Leaf::Cylinder)?;
            edges.push(intersection(vec![edge, bottom, top]));
        }
    }
    let mut rounded_rhombus = intersection(octagon);
    for edge in edges {
        rounded_rhombus.extend(edge);
        rounded_rhombus.push(Node::Union);
    }

    // The radii .75 and .25 are 1.5 apart: the sine of the half-angle is 1/3, and the circles of contact lie a third of a radius up.
    let rounded_side = intersection(vec![
        nappe(vec3(0.0, 1.5, 0.0), Vec3::NEG_Y, 1.0, 8.0_f32.sqrt())?,
        half_space(vec3(0.0, -0.5, 0.0), Vec3::NEG_Y)?,
        half_space(vec3(0.0, 0.75 + 0.25 / 3.0, 0.0), Vec3::Y)?,
    ]);
    let between = intersection(vec![cylinder(0.5)?, bottom, top]);
    let cap = |name, of, parts: Vec<Leaf>, own| shape(name, of, intersection(parts), own);

    Ok(vec![
        cap("cuboid", "6 half-spaces", cuboid, Leaf::Cuboid(CUBOID)),
        cap(
            "capped cylinder",
            "cylinder, 2 half-spaces",
            vec![cylinder(0.75)?, bottom, top],
            Leaf::CappedCylinder(CAPPED_CYLINDER),
        ),
        cap(
            "cone",
            "nappe, half-space",
            vec![nappe(HIGH, Vec3::NEG_Y, 0.75, 1.5)?, bottom],
            Leaf::Cone(CONE),
        ),
        cap(
            "capped cone",
            "nappe, 2 half-spaces",
            vec![nappe(vec3(0.0, 1.5, 0.0), Vec3::NEG_Y, 1.0, 3.0)?, bottom, top],
            Leaf::CappedCone(CAPPED_CONE),
        ),
        shape(
            "capsule",
            "2 spheres, cylinder, 2 half-spaces",
            with_ends(between, sphere(LOW, 0.5)?, sphere(HIGH, 0.5)?),
            Leaf::Capsule(CAPSULE),
        ),
        cap("hexagonal prism", "8 half-spaces", hexagon, Leaf::HexagonalPrism(HEXAGONAL_PRISM)),
        cap(
            "triangular prism",
            "5 half-spaces",
            triangle,
            Leaf::TriangularPrism(TRIANGULAR_PRISM),
        ),
        cap("octahedron", "8 half-spaces", octahedron, Leaf::Octahedron(OCTAHEDRON)),
        cap("pyramid", "5 half-spaces", pyramid, Leaf::Pyramid(PYRAMID)),
        cap("rhombus", "6 half-spaces", rhombus, Leaf::Rhombus(RHOMBUS)),
        shape(
            "rounded rhombus",
            "4 cylinders, 18 half-spaces",
            rounded_rhombus,
            Leaf::Rhombus(ROUNDED_RHOMBUS),
        ),
        shape(
            "rounded cone",
            "2 spheres, nappe, 2 half-spaces",
            with_ends(rounded_side, sphere(LOW, 0.75)?, sphere(HIGH, 0.25)?),
            Leaf::RoundedCone(ROUNDED_CONE),
        ),
        cap(
            "solid angle",
            "sphere, nappe",
            vec![sphere(LOW, 1.5)?, nappe(LOW, Vec3::Y, 0.75, 1.0)?],
            Leaf::SolidAngle(SOLID_ANGLE),
        ),
        program("wide solid angle", "sphere, nappe", WIDE_SOLID_ANGLE.program().nodes().to_vec()),
        program("box frame", "4 cuboids", BOX_FRAME.program().nodes().to_vec()),
        program("double cone", "2 nappes", DOUBLE_CONE.program().nodes().to_vec()),
    ])
}

fn half_space(point: Vec3, normal: Vec3) -> Result<Leaf, Invalid> {
    HalfSpace::new(point, normal).map(Leaf::HalfSpace)
}

fn planes(point: Vec3, normals: [Vec3; 3]) -> Result<Vec<Leaf>, Invalid> {
    normals.into_iter().map(|normal| half_space(point, normal)).collect()
}

fn intersection(parts: Vec<Leaf>) -> Vec<Node> {
    let mut nodes = Vec::new();
    for part in parts {
        let is_first = nodes.is_empty();
        nodes.push(Node::leaf(part));
        if !is_first {
            nodes.push(Node::Intersection);
        }
    }
    nodes
}

/// A side between two spheres.
fn with_ends(mut side: Vec<Node>, a: Leaf, b: Leaf) -> Vec<Node> {
    side.extend([Node::leaf(a), Node::Union, Node::leaf(b), Node::Union]);
    side
}

fn shape(name: &'static str, of: &'static str, nodes: Vec<Node>, own: Leaf) -> Composed {
    Composed {
        own: Some(own),
        ..program(name, of, nodes)
    }
}

fn program(name: &'static str, of: &'static str, nodes: Vec<Node>) -> Composed {
    Composed {
        name,
        of,
        nodes,
        own: None,
    }
}
