//! What solids with flat faces share: parallel pairs of faces, single ones, and the caps of upright prisms.

use super::cuboid::extent;
use super::plane;
use super::solid::{Bounds, Ground, Surface};
use crate::invalid::{Invalid, coordinate, point};
use crate::range::{larger, max_norm};
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::Vec3;

/// `√3 / 2`, the height of an equilateral triangle of unit side, correctly rounded in `f32` and in `f64`: the leading
/// digits, the next and the rest, of which an arithmetic keeps what it can.
#[inline(always)]
pub(super) fn half_root_three<T: Real>(like: T) -> T {
    (like.splat_like(0.866_025_4) + like.splat_like(1.554_362_5e-8)) + like.splat_like(-6.159_584e-16)
}

/// `1 / √3`, the components of the unit vector across an octahedron's face, correctly rounded like
/// [`half_root_three`].
#[inline(always)]
pub(super) fn per_root_three<T: Real>(like: T) -> T {
    (like.splat_like(0.577_350_26) + like.splat_like(1.036_241_7e-8)) + like.splat_like(-4.106_389_3e-16)
}

/// Two parallel faces seen from a point: the heights over them, along one normal of any length.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeenSlab<T> {
    over_lower: T,
    over_upper: T,
}

impl<T: Real> SeenSlab<T> {
    /// The slab between two heights, seen from a third.
    #[inline(always)]
    pub(super) fn between(height: T, lower: T, upper: T) -> Self {
        Self {
            over_lower: height - lower,
            over_upper: height - upper,
        }
    }

    /// The slab of the points nearer than `half` to a plane, in units of the normal, seen from a height over it.
    #[inline(always)]
    pub(super) fn around(height: T, half: T) -> Self {
        Self::between(height, -half, half)
    }

    /// The parameters at which the ray crosses the lower face and the upper one.
    #[inline(always)]
    pub(super) fn crossings(&self, per_speed: T) -> [T; 2] {
        [
            plane::crossing(self.over_lower, per_speed),
            plane::crossing(self.over_upper, per_speed),
        ]
    }

    #[inline(always)]
    pub(super) fn lift(seen: &SeenSlab<T::Scalar>, like: T) -> Self {
        Self {
            over_lower: like.lift_like(seen.over_lower),
            over_upper: like.lift_like(seen.over_upper),
        }
    }

    /// The slab seen from a point that may lie on its lower face, number `lower`, or on the upper one, the next
    /// number; `scale` is the length of the normal.
    #[inline(always)]
    pub(super) fn grounded(self, ground: &Ground<T>, lower: f32, scale: T, extent: T) -> Self {
        Self {
            over_lower: ground.settle(lower, self.over_lower, scale, extent),
            over_upper: ground.settle(lower + 1.0, self.over_upper, scale, extent),
        }
    }
}

/// What faces leave of a ray: the last entry and the first exit so far.
///
/// Every face must leave something by itself: only there does the NaN of a ray in a face show.
#[derive(Clone, Copy, Debug)]
pub(super) struct Within<T: Real> {
    enter: T,
    exit: T,
    inhabited: T::Mask,
}

impl<T: Real> Within<T> {
    /// Between two parallel faces.
    #[inline(always)]
    pub(super) fn slab(slab: &SeenSlab<T>, per_speed: T) -> Self {
        Self::unless_empty(plane::between(slab.over_lower, slab.over_upper, per_speed))
    }

    /// Also between these.
    #[inline(always)]
    pub(super) fn and_slab(self, slab: &SeenSlab<T>, per_speed: T) -> Self {
        self.and(Self::slab(slab, per_speed))
    }

    /// Below a single face.
    #[inline(always)]
    pub(super) fn below(height: T, per_speed: T) -> Self {
        Self::unless_empty(plane::below(height, per_speed))
    }

    /// Also below this one.
    #[inline(always)]
    pub(super) fn and_below(self, height: T, per_speed: T) -> Self {
        self.and(Self::below(height, per_speed))
    }

    #[inline(always)]
    fn unless_empty((enter, exit): (T, T)) -> Self {
        Self {
            enter,
            exit,
            inhabited: enter.lt(exit),
        }
    }

    /// What both leave.
    #[inline(always)]
    pub(super) fn and(self, other: Self) -> Self {
        Self {
            enter: self.enter.max(other.enter),
            exit: self.exit.min(other.exit),
            inhabited: self.inhabited & other.inhabited,
        }
    }

    #[inline(always)]
    pub(super) fn span(self) -> Span<T> {
        Span::between_where(self.inhabited, self.enter, self.exit)
    }
}

/// The search for the face a ray crosses at a parameter, from the last face to the first: the first one found stays.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossed<T> {
    t: T,
    found: Surface<T>,
}

impl<T: Real> Crossed<T> {
    /// `otherwise` unless a face is found.
    #[inline(always)]
    pub(super) fn at(t: T, otherwise: Surface<T>) -> Self {
        Self { t, found: otherwise }
    }

    /// The face with this number and unit normal, if the ray crosses it here.
    #[inline(always)]
    pub(super) fn face(self, number: f32, normal: V3<T>, height: T, per_speed: T) -> Self {
        let face = Surface {
            normal,
            face: self.t.splat_like(number),
        };
        Self {
            found: face.or_else(plane::crossing(height, per_speed).eq(self.t), self.found),
            ..self
        }
    }

    /// Two parallel faces, number `lower` and the next, the normal being that of the upper.
    #[inline(always)]
    pub(super) fn slab(self, lower: f32, normal: V3<T>, slab: &SeenSlab<T>, per_speed: T) -> Self {
        self.face(lower + 1.0, normal, slab.over_upper, per_speed)
            .face(lower, -normal, slab.over_lower, per_speed)
    }

    #[inline(always)]
    pub(super) fn surface(self) -> Surface<T> {
        self.found
    }
}

/// Where an upright prism stands and ends: the caps are its faces 0, the bottom, and 1, the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Caps {
    bottom: Vec3,
    top: f32,
}

impl Caps {
    /// The caps at the height of `bottom`, which is a point of the middle line, and at the height `top`; `names` are
    /// those of the two and of their difference.
    pub(super) const fn new(names: [&'static str; 3], bottom: Vec3, top: f32) -> Result<Self, Invalid> {
        match (point(names[0], bottom), coordinate(names[1], top), extent(names[2], top - bottom.y)) {
            (Ok(bottom), Ok(top), Ok(())) => Ok(Self { bottom, top }),
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
        }
    }

    pub(super) const fn bottom(&self) -> Vec3 {
        self.bottom
    }

    pub(super) const fn top(&self) -> f32 {
        self.top
    }

    /// From the middle of the bottom to the point.
    #[inline(always)]
    pub(super) fn to<T: Real>(&self, p: V3<T>) -> V3<T> {
        p - V3::splat(p.x, self.bottom)
    }

    #[inline(always)]
    pub(super) fn seen_from<T: Real>(&self, origin: V3<T>) -> SeenSlab<T> {
        let y = origin.y;
        SeenSlab::between(y, y.splat_like(self.bottom.y), y.splat_like(self.top))
    }

    /// How far the farthest point of the prism is from the world's origin, at most, coordinate by coordinate, where
    /// `reach` is how far it extends from its middle line.
    #[inline(always)]
    pub(super) const fn extent(&self, reach: f32) -> f32 {
        larger(max_norm(self.bottom), self.top.abs()) + reach
    }

    /// The search for the face, at the end of which the caps are looked at.
    #[inline(always)]
    pub(super) fn crossed<T: Real>(crossed: Crossed<T>, caps: &SeenSlab<T>, toward: &Toward<T>) -> Surface<T> {
        let up = V3::splat(toward.vv, Vec3::Y);
        crossed.slab(0.0, up, caps, toward.per_component.y).surface()
    }

    /// The standard signed distance to the prism whose outline, across the axis, is `across` away.
    ///
    /// Source: I. Quilez, Distance functions (extrusion).
    #[inline(always)]
    pub(super) fn distance<T: Real>(&self, across: T, y: T) -> T {
        let zero = y.splat_like(0.0);
        let along = (y.splat_like(self.bottom.y) - y).max(y - y.splat_like(self.top));
        let outside = (across.max(zero).squared() + along.max(zero).squared()).sqrt();
        outside + across.max(along).min(zero)
    }

    /// The bounds of the prism that reaches from `low` to `high` from its middle line, along x and z.
    pub(super) fn bounds(&self, low: [f32; 2], high: [f32; 2]) -> Bounds {
        let at = |reach: [f32; 2]| Vec3::new(self.bottom.x + reach[0], 0.0, self.bottom.z + reach[1]);
        let outline = Bounds::around(at(low), Vec3::ZERO).joined(Bounds::around(at(high), Vec3::ZERO));
        Bounds {
            min: outline.min.with_y(self.bottom.y),
            max: outline.max.with_y(self.top),
        }
    }
}

/// From the nearest point of a segment to a point, in a plane; the segment leads from `(0, 0)` to `side`.
#[inline(always)]
pub(super) fn from_segment<T: Real>((x, y): (T, T), side: (T, T)) -> (T, T) {
    let (zero, one) = (x.splat_like(0.0), x.splat_like(1.0));
    let along = (x * side.0 + y * side.1) / (side.0.squared() + side.1.squared());
    let along = along.max(zero).min(one);
    (x - side.0 * along, y - side.1 * along)
}

#[cfg(test)]
mod tests {
    use crate::leaf::{Ground, HexagonalPrism, Octahedron, Pyramid, Rhombus, Solid, TriangularPrism};
    use crate::ray::Line;
    use crate::toward::Toward;
    use crate::vec3::V3;
    use glam::{Vec3, vec3};

    /// Sends a ray in and a ray out through each face, `depth` away from `middle` along its normal, the faces being in
    /// the order of their numbers; and a ray in from a point that is only said to lie on the face.
    fn check<S: Solid>(solid: &S, middle: Vec3, faces: &[(Vec3, f32)]) {
        for (number, &(outward, depth)) in faces.iter().enumerate() {
            let normal = outward.normalize();
            let from = |distance: f32, direction: Vec3| Line {
                origin: V3::<f64>::from(middle + normal * distance),
                toward: Toward::new(V3::<f64>::from(direction)),
            };
            let near = |found: f64, wanted: f32| assert!((found - f64::from(wanted)).abs() < 1e-5, "face {number}: {found} {wanted}");
            let (inward, outward) = (from(depth + 1.0, -normal), from(0.0, normal));
            let (enter, exit) = (solid.span_along(&inward).enter, solid.span_along(&outward).exit);
            near(enter, 1.0);
            near(exit, depth);
            for (line, t) in [(inward, enter), (outward, exit)] {
                let surface = solid.surface(&solid.seen_from(line.origin), &line.toward, t);
                assert_eq!(surface.face, number as f64);
                near(surface.normal.dot(V3::from(normal)), 1.0);
            }
            let close = from(depth + 0.01, -normal);
            let ground = Ground {
                tolerance: 0.0,
                face: number as f64,
            };
            let seen = solid.grounded(solid.seen_from(close.origin), &ground);
            assert_eq!(solid.span(&seen, &close.toward).enter, 0.0, "face {number}");
            near(solid.span(&seen, &close.toward).exit, (solid.span_along(&close).exit) as f32);
        }
    }

    #[test]
    fn every_face_has_its_number_and_its_normal() {
        let (bottom, middle, slope) = (vec3(1.0, -2.0, 3.0), vec3(1.0, 0.0, 3.0), 0.75_f32.sqrt());
        let caps = [(Vec3::NEG_Y, 2.0), (Vec3::Y, 2.0)];
        let pair = |normal: Vec3, depth: f32| [(-normal, depth), (normal, depth)];

        let sides = [
            pair(Vec3::X, 1.5),
            pair(vec3(0.5, 0.0, slope), 1.5),
            pair(vec3(0.5, 0.0, -slope), 1.5),
        ];
        let nut = HexagonalPrism::new(bottom, 2.0, 1.5).unwrap();
        check(&nut, middle, &[&caps, sides.as_flattened()].concat());

        let sides = [(Vec3::NEG_Z, 1.5), (vec3(slope, 0.0, 0.5), 1.5), (vec3(-slope, 0.0, 0.5), 1.5)];
        let wedge = TriangularPrism::new(bottom, 2.0, 1.5).unwrap();
        check(&wedge, middle, &[&caps[..], &sides].concat());

        let normals = [
            vec3(1.0, 1.0, 1.0),
            vec3(1.0, 1.0, -1.0),
            vec3(1.0, -1.0, 1.0),
            vec3(1.0, -1.0, -1.0),
        ];
        let faces = normals.map(|normal| pair(normal, 3.0_f32.sqrt()));
        check(&Octahedron::new(middle, 3.0).unwrap(), middle, faces.as_flattened());

        // The sides are 2.4 from the middle of the base, and 1.8 from a point one above.
        let sides = [Vec3::NEG_X, Vec3::X, Vec3::NEG_Z, Vec3::Z].map(|out| (out * 4.0 + Vec3::Y * 3.0, 1.8));
        let tomb = Pyramid::new(bottom, 3.0, 4.0).unwrap();
        check(&tomb, bottom + Vec3::Y, &[&[(Vec3::NEG_Y, 1.0)], &sides[..]].concat());

        for rounding in [0.0, 0.5] {
            let sides = [
                pair(vec3(3.0, 0.0, 4.0), 2.4 + rounding),
                pair(vec3(3.0, 0.0, -4.0), 2.4 + rounding),
            ];
            let edges = [pair(Vec3::X, 4.0 + rounding), pair(Vec3::Z, 3.0 + rounding)];
            let edges: &[_] = if rounding == 0.0 { &[] } else { edges.as_flattened() };
            let tile = Rhombus::new(bottom, 2.0, 4.0, 3.0, rounding).unwrap();
            check(&tile, middle, &[&caps, sides.as_flattened(), edges].concat());
        }
    }
}
