//! Solids with flat faces, by their corners: the planes of the faces follow from these in exact arithmetic.

use crate::reference::{Exact, ExactVec3, Expr};
use glam::{DVec3, Vec3};
use rand::{Rng, RngExt};

/// How many significant bits of an irrational number are kept.
const BITS: usize = 400;

/// A convex solid: its corners, and for each face the corners around it.
pub(super) struct Polyhedron {
    corners: Vec<ExactVec3>,
    faces: Vec<Vec<usize>>,
}

/// The point of these coordinates from an origin.
fn from(origin: Vec3, [x, y, z]: [Exact; 3]) -> ExactVec3 {
    &ExactVec3::from(origin) + &ExactVec3::from([x, y, z])
}

/// `√3`.
fn root_three() -> Exact {
    Exact::from(3).sqrt(BITS)
}

impl Polyhedron {
    /// A prism over a polygon, given by its corners (x, z) from the middle, one after the other.
    fn prism(bottom: Vec3, top: f32, outline: &[[Exact; 2]]) -> Self {
        let count = outline.len();
        let at = |y: Exact| {
            outline
                .iter()
                .map(move |[x, z]| from(bottom.with_y(0.0), [x.clone(), y.clone(), z.clone()]))
        };
        let corners = at(bottom.y.into()).chain(at(top.into())).collect();
        let sides = (0..count).map(|corner| {
            let next = (corner + 1) % count;
            vec![corner, next, next + count, corner + count]
        });
        let caps = [(0..count).collect(), (count..2 * count).collect()];
        Self {
            corners,
            faces: sides.chain(caps).collect(),
        }
    }

    /// The box between two corners.
    pub(super) fn cuboid(min: Vec3, max: Vec3) -> Self {
        let [x, z] = [(min.x, max.x), (min.z, max.z)].map(|(low, high)| Exact::from(high) - Exact::from(low));
        let none = Exact::ZERO;
        let outline = vec![[none.clone(), none.clone()], [none.clone(), z.clone()], [x.clone(), z], [x, none]];
        Self::prism(min, max.y, &outline)
    }

    /// A prism over the regular hexagon with two sides across x, each so far from the middle.
    pub(super) fn hexagonal_prism(bottom: Vec3, top: f32, apothem: f32) -> Self {
        let near = Exact::from(apothem).quotient(&root_three(), BITS);
        let (wide, far) = (Exact::from(apothem), near.scaled(1));
        let none = Exact::ZERO;
        let outline = vec![
            [wide.clone(), near.clone()],
            [none.clone(), far.clone()],
            [-&wide, near.clone()],
            [-&wide, -&near],
            [none, -far],
            [wide, -near],
        ];
        Self::prism(bottom, top, &outline)
    }

    /// A prism over the regular triangle with one side across z, below the middle, and a corner above.
    pub(super) fn triangular_prism(bottom: Vec3, top: f32, inradius: f32) -> Self {
        let inradius = Exact::from(inradius);
        let half = &inradius * &root_three();
        let outline = vec![[Exact::ZERO, inradius.scaled(1)], [-&half, -&inradius], [half, -inradius]];
        Self::prism(bottom, top, &outline)
    }

    /// A prism over the rhombus with these halves of its diagonals.
    pub(super) fn rhombus(bottom: Vec3, top: f32, half_x: f32, half_z: f32) -> Self {
        let (x, z) = (Exact::from(half_x), Exact::from(half_z));
        let none = Exact::ZERO;
        let outline = vec![[x.clone(), none.clone()], [none.clone(), z.clone()], [-x, none.clone()], [none, -z]];
        Self::prism(bottom, top, &outline)
    }

    /// The octahedron with its corners on the axes of its centre, so far away.
    pub(super) fn octahedron(center: Vec3, radius: f32) -> Self {
        let corner = |axis: usize, reach: Exact| {
            let mut at = [Exact::ZERO, Exact::ZERO, Exact::ZERO];
            at[axis] = reach;
            from(center, at)
        };
        let corners = (0..3).flat_map(|axis| [corner(axis, radius.into()), corner(axis, (-radius).into())]);
        let faces = (0..8_usize).map(|octant| (0..3).map(|axis| 2 * axis + (octant >> axis & 1)).collect());
        Self {
            corners: corners.collect(),
            faces: faces.collect(),
        }
    }

    /// The pyramid over a square around `base`, with its apex above.
    pub(super) fn pyramid(base: Vec3, half_width: f32, height: f32) -> Self {
        let half = Exact::from(half_width);
        let corner = |x: i32, z: i32| from(base, [&half * &x.into(), Exact::ZERO, &half * &z.into()]);
        let apex = from(base, [Exact::ZERO, height.into(), Exact::ZERO]);
        let sides = (0..4).map(|side| vec![side, (side + 1) % 4, 4]);
        Self {
            corners: vec![corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1), apex],
            faces: sides.chain([vec![0, 1, 2, 3]]).collect(),
        }
    }

    /// The vector from the first corner of a face outward, across the face.
    fn outward(&self, face: &[usize]) -> ExactVec3 {
        let [first, second, third] = [0, 1, 2].map(|number| &self.corners[face[number]]);
        let normal = (second - first).cross(&(third - first));
        // All corners are behind the face, so those not on it tell which side that is.
        let inward = self
            .corners
            .iter()
            .map(|corner| (corner - first).dot(&normal))
            .fold(Exact::ZERO, |a, b| a + b);
        if inward.sign().is_gt() { -&normal } else { normal }
    }

    /// The points behind all faces, each moved outward by `offset`.
    pub(super) fn exact(&self, offset: f64) -> Expr {
        let behind = |face: &Vec<usize>| {
            let normal = self.outward(face);
            let share = Exact::from(offset).quotient(&normal.length_squared().sqrt(BITS), BITS);
            Expr::half_space(&self.corners[face[0]] + &normal.times(&share), normal)
        };
        Expr::And(self.faces.iter().map(behind).collect())
    }

    fn corner(&self, number: usize) -> DVec3 {
        self.corners[number].to_f64().into()
    }

    /// The faces, as triangles.
    pub(super) fn triangles(&self) -> Vec<[DVec3; 3]> {
        let fan = |face: &Vec<usize>| {
            let corners: Vec<_> = face.iter().map(|&number| self.corner(number)).collect();
            let triangles = (2..corners.len()).map(|last| [corners[0], corners[last - 1], corners[last]]);
            triangles.collect::<Vec<_>>()
        };
        self.faces.iter().flat_map(fan).collect()
    }

    /// A point of a face and the outward normal there.
    pub(super) fn surface(&self, rng: &mut impl Rng) -> (DVec3, DVec3) {
        let face = &self.faces[rng.random_range(0..self.faces.len())];
        let last = rng.random_range(2..face.len());
        let triangle = [0, last - 1, last].map(|number| self.corner(face[number]));
        (in_triangle(rng, triangle), DVec3::from(self.outward(face).to_f64()).normalize())
    }

    /// A point of an edge; one in four is a corner.
    pub(super) fn edge_point(&self, rng: &mut impl Rng) -> DVec3 {
        let face = &self.faces[rng.random_range(0..self.faces.len())];
        let first = rng.random_range(0..face.len());
        let [from, to] = [first, (first + 1) % face.len()].map(|number| self.corner(face[number]));
        between(rng, from, to)
    }
}

/// A point between two others; one in four is the first of them.
pub(super) fn between(rng: &mut impl Rng, from: DVec3, to: DVec3) -> DVec3 {
    if rng.random_range(0..4) == 0 {
        from
    } else {
        from.lerp(to, rng.random_range(0.0..1.0))
    }
}

/// A point of a triangle, evenly distributed.
pub(super) fn in_triangle(rng: &mut impl Rng, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (u, v): (f64, f64) = (rng.random_range(0.0..1.0), rng.random_range(0.0..1.0));
    let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
    a + (b - a) * u + (c - a) * v
}
