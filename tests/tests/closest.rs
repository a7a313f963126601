//! The standard distance against the nearest point of the surface, searched for on the surface; and that it changes
//! no faster than the point.

use glam::{DVec3, Vec3};
use gsdf_nostd::{Leaf, Solid};
use gsdf_tests::sandwich::ROUNDOFF;
use gsdf_tests::shape::{KINDS, Shape, log_uniform, unit};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors of the numbers that meet a distance may be off.
const ALLOWED: f64 = 8.0;

/// Four units in the last place, of the numbers that meet.
const FOUR_ULP: f64 = 8.0 * ROUNDOFF;

const SOLIDS: u64 = 1_000;
const POINTS: usize = 20;

/// A point at a solid: near its surface, at an edge, or anywhere about.
fn point(rng: &mut Pcg64, shape: &Shape, size: f64, number: usize) -> Vec3 {
    let from = if number.is_multiple_of(2) {
        shape.surface(rng).0
    } else {
        shape.edge_point(rng)
    };
    (from + unit(rng) * size * log_uniform(rng, 1e-4, 10.0)).as_vec3()
}

fn for_solids(kind: usize, check: impl Fn(&mut Pcg64, &Shape, Leaf, f64) -> f64 + Sync) -> f64 {
    let worst = (0..SOLIDS).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
        let size = log_uniform(&mut rng, 1e-2, 1e3);
        let shape = Shape::random(&mut rng, kind, size, 4.0);
        check(&mut rng, &shape, shape.leaf().unwrap(), size)
    });
    worst.reduce(|| 0.0, f64::max)
}

/// The length and the sign.
#[test]
fn distances_are_those_to_the_nearest_point() {
    for (kind, name) in KINDS.iter().enumerate() {
        let worst = for_solids(kind, |rng, shape, leaf, size| {
            let mut worst = 0.0_f64;
            for number in 0..POINTS {
                let place = point(rng, shape, size, number);
                let at: DVec3 = place.as_dvec3();
                let distance = shape.to_surface(at);
                let signed = if shape.holds(at) { -distance } else { distance };
                let off = (f64::from(leaf.sdf(place)) - signed).abs() / (ROUNDOFF * (at.length() + shape.extent()));
                assert!(
                    off <= ALLOWED,
                    "{name}: {} and not {signed}, off by {off} rounding errors, at {place}: {shape:?}",
                    leaf.sdf(place)
                );
                worst = worst.max(off);
            }
            worst
        });
        println!("{name}: off by at most {worst:.1} rounding errors");
    }
}

/// Two points' distances differ by no more than the points are apart, and four units in the last place.
#[test]
fn distances_change_no_faster_than_the_point() {
    for (kind, name) in KINDS.iter().enumerate() {
        let worst = for_solids(kind, |rng, shape, leaf, size| {
            let mut worst = 0.0_f64;
            for number in 0..POINTS {
                let first = point(rng, shape, size, number);
                let second = (first.as_dvec3() + unit(rng) * size * log_uniform(rng, 1e-7, 10.0)).as_vec3();
                let apart = (first.as_dvec3() - second.as_dvec3()).length();
                let [from, to] = [first, second].map(|point| f64::from(leaf.sdf(point)));
                let scale = first.as_dvec3().length().max(second.as_dvec3().length()) + shape.extent();
                let excess = ((from - to).abs() - apart) / (FOUR_ULP * scale);
                assert!(
                    excess <= 1.0,
                    "{name}: {from} at {first}, {to} at {second}, {apart} apart: {excess} of what is allowed: {shape:?}"
                );
                worst = worst.max(excess);
            }
            worst
        });
        println!("{name}: {:.1} units in the last place more than the way", 4.0 * worst);
    }
}
