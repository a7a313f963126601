//! What holds of sets holds of scenes, to the bit: crossings, leaves, faces and normals, of all kinds of solids, at rest and
//! posed. That it holds of any spans at all is proved in `algebra.rs`; here it goes through every stage of a query.

use gsdf_nostd::{Hit, Node, Ray};
use gsdf_tests::conformance::packet::bits;
use gsdf_tests::laws::Scene;
use gsdf_tests::sandwich::ROUNDOFF;
use gsdf_tests::shape::composed::{COMPOSED, Composed};
use gsdf_tests::shape::log_uniform;
use gsdf_tests::trees::Tree;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

const SCENES: u64 = 2_000;
const RAYS: usize = 16;

/// A property on random scenes and rays, each scene with a seed of its own; returns how many hits there were.
fn for_rays(law: impl Fn(&Scene, Ray, &mut Pcg64) -> usize + Sync) {
    let hits: usize = (0..SCENES)
        .into_par_iter()
        .map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed);
            let leaves = rng.random_range(2..=10);
            let scene = Scene::random(&mut rng, leaves, true);
            (0..RAYS)
                .map(|_| {
                    let ray = scene.ray(&mut rng);
                    law(&scene, ray, &mut rng)
                })
                .sum::<usize>()
        })
        .sum();
    assert!(hits > SCENES as usize * RAYS / 4, "the rays have lost their aim: {hits} hits");
}

/// Two expressions are the same to the bit: every hit in `f32`, every crossing in `f64`.
fn assert_same(scene: &Scene, ray: Ray, one: &Tree, other: &Tree) -> usize {
    let [one, other] = [one, other].map(|tree| scene.nodes(tree));
    let (hits, others) = (scene.hits(&one, ray), scene.hits(&other, ray));
    let all = |hits: &[Hit]| hits.iter().map(bits).collect::<Vec<_>>();
    assert_eq!(
        all(&hits),
        all(&others),
        "{hits:?} and {others:?} along {ray:?}: {one:?}, {other:?}"
    );
    let double = [&one, &other].map(|nodes| {
        let (inside, crossings) = scene.crossings::<f64>(nodes, ray);
        let crossings: Vec<_> = crossings.iter().map(|c| (c.t.to_bits(), c.leaf, c.entering)).collect();
        (inside, crossings)
    });
    assert_eq!(double[0], double[1], "along {ray:?}: {one:?}, {other:?}");
    hits.len()
}

/// The expression's leaves cut in two, with a random expression over each half.
fn halves(scene: &Scene, rng: &mut Pcg64) -> (Tree, Tree) {
    let count = scene.solids.len();
    let split = rng.random_range(1..count);
    (Tree::random(rng, split), Tree::random(rng, count - split).shifted(split))
}

#[test]
fn a_difference_is_an_intersection_with_the_complement() {
    for_rays(|scene, ray, rng| {
        let (a, b) = halves(scene, rng);
        assert_same(scene, ray, &a.clone().without(b.clone()), &a.and(b.inverted()))
    });
}

#[test]
fn the_complement_of_a_union_is_the_intersection_of_complements() {
    for_rays(|scene, ray, rng| {
        let (a, b) = halves(scene, rng);
        let (not_a, not_b) = (a.clone().inverted(), b.clone().inverted());
        assert_same(scene, ray, &a.clone().or(b.clone()).inverted(), &not_a.clone().and(not_b.clone()))
            + assert_same(scene, ray, &a.and(b).inverted(), &not_a.or(not_b))
    });
}

#[test]
fn the_complement_of_the_complement_is_the_solid() {
    for_rays(|scene, ray, _| assert_same(scene, ray, &scene.tree.clone().inverted().inverted(), &scene.tree));
}

/// The copy's leaves have higher numbers, so it is never the one that is named.
#[test]
fn a_copy_of_itself_adds_nothing_and_takes_nothing() {
    for_rays(|scene, ray, _| {
        let tree = &scene.tree;
        assert_same(scene, ray, &tree.clone().or(tree.clone()), tree) + assert_same(scene, ray, &tree.clone().and(tree.clone()), tree)
    });
}

/// Nothing is left of a solid without itself, and there is nothing that it and its complement are not.
#[test]
fn a_solid_and_its_complement_leave_nothing_out() {
    for_rays(|scene, ray, _| {
        let tree = &scene.tree;
        let nothing = scene.nodes(&tree.clone().without(tree.clone()));
        let everything = scene.nodes(&tree.clone().or(tree.clone().inverted()));
        assert_eq!(scene.crossings::<f32>(&nothing, ray), (false, vec![]), "{nothing:?} along {ray:?}");
        assert_eq!(
            scene.crossings::<f32>(&everything, ray),
            (true, vec![]),
            "{everything:?} along {ray:?}"
        );
        scene.hits(&scene.nodes(tree), ray).len()
    });
}

/// The same surface from the other side: all is the same but the sense and the normal, which is the negative.
#[test]
fn a_complement_has_the_same_surface_and_the_opposite_normal() {
    for_rays(|scene, ray, _| {
        let (nodes, inverted) = (scene.nodes(&scene.tree), scene.nodes(&scene.tree.clone().inverted()));
        let hits = scene.hits(&nodes, ray);
        let turned: Vec<Hit> = (scene.hits(&inverted, ray).into_iter())
            .map(|mut hit| {
                (hit.normal, hit.entering) = (-hit.normal, !hit.entering);
                hit
            })
            .collect();
        assert_eq!(
            hits.iter().map(bits).collect::<Vec<_>>(),
            turned.iter().map(bits).collect::<Vec<_>>(),
            "along {ray:?}: {nodes:?}"
        );
        let [sdf, negative] = [&nodes, &inverted].map(|nodes| scene.program(nodes).sdf(ray.origin()));
        assert_eq!(sdf, -negative);
        hits.len()
    });
}

/// Crossings ascend strictly, in and out by turns from whichever side the start is on; the first is what is cast for and
/// what the distance says; and a range holds those in it.
#[test]
fn crossings_ascend_and_alternate_and_ranges_cut_them() {
    for_rays(|scene, ray, rng| {
        let nodes = scene.nodes(&scene.tree);
        let (inside, crossings) = scene.crossings::<f32>(&nodes, ray);
        let hits = scene.hits(&nodes, ray);
        let what = || format!("{crossings:?} along {ray:?}: {nodes:?}");
        let mut last = (0.0, inside);
        for (crossing, hit) in crossings.iter().zip(&hits) {
            assert!(crossing.t > last.0 && crossing.entering != last.1, "{}", what());
            assert_eq!(
                (crossing.t, crossing.leaf, crossing.entering),
                (hit.t, hit.leaf, hit.entering),
                "{}",
                what()
            );
            last = (crossing.t, crossing.entering);
        }
        assert_eq!(crossings.len(), hits.len(), "{hits:?}: {}", what());
        let mut scratch = vec![gsdf_nostd::Span::EMPTY; scene.solids.len()];
        let distance: f32 = scene.program(&nodes).along(ray, &mut scratch).unwrap().gsdf();
        let first = crossings.first().map_or(f32::INFINITY, |crossing| crossing.t);
        assert_eq!(distance, if inside { -first } else { first }, "{}", what());
        // From one crossing, or a place just beside, to another.
        let mut bound = |otherwise: f32| match crossings.len() {
            0 => otherwise,
            count => {
                let t = crossings[rng.random_range(0..count)].t;
                [t, t.next_up(), t.next_down(), t * rng.random_range(0.5..1.5)][rng.random_range(0..4)]
            }
        };
        if let Ok(part) = ray.within(bound(0.5)..bound(2.0)) {
            let (start, end) = (part.range().start, part.range().end);
            let expected: Vec<_> = crossings.iter().filter(|c| start < c.t && c.t < end).copied().collect();
            let (starts_inside, within) = scene.crossings::<f32>(&nodes, part);
            assert_eq!(within, expected, "{start} to {end}: {}", what());
            let before = crossings.iter().rfind(|crossing| crossing.t <= start);
            assert_eq!(
                starts_inside,
                before.map_or(inside, |crossing| crossing.entering),
                "{start}: {}",
                what()
            );
        }
        hits.len()
    });
}

/// How many rounding errors a distance and a crossing may be off together.
const ALLOWED: f64 = 16.0;

/// Who has crossed the boundary an odd number of times is on the other side, as the standard distance sees it: at the
/// start, between any two crossings, and far beyond the last.
#[test]
fn parity_is_membership() {
    let checked = std::sync::atomic::AtomicUsize::new(0);
    for_rays(|scene, ray, _| {
        let nodes = scene.nodes(&scene.tree);
        let (inside, crossings) = scene.crossings::<f32>(&nodes, ray);
        let program = scene.program(&nodes);
        let extent = scene.solids.iter().map(|(shape, _)| shape.extent() * 8.0).fold(20.0, f64::max);
        let ends: Vec<f32> = crossings.iter().map(|crossing| crossing.t).collect();
        let places = places_between(&ends);
        for (number, t) in places.into_iter().enumerate() {
            let place = ray.at(t);
            let distance = f64::from(program.sdf(place));
            if distance.abs() > ALLOWED * ROUNDOFF * (extent + place.as_dvec3().length() + ray.origin().as_dvec3().length()) {
                assert_eq!(
                    distance < 0.0,
                    inside != (number % 2 == 1),
                    "{distance} at {t} after {number} crossings along {ray:?}: {nodes:?}"
                );
                checked.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
            }
        }
        crossings.len()
    });
    let checked = checked.into_inner();
    println!("{checked} places");
    assert!(checked > SCENES as usize * RAYS);
}

/// The start, a place between every two crossings, and one beyond the last.
fn places_between(crossings: &[f32]) -> Vec<f32> {
    let mut before = 0.0;
    let mut places = vec![];
    for &t in crossings {
        places.push(f32::midpoint(before, t));
        before = t;
    }
    places.push(before * 1.5 + 10.0);
    places
}

/// The same of the shapes that are programs, by their own standard distance.
#[test]
fn parity_is_membership_in_composed_shapes() {
    use gsdf_nostd::{BoxFrame, DoubleCone, WideSolidAngle};
    fn check(distance: impl Fn(glam::Vec3) -> f32, nodes: &[Node], ray: Ray, extent: f64) -> usize {
        let program = gsdf_nostd::Program::new(nodes).unwrap();
        let mut scratch = [gsdf_nostd::Span::EMPTY; 4];
        let sight = program.along(ray, &mut scratch).unwrap();
        let inside = sight.march::<f32>().inside;
        let ends: Vec<f32> = sight.crossings::<f32>().map(|crossing| crossing.t).collect();
        for (number, t) in places_between(&ends).into_iter().enumerate() {
            let place = ray.at(t);
            let (own, scale) = (
                f64::from(distance(place)),
                extent + place.as_dvec3().length() + ray.origin().as_dvec3().length(),
            );
            if own.abs() > ALLOWED * ROUNDOFF * scale {
                assert_eq!(own < 0.0, inside != (number % 2 == 1), "{own} at {t} along {ray:?}: {nodes:?}");
            }
        }
        ends.len()
    }
    for (kind, name) in COMPOSED.iter().enumerate() {
        let met: usize = (0..10_000_u64)
            .into_par_iter()
            .map(|seed| {
                let mut rng = Pcg64::seed_from_u64(seed);
                let solid = Composed::random(&mut rng, kind, 1.0);
                let target = if rng.random() {
                    solid.surface(&mut rng).0
                } else {
                    solid.edge_point(&mut rng)
                };
                let from = target + gsdf_tests::shape::unit(&mut rng) * log_uniform(&mut rng, 1e-3, 1e2);
                let from = from.as_vec3();
                let ray = Ray::new(from, (target - from.as_dvec3()).as_vec3()).unwrap();
                let extent = 10.0 * solid.extent();
                match solid {
                    Composed::BoxFrame { min, max, thickness } => {
                        let made = BoxFrame::new(min, max, thickness).unwrap();
                        check(|p| made.sdf(p), made.program().nodes(), ray, extent)
                    }
                    Composed::DoubleCone {
                        apex,
                        axis,
                        radius,
                        height,
                    } => {
                        let made = DoubleCone::new(apex, axis, radius, height).unwrap();
                        check(|p| made.sdf(p), made.program().nodes(), ray, extent)
                    }
                    Composed::WideSolidAngle {
                        apex,
                        axis,
                        reach,
                        radius,
                        height,
                    } => {
                        let made = WideSolidAngle::new(apex, axis, reach, radius, height).unwrap();
                        check(|p| made.sdf(p), made.program().nodes(), ray, extent)
                    }
                }
            })
            .sum();
        assert!(met > 5_000, "{name}: {met} crossings");
    }
}
