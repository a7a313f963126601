//! What is shown: every shape on the same ground, in the same light, from the same side.

use crate::palette;
use crate::scenes::{Look, Scene};
use anyhow::Result;
use glam::{Vec3, vec3};
use gsdf_nostd::{Bounds, BoxFrame, Camera, Csg, DoubleCone, HalfSpace, Leaf, Node, Solid, WideSolidAngle, valid};
use gsdf_workload::solids::{ALONE, NAMES, Visitor, visit};

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

/// A double cone.
pub const DOUBLE_CONE: DoubleCone = valid!(DoubleCone::new(Vec3::ZERO, Vec3::Y, 0.5, 1.0));
/// A box frame.
pub const BOX_FRAME: BoxFrame = valid!(BoxFrame::new(vec3(-0.75, -0.75, -0.75), vec3(0.75, 0.75, 0.75), 0.1875));
/// A solid angle beyond 90 degrees. What it lacks opens towards the camera.
pub const WIDE_SOLID_ANGLE: WideSolidAngle = valid!(WideSolidAngle::new(Vec3::ZERO, vec3(0.48, -0.6, 0.64), 1.0, 1.0, -0.75));

/// From where, seen from its middle, a shape is looked at.
const FROM: Vec3 = vec3(-2.3, 2.1, -4.4);
/// The same for a ground: flat enough to see where it ends.
const FROM_LOW: Vec3 = vec3(-2.3, 0.7, -4.4);
/// The tangent of the angle from the middle of the picture, while it is square, to its upper edge.
const TANGENT: f32 = 0.34;

/// A solid of each kind, by the list of the workload, and the shapes that are programs.
#[must_use]
pub fn all() -> Vec<Exhibit> {
    let mut boxes = Boxes(Vec::new());
    visit(&mut boxes);
    let leaves = NAMES.iter().zip(&ALONE).zip(boxes.0).map(|((name, program), bounds)| Exhibit {
        name,
        nodes: program.nodes().to_vec(),
        bounds,
    });
    leaves
        .chain([
            composed("double cone", &DOUBLE_CONE.program(), DOUBLE_CONE.bounds()),
            composed("box frame", &BOX_FRAME.program(), BOX_FRAME.bounds()),
            composed("wide solid angle", &WIDE_SOLID_ANGLE.program(), WIDE_SOLID_ANGLE.bounds()),
        ])
        .collect()
}

struct Boxes(Vec<Option<Bounds>>);

impl Visitor for Boxes {
    fn leaf<S: Solid>(&mut self, _: &'static str, solid: S) {
        self.0.push(solid.bounds());
    }
}

fn composed<const N: usize>(name: &'static str, program: &Csg<N>, bounds: Option<Bounds>) -> Exhibit {
    Exhibit {
        name,
        nodes: program.nodes().to_vec(),
        bounds,
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
