//! The quadrilateral.

use super::facet::{self, SeenFacet, across, arrow, cross, dot};
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Fault, Invalid};
use crate::range::{larger, max_norm};
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// The flat piece of surface between four corners, convex, without thickness, seen from both sides: the two triangles
/// `a b c` and `a c d`.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/quad.md"))]
///
/// All that is said of a [`Triangle`](super::Triangle) holds here too, watertightness between facets that share an
/// edge included.
///
/// - Standard: the distance to the plane over the quad, to the nearest edge beside it; never negative. Source: I.
///   Quilez, Distance functions (quad).
/// - Along a ray: the two triangles, which share the arithmetic of the diagonal.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them, for corners in a plane up to their own.
///   Cost: two divisions and 43 products and sums where it is missed, four and about 190 where it is hit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quad {
    corners: [Vec3; 4],
}

const NAMES: [[&str; 4]; 4] = [
    ["quad a", "quad b", "quad c", "quad a b c: longest edge squared"],
    ["quad b", "quad c", "quad d", "quad b c d: longest edge squared"],
    ["quad c", "quad d", "quad a", "quad c d a: longest edge squared"],
    ["quad d", "quad a", "quad b", "quad d a b: longest edge squared"],
];

/// How far the diagonals may pass each other, as a share of the largest coordinate: 2^-20, sixteen rounding errors.
const FLATNESS: f64 = 1.0 / 1_048_576.0;

impl Quad {
    /// The quad with these corners, in order around it.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, three corners are within 2^-20 of a line, the four do not turn
    /// the same way all around, or their diagonals pass each other by more than 2^-20 of the largest coordinate.
    pub const fn new(a: Vec3, b: Vec3, c: Vec3, d: Vec3) -> Result<Self, Invalid> {
        let corners = [a, b, c, d];
        let normal = cross(arrow(a, c), arrow(b, d));
        let mut index = 0;
        while index < 4 {
            let [from, at, to] = [corners[index], corners[(index + 1) % 4], corners[(index + 2) % 4]];
            match facet::corner_normal(NAMES[index], from, at, to) {
                Ok(turn) if dot(turn, normal) > 0.0_f64 => {}
                Ok(turn) => return Err(Invalid::new("quad: turn at a corner", dot(turn, normal) as f32, Fault::NotConvex)),
                Err(error) => return Err(error),
            }
            index += 1;
        }
        let extent = larger(larger(max_norm(a), max_norm(b)), larger(max_norm(c), max_norm(d))) as f64;
        // The diagonals' distance times the length of the normal.
        let gap = dot(arrow(a, b), normal);
        if gap * gap > FLATNESS * FLATNESS * extent * extent * dot(normal, normal) {
            return Err(Invalid::new("quad: volume of its corners, times six", gap as f32, Fault::NotPlanar));
        }
        Ok(Self { corners })
    }

    /// The corners, in order around it.
    #[must_use]
    pub const fn corners(&self) -> [Vec3; 4] {
        self.corners
    }

    /// A vector about which the corners turn to the left.
    #[inline(always)]
    fn across<T: Real>(&self, like: T) -> V3<T> {
        let [a, b, c, d] = self.corners;
        let (a, b, c, d) = (V3::splat(like, a), V3::splat(like, b), V3::splat(like, c), V3::splat(like, d));
        across(c - a, d - b)
    }
}

impl Solid for Quad {
    type Seen<T: Real> = SeenFacet<T, 4>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        facet::distance(&self.corners, self.across(p.x), p)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        SeenFacet::new(&self.corners, origin)
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenFacet::lift(seen, like)
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        seen.grounded(&self.corners, self.across(ground.face), ground)
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        seen.span(toward)
    }

    /// Face 0 is both sides: the normal is turned against the ray where it enters, and along it where it leaves.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        Surface {
            normal: seen.normal(self.across(t), toward, t),
            face: t.splat_like(0.0),
        }
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn bounds(&self) -> Option<Bounds> {
        let [a, b, c, d] = self.corners;
        Some(Bounds {
            min: a.min(b).min(c).min(d),
            max: a.max(b).max(c).max(d),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Quad;
    use crate::invalid::Fault;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        // A trapezium in the plane y = 1.
        let corners = [(0.0, 0.0), (0.0, 4.0), (2.0, 4.0), (5.0, 0.0)].map(|(x, z)| vec3(x, 1.0, z));
        let [a, b, c, d] = corners;
        let sheet = Quad::new(a, b, c, d).unwrap();
        assert_eq!(sheet.sdf(vec3(1.0, 3.0, 1.0)), 2.0);
        assert_eq!(sheet.sdf(vec3(1.0, -1.0, 3.0)), 2.0);
        assert_eq!(sheet.sdf(vec3(-3.0, 5.0, 2.0)), 5.0);
        assert!((sheet.sdf(vec3(3.5 + 1.6, 1.0, 2.0 + 1.2)) - 2.0).abs() < 1e-6);
        // Both triangles and the diagonal between them, from both sides.
        for (x, z) in [(0.5, 3.0), (3.0, 1.0), (1.0, 2.0)] {
            assert_eq!(sheet.gsdf(vec3(x, 4.0, z), Vec3::NEG_Y), 3.0);
            assert_eq!(sheet.gsdf(vec3(x, -4.0, z), Vec3::Y), 5.0);
            assert_eq!(sheet.gsdf(vec3(x, 4.0, z), Vec3::Y), f32::INFINITY);
        }
        for (x, z) in [(-0.1, 1.0), (1.0, 4.1), (3.6, 2.0), (1.0, -0.1)] {
            assert_eq!(sheet.gsdf(vec3(x, 4.0, z), Vec3::NEG_Y), f32::INFINITY);
        }
        assert_eq!(sheet.gsdf(vec3(-1.0, 1.0, 2.0), Vec3::X), f32::INFINITY);
    }

    #[test]
    fn what_is_no_convex_quad_is_refused() {
        let fault = |c: Vec3, d: Vec3| Quad::new(Vec3::ZERO, Vec3::X, c, d).map_err(|error| error.fault());
        assert_eq!(fault(vec3(1.0, 1.0, 0.5), Vec3::Y), Err(Fault::NotPlanar));
        assert_eq!(fault(vec3(0.25, 0.25, 0.0), Vec3::Y), Err(Fault::NotConvex));
        assert_eq!(fault(Vec3::Y, vec3(1.0, 1.0, 0.0)), Err(Fault::NotConvex));
        assert_eq!(fault(vec3(2.0, 0.0, 0.0), Vec3::Y), Err(Fault::Degenerate));
        assert!(fault(vec3(1.0, 1.0, 1e-7), Vec3::Y).is_ok());
    }
}
