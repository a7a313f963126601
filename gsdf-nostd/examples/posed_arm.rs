//! A scene in flash with a joint that moves: each frame poses the arm anew and looks at it, without rebuilding
//! anything.
//!
//! `cargo run --release --package gsdf-nostd --example posed_arm`

use core::f32::consts::PI;
use glam::{Mat3, Vec3, vec3};
use gsdf_nostd::{Camera, CappedCylinder, Capsule, Cuboid, Sphere, Transform, csg};

csg! {
    /// A stand in the world and an arm in frame 1, whose origin is the joint.
    const ROBOT = union(
        Cuboid::new(vec3(-0.6, -1.0, -0.6), vec3(0.6, -0.8, 0.6)),
        CappedCylinder::new(vec3(0.0, -0.8, 0.0), Vec3::ZERO, Vec3::Y, 0.15),
        posed(1, union(
            Sphere::new(Vec3::ZERO, 0.25),
            difference(
                Capsule::new(Vec3::ZERO, vec3(1.2, 0.0, 0.0), 0.18),
                Sphere::new(vec3(1.4, 0.0, 0.0), 0.18)
            )
        ))
    )
}

fn main() -> Result<(), Box<dyn core::error::Error>> {
    let raster = Camera::orthographic(vec3(0.0, 0.0, -5.0), Vec3::ZERO, Vec3::Y, 1.4)?.raster(48, 48);
    let mut scratch = ROBOT.scratch();
    for frame in 0..4_u8 {
        let swing = Mat3::from_rotation_z(f32::from(frame) * PI / 6.0);
        let pose = [Transform::affine(swing, Vec3::ZERO)?];
        let program = ROBOT.program().posed(&pose)?;
        println!("the arm at {} degrees", 30 * frame);
        // A character cell is about twice as high as wide.
        for y in (0..raster.height()).step_by(2) {
            let mut line = String::new();
            for x in 0..raster.width() {
                let hit = program.along(raster.ray(x, y)?, &mut scratch)?.cast();
                line.push(hit.map_or(' ', |hit| shade(hit.normal)));
            }
            println!("{}", line.trim_end());
        }
    }
    Ok(())
}

/// A character as dark as the surface would be with the light at the upper left.
fn shade(normal: Vec3) -> char {
    let brightness = normal.dot(vec3(-0.5, 0.7, -0.5)).max(0.0);
    let ramp = ['.', ':', '-', '=', '+', '*', '#', '@'];
    ramp.into_iter().rev().nth((brightness * 7.99) as usize).unwrap_or('.')
}
