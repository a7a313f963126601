//! A simulated time-of-flight sensor of 8 by 8 zones.

use core::fmt;
use core::ops::Range;
use glam::Vec3;
use gsdf_nostd::{Camera, Invalid, Lane, Program, ProgramError, Ray, RayError, Solid, Span, V3};

/// A sensor that tells distances in 8 by 8 zones, as the common time-of-flight parts do: one ray through the middle of
/// each, on a square field of view.
///
/// Zones are numbered row by row from the upper left corner of what the sensor sees: zone `8 y + x`. Distances are
/// Euclidean, from the sensor along unit directions, not depths. The rays are made once and take 2.3 KB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RangeFinder {
    rays: [Ray; Self::ZONES],
    near: f32,
    far: f32,
}

/// Why something is not a range finder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RangeFinderError {
    /// The place, what it looks at, its upright or its field of view.
    Camera(Invalid),
    /// A zone has no ray.
    Ray(RayError),
    /// The limits do not satisfy `0 <= near < far < infinity`, or hold NaN.
    Limits(f32, f32),
}

impl fmt::Display for RangeFinderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Camera(error) => error.fmt(f),
            Self::Ray(error) => error.fmt(f),
            Self::Limits(near, far) => {
                write!(f, "range finder limits {near}..{far}: must satisfy 0 <= near < far, both finite")
            }
        }
    }
}

impl core::error::Error for RangeFinderError {}

impl RangeFinder {
    /// The number of zones in a row, and of rows.
    pub const SIDE: usize = 8;
    /// The number of zones.
    pub const ZONES: usize = Self::SIDE * Self::SIDE;

    /// The sensor at `eye` that looks at `target`, with `up` upward. `tangent` is that of half its field of view along
    /// a side (0.414 for the 45 degrees of common parts); `limits` are the nearest and the farthest distance it can
    /// tell. All in the units of the scene.
    ///
    /// # Errors
    /// Where there is no such [camera](Camera::pinhole), or unless `0 <= limits.start < limits.end`, both finite.
    pub fn new(eye: Vec3, target: Vec3, up: Vec3, tangent: f32, limits: Range<f32>) -> Result<Self, RangeFinderError> {
        let (near, far) = (limits.start, limits.end);
        if !(0.0 <= near && near < far && far < f32::INFINITY) {
            return Err(RangeFinderError::Limits(near, far));
        }
        let camera = Camera::pinhole(eye, target, up, tangent).map_err(RangeFinderError::Camera)?;
        let raster = camera.raster(Self::SIDE as u32, Self::SIDE as u32);
        let forward = Ray::new(eye, camera.forward()).map_err(RangeFinderError::Ray)?;
        let mut rays = [forward; Self::ZONES];
        for (zone, ray) in (0_u32..).zip(&mut rays) {
            let slanted = raster.ray(zone % 8, zone / 8).map_err(RangeFinderError::Ray)?;
            let unit = V3::from(slanted.direction()).normalized_or(V3::from(camera.forward()));
            *ray = Ray::new(eye, unit.into()).map_err(RangeFinderError::Ray)?;
        }
        Ok(Self { rays, near, far })
    }

    /// The rays of the zones: their directions are of unit length.
    #[must_use]
    pub const fn rays(&self) -> &[Ray; Self::ZONES] {
        &self.rays
    }

    /// One reading: in each zone the distance to what `program` shows there.
    ///
    /// Infinite where there is nothing before the far limit. What is nearer than the near limit reads as the near
    /// limit, since it hides all behind it; so does every zone of a sensor that is inside of a solid.
    ///
    /// Costs 64 casts, in the arithmetic of `scratch`.
    ///
    /// # Errors
    /// Where `scratch` is shorter than the program has leaves.
    pub fn read<L: Solid, T: Lane>(&self, program: &Program<'_, L>, scratch: &mut [Span<T>]) -> Result<[f32; Self::ZONES], ProgramError> {
        let mut distances = [f32::INFINITY; Self::ZONES];
        for (distance, ray) in distances.iter_mut().zip(&self.rays) {
            let seen = program.along(*ray, &mut *scratch)?.march::<T>();
            let nearest = seen.t.to_f32();
            if seen.inside || nearest < self.near {
                *distance = self.near;
            } else if nearest < self.far {
                *distance = nearest;
            }
        }
        Ok(distances)
    }
}

/// A distance in metres as the whole millimetres that sensors report: to the nearest, `u16::MAX` from there on and
/// without a target.
#[must_use]
pub fn millimetres(metres: f32) -> u16 {
    // `as` saturates.
    (metres * 1000.0 + 0.5) as u16
}
