//! What is inside, by both distances, against the definition of each solid.

use gsdf_nostd::Solid;
use gsdf_tests::sandwich::ROUNDOFF;
use gsdf_tests::shape::{KINDS, Shape, log_uniform, unit};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors of the numbers that meet a surface may be off.
const ALLOWED: f64 = 8.0;

const SOLIDS: u64 = 2_000;
const POINTS: usize = 100;

/// Of 200,000 points at each kind of solid, near its surface and far, those that are farther from it than rounding are
/// inside or outside as they should be: by the sign of the distance, and by that of the distance along a ray.
#[test]
fn points_are_inside_where_the_definition_says_so() {
    for (kind, name) in KINDS.iter().enumerate() {
        let counts = (0..SOLIDS).into_par_iter().map(|seed| {
            let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
            let size = log_uniform(&mut rng, 1e-2, 1e3);
            let shape = Shape::random(&mut rng, kind, size, 4.0);
            let leaf = shape.leaf().unwrap();
            let (mut inside, mut near) = (0, 0);
            for _ in 0..POINTS {
                let (on, normal) = shape.surface(&mut rng);
                let (away, depth) = (log_uniform(&mut rng, 1e-4, 2.0), log_uniform(&mut rng, 1e-4, 0.5));
                let point = (on + (unit(&mut rng) * away - normal * depth) * size).as_vec3();
                let distance = leaf.sdf(point);
                let along = leaf.gsdf(point, unit(&mut rng).as_vec3());
                let holds = shape.holds(point.as_dvec3());
                inside += usize::from(holds);
                if f64::from(distance).abs() <= ALLOWED * ROUNDOFF * (point.as_dvec3().length() + shape.extent()) {
                    near += 1;
                    continue;
                }
                assert_eq!(distance < 0.0, holds, "{name}: {distance} at {point}: {shape:?}");
                assert_eq!(along < 0.0, holds, "{name}: {along} along a ray from {point}: {shape:?}");
            }
            (inside, near)
        });
        let (inside, near) = counts.reduce(|| (0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
        let points = SOLIDS as usize * POINTS;
        println!("{name}: {inside} of {points} points are inside, {near} too near to tell");
        assert!(
            near * 50 < points,
            "{name}: {near} of {points} points are said to be on the surface"
        );
        let both = inside * 10 > points && inside * 10 < 9 * points;
        assert!(both || inside == 0 && near < points, "{name}: {inside} of {points} points inside");
    }
}
