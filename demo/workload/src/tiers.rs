//! Speed against accuracy where every instruction counts: what a ray costs in each tier, and how far off its answer is.
//!
//! A tier of a single ray is the type of its spans, or a certified cast. The scenes are [`S1`] and [`S2`], each in a leaf
//! type of its own solids, so that an image which links every formula four times over still fits a micro:bit.

use crate::costs::{CostError, Item, Meter};
use crate::scenes::{S1, S2, Scene};
use core::hint::black_box;
use glam::{Vec3, vec3};
use gsdf_nostd::{
    Bounded, Camera, CappedCylinder, Certified, CertifiedScratch, Csg, Cuboid, HalfSpace, Hit, Invalid, Lane, Plain, Program, ProgramError,
    Ray, RayError, Settled, Solid, Span, Sphere, csg, leaf_set,
};

/// The rays along each side of the pictures: enough for one in a hundred to pass close by an edge.
pub const SIDE: u32 = 32;

/// How many times as far away a scene is seen once more: where textbook formulas begin to fail.
pub const AWAY: f32 = 100.0;

/// The tiers, from fast to accurate, as records call them.
pub const TIERS: [&str; 4] = ["fast", "robust", "f64", "certified"];

leaf_set! {
    /// The solids of [`BALL_ON_GROUND`].
    pub enum BallOrGround { Sphere(Sphere), HalfSpace(HalfSpace) }
}

leaf_set! {
    /// The solids of [`DRILLED_BLOCK`].
    pub enum BlockOrDrill { Cuboid(Cuboid), Sphere(Sphere), CappedCylinder(CappedCylinder) }
}

csg! {
    /// [`S1`], of spheres and half-spaces.
    pub const BALL_ON_GROUND: BallOrGround = union(Sphere::new(vec3(0.0, 1.0, 0.0), 1.0), HalfSpace::new(Vec3::ZERO, Vec3::Y))
}

csg! {
    /// [`S2`], of the three solids it is made of.
    pub const DRILLED_BLOCK: BlockOrDrill = difference(
        intersection(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(Vec3::ZERO, 1.35)),
        CappedCylinder::new(vec3(-1.5, 0.0, 0.0), vec3(1.5, 0.0, 0.0), Vec3::X, 0.6),
        CappedCylinder::new(vec3(0.0, -1.5, 0.0), vec3(0.0, 1.5, 0.0), Vec3::Y, 0.6),
        CappedCylinder::new(vec3(0.0, 0.0, -1.5), vec3(0.0, 0.0, 1.5), Vec3::Z, 0.6)
    )
}

static GROUND: Csg<3, BallOrGround> = BALL_ON_GROUND;
static BLOCK: Csg<9, BlockOrDrill> = DRILLED_BLOCK;

/// The leaves of the larger of them.
const LEAVES: usize = DRILLED_BLOCK.leaves();

/// How far off the answers of a tier are, over the rays of a picture, held against the same formulas in `f64`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Accuracy {
    /// The rays that hit instead of missing, or the other way about, or hit another leaf.
    pub wrong: u32,
    /// The largest error of a distance, in units in the last place of `f32`, over the rays that are not wrong. Half a unit
    /// is what rounding the exact one takes.
    pub ulps: f64,
    /// The rays that were not settled in single precision, where the tier tells.
    pub doubtful: Option<u32>,
}

/// Measures what a ray costs, distance, normal and leaf, in the two tiers of single precision, whose arithmetic is `T`.
///
/// # Errors
/// Never.
pub fn costs_in_single<T: Lane>(arithmetic: &'static str, meter: &mut impl Meter) -> Result<(), CostError> {
    fn of_picture<T: Lane, L: Solid>(picture: &Picture<'_, L>, arithmetic: &'static str, meter: &mut impl Meter) -> Result<(), CostError> {
        picture.cost(Plain(T::from(0.0)), &picture.item("fast", arithmetic), meter)?;
        picture.cost(T::from(0.0), &picture.item("robust", arithmetic), meter)
    }
    of_picture::<T, _>(&Picture::of_ground(), arithmetic, meter)?;
    of_picture::<T, _>(&Picture::of_block(), arithmetic, meter)?;
    of_picture::<T, _>(&Picture::of_far_block(), arithmetic, meter)
}

/// Measures what a ray costs in the two tiers that need `f64`: always, or where `f32` leaves a doubt.
///
/// # Errors
/// Never.
pub fn costs_in_double(meter: &mut impl Meter) -> Result<(), CostError> {
    fn of_picture<L: Solid>(picture: &Picture<'_, L>, meter: &mut impl Meter) -> Result<(), CostError> {
        picture.cost(0.0_f64, &picture.item("f64", ""), meter)?;
        picture.cost_of_certified(&picture.item("certified", ""), meter)
    }
    of_picture(&Picture::of_ground(), meter)?;
    of_picture(&Picture::of_block(), meter)?;
    of_picture(&Picture::of_far_block(), meter)
}

/// Tells how far off each tier is, of each scene.
///
/// # Errors
/// Never.
pub fn accuracies(mut tell: impl FnMut(&Item, &Accuracy)) -> Result<(), CostError> {
    Picture::of_ground().accuracies(&mut tell)?;
    Picture::of_block().accuracies(&mut tell)?;
    Picture::of_far_block().accuracies(&mut tell)
}

/// A scene in a leaf type of its own, and from where it is seen.
struct Picture<'a, L> {
    name: &'static str,
    scene: &'a Scene,
    /// How many times as far as the scene's own camera stands; through a lens as many times as long.
    away: f32,
    program: Program<'a, L>,
}

// Where the compiler knew the numbers of a scene it would compute with some of them itself.

impl Picture<'static, BallOrGround> {
    fn of_ground() -> Self {
        Self {
            name: S1.name,
            scene: &S1,
            away: 1.0,
            program: black_box(&GROUND).program(),
        }
    }
}

impl Picture<'static, BlockOrDrill> {
    fn of_block() -> Self {
        Self {
            name: S2.name,
            scene: &S2,
            away: 1.0,
            program: black_box(&BLOCK).program(),
        }
    }

    fn of_far_block() -> Self {
        Self {
            name: "s2 far",
            away: AWAY,
            ..Self::of_block()
        }
    }
}

impl<L: Solid> Picture<'_, L> {
    fn item(&self, tier: &'static str, arithmetic: &'static str) -> Item {
        Item {
            kind: "tier",
            name: self.name,
            query: tier,
            arithmetic,
        }
    }

    fn rays(&self) -> Result<impl Iterator<Item = Result<Ray, RayError>> + use<L>, Invalid> {
        let Scene { eye, target, tangent, .. } = *self.scene;
        let eye = target + self.away * (eye - target);
        let raster = Camera::pinhole(eye, target, Vec3::Y, tangent / self.away)?.raster(SIDE, SIDE);
        Ok((0..SIDE * SIDE).map(move |number| raster.ray(number % SIDE, number / SIDE)))
    }

    fn cost<T: Lane>(&self, like: T, item: &Item, meter: &mut impl Meter) -> Result<(), CostError> {
        let mut scratch = [Span::empty_like(like); LEAVES];
        for ray in self.rays()? {
            let ray = black_box(ray?);
            black_box(meter.query(|| cast(&self.program, &ray, &mut scratch))?);
        }
        meter.finish(item);
        Ok(())
    }

    fn cost_of_certified(&self, item: &Item, meter: &mut impl Meter) -> Result<(), CostError> {
        let mut scratch = Scratch::new();
        for ray in self.rays()? {
            let ray = black_box(ray?);
            black_box(meter.query(|| cast_certified(&self.program, &ray, &mut scratch))?);
        }
        meter.finish(item);
        Ok(())
    }

    fn accuracies(&self, tell: &mut impl FnMut(&Item, &Accuracy)) -> Result<(), CostError> {
        let mut found = [Accuracy::default(); TIERS.len()];
        let mut doubtful = 0;
        let mut plain = [Span::empty_like(Plain(0.0_f32)); LEAVES];
        let mut single = [Span::EMPTY; LEAVES];
        let mut double = [Span::empty_like(0.0_f64); LEAVES];
        let mut scratch = Scratch::new();
        for ray in self.rays()? {
            let ray = ray?;
            let hit = cast(&self.program, &ray, &mut double)?;
            let truth = Truth {
                t: self.program.along(ray, &mut double)?.march().t,
                hit,
            };
            let certified = cast_certified(&self.program, &ray, &mut scratch)?;
            let hits = [
                cast(&self.program, &ray, &mut plain)?,
                cast(&self.program, &ray, &mut single)?,
                hit,
                certified.hit,
            ];
            for (accuracy, hit) in found.iter_mut().zip(&hits) {
                accuracy.hold_against(&truth, hit.as_ref());
            }
            doubtful += u32::from(certified.settled != Settled::Single);
        }
        let [.., certified] = &mut found;
        certified.doubtful = Some(doubtful);
        for (tier, accuracy) in TIERS.iter().zip(&found) {
            tell(&self.item(tier, ""), accuracy);
        }
        Ok(())
    }
}

// One copy of each, whoever asks: for the sake of flash, and so that the cost is of the code whose accuracy is told.

#[inline(never)]
fn cast<T: Lane, L: Solid>(program: &Program<'_, L>, ray: &Ray, scratch: &mut [Span<T>]) -> Result<Option<Hit>, ProgramError> {
    Ok(program.along(*ray, scratch)?.cast())
}

#[inline(never)]
fn cast_certified<L: Solid>(program: &Program<'_, L>, ray: &Ray, scratch: &mut Scratch) -> Result<Certified, ProgramError> {
    program.cast_certified(ray, scratch.lent())
}

/// The memory of certified casts.
struct Scratch {
    single: [Span<Bounded<f32>>; LEAVES],
    double: [Span<Bounded<f64>>; LEAVES],
    tie: [Span<f64>; LEAVES],
}

impl Scratch {
    fn new() -> Self {
        Self {
            single: [Span::empty_like(Bounded::exact(0.0)); LEAVES],
            double: [Span::empty_like(Bounded::exact(0.0)); LEAVES],
            tie: [Span::empty_like(0.0); LEAVES],
        }
    }

    fn lent(&mut self) -> CertifiedScratch<'_> {
        CertifiedScratch {
            single: &mut self.single,
            double: &mut self.double,
            tie: &mut self.tie,
        }
    }
}

/// What a ray meets in `f64`: the distance before it is rounded, and all that is.
struct Truth {
    t: f64,
    hit: Option<Hit>,
}

impl Accuracy {
    fn hold_against(&mut self, truth: &Truth, found: Option<&Hit>) {
        match (&truth.hit, found) {
            (None, None) => {}
            (Some(right), Some(found)) if right.leaf == found.leaf => {
                let ulp = f64::from(right.t.next_up()) - f64::from(right.t);
                self.ulps = self.ulps.max((f64::from(found.t) - truth.t).abs() / ulp);
            }
            _ => self.wrong += 1,
        }
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::*;
    use std::format;
    use std::string::{String, ToString};
    use std::vec::Vec;

    #[test]
    fn the_scenes_are_the_reference_scenes() -> Result<(), CostError> {
        fn same<L: Solid>(picture: &Picture<'_, L>) -> Result<(), CostError> {
            for ray in picture.rays()? {
                let ray = ray?;
                let own = cast(&picture.program, &ray, &mut [Span::EMPTY; LEAVES])?;
                assert_eq!(own, cast(&picture.scene.program, &ray, &mut [Span::EMPTY; LEAVES])?);
            }
            Ok(())
        }
        same(&Picture::of_ground())?;
        same(&Picture::of_block())
    }

    /// The accuracy that is told under this name.
    fn accuracy(name: &str) -> Result<Accuracy, CostError> {
        let mut found = None;
        accuracies(|item, accuracy| {
            if item.to_string() == name {
                assert_eq!(found.replace(*accuracy), None, "{name} is told twice");
            }
        })?;
        Ok(found.expect("it is told"))
    }

    #[test]
    fn robust_formulas_hold_where_textbook_formulas_fail() -> Result<(), CostError> {
        for picture in ["s1", "s2", "s2-far"] {
            let robust = accuracy(&format!("tier/{picture}/robust"))?;
            let fast = accuracy(&format!("tier/{picture}/fast"))?;
            assert!(robust.wrong == 0 && robust.ulps < 10.0, "{picture}: {robust:?}");
            assert!(fast.ulps > 2.0 * robust.ulps, "{picture}: {fast:?}");
        }
        assert_eq!(accuracy("tier/s2/fast")?.wrong, 0);
        assert!(accuracy("tier/s2-far/fast")?.wrong > 0);
        Ok(())
    }

    #[test]
    fn tiers_that_need_double_precision_are_right_to_rounding() -> Result<(), CostError> {
        for picture in ["s1", "s2", "s2-far"] {
            let double = accuracy(&format!("tier/{picture}/f64"))?;
            let certified = accuracy(&format!("tier/{picture}/certified"))?;
            assert!(double.wrong == 0 && double.ulps <= 0.5 && double.doubtful.is_none(), "{double:?}");
            assert!(certified.wrong == 0 && certified.ulps <= 0.5, "{certified:?}");
            assert!(certified.doubtful.is_some_and(|rays| rays < 10), "{certified:?}");
        }
        assert_ne!(accuracy("tier/s2-far/certified")?.doubtful, Some(0));
        Ok(())
    }

    #[test]
    fn every_ray_of_every_tier_is_measured() -> Result<(), CostError> {
        #[derive(Default)]
        struct Queries(u32, Vec<String>);

        impl Meter for Queries {
            fn query<R>(&mut self, query: impl FnOnce() -> R) -> R {
                self.0 += 1;
                query()
            }

            fn finish(&mut self, item: &Item) {
                assert_eq!(core::mem::take(&mut self.0), SIDE * SIDE, "{item}");
                self.1.push(item.to_string());
            }
        }

        let mut queries = Queries::default();
        costs_in_single::<f32>("", &mut queries)?;
        costs_in_double(&mut queries)?;
        let mut told = Vec::new();
        accuracies(|item, _| told.push(item.to_string()))?;
        queries.1.sort();
        told.sort();
        assert_eq!(queries.1, told);
        costs_in_single::<f32>("fpu", &mut queries)?;
        assert_eq!(queries.1.last().map(String::as_str), Some("tier/s2-far/robust-fpu"));
        Ok(())
    }
}
