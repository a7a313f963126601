//! The solids that are programs, along rays and at points, against exact arithmetic and their definitions.

use glam::{DVec3, Vec3};
use gsdf_nostd::{BoxFrame, Crossing, DoubleCone, Ray, Span, SphereTracer, Traced, WideSolidAngle};
use gsdf_tests::corpus::jittered;
use gsdf_tests::reference::ExactVec3;
use gsdf_tests::sandwich::{ROUNDOFF, disagreements};
use gsdf_tests::shape::composed::{COMPOSED, Composed};
use gsdf_tests::shape::{across, log_uniform, unit};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors of the numbers that meet a surface or a distance may be off.
const ALLOWED: f64 = 8.0;

/// What the library makes of the parameters.
#[derive(Clone, Copy, Debug)]
enum Built {
    BoxFrame(BoxFrame),
    DoubleCone(DoubleCone),
    WideSolidAngle(WideSolidAngle),
}

/// The same question to whichever solid it is.
macro_rules! ask {
    ($built:expr, $solid:ident => $question:expr) => {
        match $built {
            Built::BoxFrame($solid) => $question,
            Built::DoubleCone($solid) => $question,
            Built::WideSolidAngle($solid) => $question,
        }
    };
}

impl Built {
    fn new(solid: &Composed) -> Self {
        match *solid {
            Composed::BoxFrame { min, max, thickness } => Self::BoxFrame(BoxFrame::new(min, max, thickness).unwrap()),
            Composed::DoubleCone {
                apex,
                axis,
                radius,
                height,
            } => Self::DoubleCone(DoubleCone::new(apex, axis, radius, height).unwrap()),
            Composed::WideSolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => Self::WideSolidAngle(WideSolidAngle::new(apex, axis, reach, radius, height).unwrap()),
        }
    }

    fn sdf(&self, point: Vec3) -> f64 {
        ask!(self, solid => solid.sdf(point)).into()
    }

    fn gsdf(&self, point: Vec3, direction: Vec3) -> f64 {
        ask!(self, solid => solid.gsdf(point, direction)).into()
    }

    /// The distance the nodes give, which is a bound.
    fn bound(&self, point: Vec3) -> f64 {
        ask!(self, solid => solid.program().sdf(point)).into()
    }

    /// What sphere tracing over the solid's own distance comes to.
    fn traced(&self, tracer: &SphereTracer, ray: &Ray) -> Traced<f32> {
        ask!(self, solid => tracer.cast(solid, ray))
    }

    /// Whether the ray starts inside, and where it crosses the surface.
    fn along(&self, ray: Ray) -> (bool, Vec<Crossing<f32>>) {
        let mut scratch = [Span::EMPTY; 8];
        ask!(self, solid => {
            let program = solid.program();
            let sight = program.program().along(ray, &mut scratch).unwrap();
            (sight.march::<f32>().inside, sight.crossings().collect())
        })
    }
}

/// Four units in the last place, of the numbers that meet, are eight rounding errors.
const FOUR_ULP: f64 = 8.0 * ROUNDOFF;

/// A solid with a seed of its own.
fn random(kind: usize, seed: u64) -> (Pcg64, Composed, Built, f64) {
    let mut rng = Pcg64::seed_from_u64(seed * COMPOSED.len() as u64 + kind as u64);
    let size = log_uniform(&mut rng, 1e-2, 1e3);
    let solid = Composed::random(&mut rng, kind, size);
    (rng, solid, Built::new(&solid), size)
}

fn point(rng: &mut impl Rng, solid: &Composed, size: f64) -> Vec3 {
    let (on, normal) = solid.surface(rng);
    match rng.random_range(0..3) {
        0 => (on - normal * size * log_uniform(rng, 1e-4, 0.3)).as_vec3(),
        1 => (solid.edge_point(rng) + unit(rng) * size * log_uniform(rng, 1e-4, 10.0)).as_vec3(),
        _ => (on + unit(rng) * size * log_uniform(rng, 1e-4, 10.0)).as_vec3(),
    }
}

/// A ray at the surface, at an edge, from within, along the surface, from it, or anyhow.
fn ray(rng: &mut Pcg64, solid: &Composed, size: f64) -> (Vec3, Vec3) {
    let (on, normal) = solid.surface(rng);
    let distance = size * log_uniform(rng, 0.5, 1e3);
    let toward = |target: DVec3, direction: DVec3| {
        let from = (target - direction * distance).as_vec3();
        (from, (target - from.as_dvec3()).normalize().as_vec3())
    };
    match rng.random_range(0..10) {
        0..3 => toward(on, unit(rng)),
        3..5 => toward(solid.edge_point(rng), unit(rng)),
        5..7 => ((on - normal * size * log_uniform(rng, 1e-4, 0.3)).as_vec3(), unit(rng).as_vec3()),
        7 => {
            let along = across(rng, normal);
            let (from, direction) = toward(on, along);
            (jittered(rng, from, 32), direction)
        }
        8 => (on.as_vec3(), unit(rng).as_vec3()),
        _ => ((unit(rng) * distance).as_vec3(), unit(rng).as_vec3()),
    }
}

/// Every entry and exit of 20,000 rays: wherever the computed spans disagree with the exact ones, the ray is within
/// rounding of the surface.
#[test]
fn crossings_are_those_of_exact_arithmetic() {
    const RAYS: u64 = 20_000;
    for (kind, name) in COMPOSED.iter().enumerate() {
        let outcomes = (0..RAYS).into_par_iter().map(|seed| {
            let (mut rng, solid, built, size) = random(kind, seed);
            let (origin, direction) = ray(&mut rng, &solid, size);
            let (inside, crossings) = built.along(Ray::new(origin, direction).unwrap());
            let mut ends: Vec<f64> = crossings.iter().map(|crossing| f64::from(crossing.t)).collect();
            let first = ends.first().copied().unwrap_or(f64::INFINITY);
            let along = built.gsdf(origin, direction);
            assert_eq!(
                along,
                if inside { -first } else { first },
                "{name}: {solid:?} from {origin} along {direction}"
            );
            if inside {
                ends.insert(0, 0.0);
            }
            if ends.len() % 2 == 1 {
                ends.push(f64::INFINITY);
            }
            let computed: Vec<_> = ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
            let exact: Vec<_> = (solid.exact(0.0).spans(origin, direction).iter())
                .map(|(enter, exit)| (enter.to_f64().max(0.0), exit.to_f64()))
                .filter(|(enter, exit)| enter < exit)
                .collect();
            for (t, is_inside) in disagreements(&exact, &computed) {
                let scale = origin.as_dvec3().length() + solid.extent() + t.abs() * direction.as_dvec3().length();
                let offset = ALLOWED * ROUNDOFF * scale;
                let at = &ExactVec3::from(origin) + &ExactVec3::from(direction).times(&t.into());
                let moved = solid.exact(if is_inside { -offset } else { offset }).contains(at);
                assert!(
                    t < 0.0 || moved != is_inside,
                    "{name}: at {t} of {origin} along {direction}: {computed:?}, exactly {exact:?}, of {solid:?}"
                );
            }
            [!crossings.is_empty(), inside, computed.len() > 1].map(usize::from)
        });
        let [hits, inside, several] = outcomes.reduce(|| [0; 3], |a, b| [a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
        println!("{name}: {hits} of {RAYS} rays hit, {inside} start inside, {several} go in more than once");
        assert!(
            hits as u64 * 3 > RAYS && inside as u64 * 10 > RAYS,
            "{name}: the rays lost their aim"
        );
        assert!(several as u64 * 50 > RAYS, "{name}: too few rays go in more than once");
    }
}

/// Of 200,000 points, those farther from the surface than rounding are inside or outside by definition, and as far from
/// the surface as its nearest point; what the nodes give is of the same sign and no larger.
#[test]
fn points_are_inside_by_definition_and_distances_to_the_nearest_point() {
    const SOLIDS: u64 = 2_000;
    const POINTS: usize = 100;
    for (kind, name) in COMPOSED.iter().enumerate() {
        let outcomes = (0..SOLIDS).into_par_iter().map(|seed| {
            let (mut rng, solid, built, size) = random(kind, seed);
            let (mut inside, mut worst) = (0, 0.0_f64);
            for _ in 0..POINTS {
                let place = point(&mut rng, &solid, size);
                let at = place.as_dvec3();
                let rounding = ROUNDOFF * (at.length() + solid.extent());
                let (holds, distance) = (solid.holds(at), solid.to_surface(at));
                let signed = if holds { -distance } else { distance };
                inside += usize::from(holds);
                let (sdf, bound) = (built.sdf(place), built.bound(place));
                let off = (sdf - signed).abs() / rounding;
                assert!(
                    off <= ALLOWED,
                    "{name}: {sdf} and not {signed}, off by {off} rounding errors, at {place}: {solid:?}"
                );
                worst = worst.max(off);
                assert!(
                    bound.abs() <= distance + ALLOWED * rounding,
                    "{name}: nodes give {bound}, it is {signed} at {place}: {solid:?}"
                );
                if distance > ALLOWED * rounding {
                    assert_eq!(
                        bound < 0.0,
                        holds,
                        "{name}: nodes give {bound}, it is {signed} at {place}: {solid:?}"
                    );
                    let along = built.gsdf(place, unit(&mut rng).as_vec3());
                    assert_eq!(along < 0.0, holds, "{name}: {along} along a ray from {place}: {solid:?}");
                }
                let other = (at + unit(&mut rng) * size * log_uniform(&mut rng, 1e-7, 10.0)).as_vec3();
                let apart = (other.as_dvec3() - at).length();
                let larger = ROUNDOFF * (at.length().max(other.as_dvec3().length()) + solid.extent());
                let change = (built.sdf(other) - sdf).abs();
                assert!(
                    change <= apart + FOUR_ULP / ROUNDOFF * larger,
                    "{name}: {change} from {place} to {other}, {apart} apart: {solid:?}"
                );
            }
            (inside, worst)
        });
        let (inside, worst) = outcomes.reduce(|| (0, 0.0), |a, b| (a.0 + b.0, a.1.max(b.1)));
        let points = SOLIDS as usize * POINTS;
        println!("{name}: {inside} of {points} points are inside; distances are off by at most {worst:.1} rounding errors");
        assert!(
            inside * 10 > points && inside * 10 < 9 * points,
            "{name}: {inside} of {points} points inside"
        );
    }
}

/// Without relaxation: where a march ends the distance is at most epsilon, and the exact crossing is not passed by more
/// than four units in the last place.
#[test]
fn a_marcher_stops_at_the_surface_and_never_beyond() {
    const RAYS: u64 = 2_000;
    let tracer = SphereTracer {
        relaxation: 1.0,
        max_steps: 512,
        ..SphereTracer::default()
    };
    for (kind, name) in COMPOSED.iter().enumerate() {
        let outcomes = (0..RAYS).into_par_iter().map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed * COMPOSED.len() as u64 + kind as u64);
            let solid = Composed::random(&mut rng, kind, 1.0);
            let built = Built::new(&solid);
            let (origin, direction) = ray(&mut rng, &solid, 1.0);
            let traced = built.traced(&tracer, &Ray::new(origin, direction).unwrap().within(0.0..1e4).unwrap());
            if !traced.hit {
                return (0, 0.0_f64);
            }
            let t = f64::from(traced.t);
            let place = origin.as_dvec3() + direction.as_dvec3() * t;
            let scale = origin.as_dvec3().length() + solid.extent() + t;
            let left = solid.to_surface(place);
            assert!(
                left <= f64::from(tracer.epsilon) * t.max(1.0) + FOUR_ULP * scale,
                "{name}: stopped {left} off the surface, from {origin} along {direction}: {solid:?}"
            );
            let Some(exact) = solid.exact(0.0).along(origin, direction).first_crossing_after(0.0) else {
                return (1, 0.0);
            };
            let beyond = (t - exact.t.to_f64()) / (FOUR_ULP * scale);
            // A start on the surface has that crossing behind it as well as ahead, by rounding; and a ray along the
            // surface may cross it there or later.
            let near =
                |offset: f64, at: DVec3| solid.exact(offset).contains(at.to_array()) && !solid.exact(-offset).contains(at.to_array());
            let middle = origin.as_dvec3() + direction.as_dvec3() * exact.t.to_f64().midpoint(t);
            let excused = near(FOUR_ULP * scale, origin.as_dvec3()) || near(FOUR_ULP * scale, middle);
            assert!(
                beyond <= 1.0 || excused,
                "{name}: {t} is beyond {:?}, {beyond} of what is allowed, from {origin} along {direction}: {solid:?}",
                exact.t
            );
            (1, if excused { 0.0 } else { beyond })
        });
        let (hits, worst) = outcomes.reduce(|| (0, 0.0), |a, b| (a.0 + b.0, a.1.max(b.1)));
        println!(
            "{name}: {hits} of {RAYS} marches stop, at most {:.1} units in the last place beyond",
            4.0 * worst
        );
        assert!(hits * 4 > RAYS, "{name}: only {hits} of {RAYS} marches stop");
    }
}
