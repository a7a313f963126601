//! What a ray sees does not depend on which way it is run through: to the bit where the numbers allow it, within the rounding
//! bound elsewhere.

use core::ops::Neg;
use core::sync::atomic::{AtomicUsize, Ordering};
use glam::Vec3;
use gsdf_nostd::{HalfSpace, Hit, Lane, Leaf, Line, Node, Program, Ray, Solid, Span, Toward, V3};
use gsdf_tests::corpus;
use gsdf_tests::laws::Scene;
use gsdf_tests::sandwich::{Trial, disagreements};
use gsdf_tests::shape::{KINDS, Shape, log_uniform};
use gsdf_tests::trees::{Number, Tree, random_solid};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors a crossing may be off its surface.
pub(crate) const ALLOWED: f64 = 8.0;

/// Rays at each kind of leaf.
const RAYS: u64 = 4_000;

/// A property on a ray at a solid of each kind, from the classes of the corpus.
pub(crate) fn for_leaves(law: impl Fn(&mut Pcg64, &Shape, Trial) + Sync) {
    for kind in 0..KINDS.len() {
        (0..RAYS).into_par_iter().for_each(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
            let size = log_uniform(&mut rng, 1e-2, 1e3);
            let shape = Shape::random(&mut rng, kind, size, 4.0);
            let (_, trial) = corpus::ray(&mut rng, &shape, size, 1e4);
            law(&mut rng, &shape, trial);
        });
    }
}

/// A line run through backwards: `-t` for `t`, so that what was the exit is the entry, and the surface is the same from
/// there. All formulas are even or odd in the direction, and rounding is to nearest, so not a bit differs (but for the
/// sign of a zero). A facet, which is left at the next number, is entered where it was entered. The one exception is a line
/// that starts at its nearest point to a round solid's middle, or along a cone's axis: there `B` is zero, of which there is
/// no negative, and the two ends may swap their rounding errors.
#[test]
fn a_line_run_backwards_swaps_entry_and_exit_to_the_bit() {
    fn check<T: Number + Neg<Output = T> + Into<f64>>(shape: &Shape, trial: &Trial, exceptions: &AtomicUsize) {
        let leaf = shape.leaf().unwrap();
        let like = T::from(0.0);
        let line = |direction: Vec3| Line {
            origin: V3::splat(like, trial.origin),
            toward: Toward::new(V3::splat(like, direction)),
        };
        let (forth, back) = (line(trial.direction), line(-trial.direction));
        let (one, other): (Span<T>, Span<T>) = (leaf.span_along(&forth), leaf.span_along(&back));
        let is_empty = |span: Span<T>| span.enter >= span.exit;
        assert_eq!(is_empty(one), is_empty(other), "{one:?} and {other:?}: {trial:?}");
        if is_empty(one) {
            return;
        }
        if shape.is_facet() {
            assert_eq!(one.enter, -other.enter, "{one:?} and {other:?}: {trial:?}");
            return;
        }
        let ends = [(one.enter, -other.exit), (one.exit, -other.enter)];
        if ends.iter().any(|(end, turned)| end != turned) {
            let unit = if T::nearest(1.0 + f64::EPSILON) == T::from(1.0) {
                f64::from(f32::EPSILON)
            } else {
                f64::EPSILON
            };
            for (end, turned) in ends {
                let (end, turned): (f64, f64) = (end.into(), turned.into());
                let is_near = end == turned || (end - turned).abs() <= 32.0 * unit * end.abs();
                assert!(shape.is_round() && is_near, "{one:?} and {other:?}: {trial:?}");
            }
            exceptions.fetch_add(1, Ordering::Relaxed);
            return;
        }
        let seen = leaf.seen_from(forth.origin);
        for t in [one.enter, one.exit] {
            if t.abs() < T::from(f32::INFINITY) {
                let (surface, again) = (leaf.surface(&seen, &forth.toward, t), leaf.surface(&seen, &back.toward, -t));
                assert_eq!(surface, again, "at {t:?}: {trial:?}");
            }
        }
    }
    let exceptions = AtomicUsize::new(0);
    for_leaves(|_, shape, trial| {
        check::<f32>(shape, &trial, &exceptions);
        check::<f64>(shape, &trial, &exceptions);
    });
    let (exceptions, rays) = (exceptions.into_inner(), 2 * RAYS as usize * KINDS.len());
    println!("{exceptions} of {rays} lines differ in the last units of an end");
    assert!(exceptions * 100 < rays, "{exceptions} of {rays}");
}

/// How far apart the two ends are from which a scene is looked through, in units of the direction.
const ACROSS: f32 = 16.0;

/// A ray through the middle of things whose numbers are so coarse that its far end is an `f32` point too: the one way and
/// the other, exactly the same line.
pub(crate) fn both_ways(rng: &mut Pcg64, coarse: f32) -> [Ray; 2] {
    let mut vector = |most: f32| Vec3::from_array([(); 3].map(|()| (rng.random_range(-most..most) * coarse).round() / coarse));
    let (target, mut direction) = (vector(2.0), vector(1.0));
    if direction == Vec3::ZERO {
        direction = Vec3::X;
    }
    let near = target - direction * (ACROSS / 2.0);
    let far = near + direction * ACROSS;
    [(near, direction), (far, -direction)].map(|(origin, direction)| {
        let ray = Ray::new(origin, direction).unwrap();
        ray.within(0.0..ACROSS).unwrap()
    })
}

/// Where a ray is inside, from its start to [`ACROSS`].
fn spans(inside: bool, crossings: impl Iterator<Item = f32>) -> Vec<(f64, f64)> {
    let mut ends: Vec<f64> = inside.then_some(0.0).into_iter().chain(crossings.map(f64::from)).collect();
    if ends.len() % 2 == 1 {
        ends.push(ACROSS.into());
    }
    ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

/// From the other end the same is seen in the opposite order: wherever the two differ, the place is within the rounding
/// errors of both of some solid's surface.
#[test]
fn from_the_other_end_entries_are_exits_within_rounding() {
    let met: usize = (0..20_000_u64)
        .into_par_iter()
        .map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed);
            let leaves = rng.random_range(1..=8);
            let scene = Scene::random(&mut rng, leaves, false);
            let nodes = scene.nodes(&scene.tree);
            let [forth, back] = both_ways(&mut rng, 1024.0);
            let [one, other] = [forth, back].map(|ray| {
                let (inside, crossings) = scene.crossings::<f32>(&nodes, ray);
                spans(inside, crossings.iter().map(|crossing| crossing.t))
            });
            let turned: Vec<_> = other
                .iter()
                .rev()
                .map(|(enter, exit)| (f64::from(ACROSS) - exit, f64::from(ACROSS) - enter))
                .collect();
            for (t, _) in disagreements(&one, &turned) {
                let near = scene.solids.iter().any(|&(shape, _)| {
                    let trial = |ray: Ray| Trial {
                        shape,
                        origin: ray.origin(),
                        direction: ray.direction(),
                    };
                    trial(forth).is_near_surface(t, ALLOWED) || trial(back).is_near_surface(f64::from(ACROSS) - t, ALLOWED)
                });
                assert!(
                    near || t <= 0.0 || t >= f64::from(ACROSS),
                    "seed {seed}: at {t}: {one:?}, the other way {turned:?}, along {forth:?}: {nodes:?}"
                );
            }
            one.len()
        })
        .sum();
    assert!(met > 5_000, "{met}");
}

/// Where no number is rounded, not a bit differs from the other end: boxes and half-spaces on a grid, along it. Of several
/// faces in one place the same leaf's is named, with the same normal, whether it is entered or left there.
#[test]
fn from_the_other_end_a_grid_is_the_same_to_the_bit() {
    let (mut met, mut tied) = (0, 0);
    for seed in 0..60_000_u64 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let leaves = rng.random_range(1..=10);
        let flat = |rng: &mut Pcg64| loop {
            let solid = random_solid(rng);
            if matches!(solid, Leaf::Cuboid(_) | Leaf::HalfSpace(_)) {
                return solid;
            }
        };
        let solids: Vec<Leaf> = (0..leaves).map(|_| flat(&mut rng)).collect();
        let nodes: Vec<Node> = Tree::random(&mut rng, leaves).postfix(&solids);
        let program = Program::new(&nodes).unwrap();
        let mut direction = Vec3::ZERO;
        direction[rng.random_range(0..3)] = 1.0;
        // Half-way between the grid's lines, so that the ray lies in no face.
        let mut half = || f32::from(rng.random_range(-3_i8..3)) + 0.5;
        let at = Vec3::new(half(), half(), half());
        let hits = |origin: Vec3, direction: Vec3| {
            let mut scratch = vec![Span::EMPTY; leaves];
            let mut rest = Ray::new(origin, direction).and_then(|ray| ray.within(0.0..16.0));
            let mut hits: Vec<Hit> = vec![];
            while let Ok(ray) = rest
                && let Some(hit) = program.along(ray, &mut scratch).unwrap().cast()
            {
                hits.push(hit);
                rest = ray.within(hit.t..16.0);
            }
            hits
        };
        let (one, other) = (hits(at - direction * 8.0, direction), hits(at + direction * 8.0, -direction));
        let told = |hit: &Hit, t: f32, entering: bool| (t, hit.point, hit.normal, hit.leaf, hit.face, entering);
        let turned: Vec<_> = other.iter().rev().map(|hit| told(hit, 16.0 - hit.t, !hit.entering)).collect();
        let one: Vec<_> = one.iter().map(|hit| told(hit, hit.t, hit.entering)).collect();
        assert_eq!(one, turned, "seed {seed}: {nodes:?}");
        met += one.len();
        tied += one.len().saturating_sub(1);
    }
    assert!(met > 10_000 && tied > 3_000, "{met}, {tied}");
}

/// A plane and its opposite, which neighbours write, are crossed at the same parameter to the bit, by lines both ways.
#[test]
fn the_two_sides_of_a_plane_meet_to_the_bit() {
    fn check<T: Lane>(sides: [HalfSpace; 2], trial: &Trial) {
        let line: Line<T> = Ray::new(trial.origin, trial.direction).unwrap().line(T::from(0.0));
        let [one, other] = sides.map(|side| side.span_along(&line));
        let infinity = T::from(f32::INFINITY);
        let meet = one.exit == other.enter && one.enter == -infinity && other.exit == infinity
            || other.exit == one.enter && other.enter == -infinity && one.exit == infinity;
        let parallel = one.enter == -infinity && one.exit == infinity || other.enter == -infinity && other.exit == infinity;
        let in_plane = one.enter >= one.exit && other.enter >= other.exit;
        assert!(meet || parallel || in_plane, "{trial:?}");
    }
    for_leaves(|_, shape, trial| {
        let Shape::HalfSpace { point, normal } = *shape else { return };
        let sides = [HalfSpace::new(point, normal).unwrap(), HalfSpace::new(point, -normal).unwrap()];
        check::<f32>(sides, &trial);
        check::<f64>(sides, &trial);
    });
}
