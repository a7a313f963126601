//! How far does the hand see? An arm with two joints, posed at run time: for each angle of the elbow, the range of a sensor in
//! the palm, with the arm itself in the way where it is.
//!
//! `cargo run --release --package gsdf-nostd --example posed_joint`

use core::error::Error;
use glam::{Affine3A, Vec3, vec3};
use gsdf_nostd::{Capsule, Cuboid, Invalid, Ray, Sphere, Transform, csg};

csg! {
    /// Millimetres. A cell, open on one side, and a crate in the world; the upper arm in frame 1, the forearm in frame 2,
    /// each starting at its joint and pointing along its own x.
    const WORKPLACE = union(
        difference(
            Cuboid::new(vec3(-920.0, -920.0, -20.0), vec3(900.0, 920.0, 1220.0)),
            Cuboid::new(vec3(-900.0, -900.0, 0.0), vec3(900.0, 900.0, 1200.0))
        ),
        Cuboid::new(vec3(350.0, -150.0, 0.0), vec3(650.0, 150.0, 200.0)),
        posed(1, union(Sphere::new(Vec3::ZERO, 60.0), Capsule::new(Vec3::ZERO, vec3(300.0, 0.0, 0.0), 40.0))),
        posed(2, union(Sphere::new(Vec3::ZERO, 50.0), Capsule::new(Vec3::ZERO, vec3(220.0, 0.0, 0.0), 30.0)))
    )
}

const NAMES: [&str; 7] = ["outside of the cell", "cell", "crate", "shoulder", "upper arm", "elbow", "forearm"];

/// A map as the library takes it.
fn pose(map: &Affine3A) -> Result<Transform, Invalid> {
    Transform::affine(map.matrix3.into(), map.translation.into())
}

fn main() -> Result<(), Box<dyn Error>> {
    // The shoulder stands still, at 60 degrees above the horizon; a turn about -y lifts.
    let shoulder = Affine3A::from_translation(vec3(0.0, 0.0, 400.0)) * Affine3A::from_rotation_y(-60_f32.to_radians());
    let mut scratch = WORKPLACE.scratch();
    println!("elbow  range  of");
    for degrees in (-180..=180).step_by(15) {
        let bend = Affine3A::from_rotation_y(-(degrees as f32).to_radians());
        let elbow = shoulder * Affine3A::from_translation(vec3(300.0, 0.0, 0.0)) * bend;
        // Nothing is rebuilt: the program stays where it is, and two transforms are all that a pose takes.
        let poses = [pose(&shoulder)?, pose(&elbow)?];
        let program = WORKPLACE.program().posed(&poses)?;
        // The sensor looks out of the end of the forearm, from just before its surface.
        let palm = elbow.transform_point3(vec3(252.0, 0.0, 0.0));
        let ray = Ray::new(palm, elbow.transform_vector3(Vec3::X))?.within(0.0..2000.0)?;
        let sight = program.along(ray, &mut scratch)?;
        match sight.cast() {
            _ if program.contains(palm) => println!("{degrees:>5}  it would hit something"),
            Some(hit) => {
                let name = NAMES.get(hit.leaf as usize).copied().unwrap_or("something new");
                println!("{degrees:>5}  {:>5.1}  {name}", hit.t);
            }
            None => println!("{degrees:>5}      -  nothing within two metres"),
        }
    }
    Ok(())
}
