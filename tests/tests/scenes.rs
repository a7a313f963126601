//! The reference scenes at full size: single against double precision, pixel by pixel.

use gsdf_demo::scenes::{self, Scene};
use gsdf_nostd::{Lane, March, Program, Raster, Span};
use gsdf_tests::tiles::{Part, parts, visible};
use rayon::prelude::*;

const SIZE: u32 = 1024;
const TILE: u32 = 32;

/// In how many pixels the masks may differ.
const ALLOWED: usize = 32;

/// Which pixels show the scene, in the arithmetic of `like`.
fn mask<T: Lane + Send + Sync>(scene: &Scene, like: T) -> Vec<bool> {
    let raster = scene.camera.raster(SIZE, SIZE);
    let parts = parts(&scene.nodes);
    let mut mask = vec![false; (SIZE * SIZE) as usize];
    mask.par_chunks_mut((SIZE * TILE) as usize)
        .zip(0..SIZE / TILE)
        .for_each(|(band, row)| {
            for column in 0..SIZE / TILE {
                fill_tile(&parts, &raster, (column * TILE, row * TILE), like, band);
            }
        });
    mask
}

fn fill_tile<T: Lane>(parts: &[Part<'_>], raster: &Raster, from: (u32, u32), like: T, band: &mut [bool]) {
    let nodes = visible(parts, raster, from, (from.0 + TILE, from.1 + TILE)).unwrap();
    if nodes.is_empty() {
        return;
    }
    let program = Program::new(&nodes).unwrap();
    let (enter, exit) = (like.splat_like(f32::INFINITY), like.splat_like(f32::NEG_INFINITY));
    let mut scratch = vec![Span { enter, exit }; program.leaves()];
    for y in 0..TILE {
        for x in 0..TILE {
            let ray = raster.ray(from.0 + x, from.1 + y).unwrap();
            let March::<T> { t, .. } = program.along(ray, &mut scratch).unwrap().march();
            band[(y * SIZE + from.0 + x) as usize] = t < like.splat_like(f32::INFINITY);
        }
    }
}

/// Whether a pixel has a neighbour on the other side of the mask's edge.
fn is_on_rim(mask: &[bool], pixel: usize) -> bool {
    let (x, y) = (pixel as u32 % SIZE, pixel as u32 / SIZE);
    let near = |v: u32| v.saturating_sub(1)..=(v + 1).min(SIZE - 1);
    near(y).any(|row| near(x).any(|column| mask[(row * SIZE + column) as usize] != mask[pixel]))
}

fn count(mask: &[bool]) -> usize {
    mask.iter().filter(|&&hit| hit).count()
}

/// `hits` is what programs that share nothing with this one count, in double precision.
fn check(scene: &Scene, hits: usize) {
    let single = mask(scene, 0.0_f32);
    let double = mask(scene, 0.0_f64);
    let differing: Vec<_> = (0..single.len()).filter(|&pixel| single[pixel] != double[pixel]).collect();
    println!(
        "{}: {} hits, {} in double precision, {} pixels differ",
        scene.name,
        count(&single),
        count(&double),
        differing.len()
    );
    assert!(differing.len() <= ALLOWED, "{}: {} pixels differ", scene.name, differing.len());
    for &pixel in &differing {
        assert!(is_on_rim(&double, pixel), "{}: pixel {pixel} differs away from any rim", scene.name);
    }
    assert!(
        count(&double).abs_diff(hits) <= 12,
        "{}: {} hits, not about {hits}",
        scene.name,
        count(&double)
    );
}

#[test]
fn s1_ball_on_ground() {
    check(&scenes::s1(), 804_070);
}

#[test]
fn s2_drilled_block() {
    check(&scenes::s2(), 481_502);
}

#[test]
fn s3_grid_of_solids() {
    check(&scenes::s3(), 432_812);
}

#[test]
fn s4_grid_of_spheres() {
    check(&scenes::s4(), 548_908);
}

#[test]
fn s5_field_of_blocks() {
    check(&scenes::s5(), 405_006);
}

/// What the tiles leave out is not seen: the whole scene gives the same mask.
#[test]
fn tiles_change_nothing() {
    let scene = scenes::s3();
    let raster = scene.camera.raster(SIZE, SIZE);
    let program = scene.program().unwrap();
    let tiled = mask(&scene, 0.0_f32);
    let rows: Vec<u32> = (0..SIZE).step_by(16).collect();
    rows.into_par_iter().for_each(|y| {
        let mut scratch = vec![Span::EMPTY; program.leaves()];
        for x in 0..SIZE {
            let ray = raster.ray(x, y).unwrap();
            let hit = program.along(ray, &mut scratch).unwrap().cast().is_some();
            assert_eq!(hit, tiled[(y * SIZE + x) as usize], "pixel {x}, {y}");
        }
    });
}
