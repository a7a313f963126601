//! Certified pictures against a certified cast of each pixel's ray, bit for bit, at every level.

use gsdf_demo::scenes;
use gsdf_nostd::glam::{Vec3, vec3};
use gsdf_nostd::{Bounded, Camera, Certified, CertifiedScratch, Program, Raster, Settled, Span};
use gsdf_simd::{Certificates, Level, Pixel, Renderer, Scene, TILE_SIDE, Target, Tile, Wants};
use gsdf_tests::conformance::packet::Composed;
use gsdf_tests::shape::{log_uniform, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// What is known of a pixel.
type Known = (Pixel, u32, f32, Settled);

/// Rows of a picture with its certificates.
struct Rows<'r> {
    pixels: &'r mut [Known],
    width: usize,
}

impl Rows<'_> {
    /// The pixels that a tile covers, with their places in it.
    fn covered(&mut self, x: u32, y: u32) -> impl Iterator<Item = (&mut Known, [usize; 2])> {
        let rows = self.pixels.chunks_exact_mut(self.width).skip(y as usize).take(TILE_SIDE);
        rows.enumerate().flat_map(move |(down, row)| {
            let row = row.iter_mut().skip(x as usize).take(TILE_SIDE);
            row.enumerate().map(move |(right, known)| (known, [right, down]))
        })
    }
}

impl Target for Rows<'_> {
    fn wants(&self) -> Wants {
        Wants::NORMALS_AND_FACES
    }

    fn split_at(self, row: u32) -> (Self, Self) {
        let middle = (row as usize * self.width).min(self.pixels.len());
        let (above, below) = self.pixels.split_at_mut(middle);
        let of = |pixels| Rows { pixels, width: self.width };
        (of(above), of(below))
    }

    fn put(&mut self, x: u32, y: u32, tile: &Tile) {
        for (known, [right, down]) in self.covered(x, y) {
            (known.0, known.1) = (tile.pixel(right, down), tile.face[Tile::index(right, down)]);
        }
    }

    fn certify(&mut self, x: u32, y: u32, certificates: &Certificates) {
        for (known, [right, down]) in self.covered(x, y) {
            let pixel = Tile::index(right, down);
            (known.2, known.3) = (certificates.bound[pixel], certificates.settled[pixel]);
        }
    }
}

/// How pixels were settled by single rays, and those that the picture settled sooner.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    single: u64,
    double: u64,
    tie: u64,
    sooner: u64,
    hits: u64,
}

impl Count {
    fn joined(self, other: Self) -> Self {
        Self {
            single: self.single + other.single,
            double: self.double + other.double,
            tie: self.tie + other.tie,
            sooner: self.sooner + other.sooner,
            hits: self.hits + other.hits,
        }
    }
}

fn check(program: &Program<'_>, raster: Raster, what: &str) -> Count {
    let scene = Scene::new(*program);
    let leaves = program.leaves();
    let mut single = vec![Span::empty_like(Bounded::exact(0.0)); leaves];
    let mut double = vec![Span::empty_like(Bounded::exact(0.0)); leaves];
    let mut tie = vec![Span::empty_like(0.0); leaves];
    let (width, height) = (raster.width(), raster.height());
    let mut count = Count::default();
    let expected: Vec<Certified> = (0..width * height)
        .map(|pixel| {
            let scratch = CertifiedScratch {
                single: &mut single,
                double: &mut double,
                tie: &mut tie,
            };
            let ray = raster.ray(pixel % width, pixel / width).unwrap();
            let found = program.cast_certified(&ray, scratch).unwrap();
            match found.settled {
                Settled::Single => count.single += 1,
                Settled::Double => count.double += 1,
                Settled::Tie => count.tie += 1,
            }
            count.hits += u64::from(found.hit.is_some());
            found
        })
        .collect();
    for level in Level::available() {
        let nothing = (Pixel::NOTHING, 7, -1.0, Settled::Tie);
        let mut pixels = vec![nothing; (width * height) as usize];
        let rows = Rows {
            pixels: &mut pixels,
            width: width as usize,
        };
        let effort = Renderer::certified_at_level(&scene, raster, level).render(rows);
        let seen = pixels.iter().filter(|(pixel, ..)| pixel.leaf != Pixel::NO_LEAF).count();
        assert_eq!(effort.hits, seen as u64, "{what}, {level}");
        count.sooner = 0;
        for ((number, (pixel, face, bound, settled)), expected) in pixels.iter().enumerate().zip(&expected) {
            let from = || format!("{what}, {level}, pixel {number}: {pixel:?} {bound} {settled:?}, not {expected:?}");
            assert!(*settled <= expected.settled, "{}", from());
            if *settled < expected.settled {
                count.sooner += 1;
                let near = |t: f32| (t - pixel.distance).abs() <= bound + expected.bound.min(1e-5 * t);
                assert!(
                    expected.hit.map_or(pixel.distance == f32::INFINITY, |hit| near(hit.t)),
                    "{}",
                    from()
                );
                continue;
            }
            let own = match expected.hit {
                Some(hit) => (hit.t, hit.normal.to_array(), hit.leaf, u32::from(hit.face)),
                None => (f32::INFINITY, [0.0; 3], Pixel::NO_LEAF, 0),
            };
            assert_eq!((pixel.distance, pixel.normal, pixel.leaf, *face), own, "{}", from());
            assert_eq!(*bound, expected.bound, "{}", from());
        }
    }
    count
}

#[test]
fn random_programs() {
    let counts = (0..400_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let composed = Composed::random(&mut rng);
        let eye = unit(&mut rng).as_vec3() * log_uniform(&mut rng, 0.1, 100.0) as f32;
        let (target, tangent) = (unit(&mut rng).as_vec3(), rng.random_range(0.02..1.0));
        let camera = if rng.random_range(0..4) == 0 {
            Camera::orthographic(eye, target, Vec3::Y, 1.5)
        } else {
            Camera::pinhole(eye, target, Vec3::Y, tangent)
        };
        let raster = camera.unwrap().raster(21, 18);
        check(&composed.program(), raster, &format!("seed {seed}"))
    });
    let count = counts.reduce(Count::default, Count::joined);
    println!("{count:?}");
    assert!(count.hits > 20_000 && count.single > 100_000, "{count:?}");
    assert!(count.double > 100 && count.tie > 100 && count.sooner > 10, "{count:?}");
}

/// Scenes of many parts from near, from far and from within.
#[test]
fn scenes_of_many_parts() {
    for scene in [scenes::s3(), scenes::s5(), scenes::planetary(), scenes::hollow()] {
        let program = scene.program().unwrap();
        let far = Camera::pinhole(vec3(900.0, 1100.0, -800.0), Vec3::ZERO, Vec3::Y, 0.01).unwrap();
        let within = Camera::pinhole(vec3(0.3, 0.2, 0.1), vec3(3.0, 1.0, 2.0), Vec3::Y, 1.0).unwrap();
        for camera in [scene.camera, far, within] {
            let count = check(&program, camera.raster(40, 35), scene.name);
            assert!(count.single > 50, "{}: {count:?}", scene.name);
        }
    }
}
