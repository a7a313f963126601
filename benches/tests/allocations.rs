//! A renderer allocates for its first picture, and no more. The whole process is watched: so this is a program of its own, without a harness, whose threads allocate as they please.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gsdf_benches::scenes::Scene;
use gsdf_simd::{Level, Pixel, Records, Renderer, Tiles};
use rayon::ThreadPoolBuilder;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const SIZE: u32 = 100;

/// Scenes, and on how many threads. Who finds complements keeps room for as many as a tile of his has met: on several threads a later picture may bring him a tile that has more.
const SCENES: [(&str, &[usize]); 7] = [
    ("s1", &[1, 2]),
    ("s2", &[1]),
    ("s3", &[1, 2]),
    ("s4", &[1, 2]),
    ("s5", &[1]),
    ("s6-22", &[1, 2]),
    ("s7", &[1]),
];

fn main() {
    // Threads allocate where they start and end, and where one takes work from another for the first time: all of that is over before anybody counts.
    let pools = [1, 2].map(|threads| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.broadcast(|_| rayon::yield_now());
        pool
    });
    for (name, threads) in SCENES {
        let scene = Scene::by_name(name).unwrap();
        let prepared = gsdf_simd::Scene::new(scene.program().unwrap());
        let raster = scene.camera.raster(SIZE, SIZE);
        for pool in pools.iter().filter(|pool| threads.contains(&pool.current_num_threads())) {
            let threads = pool.current_num_threads();
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
                    [counted(), (0..4).map(|_| counted()).sum()]
                });
                assert!(first > 0, "{name}, {level}: nobody counts");
                assert_eq!(after, 0, "{name}, {level}, {threads} threads: a later picture allocates");
            }
        }
    }
}
