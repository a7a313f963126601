//! From where shapes are looked at: chance, and the same in every run.

use super::shapes::Shape;
use anyhow::{Context, Result};
use core::f32::consts::TAU;
use glam::{Vec3, vec3};
use gsdf_nostd::{Camera, Program};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Where the eyes are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Outside the shape. Hollows and what was cut away are outside.
    Outside,
    /// Inside the shape.
    Inside,
}

/// How far from the middle of a shape an eye outside may be, in radii.
pub const FARTHEST: f32 = 5.0;

/// The distribution, in words.
#[must_use]
pub fn distribution() -> String {
    format!(
        "Outside: eyes in every direction from the middle of the shape, at distances spread evenly from 0 to {FARTHEST} radii of the ball\n\
         around it, as far as they are outside the shape; each looks at some point of that ball, which fills the picture. Inside: eyes\n\
         spread evenly over the shape, and each looks anywhere, 90 degrees wide."
    )
}

/// So many cameras on one side of a shape. Another `seed`, others; the same, the same.
///
/// # Errors
/// Where no place is found on that side.
pub fn cameras(shape: &Shape, side: Side, count: u32, seed: u64) -> Result<Vec<Camera>> {
    let program = shape.program()?;
    let mut rng = Pcg64::seed_from_u64(seed);
    (0..count).map(|_| camera(shape, program, side, &mut rng)).collect()
}

/// How often a place is tried before a shape is given up.
const TRIES: u32 = 100_000;

fn camera(shape: &Shape, program: Program<'_>, side: Side, rng: &mut Pcg64) -> Result<Camera> {
    let wanted = |eye: &Vec3| program.contains(*eye) == (side == Side::Inside);
    let reach = |rng: &mut Pcg64| match side {
        Side::Outside => direction(rng) * rng.random_range(0.0..FARTHEST),
        Side::Inside => in_ball(rng),
    };
    let eye = (0..TRIES)
        .map(|_| shape.middle + shape.radius * reach(rng))
        .find(wanted)
        .with_context(|| format!("{}: nobody can stand there", shape.name))?;
    let (target, tangent) = match side {
        Side::Outside => {
            let target = shape.middle + shape.radius * in_ball(rng);
            (target, (shape.radius / eye.distance(shape.middle)).clamp(1.0 / FARTHEST, 1.0))
        }
        Side::Inside => (eye + direction(rng), 1.0),
    };
    let up = (target - eye).any_orthogonal_vector();
    Camera::pinhole(eye, target, up, tangent).with_context(|| format!("{}: a camera at {eye}", shape.name))
}

/// A unit vector, all directions alike: height and longitude are spread evenly (Archimedes).
fn direction(rng: &mut Pcg64) -> Vec3 {
    let height: f32 = rng.random_range(-1.0..1.0);
    let (sine, cosine) = rng.random_range(0.0..TAU).sin_cos();
    let across = (1.0 - height * height).sqrt();
    vec3(across * cosine, across * sine, height)
}

/// A point of the unit ball.
fn in_ball(rng: &mut Pcg64) -> Vec3 {
    direction(rng) * rng.random_range(0.0_f32..1.0).cbrt()
}

#[cfg(test)]
mod tests {
    use super::{FARTHEST, Side, cameras};
    use crate::paper::shapes::shapes;
    use anyhow::Result;

    #[test]
    fn eyes_are_where_they_should_be_and_the_same_every_time() -> Result<()> {
        for shape in shapes() {
            let program = shape.program()?;
            for side in [Side::Outside, Side::Inside] {
                let some = cameras(&shape, side, 64, 1)?;
                assert_eq!(some, cameras(&shape, side, 64, 1)?);
                assert_ne!(some, cameras(&shape, side, 64, 2)?);
                for camera in some {
                    assert_eq!(program.contains(camera.eye()), side == Side::Inside, "{}", shape.name);
                    assert!(camera.eye().distance(shape.middle) <= FARTHEST * shape.radius);
                }
            }
        }
        Ok(())
    }
}
