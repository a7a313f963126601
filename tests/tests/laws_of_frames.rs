//! What a ray sees does not depend on the unit of lengths and on where the world stands: to the bit where the numbers allow it,
//! within the rounding bound elsewhere.

use crate::laws_of_rays::{ALLOWED, both_ways, for_leaves};
use glam::{DMat3, DVec3, Mat3, Vec3};
use gsdf_nostd::{Departure, Hit, MAX_LENGTH, Node, Program, Ray, Span, Transform};
use gsdf_tests::conformance::packet::bits;
use gsdf_tests::corpus;
use gsdf_tests::laws::Scene;
use gsdf_tests::poses::{Posed, random_motion};
use gsdf_tests::sandwich::disagreements;
use gsdf_tests::shape::{KINDS, Shape, log_uniform, unit};
use gsdf_tests::trees::Tree;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// A solid in a frame of another size is, where that is a power of two, the solid in the world: the numbers that meet are
/// 2^20 times as large or as small, and nothing of them is lost.
#[test]
fn a_frame_of_another_size_changes_no_bit() {
    let hits: usize = (0..4_000_u64)
        .into_par_iter()
        .map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed);
            let kind = rng.random_range(0..KINDS.len());
            // In the frame sizes are from 2^-20 to 2^30 too.
            let exponent = rng.random_range(-20..=20);
            let size = f64::from(exponent.max(0)).exp2() * log_uniform(&mut rng, 4.0, 64.0);
            let shape = Shape::random(&mut rng, kind, size, 2.0);
            let local = shape.measured(|length| length * 2.0_f32.powi(-exponent));
            let Ok(solid) = local.leaf() else { return 0 };
            let pose = Transform::affine(Mat3::from_diagonal(Vec3::splat(2.0_f32.powi(exponent))), Vec3::ZERO).unwrap();
            let (here, there) = ([Node::leaf(shape.leaf().unwrap())], [Node::Leaf { solid, frame: 1 }]);
            let scene = |solid| Scene {
                solids: vec![(solid, 0)],
                tree: Tree::Leaf(0),
                poses: [pose, Transform::IDENTITY],
            };
            let mut count = 0;
            for _ in 0..8 {
                // At the solid, or from far away at whatever of it has no end: there the largest numbers meet.
                let (origin, direction) = if rng.random() {
                    let trial = corpus::ray(&mut rng, &shape, size, 1e2).1;
                    (trial.origin, trial.direction)
                } else {
                    let distance = log_uniform(&mut rng, 1e6, 5e8);
                    ((unit(&mut rng) * distance).as_vec3(), unit(&mut rng).as_vec3())
                };
                let Ok(ray) = Ray::new(origin, direction) else {
                    continue;
                };
                let (hits, found) = (scene(shape).hits(&here, ray), scene(local).hits(&there, ray));
                // A facet's thickness next to the start is no share of anything.
                if shape.is_facet() && hits.iter().chain(&found).any(|hit| hit.t < 1e-15) {
                    continue;
                }
                let what = || format!("seed {seed}: {found:?}, not {hits:?} along {ray:?}: {shape:?} at 2^{exponent}");
                assert_eq!(found.len(), hits.len(), "{}", what());
                for (found, hit) in found.iter().zip(&hits) {
                    // A normal that comes to the world is made of unit length once more.
                    assert!((found.normal - hit.normal).length() < 3e-7, "{}", what());
                    let mut turned = *found;
                    turned.normal = hit.normal;
                    assert_eq!(bits(&turned), bits(hit), "{}", what());
                }
                count += hits.len();
            }
            count
        })
        .sum();
    assert!(hits > 10_000, "{hits}");
}

/// A hit with its parameter and its point in other units.
fn in_unit(mut hit: Hit, of_parameter: f32, of_length: f32) -> Hit {
    hit.t *= of_parameter;
    hit.point *= of_length;
    hit
}

/// The scene in another unit, a power of two: the same hits, leaf by leaf and bit by bit, at parameters multiplied
/// exactly; and at the same ones if the direction is in that unit too. So it is on leaving a hit.
#[test]
fn a_power_of_two_as_unit_of_length_changes_no_bit() {
    let hits: usize = (0..4_000_u64)
        .into_par_iter()
        .map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed);
            let leaves = rng.random_range(1..=8);
            let scene = Scene::random(&mut rng, leaves, false);
            let nodes = scene.nodes(&scene.tree);
            let factor = 2.0_f32.powi(rng.random_range(-8..=20));
            let larger = Scene {
                solids: scene
                    .solids
                    .iter()
                    .map(|(shape, frame)| (shape.measured(|length| length * factor), *frame))
                    .collect(),
                ..scene.clone()
            };
            let larger_nodes = larger.nodes(&scene.tree);
            let mut count = 0;
            for _ in 0..8 {
                let ray = scene.ray(&mut rng);
                let hits = scene.hits(&nodes, ray);
                // A facet's thickness next to the start is no share of anything.
                if hits.iter().any(|hit| hit.t < 1e-15) {
                    continue;
                }
                for (unit, speed) in [(factor, 1.0), (1.0, factor)] {
                    let other = Ray::new(ray.origin() * factor, ray.direction() * speed).unwrap();
                    let expected = hits.iter().map(|hit| in_unit(*hit, unit, factor));
                    let found = larger.hits(&larger_nodes, other);
                    assert_eq!(
                        found.iter().map(bits).collect::<Vec<_>>(),
                        expected.map(|hit| bits(&hit)).collect::<Vec<_>>(),
                        "seed {seed}: {found:?}, not {hits:?} times {factor}, along {ray:?}: {nodes:?}"
                    );
                    let double = scene.crossings::<f64>(&nodes, ray).1;
                    let again = larger.crossings::<f64>(&larger_nodes, other).1;
                    // In double precision that thickness can be told from the next number.
                    let has_facets = scene.solids.iter().any(|(shape, _)| shape.is_facet());
                    assert!(
                        has_facets
                            || double.len() == again.len()
                                && double
                                    .iter()
                                    .zip(&again)
                                    .all(|(a, b)| a.t * f64::from(unit) == b.t && a.leaf == b.leaf),
                        "seed {seed}: {again:?}, not {double:?} times {unit}, along {ray:?}: {nodes:?}"
                    );
                }
                // Nothing leaves a place out of range.
                if let Some(hit) = hits.first().filter(|hit| hit.point.abs().max_element() * factor < MAX_LENGTH) {
                    let away = unit(&mut rng).as_vec3();
                    let leaving = |scene: &Scene, nodes: &[Node], hit: &Hit, t: f32| {
                        let mut scratch = vec![Span::EMPTY; leaves];
                        let start = Departure::new(hit, away).unwrap();
                        let next = scene.program(nodes).along(start, &mut scratch).unwrap().cast();
                        next.map(|next| bits(&in_unit(next, t, t)))
                    };
                    let other = Ray::new(ray.origin() * factor, ray.direction()).unwrap();
                    let other = larger.hits(&larger_nodes, other)[0];
                    assert_eq!(
                        leaving(&scene, &nodes, hit, factor),
                        leaving(&larger, &larger_nodes, &other, 1.0),
                        "seed {seed}: leaving {hit:?} along {away}: {nodes:?}"
                    );
                }
                count += hits.len();
            }
            count
        })
        .sum();
    assert!(hits > 20_000, "{hits}");
}

/// A quarter turn and a translation in eighths round nothing, so a scene moved so, with the ray, is the same to the bit;
/// normals are turned.
#[test]
fn a_motion_without_rounding_changes_no_bit() {
    let turns = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];
    let hits: usize = (0..4_000_u64)
        .into_par_iter()
        .map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed);
            let leaves = rng.random_range(1..=6);
            let mut scene = Scene::random(&mut rng, leaves, false);
            let nodes = scene.nodes(&scene.tree);
            let first = rng.random_range(0..6);
            let second = turns[(first + 1 + 3 * rng.random_range(0..2)) % 6];
            let turn = Mat3::from_cols(turns[first], second, turns[first].cross(second));
            let shift = Vec3::from_array([(); 3].map(|()| f32::from(rng.random_range(-32_i8..32)) / 8.0));
            let at_rest = scene.clone();
            scene.poses[0] = Transform::affine(turn, shift).unwrap();
            for (_, frame) in &mut scene.solids {
                *frame = 1;
            }
            let moved = scene.nodes(&scene.tree);
            let mut count = 0;
            for _ in 0..8 {
                // An origin so coarse that the translation does not round it.
                let [ray, _] = both_ways(&mut rng, 1024.0);
                let other = Ray::new(turn * ray.origin() + shift, turn * ray.direction()).unwrap();
                let told = |hit: &Hit, normal: Vec3| (hit.t.to_bits(), hit.leaf, hit.face, hit.entering, normal);
                let hits = at_rest.hits(&nodes, Ray::new(ray.origin(), ray.direction()).unwrap());
                let found = scene.hits(&moved, other);
                // A normal is made of unit length once more in the world.
                let expected: Vec<_> = hits.iter().map(|hit| told(hit, Vec3::ZERO)).collect();
                assert_eq!(
                    found.iter().map(|hit| told(hit, Vec3::ZERO)).collect::<Vec<_>>(),
                    expected,
                    "seed {seed}: {found:?}, not {hits:?}, along {ray:?}: {nodes:?}"
                );
                for (found, hit) in found.iter().zip(&hits) {
                    assert!(
                        (found.normal - turn * hit.normal).length() < 1e-6,
                        "seed {seed}: {found:?}, not {hit:?}"
                    );
                }
                count += hits.len();
            }
            count
        })
        .sum();
    assert!(hits > 5_000, "{hits}");
}

/// Any other motion of solid and ray together moves the crossings by the rounding of the ray in the world and in the frame,
/// and no more.
#[test]
fn a_motion_of_solid_and_ray_changes_nothing_but_rounding() {
    // The ray is rounded in the world, its origin and its direction, and on the way back.
    const MOVED: f64 = 2.0 * ALLOWED;
    for_leaves(|rng, shape, trial| {
        // In the frame, which is where the corpus aims, the numbers are moderate.
        let pose = random_motion(rng);
        let posed = Posed::new((*shape).into(), pose);
        let rows = pose.to_local().map(Vec3::as_dvec3);
        let to_world = DMat3::from_cols(rows[0], rows[1], rows[2]).transpose().inverse();
        let origin: DVec3 = to_world * trial.origin.as_dvec3() + pose.origin().as_dvec3();
        let ray = Ray::new(origin.as_vec3(), (to_world * trial.direction.as_dvec3()).as_vec3()).unwrap();
        let (inside, crossings) = posed.computed(ray);
        let leaf = shape.leaf().unwrap();
        let nodes = [Node::leaf(leaf)];
        let mut scratch = [Span::EMPTY; 1];
        let sight = Program::new(&nodes).unwrap();
        let sight = sight.along(Ray::new(trial.origin, trial.direction).unwrap(), &mut scratch).unwrap();
        let endless = |inside: bool, crossings: Vec<f32>| {
            let mut ends: Vec<f64> = inside
                .then_some(0.0)
                .into_iter()
                .chain(crossings.into_iter().map(f64::from))
                .collect();
            if ends.len() % 2 == 1 {
                ends.push(f64::INFINITY);
            }
            ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect::<Vec<_>>()
        };
        let at_rest = endless(sight.march::<f32>().inside, sight.crossings::<f32>().map(|c| c.t).collect());
        let moved = endless(inside, crossings.iter().map(|crossing| crossing.t).collect());
        for (t, _) in disagreements(&at_rest, &moved) {
            assert!(
                t <= 0.0 || posed.is_near_leaf(&ray, 0, t, MOVED),
                "at {t}: at rest {at_rest:?}, moved {moved:?}: {trial:?} in {pose:?}"
            );
        }
    });
}
