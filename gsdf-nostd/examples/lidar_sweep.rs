//! A spinning lidar in a room: one range per degree as a robot would get it, first as a table, then as a map.
//!
//! `cargo run --release --package gsdf-nostd --example lidar_sweep`

use core::error::Error;
use core::f32::consts::TAU;
use glam::{Vec2, Vec3, vec2, vec3};
use gsdf_nostd::{CappedCylinder, Cuboid, Ray, csg};

csg! {
    /// Metres. The walls are one block less the air in it; a doorway, two pillars and a box.
    const ROOM = union(
        difference(
            Cuboid::new(vec3(-4.2, -3.2, 0.0), vec3(4.2, 3.2, 2.5)),
            Cuboid::new(vec3(-4.0, -3.0, 0.0), vec3(4.0, 3.0, 2.5)),
            Cuboid::new(vec3(3.9, -0.5, 0.0), vec3(4.3, 0.6, 2.0))
        ),
        CappedCylinder::new(vec3(-1.5, 1.2, 0.0), vec3(-1.5, 1.2, 2.5), Vec3::Z, 0.3),
        CappedCylinder::new(vec3(1.5, 1.2, 0.0), vec3(1.5, 1.2, 2.5), Vec3::Z, 0.3),
        Cuboid::new(vec3(-3.2, -2.4, 0.0), vec3(-1.6, -1.2, 0.8))
    )
}

/// Where the lidar is, and what it cannot see: what is nearer or farther.
const EYE: Vec3 = vec3(0.2, -0.4, 0.3);
const BLIND: f32 = 0.15;
const FARTHEST: f32 = 6.0;

const COLUMNS: usize = 68;
const ROWS: usize = 27;

fn main() -> Result<(), Box<dyn Error>> {
    let mut map = [[' '; COLUMNS]; ROWS];
    let mut mark = |place: Vec2, letter: char| {
        // Eight cells per metre across, four along: a character is twice as high as wide.
        let cell = vec2(place.x * 8.0 + COLUMNS as f32 / 2.0, ROWS as f32 / 2.0 - place.y * 4.0);
        if let Some(cell) = map.get_mut(cell.y as usize).and_then(|row| row.get_mut(cell.x as usize)) {
            *cell = letter;
        }
    };
    mark(EYE.truncate(), '@');
    println!("degrees  metres");
    for degree in 0..360_u16 {
        let (sin, cos) = (f32::from(degree) / 360.0 * TAU).sin_cos();
        let ray = Ray::new(EYE, vec3(cos, sin, 0.0))?.within(BLIND..FARTHEST)?;
        let hit = ROOM.cast(&ray);
        if let Some(hit) = hit {
            mark(hit.point.truncate(), '#');
        }
        if degree % 30 == 0 {
            println!("{degree:>7}  {}", hit.map_or("nothing".to_owned(), |hit| format!("{:.3}", hit.t)));
        }
    }
    for row in map {
        println!("{}", row.iter().collect::<String>().trim_end());
    }
    Ok(())
}
