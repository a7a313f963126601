//! What a query finds.

use super::footing::OnSurface;
use super::lanes::Encounter;
use crate::ray::Ray;
use crate::real::Lane;
use crate::vec3::V3;
use glam::Vec3;

/// Where a ray first crosses the boundary of a program, and what it meets there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The parameter of the ray, in units of its direction's length; an end of a leaf's span, bit for bit.
    pub t: f32,
    /// The point, each coordinate with the rounding of `t` and two more.
    pub point: Vec3,
    /// The unit normal of the surface, outward from the solid: against the ray where it enters, along it where it
    /// leaves.
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

impl Hit {
    /// What a ray meets at its parameter `t`, its numbers rounded to `f32`: for evaluators of one's own, such as packets.
    #[must_use]
    pub fn new<T: Lane>(ray: &Ray, t: T, met: &Encounter<T>) -> Self {
        Self::at(ray, t.to_f32(), met)
    }

    /// The same with the parameter in `f32` already.
    pub(super) fn at<T: Lane>(ray: &Ray, t: f32, met: &Encounter<T>) -> Self {
        let point = ray.at(t);
        let V3 { x, y, z } = met.surface.normal;
        Self {
            t,
            point,
            normal: Vec3::new(x.to_f32(), y.to_f32(), z.to_f32()),
            leaf: met.leaf.to_index(),
            // Saturates: no solid has 255 faces.
            face: u8::try_from(met.surface.face.to_index()).unwrap_or(u8::MAX),
            entering: met.entering,
            slack: OnSurface::slack(ray.origin(), point),
        }
    }
}
