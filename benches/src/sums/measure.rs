//! What they cost.

use super::made_of::Composed;
use crate::inputs::{Inputs, SEED};
use crate::leaves::ray_kernel;
use crate::stats::Estimate;
use anyhow::{Context, Result};
use gsdf_counted::{Counted, counting};
use gsdf_nostd::{Anywhere, Leaf, Line, Program, Real, Solid, Span, Toward, V3, march};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// How long each turn lasts at least.
const LEAST_TURN: Duration = Duration::from_millis(1);

/// A ray, or a packet of them: origin and direction.
pub type Rays<T> = [(V3<T>, V3<T>)];

/// The times of a shape in one arithmetic, and their ratios.
#[derive(Clone, Debug)]
pub struct Costs {
    /// The medians in nanoseconds per ray: of all parts alone, one after the other; of the program of the parts; of the span of its own.
    pub nanoseconds: [f64; 3],
    /// The program against the parts.
    pub program_to_parts: Estimate,
    /// The span of its own against the parts.
    pub own_to_parts: Estimate,
    /// The span of its own against the program.
    pub own_to_program: Estimate,
}

/// The operations per ray, of all kinds together, those that belong to the ray's direction counted once; and of them the divisions and square roots.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    /// All of them: of the parts, of the program, of the span of its own.
    pub all: [f64; 3],
    /// Divisions and square roots alone.
    pub slow: [f64; 3],
}

/// Rays for a shape: half of them hit its span of its own; or, where it has none, its first part.
#[must_use]
pub fn inputs_for(shape: &Composed, count: usize) -> Option<Inputs> {
    let target = shape.own.as_ref().or_else(|| shape.parts().next())?;
    Some(Inputs::new(target, shape.name, count, SEED))
}

/// The distances along rays by a solid of one kind, which is known before the first of them: a call per ray, or packet.
fn alone<T: Real>(leaf: &Leaf, rays: &Rays<T>, distances: &mut [T]) {
    macro_rules! by_kind {
        ($($kind:ident)+) => {
            match leaf {
                $(Leaf::$kind(solid) => calls(solid, rays, distances),)+
            }
        };
    }
    by_kind! {
        HalfSpace Sphere Cylinder Nappe Cuboid CappedCylinder Cone CappedCone Capsule HexagonalPrism TriangularPrism Octahedron Pyramid
        Rhombus RoundedCone SolidAngle Triangle Quad
    }
}

fn calls<T: Real, S: Solid>(solid: &S, rays: &Rays<T>, distances: &mut [T]) {
    #[inline(never)]
    fn one<T: Real, S: Solid>(solid: &S, (origin, direction): &(V3<T>, V3<T>)) -> T {
        ray_kernel(solid, *origin, *direction)
    }
    for (distance, ray) in distances.iter_mut().zip(rays) {
        *distance = one(solid, ray);
    }
}

/// The same by a program: every leaf's span, then the march.
fn together<T: Real>(program: &Program<'_>, rays: &Rays<T>, spans: &mut [Span<T>], distances: &mut [T]) {
    #[inline(never)]
    fn one<T: Real>(program: &Program<'_>, (origin, direction): &(V3<T>, V3<T>), spans: &mut [Span<T>]) -> T {
        marched(program, &line(*origin, *direction), spans)
    }
    for (distance, ray) in distances.iter_mut().zip(rays) {
        *distance = one(program, ray, spans);
    }
}

#[inline(always)]
fn marched<T: Real>(program: &Program<'_>, line: &Line<T>, spans: &mut [Span<T>]) -> T {
    program.spans_along(line, Anywhere, spans);
    let found = march(program.nodes(), spans, line.toward.vv.splat_like(0.0));
    T::select(found.inside, -found.t, found.t)
}

#[inline(always)]
fn line<T: Real>(origin: V3<T>, direction: V3<T>) -> Line<T> {
    Line {
        origin,
        toward: Toward::new(direction),
    }
}

/// The distances along rays by the program, and by the span of its own where there is one.
///
/// # Errors
/// Where the parts are not a program.
pub fn distances_of(shape: &Composed, rays: &Rays<f32>) -> Result<[Option<Vec<f32>>; 2]> {
    let program = Program::new(&shape.nodes).with_context(|| shape.name)?;
    let (mut by_program, mut by_own) = (vec![0.0; rays.len()], vec![0.0; rays.len()]);
    together(&program, rays, &mut vec![Span::EMPTY; program.leaves()], &mut by_program);
    Ok([
        Some(by_program),
        shape.own.as_ref().map(|own| {
            alone(own, rays, &mut by_own);
            by_own
        }),
    ])
}

/// Times a shape on rays, or packets of `lanes`: parts, program and span of its own by turns, in each round from another one on.
///
/// # Errors
/// Where the parts are not a program.
pub fn costs<T: Real>(shape: &Composed, rays: &Rays<T>, lanes: usize, rounds: usize) -> Result<Costs> {
    let program = Program::new(&shape.nodes).with_context(|| shape.name)?;
    let like = rays.first().with_context(|| format!("{}: no rays", shape.name))?.0.x;
    let mut spans = vec![Span::empty_like(like); program.leaves()];
    let mut distances = vec![like; rays.len()];
    let mut pass = |way: usize| match way {
        0 => shape
            .parts()
            .for_each(|part| alone(black_box(part), rays, black_box(&mut distances))),
        1 => together(black_box(&program), rays, &mut spans, black_box(&mut distances)),
        _ => {
            if let Some(own) = &shape.own {
                alone(black_box(own), rays, black_box(&mut distances));
            }
        }
    };
    let mut turn = |way: usize, repeats: u32| {
        let begin = Instant::now();
        (0..repeats).for_each(|_| pass(way));
        begin.elapsed().as_secs_f64() / f64::from(repeats)
    };
    let ways = if shape.own.is_some() { 3 } else { 2 };
    let trials: Vec<f64> = (0..ways).map(|way| turn(way, 1).min(turn(way, 1))).collect();
    let slowest = trials.iter().fold(LEAST_TURN.as_secs_f64(), |most, trial| most.max(*trial));
    // Turns that last equally long are disturbed alike.
    let repeats: Vec<_> = trials
        .iter()
        .map(|trial| (slowest / trial).round().clamp(1.0, 1e6) as u32)
        .collect();
    let mut times = vec![Vec::new(); 3];
    for round in 0..rounds.max(1) {
        for way in (0..ways).map(|way| (way + round) % ways) {
            times[way].push(turn(way, repeats[way]));
        }
    }
    let estimate = |sample: &[f64]| Estimate::new(sample).unwrap_or(Estimate::UNKNOWN);
    let ratio = |of: usize, to: usize| {
        let ratios: Vec<f64> = times[of].iter().zip(&times[to]).map(|(of, to)| of / to).collect();
        estimate(&ratios)
    };
    let per_ray = 1e9 / (rays.len() * lanes) as f64;
    Ok(Costs {
        nanoseconds: core::array::from_fn(|way| per_ray * estimate(&times[way]).median),
        program_to_parts: ratio(1, 0),
        own_to_parts: ratio(2, 0),
        own_to_program: ratio(2, 1),
    })
}

/// Counts what a shape takes on rays: the same on every machine.
///
/// # Errors
/// Where the parts are not a program.
pub fn counts(shape: &Composed, rays: &Rays<f32>) -> Result<Counts> {
    let program = Program::new(&shape.nodes).with_context(|| shape.name)?;
    let mut spans = vec![Span::empty_like(Counted(0.0)); program.leaves()];
    let mut counts = Counts::default();
    let lifted = |v: &V3<f32>| V3::new(Counted(v.x), Counted(v.y), Counted(v.z));
    for (origin, direction) in rays {
        let (line, of_direction) = counting(|| line(lifted(origin), lifted(direction)));
        let zero = Counted(0.0);
        let crossing = |leaf: &Leaf| leaf.span_along(&line).signed_crossing(zero);
        let ways = [
            counting(|| {
                shape.parts().for_each(|part| {
                    black_box(crossing(part));
                });
            })
            .1,
            counting(|| marched(&program, &line, &mut spans)).1,
            counting(|| shape.own.as_ref().map(crossing)).1,
        ];
        for (way, mut done) in ways.into_iter().enumerate() {
            done += of_direction;
            let slow = done.divisions + done.square_roots;
            counts.slow[way] += slow as f64 / rays.len() as f64;
            let quick = done.additions + done.multiplications + done.comparisons + done.selections + done.extrema + done.signs;
            counts.all[way] += (slow + quick) as f64 / rays.len() as f64;
        }
    }
    Ok(counts)
}

#[cfg(test)]
mod tests {
    use super::{costs, counts, distances_of, inputs_for};
    use crate::sums::all;
    use anyhow::{Context, Result};
    use glam::Vec3;
    use gsdf_nostd::Solid;

    /// By how much a surface may be moved by rounding, of coordinates of about four units.
    const ROUNDING: f32 = 2e-5;

    #[test]
    fn programs_of_parts_are_the_shapes() -> Result<()> {
        for shape in all()? {
            let Some(own) = &shape.own else { continue };
            let inputs = inputs_for(&shape, 4096).context("a part")?;
            let [program, span] = distances_of(&shape, &inputs.rays)?;
            let mut hits = 0;
            for ((ray, by_program), by_own) in inputs.rays.iter().zip(program.context("a program")?).zip(span.context("a span")?) {
                let (origin, direction): (Vec3, Vec3) = (ray.0.into(), ray.1.into());
                hits += u32::from(by_own.is_finite());
                for t in [by_program, by_own] {
                    let off = if t.is_finite() { own.sdf(origin + t * direction) } else { 0.0 };
                    assert!(off.abs() < ROUNDING, "{}: {t} along {ray:?} is {off} off", shape.name);
                }
                if by_program.is_finite() != by_own.is_finite() {
                    // Then the ray no more than touches the shape.
                    let t = by_program.min(by_own);
                    let deepest = (0..100)
                        .map(|step| own.sdf(origin + (t + 0.01 * step as f32) * direction))
                        .fold(0.0, f32::min);
                    assert!(deepest > -ROUNDING, "{}: {by_program} and {by_own} along {ray:?}", shape.name);
                } else if by_own.is_finite() {
                    let apart = (by_program - by_own).abs();
                    assert!(apart < 1e-2, "{}: {by_program} and {by_own} along {ray:?}", shape.name);
                }
            }
            assert!(hits > 1900, "{}: {hits}", shape.name);
        }
        Ok(())
    }

    #[test]
    fn every_figure_is_there_where_there_is_something_to_measure() -> Result<()> {
        for shape in all()? {
            let inputs = inputs_for(&shape, 64).context("a part")?;
            let (times, counts) = (costs(&shape, &inputs.rays, 1, 1)?, counts(&shape, &inputs.rays)?);
            let ways = if shape.own.is_some() { 3 } else { 2 };
            assert!(
                times.nanoseconds[..ways].iter().all(|time| *time > 0.0),
                "{}: {times:?}",
                shape.name
            );
            assert_eq!(times.own_to_parts.median.is_nan(), shape.own.is_none(), "{}", shape.name);
            // The program does all that its parts do, and compares.
            assert!(
                counts.all[1] > counts.all[0] && counts.slow[1] == counts.slow[0],
                "{}: {counts:?}",
                shape.name
            );
        }
        Ok(())
    }
}
