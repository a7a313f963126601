//! Scenes far out of the range of the formulas, measured in a unit of their own.

use glam::Vec3;
use gsdf_nostd::{Solid, Unit};
use gsdf_tests::corpus;
use gsdf_tests::shape::{KINDS, Shape, log_uniform};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const RAYS: u64 = 2_000;

/// The unit of a shape: that of its extent, or where that is nothing, of its size.
fn unit_of(shape: &Shape, size: f64) -> Unit {
    Unit::of(shape.extent().max(size) as f32).unwrap()
}

/// Every kind of leaf, from 1e-30 to 1e30: the solid and the ray are those at one, bit for bit, so the distance is too.
#[test]
fn solids_of_any_size_are_those_at_one() {
    for (kind, name) in KINDS.iter().enumerate() {
        let mut hits = 0;
        for seed in 0..RAYS {
            let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
            let size = log_uniform(&mut rng, 1e-2, 1e2);
            let shape = Shape::random(&mut rng, kind, size, 4.0);
            let (_, trial) = corpus::ray(&mut rng, &shape, size, 1e3);
            let (exponent, speed) = (rng.random_range(-100..=90), rng.random_range(-100..=90));
            let [scale, speed_scale] = [exponent, speed].map(|exponent| 2.0_f32.powi(exponent));
            let (small, here) = (unit_of(&shape, size), shape.leaf().unwrap());
            let world = shape.measured(|length| length * scale);
            let unit = unit_of(&world, size * f64::from(scale));
            assert_eq!(unit.exponent(), small.exponent() + exponent, "{name}");

            let there = world.measured(|length| unit.length(length)).leaf();
            let at_one = shape.measured(|length| small.length(length)).leaf();
            assert_eq!(there, at_one, "{name}: {shape:?} at 2^{exponent}");
            let Ok(there) = there else { continue };

            let (origin, direction) = (trial.origin * scale, trial.direction * speed_scale);
            let (ray, parameter) = unit.ray(origin, direction).unwrap();
            assert_eq!(unit.point_to_world(ray.origin()), origin);
            let distance = there.gsdf(ray.origin(), ray.direction());
            let expected = f64::from(here.gsdf(trial.origin, trial.direction));
            let found = f64::from(distance) * 2.0_f64.powi(parameter.exponent() - exponent + speed);
            // From a point of a facet the ray leaves it after the thinnest of spans, which is one in every unit.
            if shape.is_facet() && expected <= 0.0 {
                assert!(found <= 0.0, "{name}: {found} from {trial:?}");
                continue;
            }
            assert_eq!(found, expected, "{name}: {trial:?} at 2^{exponent}, 2^{speed} as fast");
            assert_eq!(
                parameter.to_world(distance),
                (found * 2.0_f64.powi(exponent - speed)) as f32,
                "{name}: {trial:?}"
            );
            hits += u64::from(distance.is_finite());
        }
        assert!(hits * 4 > RAYS, "{name}: {hits} of {RAYS} rays hit");
    }
}

/// A scene that does not fit into one unit is refused, and not seen wrong.
#[test]
fn what_no_unit_holds_is_refused() {
    let unit = Unit::of(1e30).unwrap();
    assert!(gsdf_nostd::Sphere::new(Vec3::ZERO, unit.length(1e20)).is_err());
    let unit = Unit::of(1e-30).unwrap();
    assert!(gsdf_nostd::Sphere::new(unit.point(Vec3::splat(1.0)), unit.length(1e-30)).is_err());
    assert!(unit.ray(Vec3::splat(1.0), Vec3::X).is_err());
}
