//! The tiers: how much arithmetic a ray is worth, one ray at a time.

use clap::ValueEnum;
use gsdf_nostd::{Anywhere, Bounded, CertifiedScratch, Hit, Lane, Plain, Program, Ray, Real, Settled, Span, march};
use gsdf_trade::Primitive;
use serde::Serialize;

/// In what arithmetic rays are cast. The formulas are the same; rays and models are single precision numbers in all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum Tier {
    /// Textbook formulas in single precision
    Fast,
    /// Formulas in single precision that are right to rounding from any distance
    #[default]
    Robust,
    /// Single precision with bounds on its errors, double precision where these leave a doubt, and a rule where both do
    Certified,
    /// Double precision
    F64,
}

/// A distance along a ray, as precise as it was computed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Distance {
    /// In single precision.
    Single(f32),
    /// In double precision.
    Double(f64),
}

/// Where a ray crosses the surface of a model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The distance, in units of the direction's length.
    pub distance: Distance,
    /// What is met there, in single precision.
    pub hit: Hit,
}

/// How certain it is what a ray crosses first.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Certainty {
    /// By how much the distance may be off; infinite where nothing is certain.
    pub bound: f32,
    /// Which arithmetic proved it, or that a rule decided.
    #[serde(serialize_with = "by_name")]
    pub settled: Settled,
}

impl Certainty {
    /// What it is called how a ray was settled.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self.settled {
            Settled::Single => "single",
            Settled::Double => "double",
            Settled::Tie => "tie",
        }
    }
}

fn by_name<S: serde::Serializer>(settled: &Settled, serializer: S) -> Result<S::Ok, S::Error> {
    let certainty = Certainty {
        bound: 0.0,
        settled: *settled,
    };
    serializer.serialize_str(certainty.name())
}

/// The arithmetic of a single ray.
trait Number: Lane {
    fn distance(self) -> Distance;
}

impl Number for Plain<f32> {
    fn distance(self) -> Distance {
        Distance::Single(self.0)
    }
}

impl Number for f32 {
    fn distance(self) -> Distance {
        Distance::Single(self)
    }
}

impl Number for f64 {
    fn distance(self) -> Distance {
        Distance::Double(self)
    }
}

/// Casts rays by themselves, each past every leaf.
pub struct Alone<'m> {
    program: Program<'m, Primitive>,
    spans: Spans,
}

/// Memory for the spans of a program's leaves.
enum Spans {
    Fast(Vec<Span<Plain<f32>>>),
    Robust(Vec<Span<f32>>),
    Double(Vec<Span<f64>>),
    Certified {
        single: Vec<Span<Bounded<f32>>>,
        double: Vec<Span<Bounded<f64>>>,
        tie: Vec<Span<f64>>,
    },
}

fn empty<T: Real>(program: Program<'_, Primitive>, like: T) -> Vec<Span<T>> {
    vec![Span::empty_like(like); program.leaves()]
}

impl<'m> Alone<'m> {
    /// In a tier.
    #[must_use]
    pub fn new(program: Program<'m, Primitive>, tier: Tier) -> Self {
        let spans = match tier {
            Tier::Fast => Spans::Fast(empty(program, Plain(0.0))),
            Tier::Robust => Spans::Robust(empty(program, 0.0)),
            Tier::F64 => Spans::Double(empty(program, 0.0)),
            Tier::Certified => Spans::Certified {
                single: empty(program, Bounded::exact(0.0)),
                double: empty(program, Bounded::exact(0.0)),
                tie: empty(program, 0.0),
            },
        };
        Self { program, spans }
    }

    /// The first crossing of a ray, and in the certified tier how certain that is.
    pub fn first(&mut self, ray: &Ray) -> (Option<Crossing>, Option<Certainty>) {
        let program = &self.program;
        match &mut self.spans {
            Spans::Fast(spans) => (crossings(program, ray, spans).next(), None),
            Spans::Robust(spans) => (crossings(program, ray, spans).next(), None),
            Spans::Double(spans) => (crossings(program, ray, spans).next(), None),
            Spans::Certified { single, double, tie } => {
                let scratch = CertifiedScratch { single, double, tie };
                // There is a span for every leaf.
                let Ok(found) = program.cast_certified(ray, scratch) else {
                    return (None, None);
                };
                let crossing = found.hit.map(|hit| Crossing {
                    distance: Distance::Single(hit.t),
                    hit,
                });
                let certainty = Certainty {
                    bound: found.bound,
                    settled: found.settled,
                };
                (crossing, Some(certainty))
            }
        }
    }

    /// All crossings of a ray, in order; in the certified tier those of double precision, of which nothing is certified.
    pub fn all(&mut self, ray: &Ray) -> Vec<Crossing> {
        let program = &self.program;
        match &mut self.spans {
            Spans::Fast(spans) => crossings(program, ray, spans).collect(),
            Spans::Robust(spans) => crossings(program, ray, spans).collect(),
            Spans::Double(spans) | Spans::Certified { tie: spans, .. } => crossings(program, ray, spans).collect(),
        }
    }

    /// How many sweeps over the program a ray takes to its first crossing; in the certified tier those of double precision.
    pub fn sweeps(&mut self, ray: &Ray) -> u32 {
        let program = &self.program;
        match &mut self.spans {
            Spans::Fast(spans) => sweeps(program, ray, spans),
            Spans::Robust(spans) => sweeps(program, ray, spans),
            Spans::Double(spans) | Spans::Certified { tie: spans, .. } => sweeps(program, ray, spans),
        }
    }
}

/// The crossings of a ray, in order.
fn crossings<'s, T: Number>(
    program: &'s Program<'_, Primitive>,
    ray: &'s Ray,
    spans: &'s mut [Span<T>],
) -> impl Iterator<Item = Crossing> + 's {
    let like = T::from(0.0);
    let line = ray.line(like);
    program.spans_along(&line, Anywhere, spans);
    let mut t = ray.start_on_line(like);
    core::iter::from_fn(move || {
        t = march(program.nodes(), spans, t).t;
        let parameter = ray.parameter_of(t);
        // What is beyond all numbers of single precision is nothing.
        parameter.to_f32().is_finite().then(|| Crossing {
            distance: parameter.distance(),
            hit: Hit::new(ray, parameter, &program.surface_at(&line, Anywhere, spans, t)),
        })
    })
}

fn sweeps<T: Number>(program: &Program<'_, Primitive>, ray: &Ray, spans: &mut [Span<T>]) -> u32 {
    // There is a span for every leaf.
    program.along(*ray, spans).map_or(0, |sight| sight.march::<T>().sweeps)
}
