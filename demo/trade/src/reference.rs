//! Scenes on which other renderers were measured, and one of them from far away.

use crate::subject::Subject;
use anyhow::{Context, Result};
use glam::Vec3;
use gsdf_nostd::Camera;
use gsdf_workload::scenes::{S1, S2};

/// The names of the scenes: a ball on the ground, a drilled block, and the block a thousand times as far away, through a lens
/// that shows it as large.
pub const NAMES: [&str; 3] = ["s1", "s2", "s2-far"];

/// How many times as far.
const FARTHER: f32 = 1000.0;

/// How far tracers go: to the end of the scenes, and some.
const FAR: f32 = 10_000.0;

/// The scene of a name, seen in a picture of so many pixels along each side.
///
/// # Errors
/// Where there is none of that name.
pub fn reference(name: &str, size: u32) -> Result<Subject<'static>> {
    let (scene, times) = match name {
        "s1" => Some((&S1, 1.0)),
        "s2" => Some((&S2, 1.0)),
        "s2-far" => Some((&S2, FARTHER)),
        _ => None,
    }
    .with_context(|| format!("no scene {name}: there are {}", NAMES.join(", ")))?;
    let camera = Camera::pinhole(scene.eye * times, scene.target, Vec3::Y, scene.tangent / times)?;
    Subject::new(name, scene.program, camera.raster(size, size), FAR)
}
