//! In every tier a packet gives the bits of its rays by themselves, at every level.

use glam::{Vec3, vec3};
use gsdf_nostd::{Bounded, CappedCylinder, Certificate, Cuboid, Hit, Lane, Node, Plain, Program, Ray, Span, Sphere, certify, leaf_set};
use gsdf_simd::{Double, Fast, Lanes, Level, Packet, Robust, Tier, Work, certificate_of};
use proptest::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

leaf_set! {
    /// One solid of each kind of formula.
    enum Few { Sphere(Sphere), Cuboid(Cuboid), CappedCylinder(CappedCylinder) }
}

/// `((cuboid ∩ sphere) - drum) ∪ sphere`. Few solids: each is compiled in every tier at every level.
fn nodes() -> Vec<Node<Few>> {
    let leaf = |solid: Few| Node::Leaf { solid, frame: 0 };
    vec![
        leaf(Few::Cuboid(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE).unwrap())),
        leaf(Few::Sphere(Sphere::new(vec3(0.1, 0.0, 0.2), 1.35).unwrap())),
        Node::Intersection,
        leaf(Few::CappedCylinder(
            CappedCylinder::new(vec3(0.3, -1.5, 0.0), vec3(0.3, 1.5, 0.0), Vec3::Y, 0.6).unwrap(),
        )),
        Node::Difference,
        leaf(Few::Sphere(Sphere::new(vec3(-1.0, 1.7, 0.4), 0.7).unwrap())),
        Node::Union,
    ]
}

/// Rays from near and far, some along axes and some from within, mostly at the solids.
fn rays(seed: u64, count: usize) -> Vec<Ray> {
    let mut rng = Pcg64::seed_from_u64(seed);
    let mut coordinate = |reach: f32| rng.random_range(-reach..reach);
    (0..count)
        .map(|number| {
            let reach = [1.0, 4.0, 30.0, 1e5][number % 4];
            let origin = vec3(coordinate(reach), coordinate(reach), coordinate(reach));
            let target = vec3(coordinate(1.5), coordinate(1.5), coordinate(1.5));
            let direction = if number % 7 == 0 { Vec3::NEG_Y } else { target - origin };
            Ray::new(origin, direction).unwrap()
        })
        .collect()
}

/// A packet of these rays in every tier.
struct InPackets<'a>(Program<'a, Few>, &'a [Ray]);

/// What each ray hits in a tier, and the certificates.
type Found = ([Vec<Option<Hit>>; 3], Vec<Certificate<f32>>);

impl Work for InPackets<'_> {
    type Output = Found;

    fn run<T: Lanes>(self, token: T::Token) -> Found {
        let tiers = [
            T::vectorize(
                token,
                #[inline(always)]
                || hits::<T, Fast>(token, &self),
            ),
            T::vectorize(
                token,
                #[inline(always)]
                || hits::<T, Robust>(token, &self),
            ),
            T::vectorize(
                token,
                #[inline(always)]
                || hits::<T, Double>(token, &self),
            ),
        ];
        (
            tiers,
            T::vectorize(
                token,
                #[inline(always)]
                || certificates::<T>(token, &self),
            ),
        )
    }
}

#[inline(always)]
fn hits<T: Lanes, A: Tier>(token: T::Token, InPackets(program, rays): &InPackets<'_>) -> Vec<Option<Hit>> {
    let mut spans = vec![Span::empty_like(A::widened(T::splat(token, 0.0))); program.leaves()];
    let mut all = Vec::new();
    for rays in rays.chunks(T::LANES) {
        let found = Packet::<T>::of(token, rays).cast_as::<A, _>(token, program, &mut spans).unwrap();
        all.extend(rays.iter().enumerate().map(|(lane, ray)| found.lane(lane, ray)));
    }
    all
}

#[inline(always)]
fn certificates<T: Lanes>(token: T::Token, InPackets(program, rays): &InPackets<'_>) -> Vec<Certificate<f32>> {
    let mut spans = vec![Span::empty_like(Bounded::exact(T::splat(token, 0.0))); program.leaves()];
    let mut all = Vec::new();
    for rays in rays.chunks(T::LANES) {
        let found = Packet::<T>::of(token, rays).certify(program, &mut spans).unwrap();
        all.extend((0..rays.len()).filter_map(|lane| certificate_of(&found, lane)));
    }
    all
}

fn alone<T: Lane>(program: &Program<'_, Few>, ray: &Ray, like: T) -> Option<Hit> {
    let mut spans = vec![Span::empty_like(like); program.leaves()];
    program.along(*ray, &mut spans).unwrap().cast()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn a_lane_is_a_ray(seed in any::<u64>()) {
        let (nodes, rays) = (nodes(), rays(seed, 203));
        let program = Program::new(&nodes).unwrap();
        for level in Level::available() {
            let (tiers, certificates) = level.run(InPackets(program, &rays));
            for (number, ray) in rays.iter().enumerate() {
                let expected = [
                    alone(&program, ray, Plain(0.0_f32)),
                    alone(&program, ray, 0.0_f32),
                    alone(&program, ray, 0.0_f64),
                ];
                for (found, expected) in tiers.iter().zip(expected) {
                    prop_assert_eq!(found[number], expected, "{} {:?}", level, ray);
                }
                let mut spans = vec![Span::empty_like(Bounded::exact(0.0_f32)); program.leaves()];
                program.spans_along(&ray.line(Bounded::exact(0.0)), gsdf_nostd::Anywhere, &mut spans);
                let own = certify(&nodes, &spans, ray.start_on_line(0.0));
                let lane = certificates[number];
                prop_assert_eq!(lane.sure, own.sure, "{} {:?}", level, ray);
                if own.sure {
                    let said = |it: Certificate<f32>| (it.t, it.leaf, it.at_enter, it.inside);
                    prop_assert_eq!(said(lane), said(own), "{} {:?}", level, ray);
                }
            }
        }
    }
}
