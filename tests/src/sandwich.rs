//! Backward error, measured with exact arithmetic: by how much a surface would have to move for a computed span to be right.

use crate::reference::{Exact, ExactVec3, Root};
use crate::shape::Shape;
use glam::Vec3;
use gsdf_nostd::{Line, Solid, Span, Toward, V3};

/// The unit roundoff of `f32`.
pub const ROUNDOFF: f64 = 1.0 / 16_777_216.0;

/// A leaf's span along a ray as the library computes it.
///
/// # Panics
/// Where the library refuses the shape, which generators do not make.
#[must_use]
pub fn computed_span(shape: &Shape, origin: Vec3, direction: Vec3) -> Span<f32> {
    let leaf = shape.leaf().expect("generators make valid shapes");
    leaf.span_along(&Line {
        origin: V3::from(origin),
        toward: Toward::new(V3::from(direction)),
    })
}

/// Farther along a ray than any coordinate reaches: 2^100.
const BEYOND: f64 = 1_267_650_600_228_229_401_496_703_205_376.0;

/// A shape and a ray, with what both are worth in rounding errors.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// The solid.
    pub shape: Shape,
    /// Where the ray starts.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
}

impl Trial {
    /// The exact span; solids here are convex, so there is at most one.
    ///
    /// # Panics
    /// Where there are more.
    #[must_use]
    pub fn exact_span(&self) -> Option<(Root, Root)> {
        let spans = self.shape.exact(0.0).along(self.origin, self.direction).spans();
        assert!(spans.len() <= 1, "a convex solid has one span, not {}", spans.len());
        spans.into_iter().next()
    }

    /// One rounding error of the numbers that meet at parameter `t`, as a length.
    fn rounding_at(&self, t: f64) -> f64 {
        let travelled = t.abs() * self.direction.as_dvec3().length();
        ROUNDOFF * (self.origin.as_dvec3().length() + self.shape.extent() + travelled)
    }

    /// Parameters at which the computed and the exact span disagree on membership, a few in each interval in which they do, and whether the exact one is inside.
    fn disagreements(&self, span: Span<f32>) -> Vec<(f64, bool)> {
        let exact = self
            .exact_span()
            .map_or((f64::INFINITY, f64::NEG_INFINITY), |(enter, exit)| (enter.to_f64(), exit.to_f64()));
        let computed = (f64::from(span.enter), f64::from(span.exit));
        let mut ends = vec![-BEYOND, exact.0, exact.1, computed.0, computed.1, BEYOND];
        ends.retain(|end| end.is_finite());
        ends.sort_by(f64::total_cmp);
        let mut found = Vec::new();
        for pair in ends.windows(2) {
            let (low, high) = (pair[0], pair[1]);
            let inside = |span: (f64, f64)| span.0 <= low && high <= span.1;
            if low < high && inside(exact) != inside(computed) {
                let share = |f: f64| low + f * (high - low);
                // Near the finite ends, and further out step by step where the interval is endless.
                let near = [1e-6, 0.25, 0.5, 0.75, 1.0 - 1e-6].map(share);
                let far = [1.0, 1e3, 1e6, 1e12].map(|step| if low == -BEYOND { high - step } else { low + step });
                let samples = near.into_iter().chain(far).filter(|t| low < *t && *t < high);
                found.extend(samples.map(|t| (t, inside(exact))));
            }
        }
        found
    }

    /// How many rounding errors explain the computed span: the least power of two `k`, from 1/4 to 2^20, such that wherever it disagrees with the exact one the point of the ray
    /// is within `k` rounding errors of the surface.
    #[must_use]
    pub fn roundings(&self, span: Span<f32>) -> f64 {
        let explained = |t: f64, inside: bool, roundings: f64| {
            let offset = roundings * self.rounding_at(t);
            let (origin, direction) = (ExactVec3::from(self.origin), ExactVec3::from(self.direction));
            let point = &origin + &direction.times(&Exact::from(t));
            // What is inside must not be so by more than the offset, what is outside must be inside with it.
            inside != self.shape.exact(if inside { -offset } else { offset }).contains(point)
        };
        let mut roundings = 0.25;
        for (t, inside) in self.disagreements(span) {
            while !explained(t, inside, roundings) && roundings < 1_048_576.0 {
                roundings *= 2.0;
            }
        }
        roundings
    }
}
