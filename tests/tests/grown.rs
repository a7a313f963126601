//! Solids whose surfaces are moved outward or inward are where they should be.

use glam::DVec3;
use gsdf_nostd::{Leaf, Solid, V3};
use gsdf_tests::shape::{KINDS, Shape, log_uniform, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Solids of each kind.
const SOLIDS: u64 = 3000;

fn distance(leaf: &Leaf, point: DVec3) -> f64 {
    leaf.distance(V3::new(point.x, point.y, point.z))
}

/// Around all that is within the length of the solid, and no farther from its faces; within all that is as deep in it.
#[test]
fn grown_solids_are_as_far_from_what_they_were_as_is_said() {
    for (kind, name) in KINDS.iter().enumerate() {
        let (mut larger, mut smaller, mut within) = (0, 0, 0);
        for seed in 0..SOLIDS {
            let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
            let size = log_uniform(&mut rng, 1e-2, 1e3);
            let shape = Shape::random(&mut rng, kind, size, 4.0);
            let leaf = shape.leaf().unwrap();
            let by = size * log_uniform(&mut rng, 1e-3, 0.2);
            let tolerance = 1e-6 * (shape.extent() + by);
            let (point, outward) = shape.surface(&mut rng);
            if let Some(outer) = leaf.grown(by as f32) {
                larger += 1;
                let across = distance(&outer, point + outward * by);
                assert!(across.abs() <= tolerance, "{name} {seed}: {across} of {by}, {leaf:?}");
                let near = point + unit(&mut rng) * (by * rng.random_range(0.0..1.0));
                let off = distance(&outer, near);
                assert!(off <= tolerance, "{name} {seed}: {off} of {by}, {leaf:?}");
            }
            if let Some(inner) = leaf.grown(-by as f32) {
                smaller += 1;
                let deep = point - outward * (by + tolerance + size * rng.random_range(0.0..0.5));
                if distance(&inner, deep) < -tolerance {
                    within += 1;
                    let depth = distance(&leaf, deep);
                    assert!(depth <= tolerance - by, "{name} {seed}: {depth} of {by}, {leaf:?}");
                }
            }
        }
        println!("{name}: {larger} larger, {smaller} smaller, {within} points within these");
        if !["half-space", "cylinder", "nappe", "solid angle", "triangle", "quad"].contains(name) {
            assert!(larger > SOLIDS / 2 && smaller > SOLIDS / 2 && within > 300, "{name}");
        } else {
            assert_eq!((larger, smaller), (0, 0), "{name}");
        }
    }
}
