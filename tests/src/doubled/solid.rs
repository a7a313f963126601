//! Solids as polynomials in double-double arithmetic.

use super::ball::Ball;
use super::quadric::{PLACES, Quadric};
use crate::reference::{Exact, ExactVec3, Expr};
use glam::{DMat3, DVec3, Vec3};

/// A surface: where its polynomial is negative is inside.
#[derive(Clone, Debug)]
pub(super) struct Surface {
    pub(super) doubled: Quadric<Ball>,
    pub(super) nearly: Quadric<f64>,
    pub(super) is_flat: bool,
}

/// How the insides of surfaces, by their numbers, make that of the solid.
#[derive(Clone, Debug)]
pub(super) enum Tree {
    Surface(u32),
    And(Vec<Self>),
    Or(Vec<Self>),
    Not(Box<Self>),
}

impl Tree {
    /// Whether what is inside of these surfaces, one bit for each, is inside.
    pub(super) fn holds(&self, inside: u64) -> bool {
        match self {
            Self::Surface(number) => inside >> number & 1 == 1,
            Self::And(all) => all.iter().all(|inner| inner.holds(inside)),
            Self::Or(any) => any.iter().any(|inner| inner.holds(inside)),
            Self::Not(inner) => !inner.holds(inside),
        }
    }
}

/// Where a solid is, and how large: the units in which its polynomials are kept, so that nothing is far away.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units {
    pub(super) center: [f64; 3],
    /// A power of two.
    pub(super) scale: f64,
}

impl Units {
    fn new(center: [f64; 3], size: f64) -> Self {
        Self {
            // Few digits, so that differences from it stay short.
            center: center.map(|coordinate| f64::from(coordinate as f32)),
            scale: size.log2().round().exp2(),
        }
    }

    /// The places at which polynomials are looked at.
    fn places(&self) -> [ExactVec3; 10] {
        let scale = Exact::from(self.scale);
        PLACES.map(|place| {
            let offset = ExactVec3::from(place.map(Exact::from));
            &ExactVec3::from(self.center) + &offset.times(&scale)
        })
    }

    /// The polynomials of a solid, in the order of its expression, and how they are put together.
    fn polynomials(&self, solid: &Expr) -> (Vec<Quadric<Exact>>, Tree) {
        let mut polynomials = Vec::new();
        let tree = collect(solid, &self.places(), &mut polynomials);
        (polynomials, tree)
    }
}

fn collect(solid: &Expr, places: &[ExactVec3; 10], polynomials: &mut Vec<Quadric<Exact>>) -> Tree {
    match solid {
        Expr::Leaf(inequality) => {
            let values = places.each_ref().map(|place| inequality.value(place));
            polynomials.push(Quadric::through(&values));
            Tree::Surface(polynomials.len() as u32 - 1)
        }
        Expr::And(all) => Tree::And(all.iter().map(|inner| collect(inner, places, polynomials)).collect()),
        Expr::Or(any) => Tree::Or(any.iter().map(|inner| collect(inner, places, polynomials)).collect()),
        Expr::Not(inner) => Tree::Not(Box::new(collect(inner, places, polynomials))),
        Expr::Tagged { inner, .. } => collect(inner, places, polynomials),
        Expr::Mapped { map, inner } => collect(inner, &places.each_ref().map(|place| map.apply(place)), polynomials),
    }
}

/// A solid, ready for many lines.
#[derive(Clone, Debug)]
pub struct Solid {
    pub(super) surfaces: Vec<Surface>,
    pub(super) tree: Tree,
    /// For a facet, how many surfaces come before that of its plane: the others are its outline.
    pub(super) plane: Option<usize>,
    pub(super) units: Units,
    pub(super) frame: Option<Frame>,
}

/// The map to a solid's own frame: rows of its matrix, what it takes to zero, and the inverse of the matrix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub(super) rows: [[f64; 3]; 3],
    pub(super) origin: [f64; 3],
    pub(super) columns: DMat3,
}

/// By how much each surface of a solid moves when one number moves that the solid is given by.
#[derive(Clone, Debug)]
pub struct Input(pub(super) Vec<Quadric<f64>>);

impl Frame {
    /// What the numbers of the frame are worth at a crossing at `t`: origin and direction of a ray are taken to the frame
    /// one by one, so each by a matrix that is off by rounding errors of its own.
    pub(super) fn worth(&self, gradient: [f64; 3], origin: Vec3, direction: Vec3, t: f64) -> f64 {
        let local = self.columns.transpose() * DVec3::from(gradient);
        let sizes = [0, 1, 2].map(|axis| {
            let (o, from) = (f64::from(origin[axis]), self.origin[axis]);
            (o - from).abs() + from.abs() + (t * f64::from(direction[axis])).abs()
        });
        let row = |row: [f64; 3]| row[0].abs() * sizes[0] + row[1].abs() * sizes[1] + row[2].abs() * sizes[2];
        local.x.abs() * row(self.rows[0]) + local.y.abs() * row(self.rows[1]) + local.z.abs() * row(self.rows[2])
    }
}

impl Solid {
    /// A solid with an inside, which is about `size` large around `center`.
    #[must_use]
    pub fn new(solid: &Expr, center: [f64; 3], size: f64) -> Self {
        let units = Units::new(center, size);
        let (polynomials, tree) = units.polynomials(solid);
        let surface = |exact: &Quadric<Exact>| Surface {
            doubled: exact.map(|number| Ball::from(number)),
            nearly: exact.map(Exact::to_f64),
            is_flat: exact.is_flat(),
        };
        Self {
            surfaces: polynomials.iter().map(surface).collect(),
            tree,
            plane: None,
            units,
            frame: None,
        }
    }

    /// The solid, knowing that it is given in a frame, which rays are taken to first. That makes no difference but to the
    /// condition of crossings.
    #[must_use]
    pub fn in_frame(self, rows: [[f64; 3]; 3], origin: [f64; 3]) -> Self {
        let columns = DMat3::from_cols_array_2d(&rows).transpose().inverse();
        Self {
            frame: Some(Frame { rows, origin, columns }),
            ..self
        }
    }

    /// A piece of the plane that bounds a half-space: what of it is within an outline.
    #[must_use]
    pub fn facet(half_space: &Expr, outline: &Expr, center: [f64; 3], size: f64) -> Self {
        let mut facet = Self::new(&outline.clone().and(half_space.clone()), center, size);
        // The half-space is the last of the surfaces, and no part of the outline.
        facet.plane = Some(facet.surfaces.len() - 1);
        if let Tree::And(parts) = &mut facet.tree {
            parts.truncate(1);
        }
        facet
    }

    /// What a number of the solid is worth: `less` and `more` are the solid, as it was given, with the number moved by
    /// `step` in all, and `value` is the number.
    #[must_use]
    pub fn input(&self, less: &Expr, more: &Expr, step: f64, value: f64) -> Input {
        let factor = Exact::from(value / step);
        let (less, more) = (self.units.polynomials(less).0, self.units.polynomials(more).0);
        let share = |(less, more): (&Quadric<Exact>, &Quadric<Exact>)| more.difference(less, &factor).map(Exact::to_f64);
        Input(less.iter().zip(&more).map(share).collect())
    }
}
