//! The ways to find where a ray meets a scene.

use super::scene::{Primitive, Scene};
use anyhow::Result;
use core::fmt;
use gsdf_nostd::{Bounded, CertifiedScratch, Hit, Lane, Plain, Program, ProgramError, Ray, Span, SphereTracer};
use gsdf_simd::{Double, Fast, Lanes, Level, MOST_LANES, Packet, Robust, Tier, Work};

/// How much is spent on accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Textbook formulas in `f32`.
    Fast,
    /// Robust formulas in `f32`.
    Robust,
    /// Robust formulas in `f64`.
    Double,
    /// Robust formulas in `f32` with bounds on their errors, and `f64` where these leave a doubt.
    Certified,
    /// Sphere tracing.
    Traced(SphereTracer),
}

/// A method, along one ray at a time or along packets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contender {
    /// The method.
    pub method: Method,
    /// Where packets are computed; [`None`] for single rays.
    pub level: Option<Level>,
}

/// What a ray meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// The ray's parameter, infinite where it meets nothing.
    pub t: f32,
    /// The number of the leaf, where the method tells.
    pub leaf: Option<u32>,
}

impl Seen {
    /// The leaf, where something was met.
    #[must_use]
    pub fn hit_leaf(&self) -> Option<u32> {
        self.leaf.filter(|_| self.t.is_finite())
    }
}

const NOTHING: Seen = Seen {
    t: f32::INFINITY,
    leaf: None,
};

/// The distances to the surface, relative to that to the eye, at which tracers stop.
const EPSILONS: [f32; 4] = [1e-2, 1e-3, 1e-4, 1e-5];

/// After how many steps tracers give up.
const STEPS: [u32; 2] = [64, 512];

impl Contender {
    /// All of them: tiers and tracers, single rays and packets; certified ones alone, since each is completed by itself.
    pub fn all(level: Level) -> impl Iterator<Item = Self> {
        let tiers = [Method::Fast, Method::Robust, Method::Double, Method::Certified].into_iter();
        let tracers = EPSILONS.into_iter().flat_map(|epsilon| {
            STEPS.into_iter().map(move |max_steps| {
                Method::Traced(SphereTracer {
                    epsilon,
                    max_steps,
                    ..SphereTracer::default()
                })
            })
        });
        let both = move |method| {
            let packets = (method != Method::Certified).then_some(level);
            core::iter::once(None)
                .chain(packets.map(Some))
                .map(move |level| Self { method, level })
        };
        tiers.chain(tracers).flat_map(both)
    }

    /// Whether it is a tracer.
    #[must_use]
    pub fn is_traced(&self) -> bool {
        matches!(self.method, Method::Traced(_))
    }

    /// Casts all rays of a scene.
    ///
    /// # Errors
    /// Where the scene is none, which reference scenes are not.
    pub fn cast(&self, scene: &Scene, seen: &mut Vec<Seen>) -> Result<()> {
        seen.clear();
        seen.resize(scene.rays.len(), NOTHING);
        let job = Job {
            method: self.method,
            program: scene.program()?,
            rays: &scene.rays,
            seen,
        };
        match self.level {
            Some(level) => level.run(job),
            None => job.one_by_one(),
        }
    }
}

impl fmt::Display for Contender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.method {
            Method::Fast => write!(f, "fast")?,
            Method::Robust => write!(f, "robust")?,
            Method::Double => write!(f, "f64")?,
            Method::Certified => write!(f, "certified")?,
            Method::Traced(tracer) => write!(f, "traced {:e} {}", tracer.epsilon, tracer.max_steps)?,
        }
        match self.level {
            Some(level) => write!(f, ", {level}"),
            None => write!(f, ", scalar"),
        }
    }
}

struct Job<'a> {
    method: Method,
    program: Program<'a, Primitive>,
    rays: &'a [Ray],
    seen: &'a mut [Seen],
}

/// How far tracers go: to the end of the scenes, and some.
const FAR: f32 = 10_000.0;

impl Job<'_> {
    fn one_by_one(self) -> Result<()> {
        match self.method {
            Method::Fast => self.along(Plain(0.0_f32)),
            Method::Robust => self.along(0.0_f32),
            Method::Double => self.along(0.0_f64),
            Method::Certified => {
                let leaves = self.program.leaves();
                let mut single = vec![Span::empty_like(Bounded::exact(0.0)); leaves];
                let mut double = vec![Span::empty_like(Bounded::exact(0.0)); leaves];
                let mut tie = vec![Span::empty_like(0.0); leaves];
                for (ray, seen) in self.rays.iter().zip(self.seen) {
                    let scratch = CertifiedScratch {
                        single: &mut single,
                        double: &mut double,
                        tie: &mut tie,
                    };
                    *seen = self.program.cast_certified(ray, scratch)?.hit.into();
                }
                Ok(())
            }
            Method::Traced(tracer) => {
                for (ray, seen) in self.rays.iter().zip(self.seen) {
                    let traced = tracer.cast(&self.program, &ray.within(0.0..FAR)?);
                    seen.t = if traced.hit { traced.t } else { f32::INFINITY };
                }
                Ok(())
            }
        }
    }

    fn along<T: Lane>(self, like: T) -> Result<()> {
        let mut spans = vec![Span::empty_like(like); self.program.leaves()];
        for (ray, seen) in self.rays.iter().zip(self.seen) {
            *seen = self.program.along(*ray, &mut spans)?.cast().into();
        }
        Ok(())
    }

    /// Memory for packets in a tier.
    fn scratch<T: Lanes, A: Tier>(&self, token: T::Token) -> Vec<Span<A::Number<T>>> {
        vec![Span::empty_like(A::widened(T::splat(token, 0.0))); self.program.leaves()]
    }
}

impl From<Option<Hit>> for Seen {
    fn from(hit: Option<Hit>) -> Self {
        match hit {
            Some(hit) => Self {
                t: hit.t,
                leaf: Some(hit.leaf),
            },
            None => NOTHING,
        }
    }
}

impl Work for Job<'_> {
    type Output = Result<()>;

    /// Nothing is allocated where code is compiled for a level: what that calls is not.
    fn run<T: Lanes>(self, token: T::Token) -> Result<()> {
        match self.method {
            Method::Fast => {
                let mut spans = self.scratch::<T, Fast>(token);
                T::vectorize(
                    token,
                    #[inline(always)]
                    || packets::<T, Fast>(token, self, &mut spans),
                )?;
            }
            Method::Robust => {
                let mut spans = self.scratch::<T, Robust>(token);
                T::vectorize(
                    token,
                    #[inline(always)]
                    || packets::<T, Robust>(token, self, &mut spans),
                )?;
            }
            Method::Double => {
                let mut spans = self.scratch::<T, Double>(token);
                T::vectorize(
                    token,
                    #[inline(always)]
                    || packets::<T, Double>(token, self, &mut spans),
                )?;
            }
            // As single rays: it is the completion of each that takes the time.
            Method::Certified => self.one_by_one()?,
            Method::Traced(tracer) => {
                let rays = self.rays.iter().map(|ray| ray.within(0.0..FAR)).collect::<Result<Vec<_>, _>>()?;
                T::vectorize(
                    token,
                    #[inline(always)]
                    || traced::<T>(token, &tracer, &self.program, &rays, self.seen),
                );
            }
        }
        Ok(())
    }
}

#[inline(always)]
fn packets<T: Lanes, A: Tier>(token: T::Token, job: Job<'_>, spans: &mut [Span<A::Number<T>>]) -> Result<(), ProgramError> {
    let Job { program, rays, seen, .. } = job;
    for (rays, seen) in rays.chunks(T::LANES).zip(seen.chunks_mut(T::LANES)) {
        let hits = Packet::<T>::of(token, rays).cast_as::<A, _>(token, &program, spans)?;
        let (mut t, mut leaf) = ([0.0; MOST_LANES], [0; MOST_LANES]);
        hits.t.store(&mut t);
        T::select(hits.hit, hits.met.leaf, T::splat(token, f32::INFINITY)).store_numbers(&mut leaf);
        for (place, (t, leaf)) in seen.iter_mut().zip(t.into_iter().zip(leaf)) {
            *place = Seen { t, leaf: Some(leaf) };
        }
    }
    Ok(())
}

#[inline(always)]
fn traced<T: Lanes>(token: T::Token, tracer: &SphereTracer, program: &Program<'_, Primitive>, rays: &[Ray], seen: &mut [Seen]) {
    for (rays, seen) in rays.chunks(T::LANES).zip(seen.chunks_mut(T::LANES)) {
        let found = Packet::<T>::of(token, rays).trace(tracer, program);
        let mut t = [0.0; MOST_LANES];
        T::select(found.hit, found.t, T::splat(token, f32::INFINITY)).store(&mut t);
        for (place, t) in seen.iter_mut().zip(t) {
            place.t = t;
        }
    }
}
