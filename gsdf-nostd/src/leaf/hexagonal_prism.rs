//! The hexagonal prism.

use super::polyhedron::{Caps, Crossed, SeenSlab, Within, half_root_three};
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, length};
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The upright prism over a regular hexagon, two sides of which are across x; turn it with a
/// [`Transform`](crate::Transform).
///
#[cfg_attr(doc, doc = include_str!("../../pictures/hexagonal_prism.md"))]
///
/// It stores the heights of its caps, so that a cap shared with a neighbour is one and the same number.
///
/// - Standard: the point mirrored into the sixth around one side, where the nearest point of the outline is on that
///   side, and the prism over the outline's distance, exact. Source: I. Quilez, Distance functions (hexagonal prism).
/// - Along a ray: the last entry into and the first exit from four slabs.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: twelve products and two divisions;
///   two more divisions belong to the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HexagonalPrism {
    caps: Caps,
    apothem: f32,
}

/// A [`HexagonalPrism`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenHexagonalPrism<T> {
    caps: SeenSlab<T>,
    /// Between the faces across x, and across the normals of the other sides, in the order of the faces.
    sides: [SeenSlab<T>; 3],
}

impl HexagonalPrism {
    /// The prism from the hexagon around `bottom`, at its height, up to the height `top`, the sides being `apothem`
    /// away from the middle: those across x, and those 60 degrees off.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, `top` is not above `bottom.y` by at least 2^-20, or the
    /// apothem is not from 2^-20 to 2^30.
    pub const fn new(bottom: Vec3, top: f32, apothem: f32) -> Result<Self, Invalid> {
        const NAMES: [&str; 3] = ["hexagonal prism bottom", "hexagonal prism top", "hexagonal prism top - bottom.y"];
        match (Caps::new(NAMES, bottom, top), length("hexagonal prism apothem", apothem)) {
            (Ok(caps), Ok(apothem)) => Ok(Self { caps, apothem }),
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
    pub const fn apothem(&self) -> f32 {
        self.apothem
    }

    /// The components of a vector along the normals of the oblique sides, `(1/2, 0, √3/2)` and `(1/2, 0, -√3/2)`.
    #[inline(always)]
    fn oblique<T: Real>(v: V3<T>) -> (T, T) {
        let (x, z) = (v.x * v.x.splat_like(0.5), v.z * half_root_three(v.z));
        (x + z, x - z)
    }
}

impl Solid for HexagonalPrism {
    type Seen<T: Real> = SeenHexagonalPrism<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let w = self.caps.to(p);
        let (zero, half, slope) = (p.x.splat_like(0.0), p.x.splat_like(0.5), half_root_three(p.x));
        let apothem = p.x.splat_like(self.apothem);
        let (x, z) = (w.x.abs(), w.z.abs());
        // Beyond the line from the middle to a corner, mirrored in it.
        let beyond = (z * slope - x * half).max(zero);
        let (x, z) = (x + beyond, z - (beyond + beyond) * slope);
        let half_side = apothem * slope / p.x.splat_like(1.5);
        let (over, past) = (x - apothem, (z.abs() - half_side).max(zero));
        let away = (over.squared() + past.squared()).sqrt();
        self.caps.distance(T::select(over.lt(zero), -away, away), p.y)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let w = self.caps.to(origin);
        let (rising, falling) = Self::oblique(w);
        let apothem = origin.x.splat_like(self.apothem);
        SeenHexagonalPrism {
            caps: self.caps.seen_from(origin),
            sides: [
                SeenSlab::around(w.x, apothem),
                SeenSlab::around(rising, apothem),
                SeenSlab::around(falling, apothem),
            ],
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        let [x, rising, falling] = &seen.sides;
        SeenHexagonalPrism {
            caps: SeenSlab::lift(&seen.caps, like),
            sides: [SeenSlab::lift(x, like), SeenSlab::lift(rising, like), SeenSlab::lift(falling, like)],
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        let extent = one.splat_like(self.caps.extent(self.apothem));
        let [x, rising, falling] = seen.sides;
        SeenHexagonalPrism {
            caps: seen.caps.grounded(ground, 0.0, one, extent),
            sides: [
                x.grounded(ground, 2.0, one, extent),
                rising.grounded(ground, 4.0, one, extent),
                falling.grounded(ground, 6.0, one, extent),
            ],
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let (rising, falling) = Self::oblique(toward.v);
        Within::slab(&seen.sides[0], toward.per_component.x)
            .and_slab(&seen.caps, toward.per_component.y)
            .and_slab(&seen.sides[1], reciprocal_speed(rising))
            .and_slab(&seen.sides[2], reciprocal_speed(falling))
            .span()
    }

    /// Faces 0 and 1 are the bottom and the top, 2 and 3 the sides towards -x and +x, 4 and 5 those towards `-(1/2, 0,
    /// √3/2)` and the opposite, 6 and 7 those towards `-(1/2, 0, -√3/2)` and the opposite. On an edge the first of
    /// the faces that meet there.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let (zero, half, slope) = (t.splat_like(0.0), t.splat_like(0.5), half_root_three(t));
        let (rising, falling) = Self::oblique(toward.v);
        let last = Surface {
            normal: V3::new(half, zero, -slope),
            face: t.splat_like(7.0),
        };
        let crossed = Crossed::at(t, last)
            .slab(6.0, last.normal, &seen.sides[2], reciprocal_speed(falling))
            .slab(4.0, V3::new(half, zero, slope), &seen.sides[1], reciprocal_speed(rising))
            .slab(2.0, V3::splat(t, Vec3::X), &seen.sides[0], toward.per_component.x);
        Caps::crossed(crossed, &seen.caps, toward)
    }

    fn grown(&self, by: f32) -> Option<Self> {
        Self::new(self.bottom() - Vec3::Y * by, self.top() + by, self.apothem + by).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        // The corners are 2/√3 of the apothem away; the constant is that, rounded up for the rounding of the product.
        let corner = self.apothem * 1.154_701;
        Some(self.caps.bounds([-self.apothem, -corner], [self.apothem, corner]))
    }
}

#[cfg(test)]
mod tests {
    use super::HexagonalPrism;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let nut = HexagonalPrism::new(vec3(1.0, -1.0, 0.0), 3.0, 2.0).unwrap();
        // Over a side, a cap, the edge between them, and inside near each.
        assert_eq!(nut.sdf(vec3(7.0, 0.0, 0.5)), 4.0);
        assert_eq!(nut.sdf(vec3(1.5, 5.0, 1.0)), 2.0);
        assert_eq!(nut.sdf(vec3(-4.0, 7.0, 0.0)), 5.0);
        assert_eq!(nut.sdf(vec3(2.5, 1.0, 0.0)), -0.5);
        assert_eq!(nut.sdf(vec3(1.0, -0.75, 0.0)), -0.25);
        // The corners are on the axis z, 4/√3 away.
        assert!((nut.sdf(vec3(1.0, 0.0, 5.0)) - (5.0 - 4.0 / 3.0_f32.sqrt())).abs() < 1e-6);
        assert_eq!(nut.gsdf(vec3(9.0, 0.0, 0.0), Vec3::NEG_X), 6.0);
        assert_eq!(nut.gsdf(vec3(1.0, 9.0, 0.0), Vec3::NEG_Y), 6.0);
        assert_eq!(nut.gsdf(vec3(1.0, 0.0, 0.0), Vec3::NEG_Y), -1.0);
        // Along an oblique normal: the sides towards +x and +z, and those towards +x and -z.
        for z in [0.75_f32.sqrt(), -(0.75_f32.sqrt())] {
            assert!((nut.gsdf(vec3(1.0, 0.0, 0.0), vec3(0.5, 0.0, z)) + 2.0).abs() < 1e-6);
        }
        // Past a corner, and in a side.
        assert_eq!(nut.gsdf(vec3(9.0, 0.0, 2.4), Vec3::NEG_X), f32::INFINITY);
        assert!(nut.gsdf(vec3(9.0, 0.0, 2.3), Vec3::NEG_X).is_finite());
        assert_eq!(nut.gsdf(vec3(3.0, 0.0, 9.0), Vec3::NEG_Z), f32::INFINITY);
    }
}
