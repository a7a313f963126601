//! Facets along a ray: what the triangle and the quad share.

use super::solid::{Ground, nowhere};
use crate::invalid::{Fault, Invalid, point};
use crate::range::{MIN_LENGTH, larger, max_norm};
use crate::real::{Mask, Real};
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// The corners of a facet seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenFacet<T, const N: usize> {
    /// From the origin to the corners.
    corners: [V3<T>; N],
    /// 0 where the origin lies on the facet, which a ray has then left behind, 1 elsewhere.
    ahead: T,
}

impl<T: Real, const N: usize> SeenFacet<T, N> {
    #[inline(always)]
    pub(super) fn new(corners: &[Vec3; N], origin: V3<T>) -> Self {
        let mut seen = [origin; N];
        for (seen, corner) in seen.iter_mut().zip(corners) {
            *seen = V3::splat(origin.x, *corner) - origin;
        }
        Self {
            corners: seen,
            ahead: origin.x.splat_like(1.0),
        }
    }

    #[inline(always)]
    pub(super) fn lift(seen: &SeenFacet<T::Scalar, N>, like: T) -> Self {
        let mut corners = [V3::new(like, like, like); N];
        for (lifted, corner) in corners.iter_mut().zip(&seen.corners) {
            *lifted = V3::lift(like, *corner);
        }
        Self {
            corners,
            ahead: like.lift_like(seen.ahead),
        }
    }

    /// The facet seen from a point that may lie on it; `across` is what [`across`] makes of its edges.
    #[inline(always)]
    pub(super) fn grounded(self, corners: &[Vec3; N], across: V3<T>, ground: &Ground<T>) -> Self {
        let one = ground.face.splat_like(1.0);
        let normal = unit_or_zero(across);
        let mut extent = 0.0;
        for corner in corners {
            extent = larger(extent, max_norm(*corner));
        }
        let height = ground.settle(0.0, self.corners[0].dot(normal), one, one.splat_like(extent));
        Self {
            ahead: T::select(height.eq(one.splat_like(0.0)), height, self.ahead),
            ..self
        }
    }

    /// The span of a facet that is the union of triangles which all have the first corner, given in order around.
    ///
    /// Each corner is first moved across the ray onto an axis: `x = p - (v_x / v_z) p_z`, where `z` is the direction's
    /// largest component. The same corner moves by the same rounding error whichever facet it belongs to, and from
    /// there on every decision is the sign of `x y' - y x'`, of two corners, in which a rounded difference of rounded
    /// products is never wrong, only ever zero; zero belongs to the facets on both sides. No ray slips through between
    /// facets that share corners. A ray that sees nothing but zeros lies in the facet's plane.
    ///
    /// The parameter is a mean of those of the corners, weighted with these determinants. For a ray almost in the plane
    /// they cancel, so the lost parts of their products are added back in: the crossing is then that of a facet whose
    /// corners moved by their own rounding errors, however grazing the ray.
    ///
    /// Source: S. Woop, C. Benthin, I. Wald, Watertight Ray/Triangle Intersection, JCGT 2 (2013); T. Dekker, A
    /// Floating-Point Technique for Extending the Available Precision, 1971.
    #[inline(always)]
    pub(super) fn span(&self, toward: &Toward<T>) -> Span<T> {
        let zero = self.ahead.splat_like(0.0);
        let sight = Sight::new(toward);
        let mut corners = [sight.corner(self.corners[0]); N];
        for (aimed, corner) in corners.iter_mut().zip(&self.corners) {
            *aimed = sight.corner(*corner);
        }
        let first = &corners[0];
        let mut near = zero.lt(zero);
        for index in 1..N - 1 {
            let (second, third) = (&corners[index], &corners[index + 1]);
            near = near | !is_mixed(second.turn(third), third.turn(first), first.turn(second));
        }
        let near = near & zero.lt(self.ahead);
        if nowhere(near) {
            return Span::empty_like(zero);
        }
        let splitter = splitter(zero);
        let (mut met, mut t) = (near.splat_like(false), zero);
        for index in 1..N - 1 {
            let (second, third) = (&corners[index], &corners[index + 1]);
            let u = second.exact_turn(third, splitter);
            let v = third.exact_turn(first, splitter);
            let w = first.exact_turn(second, splitter);
            let area = (u + v) + w;
            let way = (u * first.along + v * second.along) + w * third.along;
            t = T::select(met, t, way / (area * sight.speed));
            met = met | (!is_mixed(u, v, w) & !area.eq(zero));
        }
        // Next to 0, where numbers are as close as they get, no caller's unit of length may take the span to nothing.
        let exit = t.next_up().max(t + t.splat_like(THINNEST));
        Span::between_where(near & met, t, exit)
    }

    /// The unit normal, turned against the ray where it enters the facet, along the ray where it leaves it; `across` is
    /// what [`across`] makes of its edges.
    #[inline(always)]
    pub(super) fn normal(&self, across: V3<T>, toward: &Toward<T>, t: T) -> V3<T> {
        let normal = toward.unit_normal(across);
        let entering = self.span(toward).enter.eq(t);
        let along = t.splat_like(0.0).lt(normal.dot(toward.v));
        V3::select(entering.differs_from(along), normal, -normal)
    }
}

/// The least length of a facet's span: 2^-80, too little to be seen in any other number than 0.
const THINNEST: f32 = 1.0 / (1_u128 << 80) as f32;

/// The ray's own frame: which component of its direction is the largest, and how it strays from that axis.
struct Sight<T: Real> {
    mostly_x: T::Mask,
    mostly_y: T::Mask,
    slopes: [T; 2],
    speed: T,
}

impl<T: Real> Sight<T> {
    #[inline(always)]
    fn new(toward: &Toward<T>) -> Self {
        let (x, y, z) = (toward.v.x.abs(), toward.v.y.abs(), toward.v.z.abs());
        let mut sight = Self {
            mostly_x: y.le(x) & z.le(x),
            mostly_y: z.le(y),
            slopes: [x, y],
            speed: z,
        };
        let [first, second, speed] = sight.turned(toward.v);
        (sight.slopes, sight.speed) = ([first / speed, second / speed], speed);
        sight
    }

    /// The components of a vector, the one along the ray's largest last.
    #[inline(always)]
    fn turned(&self, v: V3<T>) -> [T; 3] {
        [self.pick(v.y, v.z, v.x), self.pick(v.z, v.x, v.y), self.pick(v.x, v.y, v.z)]
    }

    /// The first number where the ray's largest component is that along x, the second where it is that along y, or the
    /// third.
    #[inline(always)]
    fn pick(&self, x: T, y: T, z: T) -> T {
        T::select(self.mostly_x, x, T::select(self.mostly_y, y, z))
    }

    #[inline(always)]
    fn corner(&self, from_origin: V3<T>) -> Aimed<T> {
        let [x, y, along] = self.turned(from_origin);
        Aimed {
            x: x - self.slopes[0] * along,
            y: y - self.slopes[1] * along,
            along,
        }
    }
}

/// A corner in the ray's frame: how far beside the ray, and how far along it.
#[derive(Clone, Copy)]
struct Aimed<T> {
    x: T,
    y: T,
    along: T,
}

impl<T: Real> Aimed<T> {
    /// Twice the area of the triangle of the ray and two corners; positive where it turns to the left. Its sign is
    /// never wrong, but the value may be 0 where it should not be.
    #[inline(always)]
    fn turn(&self, to: &Self) -> T {
        self.x * to.y - to.x * self.y
    }

    /// The same, to about two units roundoff.
    #[inline(always)]
    fn exact_turn(&self, to: &Self, splitter: T) -> T {
        let (left, right) = (self.x * to.y, to.x * self.y);
        let lost = residue(self.x, to.y, left, splitter) - residue(to.x, self.y, right, splitter);
        (left - right) + lost
    }
}

/// Whether some of the numbers are positive and others negative.
#[inline(always)]
fn is_mixed<T: Real>(u: T, v: T, w: T) -> T::Mask {
    let zero = u.splat_like(0.0);
    let least = u.min(v).min(w);
    let greatest = u.max(v).max(w);
    least.lt(zero) & zero.lt(greatest)
}

/// `x y - product`, exactly, where `product` is the rounded one.
#[inline(always)]
fn residue<T: Real>(x: T, y: T, product: T, splitter: T) -> T {
    let ((x_high, x_low), (y_high, y_low)) = (halves(x, splitter), halves(y, splitter));
    x_low * y_low - (((product - x_high * y_high) - x_low * y_high) - x_high * y_low)
}

/// A number as the sum of two of half as many digits.
#[inline(always)]
fn halves<T: Real>(x: T, splitter: T) -> (T, T) {
    let scaled = x * splitter;
    let high = scaled - (scaled - x);
    (high, x - high)
}

/// What splits a number into halves by multiplication: 2^12 + 1 for the 24 bits of `f32`, 2^27 + 1 for the 53 of `f64`.
#[inline(always)]
fn splitter<T: Real>(like: T) -> T {
    let one = like.splat_like(1.0);
    let beyond_single = one + one.splat_like(f32::EPSILON * f32::EPSILON);
    T::select(beyond_single.eq(one), one.splat_like(4097.0), one + one.splat_like(134_217_728.0))
}

/// A vector across `first` and `second`, zero where they are as good as parallel.
///
/// The part of `second` along `first` is taken away before they are multiplied, so that the normal of a needle is that
/// of corners moved by rounding errors, and no worse.
#[inline(always)]
pub(super) fn across<T: Real>(first: V3<T>, second: V3<T>) -> V3<T> {
    let unscaled = first.scaled(first.x.splat_like(1.0) / first.norm_squared());
    let upright = second - first.scaled(unscaled.dot(second));
    unscaled.cross(upright)
}

#[inline(always)]
fn unit_or_zero<T: Real>(across: V3<T>) -> V3<T> {
    across.normalized_or(V3::splat(across.x, Vec3::ZERO))
}

/// The standard distance to a facet: to its plane over the facet, to the nearest edge beside it. `across` is what [`across`]
/// makes of its edges.
///
/// Source: I. Quilez, Distance functions (triangle, quad).
#[inline(always)]
pub(super) fn distance<T: Real, const N: usize>(corners: &[Vec3; N], across: V3<T>, p: V3<T>) -> T {
    let normal = unit_or_zero(across);
    let (zero, one) = (p.x.splat_like(0.0), p.x.splat_like(1.0));
    let mut to_edge = zero.splat_like(f32::INFINITY);
    let mut over = zero.eq(zero);
    for index in 0..N {
        let from = V3::splat(p.x, corners[index]);
        let edge = V3::splat(p.x, corners[(index + 1) % N]) - from;
        let w = p - from;
        let along = (w.dot(edge) / edge.norm_squared()).max(zero).min(one);
        to_edge = to_edge.min((w - edge.scaled(along)).norm_squared());
        over = over & zero.le(normal.cross(edge).dot(w));
    }
    let to_plane = (p - V3::splat(p.x, corners[0])).dot(normal).abs();
    T::select(over, to_plane, to_edge.sqrt())
}

/// In `f64`, a vector between points.
pub(super) type Arrow = [f64; 3];

pub(super) const fn arrow(from: Vec3, to: Vec3) -> Arrow {
    [
        to.x as f64 - from.x as f64,
        to.y as f64 - from.y as f64,
        to.z as f64 - from.z as f64,
    ]
}

pub(super) const fn dot(a: Arrow, b: Arrow) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) const fn cross(a: Arrow, b: Arrow) -> Arrow {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The vector across three corners, twice as long as their triangle is large, where these are points and no two
/// edges are parallel; `names` are those of the corners, then that of the triangle.
pub(super) const fn corner_normal(names: [&'static str; 4], a: Vec3, b: Vec3, c: Vec3) -> Result<Arrow, Invalid> {
    match (point(names[0], a), point(names[1], b), point(names[2], c)) {
        (Ok(_), Ok(_), Ok(_)) => {}
        (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => return Err(error),
    }
    let (ab, bc, ca) = (arrow(a, b), arrow(b, c), arrow(c, a));
    let normal = cross(ab, bc);
    let longest_squared = dot(ab, ab).max(dot(bc, bc)).max(dot(ca, ca));
    let least = MIN_LENGTH as f64;
    // The height over the longest edge is twice the area by its length.
    if dot(normal, normal) < least * least * longest_squared || longest_squared == 0.0 {
        Err(Invalid::new(names[3], longest_squared as f32, Fault::Degenerate))
    } else {
        Ok(normal)
    }
}

#[cfg(test)]
mod tests {
    use super::{Aimed, residue, splitter};
    use crate::leaf::{Leaf, Quad, Solid, Triangle};
    use crate::ray::Line;
    use crate::toward::Toward;
    use crate::vec3::V3;
    use glam::{Vec3, vec3};

    #[test]
    fn what_rounding_loses_of_a_product_is_found_in_either_precision() {
        let (x, y) = (1.234_567_8_f32, 7.654_321_7_f32);
        assert_eq!(
            f64::from(residue(x, y, x * y, splitter(0.0_f32))),
            f64::from(x) * f64::from(y) - f64::from(x * y)
        );
        // (1 + e)² = 1 + 2 e + e², and the last is lost.
        let x = 1.0 + f64::EPSILON;
        assert_eq!(residue(x, x, x * x, splitter(0.0_f64)), f64::EPSILON * f64::EPSILON);
    }

    #[test]
    fn turns_keep_their_digits_where_corners_are_almost_in_line_with_the_ray() {
        let [from, to] = [(1.234_567_8_f32, 7.654_321_f32), (2.469_135_f32, 15.308_64_f32)].map(|(x, y)| Aimed { x, y, along: 0.0 });
        let exact = f64::from(from.x) * f64::from(to.y) - f64::from(to.x) * f64::from(from.y);
        let error = f64::from(from.exact_turn(&to, splitter(0.0_f32))) - exact;
        assert!(error.abs() <= exact.abs() * f64::from(f32::EPSILON), "{error} of {exact}");
    }

    fn hits(sheet: &[Leaf], origin: Vec3, direction: Vec3) -> usize {
        let line = Line {
            origin: V3::<f32>::from(origin),
            toward: Toward::new(V3::from(direction)),
        };
        let is_hit = |facet: &&Leaf| {
            let span = facet.span_along(&line);
            span.enter < span.exit
        };
        sheet.iter().filter(is_hit).count()
    }

    #[test]
    fn no_ray_slips_through_an_edge_or_a_corner() {
        // A tent of four triangles and four quads without a floor, from within: whoever looks up or aside sees it.
        let top = vec3(0.1, 0.2, 0.3);
        let [a, b, c, d] = [(-1.0, 0.3), (0.2, 1.1), (0.9, -0.1), (-0.2, -1.3)].map(|(x, y)| vec3(x, y, -0.7));
        let around = [a, b, c, d];
        let sides: [[Leaf; 2]; 4] = [0, 1, 2, 3].map(|side| {
            let (from, to) = (around[side], around[(side + 1) % 4]);
            let below = Vec3::NEG_Z * 0.5;
            [
                Triangle::new(top, from, to).unwrap().into(),
                Quad::new(from, from + below, to + below, to).unwrap().into(),
            ]
        });
        let tent = sides.as_flattened();
        for step in 0..2_000_u16 {
            let share = f32::from(step) / 2_000.0;
            let eye = vec3(0.3 * share - 0.1, 0.2 - 0.3 * share * share, -0.8 - 0.3 * share);
            for corner in around {
                let on_ridge = top.lerp(corner, share);
                let on_post = corner + Vec3::NEG_Z * (0.3 * share);
                assert!(hits(tent, eye, on_ridge - eye) > 0, "{share}");
                assert!(hits(tent, eye, on_post - eye) > 0, "{share}");
            }
        }
    }
}
