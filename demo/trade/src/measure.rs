//! Times and errors, measured by turns.

use crate::cast::Ready;
use crate::contender::Contender;
use crate::statistics::Estimate;
use crate::subject::Subject;
use anyhow::{Context, Result};
use gsdf_nostd::Span;
use gsdf_simd::Level;
use rayon::ThreadPoolBuilder;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// What became of a contender on a subject.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Measured {
    /// The subject.
    pub scene: String,
    /// The contender.
    pub contender: String,
    /// Nanoseconds per ray: the median of the rounds.
    pub ns: f64,
    /// The least that the median of all rounds there could be is, with 95 % confidence: order statistics.
    pub ns_low: f64,
    /// The most.
    pub ns_high: f64,
    /// How many times as long as tiles a ray takes: the median of the rounds, each compared within itself.
    pub ratio: f64,
    /// The least that the median of all rounds there could be is, with 95 % confidence.
    pub ratio_low: f64,
    /// The most.
    pub ratio_high: f64,
    /// The relative error of the distance that one hit in a hundred exceeds.
    pub p99: f64,
    /// The largest.
    pub worst: f64,
    /// Rays that meet something and are said to miss, or the other way round.
    pub wrong: usize,
    /// Rays that are said to meet another leaf; nothing where a method does not tell.
    pub wrong_leaf: Option<usize>,
    /// The rays that are cast in each round.
    pub rays: usize,
    /// Those of them of which it is known what they meet.
    pub judged: usize,
    /// Whether no other contender is both faster and more accurate.
    pub is_best: bool,
}

/// Measures contenders on a subject, one after the other in every round: a machine that slows down does so for all. All of
/// them compute on one thread.
///
/// Where there is a `limit`, who would take longer than that in a round casts fewer rays; and `f64` arithmetic, which tells
/// what is right, is given eight times as long, once.
///
/// # Errors
/// Where the subject is no program, or there is no thread.
pub fn measure(
    subject: &Subject<'_>,
    contenders: &[Contender],
    rounds: usize,
    limit: Option<Duration>,
    progress: impl FnMut() + Send,
) -> Result<Vec<Measured>> {
    alone(|| race(subject, contenders, rounds, limit, progress))
}

impl Subject<'_> {
    /// Takes a picture of half the sides, or a quarter and so on, where tiles of a larger one take too long on one thread: more
    /// than twenty times the limit, since nobody else casts rays as fast.
    ///
    /// # Errors
    /// As [`look`](Self::look).
    pub fn fit(&mut self, level: Level, limit: Duration) -> Result<()> {
        /// The side of a picture that is taken whatever it takes.
        const LEAST: u32 = 16;
        let raster = self.raster();
        let halved = |halvings: u32| {
            let side = |side: u32| (side >> halvings).max(1);
            raster.camera().raster(side(raster.width()), side(raster.height()))
        };
        // From small to large: what each takes is known when it is over.
        let most = raster.width().max(raster.height()).div_ceil(LEAST).ilog2();
        for halvings in (0..=most).rev() {
            self.look(halved(halvings))?;
            let took = alone(|| {
                let mut tiles = Contender::tiles(level).ready(self)?;
                let begin = Instant::now();
                tiles.cast(self.rays().len())?;
                Ok(begin.elapsed())
            })?;
            if took > 20 * limit {
                return self.look(halved((halvings + 1).min(most)));
            }
        }
        Ok(())
    }
}

/// Does something on a thread of its own, and on no other one.
fn alone<R: Send>(work: impl FnOnce() -> Result<R> + Send) -> Result<R> {
    let pool = ThreadPoolBuilder::new().num_threads(1).build();
    pool.context("cannot start a thread")?.install(work)
}

fn race(
    subject: &Subject<'_>,
    contenders: &[Contender],
    rounds: usize,
    limit: Option<Duration>,
    mut progress: impl FnMut(),
) -> Result<Vec<Measured>> {
    let truth = truth(subject, limit.map(|limit| 8 * limit))?;
    let mut ready = Vec::new();
    let mut measured = Vec::new();
    for contender in contenders {
        let mut contender = contender.ready(subject)?;
        let turn = match limit {
            Some(limit) => Turn::of(&mut contender, subject.rays().len(), limit)?,
            None => Turn {
                rays: subject.rays().len(),
                times: 1,
            },
        };
        // Once without a clock: what it says does not depend on the round.
        contender.cast(turn.rays)?;
        measured.push(judged(subject, &contender, turn.rays, &truth));
        ready.push((contender, turn));
    }
    let mut times = vec![Vec::with_capacity(rounds); contenders.len()];
    for _ in 0..rounds {
        for ((contender, turn), times) in ready.iter_mut().zip(&mut times) {
            let begin = Instant::now();
            for _ in 0..turn.times {
                contender.cast(turn.rays)?;
                black_box(&contender);
            }
            let count = turn.rays * turn.times;
            times.push(begin.elapsed().as_secs_f64() * 1e9 / count as f64);
        }
        progress();
    }
    let base = contenders.iter().position(Contender::is_base).unwrap_or(0);
    let base = times.get(base).cloned().unwrap_or_default();
    for (measured, times) in measured.iter_mut().zip(times) {
        let ratios = times.iter().zip(&base).map(|(own, base)| own / base).collect();
        let (ns, ratio) = (Estimate::of(times), Estimate::of(ratios));
        (measured.ns, measured.ns_low, measured.ns_high) = (ns.median, ns.low, ns.high);
        (measured.ratio, measured.ratio_low, measured.ratio_high) = (ratio.median, ratio.low, ratio.high);
    }
    mark_best(&mut measured);
    Ok(measured)
}

/// What the rays meet, in `f64`; of as many as there is time for.
fn truth(subject: &Subject<'_>, limit: Option<Duration>) -> Result<Vec<Option<(f64, u32)>>> {
    /// Of so many rays it is known however long that takes.
    const LEAST: usize = 64;
    let program = subject.program()?;
    let mut spans = vec![Span::empty_like(0.0_f64); program.leaves()];
    let begin = Instant::now();
    let mut met = Vec::new();
    for ray in subject.rays() {
        if met.len() >= LEAST && limit.is_some_and(|limit| begin.elapsed() >= limit) {
            break;
        }
        let first = program.along(*ray, &mut spans)?.crossings().next();
        met.push(first.map(|crossing| (crossing.t, crossing.leaf)));
    }
    Ok(met)
}

/// What a contender does in a round.
struct Turn {
    /// How many rays it casts.
    rays: usize,
    /// How often it casts them.
    times: usize,
}

impl Turn {
    /// As many rays of all as a contender casts within a limit, but no fewer than it casts at all; and, where these are soon
    /// cast, that so often that a clock can tell.
    fn of(contender: &mut Ready<'_, '_>, all: usize, limit: Duration) -> Result<Self> {
        let fewest = contender.fewest();
        let mut rays = fewest;
        loop {
            let begin = Instant::now();
            contender.cast(rays)?;
            let took = begin.elapsed().max(Duration::from_nanos(1));
            let share = limit.as_secs_f64() / took.as_secs_f64();
            if rays == all {
                let times = (share / 8.0).ceil().clamp(1.0, 1000.0) as usize;
                return Ok(Self { rays, times });
            }
            if share <= 4.0 {
                let affordable = (rays as f64 * share) as usize;
                return Ok(Self {
                    rays: (affordable - affordable % fewest).clamp(fewest, all),
                    times: 1,
                });
            }
            rays = (4 * rays).min(all);
        }
    }
}

fn judged(subject: &Subject<'_>, ready: &Ready<'_, '_>, rays: usize, truth: &[Option<(f64, u32)>]) -> Measured {
    let (mut errors, mut wrong, mut wrong_leaf) = (Vec::new(), 0, 0);
    let known = || truth.iter().take(rays).enumerate();
    for (seen, truth) in known().filter_map(|(ray, truth)| Some((ready.seen(ray)?, truth))) {
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
        scene: subject.name().to_owned(),
        contender: ready.contender().to_string(),
        ns: 0.0,
        ns_low: 0.0,
        ns_high: 0.0,
        ratio: 0.0,
        ratio_low: 0.0,
        ratio_high: 0.0,
        p99: at(last - last / 100),
        worst: at(last),
        wrong,
        wrong_leaf: (!ready.contender().is_traced()).then_some(wrong_leaf),
        rays,
        judged: known().len(),
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
