//! Surfaces made of facets: what goes through one is seen to do so, also at the edges and corners of its triangles.

use glam::{DVec3, Vec3, vec3};
use gsdf_nostd::{Crossing, Node, Program, Quad, Ray, Solid, Span, Triangle};
use gsdf_tests::shape::{across, log_uniform, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// A closed surface around a point inside, of triangles that share their corners bit for bit.
struct Mesh {
    triangles: Vec<[Vec3; 3]>,
    nodes: Vec<Node>,
    center: DVec3,
    size: f64,
}

impl Mesh {
    fn new(triangles: Vec<[Vec3; 3]>, center: DVec3, size: f64) -> Self {
        let mut nodes = Vec::new();
        for &[a, b, c] in &triangles {
            nodes.push(Node::leaf(Triangle::new(a, b, c).unwrap().into()));
            if nodes.len() > 1 {
                nodes.push(Node::Union);
            }
        }
        Self {
            triangles,
            nodes,
            center,
            size,
        }
    }

    /// A tetrahedron of random corners, each towards one of four directions that surround the middle.
    fn tetrahedron(rng: &mut Pcg64) -> Self {
        let size = log_uniform(rng, 1e-1, 1e2);
        let center = unit(rng) * size * rng.random_range(0.0..4.0);
        let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
        let corners = corners.map(|corner| (center + (DVec3::from(corner) + unit(rng) * 0.3) * size).as_vec3());
        let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
        // Each face begins at a random one of its corners, and turns either way.
        let faces = faces.map(|face| {
            let (first, turn) = (rng.random_range(0..3), rng.random_range(1..3));
            [0, 1, 2].map(|step| corners[face[(first + step * turn) % 3]])
        });
        Self::new(faces.into(), center, size)
    }

    /// A ball of eighty triangles.
    fn ball(rng: &mut Pcg64) -> Self {
        let size = log_uniform(rng, 1e-1, 1e2);
        let center = (unit(rng) * size * rng.random_range(0.0..4.0)).as_vec3();
        let golden = f32::midpoint(1.0, 5.0_f32.sqrt());
        let corner = |number: usize| {
            let (a, b) = ([1.0, -1.0][number & 1], golden * [1.0, -1.0][number >> 1 & 1]);
            [vec3(0.0, a, b), vec3(a, b, 0.0), vec3(b, 0.0, a)][number >> 2].normalize()
        };
        let corners: Vec<Vec3> = (0..12).map(corner).collect();
        let near = |a: usize, b: usize| corners[a].distance(corners[b]) < 1.2;
        let mut triangles = Vec::new();
        let at = |direction: Vec3| center + direction.normalize() * size as f32;
        for a in 0..12 {
            for b in a + 1..12 {
                for c in b + 1..12 {
                    if near(a, b) && near(b, c) && near(a, c) {
                        let [a, b, c] = [a, b, c].map(|number| corners[number]);
                        let [ab, bc, ca] = [a + b, b + c, c + a];
                        triangles.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].map(|corners| corners.map(at)));
                    }
                }
            }
        }
        assert_eq!(triangles.len(), 80);
        Self::new(triangles, center.as_dvec3(), size)
    }

    /// A corner, a point of an edge, or a point very near to one.
    fn target(&self, rng: &mut Pcg64) -> DVec3 {
        let corners = self.triangles[rng.random_range(0..self.triangles.len())].map(Vec3::as_dvec3);
        let along = corners[0].lerp(corners[1], rng.random_range(0.0..1.0));
        match rng.random_range(0..4) {
            0 => corners[0],
            1 => along,
            2 => corners[0].midpoint(corners[1]),
            _ => along + unit(rng) * self.size * log_uniform(rng, 1e-9, 1e-2),
        }
    }

    fn crossings(&self, ray: Ray) -> Vec<Crossing<f32>> {
        let mut scratch = [Span::EMPTY; 80];
        let program = Program::new(&self.nodes).unwrap();
        program.along(ray, &mut scratch).unwrap().crossings().collect()
    }
}

/// How near two crossings are that are one, as a share of a mesh's size: far less than any ray here spends inside.
const SAME_PLACE: f64 = 1e-4;

fn check(meshes: u64, rays: usize, mesh: fn(&mut Pcg64) -> Mesh) {
    let outcomes = (0..meshes).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mesh = mesh(&mut rng);
        for number in 0..rays {
            let target = mesh.target(&mut rng);
            let within = mesh.center + unit(&mut rng) * mesh.size * rng.random_range(0.0..0.2);
            let outward = number % 2 == 0;
            // From within the ray must leave once. From outside, on the far side of the target, it must enter and leave.
            let (origin, expected) = if outward {
                (within, 1)
            } else {
                (target + (target - within) * rng.random_range(0.5..10.0), 2)
            };
            let origin = origin.as_vec3();
            let toward = (target - origin.as_dvec3()).as_vec3();
            let crossings = mesh.crossings(Ray::new(origin, toward).unwrap());
            let mut places: Vec<f32> = (crossings.iter().filter(|crossing| crossing.entering))
                .map(|crossing| crossing.t)
                .collect();
            // At an edge the facets on both sides are met, which may be by rounding one after the other.
            let length = f64::from(toward.length());
            places.dedup_by(|next, last| f64::from(*next - *last) * length < SAME_PLACE * mesh.size);
            assert_eq!(
                places.len(),
                expected,
                "seed {seed}: from {origin} along {toward} at {target}: {crossings:?} of {:?}",
                mesh.triangles
            );
        }
    });
    outcomes.collect::<Vec<()>>();
}

#[test]
fn a_tetrahedron_is_met_once_on_the_way_in_and_once_on_the_way_out() {
    check(2_000, 50, Mesh::tetrahedron);
}

#[test]
fn a_ball_of_triangles_is_met_once_on_the_way_in_and_once_on_the_way_out() {
    check(200, 200, Mesh::ball);
}

/// Whichever way a facet is wound, and from whichever side it is looked at, its normal is turned to the ray.
#[test]
fn normals_are_turned_to_the_ray() {
    let mut rng = Pcg64::seed_from_u64(1);
    for _ in 0..20_000 {
        let point = (unit(&mut rng) * 3.0).as_vec3();
        let first = unit(&mut rng);
        let (first, second) = (first.as_vec3(), across(&mut rng, first).as_vec3());
        let corners = [point, point + first, point + first + second, point + second];
        let node = if rng.random() {
            Node::leaf(Triangle::new(corners[0], corners[1], corners[2]).unwrap().into())
        } else {
            Node::leaf(Quad::new(corners[0], corners[1], corners[2], corners[3]).unwrap().into())
        };
        let target = point + first * 0.6 + second * 0.3;
        let away = unit(&mut rng).as_vec3();
        if away.dot(first.cross(second)).abs() < 0.01 {
            continue;
        }
        let nodes: [Node; 1] = [node];
        let mut scratch = [Span::EMPTY; 1];
        let ray = Ray::new(target + away * 2.0, -away).unwrap();
        let hit = Program::new(&nodes).unwrap().along(ray, &mut scratch).unwrap().cast().unwrap();
        assert!(
            (hit.t - 2.0).abs() < 1e-4 && hit.entering && hit.normal.dot(away) > 0.0,
            "{hit:?} of {corners:?}"
        );
        assert!(
            (hit.normal.length() - 1.0).abs() < 1e-6 && hit.normal.cross(first.cross(second)).length() < 1e-5,
            "{hit:?}"
        );
    }
}

/// The distance to a facet is never negative, and zero on it up to rounding.
#[test]
fn a_facet_has_no_inside() {
    let mut rng = Pcg64::seed_from_u64(2);
    let triangle = Triangle::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap();
    for _ in 0..10_000 {
        let (u, v): (f32, f32) = (rng.random_range(0.0..0.5), rng.random_range(0.0..0.5));
        let height = rng.random_range(-2.0_f32..2.0);
        assert_eq!(triangle.sdf(vec3(u, v, height)), height.abs());
    }
}
