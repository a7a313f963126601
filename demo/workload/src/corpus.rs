//! A hundred thousand rays with every oddity, and what is asked about them.
//!
//! The rays are drawn by a generator of specified integers and put together by correctly rounded operations in one
//! written order, so that they too have the same bits everywhere. All aim at solids about one unit in size whose
//! faces, edges and tips lie at multiples of a quarter: so do many of the rays, which makes exact touches frequent.

mod draw;
mod programs;

pub use draw::{Class, Queries, Query};
pub use programs::{PROGRAMS, program};

use crate::digest::Digest;
use glam::Vec3;
use gsdf_nostd::{Departure, Hit, Lane, ProgramError, Ray, Span, V3};

/// How many rays there are.
pub const RAYS: usize = 100_000;

/// Of how many rays one is asked more than what it hits: all would keep a Cortex-M0 busy for too long.
const STRIDE: usize = 3;

/// How many rays in a row are asked about one program: as many as a packet holds.
pub const BLOCK: usize = 8;

/// The spans of scratch memory that every program of the corpus does with.
pub const SPANS: usize = programs::MOST_LEAVES;

/// The rays, in order. Ray number `n` is for program `n / BLOCK`, counted modulo the number of programs.
#[must_use]
pub fn queries() -> Queries {
    Queries::new()
}

/// The hash of what each ray hits first, in the arithmetic of the scratch memory; a ray that is none counts as refused.
///
/// # Errors
/// Where `scratch` is shorter than [`SPANS`].
pub fn hits<T: Lane>(scratch: &mut [Span<T>]) -> Result<u64, ProgramError> {
    let mut digest = Digest::new();
    for query in queries() {
        match query.ray() {
            Ok(ray) => digest.cast(program(query.program).along(ray, &mut *scratch)?.cast().as_ref()),
            Err(_) => digest.refused(),
        }
    }
    Ok(digest.finish())
}

/// The hash of the standard distance at the origin of every third ray, of the directional one along it and of all its
/// crossings, in the arithmetic of the scratch memory.
///
/// # Errors
/// Where `scratch` is shorter than [`SPANS`].
pub fn readings<T: Lane>(scratch: &mut [Span<T>]) -> Result<u64, ProgramError> {
    let mut digest = Digest::new();
    for query in queries().step_by(STRIDE) {
        let Ok(ray) = query.ray() else {
            digest.refused();
            continue;
        };
        let program = program(query.program);
        let distance = program.distance(V3::splat(T::from(0.0), ray.origin()));
        let sight = program.along(ray, &mut *scratch)?;
        digest.number(distance.to_f32());
        digest.number(sight.gsdf().to_f32());
        for crossing in sight.crossings() {
            digest.number(crossing.t.to_f32());
            digest.word(2 * crossing.leaf + u32::from(crossing.entering));
        }
    }
    Ok(digest.finish())
}

/// The hash of what is hit next from where every third ray hits first: straight on and mirrored by turns;
/// in the arithmetic of the scratch memory.
///
/// # Errors
/// Where `scratch` is shorter than [`SPANS`].
pub fn departures<T: Lane>(scratch: &mut [Span<T>]) -> Result<u64, ProgramError> {
    let mut digest = Digest::new();
    for (number, query) in queries().step_by(STRIDE).enumerate() {
        let program = program(query.program);
        let Ok(ray) = query.ray() else { continue };
        let Some(hit) = program.along(ray, &mut *scratch)?.cast() else {
            continue;
        };
        let onward = if number % 2 == 0 { ray.direction() } else { mirrored(&ray, &hit) };
        match Departure::new(&hit, onward) {
            Ok(departure) => digest.cast(program.along(departure, &mut *scratch)?.cast().as_ref()),
            Err(_) => digest.refused(),
        }
    }
    Ok(digest.finish())
}

/// The direction of a ray after it was mirrored where it hit.
fn mirrored(ray: &Ray, hit: &Hit) -> Vec3 {
    let (direction, normal) = (V3::from(ray.direction()), V3::from(hit.normal));
    (direction - normal.scaled(2.0 * direction.dot(normal))).into()
}
