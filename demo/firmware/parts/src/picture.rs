//! A program as something to draw, for every display that has a driver for `embedded-graphics`.

use core::fmt;
use embedded_graphics_core::Drawable;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{Dimensions, Point, Size};
use embedded_graphics_core::pixelcolor::PixelColor;
use embedded_graphics_core::primitives::{PointsIter, Rectangle};
use gsdf_nostd::{Hit, Lane, Program, ProgramError, Raster, RayError, Solid, Span};

/// A program as a camera sees it, to be drawn on any display: `picture.draw(&mut display)?`.
///
/// It casts one ray per pixel that the display has and hands the colours over row by row, as the display takes them:
/// no copy of the picture is kept. `shader` makes a colour of a pixel's place, counted from the picture's upper left
/// corner, and what is seen there.
///
/// ```
/// use embedded_graphics::framebuffer::{Framebuffer, buffer_size};
/// use embedded_graphics::pixelcolor::{BinaryColor, raw::{LittleEndian, RawU1}};
/// use embedded_graphics::prelude::*;
/// use gsdf_nostd::{Camera, Sphere, csg};
/// use gsdf_parts::Picture;
/// use gsdf_parts::shade::{brightness, dithered};
/// use glam::{Vec3, vec3};
///
/// csg! { const BALL = Sphere::new(Vec3::ZERO, 1.0) }
/// let raster = Camera::pinhole(vec3(0.0, 0.0, 4.0), Vec3::ZERO, Vec3::Y, 0.3)?.raster(32, 32);
/// let picture = Picture::new(BALL.program(), raster, BALL.scratch(), |pixel, hit| {
///     dithered(pixel, hit.map_or(0, |hit| brightness(hit.normal, Vec3::Y)))
/// })?;
///
/// let mut display = Framebuffer::<BinaryColor, RawU1, LittleEndian, 32, 32, { buffer_size::<BinaryColor>(32, 32) }>::new();
/// picture.draw(&mut display)?;
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Picture<'a, const N: usize, L, F, T = f32> {
    program: Program<'a, L>,
    raster: Raster,
    /// Not yet used: drawing works on a copy, since it has but a shared reference.
    scratch: [Span<T>; N],
    shader: F,
    top_left: Point,
}

/// Why something is not a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PictureError {
    /// The scratch memory is too short.
    Program(ProgramError),
    /// A pixel of the raster has no ray: an orthographic camera's picture that leaves the range of coordinates.
    Ray(RayError),
}

impl fmt::Display for PictureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Program(error) => error.fmt(f),
            Self::Ray(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for PictureError {}

impl<'a, const N: usize, L: Solid, F, T: Lane> Picture<'a, N, L, F, T> {
    /// The picture of `program` on `raster`, at the upper left corner of the display. `scratch` is what
    /// [`Csg::scratch`](gsdf_nostd::Csg::scratch) gives, or any array of at least as many spans as there are leaves; in
    /// their arithmetic the picture is computed.
    ///
    /// # Errors
    /// Where `scratch` is shorter than that, or a pixel of the raster has no ray.
    pub fn new<C>(program: Program<'a, L>, raster: Raster, scratch: [Span<T>; N], shader: F) -> Result<Self, PictureError>
    where
        F: Fn(Point, Option<&Hit>) -> C,
    {
        if N < program.leaves() {
            return Err(PictureError::Program(ProgramError::ScratchTooShort(N, program.leaves())));
        }
        // Rays start in a parallelogram and directions make one, the range is a box: corners in it have all in it.
        if let (Some(right), Some(bottom)) = (raster.width().checked_sub(1), raster.height().checked_sub(1)) {
            for (x, y) in [(0, 0), (right, 0), (0, bottom), (right, bottom)] {
                raster.ray(x, y).map_err(PictureError::Ray)?;
            }
        }
        Ok(Self {
            program,
            raster,
            scratch,
            shader,
            top_left: Point::zero(),
        })
    }

    /// The same picture elsewhere on the display. What lies beyond the display's edges is not computed.
    ///
    /// A place so far out that `i32` could not count all pixels is moved back to where it can.
    #[must_use]
    pub fn at(self, top_left: Point) -> Self {
        let most = Point::new(
            i32::MAX.saturating_sub_unsigned(self.raster.width()),
            i32::MAX.saturating_sub_unsigned(self.raster.height()),
        );
        let top_left = top_left.component_min(most);
        Self { top_left, ..self }
    }

    /// What is seen through a pixel of the raster.
    fn cast(&self, pixel: Point, scratch: &mut [Span<T>]) -> Option<Hit> {
        let (x, y) = (u32::try_from(pixel.x).ok()?, u32::try_from(pixel.y).ok()?);
        self.program.along(self.raster.ray(x, y).ok()?, scratch).ok()?.cast()
    }
}

impl<const N: usize, L, F, T> Dimensions for Picture<'_, N, L, F, T> {
    fn bounding_box(&self) -> Rectangle {
        Rectangle::new(self.top_left, Size::new(self.raster.width(), self.raster.height()))
    }
}

impl<const N: usize, L, C, F, T> Drawable for Picture<'_, N, L, F, T>
where
    L: Solid,
    C: PixelColor,
    F: Fn(Point, Option<&Hit>) -> C,
    T: Lane,
{
    type Color = C;
    type Output = ();

    fn draw<D: DrawTarget<Color = C>>(&self, target: &mut D) -> Result<(), D::Error> {
        let visible = self.bounding_box().intersection(&target.bounding_box());
        if visible.is_zero_sized() {
            return Ok(());
        }
        let mut scratch = self.scratch;
        let colors = visible.points().map(|place| {
            let pixel = place - self.top_left;
            (self.shader)(pixel, self.cast(pixel, &mut scratch).as_ref())
        });
        target.fill_contiguous(&visible, colors)
    }
}
