//! The operators: what each rounding may lose.

use super::{UNDERFLOW, WithError};
use crate::real::{Mask, Real};
use core::ops::{Add, Div, Mul, Neg, Sub};

impl<T: Real, const ALWAYS: bool> Add for WithError<T, ALWAYS> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let (a, b) = (self.value, other.value);
        let value = a + b;
        let (a_part, b_part) = (value - b, value - (value - b));
        let lost = ((a - a_part) + (b - b_part)).abs();
        let error = (self.error + other.error) + lost;
        if !ALWAYS || Self::is_finite(value).all() {
            // Of what is infinite, what is lost is not a number.
            Self { value, error }
        } else {
            endless_sum(self, other, value, error)
        }
    }
}

impl<T: Real, const ALWAYS: bool> Sub for WithError<T, ALWAYS> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<T: Real, const ALWAYS: bool> Mul for WithError<T, ALWAYS> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let value = self.value * other.value;
        let ordinary = Self::is_ordinary(value);
        if !ALWAYS || ordinary.all() {
            let inherited = self.value.abs() * other.error + (other.value.abs() + other.error) * self.error;
            let error = inherited + Self::half_ulp(value);
            Self { value, error }.where_known(ordinary)
        } else {
            odd_product(self, other, value)
        }
    }
}

impl<T: Real, const ALWAYS: bool> Div for WithError<T, ALWAYS> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let least = other.value.abs() - other.reach();
        let ordinary = Self::is_ordinary(value) & least.splat_like(0.0).lt(least);
        if !ALWAYS || ordinary.all() {
            let inherited = (self.error + value.abs() * other.error) / least;
            let error = inherited + Self::half_ulp(value);
            Self { value, error }.where_known(ordinary)
        } else {
            odd_quotient(self, other, value)
        }
    }
}

// What is rare, apart: in all of a formula's operations it would be most of its code.

#[cold]
#[inline(never)]
fn endless_sum<T: Real, const ALWAYS: bool>(a: WithError<T, ALWAYS>, b: WithError<T, ALWAYS>, value: T, error: T) -> WithError<T, ALWAYS> {
    value.apart(
        #[inline(always)]
        || {
            let zero = value.splat_like(0.0);
            let endless = !(WithError::<T, ALWAYS>::is_finite(a.value) & WithError::<T, ALWAYS>::is_finite(b.value));
            let sum = WithError::<T, ALWAYS>::rounded(value, a.error + b.error, zero, endless);
            WithError {
                value,
                error: T::select(WithError::<T, ALWAYS>::is_finite(value), error, sum.error),
            }
        },
    )
}

#[inline(never)]
fn odd_product<T: Real, const ALWAYS: bool>(a: WithError<T, ALWAYS>, b: WithError<T, ALWAYS>, value: T) -> WithError<T, ALWAYS> {
    value.apart(
        #[inline(always)]
        || {
            let zero = value.splat_like(0.0);
            let nothing = a.is_nothing() | b.is_nothing();
            if nothing.all() && WithError::<T, ALWAYS>::is_finite(value).all() {
                return WithError::<T, ALWAYS>::exact(value);
            }
            let inherited = a.value.abs() * b.error + (b.value.abs() + b.error) * a.error;
            let exact = a.is_exact() & b.is_exact();
            // Other lanes' numbers are no reason for another bound.
            let rounding = WithError::<T, ALWAYS>::half_ulp(value)
                + T::select(WithError::<T, ALWAYS>::is_ordinary(value), zero, zero.splat_like(UNDERFLOW));
            WithError::<T, ALWAYS>::rounded(
                value,
                T::select(exact | nothing, zero, inherited),
                T::select(nothing, zero, rounding),
                !(WithError::<T, ALWAYS>::is_finite(a.value) & WithError::<T, ALWAYS>::is_finite(b.value)),
            )
        },
    )
}

#[cold]
#[inline(never)]
fn odd_quotient<T: Real, const ALWAYS: bool>(a: WithError<T, ALWAYS>, b: WithError<T, ALWAYS>, value: T) -> WithError<T, ALWAYS> {
    value.apart(
        #[inline(always)]
        || {
            let zero = value.splat_like(0.0);
            let least = b.value.abs() - b.reach();
            let inherited = (a.error + value.abs() * b.error) / least;
            let inherited = T::select(zero.lt(least), inherited, zero.splat_like(f32::INFINITY));
            let exact = a.is_exact() & b.is_exact();
            let is_ordinary = WithError::<T, ALWAYS>::is_ordinary(value) & zero.lt(least);
            let rounding = WithError::<T, ALWAYS>::half_ulp(value) + T::select(is_ordinary, zero, zero.splat_like(UNDERFLOW));
            WithError::<T, ALWAYS>::rounded(
                value,
                T::select(exact, zero, inherited),
                T::select(a.is_nothing(), zero, rounding),
                !WithError::<T, ALWAYS>::is_finite(a.value) | b.is_nothing(),
            )
        },
    )
}

#[cold]
#[inline(never)]
pub(super) fn odd_root<T: Real, const ALWAYS: bool>(square: WithError<T, ALWAYS>) -> WithError<T, ALWAYS> {
    square.value.apart(
        #[inline(always)]
        || {
            let zero = square.value.splat_like(0.0);
            let negative = square.value.lt(zero);
            let most = (square.value + square.reach()).max(zero).sqrt();
            let value = T::select(negative & zero.lt(most), zero, square.value.sqrt());
            let inherited = T::select(square.reach().lt(square.value), square.error / value, value + most);
            let inherited = T::select(square.is_exact(), zero, inherited);
            WithError::<T, ALWAYS>::rounded(
                value,
                inherited,
                WithError::<T, ALWAYS>::half_ulp(value),
                !WithError::<T, ALWAYS>::is_finite(square.value),
            )
        },
    )
}

impl<T: Real, const ALWAYS: bool> Neg for WithError<T, ALWAYS> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            error: self.error,
        }
    }
}
