//! Rays and points to measure leaves with, made beforehand, half of them hits.

use crate::leaves::ray_kernel;
use glam::Vec3;
use gsdf_nostd::{Real, Solid, V3};
use gsdf_simd::F32x8;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// How many rays and points a leaf is measured with.
pub const COUNT: usize = 8192;

/// The seed they are made from, together with the leaf's name.
pub const SEED: u64 = 0x6753_4446;

/// How far from a facet a point may be that counts as inside.
const NEAR: f32 = 0.25;

/// The probability with which a ray is made to hit, and a point to lie inside.
pub const HIT_RATE: f64 = 0.5;

/// Rays and points around a leaf, in an order in which hits and misses cannot be foreseen.
#[derive(Clone, Debug)]
pub struct Inputs {
    /// Origins outside the leaf, and directions with a largest component of 1 in magnitude.
    pub rays: Vec<(V3<f32>, V3<f32>)>,
    /// Points near the leaf.
    pub points: Vec<V3<f32>>,
    /// The share of the rays that hit.
    pub hit_rate: f64,
    /// The share of the points that lie inside, or near a facet, which has no inside.
    pub inside_rate: f64,
}

impl Inputs {
    /// `count` rays and as many points for a leaf that stands around the world's origin. The same seed and name give the same ones everywhere.
    ///
    /// Rays come from all sides, from a distance of four units, and are aimed into the ball of radius 2 around the leaf; points are uniform in the cube of half-extent 1.5. Whether the
    /// next one is to be a hit is drawn first, then candidates until one is.
    #[must_use]
    pub fn new<S: Solid>(solid: &S, name: &str, count: usize, seed: u64) -> Self {
        let stream = name
            .bytes()
            .fold(seed, |hash, byte| hash.wrapping_mul(0x0100_0000_01b3) ^ u64::from(byte));
        let mut random = Pcg64::seed_from_u64(stream);
        let ray = |random: &mut Pcg64| {
            let (origin, aim) = (4.0 * on_sphere(random), 2.0 * in_ball(random));
            (origin, aim - origin)
        };
        let rays: Vec<(V3<f32>, V3<f32>)> = (0..count)
            .map(|_| {
                let outside = |random: &mut Pcg64| until(|(origin, _)| solid.sdf(*origin) > 0.0, || ray(random));
                let hits = |(origin, direction): &(Vec3, Vec3)| solid.gsdf(*origin, *direction).is_finite();
                let (origin, direction) = half_the_time(&mut random, hits, outside);
                (origin.into(), (direction / direction.abs().max_element()).into())
            })
            .collect();
        let place = |random: &mut Pcg64| 1.5 * in_cube(random);
        let mut scout = Pcg64::seed_from_u64(stream);
        let is_facet = (0..10_000).all(|_| solid.sdf(place(&mut scout)) >= 0.0);
        let depth = if is_facet { NEAR } else { 0.0 };
        let points: Vec<V3<f32>> = (0..count)
            .map(|_| half_the_time(&mut random, |point| solid.sdf(*point) < depth, place).into())
            .collect();
        let share = |hits: usize| hits as f64 / count.max(1) as f64;
        Self {
            hit_rate: share(rays.iter().filter(|(p, v)| ray_kernel(solid, *p, *v).is_finite()).count()),
            inside_rate: share(points.iter().filter(|p| solid.distance(**p) < depth).count()),
            rays,
            points,
        }
    }

    /// The same rays, eight in each. The last few are left out unless their number is a multiple of eight.
    #[must_use]
    pub fn packets_of_rays(&self) -> Vec<(V3<F32x8>, V3<F32x8>)> {
        let (origins, directions): (Vec<_>, Vec<_>) = self.rays.iter().copied().unzip();
        packets(&origins).into_iter().zip(packets(&directions)).collect()
    }

    /// The same points, eight in each. The last few are left out unless their number is a multiple of eight.
    #[must_use]
    pub fn packets_of_points(&self) -> Vec<V3<F32x8>> {
        packets(&self.points)
    }
}

/// The first candidate for which `good` holds.
fn until<T>(good: impl Fn(&T) -> bool, mut candidate: impl FnMut() -> T) -> T {
    loop {
        let candidate = candidate();
        if good(&candidate) {
            return candidate;
        }
    }
}

/// A candidate for which `hit` holds, or does not, by a toss of a coin. Either kind must have a fair share of the candidates.
fn half_the_time<T>(random: &mut Pcg64, hit: impl Fn(&T) -> bool, candidate: impl Fn(&mut Pcg64) -> T) -> T {
    let wanted = random.random_bool(HIT_RATE);
    until(|drawn| hit(drawn) == wanted, || candidate(random))
}

/// Eight vectors as one, again and again.
fn packets(vectors: &[V3<f32>]) -> Vec<V3<F32x8>> {
    let (eights, _) = vectors.as_chunks::<8>();
    let lanes = |eight: &[V3<f32>; 8], of: fn(&V3<f32>) -> f32| F32x8::new(eight.each_ref().map(of));
    (eights.iter())
        .map(|eight| V3::new(lanes(eight, |v| v.x), lanes(eight, |v| v.y), lanes(eight, |v| v.z)))
        .collect()
}

/// A point of the cube of half-extent 1, uniform.
fn in_cube(random: &mut impl Rng) -> Vec3 {
    let mut coordinate = || random.random_range(-1.0_f32..=1.0);
    Vec3::new(coordinate(), coordinate(), coordinate())
}

/// A point of the unit ball, uniform.
fn in_ball(random: &mut impl Rng) -> Vec3 {
    until(|point: &Vec3| point.length_squared() <= 1.0, || in_cube(random))
}

/// A point of the unit sphere, uniform.
fn on_sphere(random: &mut impl Rng) -> Vec3 {
    // Nearer to the centre the direction has lost digits.
    let point = until(|point: &Vec3| point.length_squared() > 1e-4, || in_ball(random));
    point / Real::sqrt(point.length_squared())
}

#[cfg(test)]
mod tests {
    use super::{COUNT, HIT_RATE, Inputs, SEED};
    use crate::leaves::{Visitor, visit_leaves};
    use gsdf_nostd::Solid;

    struct HalfAreHits;

    impl Visitor for HalfAreHits {
        fn leaf<S: Solid>(&mut self, name: &'static str, solid: S) {
            let inputs = Inputs::new(&solid, name, COUNT, SEED);
            assert_eq!((inputs.rays.len(), inputs.points.len()), (COUNT, COUNT));
            for rate in [inputs.hit_rate, inputs.inside_rate] {
                assert!((rate - HIT_RATE).abs() < 0.03, "{name}: {rate}");
            }
            let again = Inputs::new(&solid, name, COUNT, SEED);
            assert_eq!((again.rays, again.points), (inputs.rays, inputs.points), "{name}");
        }
    }

    #[test]
    fn half_of_all_inputs_are_hits_and_the_same_ones_every_time() {
        visit_leaves(&mut HalfAreHits);
    }
}
