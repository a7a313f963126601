//! Square roots, correctly rounded: the one operation of [`Real`](crate::Real) for which stable `core` has no name.

/// The compiler's own, which it schedules and encodes for the processor it builds for.
///
/// Where there is no operating system there is no standard library: there the feature changes nothing, so that a
/// workspace may have it on for a host and build for a board as well.
#[cfg(all(feature = "std", not(target_os = "none")))]
mod provider {
    extern crate std;

    #[inline(always)]
    pub(crate) fn single(square: f32) -> f32 {
        square.sqrt()
    }

    #[inline(always)]
    pub(crate) fn double(square: f64) -> f64 {
        square.sqrt()
    }
}

#[cfg(not(all(feature = "std", not(target_os = "none"))))]
mod provider {
    pub(crate) use libm::{sqrt as double, sqrtf as single};
}

pub(crate) use provider::{double, single};
