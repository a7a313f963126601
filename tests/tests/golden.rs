//! The reference scenes at full size have these bits, in every arithmetic, at every level and on any number of threads, in
//! default and native builds, for ever.
//!
//! A hash that changes on purpose is a change of results for every user: say so in the commit that changes it.

use gsdf_demo::scenes;
use gsdf_simd::{Level, Pixel, Records, Renderer, Scene};
use gsdf_tests::conformance::contracted::Contracted;
use gsdf_tests::golden::{hash, scalar_picture, staged_picture};
use rayon::ThreadPoolBuilder;

const SIZE: u32 = 1024;

const S1: u64 = 0xbfcd_7c6b_457f_b291;
const S2: u64 = 0xeb9a_3143_3134_ea35;
const S3: u64 = 0x1394_b776_f4d2_a5ed;
const S4: u64 = 0x85c7_51e4_f131_a77d;
const S5: u64 = 0xc924_ee7a_8d5c_3305;

fn scalar(scene: &scenes::Scene) -> Vec<Pixel> {
    scalar_picture(&scene.program().unwrap(), &scene.camera.raster(SIZE, SIZE)).unwrap()
}

/// In packets, through what each tile sees of the scene.
fn packets(scene: &scenes::Scene, level: Level, threads: usize) -> Vec<Pixel> {
    let mut pixels = vec![Pixel::NOTHING; (SIZE * SIZE) as usize];
    let prepared = Scene::new(scene.program().unwrap());
    let mut renderer = Renderer::at_level(&prepared, scene.camera.raster(SIZE, SIZE), level);
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| renderer.render(Records::new(&mut pixels, SIZE, SIZE)));
    pixels
}

/// The row of a table: what was cast how, what came out, and what should have.
fn check(row: &str, scene: &scenes::Scene, pixels: &[Pixel], golden: u64) {
    let found = hash(pixels);
    assert_eq!(found, golden, "{}, {row}: {found:#018x}, not {golden:#018x}", scene.name);
}

macro_rules! golden {
    ($($name:ident: $scene:path, $golden:ident;)+) => {$(
        mod $name {
            use super::*;

            #[test]
            fn scalar() {
                let scene = $scene();
                check("scalar", &scene, &super::scalar(&scene), $golden);
            }

            #[test]
            fn packets_at_every_level() {
                let scene = $scene();
                for level in Level::available() {
                    check(&format!("packets at level {level}"), &scene, &packets(&scene, level, 1), $golden);
                }
            }

            #[test]
            fn packets_on_two_threads() {
                let scene = $scene();
                check("packets, 2 threads", &scene, &packets(&scene, Level::best(), 2), $golden);
            }
        }
    )+};
}

golden! {
    s1: scenes::s1, S1;
    s2: scenes::s2, S2;
    s3: scenes::s3, S3;
    s4: scenes::s4, S4;
    s5: scenes::s5, S5;
}

/// The hashes see a fused multiply-add: of two arithmetics through the same text, the one that fuses has other bits in
/// every scene.
#[test]
fn a_fused_multiply_add_changes_every_hash() {
    for (scene, golden) in [
        (scenes::s1(), S1),
        (scenes::s2(), S2),
        (scenes::s3(), S3),
        (scenes::s4(), S4),
        (scenes::s5(), S5),
    ] {
        let (program, raster) = (scene.program().unwrap(), scene.camera.raster(SIZE, SIZE));
        check("stages", &scene, &staged_picture(&program, &raster, 0.0_f32).unwrap(), golden);
        let fused = staged_picture(&program, &raster, Contracted::from(0.0)).unwrap();
        assert_ne!(hash(&fused), golden, "{}: fused, and yet the same", scene.name);
    }
}

/// A hash that did not look at every field of every pixel would guard nothing.
#[test]
fn every_bit_of_every_pixel_counts() {
    let pixels = vec![
        Pixel {
            distance: 1.0,
            normal: [0.0, 0.6, 0.8],
            leaf: 3
        };
        9
    ];
    let original = hash(&pixels);
    // The hash of nothing is the offset basis that the algorithm's authors chose.
    assert_eq!(hash(&[]), 0xcbf2_9ce4_8422_2325);
    let mutations: [fn(&mut Pixel); 6] = [
        |pixel| pixel.distance = pixel.distance.next_up(),
        |pixel| pixel.normal[0] = -pixel.normal[0],
        |pixel| pixel.normal[1] = pixel.normal[1].next_up(),
        |pixel| pixel.normal[2] = pixel.normal[2].next_down(),
        |pixel| pixel.leaf += 1,
        |pixel| *pixel = Pixel::NOTHING,
    ];
    for place in 0..pixels.len() {
        for mutate in mutations {
            let mut changed = pixels.clone();
            mutate(&mut changed[place]);
            assert_ne!(hash(&changed), original, "pixel {place}");
        }
    }
}
