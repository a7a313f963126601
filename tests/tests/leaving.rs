//! Batches of rays that leave surfaces against one scalar departure per ray, bit for bit, at every level.

use core::ops::Range;
use glam::{Mat3, Vec3, vec3};
use gsdf_demo::scenes;
use gsdf_nostd::{Departure, Hit, Node, OnSurface, Program, Ray, Span, Transform};
use gsdf_simd::{Caster, Leaving, LengthsDiffer, Level, Pixel, RayHits, Rays, Scene};
use gsdf_tests::conformance::packet::Composed;
use gsdf_tests::shape::{log_uniform, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// A ray that goes on from a hit, and what it meets by itself.
struct Onward {
    hit: Hit,
    slack: f32,
    direction: Vec3,
    range: Range<f32>,
    expected: Option<Hit>,
}

impl Onward {
    /// On from where a ray hits a program, if it does, some way: along the surface as much as straight away, and also inward.
    fn random(rng: &mut Pcg64, program: &Program<'_>, ray: Ray) -> Option<Self> {
        let mut spans = vec![Span::EMPTY; program.leaves()];
        let hit = program.along(ray, &mut spans).unwrap().cast()?;
        let any = unit(rng).as_vec3();
        let along = any - any.dot(hit.normal) * hit.normal;
        let direction = match rng.random_range(0..8) {
            0 => any,
            1 => ray.direction().normalize().reflect(hit.normal),
            2 => along,
            3 => along + 1e-3 * hit.normal,
            // From far away the point is farther from the surface than such a ray comes down to it.
            4..6 => along - log_uniform(rng, 1e-4, 0.1) as f32 * hit.normal,
            _ => any * any.dot(hit.normal).signum(),
        };
        let departure = Departure::new(&hit, direction).ok()?;
        let range = match rng.random_range(0..3) {
            0 => 0.0..rng.random_range(0.1_f32..5.0),
            _ => 0.0..f32::INFINITY,
        };
        let expected = program.along(departure.within(range.clone()).unwrap(), &mut spans).unwrap().cast();
        Some(Self {
            slack: OnSurface::slack(ray.origin(), hit.point),
            hit,
            direction,
            range,
            expected,
        })
    }
}

/// What came of some rays.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    hits: u64,
    misses: u64,
    /// Rays that start inside.
    inside: u64,
}

impl Count {
    fn joined(self, other: Self) -> Self {
        Self {
            hits: self.hits + other.hits,
            misses: self.misses + other.misses,
            inside: self.inside + other.inside,
        }
    }
}

/// Whether rays find together what each finds alone.
fn check(program: &Program<'_>, onward: &[Onward], what: &str) -> Count {
    let plane = |of: &dyn Fn(&Onward) -> f32| onward.iter().map(of).collect::<Vec<_>>();
    let [ox, oy, oz] = [0, 1, 2].map(|axis| plane(&|ray| ray.hit.point[axis]));
    let [dx, dy, dz] = [0, 1, 2].map(|axis| plane(&|ray| ray.direction[axis]));
    let [start, end] = [plane(&|ray| ray.range.start), plane(&|ray| ray.range.end)];
    let slack = plane(&|ray| ray.slack);
    let leaves: Vec<u32> = onward.iter().map(|ray| ray.hit.leaf).collect();
    let faces: Vec<u32> = onward.iter().map(|ray| ray.hit.face.into()).collect();
    let rays = Rays {
        range: Some([&start, &end]),
        leaving: Some(Leaving {
            leaf: &leaves,
            face: &faces,
            slack: &slack,
        }),
        ..Rays::new([&ox, &oy, &oz], [&dx, &dy, &dz])
    };
    let scene = Scene::new(*program);
    for level in Level::available() {
        let caster = Caster::at_level(&scene, level);
        let mut distance = vec![-1.0; onward.len()];
        let [mut x, mut y, mut z] = [distance.clone(), distance.clone(), distance.clone()];
        let (mut leaf, mut face) = (vec![7; onward.len()], vec![7; onward.len()]);
        let hits = RayHits {
            distance: &mut distance,
            normal: Some([&mut x, &mut y, &mut z]),
            leaf: Some(&mut leaf),
            face: Some(&mut face),
        };
        caster.cast(&rays, hits).unwrap();
        let mut any = vec![false; onward.len()];
        caster.any(&rays, &mut any).unwrap();
        for (index, ray) in onward.iter().enumerate() {
            let found = (
                distance[index].to_bits(),
                leaf[index],
                face[index],
                [x[index], y[index], z[index]].map(f32::to_bits),
            );
            let expected = match ray.expected {
                Some(hit) => (hit.t.to_bits(), hit.leaf, hit.face.into(), hit.normal.to_array().map(f32::to_bits)),
                None => (f32::INFINITY.to_bits(), Pixel::NO_LEAF, 0, [0; 3]),
            };
            let from = || {
                let Onward { hit, direction, range, .. } = ray;
                format!("{what}, {level}, ray {index}: {hit:?} along {direction} within {range:?}")
            };
            assert_eq!(found, expected, "{}", from());
            assert_eq!(any[index], ray.expected.is_some(), "{}", from());
        }
    }
    let hits = onward.iter().filter_map(|ray| ray.expected);
    let hits = (hits.clone().count() as u64, hits.filter(|hit| !hit.entering).count() as u64);
    Count {
        hits: hits.0,
        misses: onward.len() as u64 - hits.0,
        inside: hits.1,
    }
}

#[test]
fn random_programs() {
    let counts = (0..3000_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let composed = Composed::random(&mut rng);
        let program = composed.program();
        let mut onward = Vec::new();
        for _ in 0..rng.random_range(1..40) {
            let mut asked = composed.aimed(&mut rng);
            // From far away hits are far off their surfaces.
            if rng.random_range(0..3) == 0 {
                let far = asked.direction.normalize() * log_uniform(&mut rng, 1.0, 1e6) as f32;
                asked.origin -= far;
            }
            let ray = Ray::new(asked.origin, asked.direction).unwrap();
            onward.extend(Onward::random(&mut rng, &program, ray));
        }
        check(&program, &onward, &format!("seed {seed}"))
    });
    let count = counts.reduce(Count::default, Count::joined);
    assert!(count.hits > 3000 && count.misses > 9000 && count.inside > 1000, "{count:?}");
}

/// Scenes of more leaves than rays are taken through together that go different ways, in a frame of their own too.
#[test]
fn scenes_of_many_parts() {
    for scene in [scenes::s4(), scenes::s5(), scenes::planetary()] {
        let at_rest = scene.program().unwrap();
        let posed: Vec<_> = (at_rest.nodes().iter())
            .map(|node| match node {
                Node::Leaf { solid, .. } => Node::Leaf { solid: *solid, frame: 1 },
                other => *other,
            })
            .collect();
        let stretched = Mat3::from_axis_angle(vec3(0.6, 0.0, 0.8), 0.7) * Mat3::from_diagonal(vec3(0.5, 2.0, 1.0));
        let poses = [Transform::affine(stretched, vec3(0.2, 0.9, 0.1)).unwrap()];
        let posed = Program::new(&posed).unwrap().posed(&poses).unwrap();
        for program in [at_rest, posed] {
            let counts = (0..8_u64).into_par_iter().map(|seed| {
                let mut rng = Pcg64::seed_from_u64(seed);
                let mut onward = Vec::new();
                while onward.len() < 60 {
                    let origin = unit(&mut rng).as_vec3() * log_uniform(&mut rng, 10.0, 1e5) as f32;
                    let ray = Ray::new(origin, unit(&mut rng).as_vec3() * 6.0 - origin).unwrap();
                    onward.extend(Onward::random(&mut rng, &program, ray));
                }
                check(&program, &onward, scene.name)
            });
            let count = counts.reduce(Count::default, Count::joined);
            assert!(count.hits > 50 && count.misses > 100, "{}: {count:?}", scene.name);
        }
    }
}

#[test]
fn what_no_ray_leaves_is_refused_or_none() {
    let scene = Scene::new(scenes::PART.program());
    let caster = Caster::new(&scene);
    let three = [1.0; 3];
    let leave = |leaf: &'static [u32], face: &'static [u32], slack: &'static [f32]| Rays {
        leaving: Some(Leaving { leaf, face, slack }),
        ..Rays::new([&three; 3], [&three; 3])
    };
    let mut distance = [0.0; 3];
    let refused = Err(LengthsDiffer { expected: 3, found: 2 });
    for rays in [
        leave(&[0; 2], &[0; 3], &[0.0; 3]),
        leave(&[0; 3], &[0; 2], &[0.0; 3]),
        leave(&[0; 3], &[0; 3], &[0.0; 2]),
    ] {
        assert_eq!(caster.cast(&rays, RayHits::distances(&mut distance)), refused);
    }
    let faces = RayHits {
        face: Some(&mut [0; 2]),
        ..RayHits::distances(&mut distance)
    };
    assert_eq!(caster.cast(&leave(&[0; 3], &[0; 3], &[0.0; 3]), faces), refused);

    let rays = leave(&[0, 9, 1], &[0, 1, 200], &[0.0, f32::NAN, -1e-9]);
    caster.cast(&rays, RayHits::distances(&mut distance)).unwrap();
    assert_eq!(distance.map(f32::is_nan), [false, true, true], "{distance:?}");
    let mut any = [true; 3];
    caster.any(&rays, &mut any).unwrap();
    assert_eq!(any[1..], [false; 2]);
}
