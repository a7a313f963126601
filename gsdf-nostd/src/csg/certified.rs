//! Casts that say how sure they are: in one precision, then in the other, then by rule.

use super::certify::{Certificate, certify, crossing_around};
use super::check::ProgramError;
use super::footing::Anywhere;
use super::hit::Hit;
use super::lanes::Encounter;
use super::program::{Csg, Program};
use crate::bounded::Bounded;
use crate::leaf::{Solid, Surface};
use crate::ray::Ray;
use crate::real::{Lane, Real};
use crate::span::Span;
use crate::transform::Transform;

/// What a ray meets first, with a proof or the admission that there is none.
///
/// The ray's and the solids' numbers are taken as exact: what is certified is that rounding in the computation has changed
/// nothing, not that the numbers were right. Of solids whose formulas need an irrational number (the height of an
/// equilateral triangle, the length of an axis) the solid is the one in exact arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certified {
    /// The first crossing within the ray's range, with its parameter rounded from `f64`; `None` where there is none.
    pub hit: Option<Hit>,
    /// By how much the hit's parameter may be off. In all but rare cases [half a unit in its last place](half_ulp), which is to
    /// say that it is rounded correctly; infinite where nothing is certain, not even that there is a crossing.
    pub bound: f32,
    /// How far one had to go.
    pub settled: Settled,
}

/// How it became certain what a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Settled {
    /// The bounds of `f32` arithmetic left no doubt: hit or miss, which leaf, and that nothing else comes before it.
    Single,
    /// Those of `f64` arithmetic did.
    Double,
    /// Not even these. Roots of several leaves coincide, or the ray touches: which comes first is decided as
    /// everywhere, by the values in `f64` and the order of the leaves. Where membership is certain before and beyond roots that
    /// coincide, as at faces that solids share, it is only the leaf that is decided so, and the parameter has its bound. A triangle
    /// or a quad always is such a case: it has no inside to be sure of.
    Tie,
}

/// Memory for [`Program::cast_certified`]: in each of these slices one span per leaf.
#[derive(Debug)]
pub struct CertifiedScratch<'s> {
    /// For the first attempt.
    pub single: &'s mut [Span<Bounded<f32>>],
    /// For the second.
    pub double: &'s mut [Span<Bounded<f64>>],
    /// For the decision by rule.
    pub tie: &'s mut [Span<f64>],
}

impl<L: Solid> Program<'_, L> {
    /// The first crossing within the ray's range, and how certain it is: see [`Certified`].
    ///
    /// # Errors
    /// Where a slice of `scratch` is shorter than the program has leaves.
    pub fn cast_certified(&self, ray: &Ray, scratch: CertifiedScratch<'_>) -> Result<Certified, ProgramError> {
        let CertifiedScratch { single, double, tie } = scratch;
        let found = self.certify_along(ray, 0.0_f32, single)?;
        self.settle(ray, &found, double, tie)
    }

    /// What the first attempt found, completed: for those who made it in an arithmetic of their own, such as packets.
    ///
    /// # Errors
    /// Where a slice is shorter than the program has leaves, and is needed.
    pub fn settle(
        &self,
        ray: &Ray,
        single: &Certificate<f32>,
        double: &mut [Span<Bounded<f64>>],
        tie: &mut [Span<f64>],
    ) -> Result<Certified, ProgramError> {
        if let Some(found) = self.completed(ray, single, Settled::Single) {
            return Ok(found);
        }
        let second = self.certify_along(ray, 0.0_f64, double)?;
        if let Some(found) = self.completed(ray, &second, Settled::Double) {
            return Ok(found);
        }
        let around = self.crossing_around(ray, double, &second);
        Ok(by_rule(ray, self.along(*ray, tie)?.cast(), around))
    }

    /// Between which parameters of the line a crossing is certain of which it is not certain whose it is.
    fn crossing_around(&self, ray: &Ray, spans: &[Span<Bounded<f64>>], stuck: &Certificate<f64>) -> Option<(f64, f64)> {
        crossing_around(self.nodes, spans.get(..self.leaves())?, ray.start_on_line(0.0_f64), stuck)
    }

    fn certify_along<T: Lane>(&self, ray: &Ray, like: T, spans: &mut [Span<Bounded<T>>]) -> Result<Certificate<T>, ProgramError> {
        let length = spans.len();
        let Some(spans) = spans.get_mut(..self.leaves()) else {
            return Err(ProgramError::ScratchTooShort(length, self.leaves()));
        };
        self.spans_along(&ray.line(like).bounded(), Anywhere, spans);
        Ok(certify(self.nodes, spans, ray.start_on_line(like)))
    }

    /// A certificate with all that is asked for; `None` where it is none.
    fn completed<T: Lane>(&self, ray: &Ray, found: &Certificate<T>, settled: Settled) -> Option<Certified> {
        if !found.sure {
            return None;
        }
        let miss = Certified {
            hit: None,
            bound: 0.0,
            settled,
        };
        let number = found.leaf.to_index();
        let Some((solid, pose)) = self.leaf(number).filter(|_| found.t.value < T::from(f32::INFINITY)) else {
            return Some(miss);
        };
        let (t, bound, end) = sharpened(ray, solid, pose, found.at_enter);
        let reached = end.value.abs() + end.doubt().value;
        if reached.is_nan() || reached >= f64::from(f32::MAX) {
            // Beyond all finite numbers, if it is known at all.
            return (end.value.abs() - end.doubt().value > f64::from(f32::MAX)).then_some(miss);
        }
        let limit = f64::from(ray.range().end);
        if reached >= limit {
            return (end.value - end.doubt().value >= limit).then_some(miss);
        }
        let met = surface(ray, solid, pose, number, found);
        Some(Certified {
            hit: Some(Hit::at(ray, t, &met)),
            bound,
            settled,
        })
    }
}

impl<const N: usize, L: Solid> Csg<N, L> {
    /// The first crossing within the ray's range, and how certain it is: see [`Certified`].
    ///
    /// Of a scene that is neither seen edge on nor from a thousand of its sizes away all but one ray in thousands is settled
    /// in `f32`, which takes some four times as long as [`cast`](Self::cast) does.
    ///
    /// ```
    /// use gsdf_nostd::{Ray, Settled, Sphere, csg};
    /// use glam::{Vec3, vec3};
    ///
    /// csg! { const BALL = Sphere::new(Vec3::ZERO, 1.0) }
    /// let seen = BALL.cast_certified(&Ray::new(vec3(0.3, 0.0, 3.0), Vec3::NEG_Z)?);
    /// let hit = seen.hit.unwrap();
    /// assert_eq!((hit.t, seen.settled), ((3.0 - 0.91_f64.sqrt()) as f32, Settled::Single));
    /// assert!(seen.bound <= hit.t * f32::EPSILON / 2.0);
    /// // One that touches: no arithmetic can tell, and the answer is the rule's.
    /// let seen = BALL.cast_certified(&Ray::new(vec3(1.0, 0.0, 3.0), Vec3::NEG_Z)?);
    /// assert_eq!((seen.hit, seen.settled), (None, Settled::Tie));
    /// # Ok::<(), gsdf_nostd::RayError>(())
    /// ```
    #[must_use]
    pub fn cast_certified(&self, ray: &Ray) -> Certified {
        let program = self.program();
        let mut single = [EMPTY; N];
        let found = program.certify_along(ray, 0.0_f32, &mut single);
        let found = found.ok().and_then(|found| program.completed(ray, &found, Settled::Single));
        found.unwrap_or_else(|| self.settled_apart(ray))
    }

    /// What is rare, and takes more of the stack.
    #[cold]
    #[inline(never)]
    fn settled_apart(&self, ray: &Ray) -> Certified {
        let program = self.program();
        let mut double = [EMPTY_DOUBLE; N];
        let found = program.certify_along(ray, 0.0_f64, &mut double).ok();
        if let Some(found) = found.and_then(|found| program.completed(ray, &found, Settled::Double)) {
            return found;
        }
        let around = found.and_then(|found| program.crossing_around(ray, &double, &found));
        self.tied_apart(ray, around)
    }

    #[cold]
    #[inline(never)]
    fn tied_apart(&self, ray: &Ray, around: Option<(f64, f64)>) -> Certified {
        const NOTHING: Span<f64> = Span {
            enter: f64::INFINITY,
            exit: f64::NEG_INFINITY,
        };
        let mut spans = [NOTHING; N];
        let hit = self.program().along(*ray, &mut spans).ok().and_then(|sight| sight.cast());
        by_rule(ray, hit, around)
    }
}

/// What is decided by rule, where a crossing is certain between two parameters of the line if anything is.
fn by_rule(ray: &Ray, hit: Option<Hit>, around: Option<(f64, f64)>) -> Certified {
    let bound = match (&hit, around) {
        (Some(hit), Some((low, high))) => {
            let (low, high, t) = (ray.parameter_of(low), ray.parameter_of(high), f64::from(hit.t));
            let is_reached = high < f64::from(ray.range().end.min(f32::MAX));
            is_reached.then(|| rounded_up(hit.t, (t - low).max(high - t)))
        }
        _ => None,
    };
    Certified {
        hit,
        bound: bound.unwrap_or(f32::INFINITY),
        settled: Settled::Tie,
    }
}

const EMPTY: Span<Bounded<f32>> = Span {
    enter: Bounded {
        value: f32::INFINITY,
        error: 0.0,
    },
    exit: Bounded {
        value: f32::NEG_INFINITY,
        error: 0.0,
    },
};

const EMPTY_DOUBLE: Span<Bounded<f64>> = Span {
    enter: Bounded {
        value: f64::INFINITY,
        error: 0.0_f64,
    },
    exit: Bounded {
        value: f64::NEG_INFINITY,
        error: 0.0_f64,
    },
};

/// An end of a leaf's span in `f64`: the nearest `f32` with a bound on its error, half a unit in its last place if that is one,
/// and as it is.
fn sharpened<L: Solid>(ray: &Ray, solid: &L, pose: Option<&Transform>, at_enter: bool) -> (f32, f32, Bounded<f64>) {
    let span: Span<Bounded<f64>> = solid.span_in_world(&ray.line(0.0_f64).bounded(), pose);
    let end = ray.parameter_of(if at_enter { span.enter } else { span.exit });
    let t = end.value.to_f32();
    (t, rounded_up(t, (f64::from(t) - end.value).abs() + end.doubt().value), end)
}

/// By how much a number may be off, if it is at the most by so much: half a unit in its last place, or more.
fn rounded_up(t: f32, off: f64) -> f32 {
    let half = half_ulp(t);
    if off <= f64::from(half) { half } else { off.to_f32().next_up() }
}

/// Half of what there is between a number and the next greater one: by how much one that is rounded correctly may be off.
#[must_use]
pub fn half_ulp(t: f32) -> f32 {
    0.5 * (t.next_up() - t)
}

/// The surface of a leaf at a certified end of its span.
fn surface<T: Lane, L: Solid>(ray: &Ray, solid: &L, pose: Option<&Transform>, number: u32, found: &Certificate<T>) -> Encounter<T> {
    let (line, t) = (ray.line(found.t.value), found.t.value);
    let mut surface = match pose {
        Some(pose) => {
            let local = pose.line_to_local(&line);
            let own = solid.surface_along(&local.line, local.parameter(t));
            Surface {
                normal: pose.normal_to_world(own.normal),
                ..own
            }
        }
        None => solid.surface_along(&line, t),
    };
    let entering = !found.inside;
    if found.at_enter != entering {
        surface.normal = -surface.normal;
    }
    Encounter {
        leaf: T::from(number as f32),
        entering,
        surface,
    }
}
