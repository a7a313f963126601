//! The triangular prism.

use super::polyhedron::{Caps, Crossed, SeenSlab, Within, half_root_three};
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, length};
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The upright prism over an equilateral triangle, one side of which is across z, towards -z; turn it with a
/// [`Transform`](crate::Transform).
///
#[cfg_attr(doc, doc = include_str!("../../pictures/triangular_prism.md"))]
///
/// It stores the heights of its caps, so that a cap shared with a neighbour is one and the same number.
///
/// - Standard: the point mirrored to where the nearest point of the outline is on the side across z, and the prism
///   over the outline's distance, exact. Source: I. Quilez, 2D distance functions (equilateral triangle) and Distance
///   functions (extrusion). (His triangular prism is a bound.)
/// - Along a ray: the last entry into and the first exit from a slab and three half-spaces.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: nine products and two divisions;
///   two more divisions belong to the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangularPrism {
    caps: Caps,
    inradius: f32,
}

/// A [`TriangularPrism`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenTriangularPrism<T> {
    caps: SeenSlab<T>,
    /// Heights over the sides, in the order of the faces.
    over: [T; 3],
}

impl TriangularPrism {
    /// The prism from the triangle around `bottom`, at its height, up to the height `top`, the sides being `inradius`
    /// away from the middle: one towards -z, two towards +x and -x and half as much towards +z.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `top` is not above `bottom.y` by at least 2^-20, or the
    /// inradius is not from 2^-20 to 2^30.
    pub const fn new(bottom: Vec3, top: f32, inradius: f32) -> Result<Self, Invalid> {
        const NAMES: [&str; 3] = ["triangular prism bottom", "triangular prism top", "triangular prism top - bottom.y"];
        match (Caps::new(NAMES, bottom, top), length("triangular prism inradius", inradius)) {
            (Ok(caps), Ok(inradius)) => Ok(Self { caps, inradius }),
            (Err(error), _) | (_, Err(error)) => Err(error),
        }
    }

    /// The middle of the bottom.
    #[must_use]
    pub const fn bottom(&self) -> Vec3 {
        self.caps.bottom()
    }

    /// The height of the top: a coordinate.
    #[must_use]
    pub const fn top(&self) -> f32 {
        self.caps.top()
    }

    /// How far the sides are from the middle.
    #[must_use]
    pub const fn inradius(&self) -> f32 {
        self.inradius
    }

    /// The components of a vector along the normals of the oblique sides, `(√3/2, 0, 1/2)` and `(-√3/2, 0, 1/2)`.
    #[inline(always)]
    fn oblique<T: Real>(v: V3<T>) -> (T, T) {
        let (x, z) = (v.x * half_root_three(v.x), v.z * v.z.splat_like(0.5));
        (z + x, z - x)
    }
}

impl Solid for TriangularPrism {
    type Seen<T: Real> = SeenTriangularPrism<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let w = self.caps.to(p);
        let (zero, half, slope) = (p.x.splat_like(0.0), p.x.splat_like(0.5), half_root_three(p.x));
        let inradius = p.x.splat_like(self.inradius);
        let half_side = (inradius + inradius) * slope;
        // Beyond the line from the middle to a corner of the side across z, mirrored in it.
        let x = w.x.abs();
        let beyond = (x * half + w.z * slope).max(zero);
        let (x, z) = (x - beyond, w.z - (beyond + beyond) * slope);
        let (over, past) = (-(z + inradius), (x.abs() - half_side).max(zero));
        let away = (over.squared() + past.squared()).sqrt();
        self.caps.distance(T::select(over.lt(zero), -away, away), p.y)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let w = self.caps.to(origin);
        let (right, left) = Self::oblique(w);
        let inradius = origin.x.splat_like(self.inradius);
        SeenTriangularPrism {
            caps: self.caps.seen_from(origin),
            over: [-w.z - inradius, right - inradius, left - inradius],
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        let [back, right, left] = seen.over;
        SeenTriangularPrism {
            caps: SeenSlab::lift(&seen.caps, like),
            over: [like.lift_like(back), like.lift_like(right), like.lift_like(left)],
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        let extent = one.splat_like(self.caps.extent(self.inradius));
        let [back, right, left] = seen.over;
        SeenTriangularPrism {
            caps: seen.caps.grounded(ground, 0.0, one, extent),
            over: [
                ground.settle(2.0, back, one, extent),
                ground.settle(3.0, right, one, extent),
                ground.settle(4.0, left, one, extent),
            ],
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let [back, right, left] = seen.over;
        let (rightward, leftward) = Self::oblique(toward.v);
        Within::slab(&seen.caps, toward.per_component.y)
            .and_below(back, -toward.per_component.z)
            .and_below(right, reciprocal_speed(rightward))
            .and_below(left, reciprocal_speed(leftward))
            .span()
    }

    /// Faces 0 and 1 are the bottom and the top, 2 the side towards -z, 3 that towards `(√3/2, 0, 1/2)`, 4 that towards
    /// `(-√3/2, 0, 1/2)`. On an edge the first of the faces that meet there.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let (zero, half, slope) = (t.splat_like(0.0), t.splat_like(0.5), half_root_three(t));
        let [back, right, _] = seen.over;
        let (rightward, _) = Self::oblique(toward.v);
        let last = Surface {
            normal: V3::new(-slope, zero, half),
            face: t.splat_like(4.0),
        };
        let crossed = Crossed::at(t, last)
            .face(3.0, V3::new(slope, zero, half), right, reciprocal_speed(rightward))
            .face(2.0, V3::splat(t, Vec3::NEG_Z), back, -toward.per_component.z);
        Caps::crossed(crossed, &seen.caps, toward)
    }

    fn grown(&self, by: f32) -> Option<Self> {
        Self::new(self.bottom() - Vec3::Y * by, self.top() + by, self.inradius + by).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        // Half a side is √3 inradii long; the constant is that, rounded up for the rounding of the product.
        let half_side = self.inradius * 1.732_052;
        Some(self.caps.bounds([-half_side, -self.inradius], [half_side, 2.0 * self.inradius]))
    }
}

#[cfg(test)]
mod tests {
    use super::TriangularPrism;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let wedge = TriangularPrism::new(vec3(0.0, -1.0, 1.0), 3.0, 2.0).unwrap();
        let near = |found: f32, wanted: f32| assert!((found - wanted).abs() < 1e-5, "{found} {wanted}");
        // The side across z is at -1, the edge opposite at 5, the others 2√3 from x = 0.
        near(wedge.sdf(vec3(1.0, 0.0, -4.0)), 3.0);
        near(wedge.sdf(vec3(0.0, 0.0, 7.0)), 2.0);
        near(wedge.sdf(vec3(0.0, 6.0, 9.0)), 5.0);
        near(wedge.sdf(vec3(0.0, 1.0, -0.5)), -0.5);
        near(wedge.sdf(vec3(0.0, 2.75, 1.0)), -0.25);
        near(wedge.sdf(vec3(8.0, 0.0, -1.0)), 8.0 - 12.0_f32.sqrt());
        for x in [0.75_f32.sqrt(), -(0.75_f32.sqrt())] {
            let out = vec3(x, 0.0, 0.5);
            near(wedge.sdf(vec3(0.0, 1.0, 1.0) + 3.0 * out), 1.0);
            near(wedge.gsdf(vec3(0.0, 0.0, 1.0), out), -2.0);
        }
        near(wedge.gsdf(vec3(0.0, 0.0, -9.0), Vec3::Z), 8.0);
        near(wedge.gsdf(vec3(0.0, 0.0, 9.0), Vec3::NEG_Z), 4.0);
        near(wedge.gsdf(vec3(0.0, 9.0, 1.0), Vec3::NEG_Y), 6.0);
        near(wedge.gsdf(vec3(0.0, 0.0, 1.0), Vec3::NEG_Z), -2.0);
        // Beside it, and in a side.
        assert_eq!(wedge.gsdf(vec3(9.0, 0.0, 5.5), Vec3::NEG_X), f32::INFINITY);
        assert_eq!(wedge.gsdf(vec3(9.0, 0.0, -1.5), Vec3::NEG_X), f32::INFINITY);
        assert_eq!(wedge.gsdf(vec3(9.0, 0.0, -1.0), Vec3::NEG_X), f32::INFINITY);
    }
}
