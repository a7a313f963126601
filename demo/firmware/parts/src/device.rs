//! A small device: a mug and a drilled block on a turntable, shown on a display of 128 by 64 pixels, and watched by a
//! time-of-flight sensor.
//!
//! The scene is constant and lies in flash; the turntable's angle is one transform, made as it turns. All numbers are
//! metres.

use crate::picture::{Picture, PictureError};
use crate::range_finder::{RangeFinder, RangeFinderError};
use crate::shade::{brightness, dithered};
use core::fmt;
use embedded_graphics_core::Drawable;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor::BinaryColor;
use glam::{Mat3, Vec3, vec3};
use gsdf_nostd::{Camera, CappedCylinder, Cuboid, Hit, Invalid, Lane, ProgramError, Span, Transform, csg, leaf_set};
use gsdf_workload::digest::Digest;

leaf_set! {
    /// The solids of which the scene is made: no other's formulas are linked.
    pub enum Part { CappedCylinder(CappedCylinder), Cuboid(Cuboid) }
}

csg! {
    /// A mug, standing: a ring for a handle, and hollow.
    const MUG: Part = difference(
        union(
            CappedCylinder::new(vec3(-0.045, 0.0, 0.0), vec3(-0.045, 0.08, 0.0), Vec3::Y, 0.032),
            difference(
                CappedCylinder::new(vec3(-0.08, 0.042, -0.007), vec3(-0.08, 0.042, 0.007), Vec3::Z, 0.027),
                CappedCylinder::new(vec3(-0.08, 0.042, -0.01), vec3(-0.08, 0.042, 0.01), Vec3::Z, 0.017)
            )
        ),
        CappedCylinder::new(vec3(-0.045, 0.006, 0.0), vec3(-0.045, 0.09, 0.0), Vec3::Y, 0.027)
    )
}

csg! {
    /// A block, drilled through from front to back, and from above into that hole.
    const BLOCK: Part = difference(
        Cuboid::new(vec3(0.03, 0.0, -0.03), vec3(0.09, 0.05, 0.03)),
        CappedCylinder::new(vec3(0.06, 0.025, -0.04), vec3(0.06, 0.025, 0.04), Vec3::Z, 0.015),
        CappedCylinder::new(vec3(0.06, 0.025, 0.0), vec3(0.06, 0.06, 0.0), Vec3::Y, 0.008)
    )
}

csg! {
    /// Both on the turntable, in the frame that turns.
    pub const TURNTABLE: Part = union(
        CappedCylinder::new(vec3(0.0, -0.012, 0.0), Vec3::ZERO, Vec3::Y, 0.12),
        posed(1, union(MUG, BLOCK))
    )
}

/// The width of the display in pixels.
pub const WIDTH: u32 = 128;

/// The height of the display in pixels.
pub const HEIGHT: u32 = 64;

/// The bytes of the display's memory, one bit per pixel.
pub const MEMORY: usize = (WIDTH * HEIGHT / 8) as usize;

/// Where light comes from: a unit vector.
const LIGHT: Vec3 = vec3(-0.48, 0.8, -0.36);

/// Where the turntable can stop: cosine and sine of the angle, whose bits then depend on no library.
pub const STOPS: [(f32, f32); 2] = [(0.96, 0.28), (0.6, -0.8)];

/// The [`Digest`] to which [`record`] brings all stops, in their order.
pub const GOLDEN: u64 = 0x8c1b_0c5e_93d6_c099;

/// Why the device does not work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DeviceError<E> {
    /// A camera or an angle.
    Invalid(Invalid),
    /// The program or its scratch memory.
    Program(ProgramError),
    /// The picture.
    Picture(PictureError),
    /// The sensor.
    RangeFinder(RangeFinderError),
    /// The display's own.
    Display(E),
}

impl<E: fmt::Debug> fmt::Display for DeviceError<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid(error) => error.fmt(f),
            Self::Program(error) => error.fmt(f),
            Self::Picture(error) => error.fmt(f),
            Self::RangeFinder(error) => error.fmt(f),
            Self::Display(error) => write!(f, "display: {error:?}"),
        }
    }
}

impl<E: fmt::Debug> core::error::Error for DeviceError<E> {}

/// The turntable's pose at an angle, given by cosine and sine.
///
/// # Errors
/// Where the two are those of no angle at all, such as zeros or NaN.
pub const fn turned((cosine, sine): (f32, f32)) -> Result<Transform, Invalid> {
    let matrix = Mat3::from_cols(vec3(cosine, 0.0, -sine), Vec3::Y, vec3(sine, 0.0, cosine));
    Transform::affine(matrix, Vec3::ZERO)
}

/// Draws the scene on a display, in the arithmetic of `like`.
///
/// # Errors
/// Those of the display alone, if the pose is one of [`turned`].
pub fn draw<T: Lane, D>(pose: Transform, like: T, display: &mut D) -> Result<(), DeviceError<D::Error>>
where
    D: DrawTarget<Color = BinaryColor>,
{
    let poses = [pose];
    let program = TURNTABLE.program().posed(&poses).map_err(DeviceError::Program)?;
    let camera = Camera::pinhole(vec3(0.0, 0.17, -0.4), vec3(0.0, 0.02, 0.0), Vec3::Y, 0.165).map_err(DeviceError::Invalid)?;
    let picture = Picture::new(program, camera.raster(WIDTH, HEIGHT), scratch(like), |pixel, hit| {
        dithered(pixel, hit.map_or(0, shade))
    });
    picture.map_err(DeviceError::Picture)?.draw(display).map_err(DeviceError::Display)
}

/// How bright a surface is: with a little light from everywhere, which keeps what is in shadow from the black behind
/// it, and dark for the turntable itself, which keeps things from the ground they stand on.
fn shade(hit: &Hit) -> u8 {
    let bright = 24 + brightness(hit.normal, LIGHT) / 9 * 8;
    if hit.leaf == 0 { bright / 3 } else { bright }
}

/// One reading of a sensor that looks at the turntable from the front, at the height of the mug's middle: metres, in
/// the order of [`RangeFinder`]'s zones. The arithmetic is that of `like`.
///
/// # Errors
/// None, if the pose is one of [`turned`].
pub fn read<T: Lane>(pose: Transform, like: T) -> Result<[f32; RangeFinder::ZONES], DeviceError<core::convert::Infallible>> {
    let poses = [pose];
    let program = TURNTABLE.program().posed(&poses).map_err(DeviceError::Program)?;
    let sensor = RangeFinder::new(vec3(0.0, 0.08, -0.28), vec3(0.0, 0.035, 0.0), Vec3::Y, 0.414, 0.02..4.0);
    sensor
        .map_err(DeviceError::RangeFinder)?
        .read(&program, &mut scratch(like))
        .map_err(DeviceError::Program)
}

/// Memory for the spans of all leaves.
fn scratch<T: Lane>(like: T) -> [Span<T>; TURNTABLE.leaves()] {
    [Span::empty_like(like); TURNTABLE.leaves()]
}

/// Adds what the device shows and measures at a stop to a digest: the display's memory, one bit per pixel with the
/// leftmost in the highest, and the distances.
pub fn record(digest: &mut Digest, memory: &[u8; MEMORY], distances: &[f32; RangeFinder::ZONES]) {
    let (words, _) = memory.as_chunks();
    words.iter().for_each(|&word| digest.word(u32::from_le_bytes(word)));
    distances.iter().for_each(|&distance| digest.number(distance));
}

#[cfg(test)]
mod tests {
    use super::{GOLDEN, HEIGHT, MEMORY, STOPS, WIDTH, draw, read, record, turned};
    use crate::Fpu;
    use embedded_graphics::framebuffer::Framebuffer;
    use embedded_graphics::pixelcolor::raw::{LittleEndian, RawU1};
    use embedded_graphics_core::pixelcolor::BinaryColor;
    use gsdf_workload::digest::Digest;

    type Screen = Framebuffer<BinaryColor, RawU1, LittleEndian, { WIDTH as usize }, { HEIGHT as usize }, MEMORY>;

    #[test]
    fn the_device_shows_and_measures_what_it_did() {
        let mut digest = Digest::new();
        for stop in STOPS {
            let pose = turned(stop).unwrap();
            let mut display = Screen::new();
            draw(pose, Fpu(0.0), &mut display).unwrap();
            let mut plain = Screen::new();
            draw(pose, 0.0_f32, &mut plain).unwrap();
            assert_eq!(display.data(), plain.data());
            let distances = read(pose, 0.0_f32).unwrap();
            assert_eq!(distances, read(pose, Fpu(0.0)).unwrap());
            record(&mut digest, display.data(), &distances);
        }
        assert_eq!(digest.finish(), GOLDEN, "{:#018x}", digest.finish());
    }

    #[test]
    fn angles_that_are_none_are_refused() {
        for stop in [(0.0, 0.0), (f32::NAN, 0.0), (1.0, f32::INFINITY)] {
            assert!(turned(stop).is_err());
        }
    }
}
