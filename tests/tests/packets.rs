//! Packets against scalar queries, on every level and bit for bit: on random programs, the reference scenes and a user's
//! own leaf type, with lanes that hit, miss, start inside, have a range, or hold no ray at all, side by side.

use core::fmt::Debug;
use glam::{Vec3, vec3};
use gsdf_demo::scenes;
use gsdf_nostd::{
    Camera, Field, HalfSpace, Hit, Node, Program, ProgramError, Raster, Ray, Solid, Span, Sphere, SphereTracer, V3, csg, leaf_set,
};
use gsdf_simd::{F32x8, LaneMask, Lanes, Level, Packet, Work, scratch};
use gsdf_tests::conformance::octahedron::Octahedron;
use gsdf_tests::conformance::packet::{Asked, Composed, Count, bits, check, packet, scalar_hit};
use gsdf_tests::conformance::specimen::wild;
use gsdf_tests::shape::{log_uniform, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

#[test]
fn random_programs_are_the_same_in_packets() {
    let count = (0..4000_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let composed = Composed::random(&mut rng);
        let program = composed.program();
        let asked = core::array::from_fn(|_| composed.aimed(&mut rng).varied(&mut rng, &program));
        check(&program, &asked)
    });
    count.reduce(Count::default, Count::joined).assert_quotas();
}

/// A ray at a random leaf of a program, from afar or from its middle.
fn aimed_at_leaf<L: Solid>(rng: &mut Pcg64, program: &Program<'_, L>) -> Asked {
    let solids: Vec<_> = program
        .nodes()
        .iter()
        .filter_map(|node| if let Node::Leaf { solid, .. } = node { Some(*solid) } else { None })
        .collect();
    let bounds = solids[rng.random_range(0..solids.len())].bounds();
    let (center, size) = bounds.map_or((Vec3::ZERO, 1.0), |bounds| {
        ((bounds.min + bounds.max) * 0.5, (bounds.max - bounds.min).length())
    });
    let about = |rng: &mut Pcg64, size: f32| unit(rng).as_vec3() * size * rng.random_range(0.0_f32..1.0);
    if rng.random_range(0..4) == 0 {
        Asked::new(center + about(rng, 0.4 * size), unit(rng).as_vec3())
    } else {
        let origin = center + about(rng, 50.0 * size);
        let target = center + about(rng, 0.8 * size);
        Asked::new(
            origin,
            if rng.random_range(0..3) == 0 {
                origin - target
            } else {
                target - origin
            },
        )
    }
}

fn check_at_leaves<L: Solid + Debug + Sync>(program: &Program<'_, L>, packets: u64) {
    let count = (0..packets).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        check(
            program,
            &core::array::from_fn(|_| aimed_at_leaf(&mut rng, program).varied(&mut rng, program)),
        )
    });
    count.reduce(Count::default, Count::joined).assert_quotas();
}

#[test]
fn reference_scenes_are_the_same_in_packets() {
    for scene in [scenes::s1(), scenes::s2(), scenes::s3(), scenes::s4(), scenes::s5()] {
        let program = scene.program().unwrap();
        check_at_leaves(&program, if program.leaves() < 100 { 4000 } else { 400 });
    }
}

leaf_set! {
    /// A leaf type of a user's.
    pub enum Gem { Sphere(Sphere), Octahedron(Octahedron) }
}

#[test]
fn a_leaf_of_ones_own_is_the_same_in_packets() {
    let nodes = [
        Node::leaf(Gem::from(Octahedron::new(Vec3::ZERO, 1.5))),
        Node::leaf(Gem::from(Sphere::new(vec3(0.5, 0.5, 0.0), 0.75).unwrap())),
        Node::Difference,
        Node::leaf(Gem::from(Octahedron::new(vec3(2.0, 0.0, 0.5), 1.0))),
        Node::Union,
    ];
    check_at_leaves(&Program::new(&nodes).unwrap(), 4000);
}

/// Rays of the wildest numbers: the ends of what a ray may be, parameters that overflow, ranges that underflow.
#[test]
fn rays_at_the_ends_of_their_range_are_the_same_in_packets() {
    let ground: [Node; 1] = [Node::leaf(HalfSpace::new(Vec3::ZERO, Vec3::Y).unwrap().into())];
    let ground = Program::new(&ground).unwrap();
    let slow = |exponent: i32| Asked::new(vec3(0.0, 1e9, 0.0), vec3(1e-12, -1e-12 * 2.0_f32.powi(exponent), 0.0));
    let fast = |end: f32| Asked {
        range: 0.0..end,
        ..Asked::new(vec3(0.0, 1.3e-26, 0.0), vec3(0.0, -1.0995e12, 0.0))
    };
    let hit = scalar_hit(&ground, fast(1.0).ray().unwrap()).unwrap().t;
    assert!((f32::MIN_POSITIVE..1.01 * f32::MIN_POSITIVE).contains(&hit));
    // What is nearer than the least normal number is past.
    let faster = Asked::new(vec3(0.0, 1.000_001e-31, 0.0), vec3(0.0, -1.0995e12, 0.0));
    assert_eq!(scalar_hit(&ground, faster.ray().unwrap()), None);
    check(
        &ground,
        &[
            slow(-40),
            slow(-70),
            slow(-95),
            fast(1.0),
            fast(hit),
            fast(hit.next_up()),
            fast(hit.next_down()),
            faster,
        ],
    );

    for seed in 0..2000 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let composed = Composed::random(&mut rng);
        let asked = core::array::from_fn(|_| {
            let (aim, (origin, direction)) = (composed.aimed(&mut rng), wild(&mut rng));
            let aim = match rng.random_range(0..3) {
                0 => Asked::new(origin, direction),
                1 => Asked { origin, ..aim },
                _ => Asked { direction, ..aim },
            };
            aim.varied(&mut rng, &composed.program())
        });
        check(&composed.program(), &asked);
    }
}

/// What one lane finds does not depend on its neighbours, nor on which lane it is.
#[test]
fn lanes_do_not_see_each_other() {
    let scene = scenes::s2();
    let program = scene.program().unwrap();
    let mut rng = Pcg64::seed_from_u64(5);
    for _ in 0..500 {
        let asked: [Asked; 8] = core::array::from_fn(|_| aimed_at_leaf(&mut rng, &program).varied(&mut rng, &program));
        let alone = asked[0].clone();
        let nothing = alone.clone().spoilt(&mut rng);
        for lane in 0..8 {
            for others in [&alone, &nothing, &asked[7]] {
                let mut packet = [0; 8].map(|_| others.clone());
                packet[lane] = alone.clone();
                check(&program, &packet);
            }
        }
    }
}

struct Tracing<'a> {
    tracer: &'a SphereTracer,
    program: &'a Program<'a>,
    asked: &'a [Asked; 8],
}

impl Work for Tracing<'_> {
    /// Of each lane how many steps the packet took, the parameter, whether it hit, and whether it is undecided.
    type Output = Vec<(u32, (f32, bool, bool))>;

    fn run<T: Lanes>(self, token: T::Token) -> Self::Output {
        let packet = packet::<T>(token, self.asked);
        let traced = T::vectorize(
            token,
            #[inline(always)]
            || packet.trace(self.tracer, self.program),
        );
        let is = |mask: T::Mask, lane: usize| mask.to_bits() >> lane & 1 == 1;
        (0..T::LANES)
            .map(|lane| {
                let t = traced.t.lane(lane).unwrap();
                (traced.steps, (t, is(traced.hit, lane), is(traced.undecided, lane)))
            })
            .collect()
    }
}

/// Sphere tracing goes on in some lanes after others have arrived; that changes none of them.
#[test]
fn sphere_tracing_is_the_same_in_packets() {
    let (mut hits, mut undecided) = (0, 0);
    for seed in 0..2000 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let composed = Composed::random(&mut rng);
        let program = composed.program();
        let tracer = SphereTracer {
            epsilon: log_uniform(&mut rng, 1e-6, 1e-2) as f32,
            max_steps: rng.random_range(1..100),
            relaxation: rng.random_range(1.0..1.9),
        };
        let asked: [Asked; 8] = core::array::from_fn(|_| composed.aimed(&mut rng).varied(&mut rng, &program));
        for level in Level::available() {
            let traced = level.run(Tracing {
                tracer: &tracer,
                program: &program,
                asked: &asked,
            });
            for (lane, &(steps, found)) in traced.iter().enumerate() {
                let asked = &asked[lane % 8];
                let Some(ray) = asked.ray() else {
                    assert_eq!(found, (f32::INFINITY, false, false), "{level}, lane {lane}: {asked:?}");
                    continue;
                };
                let alone = tracer.cast(&program, &ray);
                assert_eq!(
                    (found.0.to_bits(), found.1, found.2),
                    (alone.t.to_bits(), alone.hit, alone.undecided),
                    "seed {seed}, {level}, lane {lane}: {asked:?}"
                );
                assert!(
                    alone.steps <= steps,
                    "the slowest lane took {steps} steps, this one {}",
                    alone.steps
                );
                if level == Level::PORTABLE {
                    hits += usize::from(found.1);
                    undecided += usize::from(found.2);
                }
            }
        }
    }
    assert!(hits > 1000 && undecided > 500, "{hits} hits, {undecided} undecided");
}

/// The standard distance at eight points.
#[test]
fn standard_distances_are_the_same_in_packets() {
    for seed in 0..3000 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let composed = Composed::random(&mut rng);
        let program = composed.program();
        let points: [Vec3; 8] = core::array::from_fn(|_| (unit(&mut rng) * log_uniform(&mut rng, 1e-3, 1e3)).as_vec3());
        let of = |axis: usize| F32x8::new(points.map(|point| point[axis]));
        let found = program.distance_at(V3::new(of(0), of(1), of(2))).to_array();
        for (point, found) in points.iter().zip(found) {
            assert_eq!(found.to_bits(), program.sdf(*point).to_bits(), "seed {seed}, at {point}");
        }
    }
}

csg! { const BALL = Sphere::new(Vec3::ZERO, 1.0) }

struct Cast<'r>(&'r [Ray]);

impl Work for Cast<'_> {
    /// Which lanes hold a ray, and what that hits.
    type Output = (u32, Vec<Option<Hit>>);

    fn run<T: Lanes>(self, token: T::Token) -> Self::Output {
        let packet = Packet::<T>::of(token, self.0);
        let mut spans = [Span::empty_like(T::splat(token, 0.0))];
        let hits = packet.cast(&BALL.program(), &mut spans).unwrap();
        let rays = self.0.iter().enumerate();
        (packet.valid().to_bits(), rays.map(|(lane, ray)| hits.lane(lane, ray)).collect())
    }
}

/// From none to more rays than lanes: those there are, in their order, and no more.
#[test]
fn packets_hold_the_first_rays() {
    let rays: Vec<Ray> = (0..18_u8)
        .map(|number| Ray::new(vec3(0.09 * f32::from(number), 0.0, 5.0), Vec3::NEG_Z).unwrap())
        .collect();
    for level in Level::available() {
        for count in 0..=rays.len() {
            let (valid, hits) = level.run(Cast(&rays[..count]));
            let held = count.min(level.lanes());
            assert_eq!((valid.count_ones() as usize, valid.trailing_ones() as usize), (held, held));
            for (lane, (ray, hit)) in rays.iter().zip(hits).enumerate() {
                let expected = if lane < held { BALL.cast(ray) } else { None };
                assert_eq!(hit, expected, "{level}, lane {lane} of {count}");
            }
        }
    }
}

/// The plain packet is that of eight.
#[test]
fn packets_hold_the_first_eight_rays() {
    let rays: Vec<Ray> = (0..10_u8)
        .map(|number| Ray::new(vec3(0.15 * f32::from(number), 0.0, 5.0), Vec3::NEG_Z).unwrap())
        .collect();
    for count in 0..=rays.len() {
        let packet = Packet::new(&rays[..count]);
        let hits = packet.cast(&BALL.program(), &mut scratch(1)).unwrap();
        assert_eq!(packet.valid().to_bits().count_ones() as usize, count.min(8));
        assert_eq!(packet.valid().to_bits().trailing_ones() as usize, count.min(8));
        for (lane, ray) in rays.iter().take(8).enumerate() {
            let expected = if lane < count { BALL.cast(ray) } else { None };
            assert_eq!(hits.lane(lane, ray), expected, "lane {lane} of {count}");
        }
        assert_eq!(hits.lane(8, &rays[0]), None);
    }
}

/// The rays through eight places of a picture are those through each of them, also where a picture reaches out of
/// range.
#[test]
fn packets_through_a_raster_are_its_rays() {
    let far = vec3(1.073_741_7e9, 0.0, -8.0);
    let cameras = [
        Camera::pinhole(vec3(2.0, 1.0, -6.0), Vec3::ZERO, Vec3::Y, 0.3).unwrap(),
        Camera::orthographic(vec3(2.0, 1.0, -6.0), Vec3::ZERO, Vec3::Y, 2.0).unwrap(),
        Camera::orthographic(far, far + Vec3::Z, Vec3::Y, 400.0).unwrap(),
    ];
    let scene = scenes::s2();
    let program = scene.program().unwrap();
    let (mut hits, mut invalid) = (0, 0);
    for raster in cameras.map(|camera| camera.raster(61, 47)) {
        for (x, y) in (0..47).flat_map(|y| (0..61).step_by(8).map(move |x| (x as f32 + 0.5, y as f32 + 0.5))) {
            let places: [f32; 8] = core::array::from_fn(|lane| x + lane as f32);
            let packet = Packet::through(&raster, F32x8::new(places), F32x8::splat(y));
            let found = packet.cast(&program, &mut scratch(program.leaves())).unwrap();
            for (lane, &x) in places.iter().enumerate() {
                let ray = Raster::ray_through(&raster, x, y).ok();
                assert_eq!(packet.valid().to_bits() >> lane & 1 == 1, ray.is_some(), "{x}, {y}");
                invalid += usize::from(ray.is_none());
                let expected = ray.and_then(|ray| scalar_hit(&program, ray).map(|hit| bits(&hit)));
                let found = ray.and_then(|ray| found.lane(lane, &ray)).map(|hit| bits(&hit));
                assert_eq!(found, expected, "{x}, {y}");
                hits += usize::from(found.is_some());
            }
        }
    }
    assert!(hits > 1000 && invalid > 500, "{hits} hits, {invalid} places without a ray");
}

#[test]
fn scratch_that_is_too_short_is_refused() {
    let scene = scenes::s2();
    let program = scene.program().unwrap();
    let packet = Packet::new(&[Ray::new(vec3(0.0, 0.0, 5.0), Vec3::NEG_Z).unwrap()]);
    for length in 0..program.leaves() {
        let error = ProgramError::ScratchTooShort(length, program.leaves());
        assert_eq!(packet.cast(&program, &mut scratch(length)).unwrap_err(), error);
        assert_eq!(packet.gsdf(&program, &mut scratch(length)).unwrap_err(), error);
    }
    assert!(packet.cast(&program, &mut scratch(program.leaves() + 3)).is_ok());
}
