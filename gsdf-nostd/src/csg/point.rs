//! The standard reading of a program: from a point to a distance.

use super::fold::{Reading, Signed, fold};
use super::program::{Csg, Program};
use crate::leaf::Solid;
use crate::ray::is_in_range;
use crate::real::Real;
use crate::vec3::V3;
use glam::Vec3;

/// A point in the world and in the frame of the last leaf, where the next one probably is too.
struct AtPoint<'a, 'p, L, T> {
    program: &'p Program<'a, L>,
    world: V3<T>,
    frame: u16,
    local: V3<T>,
    stretch: T,
}

impl<L: Solid, T: Real> Reading<L> for AtPoint<'_, '_, L, T> {
    type Operand = Signed<T>;
    #[inline(always)]
    fn leaf(&mut self, solid: &L, frame: u16) -> Signed<T> {
        if frame != self.frame {
            self.frame = frame;
            let one = self.stretch.splat_like(1.0);
            (self.local, self.stretch) = match self.program.pose(frame) {
                Some(pose) => (pose.point_to_local(self.world), one.splat_like(pose.stretch())),
                None => (self.world, one),
            };
        }
        Signed(solid.distance(self.local) * self.stretch)
    }
}

impl<L: Solid> Program<'_, L> {
    /// The standard signed distance at `p`, in any arithmetic: minimum for union, maximum for intersection, negation
    /// for complement.
    ///
    /// The sign is the true membership. The magnitude never exceeds the distance to the surface; it equals it outside
    /// of unions of solids, and is a lower bound elsewhere, and where a pose is neither rigid nor a uniform scaling.
    #[inline(always)]
    pub fn distance<T: Real>(&self, p: V3<T>) -> T {
        let mut reading = AtPoint {
            program: self,
            world: p,
            frame: 0,
            local: p,
            stretch: p.x.splat_like(1.0),
        };
        fold(self.nodes, Signed(p.x), &mut reading).0
    }

    /// The standard signed distance function `φ(p)`, negative inside; NaN unless `p` is finite and within ±2^30. See
    /// [`distance`](Self::distance) for what the magnitude is.
    #[must_use]
    pub fn sdf(&self, p: Vec3) -> f32 {
        if is_in_range(p) { self.distance(V3::from(p)) } else { f32::NAN }
    }

    /// Whether `p` is inside: `sdf(p) < 0`.
    #[must_use]
    pub fn contains(&self, p: Vec3) -> bool {
        self.sdf(p) < 0.0
    }
}

impl<const N: usize, L: Solid> Csg<N, L> {
    /// The standard signed distance function `φ(p)`, negative inside; NaN unless `p` is finite and within ±2^30. See
    /// [`Program::distance`] for what the magnitude is.
    #[must_use]
    pub fn sdf(&self, p: Vec3) -> f32 {
        self.program().sdf(p)
    }

    /// Whether `p` is inside: `sdf(p) < 0`.
    #[must_use]
    pub fn contains(&self, p: Vec3) -> bool {
        self.program().contains(p)
    }
}
