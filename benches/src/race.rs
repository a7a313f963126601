//! The race: two contenders by turns, round after round, in one process.

use crate::arena::Arena;
use crate::contender::{Contender, Painter};
use crate::frame::{Frame, Wrong};
use crate::scenes::Scene;
use crate::stats::Estimate;
use anyhow::{Context, Result};
use gsdf_simd::Level;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::time::{Duration, Instant};

/// How long each turn lasts at least: a picture that is rendered faster is rendered again. Many short turns are better than a few long ones: those of the time slices in which the system
/// lets nobody else run are undisturbed, and it is they that make the median.
const LEAST_TURN: Duration = Duration::from_millis(1);

/// The relaxations the marcher may choose from: plain, and the one its authors recommend.
const RELAXATIONS: [f32; 2] = [1.0, 1.2];

/// How the race is run.
#[derive(Clone, Copy, Debug)]
pub struct Rules {
    /// How many rounds, each of one turn of A and one of B.
    pub rounds: u32,
    /// The pixels along each side of a picture in tiles.
    pub size: u32,
    /// The threads whose worth is measured against one.
    pub threads: usize,
    /// The level at which packets are cast and traced.
    pub level: Level,
}

impl Rules {
    /// The pixels along each side of the picture of a race between these, on a scene of so many leaves; `None` where brute force would take too long. Both sides render the same
    /// picture: a smaller one shows more of a scene in each tile, which favours tiles less.
    fn size_for(&self, sides: [Contender; 2], leaves: usize) -> Option<u32> {
        let is_scalar = |contender| matches!(contender, Contender::ClosedRays | Contender::TracedRays);
        let share = if sides.into_iter().any(Contender::is_brute) {
            match leaves {
                0..=8 => 4,
                9..=256 => 16,
                257..=5_000 => 32,
                5_001..=20_000 if !sides.into_iter().any(is_scalar) => 64,
                _ => return None,
            }
        } else if sides.into_iter().any(Contender::is_traced) {
            if leaves > 20_000 { 8 } else { 2 }
        } else {
            1
        };
        Some((self.size / share).max(8))
    }
}

/// What is raced, one thread each.
const PAIRS: [(Contender, Contender); 8] = [
    // Against itself: how far from 1 this machine puts two sides that are equal.
    (Contender::ClosedTiles, Contender::ClosedTiles),
    (Contender::ClosedTiles, Contender::TracedTiles),
    (Contender::ClosedTilesBare, Contender::ClosedTiles),
    (Contender::ClosedTiles, Contender::ClosedPackets),
    (Contender::ClosedTilesBare, Contender::ClosedPackets),
    (Contender::ClosedPackets, Contender::TracedPackets),
    (Contender::ClosedRays, Contender::TracedRays),
    (Contender::ClosedPackets, Contender::ClosedRays),
];

/// One side of a race.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Side {
    /// Who renders.
    pub contender: Contender,
    /// On how many threads.
    pub threads: usize,
}

/// A side that is ready.
struct Racer<'a> {
    paint: Painter<'a>,
    threads: usize,
}

impl<'a> Racer<'a> {
    fn new(side: Side, arena: &'a Arena<'_>) -> Self {
        Self {
            paint: side.contender.ready(arena),
            threads: side.threads,
        }
    }
}

/// What came of a race.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The scene.
    pub scene: &'static str,
    /// How many leaves it has.
    pub leaves: usize,
    /// The level of the packets.
    pub level: Level,
    /// The pixels along each side of its picture.
    pub size: u32,
    /// The share of its pixels that show something.
    pub hit_rate: f64,
    /// The side that should be faster.
    pub a: Side,
    /// The side it is compared with.
    pub b: Side,
    /// The median of A's times, in nanoseconds per pixel.
    pub a_ns: f64,
    /// The median of B's times, in nanoseconds per pixel.
    pub b_ns: f64,
    /// B's time divided by A's, round by round.
    pub ratio: Estimate,
    /// How many rounds there were.
    pub rounds: u32,
    /// If B marches: by what its steps were stretched, the choice that made it faster on this scene.
    pub relaxation: Option<f32>,
    /// If B marches: the pixels it gets wrong.
    pub wrong: Option<Wrong>,
}

/// The threads that the sides run on.
#[derive(Debug)]
pub struct Pools {
    one: ThreadPool,
    several: ThreadPool,
}

impl Pools {
    /// One thread, and so many.
    ///
    /// # Errors
    /// Where the system has no more threads.
    pub fn new(threads: usize) -> Result<Self> {
        let of = |threads| ThreadPoolBuilder::new().num_threads(threads).build().context("threads to race on");
        Ok(Self {
            one: of(1)?,
            several: of(threads)?,
        })
    }

    /// The nanoseconds per pixel of one turn. The clock starts and stops within the pool: waking the first thread is not in it, sharing work with the others is.
    fn turn(&self, racer: &mut Racer<'_>, frame: &mut Frame, repeats: u32) -> f64 {
        let pool = if racer.threads == 1 { &self.one } else { &self.several };
        let elapsed = pool.install(|| {
            let begin = Instant::now();
            for _ in 0..repeats {
                (racer.paint)(frame);
                std::hint::black_box(&mut *frame);
            }
            begin.elapsed()
        });
        elapsed.as_secs_f64() * 1e9 / (f64::from(repeats) * frame.pixels.len() as f64)
    }

    /// How many pictures make a turn of each side, by the faster of two trials each. The turns of both last equally long, so that what disturbs them disturbs both alike: a short turn
    /// would slip through where a long one is interrupted.
    fn repeats(&self, racers: [&mut Racer<'_>; 2], frame: &mut Frame) -> [u32; 2] {
        let pictures = racers.map(|racer| {
            let trials = [(); 2].map(|()| self.turn(racer, frame, 1));
            trials[0].min(trials[1]) * frame.pixels.len() as f64
        });
        let turn = pictures[0].max(pictures[1]).max(LEAST_TURN.as_nanos() as f64);
        pictures.map(|picture| (turn / picture).round().clamp(1.0, 1e6) as u32)
    }
}

/// How many times the work of one thread so many do on this machine, now, at a loop that touches no memory: what no picture can exceed. Virtual processors that share a real one, and
/// neighbours who are busy, show here.
#[must_use]
pub fn thread_ceiling(pools: &Pools) -> f64 {
    let spin = |pool: &ThreadPool| {
        let begin = Instant::now();
        pool.broadcast(|_| {
            let mut state = 1_u64;
            for _ in 0..10_000_000 {
                state = std::hint::black_box(state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1));
            }
        });
        begin.elapsed().as_secs_f64()
    };
    let threads = pools.several.current_num_threads() as f64;
    let ratios: Vec<f64> = (0..7).map(|_| threads * spin(&pools.one) / spin(&pools.several)).collect();
    Estimate::new(&ratios).unwrap_or(Estimate::UNKNOWN).median
}

/// Runs all races on a scene and hands out each outcome as it comes.
///
/// # Errors
/// Where the scene is not a program, or `finished` fails.
pub fn race(scene: &Scene, rules: &Rules, pools: &Pools, finished: &mut impl FnMut(&Outcome) -> Result<()>) -> Result<()> {
    let alone = |contender| Side { contender, threads: 1 };
    let full = Arena::new(scene, rules.size)?.at_level(rules.level);
    for (a, b) in PAIRS {
        if let Some(size) = rules.size_for([a, b], full.program.leaves()) {
            finished(&one_race(&full.sized(size), alone(a), alone(b), rules.rounds, pools))?;
        }
    }
    if rules.threads > 1 {
        let contender = Contender::ClosedTiles;
        let shared = Side {
            contender,
            threads: rules.threads,
        };
        finished(&one_race(&full, shared, alone(contender), rules.rounds, pools))?;
    }
    Ok(())
}

/// Runs one race. A begins the even rounds and B the odd ones, so that a machine that grows steadily slower favours neither.
fn one_race(arena: &Arena<'_>, a: Side, b: Side, rounds: u32, pools: &Pools) -> Outcome {
    let mut frame = arena.exact();
    let arena = &if b.contender.is_traced() {
        best_relaxed(arena, b, pools, &mut frame)
    } else {
        arena.clone()
    };
    let (mut racer_a, mut racer_b) = (Racer::new(a, arena), Racer::new(b, arena));
    let [repeats_a, repeats_b] = pools.repeats([&mut racer_a, &mut racer_b], &mut frame);
    let (mut times_a, mut times_b) = (Vec::new(), Vec::new());
    for round in 0..rounds.max(1) {
        if round % 2 == 0 {
            times_a.push(pools.turn(&mut racer_a, &mut frame, repeats_a));
            times_b.push(pools.turn(&mut racer_b, &mut frame, repeats_b));
        } else {
            times_b.push(pools.turn(&mut racer_b, &mut frame, repeats_b));
            times_a.push(pools.turn(&mut racer_a, &mut frame, repeats_a));
        }
    }
    frame.settle(b.contender);
    let ratios: Vec<f64> = times_a.iter().zip(&times_b).map(|(a, b)| b / a).collect();
    let median = |sample: &[f64]| Estimate::new(sample).map_or(f64::NAN, |estimate| estimate.median);
    Outcome {
        scene: arena.name,
        leaves: arena.program.leaves(),
        level: arena.level,
        size: arena.raster.width(),
        hit_rate: frame.hit_rate(),
        a,
        b,
        a_ns: median(&times_a),
        b_ns: median(&times_b),
        ratio: Estimate::new(&ratios).unwrap_or(Estimate::UNKNOWN),
        rounds: rounds.max(1),
        relaxation: b.contender.is_traced().then_some(arena.tracer.relaxation),
        wrong: b.contender.is_traced().then(|| frame.wrong()),
    }
}

/// The arena with the relaxation with which the marcher is faster there: a trial of three turns each, by turns.
fn best_relaxed<'a>(arena: &Arena<'a>, side: Side, pools: &Pools, frame: &mut Frame) -> Arena<'a> {
    let candidates = RELAXATIONS.map(|relaxation| arena.relaxed(relaxation));
    let mut least = [f64::INFINITY; RELAXATIONS.len()];
    {
        let [plain, relaxed] = &candidates;
        let mut racers = [Racer::new(side, plain), Racer::new(side, relaxed)];
        let [plain, relaxed] = &mut racers;
        let [repeats, _] = pools.repeats([plain, relaxed], frame);
        for _ in 0..3 {
            for (least, racer) in least.iter_mut().zip(&mut racers) {
                *least = least.min(pools.turn(racer, frame, repeats));
            }
        }
    }
    let [plain, relaxed] = candidates;
    if least[1] < least[0] { relaxed } else { plain }
}

#[cfg(test)]
mod tests {
    use super::{PAIRS, Pools, Rules, race, thread_ceiling};
    use crate::contender::Contender;
    use crate::scenes::Scene;
    use anyhow::Result;
    use gsdf_simd::Level;

    #[test]
    fn a_race_has_an_outcome_for_every_pair() -> Result<()> {
        let rules = Rules {
            rounds: 2,
            size: 64,
            threads: 2,
            level: Level::best(),
        };
        let mut outcomes = Vec::new();
        race(&Scene::by_name("s1")?, &rules, &Pools::new(rules.threads)?, &mut |outcome| {
            outcomes.push(outcome.clone());
            Ok(())
        })?;
        assert_eq!(outcomes.len(), PAIRS.len() + 1);
        for outcome in &outcomes {
            assert!(outcome.a_ns > 0.0 && outcome.b_ns > 0.0 && outcome.ratio.median > 0.0);
            assert_eq!(outcome.wrong.is_some(), outcome.b.contender.is_traced());
            assert_eq!(outcome.relaxation.is_some(), outcome.b.contender.is_traced());
            assert!(outcome.hit_rate > 0.5);
        }
        let shared = outcomes.last().expect("the threads come last");
        assert_eq!((shared.a.threads, shared.b.threads, shared.size), (2, 1, 64));
        Ok(())
    }

    #[test]
    fn there_is_a_ceiling() -> Result<()> {
        assert!(thread_ceiling(&Pools::new(2)?) > 0.0);
        Ok(())
    }

    #[test]
    fn brute_force_renders_heavy_scenes_small_or_not_at_all() {
        let rules = Rules {
            rounds: 1,
            size: 1024,
            threads: 1,
            level: Level::PORTABLE,
        };
        let tiles = Contender::ClosedTiles;
        let of = |other| [2, 64, 4096, 10_001, 97_336].map(|leaves| rules.size_for([tiles, other], leaves));
        assert_eq!(of(tiles), [Some(1024); 5]);
        assert_eq!(of(Contender::TracedTiles), [Some(512), Some(512), Some(512), Some(512), Some(128)]);
        assert_eq!(of(Contender::ClosedPackets), [Some(256), Some(64), Some(32), Some(16), None]);
        assert_eq!(of(Contender::TracedRays), [Some(256), Some(64), Some(32), None, None]);
        let small = Rules { size: 16, ..rules };
        assert_eq!(small.size_for([tiles, Contender::ClosedPackets], 4096), Some(8));
    }
}
