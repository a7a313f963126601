//! Measures a cell of the table: many rays of one corpus at one kind of leaf, in every arithmetic.

use super::corpus::{Corpus, Target};
use super::statistics::{Statistics, Worst};
use super::trial::{Arithmetic, Reference, Trial};
use crate::doubled::{Ball, Ends};
use crate::shape::KINDS;
use core::ops::Range;
use core::sync::atomic::{AtomicU64, Ordering};
use gsdf_nostd::Leaf;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// The rays of a cell that are measured together: ten million in all cells. The figures of the table are the largest of any
/// such part; CI measures the first.
pub const PART: u64 = 1 << 15;

/// How many rays in succession are aimed at one solid.
pub(super) const RAYS_AT_ONE: u64 = 512;

/// How much larger than `|t|` the condition of a crossing may be for its error to count in units in the last place.
pub const WELL_CONDITIONED: f64 = 64.0;

/// The rays of one corpus at one kind of leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Cell {
    /// The number of the kind in [`KINDS`].
    pub leaf: usize,
    /// The corpus.
    pub corpus: Corpus,
}

/// What was measured in a cell.
#[derive(Clone, Debug, Default)]
pub struct Measured {
    /// For each arithmetic, in the order of [`Arithmetic::ALL`].
    pub statistics: [Statistics; 3],
    /// The rays that the exact reference had to be asked about.
    pub asked: u64,
}

impl Measured {
    fn joined(self, other: &Self) -> Self {
        let [a, b, c] = self.statistics;
        let [x, y, z] = &other.statistics;
        Self {
            statistics: [a.joined(x), b.joined(y), c.joined(z)],
            asked: self.asked + other.asked,
        }
    }
}

/// Whether plain formulas differ from robust ones at this kind of leaf: it has a side that is not flat.
#[must_use]
pub fn is_curved(leaf: usize) -> bool {
    const CURVED: [&str; 10] = [
        "sphere",
        "cylinder",
        "nappe",
        "capped cylinder",
        "cone",
        "capped cone",
        "capsule",
        "rhombus",
        "rounded cone",
        "solid angle",
    ];
    CURVED.contains(&KINDS[leaf])
}

/// Errors that need not be told from smaller ones.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Floor {
    /// Of well-conditioned crossings, in units in the last place.
    pub most: f64,
    /// Of any crossing, in units roundoff of its condition.
    pub conditioned: f64,
}

/// The largest error so far, shared between threads: crossings with smaller ones need no condition.
#[derive(Debug)]
struct Largest(AtomicU64);

impl Largest {
    fn new(error: f64) -> Self {
        Self(AtomicU64::new(error.to_bits()))
    }

    /// The bits of positive numbers are ordered as the numbers are.
    fn raise(&self, error: f64) {
        self.0.fetch_max(error.to_bits(), Ordering::Relaxed);
    }

    fn get(&self) -> f64 {
        f64::from_bits(self.0.load(Ordering::Relaxed))
    }
}

/// The largest errors so far in one arithmetic.
#[derive(Debug)]
struct Largests {
    most: Largest,
    conditioned: Largest,
}

impl From<Floor> for Largests {
    fn from(floor: Floor) -> Self {
        Self {
            most: Largest::new(floor.most),
            conditioned: Largest::new(floor.conditioned),
        }
    }
}

impl Cell {
    /// All cells that have rays.
    pub fn all() -> impl Iterator<Item = Self> {
        let cells = (0..KINDS.len()).flat_map(|leaf| Corpus::ALL.iter().map(move |&corpus| Self { leaf, corpus }));
        cells.filter(|cell| cell.corpus.missing(cell.leaf).is_none())
    }

    /// The arithmetics that have a row of their own.
    pub fn arithmetics(self) -> impl Iterator<Item = Arithmetic> {
        Arithmetic::ALL
            .into_iter()
            .filter(move |&arithmetic| arithmetic != Arithmetic::Plain || is_curved(self.leaf))
    }

    /// The seed of one of the cell's targets or rays.
    fn seed(self, number: u64) -> Pcg64 {
        let cell = (self.leaf * Corpus::ALL.len() + self.corpus as usize) as u64;
        let mut seed = [0; 32];
        seed[..8].copy_from_slice(&cell.to_le_bytes());
        seed[8..16].copy_from_slice(&number.to_le_bytes());
        Pcg64::from_seed(seed)
    }

    /// What a ray is aimed at, with many others.
    pub(super) fn target(self, ray: u64) -> Target {
        // Targets have the odd numbers, rays the even ones.
        Target::random(&mut self.seed(2 * (ray / RAYS_AT_ONE) + 1), self.leaf, self.corpus)
    }

    /// A ray by its number.
    #[must_use]
    pub fn trial(self, ray: u64) -> Trial {
        self.aimed(&self.target(ray), ray)
    }

    /// A ray by its number, aimed at its target.
    pub(super) fn aimed(self, target: &Target, ray: u64) -> Trial {
        target.ray(&mut self.seed(2 * ray))
    }

    /// Ranges of rays, cut into those that are aimed at one target.
    pub(super) fn by_target(rays: Range<u64>) -> impl Iterator<Item = Range<u64>> {
        (rays.start / RAYS_AT_ONE..rays.end.div_ceil(RAYS_AT_ONE)).map(move |target| {
            let first = target * RAYS_AT_ONE;
            first.max(rays.start)..(first + RAYS_AT_ONE).min(rays.end)
        })
    }

    /// Measures rays by their numbers, on all threads. The largest errors are not told where they are below these floors,
    /// which saves the computation of their condition.
    #[must_use]
    pub fn measure(self, rays: Range<u64>, floors: [Floor; 3]) -> Measured {
        let floors = floors.map(Largests::from);
        let targets: Vec<Range<u64>> = Self::by_target(rays).collect();
        targets
            .into_par_iter()
            .map(|rays| self.measure_at_one(rays, &floors))
            .fold(Measured::default, |all, one| all.joined(&one))
            .reduce(Measured::default, |all, one| all.joined(&one))
    }

    /// Measures rays at one and the same target.
    fn measure_at_one(self, rays: Range<u64>, largest: &[Largests; 3]) -> Measured {
        let target = self.target(rays.start);
        let solid = target.solid();
        let view = View {
            leaf: solid.leaf().expect("corpora make valid shapes"),
            reference: Reference::new(solid),
            is_facet: solid.shape.is_facet(),
            largest,
        };
        let mut measured = Measured::default();
        for ray in rays {
            let trial = self.aimed(&target, ray);
            let (truth, was_asked) = view.truth(&trial);
            measured.asked += u64::from(was_asked);
            for arithmetic in self.arithmetics() {
                view.compare(&mut measured.statistics[arithmetic as usize], &trial, ray, arithmetic, truth);
            }
        }
        measured
    }
}

/// A solid as the library has it, and as it is.
struct View<'a> {
    leaf: Leaf,
    reference: Reference,
    is_facet: bool,
    largest: &'a [Largests; 3],
}

/// The true span, with the condition of each end, as far as it is the ray's.
type Truth = Option<(Ends, [f64; 2])>;

impl View<'_> {
    /// The truth, and whether the exact reference was needed for it.
    fn truth(&self, trial: &Trial) -> (Truth, bool) {
        let with_conditions = |ends: Ends| {
            let conditions = ends.map(|end| end.map_or(0.0, |t| self.reference.ray_condition((trial.origin, trial.direction), t)));
            (ends, conditions)
        };
        if let Some(span) = self.reference.swift(trial.origin, trial.direction) {
            let truth = span.map(with_conditions);
            // A crossing must be known a hundred times better than the best arithmetic has it.
            let is_sharp = truth.is_none_or(|(ends, conditions)| {
                let known = |(end, condition): (&Option<Ball>, &f64)| {
                    end.is_none_or(|t| t.error() <= f64::EPSILON / 256.0 * condition.min(f64::MAX))
                };
                ends.iter().zip(&conditions).all(known)
            });
            if is_sharp {
                return (truth, false);
            }
        }
        (self.reference.slow(trial.origin, trial.direction).map(with_conditions), true)
    }

    fn compare(&self, statistics: &mut Statistics, trial: &Trial, ray: u64, arithmetic: Arithmetic, truth: Truth) {
        statistics.rays += 1;
        let computed = trial.computed(&self.leaf, arithmetic);
        let (Some(found), Some((ends, conditions))) = (computed, truth) else {
            if computed.is_some() != truth.is_some() {
                statistics.count_wrong(ray);
            }
            return;
        };
        // The exit of a facet is the next number after its entry, and is no crossing.
        let ends_of_it = if self.is_facet { 1 } else { 2 };
        for index in 0..ends_of_it {
            let (found, condition) = (found[index], conditions[index]);
            let Some(t) = ends[index].filter(|_| found.is_finite()) else {
                if ends[index].is_some() || found.is_finite() {
                    statistics.count_wrong(ray);
                    return;
                }
                continue;
            };
            let error = t.distance_to(found).abs();
            let ulps = error / arithmetic.ulp(t.to_f64());
            // What is at the origin but for rounding has no last place.
            if arithmetic.roundoff() * condition < t.to_f64().abs() {
                statistics.count(ulps);
            }
            if error == 0.0 {
                continue;
            }
            // The condition is no less than the ray's share of it: what is below the largest so far need not be known.
            let largest = &self.largest[arithmetic as usize];
            let roundings = |condition: f64| error / (arithmetic.roundoff() * condition);
            let is_well_conditioned = |condition: f64| condition <= WELL_CONDITIONED * t.to_f64().abs();
            if roundings(condition) > largest.conditioned.get() || (is_well_conditioned(condition) && ulps > largest.most.get()) {
                let condition = self
                    .reference
                    .condition((trial.origin, trial.direction), t, found, arithmetic.roundoff());
                let worst = roundings(condition);
                statistics.conditioned.see(Worst { error: worst, ray });
                largest.conditioned.raise(worst);
                if is_well_conditioned(condition) {
                    statistics.most.see(Worst { error: ulps, ray });
                    largest.most.raise(ulps);
                }
            }
        }
    }
}
