//! What is shown: every shape on the same ground, in the same light, from the same side.

use crate::palette;
use crate::scenes::{Look, Scene};
use anyhow::Result;
use glam::{Vec3, vec3};
use gsdf_nostd::{Bounds, Camera, HalfSpace, Leaf, Node, Program, Solid};
use gsdf_workload::shapes;
use gsdf_workload::solids::{self, ALONE, Visitor, visit};

/// A shape to be shown.
#[derive(Clone, Debug)]
pub struct Exhibit {
    /// Its name, in words.
    pub name: &'static str,
    /// Its program.
    pub nodes: Vec<Node>,
    /// A box around it, where it is bounded.
    pub bounds: Option<Bounds>,
}

/// From where, seen from its middle, a shape is looked at.
const FROM: Vec3 = vec3(-2.3, 2.1, -4.4);
/// The same for a ground: flat enough to see where it ends.
const FROM_LOW: Vec3 = vec3(-2.3, 0.7, -4.4);
/// The tangent of the angle from the middle of the picture, while it is square, to its upper edge.
const TANGENT: f32 = 0.34;

/// Every solid of the workload: those of one leaf, then those that are programs.
#[must_use]
pub fn all() -> Vec<Exhibit> {
    let mut boxes = Boxes(Vec::new());
    visit(&mut boxes);
    let exhibit = |name: &&'static str, program: Program<'static>, bounds: Option<Bounds>| Exhibit {
        name,
        nodes: program.nodes().to_vec(),
        bounds,
    };
    let leaves = (solids::NAMES.iter().zip(&ALONE).zip(boxes.0)).map(|((name, program), bounds)| exhibit(name, program.program(), bounds));
    let composed = (shapes::NAMES.iter().zip(&shapes::PROGRAMS).zip(shapes::bounds()))
        .map(|((name, program), bounds)| exhibit(name, *program, bounds));
    leaves.chain(composed).collect()
}

struct Boxes(Vec<Option<Bounds>>);

impl Visitor for Boxes {
    fn leaf<S: Solid>(&mut self, _: &'static str, solid: S) {
        self.0.push(solid.bounds());
    }
}

impl Exhibit {
    /// Its name as that of a file, without extension.
    #[must_use]
    pub fn file_name(&self) -> String {
        self.name.replace([' ', '-'], "_")
    }

    /// How many leaves its program has.
    #[must_use]
    pub fn leaves(&self) -> usize {
        self.nodes.iter().filter(|node| matches!(node, Node::Leaf { .. })).count()
    }

    /// The shape on the ground, which it touches; unbounded ones go through it, and go on beyond the picture.
    ///
    /// # Errors
    /// Where the ground is refused.
    pub fn scene(&self) -> Result<Scene> {
        let floor = self.bounds.map_or(-1.0, |bounds| bounds.min.y);
        // A half-space is a ground itself.
        let is_ground = matches!(
            self.nodes[..],
            [Node::Leaf {
                solid: Leaf::HalfSpace(_),
                ..
            }]
        );
        let mut nodes = Vec::new();
        if !is_ground {
            nodes.push(Node::leaf(Leaf::HalfSpace(HalfSpace::new(vec3(0.0, floor, 0.0), Vec3::Y)?)));
        }
        nodes.extend(&self.nodes);
        if !is_ground {
            nodes.push(Node::Union);
        }
        let ceiling = self.bounds.map_or(1.0, |bounds| bounds.max.y);
        let middle = vec3(0.0, f32::midpoint(floor, ceiling), 0.0);
        Ok(Scene {
            name: self.name,
            title: self.name,
            nodes,
            poses: Vec::new(),
            camera: Camera::pinhole(middle + if is_ground { FROM_LOW } else { FROM }, middle, Vec3::Y, TANGENT)?,
            look: Look {
                paint: if is_ground {
                    |_| palette::CORAL
                } else {
                    |leaf| if leaf == 0 { palette::GROUND } else { palette::CORAL }
                },
                haze: 16.0,
                ..Look::OUTDOORS
            },
        })
    }
}
