//! The scenes: two on which other renderers were measured, and one of them from far away.

use anyhow::{Context, Result, bail};
use glam::Vec3;
use gsdf_nostd::{Camera, CappedCylinder, Cuboid, HalfSpace, Leaf, Node, Program, Ray, Sphere, leaf_set};
use gsdf_workload::scenes as reference;

leaf_set! {
    /// The solids that the scenes are made of: all contenders link their formulas and no others.
    pub enum Primitive {
        HalfSpace(HalfSpace),
        Sphere(Sphere),
        Cuboid(Cuboid),
        CappedCylinder(CappedCylinder),
    }
}

/// The names of the scenes: a ball on the ground, a drilled block, and the block a thousand times as far away, through a lens
/// that shows it as large.
pub const NAMES: [&str; 3] = ["s1", "s2", "s2-far"];

/// How many times as far.
const FARTHER: f32 = 1000.0;

/// A program and the rays it is asked about.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// The pixels along each side of the picture.
    pub size: u32,
    /// A ray through the middle of each pixel, row by row.
    pub rays: Vec<Ray>,
    nodes: Vec<Node<Primitive>>,
}

impl Scene {
    /// The scene of a name, seen in a picture of so many pixels along each side.
    ///
    /// # Errors
    /// Where there is none of that name.
    pub fn by_name(name: &str, size: u32) -> Result<Self> {
        let name = *NAMES
            .iter()
            .find(|known| **known == name)
            .with_context(|| format!("no scene {name}: there are {}", NAMES.join(", ")))?;
        let scene = if name == "s1" { &reference::S1 } else { &reference::S2 };
        let times = if name == "s2-far" { FARTHER } else { 1.0 };
        let raster = Camera::pinhole(scene.eye * times, scene.target, Vec3::Y, scene.tangent / times)?.raster(size, size);
        let pixels = (0..size).flat_map(|y| (0..size).map(move |x| (x, y)));
        Ok(Self {
            name,
            size,
            rays: pixels.map(|(x, y)| raster.ray(x, y)).collect::<Result<_, _>>()?,
            nodes: scene.program.nodes().iter().map(primitive).collect::<Result<_>>()?,
        })
    }

    /// The program.
    ///
    /// # Errors
    /// Where the nodes are none, which those of the reference scenes are not.
    pub fn program(&self) -> Result<Program<'_, Primitive>> {
        Ok(Program::new(&self.nodes)?)
    }
}

fn primitive(node: &Node) -> Result<Node<Primitive>> {
    Ok(match node {
        Node::Leaf { solid, frame } => Node::Leaf {
            solid: match solid {
                Leaf::HalfSpace(solid) => Primitive::HalfSpace(*solid),
                Leaf::Sphere(solid) => Primitive::Sphere(*solid),
                Leaf::Cuboid(solid) => Primitive::Cuboid(*solid),
                Leaf::CappedCylinder(solid) => Primitive::CappedCylinder(*solid),
                other => bail!("no scene is made of {other:?}"),
            },
            frame: *frame,
        },
        Node::Union => Node::Union,
        Node::Intersection => Node::Intersection,
        Node::Difference => Node::Difference,
        Node::Complement => Node::Complement,
    })
}
