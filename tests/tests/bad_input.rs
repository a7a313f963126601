//! Numbers that describe nothing: refused where they are given, by name, or else harmless. Whatever the bits, no question panics and no answer is a silent NaN.

use glam::{Mat3, Vec3, vec3};
use gsdf_nostd::{
    Camera, CappedCone, CappedCylinder, Capsule, Cone, Csg, Cuboid, Cylinder, Draft, Fault, HalfSpace, HexagonalPrism, Hit, Invalid, Leaf,
    Nappe, Node, Octahedron, Pyramid, Quad, Rhombus, RoundedCone, SolidAngle, Triangle, TriangularPrism,
};
use gsdf_nostd::{MAX_LENGTH, MAX_SPEED, MIN_LENGTH, Ray, RayError, Solid, Span, Sphere, Transform, csg};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use std::error::Error;

/// What each parameter is replaced with, in turn.
#[rustfmt::skip]
const SPOILERS: [f32; 24] = [
    f32::NAN, f32::INFINITY, f32::NEG_INFINITY,
    0.0, -0.0, -1.0, 1.0, 0.5,
    1e-45, -1e-45, 1e-40, f32::MIN_POSITIVE, -f32::MIN_POSITIVE, f32::EPSILON, MIN_LENGTH,
    MAX_LENGTH, -MAX_LENGTH, 1e9, -1e9, 1e10, 1e30, -1e30, f32::MAX, f32::MIN,
];

/// A constructor of a solid, with parameters that are right, and to each the words, one of which a refusal of it must contain.
struct Constructor {
    name: &'static str,
    parameters: &'static [(&'static [f32], &'static str)],
    build: fn(&[f32]) -> Result<Leaf, Invalid>,
}

impl Constructor {
    /// All parameters in a row.
    fn right(&self) -> Vec<f32> {
        self.parameters.iter().flat_map(|(numbers, _)| numbers.iter().copied()).collect()
    }
}

const fn constructor(
    name: &'static str,
    parameters: &'static [(&'static [f32], &'static str)],
    build: fn(&[f32]) -> Result<Leaf, Invalid>,
) -> Constructor {
    Constructor { name, parameters, build }
}

fn at(numbers: &[f32], index: usize) -> Vec3 {
    Vec3::from_slice(&numbers[index..])
}

const PLACE: &[f32] = &[1.0, 2.0, 3.0];
const OBLIQUE: &[f32] = &[0.6, 0.0, 0.8];
const LOW: &[f32] = &[0.0, -1.0, 0.0];
const HIGH: &[f32] = &[0.0, 2.0, 0.0];
const UP: &[f32] = &[0.0, 1.0, 0.0];
const SIZE: &[f32] = &[0.5];
/// The place of the bottom and the height of the top, which is a coordinate as well.
const BOTTOM_TO_TOP: &[f32] = &[0.0, -1.0, 0.0, 2.0];
/// The one size that may be zero.
const ROUNDING: &[f32] = &[0.25];

#[rustfmt::skip]
const CONSTRUCTORS: [Constructor; 22] = [
    constructor("HalfSpace::new", &[(PLACE, "half-space point"), (OBLIQUE, "half-space normal")],
        |n| HalfSpace::new(at(n, 0), at(n, 3)).map(Leaf::from)),
    constructor("Sphere::new", &[(PLACE, "sphere center"), (SIZE, "sphere radius")],
        |n| Sphere::new(at(n, 0), n[3]).map(Leaf::from)),
    constructor("Cylinder::new", &[(PLACE, "cylinder point"), (OBLIQUE, "axis"), (SIZE, "radius")],
        |n| Cylinder::new(at(n, 0), at(n, 3), n[6]).map(Leaf::from)),
    constructor("Nappe::new", &[(PLACE, "nappe apex"), (OBLIQUE, "axis"), (SIZE, "radius"), (SIZE, "height")],
        |n| Nappe::new(at(n, 0), at(n, 3), n[6], n[7]).map(Leaf::from)),
    constructor("Nappe::with_angle", &[(PLACE, "nappe apex"), (OBLIQUE, "axis"), (SIZE, "angle|radius|height")],
        |n| Nappe::with_angle(at(n, 0), at(n, 3), n[6]).map(Leaf::from)),
    constructor("Cuboid::new", &[(LOW, "box min|- min"), (PLACE, "box max")],
        |n| Cuboid::new(at(n, 0), at(n, 3)).map(Leaf::from)),
    constructor("CappedCylinder::new", &[(LOW, "capped cylinder|end"), (HIGH, "capped cylinder|end"), (UP, "axis"), (SIZE, "radius")],
        |n| CappedCylinder::new(at(n, 0), at(n, 3), at(n, 6), n[9]).map(Leaf::from)),
    constructor("CappedCylinder::between", &[(LOW, "capped cylinder|end|axis"), (PLACE, "capped cylinder|end|axis"), (SIZE, "radius")],
        |n| CappedCylinder::between(at(n, 0), at(n, 3), n[6]).map(Leaf::from)),
    constructor("Cone::new", &[(LOW, "cone|end"), (HIGH, "cone|end"), (UP, "axis"), (SIZE, "cone radius")],
        |n| Cone::new(at(n, 0), at(n, 3), at(n, 6), n[9]).map(Leaf::from)),
    constructor("Cone::between", &[(LOW, "cone|end|axis"), (PLACE, "cone|end|axis"), (SIZE, "cone radius")],
        |n| Cone::between(at(n, 0), at(n, 3), n[6]).map(Leaf::from)),
    constructor("CappedCone::new", &[(LOW, "capped cone|end"), (HIGH, "capped cone|end"), (UP, "axis"), (SIZE, "bottom radius"), (SIZE, "top radius")],
        |n| CappedCone::new(at(n, 0), at(n, 3), at(n, 6), n[9], n[10]).map(Leaf::from)),
    constructor("CappedCone::between", &[(LOW, "capped cone|end|axis"), (PLACE, "capped cone|end|axis"), (SIZE, "bottom radius"), (SIZE, "top radius")],
        |n| CappedCone::between(at(n, 0), at(n, 3), n[6], n[7]).map(Leaf::from)),
    constructor("Capsule::new", &[(LOW, "capsule|center"), (PLACE, "capsule|center"), (SIZE, "radius")],
        |n| Capsule::new(at(n, 0), at(n, 3), n[6]).map(Leaf::from)),
    constructor("HexagonalPrism::new", &[(BOTTOM_TO_TOP, "bottom|top"), (SIZE, "apothem")],
        |n| HexagonalPrism::new(at(n, 0), n[3], n[4]).map(Leaf::from)),
    constructor("TriangularPrism::new", &[(BOTTOM_TO_TOP, "bottom|top"), (SIZE, "inradius")],
        |n| TriangularPrism::new(at(n, 0), n[3], n[4]).map(Leaf::from)),
    constructor("Octahedron::new", &[(PLACE, "center"), (SIZE, "radius")],
        |n| Octahedron::new(at(n, 0), n[3]).map(Leaf::from)),
    constructor("Pyramid::new", &[(PLACE, "base"), (SIZE, "half width"), (SIZE, "height")],
        |n| Pyramid::new(at(n, 0), n[3], n[4]).map(Leaf::from)),
    constructor("Rhombus::new", &[(BOTTOM_TO_TOP, "bottom|top"), (SIZE, "half x|half z|diagonal"), (SIZE, "half z|half x|diagonal"), (ROUNDING, "rounding")],
        |n| Rhombus::new(at(n, 0), n[3], n[4], n[5], n[6]).map(Leaf::from)),
    constructor("RoundedCone::new", &[(LOW, "rounded cone|center"), (PLACE, "rounded cone|center"), (SIZE, "radius|side"), (SIZE, "radius|side")],
        |n| RoundedCone::new(at(n, 0), at(n, 3), n[6], n[7]).map(Leaf::from)),
    constructor("SolidAngle::new", &[(PLACE, "apex"), (OBLIQUE, "axis"), (SIZE, "reach"), (SIZE, "radius"), (SIZE, "height")],
        |n| SolidAngle::new(at(n, 0), at(n, 3), n[6], n[7], n[8]).map(Leaf::from)),
    constructor("Triangle::new", &[(LOW, "triangle"), (HIGH, "triangle"), (PLACE, "triangle")],
        |n| Triangle::new(at(n, 0), at(n, 3), at(n, 6)).map(Leaf::from)),
    constructor("Quad::new", &[(&[0.0, 0.0, 1.0], "quad"), (&[1.0, 0.0, 1.0], "quad"), (&[1.0, 2.0, 1.0], "quad"), (&[0.0, 1.0, 1.0], "quad")],
        |n| Quad::new(at(n, 0), at(n, 3), at(n, 6), at(n, 9)).map(Leaf::from)),
];

/// Asks a solid everything about a few places near and far; a NaN, or a hit that is none, fails.
fn interrogate(leaf: Leaf, what: &str) {
    let ball: Leaf = Sphere::new(Vec3::ONE, 2.0).expect("a ball").into();
    let program: Csg<4> = Draft::new()
        .leaf(ball)
        .leaf(leaf)
        .operator(Node::Complement)
        .operator(Node::Union)
        .finish()
        .expect("a program");
    let places = [
        Vec3::ZERO,
        vec3(1.0, 2.0, 3.0),
        vec3(-3.0, 0.5, 7.0),
        vec3(1e4, -1e4, 1e4),
        vec3(-1e9, 1e9, 1e3),
    ];
    let directions = [
        Vec3::X,
        Vec3::NEG_Y,
        Vec3::Z,
        vec3(0.6, 0.0, 0.8),
        vec3(-1.0, 2.0, 0.5),
        vec3(1e-12, 1e-12, -1e-12),
        vec3(1e12, -1e12, 1e-30),
    ];
    for place in places {
        assert!(!leaf.sdf(place).is_nan() && !program.sdf(place).is_nan(), "{what}: sdf at {place}");
        for direction in directions {
            assert!(!leaf.gsdf(place, direction).is_nan(), "{what}: gsdf at {place} along {direction}");
            let ray = Ray::new(place, direction).expect("a ray");
            check(&ray, program.cast(&ray), 2, what);
        }
    }
}

/// Whether a hit is one: ahead, finite, a unit normal, numbers that exist.
fn check(ray: &Ray, hit: Option<Hit>, leaves: u32, what: &str) -> bool {
    let Some(hit) = hit else { return false };
    let range = ray.range();
    assert!(range.start < hit.t && hit.t < range.end, "{what}: {hit:?} along {ray:?}");
    assert!(
        hit.point.is_finite() && (hit.normal.length() - 1.0).abs() < 1e-5,
        "{what}: {hit:?} along {ray:?}"
    );
    assert!(hit.leaf < leaves && hit.face < 10, "{what}: {hit:?} along {ray:?}");
    true
}

/// A refusal names what is wrong, with the number, and says what would do.
fn assert_named(error: &Invalid, words: &str, what: &str) {
    assert!(words.split('|').any(|word| error.parameter().contains(word)), "{what}: {error}");
    assert!(
        !error.message().is_empty() && error.to_string().contains(error.message()),
        "{what}: {error}"
    );
    assert!(error.to_string().starts_with(error.parameter()), "{what}: {error}");
}

#[test]
fn every_constructor_of_a_solid_refuses_or_makes_one_that_answers() {
    for constructor in &CONSTRUCTORS {
        let right = constructor.right();
        let leaf = (constructor.build)(&right).unwrap_or_else(|error| panic!("{}: {error}", constructor.name));
        interrogate(leaf, constructor.name);
        let mut first = 0;
        for (numbers, words) in constructor.parameters {
            for index in first..first + numbers.len() {
                for spoiler in SPOILERS {
                    let mut spoilt = right.clone();
                    spoilt[index] = spoiler;
                    let what = format!("{} with number {index} = {spoiler:e}", constructor.name);
                    match (constructor.build)(&spoilt) {
                        Ok(leaf) => {
                            assert!(spoiler.abs() <= MAX_LENGTH, "{what} was taken");
                            interrogate(leaf, &what);
                        }
                        Err(error) => assert_named(&error, words, &what),
                    }
                }
            }
            first += numbers.len();
        }
    }
}

#[test]
fn sizes_that_are_none_are_refused() {
    for constructor in &CONSTRUCTORS {
        let right = constructor.right();
        let mut index = 0;
        for (numbers, _) in constructor.parameters {
            // Numbers that come alone are sizes and angles; the others are places and directions, where zero is as good as any.
            let may_be_zero = numbers.len() > 1 || *numbers == ROUNDING;
            for size in [0.0, -0.0, -1.0, 1e-45, f32::MIN_POSITIVE, MIN_LENGTH / 2.0] {
                let mut spoilt = right.clone();
                spoilt[index] = size;
                let refused = (constructor.build)(&spoilt).is_err();
                assert!(refused || may_be_zero, "{} with number {index} = {size:e}", constructor.name);
            }
            index += numbers.len();
        }
    }
}

#[test]
fn transforms_refuse_or_answer() {
    let right = [1.0, 0.5, 0.0, -0.25, 2.0, 0.0, 0.0, 0.125, 4.0, 3.0, -2.0, 1.0];
    csg! { const POSED = posed(1, difference(Sphere::new(Vec3::ZERO, 1.0), Cuboid::new(Vec3::ZERO, Vec3::ONE))) }
    for index in 0..right.len() {
        for spoiler in SPOILERS {
            let mut numbers = right;
            numbers[index] = spoiler;
            let what = format!("number {index} = {spoiler:e}");
            let matrix = Mat3::from_cols(at(&numbers, 0), at(&numbers, 3), at(&numbers, 6));
            let words = if index < 9 { "matrix" } else { "translation" };
            match Transform::affine(matrix, at(&numbers, 9)) {
                Ok(pose) => {
                    assert!(spoiler.abs() <= MAX_LENGTH, "{what}");
                    assert!(pose.stretch() > 0.0 && pose.stretch() <= 1025.0, "{what}");
                    let poses = [pose];
                    let program = POSED.program().posed(&poses).expect("one pose");
                    let mut scratch = [Span::EMPTY; 2];
                    for place in [Vec3::ZERO, vec3(3.0, -2.0, 9.0), vec3(-1e9, 1e9, 1e3)] {
                        assert!(!program.sdf(place).is_nan(), "{what}");
                        let ray = Ray::new(place, vec3(0.5, -1.0, 0.25)).expect("a ray");
                        check(&ray, program.along(ray, &mut scratch).expect("room").cast(), 2, &what);
                    }
                }
                Err(error) => assert_named(&error, words, &what),
            }
            assert_eq!(
                Transform::translation(at(&numbers, 9)).is_err(),
                index >= 9 && (spoiler.is_nan() || spoiler.abs() > MAX_LENGTH),
                "{what}"
            );
        }
    }
}

#[test]
fn cameras_refuse_or_make_rays() {
    let right = [1.0, 2.0, 3.0, -1.0, 0.5, 0.0, 0.0, 1.0, 0.0, 0.5];
    let words = |index| match index {
        // A place far above or below makes the line of sight parallel to `up`.
        0..3 => "camera eye|eye to target|up across",
        3..6 => "camera target|eye to target|up across",
        6..9 => "camera up",
        _ => "tangent|half height",
    };
    for index in 0..right.len() {
        for spoiler in SPOILERS {
            let mut n = right;
            n[index] = spoiler;
            let what = format!("number {index} = {spoiler:e}");
            for make in [Camera::pinhole, Camera::orthographic] {
                match make(at(&n, 0), at(&n, 3), at(&n, 6), n[9]) {
                    Ok(camera) => {
                        assert!(spoiler.abs() <= MAX_LENGTH, "{what}");
                        assert!((camera.forward().length() - 1.0).abs() < 1e-5, "{what}");
                        // The picture's middle is in range, whatever its rim.
                        assert!(camera.raster(3, 3).ray(1, 1).is_ok(), "{what}: {camera:?}");
                    }
                    Err(error) => assert_named(&error, words(index), &what),
                }
            }
        }
    }
    let camera = Camera::pinhole(Vec3::ZERO, Vec3::Z, Vec3::Y, 0.5).expect("a camera");
    // A picture without pixels, or places that are none, give no ray and no panic.
    assert!(camera.raster(0, 0).ray(0, 0).is_err());
    assert!(camera.raster(3, 3).ray_through(f32::NAN, 0.0).is_err());
    assert!(camera.raster(3, 3).ray_through(0.0, f32::INFINITY).is_err());
    assert!(camera.raster(u32::MAX, u32::MAX).ray(u32::MAX, 0).is_ok());
}

#[test]
fn rays_are_refused_for_the_number_that_is_wrong() {
    let right = [1.0, 2.0, 3.0, 0.5, -1.0, 0.25];
    for index in 0..right.len() {
        for spoiler in SPOILERS {
            let mut n = right;
            n[index] = spoiler;
            let made = Ray::new(at(&n, 0), at(&n, 3));
            let fits = match index {
                0..3 if !spoiler.is_finite() => matches!(made, Err(RayError::OriginNotFinite(_))),
                0..3 if spoiler.abs() > MAX_LENGTH => matches!(made, Err(RayError::OriginTooFar(_))),
                3.. if !spoiler.is_finite() => matches!(made, Err(RayError::DirectionNotFinite(_))),
                3.. if spoiler.abs() > MAX_SPEED => matches!(made, Err(RayError::DirectionTooLong(_))),
                _ => made.is_ok(),
            };
            assert!(fits, "number {index} = {spoiler:e}: {made:?}");
            if let Err(error) = made {
                assert!(error.to_string().contains("every co"), "{error}");
            }
        }
    }
    for nothing in [0.0, -0.0] {
        let refused = Ray::new(Vec3::ONE, Vec3::splat(nothing));
        assert!(matches!(refused, Err(RayError::DirectionZero(_))), "{nothing:e}: {refused:?}");
    }
    for little in [1e-45, 1e-39, -1e-39, 1e-13] {
        let refused = Ray::new(Vec3::ONE, Vec3::splat(little));
        assert!(matches!(refused, Err(RayError::DirectionTooShort(_))), "{little:e}: {refused:?}");
    }
    let ray = Ray::new(Vec3::ZERO, Vec3::X).expect("a ray");
    for start in SPOILERS {
        for end in SPOILERS {
            let made = ray.within(start..end);
            assert_eq!(made.is_ok(), start >= 0.0 && start < end, "{start:e}..{end:e}");
            if let Err(error) = made {
                assert!(error.to_string().contains("0 <= start < end"), "{error}");
            }
        }
    }
}

csg! {
    /// All solids, and all operators.
    const EVERYTHING = union(
        difference(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(Vec3::ONE, 0.75), Cylinder::new(Vec3::ZERO, Vec3::X, 0.25)),
        intersection(HalfSpace::new(vec3(0.0, 3.0, 0.0), Vec3::Y), complement(Nappe::new(vec3(0.0, 2.0, 0.0), Vec3::Y, 1.0, 1.0)), Sphere::new(vec3(0.0, 2.0, 0.0), 2.0)),
        posed(1, Cone::new(vec3(3.0, 0.0, 0.0), vec3(5.0, 0.0, 0.0), Vec3::X, 1.0)),
        CappedCone::new(vec3(-3.0, 0.0, 0.0), vec3(-5.0, 0.0, 0.0), Vec3::NEG_X, 1.0, 0.5),
        CappedCylinder::new(vec3(0.0, 0.0, 3.0), vec3(0.0, 0.0, 4.0), Vec3::Z, 1.5),
        Capsule::new(vec3(0.0, -4.0, 0.0), vec3(2.0, -5.0, 1.0), 0.5)
    )
}

/// A vector of any bits at all, of bits with an exponent near that of 1, or aimed at the scene.
fn random_vector(rng: &mut impl Rng) -> Vec3 {
    let kind = rng.random_range(0..3);
    Vec3::from_array([(); 3].map(|()| {
        let bits: u32 = rng.random();
        match kind {
            0 => f32::from_bits(bits),
            1 => f32::from_bits(bits & 0x83ff_ffff | 0x3c00_0000),
            _ => rng.random_range(-6.0..6.0),
        }
    }))
}

#[test]
fn no_bits_of_a_ray_make_a_program_panic_or_lie() {
    let pose = Transform::affine(Mat3::from_axis_angle(vec3(0.6, 0.0, 0.8), 1.0), Vec3::ZERO).expect("a rotation");
    let poses = [pose];
    let program = EVERYTHING.program().posed(&poses).expect("one pose");
    let mut scratch = [Span::EMPTY; 10];
    let mut wide_scratch = [Span::empty_like(0.0_f64); 10];
    let mut rng = Pcg64::seed_from_u64(0);
    let (mut refused, mut hits) = (0, 0);
    for _ in 0..200_000 {
        let (place, direction) = (random_vector(&mut rng), random_vector(&mut rng));
        let refusable = !place.abs().cmple(Vec3::splat(MAX_LENGTH)).all();
        assert_eq!(program.sdf(place).is_nan(), refusable, "sdf at {place}");
        assert_eq!(program.contains(place), program.sdf(place) < 0.0);
        let made = Ray::new(place, direction);
        let distance = EVERYTHING.gsdf(place, direction);
        assert_eq!(distance.is_nan(), made.is_err(), "gsdf at {place} along {direction}");
        let Ok(ray) = made else {
            refused += 1;
            continue;
        };
        assert!(direction.is_finite() && direction != Vec3::ZERO && !refusable);
        let ray = ray
            .within(f32::from_bits(rng.random())..f32::from_bits(rng.random()))
            .unwrap_or(ray);
        let sight = program.along(ray, &mut scratch).expect("room");
        hits += u32::from(check(&ray, sight.cast(), 10, "any bits"));
        assert!(sight.march().sweeps as usize <= program.max_sweeps());
        assert!(sight.crossings().count() <= 20, "{ray:?}");
        let exact = program.along(ray, &mut wide_scratch).expect("room");
        assert!(!exact.gsdf().is_nan() && exact.crossings().count() <= 20, "{ray:?}");
    }
    assert!(refused > 10_000 && hits > 10_000, "{refused} refused, {hits} hit");
}

/// A box with a hole of a size known at run time only.
fn drilled(radius: f32) -> Result<Csg<3>, Box<dyn Error>> {
    let block = Cuboid::new(Vec3::NEG_ONE, Vec3::ONE)?;
    let hole = Sphere::new(Vec3::ZERO, radius)?;
    Ok(Draft::new()
        .leaf(block.into())
        .leaf(hole.into())
        .operator(Node::Difference)
        .finish()?)
}

#[test]
fn a_hole_of_no_size_is_an_error_and_not_a_filled_box() {
    for radius in SPOILERS {
        match drilled(radius) {
            // What was accepted is cut out: its very centre is not solid, and a ray from there first enters or never does.
            Ok(program) => {
                assert!(program.sdf(Vec3::ZERO) > 0.0, "{radius:e} is filled");
                assert!(program.gsdf(Vec3::ZERO, Vec3::X) > 0.0, "{radius:e} is filled");
            }
            Err(error) => assert!(error.to_string().starts_with("sphere radius"), "{error}"),
        }
    }
    for radius in [f32::NAN, f32::INFINITY, 0.0, -0.5, 1e-30, f32::MAX] {
        assert!(drilled(radius).is_err(), "{radius:e}");
    }
}

/// Once every step of a repeated cast along a very long direction returned the same hit, because parameters underflowed.
#[test]
fn casts_along_long_directions_advance() {
    csg! { const BALL = Sphere::new(vec3(0.01, 0.0, 0.0), 0.001) }
    for length in [1e-12, 1e-6, 1.0, 1e6, 1e12] {
        let ray = Ray::new(Vec3::ZERO, vec3(length, 0.0, 0.0)).expect("a ray");
        let enter = BALL.cast(&ray).expect("an entry");
        let exit = BALL.cast(&ray.within(enter.t..f32::INFINITY).expect("a range")).expect("an exit");
        assert!(exit.t > enter.t && enter.entering && !exit.entering, "{length}: {enter:?} {exit:?}");
        assert!(
            BALL.cast(&ray.within(exit.t..f32::INFINITY).expect("a range")).is_none(),
            "{length}"
        );
    }
}

/// Once a constructor that computes its own axis panicked on ends that are no numbers, and blamed the axis where they coincide.
#[test]
fn ends_that_make_no_axis_are_named() {
    for spoiler in SPOILERS {
        for (from, to) in [(Vec3::splat(spoiler), Vec3::ONE), (Vec3::ONE, vec3(1.0, spoiler, 1.0))] {
            if let Err(error) = CappedCylinder::between(from, to, 1.0) {
                assert!(!error.parameter().contains("axis"), "{spoiler:e}: {error}");
            }
        }
    }
    let error = CappedCylinder::between(Vec3::ONE, Vec3::ONE, 1.0).expect_err("no axis");
    assert_eq!(error.fault(), Fault::Degenerate);
}
