//! A scene as a microcontroller has it: one constant, checked by the compiler, with a size known beforehand. Reads a sensor
//! of eight zones, which stack and time both have a bound for.
//!
//! `cargo run --release --package gsdf-nostd --example scene_in_flash`

use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCylinder, Csg, Cuboid, Ray, RayError, Sphere, csg, leaf_set};

leaf_set! {
    /// Just the solids this device knows: no formula of another is linked, and no node is larger than these are.
    enum Part { Cuboid(Cuboid), CappedCylinder(CappedCylinder), Sphere(Sphere) }
}

csg! {
    /// A bottling line in millimetres: a belt, a bottle, and its neck, which is open.
    const LINE: Part = union(
        Cuboid::new(vec3(-400.0, -60.0, -10.0), vec3(400.0, 60.0, 0.0)),
        difference(
            union(
                CappedCylinder::new(Vec3::ZERO, vec3(0.0, 0.0, 180.0), Vec3::Z, 38.0),
                Sphere::new(vec3(0.0, 0.0, 180.0), 38.0),
                CappedCylinder::new(vec3(0.0, 0.0, 180.0), vec3(0.0, 0.0, 270.0), Vec3::Z, 14.0)
            ),
            CappedCylinder::new(vec3(0.0, 0.0, 200.0), vec3(0.0, 0.0, 280.0), Vec3::Z, 11.0)
        )
    )
}

/// A `static` is one copy, which the linker leaves in flash; a `const` may be copied to where it is used.
static SCENE: Csg<9, Part> = LINE;

/// What the compiler knows already can be asserted to it: the board has two kilobytes to spare.
const _: () = assert!(size_of::<Csg<9, Part>>() <= 2048, "the scene has outgrown its place");

fn main() -> Result<(), RayError> {
    println!(
        "program:      {} leaves in {} nodes, {} bytes of flash",
        SCENE.leaves(),
        SCENE.nodes().len(),
        size_of_val(&SCENE)
    );
    println!(
        "working room: {} bytes of stack, given by the caller",
        size_of_val(&SCENE.scratch())
    );
    println!(
        "worst case:   {} sweeps along any ray; its first crossing usually takes two",
        SCENE.program().max_sweeps()
    );
    // The sensor hangs over the belt and looks down; in the middle it looks into the neck.
    for zone in 0..8_u8 {
        let x = f32::from(zone) * 12.0 - 48.0;
        match SCENE.cast(&Ray::new(vec3(x, 0.0, 400.0), Vec3::NEG_Z)?) {
            Some(hit) => println!("at {x:>5.1}: {:>7.3} mm, leaf {}", hit.t, hit.leaf),
            None => println!("at {x:>5.1}: nothing"),
        }
    }
    Ok(())
}
