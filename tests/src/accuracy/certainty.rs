//! Certificates, held against the truth: none may be wrong, and not too many missing.

use super::measure::Cell;
use super::trial::{Reference, Trial};
use crate::doubled::{Ball, Ends};
use core::ops::Range;
use gsdf_nostd::{Bounded, Certificate, IN_DOUBLES, Lane, Leaf, Node, Ray, Solid as _, Span, Unit, certify};
use rayon::prelude::*;

/// How many rays were certain, and whether rightly so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Certainty {
    /// Rays that cross the solid's boundary.
    pub hits: u64,
    /// Those that `f32` was certain of, and those that `f64` was of the others.
    pub certain_hits: [u64; 2],
    /// Rays that do not.
    pub misses: u64,
    /// Those that `f32` was certain of, and those that `f64` was of the others.
    pub certain_misses: [u64; 2],
    /// Rays that were certain of what is between a larger solid and a smaller one.
    pub certain_between: u64,
    /// The first ray of which something was certain that is not so.
    pub wrong: Option<u64>,
}

impl Certainty {
    /// Of these rays and others.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        let both = |a: [u64; 2], b: [u64; 2]| [a[0] + b[0], a[1] + b[1]];
        Self {
            hits: self.hits + other.hits,
            certain_hits: both(self.certain_hits, other.certain_hits),
            misses: self.misses + other.misses,
            certain_misses: both(self.certain_misses, other.certain_misses),
            certain_between: self.certain_between + other.certain_between,
            wrong: [self.wrong, other.wrong].into_iter().flatten().min(),
        }
    }

    /// The share of hits that `f32` is certain of.
    #[must_use]
    pub fn share(&self) -> f64 {
        self.certain_hits[0] as f64 / self.hits.max(1) as f64
    }
}

impl Cell {
    /// Certifies rays, on all threads.
    ///
    /// # Panics
    /// Where the library refuses a solid or a ray, which corpora do not make.
    #[must_use]
    pub fn certainty(self, rays: Range<u64>) -> Certainty {
        let targets: Vec<Range<u64>> = Self::by_target(rays).collect();
        let one = |rays: Range<u64>| {
            let target = self.target(rays.start);
            let solid = target.solid();
            let leaf = solid.leaf().expect("corpora make valid shapes");
            let reference = Reference::new(solid);
            let certain = rays.map(|ray| one_ray(&self.aimed(&target, ray), ray, &leaf, &reference));
            certain.fold(Certainty::default(), Certainty::joined)
        };
        targets.into_par_iter().map(one).reduce(Certainty::default, Certainty::joined)
    }
}

fn one_ray(trial: &Trial, number: u64, leaf: &Leaf, reference: &Reference) -> Certainty {
    let truth = reference
        .swift(trial.origin, trial.direction)
        .unwrap_or_else(|| reference.slow(trial.origin, trial.direction));
    let (single, least) = certified(trial, leaf, 0.0_f32, f64::from);
    let crossing = next(truth, least);
    let mut certainty = Certainty::default();
    let (count, certain) = match crossing {
        Next::At(_) => (&mut certainty.hits, &mut certainty.certain_hits),
        Next::Never => (&mut certainty.misses, &mut certainty.certain_misses),
        // Within the error of the reference's zero: whether it is ahead is a matter of taste.
        Next::Here => return certainty,
    };
    *count = 1;
    let mut is_right = true;
    match single {
        Some(found) => {
            certain[0] = 1;
            is_right &= found.holds(crossing);
        }
        None => {
            if let Some(found) = certified(trial, leaf, 0.0_f64, |t| t).0 {
                certain[1] = 1;
                is_right &= found.holds(crossing);
            }
        }
    }
    if let Some(windows) = between(trial, leaf) {
        certainty.certain_between = 1;
        is_right &= windows.iter().all(|window| window.holds(crossing));
    }
    certainty.wrong = (!is_right).then_some(number);
    certainty
}

/// Where the crossing lies that was certified, in the world; infinite where there is none.
struct Window(f64, f64);

impl Window {
    fn holds(&self, crossing: Next) -> bool {
        match crossing {
            Next::At(t) => t.distance_to(self.0) <= t.error() && t.distance_to(self.1) >= -t.error(),
            Next::Never | Next::Here => self.0 == f64::INFINITY,
        }
    }
}

/// What a certificate says, if it is one; and the least parameter that is ahead.
fn certified<T: Lane>(trial: &Trial, leaf: &Leaf, like: T, to_f64: impl Fn(T) -> f64) -> (Option<Window>, f64) {
    let (ray, in_unit) = ray_of(trial);
    let line = ray.line(like).bounded();
    let span: Span<Bounded<T>> = leaf.span_in_world(&line, trial.solid.pose.as_ref());
    let start = ray.start_on_line(like);
    let in_world = |t: T| to_f64(ray.parameter_of(t)) * in_unit;
    let nodes = [Node::Leaf { solid: *leaf, frame: 0 }];
    let Certificate { t, sure, .. } = certify(&nodes, &[span], start);
    let window = sure.then(|| {
        let (low, high) = if t.value < T::from(f32::INFINITY) {
            t.ends()
        } else {
            (t.value, t.value)
        };
        Window(in_world(low), in_world(high))
    });
    (window, in_world(start))
}

/// A ray, and by what its parameter is to be multiplied to be one in the world.
fn ray_of(trial: &Trial) -> (Ray, f64) {
    let made = match trial.solid.unit {
        Some(unit) => unit.ray(trial.origin, trial.direction),
        None => Ray::new(trial.origin, trial.direction).map(|ray| (ray, Unit::ONE)),
    };
    let (ray, parameter) = made.expect("corpora make valid rays");
    (ray, f64::from(parameter.exponent()).exp2())
}

/// What is certain of a crossing between those of a larger and a smaller solid: where it is in `f32`, and in `f64`.
fn between(trial: &Trial, leaf: &Leaf) -> Option<[Window; 2]> {
    let (ray, in_unit) = ray_of(trial);
    let pose = trial.solid.pose.as_ref();
    let moved = leaf.between(ray.origin().length(), pose)?;
    let [outer, inner] = moved.map(|solid| solid.span_in_world(&ray.line(0.0_f32), pose));
    let span: Span<Bounded<f32>> = Span::within(outer, inner);
    let nodes = [Node::Leaf { solid: *leaf, frame: 0 }];
    let found = certify(&nodes, &[span], ray.start_on_line(0.0));
    if !found.sure {
        return None;
    }
    if found.t.value == f32::INFINITY {
        return Some([Window(f64::INFINITY, f64::INFINITY), Window(f64::INFINITY, f64::INFINITY)]);
    }
    let window = |(low, high): (f64, f64)| Window(ray.parameter_of(low) * in_unit, ray.parameter_of(high) * in_unit);
    let (low, high) = found.t.ends();
    let Span { enter, exit } = leaf.span_in_world(&ray.line(0.0_f64), pose);
    let end = if found.at_enter { enter } else { exit };
    let doubt = f64::from(found.t.error * IN_DOUBLES);
    Some([window((low.into(), high.into())), window((end - doubt, end + doubt))])
}

/// The next crossing.
#[derive(Clone, Copy)]
enum Next {
    At(Ball),
    Never,
    Here,
}

fn next(truth: Option<Ends>, least: f64) -> Next {
    for t in truth.into_iter().flatten().flatten() {
        let value = t.to_f64();
        if (value - least).abs() <= t.error() * 4.0 {
            return Next::Here;
        }
        if value > least {
            return Next::At(t);
        }
    }
    Next::Never
}
