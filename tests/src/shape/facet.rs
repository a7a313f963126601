//! Flat pieces of surface in exact arithmetic. They hold no points, so they are looked at with a little thickness.

use super::polyhedron::{between, in_triangle};
use crate::reference::{Exact, ExactVec3, Expr};
use glam::{DVec3, Vec3};
use rand::{Rng, RngExt};

/// How many significant bits of an irrational number are kept.
const BITS: usize = 400;

/// How thick a facet is that is not grown, as a power of two of its extent: nothing that `f64` could tell.
const THIN: isize = -120;

/// A convex polygon in space, its corners in a plane up to rounding.
pub(super) struct Facet<'a>(pub(super) &'a [Vec3]);

impl Facet<'_> {
    fn corner(&self, number: usize) -> ExactVec3 {
        self.0[number % self.0.len()].into()
    }

    /// The vector across the facet, about which the corners turn to the left: that of the two diagonals, or of two
    /// sides.
    fn normal(&self) -> ExactVec3 {
        let last = self.0.len() - 1;
        let diagonal = |from: usize, to: usize| &self.corner(to) - &self.corner(from);
        diagonal(0, last - 1).cross(&diagonal(last - 2 + (last - 1) % 2, last))
    }

    /// The points before the plane through the edges' midpoints, moved by `offset` along `normal` or against it.
    fn half_space(&self, normal: &ExactVec3, offset: &Exact) -> Expr {
        let corners = (0..self.0.len()).map(|number| self.corner(number));
        let sum = corners.fold(ExactVec3::from([0.0_f32; 3]), |a, b| &a + &b);
        let middle = sum.times(&Exact::ONE.quotient(&Exact::from(self.0.len() as i32), BITS));
        Expr::half_space(moved(&middle, normal, offset), normal.clone())
    }

    /// The planes through the edges, across the facet, each moved outward by `offset`.
    fn outline(&self, offset: f64) -> Vec<Expr> {
        let normal = self.normal();
        let edge = |number: usize| {
            let (from, to) = (self.corner(number), self.corner(number + 1));
            let outward = (&to - &from).cross(&normal);
            Expr::half_space(moved(&from, &outward, &Exact::from(offset)), outward)
        };
        (0..self.0.len()).map(edge).collect()
    }

    /// The points nearer than `offset` to the plane, within the edges moved outward by as much; next to nothing where
    /// the offset is 0, and nothing where it is negative.
    pub(super) fn exact(&self, offset: f64) -> Expr {
        if offset < 0.0 {
            return Expr::Or(Vec::new());
        }
        let normal = self.normal();
        let extent = self.0.iter().map(|corner| corner.as_dvec3().length()).fold(0.0, f64::max);
        let thickness = Exact::from(offset) + Exact::from(extent).scaled(THIN);
        let mut walls = self.outline(offset);
        walls.extend([&normal, &-&normal].map(|side| self.half_space(side, &thickness)));
        Expr::And(walls)
    }

    /// The points before the plane, and those within the edges.
    pub(super) fn plane_and_outline(&self) -> (Expr, Expr) {
        (self.half_space(&self.normal(), &Exact::ZERO), Expr::And(self.outline(0.0)))
    }

    /// Whether a line goes through whatever way the facet's corners are moved by less than `offset`: within edges
    /// moved inward it is more than that before the facet, and more than that behind it.
    pub(super) fn is_pierced(&self, origin: Vec3, direction: Vec3, offset: f64) -> bool {
        let normal = self.normal();
        [&normal, &-&normal].into_iter().all(|side| {
            let mut walls = self.outline(-offset);
            walls.push(self.half_space(side, &Exact::from(-offset)));
            !Expr::And(walls).spans(origin, direction).is_empty()
        })
    }

    /// A point of the facet and a normal.
    pub(super) fn surface(&self, rng: &mut impl Rng) -> (DVec3, DVec3) {
        let last = rng.random_range(2..self.0.len());
        let triangle = [0, last - 1, last].map(|number| self.0[number].as_dvec3());
        let sign = if rng.random() { 1.0 } else { -1.0 };
        (in_triangle(rng, triangle), DVec3::from(self.normal().to_f64()).normalize() * sign)
    }

    /// A point of an edge; one in four is a corner.
    pub(super) fn edge_point(&self, rng: &mut impl Rng) -> DVec3 {
        let first = rng.random_range(0..self.0.len());
        let [from, to] = [first, first + 1].map(|number| self.0[number % self.0.len()].as_dvec3());
        between(rng, from, to)
    }

    /// The facet as triangles.
    pub(super) fn triangles(&self) -> Vec<[DVec3; 3]> {
        let triangle = |last: usize| [0, last - 1, last].map(|number| self.0[number].as_dvec3());
        (2..self.0.len()).map(triangle).collect()
    }
}

/// A point moved by a distance along a vector of any length.
fn moved(point: &ExactVec3, along: &ExactVec3, distance: &Exact) -> ExactVec3 {
    let share = distance.quotient(&along.length_squared().sqrt(BITS), BITS);
    point + &along.times(&share)
}
