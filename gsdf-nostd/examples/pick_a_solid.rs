//! What is under the pointer? A ray through a pixel, the leaf it meets and where, and what lies behind it.
//!
//! `cargo run --release --package gsdf-nostd --example pick_a_solid`, or with the column and row of a pixel of 640 x 480
//! after `--`

use core::error::Error;
use glam::{Vec3, vec3};
use gsdf_nostd::{Camera, CappedCylinder, Cuboid, Sphere, csg};

csg! {
    /// A mug on a table, with a ball beside it.
    const TABLE = union(
        Cuboid::new(vec3(-2.0, -0.2, -1.5), vec3(2.0, 0.0, 1.5)),
        difference(
            CappedCylinder::new(vec3(-0.6, 0.0, 0.0), vec3(-0.6, 1.2, 0.0), Vec3::Y, 0.5),
            CappedCylinder::new(vec3(-0.6, 0.1, 0.0), vec3(-0.6, 1.3, 0.0), Vec3::Y, 0.4)
        ),
        Sphere::new(vec3(0.8, 0.5, 0.0), 0.5)
    )
}

/// Leaves are numbered in the order in which they are written.
const NAMES: [&str; 4] = ["the table", "the mug", "the inside of the mug", "the ball"];

fn name(leaf: u32) -> &'static str {
    NAMES.get(leaf as usize).copied().unwrap_or("something new")
}

fn main() -> Result<(), Box<dyn Error>> {
    let raster = Camera::pinhole(vec3(1.0, 3.0, -5.0), vec3(0.0, 0.4, 0.0), Vec3::Y, 0.4)?.raster(640, 480);
    let arguments: Vec<u32> = std::env::args().skip(1).map(|number| number.parse()).collect::<Result<_, _>>()?;
    let clicks: &[[u32; 2]] = match arguments[..] {
        [] => &[[200, 160], [230, 260], [430, 230], [320, 330], [20, 20]],
        [x, y] => &[[x, y]],
        _ => return Err("give a column and a row, or nothing".into()),
    };
    for &[x, y] in clicks {
        let ray = raster.ray(x, y)?;
        // The parameter counts lengths of the direction, so a distance is their product.
        let speed = ray.direction().length();
        match TABLE.cast(&ray) {
            None => println!("({x}, {y}): nothing"),
            Some(hit) => {
                println!("({x}, {y}): {}, {:.3} away, at {:.3}", name(hit.leaf), hit.t * speed, hit.point);
                // All surfaces behind the first, in order; ray and program are the same, so nothing is met twice.
                for behind in TABLE.crossings(ray).skip(1) {
                    let way = if behind.entering { "into" } else { "out of" };
                    println!(
                        "            then {way} the solid at {}, {:.3} away",
                        name(behind.leaf),
                        behind.t * speed
                    );
                }
            }
        }
    }
    Ok(())
}
