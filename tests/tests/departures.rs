//! Rays that leave a hit: none meets the surface it leaves at a distance of rounding errors, and none misses what comes next.

use glam::{DVec3, Vec3};
use gsdf_nostd::{Departure, Hit, Ray, Span, Start, Transform};
use gsdf_tests::corpus;
use gsdf_tests::poses::{MOST_LEAVES, Posed, Tree, map_of, random_affine, random_motion};
use gsdf_tests::reference::{Exact, ExactVec3};
use gsdf_tests::sandwich::{ROUNDOFF, Trial};
use gsdf_tests::shape::{KINDS, SOLIDS, Shape, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors a hit may be off its surface, and so whatever is computed from it.
const ALLOWED: f64 = 64.0;

/// The least cosine between a leaving ray and the normal.
const FLATTEST: f64 = 1e-3;

/// How far away hits may be, at solids about one large: farther, a hit nearly along an axis is off its surface by as much as the solid is large.
const FARTHEST: f64 = 300.0;

/// Hits at each solid.
const HITS: u64 = 3_000;

/// The first hit of a start.
fn cast(posed: &Posed, start: impl Start) -> Option<Hit> {
    let mut scratch = [Span::EMPTY; MOST_LEAVES];
    posed.program().along(start, &mut scratch).unwrap().cast()
}

/// A ray at a random leaf of the solid, and its hit.
fn random_hit(rng: &mut Pcg64, posed: &Posed) -> Option<(Ray, Hit)> {
    let shapes = posed.shapes();
    let target = shapes[rng.random_range(0..shapes.len())];
    let (_, Trial { origin, direction, .. }) = corpus::ray(rng, &target, 1.0, 1e2);
    let (origin, direction) = to_world(posed.pose(), origin.as_dvec3(), direction.as_dvec3());
    let ray = Ray::new(origin.as_vec3(), direction.as_vec3()).unwrap();
    let hit = cast(posed, ray)?;
    let travelled = f64::from(hit.t) * direction.length();
    (travelled < FARTHEST).then_some((ray, hit))
}

fn to_world(pose: &Transform, point: DVec3, vector: DVec3) -> (DVec3, DVec3) {
    let [x, y, z] = pose.to_local().map(Vec3::as_dvec3);
    let matrix = glam::DMat3::from_cols(x, y, z).transpose().inverse();
    (matrix * point + pose.origin().as_dvec3(), matrix * vector)
}

/// A direction on the side of the normal, of any length: half of them steep, half nearly along the surface.
fn leaving(rng: &mut Pcg64, normal: Vec3) -> Vec3 {
    let normal = normal.as_dvec3();
    loop {
        let any = unit(rng);
        let any = any * any.dot(normal).signum();
        let flat = rng.random_range(0..2) == 0;
        let along = any - normal * any.dot(normal);
        let direction = if flat {
            along.normalize_or_zero() + normal * rng.random_range(FLATTEST..0.05)
        } else {
            any
        };
        if direction.normalize().dot(normal) > FLATTEST {
            return (direction * rng.random_range(0.5..2.0)).as_vec3();
        }
    }
}

/// How far a hit may be off the surface, in the world: a few rounding errors of the numbers that met there.
fn slack(posed: &Posed, ray: &Ray, hit: &Hit) -> f64 {
    ALLOWED * ROUNDOFF * posed.scale_at(ray, hit.leaf, hit.t.into())
}

/// How far a hit is from the nearest tip of a cone, in the world. At a tip the normal says nothing about which directions lead outward.
fn distance_to_tips(posed: &Posed, hit: &Hit) -> f64 {
    let tips = posed.shapes().iter().filter_map(|shape| match *shape {
        Shape::Nappe { apex, .. } | Shape::Cone { apex, .. } | Shape::SolidAngle { apex, .. } => Some(apex),
        _ => None,
    });
    let from = |tip: Vec3| (to_world(posed.pose(), tip.as_dvec3(), DVec3::ZERO).0 - hit.point.as_dvec3()).length();
    tips.map(from).fold(f64::INFINITY, f64::min)
}

/// Whether a hit is within rounding of an edge. There the next face is as near as the one that was hit: going inward from the one, a ray may leave at once through the other, and which
/// it does is for rounding to say.
fn is_at_edge(posed: &Posed, hit: &Hit, slack: f64) -> bool {
    let shape = posed.shapes()[hit.leaf as usize];
    if matches!(shape, Shape::Triangle { .. } | Shape::Quad { .. }) {
        return false;
    }
    let rows = posed.pose().to_local().map(Vec3::as_dvec3);
    let shrunk = (glam::DMat3::from_cols_array_2d(&rows.map(|row| row.to_array())).inverse() * hit.normal.as_dvec3()).length();
    let depth = 3.75 * slack / shrunk;
    // A point below the face that was hit, or above it where the leaf was cut away, is not as deep in the leaf as below that face only if another face is nearer.
    let is_deep = |way: f64| {
        let below = &ExactVec3::from(hit.point) + &ExactVec3::from((hit.normal.as_dvec3() * (way * 4.0 * slack)).to_array());
        shape.exact(-depth).contains(map_of(posed.pose()).apply(&below))
    };
    !is_deep(-1.0) && !is_deep(1.0)
}

/// What came of leaving hits one way.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    hits: usize,
    /// Rays that were cast anew from the point and begin in the solid or meet it at once.
    naive: usize,
    /// Rays that leave the hit and do so.
    again: usize,
    /// Hits within rounding of an edge.
    at_edges: usize,
    /// Rays that leave another hit and whose next crossing is not that of the exact solid.
    wrong: usize,
    /// Rays that leave the hit and cross anything at all.
    met: usize,
}

impl Tally {
    fn add(self, other: Self) -> Self {
        Self {
            hits: self.hits + other.hits,
            naive: self.naive + other.naive,
            again: self.again + other.again,
            at_edges: self.at_edges + other.at_edges,
            wrong: self.wrong + other.wrong,
            met: self.met + other.met,
        }
    }
}

/// Whether what is found on leaving is what is found in exact arithmetic from a point just off the surface, on the side to which the ray leaves; but for what lies within rounding of
/// the start, as another face does where the hit is at an edge.
fn is_next(posed: &Posed, hit: &Hit, departure: Departure, slack: f64, side: f64) -> bool {
    let ray = Start::ray(&departure);
    let length = ray.direction().as_dvec3().length();
    let off = hit.normal.as_dvec3() * slack * side;
    let start = &ExactVec3::from(hit.point) + &ExactVec3::from(off.to_array());
    let (_, expected) = posed.expected(&start, ray.direction());
    let (_, found) = posed.computed(departure);
    let is_same_beyond = |start: f64| {
        let first_expected = expected.iter().find(|crossing| crossing.t * length > start);
        let first_found = found.iter().find(|crossing| f64::from(crossing.t) * length > start);
        match (first_found, first_expected) {
            (None, None) => true,
            (Some(found), Some(first)) => {
                let t = f64::from(found.t);
                let near = (t - first.t).abs() * length <= 4.0 * slack || posed.is_near_leaf(ray, found.leaf, t, 4.0 * ALLOWED);
                near && found.entering == first.entering && found.leaf == first.leaf
            }
            _ => false,
        }
    };
    is_same_beyond(0.0) || is_same_beyond(4.0 * slack)
}

/// Leaves hits at a solid to the side of the normal that `side` names: +1 the normal's, -1 the other.
fn leave(seed: u64, posed: &Posed, side: f64) -> Tally {
    let mut rng = Pcg64::seed_from_u64(seed);
    let Some((ray, hit)) = random_hit(&mut rng, posed) else {
        return Tally::default();
    };
    let slack = slack(posed, &ray, &hit);
    if distance_to_tips(posed, &hit) < 64.0 * slack {
        return Tally::default();
    }
    // The normal leads out of the solid: against the ray where it enters, also on the inner side of what was cut away.
    let cosine = ray.direction().normalize().dot(hit.normal);
    assert!(
        cosine.abs() < FLATTEST as f32 || (cosine < 0.0) == hit.entering,
        "{ray:?} {hit:?} {:?}",
        posed.shapes()
    );
    let away = leaving(&mut rng, hit.normal) * side as f32;
    let (direction, inside) = (away.as_dvec3(), side < 0.0);
    let is_again = |next: &Hit| next.leaf == hit.leaf && f64::from(next.t) * direction.length() < slack;
    let anew = Ray::new(hit.point, away).unwrap();
    let naive = posed.computed(anew);
    let begins_wrong = naive.0 != inside || cast(posed, anew).is_some_and(|next| is_again(&next));

    let departure = Departure::new(&hit, away).unwrap();
    let next = cast(posed, departure);
    let at_edge = is_at_edge(posed, &hit, slack);
    let wrong = !at_edge && !is_next(posed, &hit, departure, slack, side);
    Tally {
        hits: 1,
        naive: begins_wrong.into(),
        again: next.is_some_and(|next| is_again(&next)).into(),
        at_edges: at_edge.into(),
        wrong: wrong.into(),
        met: next.is_some().into(),
    }
}

fn leave_all(name: &str, side: f64, make: impl Fn(&mut Pcg64) -> Posed + Sync) -> Tally {
    let one = |seed: u64| {
        let mut rng = Pcg64::seed_from_u64(seed);
        leave(rng.random(), &make(&mut rng), side)
    };
    let tally = (0..HITS).into_par_iter().map(one).reduce(Tally::default, Tally::add);
    let way = if side > 0.0 { "outward" } else { "inward" };
    println!(
        "{name}, {way}: {tally:?}, naively wrong {} %",
        100 * tally.naive / tally.hits.max(1)
    );
    assert!(tally.hits as u64 * 4 > HITS, "{name}: the rays have lost their aim");
    tally
}

fn leaf_at_rest(rng: &mut Pcg64, kind: usize) -> Posed {
    Posed::new(Shape::random(rng, kind, 1.0, 2.0).into(), Transform::IDENTITY)
}

/// Outward of a convex solid there is nothing more of it; a ray cast anew from the rounded point often finds something.
#[test]
fn nothing_is_met_outward_of_a_convex_solid() {
    for (kind, name) in KINDS.iter().enumerate() {
        let tally = leave_all(name, 1.0, |rng| leaf_at_rest(rng, kind));
        assert_eq!((tally.again, tally.wrong, tally.met), (0, 0, 0), "{name}");
        assert!(
            tally.naive * 10 > tally.hits,
            "{name}: {tally:?}: without re-hits there would be no need for departures"
        );
    }
}

/// Inward a ray starts inside and comes out on the other side.
#[test]
fn inward_the_way_out_is_found() {
    for (kind, name) in KINDS.iter().enumerate().take(SOLIDS) {
        let tally = leave_all(name, -1.0, |rng| leaf_at_rest(rng, kind));
        assert!(tally.wrong * 100 <= tally.hits, "{name}: {tally:?}");
    }
}

/// Overlapping, cut and posed solids: what is found next is what is there.
#[test]
fn departures_in_programs() {
    let shape = |rng: &mut Pcg64| {
        let kind = rng.random_range(0..KINDS.len());
        Shape::random(rng, kind, 1.0, 1.0)
    };
    let union = |rng: &mut Pcg64| Tree::from(shape(rng)).or(shape(rng)).or(shape(rng));
    let difference = |rng: &mut Pcg64| Tree::from(shape(rng)).minus(shape(rng)).minus(shape(rng));
    for side in [1.0, -1.0] {
        let tallies = [
            leave_all("union", side, |rng| Posed::new(union(rng), Transform::IDENTITY)),
            leave_all("difference", side, |rng| Posed::new(difference(rng), Transform::IDENTITY)),
            leave_all("moved union", side, |rng| Posed::new(union(rng), random_motion(rng))),
            leave_all("stretched difference", side, |rng| {
                Posed::new(difference(rng), random_affine(rng, 4.0))
            }),
        ];
        for tally in tallies {
            assert!(tally.wrong * 100 <= tally.hits, "{tally:?}");
            assert!(tally.again * 200 <= tally.hits, "{tally:?}");
        }
    }
}

/// From edges, rims and seams: outward nothing, in any pose.
#[test]
fn nothing_is_met_outward_of_edges() {
    for (kind, name) in KINDS.iter().enumerate().skip(4) {
        let one = |seed: u64| {
            let mut rng = Pcg64::seed_from_u64(seed);
            let shape = Shape::random(&mut rng, kind, 1.0, 2.0);
            let pose = [Transform::IDENTITY, random_motion(&mut rng), random_affine(&mut rng, 4.0)][rng.random_range(0..3)];
            let posed = Posed::new(shape.into(), pose);
            let toward = unit(&mut rng);
            let from = shape.edge_point(&mut rng) - toward * rng.random_range(0.5..20.0);
            let (origin, direction) = to_world(&pose, from, toward);
            let ray = Ray::new(origin.as_vec3(), direction.as_vec3()).unwrap();
            let hit = cast(&posed, ray)?;
            if distance_to_tips(&posed, &hit) < 64.0 * slack(&posed, &ray, &hit) {
                return None;
            }
            let away = leaving(&mut rng, hit.normal);
            let next = cast(&posed, Departure::new(&hit, away).unwrap());
            Some(next.map(|next| format!("{hit:?} towards {away} meets {next:?} of {:?} in {pose:?}", posed.shapes())))
        };
        let outcomes: Vec<_> = (0..HITS).into_par_iter().filter_map(one).collect();
        let again: Vec<_> = outcomes.iter().flatten().collect();
        println!("{name}: {} of {} hits at edges are met again", again.len(), outcomes.len());
        assert!(outcomes.len() as u64 * 5 > HITS, "the rays have lost their aim");
        assert!(again.is_empty(), "{name}: {}", again[0]);
    }
}

/// Two boxes side by side, flush on top, made large or small by the pose: a ray that leaves the one flatly does not run into the other, though only the one it leaves is known to it.
#[test]
fn nothing_is_met_across_a_flush_joint() {
    for factor in [0.002_f32, 0.1, 1.0, 10.0, 500.0] {
        let one = |seed: u64| {
            let mut rng = Pcg64::seed_from_u64(seed);
            let mut tenths = |least: i32, most: i32| rng.random_range(least..=most) as f32 * 0.1;
            let low = Vec3::new(tenths(-30, 30), tenths(-30, 30), tenths(-30, 30));
            let (joint, high) = (low.x + tenths(2, 10), low + Vec3::new(2.5, 1.0, tenths(2, 10)));
            let first = Shape::Cuboid {
                min: low,
                max: high.with_x(joint),
            };
            let second = Shape::Cuboid {
                min: low.with_x(joint),
                max: high,
            };
            let motion = random_motion(&mut rng);
            let rotation = glam::Mat3::from_cols_array_2d(&motion.to_local().map(|row| row.to_array()));
            let pose = Transform::affine(rotation * factor, motion.origin()).unwrap();
            let posed = Posed::new(Tree::from(first).or(second), pose);
            let mut share = |from: f32, to: f32| f64::from(from) + rng.random_range(0.1..0.9) * f64::from(to - from);
            let target = DVec3::new(share(low.x, joint), share(low.y, high.y), high.z.into());
            let from = target + (unit(&mut rng).with_z(0.0) + DVec3::Z) * rng.random_range(0.5..20.0);
            let (origin, direction) = to_world(&pose, from, target - from);
            let hit = cast(&posed, Ray::new(origin.as_vec3(), direction.as_vec3()).unwrap()).unwrap();
            assert_eq!((hit.leaf, hit.face), (0, 5), "{hit:?}");
            let (_, across) = to_world(&pose, target, DVec3::new(1.0, 0.0, rng.random_range(FLATTEST..0.05)));
            let next = cast(&posed, Departure::new(&hit, across.as_vec3()).unwrap());
            assert!(
                next.is_none(),
                "factor {factor}: {hit:?} towards {across} meets {next:?} of {posed:?}"
            );
            usize::from(cast(&posed, Ray::new(hit.point, across.as_vec3()).unwrap()).is_some())
        };
        let naive: usize = (0..HITS).into_par_iter().map(one).sum();
        println!("flush joint, {factor} times as large: {naive} of {HITS} rays cast anew meet something");
        assert!(naive > 0, "without re-hits there would be no need for departures");
    }
}

/// The exact point of a hit is used as it stands: nothing of a departure depends on where the ray before it came from but the slack.
#[test]
fn a_departure_keeps_the_hit_point() {
    let mut rng = Pcg64::seed_from_u64(5);
    for kind in 0..KINDS.len() {
        let posed = leaf_at_rest(&mut rng, kind);
        let Some((_, hit)) = random_hit(&mut rng, &posed) else { continue };
        let away = leaving(&mut rng, hit.normal);
        let departure = Departure::new(&hit, away).unwrap();
        let ray = Start::ray(&departure);
        assert_eq!((ray.origin(), ray.direction()), (hit.point, away));
        assert!(Exact::from(ray.range().start).is_zero());
    }
}
