//! The rounded cone: the convex hull of two spheres.

use super::conical_side::{Profile, SeenCone};
use super::plane;
use super::solid::{Bounds, Ground, Solid, Surface};
use super::sphere::{SeenSphere, Sphere};
use crate::invalid::{Fault, Invalid, length, point};
use crate::range::{MIN_LENGTH, larger, max_norm, unit_scale};
use crate::real::Real;
use crate::span::Span;
use crate::toward::{Toward, reciprocal_speed};
use crate::vec3::V3;
use glam::Vec3;

/// The convex hull of two spheres: a cone with round ends that goes over into them without an edge. With equal radii
/// it is a [`Capsule`](super::Capsule).
///
#[cfg_attr(doc, doc = include_str!("../../pictures/rounded_cone.md"))]
///
/// With `d` from the one centre to the other, `D = r_a - r_b` and `K = √(d.d - D²)`, the side touches the spheres
/// along the circles in the planes `w.d = r D`, `w` measured from the sphere's own centre, and between these holds
/// `K |w x d| < r_a d.d - D w.d`, measured from the first.
///
/// - Standard: the distance from the sphere or the side that faces the point, exact. Source: I. Quilez, Distance
///   functions (round cone).
/// - Along a ray: the union of two whole spheres and the side between the circles is convex, so the least entry and
///   the last exit of the three. Whole spheres touch the side along the circles: there is no seam to miss.
/// - Accuracy: 8 rounding errors, as the [crate](crate#accuracy) counts them. Cost: two spheres and a capped cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundedCone {
    ends: [Sphere; 2],
    /// The power of two that brings the axis from the one centre to the other near unit length.
    scale: f32,
}

/// A [`RoundedCone`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenRoundedCone<T> {
    ends: [SeenSphere<T>; 2],
    side: SeenCone<T>,
    /// Heights over the planes of the circles along which the side touches the spheres, along the axis.
    over: [T; 2],
}

impl RoundedCone {
    /// The hull of the sphere around `a` with `a_radius` and the one around `b` with `b_radius`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, a radius is not from 2^-20 to 2^30, the centres are nearer
    /// than 2^-20, or one sphere contains the other, or all of it but a last 2^-21 of the distance of the centres:
    /// then it is the larger [`Sphere`].
    pub const fn new(a: Vec3, b: Vec3, a_radius: f32, b_radius: f32) -> Result<Self, Invalid> {
        match (point("rounded cone a", a), point("rounded cone b", b)) {
            (Ok(_), Ok(_)) => {}
            (Err(error), _) | (_, Err(error)) => return Err(error),
        }
        match (length("rounded cone a radius", a_radius), length("rounded cone b radius", b_radius)) {
            (Ok(_), Ok(_)) => {}
            (Err(error), _) | (_, Err(error)) => return Err(error),
        }
        let reach = max_norm(Vec3::new(b.x - a.x, b.y - a.y, b.z - a.z));
        if reach < MIN_LENGTH {
            return Err(Invalid::new("distance between rounded cone centers", reach, Fault::TooSmall));
        }
        let (x, y, z) = (b.x as f64 - a.x as f64, b.y as f64 - a.y as f64, b.z as f64 - a.z as f64);
        let difference = a_radius as f64 - b_radius as f64;
        let apart_squared = x * x + y * y + z * z;
        let tangent_squared = apart_squared - difference * difference;
        if tangent_squared < apart_squared * LEAST_SLOPE_SQUARED {
            return Err(Invalid::new(
                "rounded cone: squared length of the side",
                tangent_squared as f32,
                Fault::Contained,
            ));
        }
        Ok(Self {
            ends: [Sphere::from_valid(a, a_radius), Sphere::from_valid(b, b_radius)],
            scale: unit_scale(reach),
        })
    }

    /// The centres of the two spheres.
    #[must_use]
    pub const fn ends(&self) -> [Vec3; 2] {
        [self.ends[0].center(), self.ends[1].center()]
    }

    /// The radii of the two spheres.
    #[must_use]
    pub const fn radii(&self) -> [f32; 2] {
        [self.ends[0].radius(), self.ends[1].radius()]
    }

    /// From the first centre to the second, and the first radius less the second, both times the same power of two.
    #[inline(always)]
    fn axis_and_taper<T: Real>(&self, like: T) -> (V3<T>, T) {
        let [a, b] = self.ends();
        let [a_radius, b_radius] = self.radii();
        let scale = like.splat_like(self.scale);
        let axis = (V3::splat(like, b) - V3::splat(like, a)).scaled(scale);
        (axis, (like.splat_like(a_radius) - like.splat_like(b_radius)) * scale)
    }

    /// The side, from the first centre.
    #[inline(always)]
    fn profile<T: Real>(&self, like: T) -> Profile<T> {
        let (axis, taper) = self.axis_and_taper(like);
        let axis_squared = axis.norm_squared();
        Profile {
            axis,
            r: like.splat_like(self.ends[0].radius()) * axis_squared,
            s: -taper,
            k: (axis_squared - taper.squared()).sqrt(),
        }
    }
}

/// The least the square of the side's length may be as a share of that of the distance of the centres, so that it
/// stays positive in every arithmetic: 2^-20.
const LEAST_SLOPE_SQUARED: f64 = 1.0 / 1_048_576.0;

/// How far an origin is over the plane in which the side touches the sphere around an end, along the profile's axis.
#[inline(always)]
fn over<T: Real>(end: &Sphere, profile: &Profile<T>, origin: V3<T>) -> T {
    let w = origin - V3::splat(origin.x, end.center());
    w.dot(profile.axis) + origin.x.splat_like(end.radius()) * profile.s
}

impl Solid for RoundedCone {
    type Seen<T: Real> = SeenRoundedCone<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let like = p.x;
        let Profile { axis, s, k, .. } = self.profile(like);
        let [a, b] = self.ends();
        let (from_a, from_b) = (p - V3::splat(like, a), p - V3::splat(like, b));
        let across = from_a.cross(axis).norm();
        // Along the side, from where it touches either sphere.
        let past_a = s * across + k * from_a.dot(axis);
        let past_b = s * across + k * from_b.dot(axis);
        let to_side = (k * across - s * from_a.dot(axis)) / axis.norm_squared() - like.splat_like(self.ends[0].radius());
        let zero = like.splat_like(0.0);
        let to_end = T::select(past_a.lt(zero), self.ends[0].distance(p), self.ends[1].distance(p));
        T::select(past_a.lt(zero) | zero.lt(past_b), to_end, to_side)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        let like = origin.x;
        let profile = self.profile(like);
        SeenRoundedCone {
            ends: [self.ends[0].seen_from(origin), self.ends[1].seen_from(origin)],
            side: SeenCone::new(origin - V3::splat(like, self.ends[0].center()), &profile),
            over: [over(&self.ends[0], &profile, origin), over(&self.ends[1], &profile, origin)],
        }
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        SeenRoundedCone {
            ends: [Sphere::lift(&seen.ends[0], like), Sphere::lift(&seen.ends[1], like)],
            side: SeenCone::lift(&seen.side, like),
            over: [like.lift_like(seen.over[0]), like.lift_like(seen.over[1])],
        }
    }

    /// The three parts meet smoothly, so an origin on the surface may be near all of them: each is settled by itself.
    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        let like = ground.face;
        let [a, b] = self.ends();
        let [a_radius, b_radius] = self.radii();
        let extent = like.splat_like(larger(a_radius, b_radius) + larger(max_norm(a), max_norm(b)));
        let profile = self.profile(like);
        // The side measures in units of an axis that is not of unit length.
        let unit = profile.axis.norm();
        let by_side = Ground {
            tolerance: ground.tolerance * unit,
            ..*ground
        };
        SeenRoundedCone {
            ends: [
                self.ends[0].grounded(seen.ends[0], &ground.of_part(1.0)),
                self.ends[1].grounded(seen.ends[1], &ground.of_part(2.0)),
            ],
            side: seen.side.grounded(&profile, &by_side, 0.0, extent * unit),
            over: seen.over,
        }
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        let profile = self.profile(toward.vv);
        let slab = plane::slab(seen.over[0], seen.over[1], reciprocal_speed(toward.v.dot(profile.axis)));
        let side = seen.side.span(&profile, toward);
        let first = self.ends[0].span(&seen.ends[0], toward);
        let second = self.ends[1].span(&seen.ends[1], toward);
        // All of it is within the side, endless as that is: a ray that leaves the side beside a seam does not meet the
        // sphere again that touches it there.
        side.intersection(slab).hull(first).hull(second).intersection(side)
    }

    /// Face 0 is the side, 1 the sphere around the first centre, 2 that around the second.
    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let at_first = self.ends[0].span(&seen.ends[0], toward).ends_at(t);
        let at_second = self.ends[1].span(&seen.ends[1], toward).ends_at(t);
        let first = Surface::of_face(1.0, self.ends[0].surface(&seen.ends[0], toward, t).normal);
        let second = Surface::of_face(2.0, self.ends[1].surface(&seen.ends[1], toward, t).normal);
        let profile = self.profile(t);
        // The slope in units of the axis, which is not of unit length.
        let by_axis = Profile {
            k: profile.k * profile.axis.norm(),
            ..profile
        };
        let side = Surface::of_face(0.0, seen.side.normal(&by_axis, toward, t));
        first.or_else(at_first, second.or_else(at_second, side))
    }

    fn divides_by_components(&self) -> bool {
        false
    }

    fn grown(&self, by: f32) -> Option<Self> {
        let ([a, b], [a_radius, b_radius]) = (self.ends(), self.radii());
        Self::new(a, b, a_radius + by, b_radius + by).ok()
    }

    fn bounds(&self) -> Option<Bounds> {
        let [first, second] = self.ends.map(|end| end.bounds());
        first.zip(second).map(|(first, second)| first.joined(second))
    }
}

#[cfg(test)]
mod tests {
    use super::RoundedCone;
    use crate::leaf::Solid;
    use crate::ray::Line;
    use crate::toward::Toward;
    use crate::vec3::V3;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        // Centres 5 apart, radii 4 and 1: the side's slope is 3 : 4, and it touches the spheres at (3.2, 2.4) and (0.8, 5.6).
        let skittle = RoundedCone::new(Vec3::ZERO, vec3(0.0, 5.0, 0.0), 4.0, 1.0).unwrap();
        assert_eq!(skittle.sdf(vec3(0.0, 8.0, 0.0)), 2.0);
        assert_eq!(skittle.sdf(vec3(0.0, -7.0, 0.0)), 3.0);
        // Two beyond the middle of the side, and inside, two below it.
        assert!((skittle.sdf(vec3(2.0 + 1.6, 4.0 + 1.2, 0.0)) - 2.0).abs() < 1e-6);
        assert!((skittle.sdf(vec3(2.0 - 1.6, 4.0 - 1.2, 0.0)) + 2.0).abs() < 1e-6);
        assert_eq!(skittle.sdf(vec3(0.0, -1.0, 0.0)), -3.0);
        // The side, both spheres, from end to end, and past it.
        assert!((skittle.gsdf(vec3(9.0, 4.0, 0.0), Vec3::NEG_X) - 7.0).abs() < 1e-6);
        assert_eq!(skittle.gsdf(vec3(9.0, 0.0, 0.0), Vec3::NEG_X), 5.0);
        assert_eq!(skittle.gsdf(vec3(0.0, 9.0, 0.0), Vec3::NEG_Y), 3.0);
        assert_eq!(skittle.gsdf(vec3(0.0, 5.5, 0.0), Vec3::NEG_Y), -9.5);
        assert_eq!(skittle.gsdf(vec3(9.0, 6.5, 0.0), Vec3::NEG_X), f32::INFINITY);
        assert_eq!(skittle.gsdf(vec3(9.0, -4.5, 0.0), Vec3::NEG_X), f32::INFINITY);
    }

    #[test]
    fn normals_go_over_from_sphere_to_side() {
        let skittle = RoundedCone::new(Vec3::ZERO, vec3(0.0, 5.0, 0.0), 4.0, 1.0).unwrap();
        // On the side, and where it touches the first sphere, from where the line to that centre is the normal.
        for height in [4.0, 2.41, 2.39] {
            let line = Line {
                origin: V3::<f32>::from(vec3(9.0, height, 0.0)),
                toward: Toward::new(V3::from(Vec3::NEG_X)),
            };
            let seen = skittle.seen_from(line.origin);
            let enter = skittle.span(&seen, &line.toward).enter;
            let normal = Vec3::from(skittle.surface(&seen, &line.toward, enter).normal);
            assert!((normal - vec3(0.8, 0.6, 0.0)).length() < 0.01, "{normal}");
        }
    }

    #[test]
    fn a_sphere_within_the_other_is_refused() {
        let cone = |b_radius| RoundedCone::new(Vec3::ZERO, Vec3::X, 3.0, b_radius);
        assert!(cone(2.0).is_err() && cone(4.0).is_err() && cone(1.5).is_err());
        assert!(cone(2.0 + 1e-5).is_ok() && cone(4.0 - 1e-5).is_ok());
    }
}
