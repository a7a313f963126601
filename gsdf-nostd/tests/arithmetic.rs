//! A cast in any arithmetic: what finds the crossing, and what the hit holds.

use core::ops::{Add, Div, Mul, Neg, Sub};
use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCone, Cuboid, Departure, HalfSpace, Hit, Lane, Program, Ray, Real, Span, Sphere, Start, csg};

csg! {
    const SOLID = difference(
        intersection(Cuboid::new(Vec3::splat(-0.9), Vec3::splat(1.1)), Sphere::new(vec3(0.1, 0.0, -0.1), 1.3)),
        CappedCone::new(vec3(0.2, -2.0, 0.1), vec3(0.2, 2.0, 0.1), Vec3::Y, 0.7, 0.3)
    )
}

/// `f32` under another name.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Named(f32);

impl From<f32> for Named {
    fn from(value: f32) -> Self {
        Self(value)
    }
}

macro_rules! operator {
    ($($operator:ident $function:ident),+) => {$(
        impl $operator for Named {
            type Output = Self;
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
    )+};
}

operator!(Add add, Sub sub, Mul mul, Div div);

impl Neg for Named {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Named {
    type Mask = bool;
    type Scalar = Self;
    const LANES: usize = 1;

    fn splat_like(self, value: f32) -> Self {
        Self(value)
    }
    fn lift_like(self, value: Self) -> Self {
        value
    }
    fn sqrt(self) -> Self {
        Self(f32::sqrt(self.0))
    }
    fn abs(self) -> Self {
        Self(f32::abs(self.0))
    }
    fn copysign(self, sign: Self) -> Self {
        Self(f32::copysign(self.0, sign.0))
    }
    fn next_up(self) -> Self {
        Self(f32::next_up(self.0))
    }
    fn lt(self, other: Self) -> bool {
        self.0 < other.0
    }
    fn le(self, other: Self) -> bool {
        self.0 <= other.0
    }
    fn eq(self, other: Self) -> bool {
        self.0 == other.0
    }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
}

impl Lane for Named {
    fn to_f32(self) -> f32 {
        self.0
    }
    fn to_index(self) -> u32 {
        self.0.to_index()
    }
}

fn cast_in<T: Lane, R: Start>(program: Program<'_>, start: R) -> Option<Hit> {
    let mut scratch = [Span::empty_like(T::from(0.0)); 8];
    program.along(start, &mut scratch).expect("room").cast()
}

/// Rays at and past the solid, oblique and of any length.
fn rays() -> impl Iterator<Item = Ray> {
    (0..40_i16).flat_map(|i| {
        (0..40_i16).filter_map(move |j| {
            let (x, y) = (f32::from(i) * 0.091 - 1.8, f32::from(j) * 0.087 - 1.7);
            Ray::new(vec3(3.1, x, y), vec3(-1.0 - 0.1 * x, 0.3 * y - 0.2 * x, 0.1 * x - 0.25 * y)).ok()
        })
    })
}

fn bits(hit: Hit) -> ([u32; 7], u32, u8, bool) {
    let numbers = [
        hit.t,
        hit.point.x,
        hit.point.y,
        hit.point.z,
        hit.normal.x,
        hit.normal.y,
        hit.normal.z,
    ];
    (numbers.map(f32::to_bits), hit.leaf, hit.face, hit.entering)
}

#[test]
fn a_newtype_over_f32_casts_to_the_same_bits() {
    let mut hits = 0;
    for ray in rays() {
        let (known, named) = (SOLID.cast(&ray), cast_in::<Named, _>(SOLID.program(), ray));
        assert_eq!(known.map(bits), named.map(bits), "{ray:?}");
        let Some(hit) = known else { continue };
        hits += 1;
        let away = Departure::new(&hit, vec3(-1.0, 0.3, 0.2)).expect("a direction");
        let (known, named) = (SOLID.along(away).cast(), cast_in::<Named, _>(SOLID.program(), away));
        assert_eq!(known.map(bits), named.map(bits), "{away:?}");
    }
    assert!(hits > 400, "{hits}");
}

#[test]
fn a_cast_in_f64_is_rounded_to_f32() {
    let (program, mut hits, mut finer) = (SOLID.program(), 0, 0);
    for ray in rays() {
        let mut scratch = [Span::empty_like(0.0_f64); 3];
        let first = program.along(ray, &mut scratch).expect("room").crossings().next();
        let hit = cast_in::<f64, _>(program, ray);
        assert_eq!(first.is_some(), hit.is_some(), "{ray:?}");
        let (Some(first), Some(hit)) = (first, hit) else { continue };
        assert_eq!(
            (first.t as f32, first.leaf, first.entering),
            (hit.t, hit.leaf, hit.entering),
            "{ray:?}"
        );
        assert_eq!(hit.point, ray.at(hit.t), "{ray:?}");
        assert!((hit.normal.length() - 1.0).abs() < 1e-6, "{ray:?}");
        hits += 1;
        // The same surface in both, but for rays near an edge.
        let Some(single) = SOLID.cast(&ray).filter(|single| (single.leaf, single.face) == (hit.leaf, hit.face)) else {
            continue;
        };
        assert!(single.normal.distance(hit.normal) < 1e-3, "{ray:?}");
        finer += u32::from(single.t != hit.t);
    }
    assert!(hits > 400 && finer > 20, "{hits} hits, {finer} of them finer than f32's");
}

#[test]
fn what_lies_beyond_all_finite_f32_is_no_hit() {
    csg! { const FLOOR = HalfSpace::new(Vec3::ZERO, Vec3::Z) }
    // Along so short a direction the plane is 2^150 of its lengths away.
    let (far, slow) = (2.0_f32.powi(30), 2.0_f32.powi(-40));
    let ray = Ray::new(vec3(0.0, 0.0, far), vec3(slow, 0.0, -slow * 2.0_f32.powi(-80))).expect("a ray");
    assert_eq!(SOLID.cast(&ray), None);
    assert_eq!(FLOOR.cast(&ray), None);
    let mut scratch = [Span::empty_like(0.0_f64); 1];
    let sight = FLOOR.program().along(ray, &mut scratch).expect("room");
    assert_eq!(sight.gsdf(), f64::from(far) / (f64::from(slow) * 2.0_f64.powi(-80)));
    assert_eq!(sight.cast(), None);
}

#[test]
fn the_normal_of_a_ball_points_away_from_its_centre() {
    csg! { const BALL = Sphere::new(Vec3::ZERO, 1.5) }
    let hits = rays().filter_map(|ray| cast_in::<f64, _>(BALL.program(), ray));
    let off = hits.map(|hit| hit.normal.distance(hit.point / 1.5)).collect::<Vec<_>>();
    assert!(off.len() > 400 && off.iter().all(|off| *off < 1e-5), "{off:?}");
}
