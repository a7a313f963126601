//! Rays, refused when they are not rays.

use crate::bounded::WithError;
use crate::range::{MAX_LENGTH, MAX_SPEED, max_norm, max_norm_bits, unit_scale};
use crate::real::{Lane, Real};
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use core::fmt;
use core::ops::Range;
use glam::Vec3;

/// The half-line `origin + t direction` for `t` in a range, checked once so that no query has to.
///
/// The parameter `t` is in units of the direction's length: a distance where the direction is of unit length, which
/// it need not be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    origin: Vec3,
    direction: Vec3,
    /// The power of two that brings the direction's largest component into [1, 2).
    scale: f32,
    range: (f32, f32),
}

/// Why something is not a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum RayError {
    /// The origin has a component that is NaN or infinite.
    OriginNotFinite(Vec3),
    /// The origin has a component beyond ±[`MAX_LENGTH`].
    OriginTooFar(Vec3),
    /// The direction has a component that is NaN or infinite.
    DirectionNotFinite(Vec3),
    /// The direction is zero.
    DirectionZero(Vec3),
    /// The largest component of the direction is below 2^-40.
    DirectionTooShort(Vec3),
    /// A component of the direction is beyond ±2^40.
    DirectionTooLong(Vec3),
    /// The range does not satisfy `0 <= start < end`, or holds NaN.
    Range(f32, f32),
}

impl fmt::Display for RayError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OriginNotFinite(found) => write!(f, "ray origin {found}: every coordinate must be finite"),
            Self::OriginTooFar(found) => {
                write!(f, "ray origin {found}: every coordinate must be within -2^30..2^30")
            }
            Self::DirectionNotFinite(found) => write!(f, "ray direction {found}: every component must be finite"),
            Self::DirectionZero(found) => write!(f, "ray direction {found}: must not be zero"),
            Self::DirectionTooShort(found) => {
                write!(f, "ray direction {found}: some component must be at least 2^-40 in magnitude")
            }
            Self::DirectionTooLong(found) => {
                write!(f, "ray direction {found}: every component must be within -2^40..2^40")
            }
            Self::Range(start, end) => write!(f, "ray range {start}..{end}: must satisfy 0 <= start < end"),
        }
    }
}

impl core::error::Error for RayError {}

impl Ray {
    /// The ray from `origin` along `direction`, over the range from 0 to infinity.
    ///
    /// # Errors
    /// Where a component is not finite, the origin is beyond ±2^30, the direction is zero, or its largest component
    /// is not from 2^-40 to 2^40.
    pub const fn new(origin: Vec3, direction: Vec3) -> Result<Self, RayError> {
        let (far, fast) = (max_norm_bits(origin), max_norm_bits(direction));
        if far > MAX_LENGTH.to_bits() || fast < MIN_SPEED.to_bits() || fast > MAX_SPEED.to_bits() {
            return Err(Self::refusal(origin, direction));
        }
        Ok(Self {
            origin,
            direction,
            scale: unit_scale(f32::from_bits(fast)),
            range: (0.0, f32::INFINITY),
        })
    }

    /// Why these two make no ray, apart from [`new`](Self::new) so that this is little code.
    #[cold]
    const fn refusal(origin: Vec3, direction: Vec3) -> RayError {
        if !is_finite(origin) {
            RayError::OriginNotFinite(origin)
        } else if !is_in_range(origin) {
            RayError::OriginTooFar(origin)
        } else if !is_finite(direction) {
            RayError::DirectionNotFinite(direction)
        } else if max_norm(direction) == 0.0 {
            RayError::DirectionZero(direction)
        } else if max_norm(direction) < MIN_SPEED {
            RayError::DirectionTooShort(direction)
        } else {
            RayError::DirectionTooLong(direction)
        }
    }

    /// The same ray over another range of its parameter. What happens at `range.start` itself counts as past, and so does
    /// what happens below 2^-126, the least normal number, of this ray's parameter or of that of its [`line`](Self::line);
    /// what happens at `range.end` counts as not reached.
    ///
    /// # Errors
    /// Unless `0 <= range.start < range.end`.
    pub const fn within(self, range: Range<f32>) -> Result<Self, RayError> {
        if range.start >= 0.0 && range.start < range.end {
            Ok(Self {
                range: (range.start, range.end),
                ..self
            })
        } else {
            Err(RayError::Range(range.start, range.end))
        }
    }

    /// Where the ray starts.
    #[must_use]
    pub const fn origin(&self) -> Vec3 {
        self.origin
    }

    /// Its direction, as it was given.
    #[must_use]
    pub const fn direction(&self) -> Vec3 {
        self.direction
    }

    /// The range of its parameter.
    #[must_use]
    pub const fn range(&self) -> Range<f32> {
        self.range.0..self.range.1
    }

    /// The point at parameter `t`, each coordinate with two roundings.
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }

    /// The line the formulas see, in the arithmetic of `like`: the ray with its direction scaled, exactly, to a largest
    /// component in [1, 2). Its parameter is another one, see [`parameter_of`](Self::parameter_of).
    #[inline]
    pub fn line<T: Real<Scalar = T>>(&self, like: T) -> Line<T> {
        let scale = like.splat_like(self.scale);
        Line {
            origin: V3::splat(like, self.origin),
            toward: Toward::new(V3::splat(like, self.direction).times_power(scale)),
        }
    }

    /// The parameter on [`line`](Self::line) that belongs to a parameter of this ray; exact unless it overflows, or falls below
    /// the normal numbers.
    #[inline]
    pub fn parameter_on_line<T: Real>(self, t: T) -> T {
        t.times_power(t.splat_like(unit_scale(self.scale)))
    }

    /// The least parameter at which a crossing counts: that which is 2^-126, the least normal number, of this ray or of
    /// its [`line`](Self::line), whichever is later.
    ///
    /// So no crossing is rounded to 0 where its parameter becomes that of the ray, and whoever asks again from a crossing on
    /// gets the next one; and no query starts at a number below the normal ones, at which some processors take a hundred
    /// times as long.
    const fn earliest(self) -> f32 {
        // 2^-126 times the scale, which is a power of two, if that is more than 1; without a product where one is a call.
        let one = 1.0_f32.to_bits();
        let scale = self.scale.to_bits();
        f32::from_bits(if scale > one { scale } else { one } - (one - f32::MIN_POSITIVE.to_bits()))
    }

    /// Where queries start on [`line`](Self::line): at the start of the range, but not before 2^-126 of the ray's parameter
    /// and of the line's. What is nearer than that counts as past.
    #[inline]
    pub fn start_on_line<T: Real>(self, like: T) -> T {
        let start = like.splat_like(self.range.0);
        self.parameter_on_line(start.max(like.splat_like(self.earliest())))
    }

    /// The next end of a span on [`line`](Self::line) from the origin on, in the parameter of this ray, with the sign that
    /// [`Span::signed_crossing`] gives it.
    #[inline]
    pub fn signed_crossing<T: Lane>(&self, span: Span<T>) -> T {
        let found = self.parameter_of(span.signed_crossing(T::from(0.0)));
        if found.abs() > T::from(self.earliest()) {
            return found;
        }
        // As rare as it is it need not be cheap.
        let start = self.parameter_on_line(T::from(self.earliest()));
        self.parameter_of(span.signed_crossing(start))
    }

    /// The parameter of this ray that belongs to a parameter on [`line`](Self::line); exact unless it overflows to
    /// infinity.
    #[inline]
    pub fn parameter_of<T: Real>(self, t: T) -> T {
        t.times_power(t.splat_like(self.scale))
    }
}

/// A line in some frame and arithmetic: where it starts and all that follows from where it points.
#[derive(Clone, Copy, Debug)]
pub struct Line<T> {
    /// The point at parameter 0.
    pub origin: V3<T>,
    /// The direction.
    pub toward: Toward<T>,
}

impl<T: Real> Line<T> {
    /// The same line, which is exact, with bounds on the errors of what was computed from it.
    #[inline(always)]
    pub fn bounded<const ALWAYS: bool>(&self) -> Line<WithError<T, ALWAYS>> {
        let V3 { x, y, z } = self.origin;
        Line {
            origin: V3::new(WithError::exact(x), WithError::exact(y), WithError::exact(z)),
            toward: self.toward.bounded(),
        }
    }
}

const fn is_finite(v: Vec3) -> bool {
    max_norm_bits(v) < f32::INFINITY.to_bits()
}

/// The least magnitude of the largest component of a direction.
const MIN_SPEED: f32 = 1.0 / MAX_SPEED;

/// Whether a point has finite coordinates of at most [`MAX_LENGTH`] in magnitude.
pub(crate) const fn is_in_range(v: Vec3) -> bool {
    max_norm_bits(v) <= MAX_LENGTH.to_bits()
}

#[cfg(test)]
mod tests {
    use super::{Ray, RayError};
    use glam::{Vec3, vec3};

    #[test]
    fn what_is_not_a_ray_is_refused() {
        let nan = vec3(0.0, f32::NAN, 0.0);
        assert!(matches!(Ray::new(nan, Vec3::X), Err(RayError::OriginNotFinite(_))));
        assert!(matches!(Ray::new(Vec3::ZERO, nan), Err(RayError::DirectionNotFinite(_))));
        assert!(matches!(Ray::new(Vec3::ZERO, Vec3::ZERO), Err(RayError::DirectionZero(_))));
        assert!(matches!(
            Ray::new(Vec3::ZERO, vec3(1e-40, 0.0, 0.0)),
            Err(RayError::DirectionTooShort(_))
        ));
        assert!(matches!(Ray::new(vec3(1e10, 0.0, 0.0), Vec3::X), Err(RayError::OriginTooFar(_))));
        let ray = Ray::new(Vec3::ZERO, Vec3::X).unwrap();
        for range in [-1.0..1.0, 1.0..1.0, f32::NAN..1.0, 0.0..f32::NAN] {
            assert!(ray.within(range).is_err());
        }
    }

    #[test]
    fn parameters_are_in_units_of_the_direction() {
        for length in [1e-12_f32, 0.3, 1.0, 7.0, 1e12] {
            let ray = Ray::new(Vec3::ZERO, vec3(0.0, length, 0.0)).unwrap();
            assert_eq!(ray.parameter_of(ray.parameter_on_line(0.75_f32)), 0.75);
        }
    }
}
