//! The infinite double cone.

use super::readings;
use crate::csg::{Csg, Node};
use crate::invalid::{Invalid, length, point, unit};
use crate::leaf::{Bounds, Leaf, Nappe, Solid};
use crate::real::Real;
use crate::vec3::V3;
use glam::Vec3;

/// Both nappes of an infinite cone: the points whose direction from `apex` makes less than the half-angle with `axis`
/// or with its opposite.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/double_cone.md"))]
///
/// - Standard: the lesser of the two nappes' distances, exact on both sides: whatever is nearest lies on the point's own
///   side of the apex.
/// - Along a ray: that of the [program](Self::program), a union of two [nappes](Nappe).
/// - Accuracy: that of [`Nappe`]. Cost: two of them and a union.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleCone {
    nappes: [Nappe; 2],
}

readings!(DoubleCone of 3 nodes);

impl DoubleCone {
    /// The double cone around `apex` along the unit vector `axis` that has `radius` at the distance `height` from the
    /// apex.
    ///
    /// Radius and height are a slope, not an angle: an angle near 0 or 90 degrees would lose it.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `axis` is not of unit length, or the radius or the height is
    /// not from 2^-20 to 2^30, or one is more than 2^20 times the other.
    pub const fn new(apex: Vec3, axis: Vec3, radius: f32, height: f32) -> Result<Self, Invalid> {
        match (
            point("double cone apex", apex),
            unit("double cone axis", axis),
            length("double cone radius", radius),
            length("double cone height", height),
        ) {
            (Ok(_), Ok(_), Ok(_), Ok(_)) => {}
            (Err(error), ..) | (_, Err(error), ..) | (_, _, Err(error), _) | (.., Err(error)) => return Err(error),
        }
        let opposite = Vec3::new(-axis.x, -axis.y, -axis.z);
        match (Nappe::new(apex, axis, radius, height), Nappe::new(apex, opposite, radius, height)) {
            (Ok(along), Ok(against)) => Ok(Self { nappes: [along, against] }),
            // All but the slope was looked at above.
            (Err(error), _) | (_, Err(error)) => Err(Invalid::new("double cone radius : height", error.found(), error.fault())),
        }
    }

    /// The point in which the nappes meet.
    #[must_use]
    pub const fn apex(&self) -> Vec3 {
        self.nappes[0].apex()
    }

    /// The direction in which the first nappe opens.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.nappes[0].axis()
    }

    /// The tangent of the half-angle.
    #[must_use]
    pub const fn slope(&self) -> f32 {
        self.nappes[0].slope()
    }

    /// The double cone as a program: leaf 0 is the nappe along the axis, 1 the one against it.
    #[must_use]
    pub const fn program(&self) -> Csg<{ Self::NODES }> {
        let [along, against] = self.nappes;
        Csg::from_binary([Node::leaf(Leaf::Nappe(along)), Node::leaf(Leaf::Nappe(against)), Node::Union])
    }

    /// The standard signed distance from `p`, in any arithmetic.
    #[inline(always)]
    pub fn distance<T: Real>(&self, p: V3<T>) -> T {
        self.nappes[0].distance(p).min(self.nappes[1].distance(p))
    }

    /// None: it is unbounded.
    #[must_use]
    pub const fn bounds(&self) -> Option<Bounds> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::DoubleCone;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let glass = DoubleCone::new(vec3(0.0, 1.0, 0.0), Vec3::Y, 3.0, 4.0).unwrap();
        for up in [-1.0, 1.0] {
            assert!((glass.sdf(vec3(0.0, 1.0 + 5.0 * up, 0.0)) + 3.0).abs() < 1e-6);
            assert!((glass.sdf(vec3(3.0 + 0.8, 1.0 + up * (4.0 - 0.6), 0.0)) - 1.0).abs() < 1e-6);
            assert_eq!(glass.gsdf(vec3(9.0, 1.0 + 4.0 * up, 0.0), Vec3::NEG_X), 6.0);
            assert_eq!(glass.gsdf(vec3(0.0, 1.0 + 4.0 * up, 0.0), Vec3::NEG_X), -3.0);
        }
        // Between the nappes; a steep ray goes out of the one and into the other.
        assert_eq!(glass.gsdf(vec3(9.0, 1.0, 0.0), Vec3::NEG_Z), f32::INFINITY);
        assert!((glass.gsdf(vec3(1.5, 9.0, 0.0), Vec3::NEG_Y) + 6.0).abs() < 1e-6);
        assert!((glass.gsdf(vec3(1.5, 1.5, 0.0), Vec3::NEG_Y) - 2.5).abs() < 1e-6);
    }
}
