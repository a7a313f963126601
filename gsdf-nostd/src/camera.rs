//! Cameras: from the place of a pixel to a ray.

use crate::invalid::{Fault, Invalid, length, point};
use crate::range::{max_norm, unit_scale};
use crate::ray::{Ray, RayError};
use crate::real::Real;
use crate::vec3::V3;
use glam::Vec3;

/// A camera: pinhole or orthographic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    eye: Vec3,
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    half_height: f32,
    projection: Projection,
}

/// How a camera's rays spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Projection {
    /// All rays start at the eye: perspective.
    Pinhole,
    /// All rays are parallel, and start in the plane through the eye.
    Orthographic,
}

impl Camera {
    /// A camera at `eye` that looks at `target`, with `up` upward in the picture. `tangent` is that of half the
    /// vertical field of view.
    ///
    /// Its rays advance by one unit along the viewing direction per unit of their parameter: `t` is depth. They are
    /// not of unit length off the centre.
    ///
    /// # Errors
    /// Where a number is not finite or out of range, eye and target coincide, or `up` is parallel to the line of
    /// sight.
    pub fn pinhole(eye: Vec3, target: Vec3, up: Vec3, tangent: f32) -> Result<Self, Invalid> {
        Self::new(eye, target, up, length("camera tangent", tangent)?, Projection::Pinhole)
    }

    /// A camera with parallel rays at `eye` that looks at `target`, with `up` upward in the picture, which is `2
    /// half_height` high in the scene. `t` is depth.
    ///
    /// # Errors
    /// As for [`pinhole`](Self::pinhole).
    pub fn orthographic(eye: Vec3, target: Vec3, up: Vec3, half_height: f32) -> Result<Self, Invalid> {
        let half_height = length("camera half height", half_height)?;
        Self::new(eye, target, up, half_height, Projection::Orthographic)
    }

    fn new(eye: Vec3, target: Vec3, up: Vec3, half_height: f32, projection: Projection) -> Result<Self, Invalid> {
        let sight = point("camera target", target)? - point("camera eye", eye)?;
        let forward = unit_or("distance from camera eye to target", sight)?;
        let up = unit_or("camera up", point("camera up", up)?)?;
        // Below this the part of `up` across the line of sight is rounding errors.
        let across = up.cross(forward);
        if max_norm(across) < PARALLEL {
            return Err(Invalid::new(
                "camera up across the line of sight",
                max_norm(across),
                Fault::Degenerate,
            ));
        }
        let right = unit_or("camera up", across)?;
        Ok(Self {
            eye,
            right,
            up: forward.cross(right),
            forward,
            half_height,
            projection,
        })
    }

    /// Where the camera stands.
    #[must_use]
    pub const fn eye(&self) -> Vec3 {
        self.eye
    }

    /// The unit vector in which it looks.
    #[must_use]
    pub const fn forward(&self) -> Vec3 {
        self.forward
    }

    /// The unit vector to the right in its picture.
    #[must_use]
    pub const fn right(&self) -> Vec3 {
        self.right
    }

    /// The unit vector upward in its picture.
    #[must_use]
    pub const fn up(&self) -> Vec3 {
        self.up
    }

    /// How its rays spread.
    #[must_use]
    pub const fn projection(&self) -> Projection {
        self.projection
    }

    /// The camera's picture as a raster of `width` by `height` square pixels.
    #[must_use]
    pub fn raster(&self, width: u32, height: u32) -> Raster {
        Raster {
            camera: *self,
            width,
            height,
        }
    }
}

/// The sine of the least angle that must be between a camera's `up` and its line of sight: 2^-16.
const PARALLEL: f32 = 1.0 / 65_536.0;

fn unit_or(parameter: &'static str, vector: Vec3) -> Result<Vec3, Invalid> {
    let largest = max_norm(vector);
    if largest < f32::MIN_POSITIVE {
        return Err(Invalid::new(parameter, largest, Fault::Degenerate));
    }
    let scaled = vector * unit_scale(largest);
    Ok(scaled / libm::sqrtf(scaled.dot(scaled)))
}

/// A camera's picture as pixels: `x` from 0 at the left, `y` from 0 at the top, centres at halves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Raster {
    camera: Camera,
    width: u32,
    height: u32,
}

impl Raster {
    /// The camera.
    #[must_use]
    pub const fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The number of pixels in a row.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// The number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The side of a pixel: in the plane at depth 1 of a pinhole camera, in the scene for an orthographic one.
    #[inline(always)]
    #[must_use]
    #[allow(clippy::cast_precision_loss, reason = "pictures are lower than 2^24 pixels")]
    pub fn pixel(&self) -> f32 {
        2.0 * self.camera.half_height / self.height as f32
    }

    /// The ray through the centre of pixel (`x`, `y`).
    ///
    /// # Errors
    /// For orthographic cameras whose picture reaches beyond ±2^30, where it does.
    pub fn ray(&self, x: u32, y: u32) -> Result<Ray, RayError> {
        #[allow(clippy::cast_precision_loss, reason = "pictures are narrower than 2^24 pixels")]
        self.ray_through(x as f32 + 0.5, y as f32 + 0.5)
    }

    /// The ray through any place of the picture; pixel (0, 0) reaches from (0, 0) to (1, 1).
    ///
    /// # Errors
    /// Where the numbers leave the range of rays.
    pub fn ray_through(&self, x: f32, y: f32) -> Result<Ray, RayError> {
        let (origin, direction) = self.line(x, y);
        Ray::new(origin.into(), direction.into())
    }

    /// Origin and direction of the ray through any place of the picture, in any arithmetic: the same bits in every
    /// lane.
    #[inline(always)]
    pub fn line<T: Real>(&self, x: T, y: T) -> (V3<T>, V3<T>) {
        self.line_from(self.column(x), self.upward(y))
    }

    /// Origin and direction of the ray through the middle of column `x`: what all its rays have in common.
    #[inline(always)]
    #[allow(clippy::cast_precision_loss, reason = "pictures are narrower than 2^24 pixels")]
    pub fn column<T: Real>(&self, x: T) -> (V3<T>, V3<T>) {
        let (eye, forward) = (V3::splat(x, self.camera.eye), V3::splat(x, self.camera.forward));
        let pixel = x.splat_like(self.pixel());
        let across = V3::splat(x, self.camera.right).scaled((x - x.splat_like(0.5 * self.width as f32)) * pixel);
        match self.camera.projection {
            Projection::Pinhole => (eye, forward + across),
            Projection::Orthographic => (eye + across, forward),
        }
    }

    /// How far row `y` is from the middle of the picture.
    #[inline(always)]
    #[allow(clippy::cast_precision_loss, reason = "pictures are lower than 2^24 pixels")]
    pub fn upward<T: Real>(&self, y: T) -> V3<T> {
        let pixel = y.splat_like(self.pixel());
        V3::splat(y, self.camera.up).scaled((y.splat_like(0.5 * self.height as f32) - y) * pixel)
    }

    /// Origin and direction of the ray that is so far above the middle of a [`column`](Self::column).
    #[inline(always)]
    pub fn line_from<T: Real>(&self, (origin, direction): (V3<T>, V3<T>), upward: V3<T>) -> (V3<T>, V3<T>) {
        match self.camera.projection {
            Projection::Pinhole => (origin, direction + upward),
            Projection::Orthographic => (origin + upward, direction),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Camera;
    use glam::{Vec3, vec3};

    #[test]
    fn the_middle_looks_forward_and_the_corners_spread() {
        let eye = vec3(0.0, 0.0, -4.0);
        let camera = Camera::pinhole(eye, Vec3::ZERO, Vec3::Y, 0.5).unwrap();
        let raster = camera.raster(200, 100);
        let middle = raster.ray_through(100.0, 50.0).unwrap();
        assert_eq!((middle.origin(), middle.direction()), (eye, Vec3::Z));
        // Right is up x forward = +x; the top left corner lies up and to the left.
        let corner = raster.ray_through(0.0, 0.0).unwrap();
        assert_eq!(corner.direction(), vec3(-1.0, 0.5, 1.0));

        let flat = Camera::orthographic(eye, Vec3::ZERO, Vec3::Y, 2.0).unwrap().raster(100, 100);
        let corner = flat.ray_through(100.0, 100.0).unwrap();
        assert_eq!((corner.origin(), corner.direction()), (vec3(2.0, -2.0, -4.0), Vec3::Z));
    }

    #[test]
    fn cameras_that_see_nothing_are_refused() {
        let (eye, target) = (vec3(1.0, 2.0, 3.0), Vec3::ZERO);
        assert!(Camera::pinhole(eye, eye, Vec3::Y, 0.5).is_err());
        assert!(Camera::pinhole(eye, target, Vec3::ZERO, 0.5).is_err());
        assert!(Camera::pinhole(Vec3::Y, target, Vec3::Y, 0.5).is_err());
        let oblique = vec3(-10.0, -10.0, -9.0);
        assert!(Camera::pinhole(oblique, target, oblique, 0.5).is_err());
        assert!(Camera::pinhole(eye, target, Vec3::Y, -0.5).is_err());
        assert!(Camera::pinhole(eye, target, Vec3::Y, f32::NAN).is_err());
        assert!(Camera::orthographic(eye, vec3(f32::NAN, 0.0, 0.0), Vec3::Y, 0.5).is_err());
    }
}
