//! The solids that models are made of, and no others: every kind of solid in every arithmetic is much to compile.

use anyhow::{Result, bail};
use gsdf_nostd::{CappedCone, CappedCylinder, Cone, Cuboid, HalfSpace, Leaf, Node, Program, Sphere, Transform, leaf_set};

leaf_set! {
    /// The solids that models and reference scenes are made of.
    pub enum Primitive {
        HalfSpace(HalfSpace),
        Sphere(Sphere),
        Cuboid(Cuboid),
        CappedCylinder(CappedCylinder),
        Cone(Cone),
        CappedCone(CappedCone),
    }
}

/// A program of such solids alone: the same nodes, to be cast at in any arithmetic.
#[derive(Clone, Debug)]
pub struct Solids {
    nodes: Vec<Node<Primitive>>,
    poses: Vec<Transform>,
}

impl Solids {
    /// Those of a program.
    ///
    /// # Errors
    /// Where it has a leaf that is none of them.
    pub fn of(program: &Program<'_>) -> Result<Self> {
        Ok(Self {
            nodes: program.nodes().iter().map(primitive).collect::<Result<_>>()?,
            poses: (1..=u16::MAX).map_while(|frame| program.pose(frame).copied()).collect(),
        })
    }

    /// The program.
    ///
    /// # Errors
    /// Where it is none, which one that came as a program is not.
    pub fn program(&self) -> Result<Program<'_, Primitive>> {
        Ok(Program::new(&self.nodes)?.posed(&self.poses)?)
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
                Leaf::Cone(solid) => Primitive::Cone(*solid),
                Leaf::CappedCone(solid) => Primitive::CappedCone(*solid),
                other => bail!("no model is made of {other:?}"),
            },
            frame: *frame,
        },
        Node::Union => Node::Union,
        Node::Intersection => Node::Intersection,
        Node::Difference => Node::Difference,
        Node::Complement => Node::Complement,
    })
}
