//! The queries whose cost is measured: the same ones on every target, whatever is measured of them.

use crate::scenes::{S1, S2, S3, Scene};
use crate::solids::{self, Visitor};
use core::fmt;
use core::hint::black_box;
use glam::{Vec3, vec3};
use gsdf_nostd::{Camera, Invalid, Lane, ProgramError, Ray, RayError, Solid, Span, SphereTracer, V3};

/// The rays along each side of the pictures whose rays are measured, of a solid and of a scene.
pub const SIDE: u32 = 8;

/// Something that takes the measure of queries: their instructions, their operations.
pub trait Meter {
    /// Does a query and adds what it took.
    fn query<R>(&mut self, query: impl FnOnce() -> R) -> R;

    /// What was added since the last time was the cost of this item.
    fn finish(&mut self, item: &Item);
}

/// What was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Item {
    /// Of what kind it is: `leaf` or `scene`.
    pub kind: &'static str,
    /// The name of the solid or the scene.
    pub name: &'static str,
    /// The question it was asked.
    pub query: &'static str,
    /// What the arithmetic is called, where it is not plain `f32`.
    pub arithmetic: &'static str,
}

/// As a path without spaces: `leaf/capped-cone/gsdf`, `scene/s1/traced-fpu`.
impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/", self.kind)?;
        for (place, word) in self.name.split(' ').enumerate() {
            let separator = if place == 0 { "" } else { "-" };
            write!(f, "{separator}{word}")?;
        }
        write!(f, "/{}", self.query)?;
        if self.arithmetic.is_empty() {
            Ok(())
        } else {
            write!(f, "-{}", self.arithmetic)
        }
    }
}

/// Why there was nothing to measure; no error of the scenes of this package.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CostError {
    /// The camera was none.
    Camera(Invalid),
    /// A ray was none.
    Ray(RayError),
    /// The scratch memory was too short.
    Scratch(ProgramError),
}

impl fmt::Display for CostError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Camera(error) => error.fmt(f),
            Self::Ray(error) => error.fmt(f),
            Self::Scratch(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for CostError {}

impl From<Invalid> for CostError {
    fn from(error: Invalid) -> Self {
        Self::Camera(error)
    }
}

impl From<RayError> for CostError {
    fn from(error: RayError) -> Self {
        Self::Ray(error)
    }
}

impl From<ProgramError> for CostError {
    fn from(error: ProgramError) -> Self {
        Self::Scratch(error)
    }
}

/// The scenes whose rays are measured: those a small processor casts in reasonable time.
const SCENES: [&Scene; 3] = [&S1, &S2, &S3];

/// The leaves of the largest of them.
const LEAVES: usize = S3.program.leaves();

/// Measures everything, in the arithmetic `T`: [`of_leaves`], and [`of_scene`] for the scenes of up to 64 leaves.
///
/// # Errors
/// Never.
pub fn of_everything<T: Lane>(arithmetic: &'static str, meter: &mut impl Meter) -> Result<(), CostError> {
    of_leaves::<T>(arithmetic, meter)?;
    let mut scratch = [Span::empty_like(T::from(0.0)); LEAVES];
    SCENES.iter().try_for_each(|scene| of_scene(scene, arithmetic, &mut scratch, meter))
}

/// The rays at a solid of [`solids`]: a picture of it, from outside and above.
fn rays() -> Result<impl Iterator<Item = Result<Ray, RayError>>, Invalid> {
    let raster = Camera::pinhole(vec3(2.3, 1.9, -3.1), Vec3::ZERO, Vec3::Y, 0.3)?.raster(SIDE, SIDE);
    Ok((0..SIDE * SIDE).map(move |number| raster.ray(number % SIDE, number / SIDE)))
}

/// Measures both distances of a solid of each kind, in the arithmetic `T`.
///
/// The generalized one from two coordinates of the caller's, with all checks, as [`Solid::gsdf`] has it; the standard
/// one as sphere tracing asks for it, [`Solid::distance`], at points along the same rays.
///
/// # Errors
/// Never.
pub fn of_leaves<T: Lane>(arithmetic: &'static str, meter: &mut impl Meter) -> Result<(), CostError> {
    struct Leaves<'m, M, T> {
        meter: &'m mut M,
        arithmetic: &'static str,
        zero: T,
        outcome: Result<(), CostError>,
    }

    impl<M: Meter, T: Lane> Leaves<'_, M, T> {
        fn measure<S: Solid>(&mut self, name: &'static str, solid: &S) -> Result<(), CostError> {
            let item = |query| Item {
                kind: "leaf",
                name,
                query,
                arithmetic: self.arithmetic,
            };
            for ray in rays()? {
                let (p, v) = black_box(ray.map(|ray| (ray.origin(), ray.direction()))?);
                black_box(self.meter.query(|| gsdf(black_box(solid), p, v, self.zero)));
            }
            self.meter.finish(&item("gsdf"));
            for (number, ray) in rays()?.enumerate() {
                let p = black_box(ray?.at(0.5 + 0.015_625 * number as f32));
                black_box(self.meter.query(|| black_box(solid).distance(V3::splat(self.zero, p))));
            }
            self.meter.finish(&item("sdf"));
            Ok(())
        }
    }

    impl<M: Meter, T: Lane> Visitor for Leaves<'_, M, T> {
        fn leaf<S: Solid>(&mut self, name: &'static str, solid: S) {
            if self.outcome.is_ok() {
                self.outcome = self.measure(name, &solid);
            }
        }
    }

    let mut leaves = Leaves {
        meter,
        arithmetic,
        zero: T::from(0.0),
        outcome: Ok(()),
    };
    solids::visit(&mut leaves);
    leaves.outcome
}

/// [`Solid::gsdf`] in the arithmetic of `like`.
fn gsdf<S: Solid, T: Lane>(solid: &S, p: Vec3, v: Vec3, like: T) -> T {
    match Ray::new(p, v) {
        Ok(ray) => ray.signed_crossing(solid.span_along(&ray.line(like))),
        Err(_) => T::from(f32::NAN),
    }
}

/// Measures what a ray of a scene's picture takes, in the arithmetic of the scratch memory: the closed form, with
/// normal and leaf, and sphere tracing with the settings of [`SphereTracer::default`], which gives a distance only.
///
/// The marcher is told how far the farthest thing in the picture is, and gives up a hundredth beyond.
///
/// # Errors
/// Where the scratch memory is shorter than the scene has leaves.
pub fn of_scene<T: Lane>(
    scene: &Scene,
    arithmetic: &'static str,
    scratch: &mut [Span<T>],
    meter: &mut impl Meter,
) -> Result<(), CostError> {
    let raster = scene.camera()?.raster(SIDE, SIDE);
    let rays = || (0..SIDE * SIDE).map(|number| raster.ray(number % SIDE, number / SIDE));
    let item = |query| Item {
        kind: "scene",
        name: scene.name,
        query,
        arithmetic,
    };
    let mut farthest = 0.0_f32;
    for ray in rays() {
        let ray = black_box(ray?);
        let hit = meter.query(|| scene.program.along(ray, scratch).map(|sight| sight.cast()))?;
        farthest = black_box(hit).map_or(farthest, |hit| farthest.max(hit.t));
    }
    meter.finish(&item("closed"));
    let tracer = black_box(SphereTracer::default());
    for ray in rays() {
        let ray = black_box(ray?.within(0.0..1.01 * farthest)?);
        black_box(meter.query(|| tracer.cast_in(&scene.program, &ray, T::from(0.0))));
    }
    meter.finish(&item("traced"));
    Ok(())
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{Item, Meter, SIDE, of_leaves, of_scene};
    use crate::scenes::S2;
    use gsdf_nostd::Span;
    use std::string::{String, ToString};
    use std::vec::Vec;

    #[derive(Default)]
    struct Queries {
        number: u32,
        items: Vec<(String, u32)>,
    }

    impl Meter for Queries {
        fn query<R>(&mut self, query: impl FnOnce() -> R) -> R {
            self.number += 1;
            query()
        }

        fn finish(&mut self, item: &Item) {
            self.items.push((item.to_string(), core::mem::take(&mut self.number)));
        }
    }

    #[test]
    fn every_item_has_its_queries() -> Result<(), super::CostError> {
        let mut queries = Queries::default();
        of_leaves::<f32>("", &mut queries)?;
        of_scene(&S2, "fpu", &mut [Span::EMPTY; 5], &mut queries)?;
        assert_eq!(queries.items.len(), 2 * crate::solids::NAMES.len() + 2);
        assert!(queries.items.iter().all(|(_, number)| *number == SIDE * SIDE));
        let names: Vec<_> = queries.items.iter().map(|(item, _)| item.as_str()).collect();
        assert!(names.contains(&"leaf/capped-cone/sdf") && names.contains(&"scene/s2/traced-fpu"));
        assert!(of_scene(&S2, "", &mut [Span::EMPTY; 4], &mut queries).is_err());
        Ok(())
    }
}
