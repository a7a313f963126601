//! A range finder's readings are the analytic distances, zone by zone, within its limits.

use glam::{Vec3, vec3};
use gsdf_nostd::{HalfSpace, ProgramError, Span, Sphere, csg};
use gsdf_parts::{Fpu, RangeFinder, RangeFinderError, millimetres};
use std::ops::Range;

csg! { const WALL = HalfSpace::new(vec3(0.0, 0.0, 2.0), Vec3::NEG_Z) }
csg! { const BALL = Sphere::new(vec3(0.3, -0.2, 3.0), 1.0) }

/// A sensor at the origin that looks along +z with +x to its right and +y upward.
fn sensor(limits: Range<f32>) -> RangeFinder {
    RangeFinder::new(Vec3::ZERO, Vec3::Z, Vec3::Y, 0.5, limits).expect("a valid sensor")
}

/// The exact direction of a zone of that sensor, per unit of depth.
fn slant(zone: usize) -> [f64; 2] {
    let place = |index: usize| (index as f64 - 3.5) / 4.0 * 0.5;
    [place(zone % 8), -place(zone / 8)]
}

#[test]
fn a_wall_is_as_far_as_its_slant_says() {
    let distances = sensor(0.0..10.0).read(&WALL.program(), &mut WALL.scratch()).unwrap();
    for (zone, distance) in distances.into_iter().enumerate() {
        let [x, y] = slant(zone);
        let expected = 2.0 * (x * x + y * y + 1.0).sqrt();
        assert!(
            (f64::from(distance) - expected).abs() < 1e-6,
            "zone {zone}: {distance}, not {expected}"
        );
    }
}

#[test]
fn a_ball_is_seen_in_its_own_zones_from_the_upper_left() {
    let distances = sensor(0.0..10.0).read(&BALL.program(), &mut BALL.scratch()).unwrap();
    let mut seen = 0;
    for (zone, distance) in distances.into_iter().enumerate() {
        let [x, y] = slant(zone);
        let length = (x * x + y * y + 1.0).sqrt();
        let along = (0.3 * x - 0.2 * y + 3.0) / length;
        let miss_squared = 0.09 + 0.04 + 9.0 - along * along;
        if miss_squared < 1.0 {
            let expected = along - (1.0 - miss_squared).sqrt();
            assert!(
                (f64::from(distance) - expected).abs() < 1e-5,
                "zone {zone}: {distance}, not {expected}"
            );
            seen += 1;
        } else {
            assert_eq!(distance, f32::INFINITY, "zone {zone}");
        }
    }
    assert!((10..54).contains(&seen), "{seen} zones see the ball");
}

#[test]
fn limits_are_kept() {
    let read = |limits| sensor(limits).read(&WALL.program(), &mut WALL.scratch()).unwrap();
    let (all, far, near) = (read(0.0..10.0), read(0.0..2.1), read(2.1..10.0));
    for zone in 0..RangeFinder::ZONES {
        assert_eq!(far[zone], if all[zone] < 2.1 { all[zone] } else { f32::INFINITY });
        assert_eq!(near[zone], all[zone].max(2.1));
    }
    assert!(far.contains(&f32::INFINITY) && near.contains(&2.1));
}

#[test]
fn a_sensor_inside_of_a_solid_reads_its_near_limit() {
    let buried = RangeFinder::new(vec3(0.0, 0.0, 3.0), Vec3::ZERO, Vec3::Y, 0.5, 0.02..4.0).unwrap();
    for program in [WALL.program(), BALL.program()] {
        assert_eq!(buried.read(&program, &mut [Span::EMPTY; 1]), Ok([0.02; 64]));
    }
}

#[test]
fn rays_are_of_unit_length_and_the_arithmetic_is_the_callers() {
    for tangent in [1e-6, 0.414, 3.0, 1e9] {
        let sensor = RangeFinder::new(vec3(1.0, 2.0, -3.0), Vec3::ZERO, Vec3::Y, tangent, 0.0..10.0).unwrap();
        assert!(sensor.rays().iter().all(|ray| (ray.direction().length() - 1.0).abs() < 1e-6));
    }
    let plain = sensor(0.1..10.0).read(&BALL.program(), &mut BALL.scratch()).unwrap();
    let fpu = sensor(0.1..10.0)
        .read(&BALL.program(), &mut [Span::empty_like(Fpu(0.0)); 1])
        .unwrap();
    assert_eq!(plain, fpu);
}

#[test]
fn nonsense_is_refused_and_nothing_panics() {
    let numbers = [
        0.0,
        -0.0,
        1.0,
        -1e-45,
        1e-20,
        1e12,
        1e30,
        f32::MAX,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];
    let mut made = 0;
    for a in numbers {
        for b in numbers {
            let limits = RangeFinder::new(Vec3::ZERO, Vec3::Z, Vec3::Y, 0.5, a..b);
            assert_eq!(limits.is_ok(), a >= 0.0 && a < b && b.is_finite(), "{a}..{b}");
            for c in numbers {
                let points = [vec3(a, b, c), vec3(b, c, a), Vec3::ONE];
                for (eye, target) in points.into_iter().flat_map(|eye| points.map(|target| (eye, target))) {
                    if let Ok(sensor) = RangeFinder::new(eye, target, Vec3::Y, c, 0.0..9.0) {
                        let distances = sensor.read(&BALL.program(), &mut BALL.scratch()).unwrap();
                        assert!(distances.iter().all(|distance| *distance >= 0.0));
                        made += 1;
                    }
                }
            }
        }
    }
    assert!(made > 50, "{made} sensors");
    let short = sensor(0.0..1.0).read::<_, f32>(&BALL.program(), &mut []);
    assert_eq!(short, Err(ProgramError::ScratchTooShort(0, 1)));
    let error = RangeFinder::new(Vec3::ZERO, Vec3::ZERO, Vec3::Y, 0.5, 0.0..1.0).unwrap_err();
    assert!(matches!(error, RangeFinderError::Camera(_)));
}

#[test]
fn millimetres_round_and_saturate() {
    for (metres, expected) in [
        (0.0, 0),
        (0.0204, 20),
        (0.0206, 21),
        (4.0, 4000),
        (65.5, 65_500),
        (66.0, u16::MAX),
        (f32::INFINITY, u16::MAX),
    ] {
        assert_eq!(millimetres(metres), expected, "{metres} m");
    }
}
