//! The same solids in exact arithmetic.

use super::Shape;
use crate::reference::{Exact, ExactVec3, Expr};
use glam::Vec3;

impl Shape {
    /// The same solid in exact arithmetic, with its surface moved outward by `offset` (inward where negative).
    ///
    /// Edges and tips stay sharp: every face moves by itself.
    #[must_use]
    pub fn exact(&self, offset: f64) -> Expr {
        let grown = |radius: f32| Exact::from(radius) + Exact::from(offset);
        let moved = |point: Vec3, axis: Vec3, by: &Exact| &ExactVec3::from(point) + &ExactVec3::from(axis).times(by);
        let (out, back) = (Exact::from(offset), Exact::from(-offset));
        // How far a cone's tip moves along its axis when its side moves by the offset: offset √(s² + k²) / s.
        let tip_shift = |rise: &Exact, run: &Exact| {
            let slant = (rise.square() + run.square()).sqrt(200);
            -(&Exact::from(offset) * &slant).quotient(rise, 200)
        };
        let height = |from: Vec3, to: Vec3, axis: Vec3| (&ExactVec3::from(to) - &ExactVec3::from(from)).dot(&axis.into());
        let nothing = || Expr::Or(Vec::new());
        if let Some(polyhedron) = self.polyhedron() {
            return polyhedron.exact(offset);
        }
        if let Some(facet) = self.facet() {
            return facet.exact(offset);
        }
        let sizes = self.sizes();
        if sizes.iter().any(|&size| f64::from(size) + offset <= 0.0) {
            return nothing();
        }
        match *self {
            Self::HalfSpace { point, normal } => Expr::half_space(moved(point, normal, &out), normal),
            Self::Sphere { center, radius } => Expr::sphere(center, grown(radius)),
            Self::Cylinder { point, axis, radius } => Expr::cylinder(point, axis, grown(radius)),
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => {
                let (rise, run) = (Exact::from(radius), Exact::from(height));
                Expr::nappe(moved(apex, axis, &tip_shift(&rise, &run)), axis, rise, run)
            }
            Self::Cuboid { min, max } => Expr::cuboid(moved(min, Vec3::ONE, &back), moved(max, Vec3::ONE, &out)),
            Self::CappedCylinder { bottom, top, axis, radius } => {
                Expr::capped_cylinder(moved(bottom, axis, &back), moved(top, axis, &out), axis, grown(radius))
            }
            Self::Cone { apex, base, axis, radius } => {
                let (rise, run) = (Exact::from(radius), height(apex, base, axis));
                let tip = moved(apex, axis, &tip_shift(&rise, &run));
                Expr::cone(tip, moved(base, axis, &out), axis, rise, run)
            }
            Self::CappedCone {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
            } => {
                let rise = Exact::from(top_radius) - Exact::from(bottom_radius);
                let run = height(bottom, top, axis);
                let slant = (rise.square() + run.square()).sqrt(200);
                // The side moves by the offset, and the bottom, where its radius is measured, too.
                let widened = Exact::from(bottom_radius) + (&Exact::from(offset) * &(&slant - &rise)).quotient(&run, 200);
                if widened.sign().is_lt() {
                    return nothing();
                }
                Expr::capped_cone(moved(bottom, axis, &back), moved(top, axis, &out), axis, widened, rise, run)
            }
            Self::Capsule { a, b, radius } => Expr::capsule(a, b, grown(radius)),
            Self::Rhombus { rounding, .. } if f64::from(rounding) + offset <= 0.0 => nothing(),
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } => {
                let (bottom, top) = (moved(bottom, Vec3::Y, &back), moved(bottom.with_y(top), Vec3::Y, &out));
                Expr::rounded_rhombus(&bottom, &top, half_x, half_z, &grown(rounding))
            }
            Self::RoundedCone { a, b, a_radius, b_radius } => Expr::rounded_cone(a, b, grown(a_radius), grown(b_radius)),
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let (rise, run) = (Exact::from(radius), Exact::from(height));
                let tip = moved(apex, axis, &tip_shift(&rise, &run));
                Expr::sphere(apex, grown(reach)).and(Expr::nappe(tip, axis, rise, run))
            }
            Self::HexagonalPrism { .. }
            | Self::TriangularPrism { .. }
            | Self::Octahedron { .. }
            | Self::Pyramid { .. }
            | Self::Triangle { .. }
            | Self::Quad { .. } => unreachable!("taken for a polyhedron or a facet above"),
        }
    }
}
