//! First hits, and rays that leave them.

use super::lanes::Encounter;
use super::program::Csg;
use super::sight::Sight;
use super::start::{Departure, Start};
use crate::leaf::{Ground, Solid};
use crate::range::max_norm;
use crate::ray::{Ray, RayError};
use crate::real::Lane;
use crate::span::Span;
use glam::Vec3;

/// Where a ray first crosses the boundary of a program, and what it meets there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The parameter of the ray, in units of its direction's length; an end of a leaf's span, bit for bit.
    pub t: f32,
    /// The point, each coordinate with the rounding of `t` and two more.
    pub point: Vec3,
    /// The unit normal of the surface, outward from the solid: against the ray where it enters, along it where it leaves.
    pub normal: Vec3,
    /// The number of the leaf whose surface it is.
    pub leaf: u32,
    /// The number of that leaf's face, as its `surface` numbers them.
    pub face: u8,
    /// Whether the ray enters the solid there, or leaves it.
    pub entering: bool,
    /// How far the point may be off the surface by rounding alone.
    pub(super) slack: f32,
}

impl<L: Solid, S: AsRef<[Span<f32>]>, R: Start> Sight<'_, L, S, R> {
    /// The first crossing within the ray's range, with its normal.
    #[must_use]
    pub fn cast(&self) -> Option<Hit> {
        let ray = self.ray();
        let start = ray.parameter_on_line(ray.range().start);
        let found = self.march_from(start)?;
        let met = self.start.surface(&self.program, self.spans.as_ref(), found);
        let t = ray.parameter_of(found);
        Some(Hit::new(ray, t, &met))
    }
}

impl Hit {
    /// What a ray meets at its parameter `t`: for evaluators of one's own, such as packets.
    #[must_use]
    pub fn new(ray: &Ray, t: f32, met: &Encounter<f32>) -> Self {
        let point = ray.at(t);
        Self {
            t,
            point,
            normal: met.surface.normal.into(),
            leaf: met.leaf.to_index(),
            face: face_number(met.surface.face),
            entering: met.entering,
            slack: (max_norm(ray.origin()) + max_norm(point)) * Ground::<f32>::ROUNDING,
        }
    }
}

fn face_number(face: f32) -> u8 {
    // Saturates: no solid has 255 faces.
    u8::try_from(face.to_index()).unwrap_or(u8::MAX)
}

impl<const N: usize, L: Solid> Csg<N, L> {
    /// The first crossing of the boundary within the ray's range: distance, point, normal, leaf, entering or leaving. `None` where there is none.
    ///
    /// ```
    /// use gsdf_nostd::{Ray, Sphere, csg};
    /// use glam::{Vec3, vec3};
    ///
    /// csg! { const BALL = Sphere::new(Vec3::ZERO, 1.0) }
    /// let hit = BALL.cast(&Ray::new(vec3(0.0, 0.0, 3.0), Vec3::NEG_Z)?).unwrap();
    /// assert_eq!((hit.t, hit.normal, hit.entering), (2.0, Vec3::Z, true));
    /// # Ok::<(), gsdf_nostd::RayError>(())
    /// ```
    #[must_use]
    pub fn cast(&self, ray: &Ray) -> Option<Hit> {
        self.along(*ray).cast()
    }

    /// The first crossing beyond a hit, along another direction: [`cast`](Self::cast) of the [`Departure`] from it.
    ///
    /// # Errors
    /// Where `direction` is not finite or zero.
    pub fn cast_from(&self, hit: &Hit, direction: Vec3) -> Result<Option<Hit>, RayError> {
        Ok(self.along(Departure::new(hit, direction)?).cast())
    }

    /// The generalized signed distance function `φ_G(v, p)`: how far from `p` along `v` to the next crossing of the boundary, positive outside, negative inside, infinite where
    /// there is none; NaN unless the two make a [`Ray`]. Exact: the march, not one evaluation of minima and maxima, which is only a bound.
    ///
    /// In units of the length of `v`: a distance where `v` is of unit length.
    #[must_use]
    pub fn gsdf(&self, p: Vec3, v: Vec3) -> f32 {
        match Ray::new(p, v) {
            Ok(ray) => self.along(ray).gsdf(),
            Err(_) => f32::NAN,
        }
    }
}
