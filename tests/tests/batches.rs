//! Batches of any rays against one scalar query per ray, bit for bit, at every level: rays in all directions, with ranges,
//! that start inside, and that are none.

use glam::{Mat3, vec3};
use gsdf_demo::scenes;
use gsdf_nostd::{Node, Program, Ray, Span, Transform};
use gsdf_simd::{Caster, LengthsDiffer, Level, Pixel, RayHits, Rays, Scene};
use gsdf_tests::conformance::packet::{Asked, Composed};
use gsdf_tests::shape::unit;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// Rays as arrays.
#[derive(Default)]
struct Arrays {
    origin: [Vec<f32>; 3],
    direction: [Vec<f32>; 3],
    range: [Vec<f32>; 2],
}

impl Arrays {
    fn of(asked: &[Asked]) -> Self {
        let mut arrays = Self::default();
        for ray in asked {
            for axis in 0..3 {
                arrays.origin[axis].push(ray.origin[axis]);
                arrays.direction[axis].push(ray.direction[axis]);
            }
            arrays.range[0].push(ray.range.start);
            arrays.range[1].push(ray.range.end);
        }
        arrays
    }

    fn rays(&self) -> Rays<'_> {
        Rays {
            range: Some(self.range.each_ref().map(Vec::as_slice)),
            ..Rays::new(
                self.origin.each_ref().map(Vec::as_slice),
                self.direction.each_ref().map(Vec::as_slice),
            )
        }
    }
}

/// What came of some rays.
#[derive(Clone, Copy, Debug, Default)]
struct Count {
    hits: u64,
    misses: u64,
    none: u64,
    inside: u64,
}

impl Count {
    fn joined(self, other: Self) -> Self {
        Self {
            hits: self.hits + other.hits,
            misses: self.misses + other.misses,
            none: self.none + other.none,
            inside: self.inside + other.inside,
        }
    }
}

fn check(program: &Program<'_>, asked: &[Asked], what: &str) -> Count {
    let scene = Scene::new(*program);
    let arrays = Arrays::of(asked);
    let mut spans = vec![Span::EMPTY; program.leaves()];
    let mut count = Count::default();
    let expected: Vec<_> = (asked.iter())
        .map(|asked| {
            let ray = Ray::new(asked.origin, asked.direction).and_then(|ray| ray.within(asked.range.clone()));
            let Ok(ray) = ray else {
                count.none += 1;
                return (f32::NAN.to_bits(), [0; 3], Pixel::NO_LEAF);
            };
            match program.along(ray, &mut spans).unwrap().cast() {
                Some(hit) => {
                    count.hits += 1;
                    count.inside += u64::from(!hit.entering);
                    (hit.t.to_bits(), hit.normal.to_array().map(f32::to_bits), hit.leaf)
                }
                None => {
                    count.misses += 1;
                    (f32::INFINITY.to_bits(), [0; 3], Pixel::NO_LEAF)
                }
            }
        })
        .collect();
    for level in Level::available() {
        let caster = Caster::at_level(&scene, level);
        let mut distance = vec![-1.0; asked.len()];
        let mut normal = [distance.clone(), distance.clone(), distance.clone()];
        let mut leaf = vec![7; asked.len()];
        let [x, y, z] = &mut normal;
        let hits = RayHits {
            normal: Some([x, y, z]),
            leaf: Some(&mut leaf),
            ..RayHits::distances(&mut distance)
        };
        caster.cast(&arrays.rays(), hits).unwrap();
        let mut any = vec![false; asked.len()];
        caster.any(&arrays.rays(), &mut any).unwrap();
        for (index, expected) in expected.iter().enumerate() {
            let distance = if distance[index].is_nan() { f32::NAN } else { distance[index] };
            let normal = [0, 1, 2].map(|axis| normal[axis][index].to_bits());
            let found = (distance.to_bits(), normal, leaf[index]);
            assert_eq!(found, *expected, "{what}, {level}, ray {index}: {:?}", asked[index]);
            assert_eq!(
                any[index],
                expected.2 != Pixel::NO_LEAF,
                "{what}, {level}, any {index}: {:?}",
                asked[index]
            );
        }
    }
    count
}

#[test]
fn random_programs() {
    let count = (0..1500_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let composed = Composed::random(&mut rng);
        let program = composed.program();
        let asked: Vec<_> = (0..rng.random_range(1..40))
            .map(|_| composed.aimed(&mut rng).varied(&mut rng, &program))
            .collect();
        check(&program, &asked, &format!("seed {seed}"))
    });
    let count = count.reduce(Count::default, Count::joined);
    assert!(
        count.hits > 3000 && count.misses > 5000 && count.none > 500 && count.inside > 500,
        "{count:?}"
    );
}

/// Rays through the grids of the reference scenes, from all sides and from within, in a frame of their own too.
#[test]
fn scenes_of_many_parts() {
    for scene in [scenes::s3(), scenes::s4(), scenes::s5()] {
        let at_rest = scene.program().unwrap();
        let posed: Vec<_> = (at_rest.nodes().iter())
            .map(|node| match node {
                Node::Leaf { solid, .. } => Node::Leaf { solid: *solid, frame: 1 },
                other => *other,
            })
            .collect();
        let turn = Mat3::from_axis_angle(vec3(0.6, 0.0, 0.8), 0.7);
        let poses = [Transform::affine(turn * 0.5, vec3(0.2, 0.9, 0.1)).unwrap()];
        let posed = Program::new(&posed).unwrap().posed(&poses).unwrap();
        for program in [at_rest, posed] {
            let counts = (0..8_u64).into_par_iter().map(|seed| {
                let mut rng = Pcg64::seed_from_u64(seed);
                let mut somewhere = |size: f32| unit(&mut rng).as_vec3() * size;
                let asked: Vec<_> = (0..50)
                    .map(|number| {
                        let origin = somewhere(if number % 5 == 0 { 3.0 } else { 30.0 });
                        Asked::new(origin, somewhere(6.0) - origin)
                    })
                    .collect();
                let mut asked = asked;
                for (number, ray) in asked.iter_mut().enumerate() {
                    if number % 3 == 0 {
                        ray.range = 0.25..0.9;
                    }
                }
                check(&program, &asked, scene.name)
            });
            let count = counts.reduce(Count::default, Count::joined);
            assert!(count.hits > 20 && count.misses > 50, "{}: {count:?}", scene.name);
        }
    }
}

/// More rays than one thread takes at a time, on several.
#[test]
fn many_rays_on_several_threads() {
    let program = scenes::PART.program();
    let scene = Scene::new(program);
    let caster = Caster::new(&scene);
    let mut rng = Pcg64::seed_from_u64(5);
    let asked: Vec<_> = (0..5000)
        .map(|_| {
            let origin = unit(&mut rng).as_vec3() * 4.0;
            Asked::new(origin, unit(&mut rng).as_vec3() - origin)
        })
        .collect();
    let arrays = Arrays::of(&asked);
    let rays = Rays {
        range: None,
        ..arrays.rays()
    };
    let cast = |threads: usize| {
        let mut distance = vec![0.0; asked.len()];
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| caster.cast(&rays, RayHits::distances(&mut distance)).unwrap());
        distance
    };
    let alone = cast(1);
    assert_eq!(alone, cast(3));
    for (ray, distance) in asked.iter().zip(alone) {
        assert_eq!(program.nodes().len(), 9);
        let hit = scenes::PART.cast(&Ray::new(ray.origin, ray.direction).unwrap());
        assert_eq!(hit.map_or(f32::INFINITY, |hit| hit.t), distance);
    }
}

#[test]
fn slices_of_different_lengths_are_refused() {
    let scene = Scene::new(scenes::PART.program());
    let caster = Caster::new(&scene);
    let (three, two) = ([1.0; 3], [1.0; 2]);
    let rays = |last: &'static [f32]| Rays::new([&[1.0; 3]; 3], [&[1.0; 3], &[1.0; 3], last]);
    let mut distance = [0.0; 3];
    let refused = Err(LengthsDiffer { expected: 3, found: 2 });
    assert_eq!(caster.cast(&rays(&[1.0; 2]), RayHits::distances(&mut distance)), refused);
    assert_eq!(caster.cast(&rays(&[1.0; 3]), RayHits::distances(&mut distance[..2])), refused);
    assert_eq!(caster.any(&rays(&[1.0; 3]), &mut [false; 2]), refused);
    assert_eq!(caster.any(&rays(&[1.0; 3]), &mut [false; 3]), Ok(()));
    let message = LengthsDiffer { expected: 3, found: 2 }.to_string();
    assert!(message.contains("2 long") && message.contains("3 long"), "{message}");
    let with_range = Rays {
        range: Some([&three, &two]),
        ..rays(&[1.0; 3])
    };
    assert_eq!(caster.any(&with_range, &mut [false; 3]), refused);
}
