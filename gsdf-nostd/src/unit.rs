//! Units of length, for scenes far smaller or larger than the range of the formulas.

use crate::invalid::{Fault, Invalid};
use crate::range::max_norm;
use crate::ray::{Ray, RayError};
use glam::Vec3;

/// A power of two that a scene's numbers are measured in, so that they are in range.
///
/// The formulas hold for coordinates up to 2<sup>30</sup> and sizes from 2<sup>-20</sup>, where none of their products
/// overflows or loses digits by underflow; what lies outside is refused. A scene of molecules in metres, or of planets in
/// millimetres, has a unit of its own: each of its numbers is divided by it where the scene is made, each ray where it is
/// made, and distances are multiplied by it where they come out. A power of two changes no digit of a number, so a scene
/// at 1e30 has the bits of one at 1, and no query has to look for the size of anything.
///
/// Directions and transforms that turn have no unit. The range is 2<sup>-20</sup> to 2<sup>30</sup> about the unit: a scene
/// whose sizes spread further than that is refused in every unit.
///
/// ```
/// use gsdf_nostd::{Sphere, Solid, Unit};
/// use glam::{Vec3, vec3};
///
/// // The Earth from the Sun, in millimetres.
/// let unit = Unit::of(1.5e14)?;
/// let earth = Sphere::new(unit.point(vec3(1.5e14, 0.0, 0.0)), unit.length(6.371e9))?;
/// let (ray, parameter) = unit.ray(Vec3::ZERO, Vec3::X)?;
/// let distance = parameter.to_world(earth.gsdf(ray.origin(), ray.direction()));
/// assert!((distance / (1.5e14 - 6.371e9) - 1.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unit {
    exponent: i32,
}

impl Unit {
    /// The unit the world is measured in.
    pub const ONE: Self = Self { exponent: 0 };

    /// The largest power of two not above `extent`: the unit in which that, the largest magnitude of a scene's
    /// coordinates and sizes, lies from 1 to 2.
    ///
    /// # Errors
    /// Where `extent` is not finite or not positive.
    pub const fn of(extent: f32) -> Result<Self, Invalid> {
        if !extent.is_finite() {
            Err(Invalid::new("extent of a unit", extent, Fault::NotFinite))
        } else if extent <= 0.0 {
            Err(Invalid::new("extent of a unit", extent, Fault::NotPositive))
        } else {
            Ok(Self {
                exponent: exponent_of(extent),
            })
        }
    }

    /// The binary logarithm of the unit.
    #[must_use]
    pub const fn exponent(self) -> i32 {
        self.exponent
    }

    /// A length or coordinate of the world in this unit.
    ///
    /// Exact where the result is at least 2<sup>-126</sup> in magnitude; what is less is nothing beside the unit. A result
    /// beyond all numbers is the largest one: still too large for anything it could be.
    #[must_use]
    pub const fn length(self, world: f32) -> f32 {
        let length = scaled(world, -self.exponent);
        if length.is_infinite() && world.is_finite() {
            f32::MAX.copysign(world)
        } else {
            length
        }
    }

    /// A point of the world in this unit, exact like [`length`](Self::length).
    #[must_use]
    pub const fn point(self, world: Vec3) -> Vec3 {
        Vec3::new(self.length(world.x), self.length(world.y), self.length(world.z))
    }

    /// The ray of the world from `origin` along `direction`, in this unit, and the unit of its parameter: a hit at `t` is
    /// at `parameter.to_world(t)` in the world, in units of the length of `direction`.
    ///
    /// The direction, too, may be of any length, down to the least positive number.
    ///
    /// # Errors
    /// Where a component is not finite, the origin is beyond 2<sup>30</sup> units, or the direction is zero; the numbers in
    /// the error are in this unit.
    pub const fn ray(self, origin: Vec3, direction: Vec3) -> Result<(Ray, Self), RayError> {
        let speed = max_norm(direction);
        let exponent = if speed.is_finite() && speed > 0.0 {
            exponent_of(speed)
        } else {
            0_i32
        };
        let turned = Self { exponent }.point(direction);
        match Ray::new(self.point(origin), turned) {
            Ok(ray) => Ok((
                ray,
                Self {
                    exponent: self.exponent - exponent,
                },
            )),
            Err(error) => Err(error),
        }
    }

    /// A length, coordinate or parameter in this unit as the world has it: exact unless it overflows to infinity or is
    /// below the least normal number.
    #[must_use]
    pub const fn to_world(self, length: f32) -> f32 {
        scaled(length, self.exponent)
    }

    /// A point in this unit as the world has it.
    #[must_use]
    pub const fn point_to_world(self, point: Vec3) -> Vec3 {
        Vec3::new(self.to_world(point.x), self.to_world(point.y), self.to_world(point.z))
    }
}

/// The exponent of the largest power of two not above a positive number.
const fn exponent_of(value: f32) -> i32 {
    // Every `f32`, the subnormal ones included, is a normal `f64`.
    (((value as f64).to_bits() >> 52_u32) & 0x7ff) as i32 - 1023
}

/// A number times a power of two between 2^-1000 and 2^1000, rounded once.
const fn scaled(value: f32, exponent: i32) -> f32 {
    let power = f64::from_bits(((1023 + exponent) as u64) << 52_u32);
    (value as f64 * power) as f32
}

#[cfg(test)]
mod tests {
    use super::Unit;
    use crate::invalid::Fault;
    use crate::leaf::{CappedCone, Solid, Sphere};
    use crate::ray::RayError;
    use glam::{Vec3, vec3};

    #[test]
    fn an_extent_lies_from_one_to_two_in_its_unit() {
        for extent in [f32::from_bits(1), 1e-42, 1e-30, 0.75, 1.0, 1.999_999_9, 2.0, 1e30, f32::MAX] {
            let unit = Unit::of(extent).unwrap();
            assert!((1.0..2.0).contains(&unit.length(extent)), "{extent}");
            assert_eq!(unit.to_world(unit.length(extent)), extent);
        }
        for (extent, fault) in [(0.0, Fault::NotPositive), (-1.0, Fault::NotPositive), (f32::NAN, Fault::NotFinite)] {
            assert_eq!(Unit::of(extent).unwrap_err().fault(), fault);
        }
    }

    /// From a thousandth of what a molecule measures to a quarter of the largest number there is.
    #[test]
    fn scenes_of_any_size_have_the_bits_of_one_at_one() {
        let (center, eye, forward) = (vec3(0.3, -0.2, 5.1), vec3(0.1, 0.4, -0.7), vec3(0.05, -0.06, 1.1));
        let (bottom, top) = (vec3(0.0, -0.5, 4.0), vec3(0.0, 0.75, 4.0));
        let ball = Sphere::new(center, 0.9).unwrap();
        let lamp = CappedCone::new(bottom, top, Vec3::Y, 0.8, 0.3).unwrap();
        let expected = [ball.gsdf(eye, forward), lamp.gsdf(eye, forward)];
        assert!(expected.iter().all(|distance| distance.is_finite()));
        for exponent in [-120, -100, -60, 0, 60, 100, 124] {
            let scale = 2.0_f32.powi(exponent);
            let unit = Unit::of(4.0 * scale).unwrap();
            let point = |point: Vec3| unit.point(point * scale);
            let length = |length: f32| unit.length(length * scale);
            let ball = Sphere::new(point(center), length(0.9)).unwrap();
            let lamp = CappedCone::new(point(bottom), point(top), Vec3::Y, length(0.8), length(0.3)).unwrap();
            for speed in [-140, -60, 0, 60, 126].map(|speed| 2.0_f32.powi(speed)) {
                let (ray, parameter) = unit.ray(eye * scale, forward * speed).unwrap();
                let found = [ball.gsdf(ray.origin(), ray.direction()), lamp.gsdf(ray.origin(), ray.direction())];
                // The last bits of a direction below the normal numbers are lost before it comes here.
                let exact = speed > 1e-37;
                for (found, expected) in found.into_iter().zip(expected) {
                    let (found, wanted) = (f64::from(found) * 2.0_f64.powi(parameter.exponent()), f64::from(expected));
                    let wanted = wanted * f64::from(scale) / f64::from(speed);
                    assert!((found / wanted - 1.0).abs() <= if exact { 0.0 } else { 1e-3 }, "{exponent} {speed}");
                }
            }
        }
    }

    #[test]
    fn what_is_no_ray_in_the_world_is_none_in_a_unit() {
        let unit = Unit::of(1e-30).unwrap();
        assert!(matches!(unit.ray(Vec3::NAN, Vec3::X), Err(RayError::OriginNotFinite(_))));
        assert!(matches!(unit.ray(Vec3::splat(1e30), Vec3::X), Err(RayError::OriginTooFar(_))));
        assert!(matches!(unit.ray(Vec3::ZERO, Vec3::ZERO), Err(RayError::DirectionZero(_))));
        assert!(matches!(unit.ray(Vec3::ZERO, Vec3::INFINITY), Err(RayError::DirectionNotFinite(_))));
        assert_eq!(Sphere::new(Vec3::ZERO, unit.length(1e30)).unwrap_err().fault(), Fault::TooLarge);
        assert_eq!(
            Sphere::new(Vec3::ZERO, Unit::ONE.length(1e-30)).unwrap_err().fault(),
            Fault::TooSmall
        );
    }
}
