//! Contenders at work.

use crate::contender::{Contender, Method, Way};
use crate::solids::Primitive;
use crate::subject::Subject;
use anyhow::Result;
use gsdf_nostd::{Bounded, CertifiedScratch, Hit, Lane, Leaf, Plain, Program, ProgramError, Ray, Span, SphereTracer};
use gsdf_simd::{Double, Fast, Lanes, MOST_LANES, Packet, Pixel, Renderer, Robust, TILE_SIDE, Target, Tier, Tile, Wants, Work};

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

/// A contender with a subject before it.
pub struct Ready<'s, 'a> {
    contender: Contender,
    subject: &'s Subject<'a>,
    program: Program<'s, Primitive>,
    /// What renders tiles: it keeps its memory from one picture to the next.
    renderer: Option<Renderer<'s, 'a, Leaf>>,
    seen: Vec<Seen>,
}

impl Contender {
    /// Takes its place before a subject.
    ///
    /// # Errors
    /// As [`Subject::program`].
    pub fn ready<'s, 'a>(&self, subject: &'s Subject<'a>) -> Result<Ready<'s, 'a>> {
        let renderer = match self.way {
            Way::Tiles(level) if self.method == Method::Certified => {
                Some(Renderer::certified_at_level(subject.prepared(), subject.raster(), level))
            }
            Way::Tiles(level) => Some(Renderer::at_level(subject.prepared(), subject.raster(), level)),
            _ => None,
        };
        Ok(Ready {
            contender: *self,
            subject,
            program: subject.program()?,
            renderer,
            seen: Vec::new(),
        })
    }
}

impl Ready<'_, '_> {
    /// The contender.
    #[must_use]
    pub fn contender(&self) -> &Contender {
        &self.contender
    }

    /// The fewest rays that it casts at once.
    #[must_use]
    pub fn fewest(&self) -> usize {
        let all = self.subject.rays().len();
        match self.contender.way {
            Way::Scalar => all.min(1),
            Way::Packets(_) => all.min(MOST_LANES),
            Way::Tiles(_) => all,
        }
    }

    /// Casts the first so many rays of the subject; all of them where it renders tiles, on the threads of the current `rayon`
    /// pool.
    ///
    /// # Errors
    /// Where the program is none.
    pub fn cast(&mut self, rays: usize) -> Result<()> {
        let all = self.subject.rays();
        let rays = all.get(..rays).unwrap_or(all);
        self.seen.clear();
        if let Some(renderer) = &mut self.renderer {
            self.seen.resize(all.len(), NOTHING);
            renderer.render(Sights {
                seen: &mut self.seen,
                width: self.subject.raster().width() as usize,
            });
            return Ok(());
        }
        self.seen.resize(rays.len(), NOTHING);
        let job = Job {
            method: self.contender.method,
            program: self.program,
            rays,
            far: self.subject.far(),
            seen: &mut self.seen,
        };
        match self.contender.way {
            Way::Packets(level) => level.run(job),
            Way::Scalar | Way::Tiles(_) => job.one_by_one(),
        }
    }

    /// What a ray met that was cast last.
    #[must_use]
    pub fn seen(&self, ray: usize) -> Option<Seen> {
        let place = match &self.renderer {
            Some(_) => *self.subject.pixels().get(ray)? as usize,
            None => ray,
        };
        self.seen.get(place).copied()
    }
}

/// Rows of a picture, of which distances and leaves are wanted, as of all contenders.
struct Sights<'t> {
    seen: &'t mut [Seen],
    width: usize,
}

impl Target for Sights<'_> {
    fn wants(&self) -> Wants {
        Wants::NOTHING_ELSE
    }

    fn split_at(self, row: u32) -> (Self, Self) {
        let width = self.width;
        let (above, below) = self.seen.split_at_mut((row as usize * width).min(self.seen.len()));
        (Self { seen: above, width }, Self { seen: below, width })
    }

    fn put(&mut self, x: u32, y: u32, tile: &Tile) {
        let rows = self.seen.chunks_exact_mut(self.width.max(1)).skip(y as usize).take(TILE_SIDE);
        for (y, row) in rows.enumerate() {
            for (x, seen) in row.iter_mut().skip(x as usize).take(TILE_SIDE).enumerate() {
                let Pixel { distance, leaf, .. } = tile.pixel(x, y);
                *seen = Seen {
                    t: distance,
                    leaf: Some(leaf),
                };
            }
        }
    }
}

struct Job<'a> {
    method: Method,
    program: Program<'a, Primitive>,
    rays: &'a [Ray],
    /// How far tracers go.
    far: f32,
    seen: &'a mut [Seen],
}

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
                    let traced = tracer.cast(&self.program, &ray.within(0.0..self.far)?);
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
                let rays = self
                    .rays
                    .iter()
                    .map(|ray| ray.within(0.0..self.far))
                    .collect::<Result<Vec<_>, _>>()?;
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
