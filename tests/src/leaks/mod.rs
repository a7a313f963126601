//! Solids that share an edge or a face, and rays aimed at what they share: none may slip through between them.
//!
//! A *leak* is a place along a ray where the union of the solids is left although the exact union goes on, by more than
//! rounding errors, and away from the edge. Two exceptions are no leaks. A ray that lies *in* a shared plane to the last
//! bit is in neither of the solids, as it is in none that has only a face there. And where more than two planes meet in
//! one edge each is rounded by itself, so that a ray through the edge may find them in another order, and leave the union
//! for the few rounding errors of that: a *sliver*.

mod solids;

use crate::poses::random_motion;
use crate::sandwich::ROUNDOFF;
use crate::shape::{log_uniform, unit};
use glam::{DMat3, DVec3, Vec3};
use gsdf_nostd::{Crossing, Line, Node, Program, Ray, Span, Transform};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
pub use solids::KINDS;
use solids::Shared;

/// Rays at one arrangement of solids.
pub const RAYS: u64 = 256;

/// The room for leaves.
const LEAVES: usize = 32;

/// How many rounding errors a surface may be off on its way into a frame and out of it.
const ALLOWED: f64 = 32.0;

/// What the rays came to.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Rays that were cast.
    pub rays: u64,
    /// Those that met the solids.
    pub met: u64,
    /// Those that lie in a shared plane.
    pub in_plane: u64,
    /// Those that left the union for rounding errors at an edge of more than two planes.
    pub slivers: u64,
    /// Those that slipped through.
    pub leaks: u64,
    /// What the first of them was.
    pub first: Option<String>,
}

impl Tally {
    /// Both as one.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            met: self.met + other.met,
            in_plane: self.in_plane + other.in_plane,
            slivers: self.slivers + other.slivers,
            leaks: self.leaks + other.leaks,
            first: self.first.or(other.first),
        }
    }
}

/// Where a ray is inside, as far as its crossings tell.
type Spans = Vec<(f64, f64)>;

/// [`RAYS`] rays at an arrangement of the kind with this number, all of a seed's own making.
///
/// # Panics
/// Where the library refuses what it should not.
#[must_use]
pub fn cast(kind: usize, seed: u64) -> Tally {
    let mut rng = Pcg64::seed_from_u64(seed * KINDS.len() as u64 + kind as u64);
    let shared = Shared::random(&mut rng, kind);
    // One in four stays at rest, where rays can be exact.
    let pose = if rng.random_range(0..4) == 0 {
        Transform::IDENTITY
    } else {
        random_motion(&mut rng)
    };
    let to_world = to_world(&pose);
    let mut tally = Tally::default();
    for _ in 0..RAYS {
        let edge = shared.edge_point(&mut rng);
        let (origin, direction) = aim(&mut rng, &shared, edge, pose == Transform::IDENTITY);
        let moved = |point: DVec3| to_world * point + pose.origin().as_dvec3();
        // From where the start is rounded to straight at the edge.
        let (start, target) = (moved(origin).as_vec3(), moved(edge));
        let direction = if pose == Transform::IDENTITY && direction.to_array().contains(&0.0) {
            direction.as_vec3()
        } else {
            (target - start.as_dvec3()).as_vec3()
        };
        let ray = Ray::new(start, direction).expect("moderate numbers make a ray");
        check(&shared, &pose, &ray, target, &mut tally);
    }
    tally
}

/// The matrix of a pose.
fn to_world(pose: &Transform) -> DMat3 {
    let rows = pose.to_local().map(Vec3::as_dvec3);
    DMat3::from_cols(rows[0], rows[1], rows[2]).transpose().inverse()
}

/// A ray of the frame, exactly at a point of an edge: from outside toward what is within, or any way.
fn aim(rng: &mut Pcg64, shared: &Shared, edge: DVec3, at_rest: bool) -> (DVec3, DVec3) {
    let distance = shared.size * log_uniform(rng, 0.1, 30.0);
    let direction = if shared.whole.is_none() || rng.random_range(0..2) == 0 {
        let within = shared.middle + unit(rng) * shared.depth * rng.random_range(0.0..0.9);
        if shared.is_hollow && rng.random_range(0..2) == 0 {
            return (within, edge - within);
        }
        edge - within
    } else if at_rest && rng.random_range(0..3) == 0 {
        // In a plane of coordinates, or along one.
        let mut along = unit(rng);
        along[rng.random_range(0..3)] = 0.0;
        if rng.random() {
            along[rng.random_range(0..3)] = 0.0;
        }
        along
    } else {
        unit(rng)
    };
    let Some(outward) = direction.try_normalize() else {
        return (edge + DVec3::X * distance, DVec3::NEG_X);
    };
    (edge + outward * distance, -outward)
}

fn crossings(nodes: &[Node], pose: &Transform, ray: &Ray) -> (bool, Vec<Crossing<f32>>) {
    let mut scratch = [Span::EMPTY; LEAVES];
    let poses = core::slice::from_ref(pose);
    let program = Program::new(nodes)
        .and_then(|program| program.posed(poses))
        .expect("these are programs");
    let sight = program.along(*ray, &mut scratch).expect("there is room");
    (sight.march::<f32>().inside, sight.crossings().collect())
}

fn spans((inside, crossings): &(bool, Vec<Crossing<f32>>)) -> Spans {
    let ends = crossings.iter().map(|crossing| f64::from(crossing.t));
    let mut ends: Vec<f64> = inside.then_some(0.0).into_iter().chain(ends).collect();
    if ends.len() % 2 == 1 {
        ends.push(f64::INFINITY);
    }
    ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

/// What of the first is not in the second; both in order.
fn gaps(whole: &Spans, union: &Spans) -> Spans {
    let mut gaps = Spans::new();
    for &(enter, exit) in whole {
        let mut from = enter;
        for &(next, last) in union.iter().filter(|&&(next, last)| last > enter && next < exit) {
            if next > from {
                gaps.push((from, next));
            }
            from = from.max(last);
        }
        if from < exit {
            gaps.push((from, exit));
        }
    }
    gaps
}

fn check(shared: &Shared, pose: &Transform, ray: &Ray, edge: DVec3, tally: &mut Tally) {
    tally.rays += 1;
    let local: Line<f32> = pose.line_to_local(&ray.line(0.0)).line;
    if shared.has_in_plane(&local) {
        tally.in_plane += 1;
        return;
    }
    let found = crossings(&shared.nodes, pose, ray);
    let union = spans(&found);
    tally.met += u64::from(!union.is_empty());
    let rows = pose.to_local().map(Vec3::as_dvec3);
    let at = |t: f64| {
        let from = ray.origin().as_dvec3() + ray.direction().as_dvec3() * t - pose.origin().as_dvec3();
        DVec3::from_array(rows.map(|row| row.dot(from)))
    };
    let speed = ray.direction().as_dvec3().length();
    let rounding = |t: f64| {
        let outside = ray.origin().as_dvec3().length() + pose.origin().as_dvec3().length();
        ALLOWED * ROUNDOFF * (outside + shared.extent + t.abs() * speed)
    };
    let leak = |why: String| format!("{why}: {found:?} along {ray:?} of {:?} in {pose:?}", shared.nodes);
    let gaps = match &shared.whole {
        // The faces are the same numbers: what is shared is gone to the bit.
        Some(whole) => {
            let whole = crossings(whole, pose, ray);
            if shared.edge.is_none() && (whole.0 != found.0 || !same_places(&whole.1, &found.1)) {
                tally.leaks += 1;
                tally.first.get_or_insert_with(|| leak(format!("not as the whole, {whole:?}")));
                return;
            }
            gaps(&spans(&whole), &union)
        }
        // From where the ray meets the edge to where it is deep inside; a mesh has no inside.
        None => {
            let along = ray.direction().as_dvec3();
            let nearest = |p: DVec3| (p - ray.origin().as_dvec3()).dot(along) / along.length_squared();
            let (edge, within) = (nearest(edge), nearest(to_world(pose) * shared.middle + pose.origin().as_dvec3()));
            let is_met = found
                .1
                .iter()
                .any(|crossing| (f64::from(crossing.t) - edge).abs() * speed <= 1e-3 * shared.size);
            if shared.is_hollow {
                if !is_met {
                    tally.leaks += 1;
                    tally.first.get_or_insert_with(|| leak(format!("nothing near {edge}")));
                }
                return;
            }
            gaps(&vec![(edge, within)], &union)
        }
    };
    let mut is_sliver = false;
    for (from, to) in gaps {
        let is_at_edge = |t: f64| t.is_finite() && shared.distance_to_edge(at(t)) <= rounding(t);
        if is_at_edge(from) && is_at_edge(to) {
            is_sliver = true;
        } else {
            tally.leaks += 1;
            tally.first.get_or_insert_with(|| leak(format!("open from {from} to {to}")));
            return;
        }
    }
    tally.slivers += u64::from(is_sliver && shared.whole.is_some());
}

fn same_places(one: &[Crossing<f32>], other: &[Crossing<f32>]) -> bool {
    let place = |crossing: &Crossing<f32>| (crossing.t.to_bits(), crossing.entering);
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| place(one) == place(other))
}
