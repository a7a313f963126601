//! The membership functions: what it means, in space, to be inside a primitive surface.
//!
//! Nothing here knows of rays. Each function is a polynomial in the coordinates of the point, of degree at most two
//! and negative inside, written down from the definition of its surface.

use super::number::Exact;
use super::vector::ExactVec3;

/// How many significant bits of the length of an axis are computed, where it has no end.
///
/// Only the sides of cones whose radius is not measured from the apex need a length at all, and where it is a binary
/// number, as for the axis of a coordinate, it is exact.
const LENGTH_BITS: usize = 640;

/// A strict inequality between polynomials in the coordinates of a point.
///
/// Parameters are exact, and no direction needs to have unit length.
#[derive(Clone, Debug)]
pub struct Inequality(Form);

#[derive(Clone, Debug)]
enum Form {
    /// `(x - point)·normal < 0`
    Plane { point: ExactVec3, normal: ExactVec3 },
    /// `|x - center|² < radius²`
    Sphere { center: ExactVec3, radius_squared: Exact },
    /// `|x - point|² |axis|² - ((x - point)·axis)² < radius² |axis|²`
    Cylinder {
        point: ExactVec3,
        axis: ExactVec3,
        axis_squared: Exact,
        scaled_radius_squared: Exact,
    },
    /// `slope.1² (|x - point|² |axis|² - ((x - point)·axis)²) < width(x)²`
    Cone {
        cone: Cone,
        axis_squared: Exact,
        run_squared: Exact,
    },
    /// `0 < width(x)`
    ConeWidth { cone: Cone },
}

/// A cone that opens along its axis, with all lengths multiplied by that of the axis.
#[derive(Clone, Debug)]
struct Cone {
    point: ExactVec3,
    axis: ExactVec3,
    rise: Exact,
    /// `run · radius · |axis|`
    offset: Exact,
    /// The square of the offset, which needs no root and hence is exact.
    offset_squared: Exact,
}

impl Cone {
    /// The distance from the axis at which the surface lies, multiplied by the run and by the length of the axis.
    /// Negative beyond the apex, where the equation of the surface has a mirror image that does not belong to the
    /// cone.
    fn width(&self, from_point: &ExactVec3) -> Exact {
        &self.offset + &(&self.rise * &from_point.dot(&self.axis))
    }

    /// The square of the width, multiplied out so that a rounded offset plays no part where nothing rises: a line
    /// that lies within such a side is outside, and not inside by a rounding error.
    fn width_squared(&self, from_point: &ExactVec3) -> Exact {
        let growth = &self.rise * &from_point.dot(&self.axis);
        &(&self.offset_squared + &(&self.offset * &growth).scaled(1)) + &growth.square()
    }
}

impl Inequality {
    /// The points behind a plane: `(x - point)·normal < 0`.
    pub fn plane(point: impl Into<ExactVec3>, normal: impl Into<ExactVec3>) -> Self {
        Self(Form::Plane {
            point: point.into(),
            normal: normal.into(),
        })
    }

    /// The points nearer to the center than the radius.
    pub fn sphere(center: impl Into<ExactVec3>, radius: impl Into<Exact>) -> Self {
        Self(Form::Sphere {
            center: center.into(),
            radius_squared: radius.into().square(),
        })
    }

    /// The points nearer than the radius to the line through a point along an axis.
    ///
    /// An axis of no length has no line, and then no point is inside.
    pub fn cylinder(point: impl Into<ExactVec3>, axis: impl Into<ExactVec3>, radius: impl Into<Exact>) -> Self {
        let axis = axis.into();
        let axis_squared = axis.length_squared();
        let scaled_radius_squared = &radius.into().square() * &axis_squared;
        Self(Form::Cylinder {
            point: point.into(),
            axis,
            axis_squared,
            scaled_radius_squared,
        })
    }

    /// The two inequalities which both hold inside a cone, and nowhere else.
    ///
    /// With `z` the distance from the point along the axis and `ρ` the distance from it, that is where `run ρ < run
    /// radius + rise z`. The first inequality is the square of it; the second excludes the mirror image beyond the
    /// apex, where the right side is negative.
    ///
    /// `z` is a distance whatever the length of the axis. That length enters only if the radius is not zero, and is
    /// then computed to 640 bits where it has no exact binary form. Such a side is right but for 2⁻⁶⁴⁰ of its size.
    ///
    /// # Panics
    ///
    /// If the run or the radius is negative.
    pub fn cone(
        point: impl Into<ExactVec3>,
        axis: impl Into<ExactVec3>,
        radius: impl Into<Exact>,
        rise: impl Into<Exact>,
        run: impl Into<Exact>,
    ) -> [Self; 2] {
        let (axis, radius, run) = (axis.into(), radius.into(), run.into());
        assert!(
            run.sign().is_ge(),
            "squaring forgets the sign of the run, so it must not be negative"
        );
        assert!(radius.sign().is_ge(), "a radius must not be negative");
        let axis_squared = axis.length_squared();
        let scaled_radius = &run * &radius;
        let offset = if radius.is_zero() {
            Exact::ZERO
        } else {
            &scaled_radius * &axis_squared.sqrt(LENGTH_BITS)
        };
        let offset_squared = &scaled_radius.square() * &axis_squared;
        let cone = Cone {
            point: point.into(),
            axis,
            rise: rise.into(),
            offset,
            offset_squared,
        };
        let within = Form::Cone {
            cone: cone.clone(),
            axis_squared,
            run_squared: run.square(),
        };
        [Self(within), Self(Form::ConeWidth { cone })]
    }

    /// The membership function at a point: negative inside, zero on the surface.
    #[must_use]
    pub fn value(&self, x: &ExactVec3) -> Exact {
        match &self.0 {
            Form::Plane { point, normal } => (x - point).dot(normal),
            Form::Sphere { center, radius_squared } => &(x - center).length_squared() - radius_squared,
            Form::Cylinder {
                point,
                axis,
                axis_squared,
                scaled_radius_squared,
            } => &distance_from_axis_squared(&(x - point), axis, axis_squared) - scaled_radius_squared,
            Form::Cone {
                cone,
                axis_squared,
                run_squared,
            } => {
                let from_point = x - &cone.point;
                let distance_squared = distance_from_axis_squared(&from_point, &cone.axis, axis_squared);
                &(run_squared * &distance_squared) - &cone.width_squared(&from_point)
            }
            Form::ConeWidth { cone } => -cone.width(&(x - &cone.point)),
        }
    }

    /// Whether the point is inside. A point on the surface is not.
    #[must_use]
    pub fn contains(&self, x: &ExactVec3) -> bool {
        self.value(x).sign().is_lt()
    }
}

/// The square of the distance from the axis, by Pythagoras, multiplied by the square of the length of the axis.
fn distance_from_axis_squared(from_point: &ExactVec3, axis: &ExactVec3, axis_squared: &Exact) -> Exact {
    &(&from_point.length_squared() * axis_squared) - &from_point.dot(axis).square()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(inequality: &Inequality, point: [f32; 3]) -> f64 {
        inequality.value(&point.into()).to_f64()
    }

    #[test]
    fn values_by_hand() {
        let plane = Inequality::plane([0.0, 0.0, 1.0_f32], [0.0, 0.0, 2.0_f32]);
        assert_eq!(value(&plane, [5.0, 6.0, 4.0]), 6.0);
        assert_eq!(value(&plane, [5.0, 6.0, 1.0]), 0.0);

        let sphere = Inequality::sphere([1.0, 2.0, 3.0_f64], 3.0_f64);
        assert_eq!(value(&sphere, [2.0, 4.0, 5.0]), 0.0);
        assert_eq!(value(&sphere, [1.0, 2.0, 3.0]), -9.0);

        // Twice the unit axis: everything is four times as large, and its sign is what it was.
        let cylinder = Inequality::cylinder([1.0, 0.0, 7.0_f32], [0.0, 0.0, 2.0_f32], 5.0_f32);
        assert_eq!(value(&cylinder, [4.0, 4.0, -9.0]), 0.0);
        assert_eq!(value(&cylinder, [1.0, 0.0, 100.0]), -100.0);
        assert_eq!(value(&cylinder, [11.0, 0.0, 0.0]), 300.0);
    }

    #[test]
    fn a_cone_measures_along_an_axis_of_any_length() {
        // Radius 2 at z = 0, growing by 3/4 per unit of z, so 5 at z = 4 and nothing at z = -8/3.
        for length in [1.0_f32, 2.0, 0.125] {
            let [within, width] = Inequality::cone([0.0_f32; 3], [0.0, length, 0.0], 2.0_f32, 3.0_f32, 4.0_f32);
            assert_eq!(value(&within, [3.0, 4.0, 4.0]), 0.0);
            assert!(value(&within, [3.0, 4.0, 3.999]) < 0.0 && value(&within, [3.0, 4.0, 4.001]) > 0.0);
            assert!(value(&width, [0.0, -2.6, 0.0]) < 0.0 && value(&width, [0.0, -2.7, 0.0]) > 0.0);
            // The mirror image satisfies the squared inequality, and only that.
            assert!(value(&within, [0.0, -9.0, 0.0]) < 0.0);
        }
    }
}
