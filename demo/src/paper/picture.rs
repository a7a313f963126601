//! The shapes under each reading, side by side on one sheet, with what is wrong in colours.

use super::measure::{Count, Each, Verdict};
use super::reader::Reader;
use super::reading::Reading;
use super::shapes::Shape;
use crate::palette::{CORAL, GROUND, INK, SAND, SLATE, to_srgb};
use crate::sheet::sheet;
use anyhow::{Context, Result};
use core::convert::Infallible;
use embedded_graphics::mono_font::{MonoFont, MonoTextStyleBuilder, ascii};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::{DrawTarget, Drawable, OriginDimensions, Pixel, Point, RgbColor, Size};
use embedded_graphics::text::{Alignment, Baseline, Text, TextStyle, TextStyleBuilder};
use glam::{Vec3, vec3};
use gsdf_nostd::{Camera, Ray};
use image::{Rgb, RgbImage, imageops};
use rayon::prelude::*;

/// The light comes from over the right shoulder of the outer camera.
const TOWARD_LIGHT: Vec3 = vec3(0.56, 0.74, -0.372_6);
/// Where nothing is, rightly.
const BACKDROP: Vec3 = vec3(0.82, 0.82, 0.80);

/// The colour of surfaces a verdict is passed on.
const fn colour(verdict: Verdict) -> Vec3 {
    match verdict {
        Verdict::Right => GROUND,
        Verdict::Phantom => CORAL,
        Verdict::Missed => SLATE,
        Verdict::Misplaced => SAND,
    }
}

/// What the colours mean.
const LEGEND: [(Verdict, &str); 4] = [
    (Verdict::Right, "right"),
    (Verdict::Phantom, "a surface where none is"),
    (Verdict::Missed, "none where one is"),
    (Verdict::Misplaced, "one at another distance"),
];

/// The camera of the pictures from outside.
///
/// # Errors
/// Where the shape is too large for any.
pub fn outer(shape: &Shape) -> Result<Camera> {
    let eye = shape.middle + shape.from * 4.0 * shape.radius;
    Camera::pinhole(eye, shape.middle, Vec3::Y, 0.27).context(shape.name)
}

/// The camera of the pictures from inside.
///
/// # Errors
/// Where the shape is too large for any, or its place inside is its middle.
pub fn inner(shape: &Shape) -> Result<Camera> {
    Camera::pinhole(shape.within, shape.middle, Vec3::Y, 1.0).context(shape.name)
}

/// What a camera sees of a shape under each reading, in pictures half as wide and high as `size`.
///
/// # Errors
/// Where the shape is no program.
pub fn pictures(shape: &Shape, camera: Camera, size: u32) -> Result<Vec<RgbImage>> {
    let reader = Reader::new(shape.program()?);
    let raster = camera.raster(size, size);
    let haze = 8.0 * shape.radius;
    let rows = (0..size)
        .into_par_iter()
        .map_init(
            || reader.scratch(),
            |scratch, y| {
                (0..size)
                    .map(|x| {
                        let ray = raster.ray(x, y).context(shape.name)?;
                        Ok(colours(&reader, ray, scratch, haze))
                    })
                    .collect::<Result<Vec<_>>>()
            },
        )
        .collect::<Result<Vec<_>>>()?;
    let picture = |reading: usize| RgbImage::from_fn(size, size, |x, y| Rgb(to_srgb(rows[y as usize][x as usize][reading])));
    // A sheet of one picture is that picture, halved.
    Ok((0..Reading::ALL.len()).map(|reading| sheet(&[picture(reading)])).collect())
}

/// The colours of one pixel under each reading.
fn colours(reader: &Reader<'_>, ray: Ray, scratch: &mut [gsdf_nostd::Span<f32>], haze: f32) -> Each<Vec3> {
    let view = reader.along(ray, scratch);
    let exact = reader.seen(Reading::Exact, view);
    Reading::ALL.map(|reading| {
        let seen = reader.seen(reading, view);
        let verdict = Verdict::on(seen, exact);
        // What was missed is drawn where it is.
        let Some(distance) = seen.or(exact) else { return BACKDROP };
        let back = -ray.direction().normalize();
        let normal = reader.normal(view, distance).unwrap_or(back);
        let facing = if normal.dot(back) < 0.0 { -normal } else { normal };
        let light = 0.5 + 0.25 * facing.dot(back) + 0.6 * facing.dot(TOWARD_LIGHT).max(0.0);
        let far = 1.0 - (-(distance * ray.direction().length() / haze).powi(2)).exp();
        (colour(verdict) * light).lerp(BACKDROP, 0.8 * far)
    })
}

/// The pictures of one shape, and the pixels that were counted.
#[derive(Clone, Debug)]
pub struct Row {
    /// The shape's name.
    pub name: &'static str,
    /// From outside and from inside, under each reading.
    pub pictures: [Vec<RgbImage>; 2],
    /// From outside and from inside, for each reading.
    pub counts: [Each<Count>; 2],
}

/// Pixels between pictures, around the sheet, for the names of shapes, and for the lines of the head.
const GAP: u32 = 6;
const NAMES: u32 = 164;
const LINE: u32 = 20;

/// All shapes, row by row under the names of the readings.
#[must_use]
pub fn table(rows: &[Row]) -> RgbImage {
    let tile = rows.first().and_then(|row| row.pictures[0].first()).map_or(0, RgbImage::width);
    let readings = Reading::ALL.len() as u32;
    // The sides keep a little apart.
    let column = |side: u32, reading: u32| GAP + NAMES + (side * readings + reading) * (tile + GAP) + side * 2 * GAP;
    let top = |row: u32| GAP + 2 * LINE + row * (tile + GAP);
    let legend = top(rows.len() as u32) + GAP;
    let mut page = Page(RgbImage::from_pixel(column(2, 0) - GAP, legend + LINE + GAP, Rgb([255; 3])));

    for (side, title) in (0..).zip(["from outside", "from inside"]) {
        page.write(&ascii::FONT_9X18_BOLD, title, [column(side, 0), GAP], Alignment::Left);
        for (number, reading) in (0..).zip(Reading::ALL) {
            page.write(
                &ascii::FONT_9X15,
                reading.name(),
                [column(side, number), GAP + LINE],
                Alignment::Left,
            );
        }
    }
    for (number, row) in (0..).zip(rows) {
        page.write(&ascii::FONT_8X13, row.name, [GAP, top(number) + tile / 2 - 6], Alignment::Left);
        for ((side, pictures), counts) in (0..).zip(&row.pictures).zip(&row.counts) {
            for ((reading, picture), count) in (0..).zip(pictures).zip(counts) {
                let corner = [column(side, reading), top(number)];
                imageops::replace(&mut page.0, picture, i64::from(corner[0]), i64::from(corner[1]));
                if reading > 0 {
                    let share = percent(count.percent(count.wrong()));
                    let place = [corner[0] + tile - 3, corner[1] + tile - 14];
                    page.write(&ascii::FONT_7X13_BOLD, &share, place, Alignment::Right);
                }
            }
        }
    }
    let mut left = column(0, 0);
    for (verdict, meaning) in LEGEND {
        let swatch = RgbImage::from_pixel(LINE - 6, LINE - 6, Rgb(to_srgb(colour(verdict))));
        imageops::replace(&mut page.0, &swatch, i64::from(left), i64::from(legend));
        page.write(&ascii::FONT_8X13, meaning, [left + LINE, legend], Alignment::Left);
        left += LINE + 8 * (meaning.len() as u32 + 3);
    }
    let note = "numbers: wrong pixels in pictures of many cameras, not of this one";
    page.write(&ascii::FONT_8X13, note, [left, legend], Alignment::Left);
    page.0
}

/// A share in few characters, 0 and 100 only where it is that exactly.
pub(super) fn percent(share: f64) -> String {
    let digits = usize::from(share < 9.95);
    let rounded = format!("{share:.digits$}");
    match rounded.as_str() {
        "0.0" if share > 0.0 => "<0.1 %".into(),
        "0.0" => "0 %".into(),
        "100" if share < 100.0 => ">99 %".into(),
        _ => rounded + " %",
    }
}

/// What can be written on.
struct Page(RgbImage);

impl Page {
    fn write(&mut self, font: &MonoFont<'_>, text: &str, [x, y]: [u32; 2], alignment: Alignment) {
        let [red, green, blue] = to_srgb(INK);
        // On paper also where a picture is: none is so dark or bright that letters could not be read.
        let letters = MonoTextStyleBuilder::new()
            .font(font)
            .text_color(Rgb888::new(red, green, blue))
            .background_color(Rgb888::WHITE)
            .build();
        let style: TextStyle = TextStyleBuilder::new().alignment(alignment).baseline(Baseline::Top).build();
        let place = Point::new(x as i32, y as i32);
        let Ok(_) = Text::with_text_style(text, place, letters, style).draw(self);
    }
}

impl OriginDimensions for Page {
    fn size(&self) -> Size {
        Size::new(self.0.width(), self.0.height())
    }
}

impl DrawTarget for Page {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(place, colour) in pixels {
            // What falls beside the page is not seen.
            if let (Ok(x), Ok(y)) = (u32::try_from(place.x), u32::try_from(place.y))
                && let Some(pixel) = self.0.get_pixel_mut_checked(x, y)
            {
                *pixel = Rgb([colour.r(), colour.g(), colour.b()]);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Row, outer, percent, pictures, table};
    use crate::paper::measure::{Count, Each};
    use crate::paper::reading::Reading;
    use crate::paper::shapes::shapes;
    use anyhow::Result;

    #[test]
    fn pictures_differ_where_readings_do() -> Result<()> {
        let ball = &shapes()[1];
        let pictures = pictures(ball, outer(ball)?, 32)?;
        // From outside a sphere every reading is right; so is none for a box.
        assert!(pictures.iter().all(|picture| *picture == pictures[0]));
        let cube = &shapes()[2];
        let pictures = super::pictures(cube, outer(cube)?, 32)?;
        assert!(pictures[1..].iter().all(|picture| *picture != pictures[0]));
        assert_eq!(pictures[0].dimensions(), (16, 16));
        Ok(())
    }

    #[test]
    fn a_table_has_room_for_all() -> Result<()> {
        let ball = &shapes()[1];
        let pictures = pictures(ball, outer(ball)?, 64)?;
        let row = Row {
            name: ball.name,
            pictures: [pictures.clone(), pictures],
            counts: [Each::<Count>::default(); 2],
        };
        let (one, two) = (table(std::slice::from_ref(&row)), table(&[row.clone(), row]));
        assert_eq!(two.height() - one.height(), 32 + super::GAP);
        assert_eq!(one.width(), two.width());
        assert!(one.width() > 2 * 32 * Reading::ALL.len() as u32);
        Ok(())
    }

    #[test]
    fn shares_never_look_better_or_worse_than_they_are() {
        let cases = [
            (0.0, "0 %"),
            (0.01, "<0.1 %"),
            (0.4, "0.4 %"),
            (9.96, "10 %"),
            (99.7, ">99 %"),
            (100.0, "100 %"),
        ];
        for (share, written) in cases {
            assert_eq!(percent(share), written);
        }
    }
}
