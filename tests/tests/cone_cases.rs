//! Rays that run along the sides of cones exactly, in numbers that are whole: where one root of the quadratic is infinitely far.

use glam::{Vec3, vec3};
use gsdf_nostd::{Nappe, Solid};
use gsdf_tests::corpus::jittered;
use gsdf_tests::sandwich::{ROUNDOFF, Trial, computed_span};
use gsdf_tests::shape::Shape;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors a surface may seem to be off.
const ALLOWED: f64 = 8.0;

/// Whole numbers with `a² + b² = c²`; any two make a slope, any other two an azimuth, and everything about the generatrix is whole.
const TRIPLES: [[f32; 3]; 12] = [
    [3.0, 4.0, 5.0],
    [4.0, 3.0, 5.0],
    [5.0, 12.0, 13.0],
    [12.0, 5.0, 13.0],
    [8.0, 15.0, 17.0],
    [15.0, 8.0, 17.0],
    [7.0, 24.0, 25.0],
    [24.0, 7.0, 25.0],
    [20.0, 21.0, 29.0],
    [9.0, 40.0, 41.0],
    [63.0, 16.0, 65.0],
    [120.0, 119.0, 169.0],
];

/// A cone of whole numbers with one of its generatrices: its tip, its axis, the direction of the generatrix away from the tip and a vector across the axis towards it.
#[derive(Clone, Copy)]
struct Family {
    apex: Vec3,
    axis: Vec3,
    radius: f32,
    height: f32,
    generatrix: Vec3,
    outward: Vec3,
}

/// The vector with `along` in the direction of the axis number `axis` and `across` in the two after it; the sense of the axis is that of `sign`.
fn turned(axis: usize, sign: f32, along: f32, across: [f32; 2]) -> Vec3 {
    let mut vector = Vec3::ZERO;
    vector[axis] = sign * along;
    vector[(axis + 1) % 3] = across[0];
    vector[(axis + 2) % 3] = across[1];
    vector
}

/// Every slope with every azimuth along every axis, and slopes of 45 degrees towards the coordinate axes.
fn families() -> Vec<Family> {
    let mut rng = Pcg64::seed_from_u64(1);
    let slopes = TRIPLES
        .iter()
        .map(|&[rise, run, _]| (rise, run))
        .chain([(1.0, 1.0), (2.0, 1.0), (1.0, 64.0)]);
    let azimuths = TRIPLES.iter().copied().chain([[1.0, 0.0, 1.0], [0.0, -1.0, 1.0], [-3.0, 4.0, 5.0]]);
    let mut families = Vec::new();
    for (radius, height) in slopes {
        for [x, y, length] in azimuths.clone() {
            let (axis, sign) = (rng.random_range(0..3), [1.0, -1.0][rng.random_range(0..2)]);
            let mut whole = || rng.random_range(-20..=20) as f32;
            families.push(Family {
                apex: vec3(whole(), whole(), whole()),
                axis: turned(axis, sign, 1.0, [0.0, 0.0]),
                radius,
                height,
                generatrix: turned(axis, sign, height * length, [radius * x, radius * y]),
                outward: turned(axis, sign, 0.0, [x, y]),
            });
        }
    }
    families
}

impl Family {
    /// The cones that have this side: the endless one, those with a base at one and at three heights, and frustums of it upward and downward.
    fn shapes(&self) -> Vec<Shape> {
        let Self {
            apex,
            axis,
            radius,
            height,
            ..
        } = *self;
        let at = |times: f32| apex + axis * height * times;
        let cone = |times: f32| Shape::Cone {
            apex,
            base: at(times),
            axis,
            radius: radius * times,
        };
        vec![
            Shape::Nappe {
                apex,
                axis,
                radius,
                height,
            },
            cone(1.0),
            cone(3.0),
            Shape::CappedCone {
                bottom: at(1.0),
                top: at(3.0),
                axis,
                bottom_radius: radius,
                top_radius: radius * 3.0,
            },
            Shape::CappedCone {
                bottom: at(4.0),
                top: at(1.0),
                axis: -axis,
                bottom_radius: radius * 4.0,
                top_radius: radius,
            },
        ]
    }

    /// Starts with whole coordinates: on the generatrix, on the opposite one and on the axis, on both sides of the tip; beside them, outside and inside; in the plane of a base.
    fn starts(&self) -> Vec<Vec3> {
        let Self {
            apex,
            axis,
            generatrix,
            outward,
            height,
            ..
        } = *self;
        let mirrored = generatrix - 2.0 * (generatrix - axis * generatrix.dot(axis));
        let beside = outward.cross(axis);
        let mut starts = vec![apex];
        for times in [-2.0, -1.0, 1.0, 2.0] {
            let on = [generatrix, mirrored, axis * height].map(|along| apex + along * times);
            starts.extend(on);
            for step in [axis, -axis, outward, -outward, beside] {
                starts.extend(on.map(|point| point + step));
                starts.push(apex + step * times);
            }
        }
        starts
    }

    /// Directions: both ways along the generatrix, its mirror images, the axis, in the plane of the base, and at right angles to the generatrix.
    fn directions(&self) -> Vec<Vec3> {
        let Self {
            axis, generatrix, outward, ..
        } = *self;
        let up = generatrix.dot(axis);
        let flat = generatrix - axis * up;
        let ways = [
            generatrix,
            axis * up - flat,
            axis,
            outward,
            outward.cross(axis),
            axis * flat.length_squared() - flat * up,
        ];
        // As a ray has it: by a power of two, which keeps the numbers as they are, to a largest component from 1 to 2.
        let scaled = |way: Vec3| way * 2.0_f32.powi(-(way.abs().max_element().log2().floor() as i32));
        ways.into_iter().map(scaled).flat_map(|way| [way, -way]).collect()
    }
}

/// The worst of all rays at all shapes, with `jitter` units in the last place on every coordinate of start and direction.
fn worst(roundoff: f64, jitter: i32, span: impl Fn(&Trial) -> (f64, f64) + Sync) -> (f64, Trial, usize) {
    let family_trials = |(seed, family): (usize, &Family)| {
        let mut rng = Pcg64::seed_from_u64(seed as u64);
        let (starts, directions) = (family.starts(), family.directions());
        let mut worst: Option<(f64, Trial)> = None;
        let mut count = 0;
        for shape in family.shapes() {
            for _ in 0..60 {
                let (start, way) = (
                    starts[rng.random_range(0..starts.len())],
                    directions[rng.random_range(0..directions.len())],
                );
                let trial = Trial {
                    shape,
                    origin: jittered(&mut rng, start, jitter),
                    direction: jittered(&mut rng, way, jitter),
                };
                count += 1;
                let found = trial.roundings(span(&trial), roundoff);
                if worst.is_none_or(|(most, _)| found > most) {
                    worst = Some((found, trial));
                }
            }
        }
        let (most, trial) = worst.unwrap();
        (most, trial, count)
    };
    let families = families();
    let reports = families.par_iter().enumerate().map(family_trials);
    let joined = reports.reduce_with(|a, b| {
        let (most, trial, count) = if a.0 < b.0 { b } else { a };
        (most, trial, if a.0 < b.0 { count + a.2 } else { count + b.2 })
    });
    joined.unwrap()
}

fn check(roundoff: f64, jitter: i32, span: impl Fn(&Trial) -> (f64, f64) + Sync) {
    let (most, trial, count) = worst(roundoff, jitter, &span);
    println!("{count} rays, {jitter} last places off: at most {most} rounding errors");
    assert!(most <= ALLOWED, "off by {most}: {trial:?}, span {:?}", span(&trial));
}

#[test]
fn rays_along_a_generatrix_and_through_the_tip() {
    check(ROUNDOFF, 0, |trial| computed_span(trial, 0.0_f32));
}

#[test]
fn rays_nearly_along_a_generatrix() {
    check(ROUNDOFF, 2, |trial| computed_span(trial, 0.0_f32));
    check(ROUNDOFF, 32, |trial| computed_span(trial, 0.0_f32));
}

#[test]
fn rays_along_a_generatrix_in_double_precision() {
    check(f64::EPSILON / 2.0, 0, |trial| computed_span(trial, 0.0_f64));
}

#[test]
fn rays_nearly_along_a_generatrix_in_double_precision() {
    check(f64::EPSILON / 2.0, 2, |trial| computed_span(trial, 0.0_f64));
}

/// The generatrices of the families are what they are called: exactly on the surface, and a ray beside them has one finite end.
#[test]
fn the_families_are_exact() {
    for family in families() {
        let shape = family.shapes()[0];
        let trial = |origin, direction| {
            Trial { shape, origin, direction }
                .exact_span()
                .map(|(enter, exit)| (enter.to_f64(), exit.to_f64()))
        };
        let Family {
            apex, axis, generatrix, ..
        } = family;
        assert_eq!(trial(apex, generatrix), None, "a ray on the surface is outside");
        let (enter, exit) = trial(apex + axis, generatrix).unwrap();
        assert!(enter.is_finite() && exit == f64::INFINITY, "from {enter} to {exit}");
        let (enter, exit) = trial(apex + axis, -generatrix).unwrap();
        assert!(enter == f64::NEG_INFINITY && exit.is_finite(), "from {enter} to {exit}");
        assert_eq!(
            trial(apex - axis, generatrix),
            None,
            "below the tip the ray meets the other nappe only"
        );
    }
}

/// Frustums of equal radii are cylinders: along their axis, across it, slantwise, and in their side.
#[test]
fn capped_cones_of_equal_radii() {
    let mut rng = Pcg64::seed_from_u64(7);
    let mut most: f64 = 0.0;
    for _ in 0..3_000 {
        let (number, sign) = (rng.random_range(0..3), [1.0, -1.0][rng.random_range(0..2)]);
        let [x, y, radius] = TRIPLES[rng.random_range(0..TRIPLES.len())];
        let axis = turned(number, sign, 1.0, [0.0, 0.0]);
        let bottom = Vec3::from_array(core::array::from_fn(|_| rng.random_range(-20..=20) as f32));
        let shape = Shape::CappedCone {
            bottom,
            top: bottom + axis * rng.random_range(1..=64) as f32,
            axis,
            bottom_radius: radius,
            top_radius: radius,
        };
        let outward = turned(number, sign, 0.0, [x, y]);
        let targets = [
            bottom,
            bottom + outward,
            bottom + outward + axis,
            bottom + axis * 0.5,
            bottom + outward * 0.5,
        ];
        let ways = [axis, outward, outward.cross(axis), outward + axis, axis * 3.0 - outward];
        let (target, way) = (
            targets[rng.random_range(0..5)],
            ways[rng.random_range(0..5)] * [1.0, -1.0][rng.random_range(0..2)],
        );
        let start = target - way * rng.random_range(-3..=3) as f32;
        let steps = [0, 2, 32][rng.random_range(0..3)];
        let trial = Trial {
            shape,
            origin: jittered(&mut rng, start, steps),
            direction: jittered(&mut rng, way, steps),
        };
        let found = trial.roundings(computed_span(&trial, 0.0_f32), ROUNDOFF);
        assert!(found <= ALLOWED, "off by {found}: {trial:?}");
        most = most.max(found);
    }
    println!("equal radii: at most {most} rounding errors");
}

/// What one works out by hand, at 45 degrees and at 3 : 4.
#[test]
fn generatrices_by_hand() {
    let nappe = Nappe::new(Vec3::ZERO, Vec3::Z, 1.0, 1.0).unwrap();
    let slope = vec3(1.0, 0.0, 1.0);
    // From below the surface of the opposite side, up along the generatrix: in at z = 1, and for ever.
    assert_eq!(nappe.gsdf(vec3(-2.0, 0.0, 0.0), slope), 1.0);
    assert_eq!(nappe.gsdf(vec3(0.0, 0.0, 4.0), slope), f32::NEG_INFINITY);
    // Down again: out at z = 2.
    assert_eq!(nappe.gsdf(vec3(0.0, 0.0, 4.0), -slope), -2.0);
    // On the surface, and on its continuation beyond the tip: outside all along.
    assert_eq!(nappe.gsdf(vec3(1.0, 0.0, 1.0), slope), f32::INFINITY);
    assert_eq!(nappe.gsdf(vec3(-1.0, 0.0, -1.0), slope), f32::INFINITY);
    // Into the other nappe, which is no part of the solid.
    assert_eq!(nappe.gsdf(vec3(2.0, 0.0, 0.0), -slope), f32::INFINITY);
    assert_eq!(nappe.gsdf(vec3(0.0, 0.0, -1.0), vec3(0.0, 0.0, -1.0)), f32::INFINITY);
    assert_eq!(nappe.gsdf(vec3(0.0, 0.0, -1.0), Vec3::Z), 1.0);

    let steep = Nappe::new(vec3(5.0, -7.0, 2.0), Vec3::X, 3.0, 4.0).unwrap();
    let generatrix = vec3(4.0, 3.0, 0.0);
    assert_eq!(steep.gsdf(vec3(5.0 - 8.0, -7.0, 2.0), generatrix), f32::INFINITY);
    assert_eq!(steep.gsdf(vec3(5.0 + 8.0, -7.0, 2.0), generatrix), f32::NEG_INFINITY);
    assert_eq!(steep.gsdf(vec3(5.0 + 8.0, -7.0, 2.0), -generatrix), -1.0);
}
