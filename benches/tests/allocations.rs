//! A renderer allocates for its first picture, and no more: the whole process is watched, so that this is a program of its own.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gsdf_benches::scenes::Scene;
use gsdf_simd::{Level, Pixel, Records, Renderer, Tiles};
use rayon::ThreadPoolBuilder;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const SIZE: u32 = 200;

/// One test alone: others that ran beside it would be counted too.
#[test]
fn pictures_after_the_first_allocate_nothing() {
    for name in ["s1", "s2", "s3", "s4", "s5", "s6-22", "s7"] {
        let scene = Scene::by_name(name).unwrap();
        let prepared = gsdf_simd::Scene::new(scene.program().unwrap());
        let raster = scene.camera.raster(SIZE, SIZE);
        for threads in [1, 2] {
            let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            for level in Level::available() {
                let mut renderer = Renderer::at_level(&prepared, raster, level);
                let mut tiles = Tiles::new(SIZE, SIZE);
                let mut pixels = vec![Pixel::NOTHING; (SIZE * SIZE) as usize];
                let [first, after] = pool.install(|| {
                    let mut counted = || {
                        let region = Region::new(ALLOCATOR);
                        renderer.look(raster);
                        renderer.render(tiles.as_target());
                        renderer.render(Records::new(&mut pixels, SIZE, SIZE));
                        let change = region.change();
                        change.allocations + change.reallocations
                    };
                    [counted(), (0..5).map(|_| counted()).sum()]
                });
                assert!(first > 0, "{name}, {level}: nobody counts");
                assert_eq!(after, 0, "{name}, {level}, {threads} threads");
            }
        }
    }
}
