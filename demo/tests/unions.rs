//! Large unions that something is cut from or common with: what prepared scenes leave out of them changes no bit, where faces
//! coincide least of all.

use anyhow::Result;
use glam::{Vec3, vec3};
use gsdf_demo::model::Model;
use gsdf_demo::model::evaluate::Reading;
use gsdf_nostd::{Camera, Program, Raster, Span};
use gsdf_simd::{Caster, Level, Pixel, RayHits, Rays, Renderer, Scene, Tiles, Visible};

/// A grid of cubes, of which every other layer touches the next.
fn grid(side: u32) -> String {
    let mut text = String::from("union() {\n");
    for number in 0..side * side * side {
        let [x, y, z] = [number % side, number / side % side, number / side / side];
        let size = if z % 2 == 0 { 1.0 } else { 0.75 };
        text += &format!("multmatrix([[1,0,0,{x}],[0,1,0,{y}],[0,0,1,{z}],[0,0,0,1]]) cube([{size},{size},{size}]);\n");
    }
    text + "}\n"
}

/// What is cut ends at faces of the grid, in part.
const CUTTER: &str = "union() { cube([3, 3, 8]); multmatrix([[1,0,0,6],[0,1,0,4],[0,0,1,0],[0,0,0,1]]) cube([2, 2.5, 3]); \
    multmatrix([[1,0,0,7],[0,1,0,7],[0,0,1,7],[0,0,0,1]]) sphere(3.3); }\n";

fn models() -> [Model; 4] {
    let grid = grid(8);
    [
        format!("difference() {{ {grid} {CUTTER} }}"),
        format!("intersection() {{ {grid} {CUTTER} }}"),
        // Beside another part, and with what is cut heavier than what it is cut from.
        format!("difference() {{ {grid} {CUTTER} }} multmatrix([[1,0,0,9],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {{ cube(2); }}"),
        format!("difference() {{ cube([8, 8, 8]); {grid} }}"),
    ]
    .map(|text| Model::read(&text, Reading::default()).expect("it is a model"))
}

/// Along the axes every ray meets faces that coincide, and from a corner none; and from within.
fn rasters() -> Result<[Raster; 4]> {
    let middle = Vec3::splat(4.0);
    Ok([
        Camera::orthographic(vec3(4.0, -9.0, 4.0), middle, Vec3::Z, 6.0)?,
        Camera::orthographic(vec3(4.0, 4.0, 20.0), middle, Vec3::Y, 6.0)?,
        Camera::pinhole(vec3(20.0, -12.0, 15.0), middle, Vec3::Z, 0.4)?,
        Camera::pinhole(vec3(7.5, 7.5, 7.5), Vec3::ZERO, Vec3::Z, 0.9)?,
    ]
    .map(|camera| camera.raster(48, 48)))
}

type Bits = Vec<(u32, u32)>;

/// What every ray of a picture finds by itself: distance and leaf.
fn alone(program: Program<'_>, raster: Raster) -> Result<Bits> {
    let mut spans = vec![Span::<f32>::EMPTY; program.leaves()];
    let mut bits = Vec::new();
    for (x, y) in (0..48).flat_map(|y| (0..48).map(move |x| (x, y))) {
        let hit = program.along(raster.ray(x, y)?, &mut spans)?.cast();
        bits.push(hit.map_or((f32::INFINITY.to_bits(), Pixel::NO_LEAF), |hit| (hit.t.to_bits(), hit.leaf)));
    }
    Ok(bits)
}

fn in_tiles(scene: &Scene<'_, gsdf_nostd::Leaf>, raster: Raster, level: Level) -> Bits {
    let mut tiles = Tiles::new(48, 48);
    Renderer::at_level(scene, raster, level).render(tiles.as_target());
    let pixels = (0..48).flat_map(|y| (0..48).map(move |x| (x, y)));
    pixels
        .filter_map(|(x, y)| tiles.pixel(x, y))
        .map(|pixel| (pixel.distance.to_bits(), pixel.leaf))
        .collect()
}

/// Every ray as one of a batch, in an order in which neighbours have nothing in common.
fn in_batches(scene: &Scene<'_, gsdf_nostd::Leaf>, raster: Raster, level: Level) -> Result<Bits> {
    const COUNT: u32 = 48 * 48;
    let order: Vec<u32> = (0..COUNT).map(|number| number * 1009 % COUNT).collect();
    let mut coordinates: [Vec<f32>; 6] = Default::default();
    for pixel in &order {
        let ray = raster.ray(pixel % 48, pixel / 48)?;
        let numbers = ray.origin().to_array().into_iter().chain(ray.direction().to_array());
        for (plane, number) in coordinates.iter_mut().zip(numbers) {
            plane.push(number);
        }
    }
    let [ox, oy, oz, dx, dy, dz] = coordinates.each_ref().map(Vec::as_slice);
    let rays = Rays::new([ox, oy, oz], [dx, dy, dz]);
    let (mut distance, mut leaf) = (vec![0.0; order.len()], vec![0; order.len()]);
    let hits = RayHits {
        leaf: Some(&mut leaf),
        ..RayHits::distances(&mut distance)
    };
    Caster::at_level(scene, level).cast(&rays, hits)?;
    let mut bits = vec![(0, 0); order.len()];
    for (place, pixel) in order.iter().enumerate() {
        bits[*pixel as usize] = (distance[place].to_bits(), leaf[place]);
    }
    Ok(bits)
}

#[test]
fn what_is_left_out_of_large_unions_changes_no_bit() -> Result<()> {
    for (number, model) in models().iter().enumerate() {
        let program = model.program()?;
        let scene = Scene::new(program);
        for raster in rasters()? {
            let alone = alone(program, raster)?;
            let hits = alone.iter().filter(|(_, leaf)| *leaf != Pixel::NO_LEAF).count();
            assert!(hits > 200, "{number}: {hits}");
            for level in Level::available() {
                assert!(in_tiles(&scene, raster, level) == alone, "{number}: tiles at {level}, {raster:?}");
                assert!(
                    in_batches(&scene, raster, level)? == alone,
                    "{number}: batches at {level}, {raster:?}"
                );
            }
        }
    }
    Ok(())
}

/// The program that is found for a square of pixels finds there what the whole one does.
#[test]
fn the_visible_program_is_the_whole_one_where_it_is_seen() -> Result<()> {
    let mut visible = Visible::new();
    for model in &models() {
        let program = model.program()?;
        let scene = Scene::new(program);
        for raster in rasters()? {
            let alone = alone(program, raster)?;
            let mut fewest = program.leaves();
            for (left, top) in (0..48).step_by(8).flat_map(|top| (0..48).step_by(8).map(move |left| (left, top))) {
                scene.visible(&raster, left, top, 8, &mut visible);
                fewest = fewest.min(visible.leaves().len());
                let seen = Program::new(visible.nodes()).ok();
                let mut spans = vec![Span::<f32>::EMPTY; visible.leaves().len()];
                for (x, y) in (top..top + 8).flat_map(|y| (left..left + 8).map(move |x| (x, y))) {
                    let ray = raster.ray(x, y)?;
                    let hit = seen.and_then(|seen| seen.along(ray, &mut spans).ok()?.cast());
                    let bits = hit.map_or((f32::INFINITY.to_bits(), Pixel::NO_LEAF), |hit| {
                        (hit.t.to_bits(), visible.leaves()[hit.leaf as usize])
                    });
                    assert_eq!(bits, alone[(48 * y + x) as usize], "{raster:?} at {x}, {y}");
                }
            }
            assert!(fewest < program.leaves() / 4, "{fewest}");
        }
    }
    Ok(())
}
