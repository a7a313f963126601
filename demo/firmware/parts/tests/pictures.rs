//! Pictures are what a cast per pixel gives, wherever on a display they lie, and the display's errors come through.

use embedded_graphics::framebuffer::{Framebuffer, buffer_size};
use embedded_graphics::image::GetPixel;
use embedded_graphics::mock_display::MockDisplay;
use embedded_graphics::pixelcolor::Gray8;
use embedded_graphics::pixelcolor::raw::{LittleEndian, RawU8};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::Rectangle;
use glam::{Vec3, vec3};
use gsdf_nostd::{Camera, Cuboid, Hit, ProgramError, Raster, Span, Sphere, csg};
use gsdf_parts::{Picture, PictureError};
use std::cell::Cell;

csg! {
    /// A ball bitten by a box: no two quarters of its picture are alike.
    const BITTEN = difference(Sphere::new(Vec3::ZERO, 1.0), Cuboid::new(vec3(0.2, 0.1, -2.0), vec3(2.0, 2.0, 2.0)))
}

fn raster(width: u32, height: u32) -> Raster {
    Camera::pinhole(vec3(0.5, 0.3, -4.0), Vec3::ZERO, Vec3::Y, 0.3)
        .expect("a valid camera")
        .raster(width, height)
}

/// A colour that tells pixel and surface, and is never that of a fresh display.
fn color(pixel: Point, hit: Option<&Hit>) -> Gray8 {
    let surface = hit.map_or(0.0, |hit| 40.0 * hit.normal.x + 100.0 + hit.leaf as f32);
    Gray8::new(1 + (surface as u8 ^ (pixel.x * 3 + pixel.y * 5) as u8) % 255)
}

/// What a pixel of the raster must show.
fn expected(raster: &Raster, pixel: Point) -> Gray8 {
    let ray = raster.ray(pixel.x as u32, pixel.y as u32).expect("a valid ray");
    color(pixel, BITTEN.cast(&ray).as_ref())
}

type Display = Framebuffer<Gray8, RawU8, LittleEndian, 24, 16, { buffer_size::<Gray8>(24, 16) }>;

#[test]
fn a_picture_anywhere_is_that_of_a_cast_per_pixel_and_clipped() {
    for (width, height) in [(24, 16), (10, 7), (40, 30), (1, 1), (0, 5), (5, 0)] {
        for (left, top) in [(0, 0), (3, 5), (-4, -6), (20, -3), (24, 0), (-100, 100), (i32::MAX, i32::MIN)] {
            let (raster, top_left) = (raster(width, height), Point::new(left, top));
            let casts = Cell::new(0);
            let shader = |pixel, hit: Option<&Hit>| {
                casts.set(casts.get() + 1);
                color(pixel, hit)
            };
            let picture = Picture::new(BITTEN.program(), raster, BITTEN.scratch(), shader)
                .unwrap()
                .at(top_left);
            if left < i32::MAX {
                assert_eq!(picture.bounding_box(), Rectangle::new(top_left, Size::new(width, height)));
            }
            let mut display = Display::new();
            let Ok(()) = picture.draw(&mut display);
            let mut visible = 0;
            for place in display.bounding_box().points() {
                let (x, y) = (i64::from(place.x) - i64::from(left), i64::from(place.y) - i64::from(top));
                let inside = (0..i64::from(width)).contains(&x) && (0..i64::from(height)).contains(&y);
                visible += i32::from(inside);
                let expected = if inside {
                    expected(&raster, Point::new(x as i32, y as i32))
                } else {
                    Gray8::BLACK
                };
                assert_eq!(
                    display.pixel(place),
                    Some(expected),
                    "{place:?} of {width}x{height} at {top_left:?}"
                );
            }
            assert_eq!(casts.get(), visible, "nothing unseen is computed");
        }
    }
}

#[test]
fn no_pixel_is_drawn_twice_or_beyond_the_edge() {
    // This display panics at both.
    let mut display = MockDisplay::<Gray8>::new();
    let raster = raster(50, 40);
    let picture = Picture::new(BITTEN.program(), raster, BITTEN.scratch(), color)
        .unwrap()
        .at(Point::new(40, -8));
    let Ok(()) = picture.draw(&mut display);
    assert_eq!(display.affected_area(), Rectangle::new(Point::new(40, 0), Size::new(24, 32)));
    assert_eq!(display.get_pixel(Point::new(43, 2)), Some(expected(&raster, Point::new(3, 10))));
    // A picture can be drawn again.
    let mut again = MockDisplay::<Gray8>::new();
    let Ok(()) = picture.draw(&mut again);
    again.assert_eq(&display);
}

/// A display whose wire is cut after some pixels.
struct Broken {
    left: u32,
}

impl OriginDimensions for Broken {
    fn size(&self) -> Size {
        Size::new(8, 8)
    }
}

impl DrawTarget for Broken {
    type Color = Gray8;
    type Error = &'static str;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(&mut self, pixels: I) -> Result<(), &'static str> {
        pixels.into_iter().try_for_each(|_| {
            self.left = self.left.checked_sub(1).ok_or("no answer")?;
            Ok(())
        })
    }
}

#[test]
fn errors_of_the_display_come_through_at_once() {
    let casts = Cell::new(0);
    let shader = |pixel, hit: Option<&Hit>| {
        casts.set(casts.get() + 1);
        color(pixel, hit)
    };
    let picture = Picture::new(BITTEN.program(), raster(8, 8), BITTEN.scratch(), shader).unwrap();
    assert_eq!(picture.draw(&mut Broken { left: 20 }), Err("no answer"));
    assert_eq!(casts.get(), 21);
    assert_eq!(picture.draw(&mut Broken { left: 64 }), Ok(()));
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let short = Picture::new(BITTEN.program(), raster(8, 8), [Span::EMPTY; 1], color);
    assert_eq!(short.err(), Some(PictureError::Program(ProgramError::ScratchTooShort(1, 2))));
    let edge = vec3(1e9, 0.0, -4.0);
    let wide = Camera::orthographic(edge, edge + Vec3::Z * 1e3, Vec3::Y, 1e8).unwrap().raster(8, 8);
    let error = Picture::new(BITTEN.program(), wide, BITTEN.scratch(), color).err().unwrap();
    assert!(matches!(error, PictureError::Ray(_)));
    assert!(error.to_string().contains("ray origin"), "{error}");
}
