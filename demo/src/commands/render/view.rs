//! From where a model is seen.

use crate::commands::size::Size;
use crate::model::bounds::Reach;
use anyhow::{Context, Result, bail};
use clap::Args;
use core::str::FromStr;
use glam::{Vec3, vec3};
use gsdf_nostd::{Bounds, Camera, Raster};

/// A camera, as far as it is told.
#[derive(Args, Clone, Debug, Default, PartialEq)]
pub struct View {
    /// Where the camera stands [default: where it sees all of the model]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub eye: Option<Place>,
    /// What it looks at [default: the middle of the model]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub target: Option<Place>,
    /// What is up in the picture [default: z]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub up: Option<Place>,
    /// The angle from the bottom of the picture to its top, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = 30.0)]
    pub fov: f32,
    /// Rays are parallel: the picture is as high as the angle is at the target
    #[arg(long)]
    pub orthographic: bool,
}

/// A point or a direction, as it is written on a command line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place(pub Vec3);

impl FromStr for Place {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers: Vec<f32> = text
            .split(',')
            .map(|number| number.trim().parse().ok().filter(|number: &f32| number.is_finite()))
            .collect::<Option<_>>()
            .unwrap_or_default();
        match numbers[..] {
            [x, y, z] => Ok(Self(vec3(x, y, z))),
            _ => Err("it is three numbers between commas, such as 1,-2.5,3".to_owned()),
        }
    }
}

/// From where one looks if nothing is said: from the front, a little from the right and from above.
const FROM: Vec3 = vec3(0.42, -0.75, 0.51);

/// How much of the picture's width or height a model fills at most.
const FILLED: f32 = 0.92;

impl View {
    /// What the camera sees of a model that reaches so far, as pixels.
    ///
    /// # Errors
    /// Where there is no such camera, or more must be told.
    pub fn raster(&self, reach: Reach, size: Size) -> Result<Raster> {
        if !(self.fov > 0.0 && self.fov < 180.0) {
            bail!("--fov {}: the angle must be between 0 and 180 degrees", self.fov);
        }
        let tangent = (0.5 * self.fov.to_radians()).tan();
        let bounds = match reach {
            Reach::Within(bounds) => Some(bounds),
            Reach::Empty => bail!("the model is empty: there is nothing to see"),
            Reach::Endless => None,
        };
        let middle = bounds.map(|bounds| 0.5 * (bounds.min + bounds.max));
        let told = |place: Option<Place>| place.map(|place| place.0);
        let target = told(self.target)
            .or(middle)
            .context("the model has no end, so that no camera sees all of it: give --eye and --target")?;
        let eye = match (told(self.eye), bounds) {
            (Some(eye), _) => eye,
            (None, Some(bounds)) => self.standing_back(bounds, target, tangent, size),
            (None, None) => bail!("the model has no end, so that no camera sees all of it: give --eye and --target"),
        };
        let up = told(self.up).unwrap_or_else(|| upward(target - eye));
        let camera = if self.orthographic {
            Camera::orthographic(eye, target, up, tangent * eye.distance(target))
        } else {
            Camera::pinhole(eye, target, up, tangent)
        };
        Ok(camera.context("there is no such camera")?.raster(size.width, size.height))
    }

    /// The place in the usual direction, as near to the target as all corners of a box allow.
    fn standing_back(&self, bounds: Bounds, target: Vec3, tangent: f32, size: Size) -> Vec3 {
        let back = FROM.normalize();
        let right = self.up.map_or(Vec3::Z, |up| up.0).cross(back).normalize_or(Vec3::X);
        let up = back.cross(right);
        let limits = [FILLED * tangent * size.width as f32 / size.height as f32, FILLED * tangent];
        let corner = |number: usize| {
            let side = |axis: usize| {
                if number >> axis & 1 == 0 {
                    bounds.min[axis]
                } else {
                    bounds.max[axis]
                }
            };
            vec3(side(0), side(1), side(2)) - target
        };
        let away = |corner: Vec3| {
            let aside = (corner.dot(right).abs() / limits[0]).max(corner.dot(up).abs() / limits[1]);
            // Parallel rays see as much of what is near as of what is far, but not what is behind them.
            let nearer = corner.dot(back);
            if self.orthographic {
                aside.max(nearer * 1.01)
            } else {
                aside + nearer
            }
        };
        target + (0..8).map(corner).map(away).fold(0.0, f32::max) * back
    }
}

/// Up, for who looks in a direction: z, or y where one looks along that.
fn upward(sight: Vec3) -> Vec3 {
    /// Nearer to an axis than that one looks along it.
    const ALONG: f32 = 1e-4;
    if sight.truncate().length() <= ALONG * sight.length() {
        Vec3::Y
    } else {
        Vec3::Z
    }
}

#[cfg(test)]
mod tests {
    use super::{Place, View};
    use crate::commands::size::Size;
    use crate::model::bounds::Reach;
    use glam::{Vec3, vec3};
    use gsdf_nostd::Bounds;

    const BOX: Bounds = Bounds {
        min: vec3(-1.0, 2.0, 0.0),
        max: vec3(5.0, 3.0, 10.0),
    };

    fn view(orthographic: bool) -> View {
        View {
            fov: 30.0,
            orthographic,
            ..View::default()
        }
    }

    #[test]
    fn a_framed_model_fills_the_picture_and_no_more() {
        for orthographic in [false, true] {
            for size in [Size::from(100), Size { width: 30, height: 200 }, Size { width: 200, height: 30 }] {
                let raster = view(orthographic).raster(Reach::Within(BOX), size).expect("there is such a camera");
                let camera = raster.camera();
                let places = (0..8).map(|number| {
                    let side = |axis: usize| if number >> axis & 1 == 0 { BOX.min[axis] } else { BOX.max[axis] };
                    let to = vec3(side(0), side(1), side(2)) - camera.eye();
                    let depth = if orthographic { 1.0 } else { to.dot(camera.forward()) };
                    assert!(to.dot(camera.forward()) > 0.0);
                    let half = 0.5 * raster.pixel() * depth;
                    let x = to.dot(camera.right()) / (half * size.width as f32);
                    let y = to.dot(camera.up()) / (half * size.height as f32);
                    x.abs().max(y.abs())
                });
                let most = places.fold(0.0, f32::max);
                assert!((0.85..=0.93).contains(&most), "{size} {orthographic}: {most}");
            }
        }
    }

    #[test]
    fn endless_models_need_a_camera() {
        let size = Size::from(10);
        let error = view(false).raster(Reach::Endless, size).expect_err("nobody sees all of it");
        assert!(error.to_string().contains("--eye"), "{error}");
        let told = View {
            eye: Some(Place(Vec3::ONE)),
            target: Some(Place(Vec3::ZERO)),
            ..view(false)
        };
        assert!(told.raster(Reach::Endless, size).is_ok());
        assert!(view(false).raster(Reach::Empty, size).is_err());
        let wide = View { fov: 180.0, ..view(false) };
        assert!(wide.raster(Reach::Within(BOX), size).is_err());
    }

    #[test]
    fn one_may_look_straight_down() {
        let above = View {
            eye: Some(Place(vec3(2.0, 2.5, 50.0))),
            ..view(false)
        };
        assert!(above.raster(Reach::Within(BOX), Size::from(10)).is_ok());
    }

    #[test]
    fn places_are_three_numbers() {
        assert_eq!("1,-2.5, 3".parse(), Ok(Place(vec3(1.0, -2.5, 3.0))));
        for wrong in ["1,2", "1,2,3,4", "a,b,c", "1,2,inf", ""] {
            assert!(wrong.parse::<Place>().is_err(), "{wrong}");
        }
    }
}
