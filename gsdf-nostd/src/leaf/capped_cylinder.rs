//! The finite cylinder.

use super::cylinder::{Cylinder, SeenSide};
use super::plane;
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, axis_between, ends, length};
use crate::range::max_norm;
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The cylinder between two caps: the points nearer to an axis than `radius`, between the planes through `bottom` and
/// `top` across it.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/capped_cylinder.md"))]
///
/// It stores both caps as positions, so that a cap shared with a neighbour is one and the same plane, to the bit.
///
/// - Standard: with `x = |(p - c) x a| - r` and `y` the height over the nearer cap, `|max((x, y), 0)| + min(max(x,
///   y), 0)`, exact. Source: I. Quilez, Distance functions.
/// - Along a ray: the side's span and the slab's, intersected. (The paper takes the maximum of three distances, which
///   lacks the test whether the spans overlap.)
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: that of a [`Cylinder`] and one
///   division.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CappedCylinder {
    side: Cylinder,
    top: Vec3,
}

const NAMES: [&str; 3] = ["capped cylinder bottom", "capped cylinder top", "capped cylinder axis"];

/// A [`CappedCylinder`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenCappedCylinder<T> {
    side: SeenSide<T>,
    /// Height over the bottom, along the axis.
    over_bottom: T,
    /// Height over the top, along the axis.
    over_top: T,
}

impl CappedCylinder {
    /// The cylinder of `radius` from `bottom` to `top`, the unit vector from the one towards the other being `axis`.
    ///
    /// The axis is a parameter of its own so that this can be `const`, and so that cylinders in a row can share it
    /// exactly; [`between`](Self::between) computes it.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `axis` is not of unit length or does not lead from `bottom`
    /// to `top`, these are nearer than 2^-20, or the radius is not from 2^-20 to 2^30.
    pub const fn new(bottom: Vec3, top: Vec3, axis: Vec3, radius: f32) -> Result<Self, Invalid> {
        match (ends(NAMES, bottom, top, axis), length("capped cylinder radius", radius)) {
            (Ok(()), Ok(radius)) => Ok(Self {
                side: Cylinder::from_valid(bottom, axis, radius),
                top,
            }),
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// The cylinder of `radius` from `bottom` to `top`; not `const`, because the axis takes a square root.
    ///
    /// # Errors
    /// As for [`new`](Self::new).
    pub fn between(bottom: Vec3, top: Vec3, radius: f32) -> Result<Self, Invalid> {
        Self::new(bottom, top, axis_between(NAMES, bottom, top)?, radius)
    }

    /// The centre of the cap the axis leads away from.
    #[must_use]
    pub const fn bottom(&self) -> Vec3 {
        self.side.point()
    }

    /// The centre of the cap the axis leads to.
    #[must_use]
    pub const fn top(&self) -> Vec3 {
        self.top
    }

    /// The side, as the infinite cylinder it is part of.
    #[must_use]
    pub const fn side(&self) -> Cylinder {
        self.side
    }
}

impl Solid for CappedCylinder {
    type Seen<T: Real> = SeenCappedCylinder<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let like = p.x;
        let zero = like.splat_like(0.0);
        let axis = V3::splat(like, self.side.axis());
        let across = self.side.distance(p);
        let below = (V3::splat(like, self.bottom()) - p).dot(axis);
        let above = (p - V3::splat(like, self.top)).dot(axis);
        let along = below.max(above);
        let outside = (across.max(zero).squared() + along.max(zero).squared()).sqrt();
        outside + across.max(along).min(zero)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let axis = V3::splat(origin.x, self.side.axis());
        SeenCappedCylinder {
            side: self.side.seen_from(origin),
            over_bottom: (origin - V3::splat(origin.x, self.bottom())).dot(axis),
            over_top: (origin - V3::splat(origin.x, self.top)).dot(axis),
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenCappedCylinder {
            side: SeenSide::lift(&seen.side, like),
            over_bottom: like.lift_like(seen.over_bottom),
            over_top: like.lift_like(seen.over_top),
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        let extent = one.splat_like(max_norm(self.bottom()).max(max_norm(self.top)));
        SeenCappedCylinder {
            side: self.side.grounded(seen.side, ground),
            over_bottom: ground.settle(1.0, seen.over_bottom, one, extent),
            over_top: ground.settle(2.0, seen.over_top, one, extent),
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let side = self.side.span(&seen.side, toward);
        let speed = toward.v.dot(V3::splat(toward.vv, self.side.axis()));
        side.intersection(plane::slab(seen.over_bottom, seen.over_top, reciprocal_speed(speed)))
    }

    /// Face 0 is the side, 1 the bottom, 2 the top. On a rim the cap.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let axis = V3::splat(t, self.side.axis());
        let per_speed = reciprocal_speed(toward.v.dot(axis));
        let at_top = plane::crossing(seen.over_top, per_speed).eq(t);
        let at_bottom = plane::crossing(seen.over_bottom, per_speed).eq(t);
        let side = self.side.surface(&seen.side, toward, t);
        let top = Surface::of_face(2.0, axis).or_else(at_top, side);
        Surface::of_face(1.0, -axis).or_else(at_bottom, top)
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn grown(&self, by: f32) -> Option<Self> {
        let axis = self.side.axis();
        Self::new(self.bottom() - axis * by, self.top + axis * by, axis, self.side.radius() + by).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        let disc = |center| Bounds::of_disc(center, self.side.axis(), self.side.radius());
        Some(disc(self.bottom()).joined(disc(self.top)))
    }
}

#[cfg(test)]
mod tests {
    use super::CappedCylinder;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let drum = CappedCylinder::new(vec3(0.0, -1.0, 0.0), vec3(0.0, 3.0, 0.0), Vec3::Y, 2.0).unwrap();
        assert_eq!(drum.sdf(vec3(5.0, 7.0, 0.0)), 5.0);
        assert_eq!(drum.sdf(vec3(0.0, 2.5, 0.0)), -0.5);
        assert_eq!(drum.sdf(vec3(0.0, -1.5, 0.0)), 0.5);
        // Through a cap, the side, and over the caps where only the infinite cylinder would be met.
        assert_eq!(drum.gsdf(vec3(1.0, 9.0, 0.0), Vec3::NEG_Y), 6.0);
        assert_eq!(drum.gsdf(vec3(5.0, 1.0, 0.0), Vec3::NEG_X), 3.0);
        assert_eq!(drum.gsdf(vec3(5.0, 4.0, 0.0), Vec3::NEG_X), f32::INFINITY);
        assert_eq!(drum.gsdf(Vec3::ZERO, Vec3::NEG_Y), -1.0);
        // In a cap.
        assert_eq!(drum.gsdf(vec3(5.0, 3.0, 0.0), Vec3::NEG_X), f32::INFINITY);
    }

    #[test]
    fn the_axis_between_points_over_each_other_is_exact() {
        let (bottom, top) = (vec3(0.1, 0.2, 0.3), vec3(0.1, 0.7, 0.3));
        let computed = CappedCylinder::between(bottom, top, 1.0).unwrap();
        assert_eq!(computed, CappedCylinder::new(bottom, top, Vec3::Y, 1.0).unwrap());
    }
}
