//! The usual solids as expressions.
//!
//! Every parameter is a number the machine holds, `f32` or `f64`, taken exactly; directions need not have unit
//! length.

use super::number::Exact;
use super::vector::ExactVec3;
use super::{Expr, Inequality};

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
