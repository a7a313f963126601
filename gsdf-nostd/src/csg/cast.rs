//! Queries of whole programs with memory of their own.

use super::hit::Hit;
use super::program::Csg;
use super::start::Departure;
use crate::leaf::Solid;
use crate::ray::{Ray, RayError};
use glam::Vec3;

impl<const N: usize, L: Solid> Csg<N, L> {
    /// The first crossing of the boundary within the ray's range: distance, point, normal, leaf, entering or leaving.
    /// `None` where there is none.
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
    /// Where `direction` is no [`Ray`]'s, or the hit lies beyond ±2^30.
    pub fn cast_from(&self, hit: &Hit, direction: Vec3) -> Result<Option<Hit>, RayError> {
        Ok(self.along(Departure::new(hit, direction)?).cast())
    }

    /// The generalized signed distance function `φ_G(v, p)`: how far from `p` along `v` to the next crossing of the
    /// boundary, positive outside, negative inside, infinite where there is none; NaN unless the two make a [`Ray`].
    /// Exact: the march, not one evaluation of minima and maxima, which is only a bound.
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
