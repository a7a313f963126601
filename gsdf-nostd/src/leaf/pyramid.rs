//! The square pyramid.

use super::polyhedron::{Crossed, Within, from_segment};
use super::solid::{Bounds, Ground, Solid, Surface};
use crate::invalid::{Invalid, length, point};
use crate::range::{larger, max_norm, unit_scale};
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The upright pyramid over a square whose sides are parallel to x and z; turn it with a
/// [`Transform`](crate::Transform).
///
#[cfg_attr(doc, doc = include_str!("../../pictures/pyramid.md"))]
///
/// - Standard: by symmetry the nearest side is known; to its triangle, in the coordinates of its plane, or to the base,
///   exact. Source: I. Quilez, Distance functions (pyramid); to the base, which his leaves out, and with the slant
///   normalized.
/// - Along a ray: the last entry into and the first exit from five half-spaces, the sides' heights being taken from
///   the apex.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: fifteen products and four divisions;
///   one more division belongs to the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pyramid {
    base: Vec3,
    half_width: f32,
    height: f32,
    /// The power of two that brings the larger of half width and height into [1, 2).
    scale: f32,
}

/// A [`Pyramid`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenPyramid<T> {
    over_base: T,
    /// Heights over the sides, in the order of the faces.
    over: [T; 4],
}

impl Pyramid {
    /// The pyramid over the square around `base` that reaches `half_width` from there along x and z, with its apex
    /// `height` above.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, or one of the lengths is not from 2^-20 to 2^30.
    pub const fn new(base: Vec3, half_width: f32, height: f32) -> Result<Self, Invalid> {
        match (
            point("pyramid base", base),
            length("pyramid half width", half_width),
            length("pyramid height", height),
        ) {
            (Ok(base), Ok(half_width), Ok(height)) => Ok(Self {
                base,
                half_width,
                height,
                scale: unit_scale(larger(half_width, height)),
            }),
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
        }
    }

    /// The middle of the base.
    #[must_use]
    pub const fn base(&self) -> Vec3 {
        self.base
    }

    /// Half the length of the base's sides.
    #[must_use]
    pub const fn half_width(&self) -> f32 {
        self.half_width
    }

    /// The height of the apex over the base.
    #[must_use]
    pub const fn height(&self) -> f32 {
        self.height
    }

    /// The components of the sides' normals, across the axis and along it: height and half width, scaled.
    #[inline(always)]
    fn normal<T: Real>(&self, like: T) -> (T, T) {
        let scale = like.splat_like(self.scale);
        (like.splat_like(self.height) * scale, like.splat_like(self.half_width) * scale)
    }

    /// The sides' normals, made of unit length.
    #[inline(always)]
    fn unit_normal<T: Real>(&self, like: T) -> (T, T) {
        let (across, along) = self.normal(like);
        let length = (across.squared() + along.squared()).sqrt();
        (across / length, along / length)
    }

    /// The products of a vector with the sides' normals, in the order of the faces.
    #[inline(always)]
    fn sides<T: Real>(&self, v: V3<T>) -> [T; 4] {
        let (across, along) = self.normal(v.x);
        let (x, y, z) = (v.x * across, v.y * along, v.z * across);
        [y - x, y + x, y - z, y + z]
    }
}

impl Solid for Pyramid {
    type Seen<T: Real> = SeenPyramid<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let zero = p.x.splat_like(0.0);
        let (half_width, height) = (zero.splat_like(self.half_width), zero.splat_like(self.height));
        let (across, along) = self.unit_normal(zero);
        let w = p - V3::splat(zero, self.base);
        // Turned and mirrored to the side towards +x and its half towards +z.
        let (x, z) = (w.x.abs(), w.z.abs());
        let (x, z) = (x.max(z) - half_width, x.min(z) - half_width);
        // In the plane of the side from the middle of the base's edge: upward, and over it.
        let (up, over) = (w.y * across - x * along, x * across + w.y * along);
        let slant = height * across + half_width * along;
        // From the base's edge and from the side's oblique one, each as far as it goes.
        let base_edge = z.max(zero).squared() + up.squared();
        let (off_z, off_up) = from_segment((z, up), (-half_width, slant));
        let side_edge = off_z.squared() + off_up.squared();
        let foot_inside = zero.lt(up) & (z * slant + up * half_width).lt(zero);
        let in_plane = T::select(foot_inside, zero, base_edge.min(side_edge));
        let outside = (in_plane + over.squared()).sqrt();
        // Inside, and below the base, the nearest point is in the plane of a face.
        let deepest = over.max(-w.y);
        let plain = deepest.lt(zero) | (x.le(zero) & w.y.le(zero));
        T::select(plain, deepest, outside)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let w = origin - V3::splat(origin.x, self.base);
        let from_apex = V3::new(w.x, w.y - w.y.splat_like(self.height), w.z);
        SeenPyramid {
            over_base: w.y,
            over: self.sides(from_apex),
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        let [a, b, c, d] = seen.over;
        SeenPyramid {
            over_base: like.lift_like(seen.over_base),
            over: [like.lift_like(a), like.lift_like(b), like.lift_like(c), like.lift_like(d)],
        }
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let one = ground.face.splat_like(1.0);
        let (across, along) = self.normal(one);
        let scale = (across.squared() + along.squared()).sqrt();
        let extent = one.splat_like(max_norm(self.base) + larger(self.half_width, self.height));
        let [a, b, c, d] = seen.over;
        SeenPyramid {
            over_base: ground.settle(0.0, seen.over_base, one, extent),
            over: [
                ground.settle(1.0, a, scale, extent),
                ground.settle(2.0, b, scale, extent),
                ground.settle(3.0, c, scale, extent),
                ground.settle(4.0, d, scale, extent),
            ],
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let [a, b, c, d] = self.sides(toward.v);
        Within::below(-seen.over_base, -toward.per_component.y)
            .and_below(seen.over[0], reciprocal_speed(a))
            .and_below(seen.over[1], reciprocal_speed(b))
            .and_below(seen.over[2], reciprocal_speed(c))
            .and_below(seen.over[3], reciprocal_speed(d))
            .span()
    }

    /// Face 0 is the base, 1 to 4 are the sides towards -x, +x, -z and +z. On an edge and at the apex the first of the
    /// faces that meet there.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let zero = t.splat_like(0.0);
        let [a, b, c, _] = self.sides(toward.v);
        let (across, along) = self.unit_normal(t);
        let last = Surface {
            normal: V3::new(zero, along, across),
            face: t.splat_like(4.0),
        };
        Crossed::at(t, last)
            .face(3.0, V3::new(zero, along, -across), seen.over[2], reciprocal_speed(c))
            .face(2.0, V3::new(across, along, zero), seen.over[1], reciprocal_speed(b))
            .face(1.0, V3::new(-across, along, zero), seen.over[0], reciprocal_speed(a))
            .face(0.0, V3::splat(t, Vec3::NEG_Y), seen.over_base, toward.per_component.y)
            .surface()
    }

    fn grown(&self, by: f32) -> Option<Self> {
        let side = libm::sqrtf(self.half_width * self.half_width + self.height * self.height);
        // As the sides move out across themselves the apex rises.
        let height = self.height + by + by * side / self.half_width;
        Self::new(self.base - Vec3::Y * by, self.half_width * height / self.height, height).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        let base = Bounds::around(self.base, Vec3::new(self.half_width, 0.0, self.half_width));
        Some(Bounds {
            min: base.min.with_y(self.base.y),
            max: base.max.with_y((self.base.y + self.height).next_up()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Pyramid;
    use crate::leaf::Solid;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        // The sides fall by 4 over 3: their normals are (4, 3) / 5.
        let tomb = Pyramid::new(vec3(1.0, -1.0, 0.0), 3.0, 4.0).unwrap();
        let near = |found: f32, wanted: f32| assert!((found - wanted).abs() < 1e-6, "{found} {wanted}");
        // Above, below, beyond an edge and a corner of the base, and over a side.
        near(tomb.sdf(vec3(1.0, 5.0, 0.0)), 2.0);
        near(tomb.sdf(vec3(2.0, -3.0, 2.0)), 2.0);
        near(tomb.sdf(vec3(8.0, -4.0, 1.0)), 5.0);
        near(tomb.sdf(vec3(5.0, -3.0, -4.0)), 6.0_f32.sqrt());
        near(tomb.sdf(vec3(2.5 + 4.0, 1.0 + 3.0, 0.0)), 5.0);
        near(tomb.sdf(vec3(1.0, 1.0 + 3.0, -1.5 - 4.0)), 5.0);
        // Inside, near the base and a side.
        near(tomb.sdf(vec3(1.0, -0.75, 0.0)), -0.25);
        near(tomb.sdf(vec3(1.0, 2.0, 0.0)), -0.6);
        // Each side, along its normal's foot; the base; up to the apex and past it.
        for out in [Vec3::X, Vec3::NEG_X, Vec3::Z, Vec3::NEG_Z] {
            near(tomb.gsdf(vec3(1.0, 1.0, 0.0) + 9.0 * out, -out), 7.5);
            near(tomb.gsdf(vec3(1.0, 1.0, 0.0), out), -1.5);
        }
        assert_eq!(tomb.gsdf(vec3(1.0, -9.0, 1.0), Vec3::Y), 8.0);
        assert_eq!(tomb.gsdf(vec3(1.0, 0.0, 0.0), Vec3::NEG_Y), -1.0);
        assert_eq!(tomb.gsdf(vec3(9.0, 3.5, 0.0), Vec3::NEG_X), f32::INFINITY);
        assert_eq!(tomb.gsdf(vec3(9.0, -1.5, 0.0), Vec3::NEG_X), f32::INFINITY);
        // In the base, and in a side.
        assert_eq!(tomb.gsdf(vec3(9.0, -1.0, 0.0), Vec3::NEG_X), f32::INFINITY);
        assert_eq!(tomb.gsdf(vec3(4.0, -1.0, 0.0), vec3(-3.0, 4.0, 0.0)), f32::INFINITY);
    }
}
