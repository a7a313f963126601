//! A picture of distances: rendered on all cores, shown as text, and written as a grey image if a path is given.
//!
//! `cargo run --release --package gsdf-simd --example depth_map -- depth.png`

use core::error::Error;
use glam::{Vec3, vec3};
use gsdf_nostd::{Camera, CappedCylinder, Cuboid, Sphere, csg};
use gsdf_simd::{Planes, Renderer, Scene};
use image::{ImageBuffer, Luma};
use std::time::Instant;

csg! {
    /// A hollowed ball with six round windows, on a slab.
    const LANTERN = union(
        difference(
            Sphere::new(Vec3::ZERO, 1.0),
            Sphere::new(Vec3::ZERO, 0.85),
            CappedCylinder::new(vec3(-2.0, 0.0, 0.0), vec3(2.0, 0.0, 0.0), Vec3::X, 0.45),
            CappedCylinder::new(vec3(0.0, -2.0, 0.0), vec3(0.0, 2.0, 0.0), Vec3::Y, 0.45),
            CappedCylinder::new(vec3(0.0, 0.0, -2.0), vec3(0.0, 0.0, 2.0), Vec3::Z, 0.45)
        ),
        Sphere::new(Vec3::ZERO, 0.3),
        Cuboid::new(vec3(-1.4, -1.1, -1.4), vec3(1.4, -0.95, 1.4))
    )
}

const WIDTH: u32 = 960;
const HEIGHT: u32 = 720;

fn main() -> Result<(), Box<dyn Error>> {
    // A scene is prepared once, and a renderer can look at it from as many places as one likes.
    let scene = Scene::new(LANTERN.program());
    let camera = Camera::pinhole(vec3(1.8, 1.6, -3.6), vec3(0.0, -0.02, 0.0), Vec3::Y, 0.36)?;
    let mut renderer = Renderer::new(&scene, camera.raster(WIDTH, HEIGHT));
    let mut depth = vec![0.0; (WIDTH * HEIGHT) as usize];
    let start = Instant::now();
    let effort = renderer.render(Planes {
        distance: &mut depth,
        normal: None,
        leaf: None,
        stride: WIDTH as usize,
        width: WIDTH,
        height: HEIGHT,
    });
    println!("{} of {} pixels hit, in {:.1?}", effort.hits, depth.len(), start.elapsed());

    // White is near and black far; where nothing is, the depth is infinite.
    let hits = || depth.iter().copied().filter(|depth| depth.is_finite());
    let (nearest, farthest) = (hits().fold(f32::INFINITY, f32::min), hits().fold(0.0, f32::max));
    println!("depths from {nearest:.3} to {farthest:.3}");
    let brightness = |depth: f32| ((farthest - depth) / (farthest - nearest)).max(0.0);
    let ramp: Vec<char> = " .:-=+*#%@".chars().collect();
    for y in (0..HEIGHT as usize).step_by(24) {
        let shown = (0..WIDTH as usize)
            .step_by(12)
            .map(|x| ramp[(brightness(depth[y * WIDTH as usize + x]) * 9.0) as usize]);
        println!("{}", shown.collect::<String>().trim_end());
    }
    if let Some(path) = std::env::args_os().nth(1) {
        // 16 bits keep more of a depth than an eye sees.
        let grey = depth
            .iter()
            .map(|depth| (brightness(*depth) * f32::from(u16::MAX)) as u16)
            .collect();
        let picture: ImageBuffer<Luma<u16>, Vec<u16>> = ImageBuffer::from_raw(WIDTH, HEIGHT, grey).ok_or("a picture of another size")?;
        picture.save(&path)?;
    }
    Ok(())
}
