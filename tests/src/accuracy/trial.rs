//! One ray at one solid: what the library says in each arithmetic, and what is true.

use super::corpus::matrix;
use crate::doubled::{Ball, Ends, Input, Solid};
use crate::poses::in_world;
use crate::reference::{Expr, Root};
use crate::shape::Shape;
use core::cell::OnceCell;
use glam::Vec3;
use gsdf_nostd::{Invalid, Lane, Leaf, Plain, Ray, Solid as _, Transform, Unit};

/// The arithmetics of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Arithmetic {
    /// `f32`.
    Robust,
    /// `f32` with textbook formulas: [`Plain`].
    Plain,
    /// `f64`.
    Double,
}

impl Arithmetic {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Robust, Self::Plain, Self::Double];

    /// The name it has in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Robust => "robust",
            Self::Plain => "plain",
            Self::Double => "f64",
        }
    }

    /// The unit roundoff.
    #[must_use]
    pub fn roundoff(self) -> f64 {
        match self {
            Self::Robust | Self::Plain => f64::from(f32::EPSILON) / 2.0,
            Self::Double => f64::EPSILON / 2.0,
        }
    }

    /// The unit in the last place of a number.
    #[must_use]
    pub fn ulp(self, number: f64) -> f64 {
        match self {
            Self::Robust | Self::Plain => {
                let near = number.abs() as f32;
                f64::from(near.next_up()) - f64::from(near)
            }
            Self::Double => number.abs().next_up() - number.abs(),
        }
    }
}

/// A solid where it stands.
#[derive(Clone, Copy, Debug)]
pub struct Placed {
    /// The solid, in its own frame.
    pub shape: Shape,
    /// The frame; `None` for the world's.
    pub pose: Option<Transform>,
    /// The unit the library measures it in; `None` where it is given the numbers as they are.
    pub unit: Option<Unit>,
}

impl Placed {
    /// A solid of the world, in no unit.
    #[must_use]
    pub fn in_world(shape: Shape) -> Self {
        Self {
            shape,
            pose: None,
            unit: None,
        }
    }

    /// The library's leaf of a shape that stands here.
    fn leaf_of(&self, shape: Shape) -> Result<Leaf, Invalid> {
        match self.unit {
            Some(unit) => shape.measured(|number| unit.length(number)).leaf(),
            None => shape.leaf(),
        }
    }

    /// The library's leaf.
    ///
    /// # Errors
    /// Where the library refuses the solid, which corpora do not make.
    pub fn leaf(&self) -> Result<Leaf, Invalid> {
        self.leaf_of(self.shape)
    }
}

/// A ray at a solid.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// The solid.
    pub solid: Placed,
    /// Where the ray starts, in the world.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
}

impl Trial {
    /// The library's span, if it finds one.
    ///
    /// # Panics
    /// Where the library refuses the ray, which corpora do not make.
    #[must_use]
    pub fn computed(&self, leaf: &Leaf, arithmetic: Arithmetic) -> Option<[f64; 2]> {
        match arithmetic {
            Arithmetic::Robust => self.span(leaf, 0.0_f32, f64::from),
            Arithmetic::Plain => self.span(leaf, Plain(0.0_f32), |t| f64::from(t.0)),
            Arithmetic::Double => self.span(leaf, 0.0_f64, |t| t),
        }
    }

    fn span<T: Lane>(&self, leaf: &Leaf, like: T, to_f64: impl Fn(T) -> f64) -> Option<[f64; 2]> {
        let made = match self.solid.unit {
            Some(unit) => unit.ray(self.origin, self.direction),
            None => Ray::new(self.origin, self.direction).map(|ray| (ray, Unit::ONE)),
        };
        let (ray, parameter) = made.expect("corpora make valid rays");
        let line = ray.line(like);
        let span = match self.solid.pose {
            Some(pose) => {
                let local = pose.line_to_local(&line);
                local.span_in_world(leaf.span_along(&local.line))
            }
            None => leaf.span_along(&line),
        };
        let in_world = f64::from(parameter.exponent()).exp2();
        let end = |t| to_f64(ray.parameter_of(t)) * in_world;
        (span.enter < span.exit).then(|| [end(span.enter), end(span.exit)])
    }
}

/// A solid in exact and in double-double arithmetic.
#[derive(Clone, Debug)]
pub struct Reference {
    solid: Placed,
    exact: Expr,
    doubled: Solid,
    inputs: OnceCell<Vec<Input>>,
}

impl Reference {
    /// The reference of a solid.
    #[must_use]
    pub fn new(solid: Placed) -> Self {
        let Placed { shape, pose, unit } = solid;
        let (middle, reach) = shape.middle_and_reach(unit.unwrap_or(Unit::ONE).to_world(1e-6).into());
        let (middle, reach) = pose.map_or((middle, reach), |pose| {
            let place = matrix(&pose) * middle + pose.origin().as_dvec3();
            (place, reach * f64::from(pose.stretch()))
        });
        let center = middle.to_array();
        let mut doubled = match shape.plane_and_outline() {
            Some((plane, outline)) => Solid::facet(&posed(plane, pose.as_ref()), &posed(outline, pose.as_ref()), center, reach),
            None => Solid::new(&posed(shape.exact(0.0), pose.as_ref()), center, reach),
        };
        if let Some(pose) = &pose {
            doubled = doubled.in_frame(
                pose.to_local().map(|row| row.as_dvec3().to_array()),
                pose.origin().as_dvec3().to_array(),
            );
        }
        Self {
            solid,
            exact: posed(shape.exact(0.0), pose.as_ref()),
            doubled,
            inputs: OnceCell::new(),
        }
    }

    /// The span of a line, in double-double arithmetic, if that can tell.
    #[must_use]
    pub fn swift(&self, origin: Vec3, direction: Vec3) -> Option<Option<Ends>> {
        self.doubled.along(origin, direction)
    }

    /// The span of a line, in exact arithmetic.
    ///
    /// # Panics
    /// Where there are two spans: solids here are convex.
    #[must_use]
    pub fn slow(&self, origin: Vec3, direction: Vec3) -> Option<Ends> {
        let spans = self.exact.spans(origin, direction);
        assert!(spans.len() <= 1, "{:?} has {} spans", self.solid.shape, spans.len());
        let end = |root: &Root| root.finite().map(Ball::from);
        spans.first().map(|(enter, exit)| [end(enter), end(exit)])
    }

    /// The condition of a crossing, as far as it is the ray's: see [`Solid::condition`].
    #[must_use]
    pub fn ray_condition(&self, ray: (Vec3, Vec3), t: Ball) -> f64 {
        self.doubled.condition(ray, t, 0.0, 0.0, &[])
    }

    /// The condition of a crossing that was found at `found`: see [`Solid::condition`].
    #[must_use]
    pub fn condition(&self, ray: (Vec3, Vec3), t: Ball, found: f64, roundoff: f64) -> f64 {
        let inputs = self.inputs.get_or_init(|| self.inputs());
        self.doubled.condition(ray, t, t.distance_to(found), roundoff, inputs)
    }

    /// How many rounding errors a place of a ray is from the nearest surface: see [`Solid::nearness`].
    #[must_use]
    pub fn nearness(&self, ray: (Vec3, Vec3), t: f64, roundoff: f64) -> f64 {
        let inputs = self.inputs.get_or_init(|| self.inputs());
        self.doubled.nearness(ray, t, roundoff, inputs)
    }

    /// What every number is worth that the solid is given by.
    fn inputs(&self) -> Vec<Input> {
        let mut values = Vec::new();
        let mut shape = self.solid.shape;
        shape.for_each_number(|number| values.push(*number));
        let of_shape = values
            .iter()
            .enumerate()
            .filter(|(_, value)| **value != 0.0)
            .filter_map(|(index, &value)| {
                let with = |number: f32| {
                    let (mut shape, mut at) = (self.solid.shape, 0);
                    shape.for_each_number(|old| {
                        *old = if at == index { number } else { *old };
                        at += 1;
                    });
                    shape
                };
                // One of two balls that hardly reaches out of the other must not be lost in it.
                let moved = |number: f32| {
                    let is_lost = matches!(self.solid.shape, Shape::RoundedCone { .. }) && self.solid.leaf_of(with(number)).is_err();
                    if is_lost { value } else { number }
                };
                let (less, more) = (moved(value * (1.0 - STEP)), moved(value * (1.0 + STEP)));
                let solid = |number: f32| posed(surfaces(&with(number)), self.solid.pose.as_ref());
                let step = f64::from(more) - f64::from(less);
                (step != 0.0).then(|| self.doubled.input(&solid(less), &solid(more), step, value.into()))
            });
        of_shape.collect()
    }
}

/// By what share a number is moved, either way, to see what it is worth: 2^-22, which takes no valid shape to where it is
/// none. In exact arithmetic nothing is lost by that.
const STEP: f32 = 1.0 / 4_194_304.0;

/// The surfaces of a shape, in the order of its [`Solid`].
fn surfaces(shape: &Shape) -> Expr {
    match shape.plane_and_outline() {
        Some((plane, outline)) => outline.and(plane),
        None => shape.exact(0.0),
    }
}

fn posed(solid: Expr, pose: Option<&Transform>) -> Expr {
    match pose {
        Some(pose) => in_world(solid, pose),
        None => solid,
    }
}
