//! Times and errors, measured by turns.

use super::contender::{Contender, Seen};
use super::scene::Scene;
use anyhow::Result;
use gsdf_nostd::Span;
use std::hint::black_box;
use std::time::Instant;

/// What each ray meets, in `f64`.
#[derive(Clone, Debug)]
pub struct Truth(Vec<Option<(f64, u32)>>);

impl Truth {
    /// What the rays of a scene meet.
    ///
    /// # Errors
    /// Where the scene is none, which reference scenes are not.
    pub fn of(scene: &Scene) -> Result<Self> {
        let program = scene.program()?;
        let mut spans = vec![Span::empty_like(0.0_f64); program.leaves()];
        let mut met = Vec::with_capacity(scene.rays.len());
        for ray in &scene.rays {
            let first = program.along(*ray, &mut spans)?.crossings().next();
            met.push(first.map(|crossing| (crossing.t, crossing.leaf)));
        }
        Ok(Self(met))
    }
}

/// What became of a contender on a scene.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Measured {
    /// The scene.
    pub scene: &'static str,
    /// The contender.
    pub contender: String,
    /// Nanoseconds per ray: the median of the rounds.
    pub ns: f64,
    /// The least that the median of all rounds there could be is, with 95 % confidence: order statistics.
    pub ns_low: f64,
    /// The most.
    pub ns_high: f64,
    /// The relative error of the distance that one hit in a hundred exceeds.
    pub p99: f64,
    /// The largest.
    pub worst: f64,
    /// Rays that meet something and are said to miss, or the other way round.
    pub wrong: usize,
    /// Rays that are said to meet another leaf; nothing where a method does not tell.
    pub wrong_leaf: Option<usize>,
    /// The rays.
    pub rays: usize,
    /// Whether no other contender is both faster and more accurate.
    pub is_best: bool,
}

/// Measures contenders on a scene: by turns, so that a machine which slows down does so for all.
///
/// # Errors
/// Where the scene is none, which reference scenes are not.
pub fn measure(scene: &Scene, contenders: &[Contender], rounds: usize, mut progress: impl FnMut()) -> Result<Vec<Measured>> {
    let truth = Truth::of(scene)?;
    let mut seen = Vec::new();
    let mut times = vec![Vec::with_capacity(rounds); contenders.len()];
    let mut measured = Vec::new();
    for contender in contenders {
        // Once without a clock: what it says does not depend on the round.
        contender.cast(scene, &mut seen)?;
        measured.push(judged(scene, contender, &truth, &seen));
    }
    for _ in 0..rounds {
        for (contender, times) in contenders.iter().zip(&mut times) {
            let start = Instant::now();
            contender.cast(scene, &mut seen)?;
            black_box(&seen);
            times.push(start.elapsed().as_secs_f64() * 1e9 / scene.rays.len() as f64);
        }
        progress();
    }
    for (measured, times) in measured.iter_mut().zip(&mut times) {
        times.sort_by(f64::total_cmp);
        measured.ns = times[times.len() / 2];
        (measured.ns_low, measured.ns_high) = interval(times);
    }
    mark_best(&mut measured);
    Ok(measured)
}

/// Around the median of sorted times: the ranks that a binomial distribution leaves out on either side.
fn interval(sorted: &[f64]) -> (f64, f64) {
    let count = sorted.len() as f64;
    let rank = ((count - 1.96 * count.sqrt()) / 2.0).floor().max(0.0) as usize;
    (sorted[rank.min(sorted.len() - 1)], sorted[sorted.len() - 1 - rank])
}

fn judged(scene: &Scene, contender: &Contender, truth: &Truth, seen: &[Seen]) -> Measured {
    let (mut errors, mut wrong, mut wrong_leaf) = (Vec::new(), 0, 0);
    for (seen, truth) in seen.iter().zip(&truth.0) {
        match truth {
            Some((t, leaf)) if seen.t.is_finite() => {
                errors.push((f64::from(seen.t) - t).abs() / t);
                wrong_leaf += usize::from(seen.leaf.is_some_and(|found| found != *leaf));
            }
            None if !seen.t.is_finite() => {}
            _ => wrong += 1,
        }
    }
    errors.sort_by(f64::total_cmp);
    let last = errors.len().saturating_sub(1);
    let at = |rank: usize| errors.get(rank).copied().unwrap_or(0.0);
    Measured {
        scene: scene.name,
        contender: contender.to_string(),
        ns: 0.0,
        ns_low: 0.0,
        ns_high: 0.0,
        p99: at(last - last / 100),
        worst: at(last),
        wrong,
        wrong_leaf: (!contender.is_traced()).then_some(wrong_leaf),
        rays: scene.rays.len(),
        is_best: false,
    }
}

/// Marks those that no other one beats: the Pareto front.
fn mark_best(measured: &mut [Measured]) {
    let all: Vec<(f64, f64)> = measured.iter().map(|one| (one.ns, one.p99)).collect();
    for (number, one) in measured.iter_mut().enumerate() {
        let beaten = |(other, (ns, p99)): (usize, &(f64, f64))| {
            other != number && *ns <= one.ns && *p99 <= one.p99 && (*ns < one.ns || *p99 < one.p99)
        };
        one.is_best = !all.iter().enumerate().any(beaten);
    }
}

#[cfg(test)]
mod tests {
    use super::interval;

    #[test]
    fn an_interval_holds_the_median() {
        let times: Vec<f64> = (0..25).map(f64::from).collect();
        let (low, high) = interval(&times);
        assert_eq!((low, high), (7.0, 17.0));
        assert_eq!(interval(&[3.0]), (3.0, 3.0));
    }
}
