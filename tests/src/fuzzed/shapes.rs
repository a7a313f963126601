//! Solids from raw parameters: refused with a reason, or consistent with themselves.

use super::Tally;
use super::raw::Raw;
use super::solids::{composed, shape};
use crate::conformance::specimen::scaled;
use crate::sandwich::{ROUNDOFF, Trial, computed_span};
use crate::shape::Shape;
use crate::shape::composed::Composed;
use glam::Vec3;
use gsdf_nostd::{Bounds, BoxFrame, DoubleCone, Hit, Invalid, Program, Ray, Solid, Span, WideSolidAngle};

/// The size that numbers near zero count as: squares of smaller ones lose digits by underflow, and through a cone's tip a least
/// square stands for none.
const LEAST: f64 = 1.0 / (1_u64 << 40) as f64;

/// How many rounding errors of the numbers that meet a surface may be off, and distances with it: eight each.
const ALLOWED: f64 = 16.0;

/// How many of them a crossing may be off its surface.
const PROMISED: f64 = 8.0;

/// How many times longer than wide a solid may be for its edges and tips to stay about where they are when its faces
/// move by rounding errors.
const BLUNT: f64 = 8.0;

/// Questions at one solid.
const QUESTIONS: usize = 6;

/// A solid as one asks it.
struct Asked<'a> {
    /// A leaf's parameters: what it is in exact arithmetic.
    shape: Option<Shape>,
    /// How far from the world's origin its numbers reach.
    extent: f64,
    /// By how much its edges and tips move at the most, where its faces do so by one: of a program.
    sharpness: f64,
    bounds: Option<Bounds>,
    sdf: &'a dyn Fn(Vec3) -> f32,
    gsdf: &'a dyn Fn(Vec3, Vec3) -> f32,
    program: Program<'a>,
    name: String,
}

/// The same solid, leaf or program, whatever it is: in its two distances, its bounds and its normals.
#[must_use]
pub fn shapes(bytes: &[u8]) -> Tally {
    let (mut raw, mut tally) = (Raw::new(bytes), Tally::default());
    if raw.below(8) > 0 {
        let shape = shape(&mut raw);
        if let Some(leaf) = tally.accept_named(shape.leaf()) {
            let nodes = [gsdf_nostd::Node::leaf(leaf)];
            let asked = Asked {
                shape: Some(shape),
                sharpness: BLUNT,
                extent: shape.extent(),
                bounds: leaf.bounds(),
                sdf: &|p| leaf.sdf(p),
                gsdf: &|p, v| leaf.gsdf(p, v),
                program: Program::new(&nodes).unwrap_or_else(|error| panic!("{error}")),
                name: format!("{shape:?}"),
            };
            asked.answer(&mut raw, &mut tally);
        }
    } else {
        ask_composed(&composed(&mut raw), &mut raw, &mut tally);
    }
    tally
}

fn ask_composed(solid: &Composed, raw: &mut Raw<'_>, tally: &mut Tally) {
    macro_rules! ask {
        ($made:expr) => {{
            let made: Result<_, Invalid> = $made;
            if let Some(made) = tally.accept_named(made) {
                let program = made.program();
                let asked = Asked {
                    shape: None,
                    sharpness: sharpness(solid),
                    extent: solid.extent(),
                    bounds: made.bounds(),
                    sdf: &|p| made.sdf(p),
                    gsdf: &|p, v| made.gsdf(p, v),
                    program: program.program(),
                    name: format!("{solid:?}"),
                };
                asked.answer(raw, tally);
            }
        }};
    }
    match *solid {
        Composed::BoxFrame { min, max, thickness } => ask!(BoxFrame::new(min, max, thickness)),
        Composed::DoubleCone {
            apex,
            axis,
            radius,
            height,
        } => ask!(DoubleCone::new(apex, axis, radius, height)),
        Composed::WideSolidAngle {
            apex,
            axis,
            reach,
            radius,
            height,
        } => ask!(WideSolidAngle::new(apex, axis, reach, radius, height)),
    }
}

impl Asked<'_> {
    fn answer(&self, raw: &mut Raw<'_>, tally: &mut Tally) {
        let name = &self.name;
        if let Some(Bounds { min, max }) = self.bounds {
            assert!(min.cmplt(max).any() && min.cmple(max).all(), "{min} to {max}: {name}");
        }
        for number in 0..QUESTIONS {
            if raw.is_empty() && number > 0 {
                break;
            }
            let (place, direction) = (self.place(raw), raw.vector());
            let signed = f64::from((self.sdf)(place));
            let along = (self.gsdf)(place, direction);
            let in_range = place.abs().cmple(Vec3::splat(gsdf_nostd::MAX_LENGTH)).all();
            assert_eq!(signed.is_nan(), !in_range, "{signed} at {place}: {name}");
            let ray = tally.accept(Ray::new(place, direction));
            assert_eq!(along.is_nan(), ray.is_none(), "{along} at {place} along {direction}: {name}");
            if let Some(ray) = ray {
                self.check(ray, signed, along, tally);
            }
        }
    }

    /// A place: anywhere, or near the solid.
    fn place(&self, raw: &mut Raw<'_>) -> Vec3 {
        match (self.bounds, raw.below(3)) {
            (_, 0) | (None, _) => raw.vector(),
            (Some(Bounds { min, max }), _) => {
                let share = Vec3::from_array([(); 3].map(|()| f32::from(raw.byte()) / 170.0 - 0.25));
                min + (max - min) * share
            }
        }
    }

    fn tolerance(&self, ray: &Ray, travelled: f64) -> f64 {
        ALLOWED * ROUNDOFF * (ray.origin().as_dvec3().length() + self.extent + travelled).max(LEAST)
    }

    fn check(&self, ray: Ray, signed: f64, along: f32, tally: &mut Tally) {
        let name = &self.name;
        let (origin, speed) = (ray.origin().as_dvec3(), ray.direction().as_dvec3().length());
        let travelled = f64::from(along).abs() * speed;
        let here = self.tolerance(&ray, 0.0);
        let what = || format!("{signed} at {origin}, but {along} along {ray:?}: {name}");
        let is_same_side = signed.abs() <= here || (signed < 0.0) == (along < 0.0);
        // Nothing is nearer in a direction than in all.
        let is_no_farther = signed.abs() <= travelled + self.tolerance(&ray, travelled.min(1e30));
        assert!(
            is_same_side && is_no_farther || self.is_explained(&ray) && self.is_right_by_itself(&ray, signed, here),
            "{}",
            what()
        );
        if let Some(Bounds { min, max }) = self.bounds {
            let beyond = (min.as_dvec3() - origin).max(origin - max.as_dvec3()).max_element();
            assert!(signed >= -here || beyond <= here, "out of {min} to {max}: {}", what());
        }
        let mut scratch = [Span::EMPTY; 8];
        let sight = self.program.along(ray, &mut scratch).unwrap_or_else(|error| panic!("{error}"));
        let march = sight.march::<f32>();
        assert!(
            march.t == along.abs() && along != 0.0 && march.inside == (along < 0.0),
            "{march:?}: {}",
            what()
        );
        tally.answered += 1;
        tally.inside += u64::from(along < 0.0);
        // The next two surfaces: an entry and an exit, or the other way around.
        let mut from = ray;
        for _ in 0..2 {
            let sight = self.program.along(from, &mut scratch).unwrap_or_else(|error| panic!("{error}"));
            let Some(hit) = sight.cast() else { break };
            assert!(hit.t > from.range().start, "{hit:?} once more along {ray:?}: {name}");
            self.check_hit(&ray, &hit);
            tally.met += 1;
            from = ray.within(hit.t..f32::INFINITY).unwrap_or_else(|error| panic!("{error}"));
        }
    }

    /// A hit has a unit normal, and lies on the surface and within the bounds.
    fn check_hit(&self, ray: &Ray, hit: &Hit) {
        let name = &self.name;
        let t = f64::from(hit.t);
        let tolerance = self.tolerance(ray, t * ray.direction().as_dvec3().length());
        let place = ray.origin().as_dvec3() + ray.direction().as_dvec3() * t;
        assert!((hit.normal.length() - 1.0).abs() < 1e-5, "{hit:?} along {ray:?}: {name}");
        let is_within = self.bounds.is_none_or(|Bounds { min, max }| {
            let beyond = (min.as_dvec3() - place).max(place - max.as_dvec3()).max_element();
            beyond <= tolerance
        });
        // The place itself is rounded to `f32`.
        let at = f64::from((self.sdf)(place.as_vec3()));
        let is_on = at.is_nan() || at.abs() <= 2.0 * tolerance;
        assert!(
            is_within && is_on || self.is_explained(ray),
            "{at} at {place}, bounds {:?}: {hit:?} along {ray:?}: {name}",
            self.bounds
        );
    }

    /// Whether what the ray sees is right but for rounding, where nothing simpler tells: because the solid is sharp, so
    /// that moving its faces by rounding errors moves its edges far.
    ///
    /// Of a leaf exact arithmetic knows. A program that sharp is let pass.
    fn is_explained(&self, ray: &Ray) -> bool {
        let Some(shape) = self.shape else {
            return self.sharpness > BLUNT;
        };
        let direction = scaled(ray.direction());
        let trial = Trial {
            shape,
            origin: ray.origin(),
            direction,
        };
        trial.roundings(computed_span(&trial, 0.0_f32), ROUNDOFF) <= PROMISED
    }

    /// Whether the standard distance is of the right sign, and no larger than the exact way to the surface.
    fn is_right_by_itself(&self, ray: &Ray, signed: f64, tolerance: f64) -> bool {
        let Some(shape) = self.shape else { return true };
        let line = shape.exact(0.0).along(ray.origin(), ray.direction());
        let way = line.first_crossing_after(0.0).map_or(f64::INFINITY, |crossing| crossing.t.to_f64());
        let speed = ray.direction().as_dvec3().length();
        signed.abs() <= tolerance || (signed < 0.0) == line.inside_at(0.0) && signed.abs() <= way * speed + tolerance
    }
}

/// How many times longer than wide a program's solids are.
fn sharpness(solid: &Composed) -> f64 {
    let ratio = |lengths: &[f32]| {
        let [least, most] = [f32::INFINITY, 0.0];
        let least = lengths.iter().fold(least, |least, length| length.abs().min(least));
        let most = lengths.iter().fold(most, |most: f32, length| length.abs().max(most));
        f64::from(most / least)
    };
    match *solid {
        Composed::BoxFrame { .. } | Composed::WideSolidAngle { height: 0.0, .. } => 1.0,
        Composed::DoubleCone { radius, height, .. } => ratio(&[radius, height]),
        Composed::WideSolidAngle { radius, height, .. } => ratio(&[radius, height]),
    }
}
