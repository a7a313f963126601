//! The octahedron.

use super::polyhedron::{Crossed, SeenSlab, Within, per_root_three};
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, length, point};
use crate::range::max_norm;
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The regular octahedron with its corners on the axes of its frame: `|x| + |y| + |z| < radius` around the centre.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/octahedron.md"))]
///
/// - Standard: in the octant where all coordinates are positive, to the plane of its face, or to the edge the point is
///   beyond, which is the one where the least coordinate vanishes, exact. Source: I. Quilez, Distance functions
///   (octahedron).
/// - Along a ray: the last entry into and the first exit from four slabs, whose heights are sums and differences of
///   coordinates.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: eight products and four divisions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octahedron {
    center: Vec3,
    radius: f32,
}

/// An [`Octahedron`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenOctahedron<T> {
    /// Between opposite faces, in the order of the faces.
    slabs: [SeenSlab<T>; 4],
}

impl Octahedron {
    /// The octahedron with corners `radius` away from `center`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, or the radius is not from 2^-20 to 2^30.
    pub const fn new(center: Vec3, radius: f32) -> Result<Self, Invalid> {
        match (point("octahedron center", center), length("octahedron radius", radius)) {
            (Ok(center), Ok(radius)) => Ok(Self { center, radius }),
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// The centre.
    #[must_use]
    pub const fn center(&self) -> Vec3 {
        self.center
    }

    /// The distance of the corners from the centre.
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// The products of a vector with `(1, 1, 1)`, `(1, 1, -1)`, `(1, -1, 1)` and `(1, -1, -1)`.
    #[inline(always)]
    fn across<T: Real>(v: V3<T>) -> [T; 4] {
        let (sum, difference) = (v.x + v.y, v.x - v.y);
        [sum + v.z, sum - v.z, difference + v.z, difference - v.z]
    }
}

impl Solid for Octahedron {
    type Seen<T: Real> = SeenOctahedron<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let radius = p.x.splat_like(self.radius);
        let w = p - V3::splat(p.x, self.center);
        let (x, y, z) = (w.x.abs(), w.y.abs(), w.z.abs());
        let (less, more) = (x.min(y), x.max(y));
        let (least, middle, greatest) = (less.min(z), less.max(more.min(z)), more.max(z));
        let over = least + middle + greatest - radius;
        // From the foot on the edge between the corners of the two greater coordinates.
        let along = (p.x.splat_like(0.5) * (greatest - middle + radius)).min(radius);
        let to_edge = V3::new(least, middle - (radius - along), greatest - along).norm();
        let beyond = (least + least + least).lt(over);
        T::select(beyond, to_edge, over * per_root_three(over))
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let radius = origin.x.splat_like(self.radius);
        let [a, b, c, d] = Self::across(origin - V3::splat(origin.x, self.center));
        SeenOctahedron {
            slabs: [
                SeenSlab::around(a, radius),
                SeenSlab::around(b, radius),
                SeenSlab::around(c, radius),
                SeenSlab::around(d, radius),
            ],
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        let [a, b, c, d] = &seen.slabs;
        SeenOctahedron {
            slabs: [
                SeenSlab::lift(a, like),
                SeenSlab::lift(b, like),
                SeenSlab::lift(c, like),
                SeenSlab::lift(d, like),
            ],
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        // The length of (1, 1, 1).
        let scale = one / per_root_three(one);
        let extent = one.splat_like(max_norm(self.center) + self.radius);
        let [a, b, c, d] = seen.slabs;
        SeenOctahedron {
            slabs: [
                a.grounded(ground, 0.0, scale, extent),
                b.grounded(ground, 2.0, scale, extent),
                c.grounded(ground, 4.0, scale, extent),
                d.grounded(ground, 6.0, scale, extent),
            ],
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let [a, b, c, d] = Self::across(toward.v);
        Within::slab(&seen.slabs[0], reciprocal_speed(a))
            .and_slab(&seen.slabs[1], reciprocal_speed(b))
            .and_slab(&seen.slabs[2], reciprocal_speed(c))
            .and_slab(&seen.slabs[3], reciprocal_speed(d))
            .span()
    }

    /// Faces 1, 3, 5 and 7 are those towards `(1, 1, 1)`, `(1, 1, -1)`, `(1, -1, 1)` and `(1, -1, -1)`, each after the
    /// one opposite, 0, 2, 4 and 6. On an edge the first of the faces that meet there.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let [a, b, c, d] = Self::across(toward.v);
        let unit = per_root_three(t);
        let last = Surface {
            normal: V3::new(unit, -unit, -unit),
            face: t.splat_like(7.0),
        };
        Crossed::at(t, last)
            .slab(6.0, last.normal, &seen.slabs[3], reciprocal_speed(d))
            .slab(4.0, V3::new(unit, -unit, unit), &seen.slabs[2], reciprocal_speed(c))
            .slab(2.0, V3::new(unit, unit, -unit), &seen.slabs[1], reciprocal_speed(b))
            .slab(0.0, V3::new(unit, unit, unit), &seen.slabs[0], reciprocal_speed(a))
            .surface()
    }

    fn grown(&self, by: f32) -> Option<Self> {
        Self::new(self.center, self.radius + by * libm::sqrtf(3.0)).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(Bounds::around(self.center, Vec3::splat(self.radius)))
    }
}

#[cfg(test)]
mod tests {
    use super::Octahedron;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let gem = Octahedron::new(vec3(1.0, 0.0, 0.0), 3.0).unwrap();
        // Beyond a corner, an edge and a face, and at the centre.
        assert_eq!(gem.sdf(vec3(6.0, 0.0, 0.0)), 2.0);
        assert_eq!(gem.sdf(vec3(1.0, 0.0, -8.0)), 5.0);
        assert!((gem.sdf(vec3(-2.0, -3.0, 0.0)) - 3.0 / 2.0_f32.sqrt()).abs() < 1e-6);
        assert!((gem.sdf(vec3(3.0, -2.0, 2.0)) - 3.0_f32.sqrt()).abs() < 1e-6);
        assert!((gem.sdf(vec3(1.0, 0.0, 0.0)) + 3.0_f32.sqrt()).abs() < 1e-6);
        // Through each pair of faces, along an axis and inside.
        for (x, y, z) in [(1.0, 1.0, 1.0), (1.0, 1.0, -1.0), (1.0, -1.0, 1.0), (1.0, -1.0, -1.0)] {
            let toward = vec3(x, y, z);
            assert_eq!(gem.gsdf(gem.center() - 4.0 * toward, toward), 3.0);
            assert_eq!(gem.gsdf(gem.center(), -toward), -1.0);
        }
        assert_eq!(gem.gsdf(vec3(1.5, 0.5, 9.0), Vec3::NEG_Z), 7.0);
        assert_eq!(gem.gsdf(vec3(1.5, 0.5, 0.0), Vec3::NEG_Y), -3.0);
        // Past an edge, and in a face.
        assert_eq!(gem.gsdf(vec3(3.0, 1.5, 9.0), Vec3::NEG_Z), f32::INFINITY);
        assert_eq!(gem.gsdf(vec3(4.0, 0.0, 0.0), vec3(-1.0, 1.0, 0.0)), f32::INFINITY);
    }
}
