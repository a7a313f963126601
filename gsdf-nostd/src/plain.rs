//! Textbook formulas, as an arithmetic.

use crate::real::{Lane, Real};
use core::ops::{Add, Div, Mul, Neg, Sub};

/// An arithmetic in which formulas take their textbook form: the operations are those of `T`, bit for bit.
///
/// Three formulas are written so that nothing large cancels in them: those of the sphere, of the cylinder's side and of
/// the cone's, and with these of every solid that has such a side. Here they take the discriminant as `B² - A C`, and the
/// cone does not first move the ray's origin to where the ray passes it. Everything else is the same, also the decisions
/// at boundaries.
///
/// - What it drops: a discriminant that is right to rounding. `B²` and `A C` grow with the square of the distance `d`,
///   so crossings are off by about `u (d / r)²` of the radius `r` (`u` the unit roundoff) instead of `u (d / r)`.
/// - How far it holds: in `f32` to `d / r` of a hundred or so, where crossings are off by some thousandths of the radius. At
///   a thousand radii one hit or miss in thirty is wrong, at ten thousand one in three.
/// - What it saves: about half the arithmetic of a sphere, more of a cone.
///
/// ```
/// use gsdf_nostd::{Plain, Ray, Real, Solid, Span, Sphere};
/// use glam::{Vec3, vec3};
///
/// let ball = Sphere::new(vec3(10_000.0, 0.0, 0.0), 1.0)?;
/// let ray = Ray::new(vec3(0.0, 0.999, 0.0), Vec3::X)?;
/// let robust: Span<f32> = ball.span_along(&ray.line(0.0));
/// let plain: Span<Plain<f32>> = ball.span_along(&ray.line(Plain(0.0)));
/// // A chord of 0.089 is half lost where 1e8 is taken from 1e8.
/// assert!((robust.exit - robust.enter - 0.089).abs() < 0.001);
/// assert!((plain.exit.0 - plain.enter.0 - 0.089).abs() > 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Plain<T>(pub T);

macro_rules! operator {
    ($trait:ident, $name:ident) => {
        impl<T: $trait<Output = T>> $trait for Plain<T> {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(other.0))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<T: Neg<Output = T>> Neg for Plain<T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<T: Lane> From<f32> for Plain<T> {
    #[inline(always)]
    fn from(value: f32) -> Self {
        Self(T::from(value))
    }
}

impl<T: Real> Real for Plain<T> {
    type Mask = T::Mask;
    const LANES: usize = T::LANES;
    const ROBUST: bool = false;
    const ROUNDOFF: f32 = T::ROUNDOFF;
    const INLINED: bool = T::INLINED;
    type Scalar = Plain<T::Scalar>;

    #[inline(always)]
    fn splat_like(self, value: f32) -> Self {
        Self(self.0.splat_like(value))
    }
    #[inline(always)]
    fn lift_like(self, value: Self::Scalar) -> Self {
        Self(self.0.lift_like(value.0))
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0))
    }
    #[inline(always)]
    fn next_up(self) -> Self {
        Self(self.0.next_up())
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self::Mask {
        self.0.lt(other.0)
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self::Mask {
        self.0.le(other.0)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> Self::Mask {
        self.0.eq(other.0)
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Self(T::select(mask, yes.0, no.0))
    }
    // The packets' own minimum and maximum.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0))
    }
}

impl<T: Lane> Lane for Plain<T> {
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self.0.to_f32()
    }
    #[inline(always)]
    fn to_index(self) -> u32 {
        self.0.to_index()
    }
}
