//! What is certified is so, and what can be certified is.

use gsdf_nostd::glam::{Vec3, vec3};
use gsdf_nostd::{Bounded, CertifiedScratch, Cuboid, Ray, Settled, Span, csg, half_ulp};
use gsdf_tests::accuracy::{Cell, Certainty, Corpus, PART};
use gsdf_tests::shape::KINDS;
use gsdf_workload::scenes::{S1, S2, S3, S4, S5, Scene};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// No certificate is wrong in ten million rays, the hardest among them; and of rays that are not meant to be hard all are
/// certain.
#[test]
fn no_certificate_is_wrong_and_few_are_missing() {
    let (mut all, mut wrong, mut missing) = (Certainty::default(), Vec::new(), Vec::new());
    for cell in Cell::all() {
        let (name, corpus) = (KINDS[cell.leaf], cell.corpus.name());
        let found = cell.certainty(0..PART);
        println!("{name:16} {corpus:16} {:.4} {found:?}", found.share());
        if let Some(ray) = found.wrong {
            wrong.push(format!("--leaf '{name}' --corpus {corpus} --replay {ray}"));
        }
        let least = least_share(cell);
        if found.share() < least {
            missing.push(format!("{name} {corpus}: {} of the hits, not {least}", found.share()));
        }
        all = all.joined(found);
    }
    println!("{all:?}");
    assert!(wrong.is_empty(), "{} cells:\n{}", wrong.len(), wrong.join("\n"));
    assert!(missing.is_empty(), "{} cells:\n{}", missing.len(), missing.join("\n"));
    assert!(all.hits + all.misses >= 9_900_000, "{all:?}");
}

/// The share of hits that `f32` must be certain of. Facets have no inside to be certain of.
fn least_share(cell: Cell) -> f64 {
    if ["triangle", "quad"].contains(&KINDS[cell.leaf]) {
        return 0.0;
    }
    match cell.corpus {
        Corpus::Moderate | Corpus::Lengths => 0.999,
        Corpus::Units | Corpus::Limits => 0.99,
        Corpus::Angles => 0.9,
        Corpus::Inside => 0.9,
        // To ten million radii, where `f32` itself is off by half a radius.
        Corpus::Far => 0.45,
        Corpus::Tiny => 0.6,
        _ => 0.0,
    }
}

/// What became of the rays of a picture.
#[derive(Clone, Copy, Debug, Default)]
struct Picture {
    hits: u32,
    single: u32,
    rounded: u32,
    others: u32,
    leaves_differ: u32,
}

/// Casts a ray through the middle of every `step`th pixel in each direction.
fn looked_at(scene: &Scene, step: u32) -> Picture {
    let leaves = scene.program.leaves();
    let (mut single, mut double) = (
        vec![Span::empty_like(Bounded::exact(0.0)); leaves],
        vec![Span::empty_like(Bounded::exact(0.0)); leaves],
    );
    let (mut tie, mut robust) = (vec![Span::empty_like(0.0); leaves], vec![Span::empty_like(0.0); leaves]);
    let camera = scene.camera().unwrap();
    let raster = camera.raster(1024, 1024);
    let mut picture = Picture::default();
    for (x, y) in (0..1024)
        .step_by(step as usize)
        .flat_map(|y| (0..1024).step_by(step as usize).map(move |x| (x, y)))
    {
        let ray = raster.ray(x, y).unwrap();
        let scratch = CertifiedScratch {
            single: &mut single,
            double: &mut double,
            tie: &mut tie,
        };
        let found = scene.program.cast_certified(&ray, scratch).unwrap();
        let plainly = scene.program.along(ray, &mut robust).unwrap().cast();
        picture.others += u32::from(found.settled == Settled::Tie);
        let Some(hit) = found.hit else {
            picture.leaves_differ += u32::from(plainly.is_some() && found.settled == Settled::Single);
            continue;
        };
        picture.hits += 1;
        picture.single += u32::from(found.settled == Settled::Single);
        picture.rounded += u32::from(found.bound <= (hit.t.next_up() - hit.t) * 0.500_01);
        if found.settled == Settled::Single {
            let same = plainly.is_some_and(|plainly| {
                let is_near = (plainly.t - hit.t).abs() <= 1e-5 * hit.t && plainly.normal.dot(hit.normal) > 0.999;
                // Not the face: at a seam of a capsule it is a matter of rounding which one is met.
                (plainly.leaf, plainly.entering) == (hit.leaf, hit.entering) && is_near
            });
            picture.leaves_differ += u32::from(!same);
        }
    }
    picture
}

/// On the reference scenes almost nothing needs more than `f32` to be certain, what is certain is what a robust cast says, and
/// distances are rounded correctly.
#[test]
fn reference_scenes_are_certain() {
    for (scene, step) in [(&S1, 3), (&S2, 3), (&S3, 6), (&S4, 24), (&S5, 16)] {
        let seen = looked_at(scene, step);
        println!("{}: {seen:?}", scene.name);
        assert!(seen.hits > 500, "{seen:?}");
        assert!(f64::from(seen.single) >= 0.999 * f64::from(seen.hits), "{}: {seen:?}", scene.name);
        assert!(f64::from(seen.rounded) >= 0.99 * f64::from(seen.hits), "{}: {seen:?}", scene.name);
        assert_eq!(seen.leaves_differ, 0, "{}: {seen:?}", scene.name);
    }
}

/// Where faces of two solids coincide it is decided by rule whose is met; that one is, and where, is certain. Where one is cut away
/// to a face that coincides nothing is: a skin might be left.
#[test]
fn faces_that_coincide_are_where_they_are_whosever_they_are() {
    csg! {
        const BOTH = union(
            Cuboid::new(vec3(-0.5, -2.0, -3.0), vec3(2.0, 0.5, 1.0)),
            Cuboid::new(Vec3::NEG_ONE, Vec3::ONE)
        )
    }
    csg! {
        const CUT = difference(
            Cuboid::new(Vec3::NEG_ONE, Vec3::ONE),
            Cuboid::new(vec3(-0.5, -2.0, -3.0), vec3(2.0, 0.5, 1.0))
        )
    }
    let mut rng = Pcg64::seed_from_u64(8);
    for _ in 0..10_000 {
        let mut within = |low: f32, high: f32| rng.random_range(low..high);
        let seen = vec3(within(-0.49, 0.99), within(-0.99, 0.49), 1.0);
        let eye = vec3(within(-3.0, 3.0), within(-3.0, 3.0), within(2.0, 9.0));
        let ray = Ray::new(eye, (seen - eye) * within(0.3, 3.0)).unwrap();
        let t = (1.0 - f64::from(eye.z)) / f64::from(ray.direction().z);
        let found = BOTH.cast_certified(&ray);
        let hit = found.hit.unwrap();
        assert_eq!((found.settled, hit.leaf), (Settled::Tie, 0), "{ray:?}");
        assert!(found.bound <= half_ulp(hit.t) * 1.001, "{ray:?}: {found:?}");
        let off = (f64::from(hit.t) - t).abs();
        assert!(off <= f64::from(found.bound) * 1.000_001, "{ray:?}: {found:?}, not {t}");
        let through = CUT.cast_certified(&ray);
        assert!(
            (through.settled, through.bound) == (Settled::Tie, f32::INFINITY),
            "{ray:?}: {through:?}"
        );
    }
}
