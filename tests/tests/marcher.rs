//! Sphere tracing over the standard distance: it stops at the surface, and never beyond it.

use gsdf_nostd::{Field, Leaf, Ray, Real, Solid, SphereTracer, V3};
use gsdf_tests::corpus;
use gsdf_tests::sandwich::ROUNDOFF;
use gsdf_tests::shape::{KINDS, Shape};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

const RAYS: u64 = 2_000;

/// Four units in the last place, of the numbers that meet.
const FOUR_ULP: f64 = 8.0 * ROUNDOFF;

/// A single leaf as the marcher takes it.
struct Alone(Leaf);

impl Field for Alone {
    fn distance_at<T: Real>(&self, p: V3<T>) -> T {
        self.0.distance(p)
    }
}

/// Without relaxation: where the march ends the distance is at most epsilon, and the exact crossing is not passed by
/// more than four units in the last place.
#[test]
fn a_marcher_stops_at_the_surface_and_never_beyond() {
    let tracer = SphereTracer {
        relaxation: 1.0,
        max_steps: 512,
        ..SphereTracer::default()
    };
    for (kind, name) in KINDS.iter().enumerate() {
        let outcomes = (0..RAYS).into_par_iter().map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
            let shape = Shape::random(&mut rng, kind, 1.0, 4.0);
            let field = Alone(shape.leaf().unwrap());
            let (_, trial) = corpus::ray(&mut rng, &shape, 1.0, 1e2);
            let ray = Ray::new(trial.origin, trial.direction).unwrap().within(0.0..1e4).unwrap();
            let traced = tracer.cast(&field, &ray);
            let (t, length) = (f64::from(traced.t), trial.direction.as_dvec3().length());
            if !traced.hit {
                return (0, 0.0_f64);
            }
            let place = trial.origin.as_dvec3() + trial.direction.as_dvec3() * t;
            let scale = trial.origin.as_dvec3().length() + shape.extent() + t * length;
            let left = field.0.distance(V3::new(place.x, place.y, place.z)).abs();
            let epsilon = f64::from(tracer.epsilon) * (t * length).max(1.0);
            assert!(
                left <= epsilon + FOUR_ULP * scale,
                "{name}: stopped {left} off the surface: {trial:?}"
            );
            let line = shape.exact(0.0).along(trial.origin, trial.direction);
            let Some(exact) = line.first_crossing_after(0.0) else {
                return (1, 0.0);
            };
            let beyond = (t - exact.t.to_f64()) * length / (FOUR_ULP * scale);
            // A start on the surface has that crossing behind it as well as ahead, by rounding.
            let starts_on = shape.exact(FOUR_ULP * scale).contains(trial.origin) && !shape.exact(-FOUR_ULP * scale).contains(trial.origin);
            assert!(
                beyond <= 1.0 || starts_on || trial.is_near_surface(exact.t.to_f64().midpoint(t), 8.0),
                "{name}: {t} is beyond {:?}, {beyond} of what is allowed: {trial:?}",
                exact.t
            );
            (1, if starts_on { 0.0 } else { beyond })
        });
        let (hits, worst) = outcomes.reduce(|| (0, 0.0), |a, b| (a.0 + b.0, a.1.max(b.1)));
        println!(
            "{name}: {hits} of {RAYS} marches stop, at most {:.1} units in the last place beyond",
            4.0 * worst
        );
        assert!(hits * 4 > RAYS, "{name}: only {hits} of {RAYS} marches stop");
    }
}
