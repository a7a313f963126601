//! Solids that share a face: no skin is left of it, in any pose, and elsewhere nothing differs from exact arithmetic either.

use glam::{DVec3, Vec3};
use gsdf_nostd::{CappedCylinder, Crossing, HalfSpace, Leaf, Node, Program, Ray, Span, Transform};
use gsdf_tests::arrangements::{ARRANGEMENTS, Aim, Arrangement, distance_to_edges, tenths};
use gsdf_tests::poses::{Expected, Posed, random_motion};
use gsdf_tests::sandwich::{ROUNDOFF, disagreements};
use gsdf_tests::shape::{Shape, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors off its surface a crossing may be. Measured: see the figures each test prints.
const ALLOWED: f64 = 8.0;

const POSES: u64 = 1_000;

/// How many rays of each aim are cast at one arrangement in one pose.
const RAYS: [(Aim, usize); 5] = [
    (Aim::Through, 5),
    (Aim::Along, 2),
    (Aim::Edge, 3),
    (Aim::Random, 3),
    (Aim::Inside, 1),
];

/// A point of the world, in the frame.
fn to_frame(pose: &Transform, point: DVec3) -> DVec3 {
    let rows = pose.to_local().map(Vec3::as_dvec3);
    DVec3::from_array(rows.map(|row| row.dot(point - pose.origin().as_dvec3())))
}

/// A point and a vector of the frame, in the world.
fn to_world(pose: &Transform, point: DVec3, vector: DVec3) -> (DVec3, DVec3) {
    let rows = pose.to_local().map(Vec3::as_dvec3);
    let matrix = glam::DMat3::from_cols(rows[0], rows[1], rows[2]).transpose().inverse();
    (matrix * point + pose.origin().as_dvec3(), matrix * vector)
}

/// Whether one of the crossings lies on the plane, within the disc, where the ray is not nearly in the plane.
fn crosses_disc(crossings: &[Crossing<f32>], ray: &Ray, center: DVec3, normal: DVec3, reach: f64) -> bool {
    let (origin, direction) = (ray.origin().as_dvec3(), ray.direction().as_dvec3());
    let speed = direction.dot(normal);
    let t = (center - origin).dot(normal) / speed;
    let length = direction.length();
    let scale = origin.length() + center.length() + t.abs() * length;
    speed.abs() > 0.1 * length
        && (origin + direction * t - center).length() < 0.9 * reach
        && crossings
            .iter()
            .any(|crossing| (f64::from(crossing.t) - t).abs() * speed.abs() < 64.0 * ROUNDOFF * scale)
}

/// The spans ahead of a ray's start between crossings at these parameters.
fn spans(inside: bool, crossings: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
    let mut ends: Vec<f64> = inside.then_some(0.0).into_iter().chain(crossings).collect();
    if ends.len() % 2 == 1 {
        ends.push(f64::INFINITY);
    }
    ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect()
}

/// Whether membership differs from the exact one only within rounding of edges, and of the exact crossings. Where several solids meet in one edge each is rounded by itself, so that one may be hit in a spike that is
/// no ray's right answer.
fn differs_at_edges_only(posed: &Posed, ray: &Ray, (starts_inside, found): &(bool, Vec<Crossing<f32>>)) -> bool {
    let (inside, expected) = posed.expected(&ray.origin().into(), ray.direction());
    let exact = spans(inside, expected.iter().map(|crossing| crossing.t));
    let computed = spans(*starts_inside, found.iter().map(|crossing| f64::from(crossing.t)));
    let is_at_edge = |t: f64| {
        let point = ray.origin().as_dvec3() + ray.direction().as_dvec3() * t;
        let local = to_frame(posed.pose(), point);
        let near =
            |(shape, leaf): (&Shape, u32)| distance_to_edges(shape, local) <= 2.0 * ALLOWED * ROUNDOFF * posed.scale_at(ray, leaf, t);
        posed.shapes().iter().zip(0..).any(near)
    };
    let is_at_crossing = |t: f64| {
        let length = ray.direction().as_dvec3().length();
        let near =
            |crossing: &Expected| (t - crossing.t).abs() * length <= 4.0 * ALLOWED * ROUNDOFF * posed.scale_at(ray, crossing.leaf, t);
        expected.iter().any(near)
    };
    disagreements(&exact, &computed)
        .into_iter()
        .all(|(t, _)| t < 0.0 || is_at_edge(t) || is_at_crossing(t))
}

/// What the rays at one arrangement came to.
#[derive(Clone, Copy, Default)]
struct Tally {
    rays: usize,
    crossings: usize,
    skins: usize,
    /// Rays that were aimed at an edge or start on the face, and differ from the exact answer.
    edges: usize,
    /// Other rays that differ.
    stray: usize,
    /// Those among all these that would differ for every ray beside this one too.
    spikes: usize,
}

impl Tally {
    fn add(self, other: Self) -> Self {
        Self {
            rays: self.rays + other.rays,
            crossings: self.crossings + other.crossings,
            skins: self.skins + other.skins,
            edges: self.edges + other.edges,
            stray: self.stray + other.stray,
            spikes: self.spikes + other.spikes,
        }
    }
}

/// Casts the rays of one pose and compares every list of crossings with the exact one.
fn compare(seed: u64, kind: usize) -> Tally {
    let mut rng = Pcg64::seed_from_u64(seed * ARRANGEMENTS.len() as u64 + kind as u64);
    let arrangement = Arrangement::random(&mut rng, kind);
    let pose = random_motion(&mut rng);
    let posed = Posed::new(arrangement.tree.clone(), pose);
    let (center, normal) = to_world(&pose, arrangement.center.as_dvec3(), arrangement.normal.as_dvec3());
    let mut tally = Tally::default();
    for (aim, count) in RAYS {
        for _ in 0..count {
            let (origin, direction) = arrangement.ray(&mut rng, aim);
            let (origin, direction) = to_world(&pose, origin, direction);
            let ray = Ray::new(origin.as_vec3(), direction.as_vec3()).unwrap();
            let computed = posed.computed(ray);
            tally.rays += 1;
            tally.crossings += computed.1.len();
            if arrangement.open && crosses_disc(&computed.1, &ray, center, normal, f64::from(arrangement.reach)) {
                tally.skins += 1;
            }
            if posed.agrees(&ray, &computed, ALLOWED) {
                continue;
            }
            match aim {
                Aim::Edge | Aim::Inside => tally.edges += 1,
                _ => tally.stray += 1,
            }
            let beside = posed.agrees_with_neighbour(&ray, &computed, ALLOWED);
            tally.spikes += usize::from(!beside);
            assert!(
                beside || differs_at_edges_only(&posed, &ray, &computed),
                "{}, pose {seed}, {aim:?}: {ray:?} finds {computed:?} instead of {:?} in {:?}",
                ARRANGEMENTS[kind],
                posed.expected(&ray.origin().into(), ray.direction()),
                posed,
            );
        }
    }
    tally
}

/// All crossings of touching, stacked and subtracted solids are those of exact arithmetic: number, depth, sense and leaf. At an edge or a silhouette rounding may decide otherwise,
/// as it would for the ray next to this one.
#[test]
fn shared_faces_leave_no_skin_in_any_pose() {
    for (kind, name) in ARRANGEMENTS.iter().enumerate() {
        let tally = (0..POSES)
            .into_par_iter()
            .map(|seed| compare(seed, kind))
            .reduce(Tally::default, Tally::add);
        let Tally {
            rays,
            crossings,
            skins,
            edges,
            stray,
            spikes,
        } = tally;
        println!(
            "{name}: {rays} rays, {crossings} crossings, {skins} skins, {edges} aimed at edges and {stray} others differ, {spikes} in a spike"
        );
        assert!(
            crossings > rays,
            "{name}: the rays have lost their aim: {crossings} crossings on {rays} rays"
        );
        assert_eq!(skins, 0, "{name}");
        assert!(
            stray * 500 < rays,
            "{name}: {stray} of {rays} rays that were not aimed at an edge differ"
        );
        assert!(
            spikes * 500 < rays,
            "{name}: {spikes} of {rays} rays differ as no ray beside them would"
        );
        assert!(edges * 10 < rays, "{name}: {edges} of {rays} rays aimed at an edge differ");
    }
}

/// A solid of one leaf with a rotation baked into its numbers: a box becomes six half-spaces, each through one of its corners.
fn baked(shape: Shape, rotation: glam::Mat3, frame_origin: Vec3) -> Vec<Node> {
    let point = |local: Vec3| rotation * local + frame_origin;
    match shape {
        Shape::Cuboid { min, max } => {
            let axes = [Vec3::X, Vec3::Y, Vec3::Z];
            let faces = axes.iter().flat_map(|&axis| [(min, -axis), (max, axis)]);
            let walls = faces.map(|(corner, normal)| HalfSpace::new(point(corner), (rotation * normal).normalize()).unwrap());
            let mut nodes: Vec<Node> = walls.map(|wall| Node::leaf(Leaf::from(wall))).collect();
            nodes.extend([Node::Intersection; 5]);
            nodes
        }
        Shape::CappedCylinder { bottom, top, axis, radius } => {
            let turned = CappedCylinder::new(point(bottom), point(top), (rotation * axis).normalize(), radius).unwrap();
            vec![Node::leaf(turned.into())]
        }
        _ => unreachable!("the first five arrangements are made of boxes and cylinders"),
    }
}

/// What motions in the leaves' own numbers would do instead: the two copies of the shared plane round apart, and rays find a skin between them.
#[test]
fn rotations_baked_into_the_leaves_would_leave_skins() {
    for (kind, name) in ARRANGEMENTS.iter().enumerate().take(5) {
        let (mut rays, mut skins) = (0, 0);
        for seed in 0..POSES {
            let mut rng = Pcg64::seed_from_u64(seed);
            let arrangement = Arrangement::random(&mut rng, kind);
            let axis = unit(&mut rng).as_vec3().normalize();
            let rotation = glam::Mat3::from_axis_angle(axis, rng.random_range(-3.2..3.2));
            let origin = Vec3::new(
                tenths(&mut rng, -100, 100),
                tenths(&mut rng, -100, 100),
                tenths(&mut rng, -100, 100),
            );
            let mut nodes: Vec<Node> = arrangement
                .tree
                .shapes()
                .iter()
                .flat_map(|&shape| baked(shape, rotation, origin))
                .collect();
            nodes.push(if kind < 3 { Node::Union } else { Node::Difference });
            let program = Program::new(&nodes).unwrap();

            let exact = rotation.as_dmat3();
            let (center, normal) = (
                exact * arrangement.center.as_dvec3() + origin.as_dvec3(),
                exact * arrangement.normal.as_dvec3(),
            );
            for _ in 0..10 {
                let (from, direction) = arrangement.ray(&mut rng, Aim::Through);
                let ray = Ray::new((exact * from + origin.as_dvec3()).as_vec3(), (exact * direction).as_vec3()).unwrap();
                let mut scratch = [Span::EMPTY; 12];
                let crossings: Vec<_> = program.along(ray, &mut scratch).unwrap().crossings().collect();
                rays += 1;
                skins += usize::from(crosses_disc(&crossings, &ray, center, normal, f64::from(arrangement.reach)));
            }
        }
        println!("{name}, baked: {skins} skins on {rays} rays");
        assert!(
            skins > 0 || kind == 2,
            "{name}: without skins there would be no need for transforms"
        );
    }
}
