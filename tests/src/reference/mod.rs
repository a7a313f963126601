//! An exact reference: where a line is inside a solid, computed without rounding and without the library's algebra.
//!
//! The library solves for crossings in closed form, one formula for each leaf. A reference that used the same
//! formulas would repeat their mistakes, so this one knows none of them:
//!
//! - A solid is a boolean expression over polynomial inequalities in *space* ([`Inequality`]), each written down from
//!   the definition of its surface: nearer to the center than the radius, behind the plane.
//! - Along the line `origin + t direction` such a polynomial has a degree of at most two, so its values at three
//!   places determine it. They are computed exactly, and interpolated exactly.
//! - Its roots cut the line into pieces. Whether a piece is inside is found by evaluating the whole expression within
//!   it, exactly. That answers every question of tangency, of coincident faces and of faces that contain the line.
//!
//! Numbers are [`Exact`], which rounds neither sums nor products. Only the *position* of a root is approximate, to
//! more than 300 bits; [`Root`] says what follows from that.
//!
//! # Which side a boundary is on
//!
//! Inequalities are strict: a point on a surface is outside it, and a line within a plane is outside the half-space
//! behind it. Along a line a single place decides nothing: spans that touch merge, and isolated points are dropped.

mod inequality;
mod line;
mod number;
mod polynomial;
mod root;
mod solids;
#[cfg(test)]
mod tests;
mod vector;

use glam::Vec3;

pub use inequality::Inequality;
pub use line::{Crossing, Line};
pub use number::Exact;
use polynomial::Quadratic;
pub use root::Root;
pub use vector::ExactVec3;

/// A solid: a boolean expression over inequalities in space.
#[derive(Clone, Debug)]
pub enum Expr {
    /// The points that satisfy an inequality.
    Leaf(Inequality),
    /// The points inside all of these, so all points if there are none.
    And(Vec<Self>),
    /// The points inside any of these, so no point if there are none.
    Or(Vec<Self>),
    /// The points not inside this, those on its surface included.
    Not(Box<Self>),
    /// The same points as inside `inner`, whose crossings are reported under a name.
    Tagged {
        /// The name. It may be given to any number of expressions.
        tag: u32,
        /// What it names.
        inner: Box<Self>,
    },
    /// The points which an affine map takes into `inner`.
    Mapped {
        /// The map from the space around to that of `inner`.
        map: AffineMap,
        /// The solid in its own space.
        inner: Box<Self>,
    },
}

/// The map that takes `x` to `linear (x - origin)`, exactly.
#[derive(Clone, Debug)]
pub struct AffineMap {
    rows: [ExactVec3; 3],
    origin: ExactVec3,
}

impl AffineMap {
    /// The map with these rows of its matrix, which takes `origin` to zero.
    pub fn new(rows: [impl Into<ExactVec3>; 3], origin: impl Into<ExactVec3>) -> Self {
        Self {
            rows: rows.map(Into::into),
            origin: origin.into(),
        }
    }

    /// Where the map takes a point.
    #[must_use]
    pub fn apply(&self, x: &ExactVec3) -> ExactVec3 {
        let from_origin = x - &self.origin;
        ExactVec3::from(self.rows.each_ref().map(|row| row.dot(&from_origin)))
    }
}

impl Expr {
    /// The same solid under a name, to be found in [`Crossing::leaves`].
    #[must_use]
    pub fn tagged(self, tag: u32) -> Self {
        Self::Tagged {
            tag,
            inner: Box::new(self),
        }
    }

    /// The solid as the space around sees it: the points `x` with `linear (x - origin)` inside this one.
    #[must_use]
    pub fn mapped(self, linear: [[f32; 3]; 3], origin: Vec3) -> Self {
        Self::Mapped {
            map: AffineMap::new(linear, origin),
            inner: Box::new(self),
        }
    }

    /// The points inside both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self::And(vec![self, other])
    }

    /// The points inside either.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self::Or(vec![self, other])
    }

    /// The points inside this and not inside the other.
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        self.and(other.complement())
    }

    /// The points not inside.
    #[must_use]
    pub fn complement(self) -> Self {
        Self::Not(Box::new(self))
    }

    /// Whether a point is inside, exactly.
    pub fn contains(&self, point: impl Into<ExactVec3>) -> bool {
        self.contains_exact(&point.into())
    }

    /// The solid along the line `origin + t direction`. The direction may have any length.
    pub fn along(&self, origin: impl Into<ExactVec3>, direction: impl Into<ExactVec3>) -> Line {
        Line::new(self, &origin.into(), &direction.into())
    }

    /// The longest spans of the line that are inside: [`Line::spans`].
    #[must_use]
    pub fn spans(&self, origin: Vec3, direction: Vec3) -> Vec<(Root, Root)> {
        self.along(origin, direction).spans()
    }

    /// Every place where the line goes in or out: [`Line::crossings`].
    #[must_use]
    pub fn crossings(&self, origin: Vec3, direction: Vec3) -> Vec<Crossing> {
        self.along(origin, direction).crossings()
    }

    /// The first place after `t_min` where the line goes in or out: [`Line::first_crossing_after`].
    #[must_use]
    pub fn first_crossing_after(&self, origin: Vec3, direction: Vec3, t_min: f64) -> Option<Crossing> {
        self.along(origin, direction).first_crossing_after(t_min)
    }

    /// Whether the line is inside just after `t`: [`Line::inside_at`].
    #[must_use]
    pub fn inside_at(&self, origin: Vec3, direction: Vec3, t: f64) -> bool {
        self.along(origin, direction).inside_at(t)
    }

    fn contains_exact(&self, point: &ExactVec3) -> bool {
        match self {
            Self::Leaf(inequality) => inequality.contains(point),
            Self::And(all) => all.iter().all(|inner| inner.contains_exact(point)),
            Self::Or(any) => any.iter().any(|inner| inner.contains_exact(point)),
            Self::Not(inner) => !inner.contains_exact(point),
            Self::Tagged { inner, .. } => inner.contains_exact(point),
            Self::Mapped { map, inner } => inner.contains_exact(&map.apply(point)),
        }
    }

    /// Adds the polynomial of every leaf along a line, given its points at `t = -1`, `0` and `1`.
    fn restrict(&self, points: &[ExactVec3; 3], polynomials: &mut Vec<Quadratic>) {
        match self {
            Self::Leaf(inequality) => {
                let [before, at_zero, after] = points.each_ref().map(|point| inequality.value(point));
                polynomials.push(Quadratic::through(&before, &at_zero, &after));
            }
            Self::And(inner) | Self::Or(inner) => inner.iter().for_each(|inner| inner.restrict(points, polynomials)),
            Self::Not(inner) | Self::Tagged { inner, .. } => inner.restrict(points, polynomials),
            Self::Mapped { map, inner } => inner.restrict(&points.each_ref().map(|point| map.apply(point)), polynomials),
        }
    }

    /// Whether a place is inside if these are the memberships of the leaves there, in the order of
    /// [`Self::restrict`].
    ///
    /// Visits every leaf, for the sake of their order and of the tags: hence `&`, which takes no short cut.
    fn evaluate(&self, leaves: &mut impl Iterator<Item = bool>, tags: &mut Vec<(u32, bool)>) -> bool {
        match self {
            Self::Leaf(_) => leaves.next().expect("every leaf has left its polynomial"),
            Self::And(all) => all.iter().fold(true, |inside, inner| inside & inner.evaluate(leaves, tags)),
            Self::Or(any) => any.iter().fold(false, |inside, inner| inside | inner.evaluate(leaves, tags)),
            Self::Not(inner) => !inner.evaluate(leaves, tags),
            Self::Mapped { inner, .. } => inner.evaluate(leaves, tags),
            Self::Tagged { tag, inner } => {
                let inside = inner.evaluate(leaves, tags);
                tags.push((*tag, inside));
                inside
            }
        }
    }
}

impl From<Inequality> for Expr {
    fn from(inequality: Inequality) -> Self {
        Self::Leaf(inequality)
    }
}
