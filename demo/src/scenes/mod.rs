//! What there is to look at: each scene a program, a camera and a choice of colours.

mod paper;
mod planetary;
mod reference;

pub use paper::{HOLLOW_SPHERE, SNOWCONE, hollow, snowcone};
pub use planetary::planetary;
pub use reference::{BALL_ON_GROUND, PART, s1, s2, s3, s4, s5};

use crate::light::Light;
use crate::palette;
use core::fmt::Display;
use glam::Vec3;
use gsdf_nostd::{Camera, Node, Program, ProgramError, Transform};

/// A solid, and how to look at it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The name by which it is asked for, and that of its file.
    pub name: &'static str,
    /// What it shows, in a few words.
    pub title: &'static str,
    /// The solid: a program in postfix order.
    pub nodes: Vec<Node>,
    /// Where its frames are, the first being frame 1.
    pub poses: Vec<Transform>,
    /// From where it is seen.
    pub camera: Camera,
    /// How it is coloured.
    pub look: Look,
}

/// The appearance of a scene: all that does not change what a ray meets.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// The colour of each leaf's surface: linear, each channel from 0 to 1.
    pub paint: fn(leaf: u32) -> Vec3,
    /// How much each leaf's surface mirrors, from 0 to 1.
    pub mirror: fn(leaf: u32) -> f32,
    /// The distance at which things have faded to a third against the background; infinite for clear air.
    pub haze: f32,
    /// The light.
    pub light: Light,
}

impl Look {
    /// Dull and grey, in the sun and in clear air: what a scene's look differs from.
    pub const OUTDOORS: Self = Self {
        paint: |_| palette::GROUND,
        mirror: |_| 0.0,
        haze: f32::INFINITY,
        light: Light::OUTDOORS,
    };
}

impl Scene {
    /// The program of the scene, with its frames posed.
    ///
    /// # Errors
    /// Where the nodes are not a program, or name a frame without a pose.
    pub const fn program(&self) -> Result<Program<'_>, ProgramError> {
        match Program::new(self.nodes.as_slice()) {
            Ok(program) => program.posed(self.poses.as_slice()),
            Err(error) => Err(error),
        }
    }
}

/// What makes a scene.
type Constructor = fn() -> Scene;

/// Every scene by its name, which is known before the scene is made.
const CATALOGUE: [(&str, Constructor); 8] = [
    ("s1", s1),
    ("s2", s2),
    ("s3", s3),
    ("s4", s4),
    ("s5", s5),
    ("snowcone", snowcone),
    ("hollow", hollow),
    ("planetary", planetary),
];

/// The names of all scenes, in the order of [`all`].
#[must_use]
pub fn names() -> [&'static str; CATALOGUE.len()] {
    CATALOGUE.map(|(name, _)| name)
}

/// The scene of a name.
#[must_use]
pub fn by_name(name: &str) -> Option<Scene> {
    CATALOGUE.iter().find(|(known, _)| *known == name).map(|(_, make)| make())
}

/// All scenes.
#[must_use]
pub fn all() -> Vec<Scene> {
    CATALOGUE.iter().map(|(_, make)| make()).collect()
}

/// A camera that stands upright.
fn upright(eye: Vec3, target: Vec3, tangent: f32) -> Camera {
    valid(Camera::pinhole(eye, target, Vec3::Y, tangent))
}

/// Many operands joined by one operator: a chain that leans to the left, so that however long it is only one operand waits beside the one at hand.
fn joined(operator: Node, operands: impl IntoIterator<Item = Vec<Node>>) -> Vec<Node> {
    let mut nodes = Vec::new();
    for operand in operands {
        let is_first = nodes.is_empty();
        nodes.extend(operand);
        if !is_first {
            nodes.push(operator);
        }
    }
    nodes
}

/// What was made of numbers that stand in this source: if they are refused, the source is wrong.
fn valid<T, E: Display>(made: Result<T, E>) -> T {
    made.unwrap_or_else(|error| panic!("a scene of the gallery: {error}"))
}

#[cfg(test)]
mod tests {
    use super::{all, by_name, names};

    #[test]
    fn every_scene_is_a_program_under_its_own_name() {
        let scenes = all();
        assert_eq!(names().len(), scenes.len());
        for (scene, name) in scenes.iter().zip(names()) {
            assert_eq!(scene.name, name);
            assert_eq!(by_name(name).map(|found| found.nodes), Some(scene.nodes.clone()));
            assert!(scene.program().is_ok(), "{name}");
        }
        assert!(by_name("s6").is_none());
    }

    #[test]
    fn leaves_are_as_many_as_the_solids_named() {
        let leaves = all()
            .iter()
            .map(|scene| scene.program().map_or(0, |program| program.leaves()))
            .collect::<Vec<_>>();
        assert_eq!(leaves[..5], [2, 5, 64, 4096, 1280]);
    }
}
