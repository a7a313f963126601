//! What no forward bound holds: rays whose hit or miss is wrong, and crossings that rounding can make any other. There the
//! answer must still be right for numbers that are off by rounding errors.

use super::measure::Cell;
use super::statistics::Worst;
use super::trial::{Arithmetic, Reference, Trial};
use crate::doubled::{Ball, Ends};
use core::ops::Range;
use rayon::prelude::*;

/// What was found where no forward bound holds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Backward {
    /// The rays that had such an answer.
    pub rays: u64,
    /// How many rounding errors the numbers must be off for all of them to be right, at the most.
    pub roundings: Worst,
}

impl Backward {
    /// What was found of these rays and others.
    #[must_use]
    pub fn joined(mut self, other: Self) -> Self {
        self.rays += other.rays;
        self.roundings.see(other.roundings);
        self
    }
}

impl Cell {
    /// Of rays by their numbers, those that no forward bound holds, in one arithmetic.
    ///
    /// # Panics
    /// Where the library refuses a solid, which corpora do not make.
    #[must_use]
    pub fn backward(self, rays: Range<u64>, arithmetic: Arithmetic) -> Backward {
        let of_one = |target: Range<u64>| {
            let solid = self.trial(target.start).solid;
            let (reference, leaf) = (Reference::new(solid), solid.leaf().expect("corpora make valid shapes"));
            let mut found = Backward::default();
            for ray in target {
                let trial = self.trial(ray);
                let computed = trial.computed(&leaf, arithmetic);
                if let Some(error) = off(&reference, &trial, computed, arithmetic.roundoff()) {
                    found = found.joined(Backward {
                        rays: 1,
                        roundings: Worst { error, ray },
                    });
                }
            }
            found
        };
        let targets: Vec<Range<u64>> = Self::by_target(rays).collect();
        targets.into_par_iter().map(of_one).reduce(Backward::default, Backward::joined)
    }
}

/// How many rounding errors explain an answer that no forward bound holds; [`None`] where one does.
fn off(reference: &Reference, trial: &Trial, computed: Option<[f64; 2]>, roundoff: f64) -> Option<f64> {
    let ray = (trial.origin, trial.direction);
    let truth = reference
        .swift(trial.origin, trial.direction)
        .unwrap_or_else(|| reference.slow(trial.origin, trial.direction));
    let near = |t: f64| reference.nearness(ray, t, roundoff);
    match (computed, truth) {
        (None, None) => None,
        // Between the ends of a span that is not there, the surface is as near as all that.
        (Some([enter, exit]), None) => Some(near(between(enter, exit))),
        (None, Some(ends)) => Some(near(between(end(ends, 0), end(ends, 1)))),
        (Some(found), Some(ends)) => {
            let of_end = |index: usize| {
                let found = found[index];
                match ends[index].filter(|_| found.is_finite()) {
                    Some(t) => {
                        let condition = reference.condition(ray, t, found, roundoff);
                        (condition.is_infinite() && t.to_f64() != found).then(|| near(found))
                    }
                    None if found.is_finite() => Some(near(found)),
                    None => ends[index].map(|t| near(t.to_f64())),
                }
            };
            // The exit of a facet is no crossing.
            let count = if trial.solid.shape.is_facet() { 1 } else { 2 };
            (0..count).filter_map(of_end).reduce(f64::max)
        }
    }
}

/// An end of a true span: the first infinite to the back, the second to the front.
fn end(ends: Ends, index: usize) -> f64 {
    let infinite = [f64::NEG_INFINITY, f64::INFINITY][index];
    ends[index].map_or(infinite, Ball::to_f64)
}

/// The middle of a span, or an end that is not infinite.
fn between(enter: f64, exit: f64) -> f64 {
    match (enter.is_finite(), exit.is_finite()) {
        (true, true) => f64::midpoint(enter, exit),
        (true, false) => enter,
        (false, true) => exit,
        (false, false) => 0.0,
    }
}
