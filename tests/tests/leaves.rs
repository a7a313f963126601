//! Every leaf, along rays of every kind, against exact arithmetic.

use gsdf_tests::corpus::{self, Class};
use gsdf_tests::sandwich::{ROUNDOFF, Trial, computed_span};
use gsdf_tests::shape::{KINDS, SOLIDS, Shape, log_uniform};
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// How many rounding errors, of the size of the numbers that meet there, a surface may seem to be off. The largest
/// ever seen is 4.
const ALLOWED: f64 = 8.0;

/// Rays at each kind of leaf.
const RAYS: u64 = 20_000;

/// The rays at one kind of leaf: near and far, at small and large solids.
fn trials(kind: usize) -> Vec<(Class, Trial)> {
    let mut rng = Pcg64::seed_from_u64(kind as u64);
    (0..RAYS)
        .map(|number| {
            let size = log_uniform(&mut rng, 1e-2, 1e3);
            let shape = Shape::random(&mut rng, kind, size, 4.0);
            let reach = if number % 2 == 0 { 1e2 } else { 1e5 };
            corpus::ray(&mut rng, &shape, size, reach)
        })
        .collect()
}

fn share(count: usize) -> f64 {
    100.0 * count as f64 / RAYS as f64
}

/// A corpus that had stopped aiming would prove nothing: it must hit, start inside, aim at edges, graze, run
/// parallel and start on surfaces often enough.
#[test]
fn the_corpus_keeps_its_quotas() {
    for (kind, name) in KINDS.iter().enumerate() {
        let trials = trials(kind);
        let spans: Vec<_> = trials.par_iter().map(|(_, trial)| trial.exact_span()).collect();
        let ahead = |enter: f64, exit: f64| exit > 0.0 && enter <= exit;
        let hits = spans
            .iter()
            .flatten()
            .filter(|(enter, exit)| ahead(enter.to_f64(), exit.to_f64()))
            .count();
        let inside = spans
            .iter()
            .flatten()
            .filter(|(enter, exit)| enter.to_f64() < 0.0 && exit.to_f64() > 0.0)
            .count();
        let mut classes = BTreeMap::new();
        for (class, _) in &trials {
            *classes.entry(*class).or_insert(0) += 1;
        }
        assert!(share(hits) >= 30.0, "{name}: {} % hits", share(hits));
        assert!(share(inside) >= 10.0 || kind >= SOLIDS, "{name}: {} % inside", share(inside));
        for class in [Class::Edge, Class::Tangent, Class::Parallel, Class::OnSurface] {
            assert!(share(classes[&class]) >= 5.0, "{name}: {} % {class:?}", share(classes[&class]));
        }
    }
}

fn check(roundoff: f64, span: impl Fn(&Trial) -> (f64, f64) + Sync) {
    for (kind, name) in KINDS.iter().enumerate() {
        let trials = trials(kind);
        let worst = trials
            .par_iter()
            .map(|(class, trial)| (trial.roundings(span(trial), roundoff), class, trial))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .unwrap();
        println!("{name}: off by at most {} rounding errors, {:?}", worst.0, worst.1);
        assert!(
            worst.0 <= ALLOWED,
            "{name}: off by {} rounding errors: {:?} {:?}, span {:?}",
            worst.0,
            worst.1,
            worst.2,
            span(worst.2)
        );
    }
}

/// Entry, exit and the decision between hit and miss: wherever the computed span disagrees with the exact one, the
/// ray is within rounding of the surface.
#[test]
fn spans_in_single_precision_are_right_to_rounding() {
    check(ROUNDOFF, |trial| computed_span(trial, 0.0_f32));
}

/// The same formulas in double precision owe nothing to single precision.
#[test]
fn spans_in_double_precision_are_right_to_its_rounding() {
    check(f64::EPSILON / 2.0, |trial| computed_span(trial, 0.0_f64));
}
