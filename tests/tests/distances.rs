//! Both distances of every leaf against exact arithmetic: the standard one at points, the generalized one along rays.

use glam::{DVec3, Vec3};
use gsdf_nostd::{Leaf, Solid, V3};
use gsdf_tests::corpus;
use gsdf_tests::poses::{Posed, random_affine, random_motion};
use gsdf_tests::sandwich::{ROUNDOFF, Trial};
use gsdf_tests::shape::{KINDS, Shape, log_uniform, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors of the numbers that meet a distance may be off.
const ALLOWED: f64 = 8.0;

/// Points at each kind of leaf.
const POINTS: u64 = 200;

/// Directions from each point in which the surface must not be nearer than the distance says.
const DIRECTIONS: usize = 64;

/// A solid, a point and what the library makes of it.
struct Sample {
    shape: Shape,
    leaf: Leaf,
    point: Vec3,
    distance: f64,
    /// What the distance may be off.
    tolerance: f64,
}

/// A random solid with a point inside, at the surface, near or far.
fn sample(rng: &mut Pcg64, kind: usize) -> Sample {
    let size = log_uniform(rng, 1e-2, 1e3);
    let shape = Shape::random(rng, kind, size, 4.0);
    let near = |rng: &mut Pcg64, reach: f64| {
        let (surface, _) = shape.surface(rng);
        surface + unit(rng) * size * log_uniform(rng, 1e-4, reach)
    };
    let point = match rng.random_range(0..4) {
        0 => shape.interior(rng),
        1 => near(rng, 1.0),
        2 => near(rng, 100.0),
        _ => unit(rng) * size * rng.random_range(0.0..6.0),
    };
    let point = point.as_vec3();
    let leaf = shape.leaf().unwrap();
    Sample {
        shape,
        leaf,
        point,
        distance: leaf.sdf(point).into(),
        tolerance: ALLOWED * ROUNDOFF * (point.as_dvec3().length() + shape.extent()),
    }
}

impl Sample {
    /// The distance in double precision, at a point beside.
    fn distance_at(&self, point: DVec3) -> f64 {
        self.leaf.distance(V3::new(point.x, point.y, point.z))
    }

    /// The unit vector towards the nearest surface, from differences of the distance in double precision; `None` where it has no gradient.
    fn toward_surface(&self) -> Option<DVec3> {
        let point = self.point.as_dvec3();
        let step = 1e-5 * self.distance.abs();
        let slope = |axis: DVec3| (self.distance_at(point + axis * step) - self.distance_at(point - axis * step)) / (2.0 * step);
        let gradient = DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z));
        // Exact distances have slope one, but where several points of the surface are nearest.
        ((gradient.length() - 1.0).abs() < 1e-6).then(|| gradient * -self.distance.signum())
    }

    /// How far the surface, moved outward by `offset`, is along a unit direction; infinite where there is none.
    fn exact_distance_along(&self, direction: DVec3, offset: f64) -> f64 {
        let line = self.shape.exact(offset).along(self.point, direction.to_array());
        line.first_crossing_after(0.0).map_or(f64::INFINITY, |crossing| crossing.t.to_f64())
    }
}

/// What all points at one kind of leaf came to.
#[derive(Default)]
struct Tally {
    signs: usize,
    gradients: usize,
    met: usize,
    worst_double: f64,
}

fn samples(kind: usize) -> impl ParallelIterator<Item = (Pcg64, Sample)> {
    (0..POINTS).into_par_iter().map(move |seed| {
        let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
        let sample = sample(&mut rng, kind);
        (rng, sample)
    })
}

/// Negative inside, positive outside, and never so large that it would reach beyond the surface.
#[test]
fn distances_have_the_right_sign_and_never_overstep() {
    for (kind, name) in KINDS.iter().enumerate() {
        samples(kind).for_each(|(mut rng, sample)| {
            let Sample {
                shape,
                point,
                distance,
                tolerance,
                ..
            } = sample;
            if distance.abs() > tolerance {
                assert_eq!(
                    distance < 0.0,
                    shape.exact(0.0).contains(point),
                    "{name}: {distance} at {point} of {shape:?}"
                );
            }
            // The directions of the surface itself are the ones that matter: towards it, as the gradient has it, and anywhere.
            let directions = (0..DIRECTIONS).map(|_| unit(&mut rng)).chain(sample.toward_surface());
            for direction in directions {
                let met = sample.exact_distance_along(direction.normalize(), 0.0);
                assert!(
                    distance.abs() <= met + tolerance,
                    "{name}: {distance}, but {met} along {direction} from {point} of {shape:?}"
                );
            }
        });
    }
}

/// The surface is where the distance and its gradient say it is; and single precision says what double precision does.
#[test]
fn distances_are_exact() {
    for (kind, name) in KINDS.iter().enumerate() {
        let tally = samples(kind).map(|(_, sample)| {
            let mut tally = Tally::default();
            let Sample {
                shape,
                point,
                distance,
                tolerance,
                ..
            } = sample;
            let double = sample.distance_at(point.as_dvec3());
            tally.worst_double = (double - distance).abs() / (tolerance / ALLOWED);
            if distance.abs() > 8.0 * tolerance {
                tally.signs = 1;
                if let Some(direction) = sample.toward_surface() {
                    tally.gradients = 1;
                    // Edges and tips are met if the solid is a little larger seen from outside, or smaller seen from inside.
                    let met = sample.exact_distance_along(direction.normalize(), tolerance.copysign(distance));
                    assert!(
                        met <= distance.abs() + 2.0 * tolerance,
                        "{name}: {distance}, but {met} to the surface from {point} of {shape:?}"
                    );
                    tally.met = 1;
                }
            }
            tally
        });
        let tally = tally.reduce(Tally::default, |a, b| Tally {
            signs: a.signs + b.signs,
            gradients: a.gradients + b.gradients,
            met: a.met + b.met,
            worst_double: a.worst_double.max(b.worst_double),
        });
        println!(
            "{name}: {} of {} points have a gradient, {} of them lead to the surface; single precision is off by at most {:.1} rounding errors",
            tally.gradients, tally.signs, tally.met, tally.worst_double,
        );
        assert!(
            tally.worst_double <= ALLOWED,
            "{name}: off by {} rounding errors",
            tally.worst_double
        );
        assert!(
            tally.gradients * 100 >= tally.signs * 99,
            "{name}: {} of {} points have a gradient",
            tally.gradients,
            tally.signs
        );
    }
}

/// In a pose: the distance itself under a motion, and never too large under any affine map.
#[test]
fn posed_distances_never_overstep() {
    for (kind, name) in KINDS.iter().enumerate() {
        (0..POINTS).into_par_iter().for_each(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
            let shape = Shape::random(&mut rng, kind, 1.0, 4.0);
            let is_motion = rng.random_range(0..2) == 0;
            let pose = if is_motion {
                random_motion(&mut rng)
            } else {
                random_affine(&mut rng, 8.0)
            };
            let posed = Posed::new(shape.into(), pose);
            let point = (pose.origin().as_dvec3() + unit(&mut rng) * rng.random_range(0.0..20.0)).as_vec3();
            let distance = f64::from(posed.program().sdf(point));
            let numbers = point.as_dvec3().length() + pose.origin().as_dvec3().length() + shape.extent() * posed.largest_factor();
            let tolerance = ALLOWED * ROUNDOFF * numbers;
            if distance.abs() > tolerance {
                assert_eq!(
                    distance < 0.0,
                    posed.exact().contains(point),
                    "{name}: {distance} at {point}: {posed:?}"
                );
            }
            for _ in 0..DIRECTIONS {
                let line = posed.exact().along(point, unit(&mut rng).to_array());
                let met = line.first_crossing_after(0.0).map_or(f64::INFINITY, |crossing| crossing.t.to_f64());
                assert!(
                    distance.abs() <= met + tolerance,
                    "{name}: {distance}, but {met} from {point}: {posed:?}"
                );
            }
            if is_motion {
                let local = pose.point_to_local(V3::<f64>::from(point));
                let expected: f64 = shape.leaf().unwrap().distance(local);
                assert!(
                    (distance - expected).abs() <= tolerance,
                    "{name}: {distance} instead of {expected}: {posed:?}"
                );
            }
        });
    }
}

/// The generalized distance: positive and to the entry outside, negative and to the exit inside, infinite where nothing is met.
#[test]
fn generalized_distances_are_those_of_exact_arithmetic() {
    const RAYS: u64 = 1_500;
    for (kind, name) in KINDS.iter().enumerate() {
        let met = (0..RAYS).into_par_iter().map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
            let size = log_uniform(&mut rng, 1e-2, 1e3);
            let shape = Shape::random(&mut rng, kind, size, 4.0);
            let (_, trial) = corpus::ray(&mut rng, &shape, size, 1e3);
            let found = f64::from(shape.leaf().unwrap().gsdf(trial.origin, trial.direction));
            let line = shape.exact(0.0).along(trial.origin, trial.direction);
            let expected = line.first_crossing_after(0.0).map_or(f64::INFINITY, |crossing| crossing.t.to_f64());
            let inside = line.inside_at(0.0);
            let expected = if inside { -expected } else { expected };
            let length = trial.direction.as_dvec3().length();
            let scale = |t: f64| trial.origin.as_dvec3().length() + shape.extent() + t.abs() * length;
            let close = found == expected
                || (found < 0.0) == inside
                    && (found - expected).abs() * length <= ALLOWED * ROUNDOFF * scale(expected.abs().min(found.abs()));
            if !close {
                // Only where the ray starts on the surface or grazes it: what was found is within rounding of it, and so is all that was missed.
                let near = |t: f64| !t.is_finite() || trial.is_near_surface(t, ALLOWED);
                let missed = match line.spans().first() {
                    Some((enter, exit)) if !inside && found > expected => f64::midpoint(enter.to_f64(), exit.to_f64().min(found)),
                    _ => 0.5 * (found.abs() + expected.abs()),
                };
                let explained = if (found < 0.0) == inside {
                    near(found.abs()) && near(missed)
                } else {
                    near(0.0)
                };
                assert!(explained, "{name}: {found} instead of {expected}: {trial:?}");
            }
            (usize::from(expected.is_finite()), usize::from(!close))
        });
        let (met, flat) = met.reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
        println!("{name}: {met} of {RAYS} rays meet the surface, {flat} too flatly to tell how deep");
        assert!(met as u64 * 10 > RAYS * 3, "{name}: the rays lost their aim");
    }
}

/// A distance has no direction and a generalized one no length: what the latter is in units of.
#[test]
fn generalized_distances_are_in_units_of_the_direction() {
    let mut rng = Pcg64::seed_from_u64(3);
    for kind in 0..KINDS.len() {
        for _ in 0..500 {
            let shape = Shape::random(&mut rng, kind, 1.0, 4.0);
            let (_, Trial { origin, direction, .. }) = corpus::ray(&mut rng, &shape, 1.0, 1e2);
            let leaf = shape.leaf().unwrap();
            let once = leaf.gsdf(origin, direction);
            for power in [-20, -1, 1, 20] {
                let factor = 2.0_f32.powi(power);
                assert_eq!(leaf.gsdf(origin, direction * factor), once / factor, "{shape:?}");
            }
        }
    }
}
