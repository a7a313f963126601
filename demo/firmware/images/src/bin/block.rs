//! A ray cast at a drilled block: a box, a sphere and three cylinders under differences and an intersection.
#![no_std]
#![no_main]

use glam::{Vec3, vec3};
use gsdf_firmware::{ask, board};
use gsdf_nostd::{CappedCylinder, Csg, Cuboid, Sphere, csg, leaf_set};

leaf_set! {
    /// The solids of the scene, so that no others are linked.
    enum Part { Cuboid(Cuboid), Sphere(Sphere), CappedCylinder(CappedCylinder) }
}

csg! {
    /// A rounded block with a hole along each axis.
    const BLOCK: Part = difference(
        intersection(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(Vec3::ZERO, 1.35)),
        CappedCylinder::new(vec3(-1.5, 0.0, 0.0), vec3(1.5, 0.0, 0.0), Vec3::X, 0.6),
        CappedCylinder::new(vec3(0.0, -1.5, 0.0), vec3(0.0, 1.5, 0.0), Vec3::Y, 0.6),
        CappedCylinder::new(vec3(0.0, 0.0, -1.5), vec3(0.0, 0.0, 1.5), Vec3::Z, 0.6)
    )
}

/// The scene, in flash.
static SCENE: Csg<9, Part> = BLOCK;

#[board::entry]
fn main() -> ! {
    ask(&SCENE);
    board::stop()
}
