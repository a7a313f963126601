//! The usual solids as expressions.
//!
//! Every parameter is a number the machine holds, `f32` or `f64`, taken exactly; directions need not have unit
//! length.

use super::number::Exact;
use super::vector::ExactVec3;
use super::{Expr, Inequality};

/// How many significant bits of an irrational number are kept.
const BITS: usize = 400;

impl Expr {
    /// The points behind a plane, seen from where its normal points to.
    pub fn half_space(point: impl Into<ExactVec3>, normal: impl Into<ExactVec3>) -> Self {
        Inequality::plane(point, normal).into()
    }

    /// A ball.
    pub fn sphere(center: impl Into<ExactVec3>, radius: impl Into<Exact>) -> Self {
        Inequality::sphere(center, radius).into()
    }

    /// A cylinder that has no ends.
    pub fn cylinder(point: impl Into<ExactVec3>, axis: impl Into<ExactVec3>, radius: impl Into<Exact>) -> Self {
        Inequality::cylinder(point, axis, radius).into()
    }

    /// One half of a double cone without end: `cos ρ < sin z`, with `z` along the axis from the apex and `ρ` the
    /// distance from the axis.
    ///
    /// # Panics
    ///
    /// If the sine is not positive, as the solid would not lie on the side the axis points to; or if the cosine is
    /// negative.
    pub fn nappe(apex: impl Into<ExactVec3>, axis: impl Into<ExactVec3>, sin: impl Into<Exact>, cos: impl Into<Exact>) -> Self {
        let sin = sin.into();
        assert!(sin.sign().is_gt(), "a nappe opens along its axis");
        flared(Inequality::cone(apex, axis, Exact::ZERO, sin, cos))
    }

    /// A box with its faces across the axes of the coordinates.
    pub fn cuboid(min: impl Into<ExactVec3>, max: impl Into<ExactVec3>) -> Self {
        let (min, max) = (min.into(), max.into());
        let axes = [[1.0_f32, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(ExactVec3::from);
        let faces = axes.iter().flat_map(|axis| [capped_below(&min, axis), capped_above(&max, axis)]);
        Self::And(faces.collect())
    }

    /// A cylinder about the line through the bottom along the axis, between planes through the bottom and the top.
    ///
    /// The top need not lie on that line.
    pub fn capped_cylinder(
        bottom: impl Into<ExactVec3>,
        top: impl Into<ExactVec3>,
        axis: impl Into<ExactVec3>,
        radius: impl Into<Exact>,
    ) -> Self {
        let (bottom, top, axis) = (bottom.into(), top.into(), axis.into());
        let side = Self::cylinder(bottom.clone(), axis.clone(), radius);
        Self::And(vec![side, capped_below(&bottom, &axis), capped_above(&top, &axis)])
    }

    /// A nappe up to the plane through the base: `run ρ < rise z`, with `z` along the axis from the apex.
    ///
    /// # Panics
    ///
    /// If the rise is not positive, or the run is negative.
    pub fn cone(
        apex: impl Into<ExactVec3>,
        base: impl Into<ExactVec3>,
        axis: impl Into<ExactVec3>,
        rise: impl Into<Exact>,
        run: impl Into<Exact>,
    ) -> Self {
        let axis = axis.into();
        let plane = capped_above(&base.into(), &axis);
        Self::And(vec![Self::nappe(apex, axis, rise, run), plane])
    }

    /// A frustum: `run ρ < run radius + rise z`, with `z` along the axis from the bottom, between planes through the
    /// bottom and the top. It widens towards the top where the rise is positive, and ends at its apex if that comes
    /// before the top.
    ///
    /// # Panics
    ///
    /// If the radius or the run is negative.
    pub fn capped_cone(
        bottom: impl Into<ExactVec3>,
        top: impl Into<ExactVec3>,
        axis: impl Into<ExactVec3>,
        bottom_radius: impl Into<Exact>,
        rise: impl Into<Exact>,
        run: impl Into<Exact>,
    ) -> Self {
        let (bottom, top, axis) = (bottom.into(), top.into(), axis.into());
        let side = flared(Inequality::cone(bottom.clone(), axis.clone(), bottom_radius, rise, run));
        Self::And(vec![side, capped_below(&bottom, &axis), capped_above(&top, &axis)])
    }

    /// The points nearer than the radius to the segment between two points, which may be the same.
    pub fn capsule(a: impl Into<ExactVec3>, b: impl Into<ExactVec3>, radius: impl Into<Exact>) -> Self {
        let (a, b, radius) = (a.into(), b.into(), radius.into());
        let axis = &b - &a;
        let ends = [&a, &b].map(|end| Self::sphere(end.clone(), radius.clone()));
        let middle = Self::capped_cylinder(a, b, axis, radius);
        Self::Or(ends.into_iter().chain([middle]).collect())
    }

    /// The convex hull of two balls, neither of which holds the other: both, and the cone that touches them between
    /// the circles where it does.
    pub fn rounded_cone(a: impl Into<ExactVec3>, b: impl Into<ExactVec3>, a_radius: Exact, b_radius: Exact) -> Self {
        let (a, b) = (a.into(), b.into());
        let axis = &b - &a;
        let apart_squared = axis.length_squared();
        // The normals of the cone lean by the angle whose sine is the difference of the radii over the distance.
        let fall = &a_radius - &b_radius;
        let run = (&apart_squared - &fall.square()).sqrt(BITS);
        let circle = |center: &ExactVec3, radius: &Exact| center + &axis.times(&(radius * &fall).quotient(&apart_squared, BITS));
        let side = Self::capped_cone(
            circle(&a, &a_radius),
            circle(&b, &b_radius),
            axis.clone(),
            (&a_radius * &run).quotient(&apart_squared.sqrt(BITS), BITS),
            -fall,
            run,
        );
        Self::Or(vec![Self::sphere(a.clone(), a_radius), Self::sphere(b.clone(), b_radius), side])
    }

    /// The points nearer than the rounding, which is positive, to a rhombus with these halves of its diagonals along x
    /// and z, between heights: the rhombus, a band along each of its sides, and a cylinder about each of its corners.
    #[must_use]
    pub fn rounded_rhombus(bottom: &ExactVec3, top: &ExactVec3, half_x: f32, half_z: f32, rounding: &Exact) -> Self {
        let up = ExactVec3::from([0.0_f32, 1.0, 0.0]);
        let corners = [[half_x, 0.0, 0.0], [0.0, 0.0, half_z], [-half_x, 0.0, 0.0], [0.0, 0.0, -half_z]];
        let corners = corners.map(|corner| bottom + &ExactVec3::from(corner));
        let sides = [0, 1, 2, 3].map(|corner| (&corners[corner], &corners[(corner + 1) % 4]));
        let outward = |(from, to): (&ExactVec3, &ExactVec3)| up.cross(&(to - from));
        let rhombus = Self::And(sides.map(|side| Self::half_space(side.0.clone(), outward(side))).into());
        let bands = sides.map(|side| {
            let (normal, along) = (outward(side), side.1 - side.0);
            let reach = normal.times(&rounding.quotient(&normal.length_squared().sqrt(BITS), BITS));
            Self::And(vec![
                capped_above(&(side.0 + &reach), &normal),
                capped_below(&(side.0 - &reach), &normal),
                capped_below(side.0, &along),
                capped_above(side.1, &along),
            ])
        });
        let edges = corners
            .each_ref()
            .map(|corner| Self::cylinder(corner.clone(), up.clone(), rounding.clone()));
        let section = Self::Or(bands.into_iter().chain(edges).chain([rhombus]).collect());
        Self::And(vec![section, capped_below(bottom, &up), capped_above(top, &up)])
    }

    /// The twelve beams along the edges of a box, of a square section inward.
    #[must_use]
    pub fn box_frame(min: &ExactVec3, max: &ExactVec3, thickness: &Exact) -> Self {
        let axes = [[1.0_f32, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(ExactVec3::from);
        // At the lower face, or at the upper one, of the axis.
        let wall = |axis: &ExactVec3, upper: bool| {
            if upper {
                capped_above(max, axis).and(capped_below(&(max - &axis.times(thickness)), axis))
            } else {
                capped_below(min, axis).and(capped_above(&(min + &axis.times(thickness)), axis))
            }
        };
        let beam = |number: usize| {
            let [along, first, second] = [0, 1, 2].map(|turn| &axes[(number / 4 + turn) % 3]);
            let ends = capped_below(min, along).and(capped_above(max, along));
            Self::And(vec![ends, wall(first, number & 1 != 0), wall(second, number & 2 != 0)])
        };
        Self::Or((0..12).map(beam).collect())
    }
}

/// A cone of one nappe.
fn flared(inequalities: [Inequality; 2]) -> Expr {
    Expr::And(inequalities.map(Expr::Leaf).into())
}

/// The points that a cap keeps whose outward normal is the axis.
fn capped_above(point: &ExactVec3, axis: &ExactVec3) -> Expr {
    Expr::half_space(point.clone(), axis.clone())
}

/// The points that a cap keeps whose outward normal is opposite to the axis.
fn capped_below(point: &ExactVec3, axis: &ExactVec3) -> Expr {
    Expr::half_space(point.clone(), -axis)
}
