//! Solids to examine, and rays at them, for any leaf type.

use crate::corpus::jittered;
use crate::shape::{Shape, across, log_uniform, unit};
use glam::{DVec3, Vec3};
use gsdf_nostd::{Leaf, Line, MAX_LENGTH, MAX_SPEED, Real, Toward, V3};
use rand::{Rng, RngExt};
use rand_pcg::Pcg64;

/// A solid, and what a suite must know of it to aim: it may be any leaf type's, and of any shape.
#[derive(Clone, Debug)]
pub struct Specimen<S> {
    /// The solid.
    pub solid: S,
    /// Points of its surface, in double precision, with the outward unit normals there.
    pub surface: Vec<(DVec3, DVec3)>,
    /// About how large it is.
    pub size: f64,
}

/// Where a ray starts and where it goes, in numbers that make a [`gsdf_nostd::Ray`].
pub type Aim = (Vec3, Vec3);

impl<S> Specimen<S> {
    /// How many points of the surface a specimen knows.
    pub const POINTS: usize = 16;

    /// The specimen of another type made from the same solid.
    pub fn map<R>(self, of: impl FnOnce(S) -> R) -> Specimen<R> {
        Specimen {
            solid: of(self.solid),
            surface: self.surface,
            size: self.size,
        }
    }

    /// How far from the origin the solid's numbers reach: what rounding errors are relative to.
    #[must_use]
    pub fn extent(&self) -> f64 {
        self.surface.iter().map(|(point, _)| point.length()).fold(self.size, f64::max)
    }

    /// A point of the surface and the normal there.
    pub fn surface_point(&self, rng: &mut impl Rng) -> (DVec3, DVec3) {
        self.surface[rng.random_range(0..self.surface.len())]
    }

    /// A point near the surface, on either side, or anywhere about.
    pub fn point(&self, rng: &mut impl Rng) -> DVec3 {
        let (point, normal) = self.surface_point(rng);
        match rng.random_range(0..3) {
            0 => point + normal * self.size * rng.random_range(-0.2..0.2),
            1 => point - normal * self.size * log_uniform(rng, 1e-3, 0.5),
            _ => point + unit(rng) * self.size * rng.random_range(0.0..5.0),
        }
    }

    /// A ray of a random kind: at the surface, from within, along the surface, along a coordinate, from the surface,
    /// anywhere.
    pub fn aim(&self, rng: &mut impl Rng) -> Aim {
        let (point, normal) = self.surface_point(rng);
        let distance = self.size * log_uniform(rng, 0.5, 100.0);
        let toward = |point: DVec3, direction: DVec3| ((point - direction * distance).as_vec3(), direction.as_vec3());
        match rng.random_range(0..8) {
            0..3 => toward(point, unit(rng)),
            3 => {
                let within = point - normal * self.size * log_uniform(rng, 1e-3, 0.3);
                (within.as_vec3(), unit(rng).as_vec3())
            }
            4 => {
                let (origin, direction) = toward(point, across(rng, normal));
                (jittered(rng, origin, 32), direction)
            }
            5 => {
                let axes = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];
                toward(point, axes[rng.random_range(0..6)])
            }
            6 => (point.as_vec3(), unit(rng).as_vec3()),
            _ => ((unit(rng) * distance).as_vec3(), unit(rng).as_vec3()),
        }
    }
}

/// A random specimen of one of the library's leaves, of a kind as [`Shape::random`] numbers them.
///
/// # Panics
/// Where `of` does not know the leaf: the number is that of another kind.
pub fn of_kind<S>(rng: &mut Pcg64, kind: usize, of: impl FnOnce(Leaf) -> Option<S>) -> Specimen<S> {
    let size = log_uniform(rng, 1e-2, 1e3);
    let shape = Shape::random(rng, kind, size, 4.0);
    let leaf = shape.leaf().expect("generators make valid shapes");
    Specimen {
        solid: of(leaf).expect("the kind is that of the leaf"),
        surface: (0..Specimen::<S>::POINTS).map(|_| shape.surface(rng)).collect(),
        size,
    }
}

/// A ray at the ends of the range of rays: coordinates of zero, the greatest, denormal ones, powers of two and any
/// bits.
pub fn wild(rng: &mut impl Rng) -> Aim {
    let coordinate = |rng: &mut dyn FnMut() -> u32, most: f32| {
        let bits = rng();
        let sign = if bits & 1 == 1 { -1.0 } else { 1.0 };
        sign * match bits >> 1 & 7 {
            0 => 0.0,
            1 => most,
            2 => f32::from_bits(bits >> 12),
            3 => 1.0,
            4 => most * f32::from_bits(0x3f00_0000 - (bits >> 8 << 4)),
            _ => Some(f32::from_bits(bits >> 2)).filter(|number| *number <= most).unwrap_or(2.0),
        }
    };
    loop {
        let mut bits = || rng.random::<u32>();
        let mut vector = |most: f32| {
            Vec3::new(
                coordinate(&mut bits, most),
                coordinate(&mut bits, most),
                coordinate(&mut bits, most),
            )
        };
        let aim = (vector(MAX_LENGTH), vector(MAX_SPEED));
        if gsdf_nostd::Ray::new(aim.0, aim.1).is_ok() {
            return aim;
        }
    }
}

/// The direction scaled exactly to a largest component from 1 to below 2, as formulas see it.
#[must_use]
pub fn scaled(direction: Vec3) -> Vec3 {
    let exponent = direction.abs().max_element().to_bits() & 0x7f80_0000;
    direction / f32::from_bits(exponent)
}

/// The line of a ray, in any arithmetic.
pub fn line<T: Real>(like: T, (origin, direction): Aim) -> Line<T> {
    Line {
        origin: V3::splat(like, origin),
        toward: Toward::new(V3::splat(like, scaled(direction))),
    }
}
