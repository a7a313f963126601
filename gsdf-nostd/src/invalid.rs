//! Why a number was refused, and what would do.

use crate::range::{MAX_LENGTH, MIN_LENGTH, UNIT_TOLERANCE, larger, max_norm, unit_scale};
use core::fmt;
use glam::Vec3;

/// A parameter of a solid, a transform or a camera that describes nothing.
///
/// Names the parameter and carries the number found; its [`Display`](fmt::Display) form adds what would be right.
/// Refusing here is what keeps queries free of surprises: a solid made of nonsense would be an empty span, and an
/// empty span under a complement is a full one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Invalid {
    parameter: &'static str,
    found: f32,
    fault: Fault,
}

/// What is wrong with a parameter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
#[non_exhaustive]
pub enum Fault {
    /// NaN or infinite.
    NotFinite,
    /// A coordinate beyond ±[`MAX_LENGTH`].
    TooFar,
    /// A size that is zero or negative.
    NotPositive,
    /// A positive size below [`MIN_LENGTH`].
    TooSmall,
    /// A size above [`MAX_LENGTH`].
    TooLarge,
    /// A direction whose length is not one; the number found is its squared length.
    NotUnit,
    /// Two ends or faces in the wrong order; the number found is the distance from the first to the second.
    Reversed,
    /// A point that must lie on an axis and does not; the number found is its distance from it.
    OffAxis,
    /// An angle outside the open interval from 0 to 90 degrees.
    NotAcute,
    /// An angle below 90 degrees, or not below 180, where a wide one is meant.
    NotWide,
    /// Four points that do not lie in a plane.
    NotPlanar,
    /// Four points that are not, in their order, the corners of a convex figure.
    NotConvex,
    /// A sphere that contains the other, or all but a last rest of it.
    Contained,
    /// Vectors that coincide, vanish or are parallel where they must not be.
    Degenerate,
    /// A matrix without an inverse, or one that stretches by more than 2^20 or less than 2^-20, or some lengths 2^20 times
    /// as much as others; the number found is its determinant.
    Singular,
}

impl Invalid {
    pub(crate) const fn new(parameter: &'static str, found: f32, fault: Fault) -> Self {
        Self { parameter, found, fault }
    }

    /// The name of the parameter that was refused.
    #[must_use]
    pub const fn parameter(&self) -> &'static str {
        self.parameter
    }

    /// The number found in it.
    #[must_use]
    pub const fn found(&self) -> f32 {
        self.found
    }

    /// What is wrong with it.
    #[must_use]
    pub const fn fault(&self) -> Fault {
        self.fault
    }

    /// What is wrong and what would do, without the number found: all that a `const` panic can print.
    #[must_use]
    pub const fn message(&self) -> &'static str {
        match self.fault {
            Fault::NotFinite => "a parameter is NaN or infinite: give a finite number",
            Fault::TooFar => "a coordinate is out of range: keep it within -2^30..2^30, or measure the scene in a Unit",
            Fault::NotPositive => "a size is zero or negative: give one from 2^-20 to 2^30",
            Fault::TooSmall => "a size is too small: give one from 2^-20 to 2^30, or measure the scene in a Unit",
            Fault::TooLarge => "a size is too large: give one from 2^-20 to 2^30, or measure the scene in a Unit",
            Fault::NotUnit => "a direction is not of unit length: normalize it",
            Fault::Reversed => "two ends or faces coincide or are in the wrong order: swap them or move them apart",
            Fault::OffAxis => "a point does not lie on the axis it ends: move it there",
            Fault::NotAcute => "an angle is not strictly between 0 and 90 degrees: use a half-space or a complement",
            Fault::NotWide => "an angle is not from 90 to below 180 degrees: use the narrow solid, or a sphere",
            Fault::NotPlanar => "four corners do not lie in a plane: move one, or use two triangles",
            Fault::NotConvex => "four corners are not in order around a convex figure: reorder them, or use two triangles",
            Fault::Contained => "one sphere contains the other: use the larger one alone",
            Fault::Degenerate => "points coincide or directions are parallel: move them apart",
            Fault::Singular => "a matrix has no inverse, or stretches by more than 2^20 or less than 2^-20, or unequally by more than 2^20",
        }
    }
}

impl fmt::Display for Invalid {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}: {}", self.parameter, self.found, self.message())
    }
}

impl core::error::Error for Invalid {}

/// Unwraps a `Result` at compile time: the value, or a compile error that says what is wrong.
///
/// The expression is evaluated in a `const` block, so this can never panic at run time.
///
/// ```
/// use gsdf_nostd::{Sphere, valid};
/// use glam::Vec3;
///
/// const BALL: Sphere = valid!(Sphere::new(Vec3::ZERO, 1.0));
/// ```
///
/// ```compile_fail
/// use gsdf_nostd::{Sphere, valid};
/// use glam::Vec3;
///
/// const BALL: Sphere = valid!(Sphere::new(Vec3::ZERO, -1.0));
/// ```
#[macro_export]
macro_rules! valid {
    ($result:expr) => {
        const {
            match $result {
                Ok(value) => value,
                Err(error) => panic!("{}", error.message()),
            }
        }
    };
}

/// `value` if it is a coordinate: finite and within ±[`MAX_LENGTH`].
pub(crate) const fn coordinate(parameter: &'static str, value: f32) -> Result<f32, Invalid> {
    if !value.is_finite() {
        Err(Invalid::new(parameter, value, Fault::NotFinite))
    } else if value.abs() > MAX_LENGTH {
        Err(Invalid::new(parameter, value, Fault::TooFar))
    } else {
        Ok(value)
    }
}

/// `value` if it is a length: from [`MIN_LENGTH`] to [`MAX_LENGTH`].
pub(crate) const fn length(parameter: &'static str, value: f32) -> Result<f32, Invalid> {
    let fault = if !value.is_finite() {
        Fault::NotFinite
    } else if value <= 0.0 {
        Fault::NotPositive
    } else if value < MIN_LENGTH {
        Fault::TooSmall
    } else if value > MAX_LENGTH {
        Fault::TooLarge
    } else {
        return Ok(value);
    };
    Err(Invalid::new(parameter, value, fault))
}

/// `value` if it is a point: three coordinates.
pub(crate) const fn point(parameter: &'static str, value: Vec3) -> Result<Vec3, Invalid> {
    match (
        coordinate(parameter, value.x),
        coordinate(parameter, value.y),
        coordinate(parameter, value.z),
    ) {
        (Ok(_), Ok(_), Ok(_)) => Ok(value),
        (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
    }
}

/// `value` if it is a direction of unit length, to [`UNIT_TOLERANCE`] of its square.
pub(crate) const fn unit(parameter: &'static str, value: Vec3) -> Result<Vec3, Invalid> {
    match point(parameter, value) {
        Ok(_) => {
            let (x, y, z) = (value.x as f64, value.y as f64, value.z as f64);
            let squared = x * x + y * y + z * z;
            if (squared - 1.0).abs() <= UNIT_TOLERANCE {
                Ok(value)
            } else {
                Err(Invalid::new(parameter, squared as f32, Fault::NotUnit))
            }
        }
        Err(error) => Err(error),
    }
}

/// Whether `axis` is a unit vector that leads from one point to another, at least [`MIN_LENGTH`] apart; `names` are
/// those of the three.
///
/// The second may lie off the axis through the first by 2^-18 of their distance and of their coordinates: what
/// rounding an oblique axis does, and no more.
pub(crate) const fn ends(names: [&'static str; 3], from: Vec3, to: Vec3, axis: Vec3) -> Result<(), Invalid> {
    match (point(names[0], from), point(names[1], to), unit(names[2], axis)) {
        (Ok(_), Ok(_), Ok(_)) => {}
        (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => return Err(error),
    }
    let (x, y, z) = (
        to.x as f64 - from.x as f64,
        to.y as f64 - from.y as f64,
        to.z as f64 - from.z as f64,
    );
    let (ax, ay, az) = (axis.x as f64, axis.y as f64, axis.z as f64);
    let along = x * ax + y * ay + z * az;
    let (u, v, w) = (y * az - z * ay, z * ax - x * az, x * ay - y * ax);
    let off_squared = u * u + v * v + w * w;
    let allowed = (along.abs() + larger(max_norm(from), max_norm(to)) as f64) / 262_144.0_f64;
    if along <= 0.0 {
        Err(Invalid::new("distance between ends along the axis", along as f32, Fault::Reversed))
    } else if along < MIN_LENGTH as f64 {
        Err(Invalid::new("distance between ends", along as f32, Fault::TooSmall))
    } else if off_squared > allowed * allowed {
        Err(Invalid::new(
            "squared distance of the second end from the axis",
            off_squared as f32,
            Fault::OffAxis,
        ))
    } else {
        Ok(())
    }
}

/// The unit vector from one point towards another, exact where they differ in one coordinate.
pub(crate) fn axis_between(names: [&'static str; 3], from: Vec3, to: Vec3) -> Result<Vec3, Invalid> {
    let difference = point(names[1], to)? - point(names[0], from)?;
    if max_norm(difference) < MIN_LENGTH {
        return Err(Invalid::new("distance between ends", max_norm(difference), Fault::Degenerate));
    }
    // An exact power of two keeps the squares in range.
    let scaled = difference * unit_scale(max_norm(difference));
    Ok(scaled / libm::sqrtf(scaled.dot(scaled)))
}
