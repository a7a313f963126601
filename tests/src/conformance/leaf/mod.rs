//! The duties of a leaf: convex, half-open, never NaN, of one sign in both readings, bounded as it says, and the same
//! bits in every stage and lane.
//!
//! What is a matter of geometry is asked in double precision, so that next to no tolerance is needed; what is a matter
//! of bits in single precision and in lanes.

mod bits;
mod space;
mod surface;

pub use bits::{lanes_are_the_scalar_bits, the_stages_are_one_formula};
pub use space::{
    both_distances_agree_on_what_is_inside, distances_change_no_faster_than_the_point, distances_never_exceed_the_way_to_the_surface,
    spans_are_half_open_and_never_nan, the_generator_aims, the_solid_is_convex,
};
pub use surface::{
    bounds_hold_the_solid, faces_belong_to_places_and_not_to_rays, grounded_origins_have_the_root_zero, normals_are_unit_and_outward,
};

use super::specimen::{Aim, Specimen, line, scaled};
use core::fmt::Debug;
use glam::DVec3;
use gsdf_nostd::{Line, Solid, Span, V3};
use rand::SeedableRng;
use rand_pcg::Pcg64;

const SPECIMENS: u64 = 200;
const RAYS: usize = 32;

/// By how much both readings may disagree, relative to the numbers that meet: unit vectors are so to 2^-21 of their
/// square, and the two readings need not take that alike.
const TOLERANCE: f64 = 1e-6;

fn for_specimens<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>, mut check: impl FnMut(&mut Pcg64, &Specimen<S>)) {
    for seed in 0..SPECIMENS {
        let mut rng = Pcg64::seed_from_u64(seed);
        let specimen = generator(&mut rng);
        check(&mut rng, &specimen);
    }
}

fn for_rays<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>, mut check: impl FnMut(&mut Pcg64, &Specimen<S>, Aim)) {
    for_specimens(generator, |rng, specimen| {
        for _ in 0..RAYS {
            let aim = specimen.aim(rng);
            check(rng, specimen, aim);
        }
    });
}

/// A ray in double precision, with what a solid's span of it is.
struct Exactly {
    line: Line<f64>,
    span: Span<f64>,
    speed: f64,
    /// The size of the numbers that meet where the ray starts.
    scale: f64,
}

impl Exactly {
    fn new<S: Solid + Debug>(specimen: &Specimen<S>, aim: Aim) -> Self {
        let line = line(0.0_f64, aim);
        Self {
            line,
            span: specimen.solid.span_along(&line),
            speed: scaled(aim.1).as_dvec3().length(),
            scale: specimen.extent() + aim.0.as_dvec3().length(),
        }
    }

    fn at(&self, t: f64) -> V3<f64> {
        self.line.origin + self.line.toward.v.scaled(t)
    }

    /// The tolerance, as a length, at a parameter.
    fn tolerance(&self, t: f64) -> f64 {
        TOLERANCE * (self.scale + t.abs() * self.speed)
    }

    fn is_inhabited(&self) -> bool {
        self.span.enter < self.span.exit
    }

    /// The ends that are places, and whether the ray enters there.
    fn ends(&self) -> impl Iterator<Item = (f64, bool)> {
        [(self.span.enter, true), (self.span.exit, false)]
            .into_iter()
            .filter(|(t, _)| t.is_finite())
    }
}

fn v3(v: DVec3) -> V3<f64> {
    V3::new(v.x, v.y, v.z)
}

fn dvec3(v: V3<f64>) -> DVec3 {
    DVec3::new(v.x, v.y, v.z)
}
