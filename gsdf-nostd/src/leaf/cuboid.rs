//! The box.

use super::plane;
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Fault, Invalid, point};
use crate::range::{MIN_LENGTH, max_norm};
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// The box of the points between two corners, with faces parallel to the coordinate planes of its frame; turn it with
/// a [`Transform`](crate::Transform).
///
#[cfg_attr(doc, doc = include_str!("../../pictures/cuboid.md"))]
///
/// It stores the positions of its faces rather than a centre and a size, so that a face shared with a neighbour is
/// one and the same number.
///
/// - Standard: with `d = |p - c| - h` by components, `|max(d, 0)| + min(max(d), 0)`, exact. Source: I. Quilez,
///   Distance functions.
/// - Along a ray: the last entry into and the first exit from three slabs (T. Kay, J. Kajiya, Ray Tracing Complex
///   Scenes, 1986). (The paper's three planes at the nearest corner bound an octant: the missing test, entry before
///   exit, turns misses into hits.)
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: six products; the three divisions
///   belong to the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid {
    min: Vec3,
    max: Vec3,
}

/// A [`Cuboid`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenCuboid<T> {
    /// From the least corner to the origin.
    over_min: V3<T>,
    /// From the greatest corner to the origin.
    over_max: V3<T>,
}

impl Cuboid {
    /// The box from corner `min` to corner `max`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, or `max` does not exceed `min` by at least 2^-20 along every
    /// axis.
    pub const fn new(min: Vec3, max: Vec3) -> Result<Self, Invalid> {
        match (point("box min", min), point("box max", max)) {
            (Ok(_), Ok(_)) => {}
            (Err(error), _) | (_, Err(error)) => return Err(error),
        }
        match (
            extent("box max.x - min.x", max.x - min.x),
            extent("box max.y - min.y", max.y - min.y),
            extent("box max.z - min.z", max.z - min.z),
        ) {
            (Ok(()), Ok(()), Ok(())) => Ok(Self { min, max }),
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
        }
    }

    /// The corner with the least coordinates.
    #[must_use]
    pub const fn min(&self) -> Vec3 {
        self.min
    }

    /// The corner with the greatest coordinates.
    #[must_use]
    pub const fn max(&self) -> Vec3 {
        self.max
    }
}

/// Refuses the distance from a lower face to an upper one unless it is at least [`MIN_LENGTH`].
pub(super) const fn extent(parameter: &'static str, value: f32) -> Result<(), Invalid> {
    if value <= 0.0 {
        Err(Invalid::new(parameter, value, Fault::Reversed))
    } else if value < MIN_LENGTH {
        Err(Invalid::new(parameter, value, Fault::TooSmall))
    } else {
        Ok(())
    }
}

impl Solid for Cuboid {
    type Seen<T: Real> = SeenCuboid<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let zero = p.x.splat_like(0.0);
        let (below, above) = (V3::splat(p.x, self.min) - p, p - V3::splat(p.x, self.max));
        // How far outside the slabs, by components; negative inside.
        let outside = V3::new(below.x.max(above.x), below.y.max(above.y), below.z.max(above.z));
        let corner = V3::new(outside.x.max(zero), outside.y.max(zero), outside.z.max(zero));
        let deepest = outside.x.max(outside.y).max(outside.z);
        corner.norm() + deepest.min(zero)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        SeenCuboid {
            over_min: origin - V3::splat(origin.x, self.min),
            over_max: origin - V3::splat(origin.x, self.max),
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenCuboid {
            over_min: V3::lift(like, seen.over_min),
            over_max: V3::lift(like, seen.over_max),
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        let extent = one.splat_like(max_norm(self.min).max(max_norm(self.max)));
        let (low, high) = (seen.over_min, seen.over_max);
        SeenCuboid {
            over_min: V3::new(
                ground.settle(0.0, low.x, one, extent),
                ground.settle(2.0, low.y, one, extent),
                ground.settle(4.0, low.z, one, extent),
            ),
            over_max: V3::new(
                ground.settle(1.0, high.x, one, extent),
                ground.settle(3.0, high.y, one, extent),
                ground.settle(5.0, high.z, one, extent),
            ),
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let (low, high, per) = (seen.over_min, seen.over_max, toward.per_component);
        let (enter_x, exit_x) = plane::between(low.x, high.x, per.x);
        let (enter_y, exit_y) = plane::between(low.y, high.y, per.y);
        let (enter_z, exit_z) = plane::between(low.z, high.z, per.z);
        // Each slab must be inhabited by itself: only here does the NaN of a ray in a face show.
        let slabs = enter_x.lt(exit_x) & enter_y.lt(exit_y) & enter_z.lt(exit_z);
        Span::between_where(slabs, enter_x.max(enter_y).max(enter_z), exit_x.min(exit_y).min(exit_z))
    }

    /// Faces 0 to 5: -x, +x, -y, +y, -z, +z. On an edge the first of the faces that meet there.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let (low, high, per) = (seen.over_min, seen.over_max, toward.per_component);
        let faces = Surface::of_face(5.0, V3::splat(t, Vec3::Z));
        let faces = Surface::of_face(4.0, V3::splat(t, Vec3::NEG_Z)).or_else(plane::crossing(low.z, per.z).eq(t), faces);
        let faces = Surface::of_face(3.0, V3::splat(t, Vec3::Y)).or_else(plane::crossing(high.y, per.y).eq(t), faces);
        let faces = Surface::of_face(2.0, V3::splat(t, Vec3::NEG_Y)).or_else(plane::crossing(low.y, per.y).eq(t), faces);
        let faces = Surface::of_face(1.0, V3::splat(t, Vec3::X)).or_else(plane::crossing(high.x, per.x).eq(t), faces);
        Surface::of_face(0.0, V3::splat(t, Vec3::NEG_X)).or_else(plane::crossing(low.x, per.x).eq(t), faces)
    }

    fn grown(&self, by: f32) -> Option<Self> {
        Self::new(self.min - by, self.max + by).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(Bounds {
            min: self.min,
            max: self.max,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Cuboid;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let block = Cuboid::new(vec3(-1.0, -2.0, -3.0), vec3(1.0, 2.0, 3.0)).unwrap();
        assert_eq!(block.sdf(vec3(4.0, 6.0, 0.0)), 5.0);
        assert_eq!(block.sdf(vec3(0.5, 0.0, 0.0)), -0.5);
        assert_eq!(block.gsdf(vec3(0.0, 0.0, 8.0), Vec3::NEG_Z), 5.0);
        assert_eq!(block.gsdf(vec3(0.0, 0.5, 0.0), Vec3::NEG_Y), -2.5);
        // Past a corner of the octant that the nearest three planes bound.
        assert_eq!(block.gsdf(vec3(3.0, 0.5, 0.5), vec3(-2.0, -4.0, 0.0)), f32::INFINITY);
        // In a face: not inside, on either side of the box.
        assert_eq!(block.gsdf(vec3(1.0, 0.0, 8.0), Vec3::NEG_Z), f32::INFINITY);
        assert_eq!(block.gsdf(vec3(-1.0, 0.0, 8.0), vec3(-0.0, 0.0, -1.0)), f32::INFINITY);
    }
}
