//! Backward error, measured with exact arithmetic: by how much a surface would have to move for a computed span to be
//! right.

use crate::reference::{Exact, ExactVec3, Root};
use crate::shape::Shape;
use glam::Vec3;
use gsdf_nostd::{Lane, Line, Solid, Toward, V3};

/// The unit roundoff of `f32`.
pub const ROUNDOFF: f64 = 1.0 / 16_777_216.0;

/// A leaf's span along a ray as the library computes it in the arithmetic of `like`, as `f64`s.
///
/// # Panics
/// Where the library refuses the shape, which generators do not make.
pub fn computed_span<T: Lane + Into<f64>>(trial: &Trial, like: T) -> (f64, f64) {
    let leaf = trial.shape.leaf().expect("generators make valid shapes");
    let span = leaf.span_along(&Line {
        origin: V3::splat(like, trial.origin),
        toward: Toward::new(V3::splat(like, trial.direction)),
    });
    (span.enter.into(), span.exit.into())
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

    /// The size of the numbers that meet at parameter `t`, a length: what rounding errors are relative to.
    fn scale_at(&self, t: f64) -> f64 {
        let travelled = t.abs() * self.direction.as_dvec3().length();
        self.origin.as_dvec3().length() + self.shape.extent() + travelled
    }

    /// How many rounding errors explain a computed span: the least power of two `k`, from 1/4 to 2^20, such that
    /// wherever it disagrees with the exact one the point of the ray is within `k` rounding errors of the surface.
    /// `roundoff` is that of the arithmetic.
    #[must_use]
    pub fn roundings(&self, computed: (f64, f64), roundoff: f64) -> f64 {
        let exact = self
            .exact_span()
            .map_or((f64::INFINITY, f64::NEG_INFINITY), |(enter, exit)| (enter.to_f64(), exit.to_f64()));
        let mut roundings = 0.25;
        // A facet holds no points that a miss of it could be told by.
        let travelled = exact.0.abs().min(BEYOND);
        while computed.0 >= computed.1
            && roundings < 1_048_576.0
            && exact.0 <= exact.1
            && self
                .shape
                .is_pierced(self.origin, self.direction, roundings * roundoff * self.scale_at(travelled))
        {
            roundings *= 2.0;
        }
        for (t, inside) in disagreements(&[exact], &[computed]) {
            // What is inside must not be so by more than the offset, what is outside must be inside with it.
            let explained = |roundings: f64| {
                let offset = roundings * roundoff * self.scale_at(t);
                inside
                    != self
                        .shape
                        .exact(if inside { -offset } else { offset })
                        .contains(point_at(self.origin, self.direction, t))
            };
            while !explained(roundings) && roundings < 1_048_576.0 {
                roundings *= 2.0;
            }
        }
        roundings
    }

    /// Whether the point at `t` is within `roundings` rounding errors of the surface.
    #[must_use]
    pub fn is_near_surface(&self, t: f64, roundings: f64) -> bool {
        let offset = roundings * ROUNDOFF * self.scale_at(t);
        let contains = |offset| self.shape.exact(offset).contains(point_at(self.origin, self.direction, t));
        contains(offset) && !contains(-offset)
    }
}

/// The exact point of a ray.
fn point_at(origin: Vec3, direction: Vec3, t: f64) -> ExactVec3 {
    &ExactVec3::from(origin) + &ExactVec3::from(direction).times(&Exact::from(t))
}

/// Parameters at which two sets of spans disagree on membership, a few in each interval in which they do, and whether
/// the first set is inside there.
#[must_use]
pub fn disagreements(first: &[(f64, f64)], second: &[(f64, f64)]) -> Vec<(f64, bool)> {
    let mut ends = vec![-BEYOND, BEYOND];
    ends.extend(
        first
            .iter()
            .chain(second)
            .flat_map(|&(enter, exit)| [enter, exit])
            .filter(|end| end.is_finite()),
    );
    ends.sort_by(f64::total_cmp);
    let mut found = Vec::new();
    for pair in ends.windows(2) {
        let (low, high) = (pair[0], pair[1]);
        let inside = |spans: &[(f64, f64)]| spans.iter().any(|&(enter, exit)| enter <= low && high <= exit);
        if low < high && inside(first) != inside(second) {
            let share = |f: f64| low + f * (high - low);
            // Near the finite ends, and further out step by step where the interval is endless.
            let near = [1e-6, 0.25, 0.5, 0.75, 1.0 - 1e-6].map(share);
            let far = [1.0, 1e3, 1e6, 1e12].map(|step| if low == -BEYOND { high - step } else { low + step });
            let samples = near.into_iter().chain(far).filter(|t| low < *t && *t < high);
            found.extend(samples.map(|t| (t, inside(first))));
        }
    }
    found
}
