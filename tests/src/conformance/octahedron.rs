//! A leaf as a user of the library writes one, from its public interface alone: the octahedron.

use super::specimen::Specimen;
use crate::shape::{log_uniform, unit};
use glam::{DVec3, Vec3};
use gsdf_nostd::{Bounds, Ground, Real, Solid, Span, Surface, Toward, V3, reciprocal_speed};
use rand::{Rng, RngExt};

/// The points with `|x| + |y| + |z| < r` around a centre: four slabs.
///
/// - Standard: with `q` the absolute coordinates and `m = q.x + q.y + q.z - r`, it is `m / √3` where a face is nearest,
///   else the distance to an edge. Source: I. Quilez, Distance functions.
/// - Along a ray: the intersection of what it sees of the slabs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Octahedron {
    center: Vec3,
    reach: f32,
}

/// An [`Octahedron`] seen from a point: the heights over the two faces of each slab.
#[derive(Clone, Copy, Debug)]
pub struct SeenOctahedron<T> {
    over_lower: [T; 4],
    over_upper: [T; 4],
}

/// The normals of the slabs, as signs of the coordinates.
const SLABS: [Vec3; 4] = [
    Vec3::new(1.0, 1.0, 1.0),
    Vec3::new(-1.0, 1.0, 1.0),
    Vec3::new(1.0, -1.0, 1.0),
    Vec3::new(1.0, 1.0, -1.0),
];

/// `1 / √3`: what the heights, taken with signs for normals, exceed the distances by.
const PER_ROOT_THREE: f32 = 0.577_350_26;

impl Octahedron {
    /// The octahedron around `center` whose corners are `reach` away.
    #[must_use]
    pub const fn new(center: Vec3, reach: f32) -> Self {
        Self { center, reach }
    }

    /// A random one.
    pub fn specimen(rng: &mut impl Rng) -> Specimen<Self> {
        let size = log_uniform(rng, 1e-2, 1e3);
        let center = (unit(rng) * size * rng.random_range(0.0..4.0)).as_vec3();
        let reach = (size * log_uniform(rng, 0.1, 2.0)) as f32;
        let surface = (0..Specimen::<Self>::POINTS).map(|_| {
            let mut sign = || if rng.random() { 1.0 } else { -1.0 };
            let signs = DVec3::new(sign(), sign(), sign());
            let shares = DVec3::new(rng.random_range(0.0..1.0), rng.random_range(0.0..1.0), rng.random_range(0.0..1.0));
            let place = signs * shares / shares.element_sum() * f64::from(reach);
            (center.as_dvec3() + place, signs / 3.0_f64.sqrt())
        });
        Specimen {
            surface: surface.collect(),
            solid: Self::new(center, reach),
            size,
        }
    }

    /// What a ray at these heights and this speed sees of one slab.
    fn slab<T: Real>(over_lower: T, over_upper: T, speed: T) -> Span<T> {
        let per_speed = reciprocal_speed(speed);
        let (lower, upper) = (-over_lower * per_speed, -over_upper * per_speed);
        let falling = per_speed.lt(speed.splat_like(0.0));
        Span::between(T::select(falling, upper, lower), T::select(falling, lower, upper))
    }

    fn speed<T: Real>(slab: usize, v: V3<T>) -> T {
        v.dot(V3::splat(v.x, SLABS[slab]))
    }
}

impl Solid for Octahedron {
    type Seen<T: Real> = SeenOctahedron<T>;

    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let (zero, half, three) = (p.x.splat_like(0.0), p.x.splat_like(0.5), p.x.splat_like(3.0));
        let reach = p.x.splat_like(self.reach);
        let w = p - V3::splat(p.x, self.center);
        let q = V3::new(w.x.abs(), w.y.abs(), w.z.abs());
        let m = (q.x + q.y + q.z) - reach;
        // Where one coordinate is so small that the foot lies on the edge without it.
        let nearer = |coordinate: T| (coordinate * three).lt(m);
        let by_z = V3::select(nearer(q.z), V3::new(q.z, q.x, q.y), V3::new(zero, zero, zero));
        let by_y = V3::select(nearer(q.y), V3::new(q.y, q.z, q.x), by_z);
        let edge = V3::select(nearer(q.x), q, by_y);
        let along = (half * ((edge.z - edge.y) + reach)).max(zero).min(reach);
        let to_edge = V3::new(edge.x, (edge.y - reach) + along, edge.z - along).norm();
        let at_edge = nearer(q.x) | nearer(q.y) | nearer(q.z);
        T::select(at_edge, to_edge, m * p.x.splat_like(PER_ROOT_THREE))
    }

    fn seen_from<T: Real>(&self, origin: V3<T>) -> SeenOctahedron<T> {
        let w = origin - V3::splat(origin.x, self.center);
        let reach = origin.x.splat_like(self.reach);
        let heights = [0, 1, 2, 3].map(|slab| Self::speed(slab, w));
        SeenOctahedron {
            over_lower: heights.map(|height| height + reach),
            over_upper: heights.map(|height| height - reach),
        }
    }

    fn lift<T: Real>(seen: &SeenOctahedron<T::Scalar>, like: T) -> SeenOctahedron<T> {
        SeenOctahedron {
            over_lower: seen.over_lower.map(|height| like.lift_like(height)),
            over_upper: seen.over_upper.map(|height| like.lift_like(height)),
        }
    }

    fn grounded<T: Real>(&self, seen: SeenOctahedron<T>, ground: &Ground<T>) -> SeenOctahedron<T> {
        let like = ground.face;
        let extent = like.splat_like(self.reach + self.center.abs().element_sum());
        // A height is √3 times a distance; 2 is more.
        let settle = |face: usize, height: T| ground.settle(face as f32, height, like.splat_like(2.0), extent);
        SeenOctahedron {
            over_lower: [0, 1, 2, 3].map(|slab| settle(2 * slab, seen.over_lower[slab])),
            over_upper: [0, 1, 2, 3].map(|slab| settle(2 * slab + 1, seen.over_upper[slab])),
        }
    }

    fn span<T: Real>(&self, seen: &SeenOctahedron<T>, toward: &Toward<T>) -> Span<T> {
        let [a, b, c, d] = [0, 1, 2, 3].map(|slab| Self::slab(seen.over_lower[slab], seen.over_upper[slab], Self::speed(slab, toward.v)));
        a.intersection(b).intersection(c.intersection(d))
    }

    /// Faces `2 k` and `2 k + 1`: the lower and the upper one of slab `k`.
    fn surface<T: Real>(&self, seen: &SeenOctahedron<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        let face = |number: usize, normal: Vec3| Surface {
            normal: V3::splat(t, normal * PER_ROOT_THREE),
            face: t.splat_like(number as f32),
        };
        let mut found = face(0, -SLABS[0]);
        for slab in [0, 1, 2, 3] {
            let per_speed = reciprocal_speed(Self::speed(slab, toward.v));
            let at = |height: T| (-height * per_speed).eq(t);
            found = face(2 * slab, -SLABS[slab]).or_else(at(seen.over_lower[slab]), found);
            found = face(2 * slab + 1, SLABS[slab]).or_else(at(seen.over_upper[slab]), found);
        }
        found
    }

    fn bounds(&self) -> Option<Bounds> {
        Some(Bounds::around(self.center, Vec3::splat(self.reach)))
    }
}
