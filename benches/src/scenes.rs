//! The scenes that are raced on: those on which other renderers were measured, and two that are made as large as one likes.

use anyhow::{Context, Result, bail, ensure};
use glam::{Vec3, vec3};
use gsdf_nostd::{Camera, CappedCylinder, Capsule, Cone, Cuboid, HalfSpace, Leaf, Node, Program, Sphere, leaf_set};
use gsdf_simd::vectorized;
use gsdf_workload::scenes as bare;

leaf_set! {
    /// The solids that these scenes are made of: all contenders link their formulas and no others.
    pub enum Primitive {
        HalfSpace(HalfSpace),
        Sphere(Sphere),
        Cuboid(Cuboid),
        CappedCylinder(CappedCylinder),
        Capsule(Capsule),
        Cone(Cone),
    }
}
vectorized!(Primitive);

/// A solid and from where it is seen.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// The solid: a program in postfix order, in the world.
    pub nodes: Vec<Node<Primitive>>,
    /// The camera: a pinhole.
    pub camera: Camera,
}

/// The names of all scenes. S6 is followed by how many spheres stand along each of its edges.
pub const NAMES: [&str; 10] = ["s1", "s2", "s3", "s4", "s5", "s6-10", "s6-22", "s6-46", "s6-100", "s7"];

impl Scene {
    /// The scene of a name.
    ///
    /// # Errors
    /// Where there is none.
    pub fn by_name(name: &str) -> Result<Self> {
        let fixed = [&bare::S1, &bare::S2, &bare::S3, &bare::S4, &bare::S5];
        if let Some(scene) = fixed.into_iter().find(|scene| scene.name == name) {
            return Self::of_workload(scene);
        }
        let name = *NAMES
            .iter()
            .find(|known| **known == name)
            .with_context(|| format!("no scene {name}"))?;
        match name.strip_prefix("s6-") {
            Some(edge) => Self::spheres(name, edge.parse()?),
            None => Self::drilled_plate(name),
        }
    }

    /// The program.
    ///
    /// # Errors
    /// Where the nodes are none.
    pub fn program(&self) -> Result<Program<'_, Primitive>> {
        Program::new(&self.nodes).with_context(|| format!("scene {}", self.name))
    }

    fn of_workload(scene: &bare::Scene) -> Result<Self> {
        let nodes = scene.program.nodes().iter().map(|node| {
            Ok(match node {
                Node::Leaf { solid, frame } => {
                    ensure!(*frame == 0, "{} has frames", scene.name);
                    Node::leaf(Primitive::try_from(*solid)?)
                }
                Node::Union => Node::Union,
                Node::Intersection => Node::Intersection,
                Node::Difference => Node::Difference,
                Node::Complement => Node::Complement,
            })
        });
        Ok(Self {
            name: scene.name,
            nodes: nodes.collect::<Result<_>>()?,
            camera: scene.camera()?,
        })
    }

    /// S6: `edge` x `edge` x `edge` spheres of radius 1/3, a unit apart, seen from as far as the cube of them is large.
    ///
    /// # Errors
    /// Never for as many spheres as a program may have.
    pub fn spheres(name: &'static str, edge: u16) -> Result<Self> {
        let from = 0.5 * (f32::from(edge) - 1.0);
        let place = |number: u16| f32::from(number) - from;
        let cells = (0..edge).flat_map(|i| (0..edge).flat_map(move |j| (0..edge).map(move |k| (i, j, k))));
        let mut nodes = Vec::with_capacity(2 * usize::from(edge).pow(3));
        for (i, j, k) in cells {
            let is_first = nodes.is_empty();
            nodes.push(Node::leaf(Primitive::Sphere(Sphere::new(
                vec3(place(i), place(j), place(k)),
                1.0 / 3.0,
            )?)));
            if !is_first {
                nodes.push(Node::Union);
            }
        }
        let eye = vec3(16.0, 13.0, -26.0) * (f32::from(edge) / 16.0);
        Ok(Self {
            name,
            nodes,
            camera: Camera::pinhole(eye, Vec3::ZERO, Vec3::Y, 0.38)?,
        })
    }

    /// S7: one difference, a plate with 10,000 holes.
    fn drilled_plate(name: &'static str) -> Result<Self> {
        let half = vec3(50.0, 1.0, 50.0);
        let mut nodes = vec![Node::leaf(Primitive::Cuboid(Cuboid::new(-half, half)?))];
        for (i, k) in (0..100_u8).flat_map(|i| (0..100_u8).map(move |k| (i, k))) {
            let at = vec3(f32::from(i) - 49.5, 0.0, f32::from(k) - 49.5);
            let hole = CappedCylinder::new(at - 1.5 * Vec3::Y, at + 1.5 * Vec3::Y, Vec3::Y, 0.3)?;
            nodes.extend([Node::leaf(Primitive::CappedCylinder(hole)), Node::Difference]);
        }
        Ok(Self {
            name,
            nodes,
            camera: Camera::pinhole(vec3(60.0, 70.0, -90.0), Vec3::ZERO, Vec3::Y, 0.5)?,
        })
    }
}

impl TryFrom<Leaf> for Primitive {
    type Error = anyhow::Error;

    fn try_from(leaf: Leaf) -> Result<Self> {
        Ok(match leaf {
            Leaf::HalfSpace(solid) => Self::HalfSpace(solid),
            Leaf::Sphere(solid) => Self::Sphere(solid),
            Leaf::Cuboid(solid) => Self::Cuboid(solid),
            Leaf::CappedCylinder(solid) => Self::CappedCylinder(solid),
            Leaf::Capsule(solid) => Self::Capsule(solid),
            Leaf::Cone(solid) => Self::Cone(solid),
            other => bail!("not among the solids of these scenes: {other:?}"),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{NAMES, Scene};
    use anyhow::Result;

    #[test]
    fn every_scene_has_its_name_and_as_many_leaves_as_solids() -> Result<()> {
        let leaves = [2, 5, 64, 4096, 1280, 1000, 10_648, 97_336, 1_000_000, 10_001];
        for (name, leaves) in NAMES.into_iter().zip(leaves) {
            let scene = Scene::by_name(name)?;
            assert_eq!((scene.name, scene.program()?.leaves()), (name, leaves));
        }
        for name in ["", "s0", "s6", "s6-11", "snowcone"] {
            assert!(Scene::by_name(name).is_err(), "{name}");
        }
        Ok(())
    }
}
