//! The contact sheet: all pictures of a gallery on one.

use crate::palette::{from_srgb, to_srgb};
use glam::Vec3;
use image::{Rgb, RgbImage, imageops};

/// How many pictures stand side by side.
const COLUMNS: u32 = 4;
/// How far the pictures are apart, in pixels, and what shows there.
const GAP: u32 = 4;
pub(crate) const PAPER: Rgb<u8> = Rgb([255; 3]);

/// Pictures of one size, halved and side by side, row by row.
#[must_use]
pub fn sheet(pictures: &[RgbImage]) -> RgbImage {
    side_by_side(&pictures.iter().map(halved).collect::<Vec<_>>())
}

/// Pictures of one size, as they are, side by side, row by row.
#[must_use]
pub fn side_by_side(pictures: &[RgbImage]) -> RgbImage {
    let count = pictures.len() as u32;
    let columns = COLUMNS.min(count);
    let (width, height) = pictures.first().map_or((0, 0), RgbImage::dimensions);
    let extent = |cells: u32, size: u32| (cells * (size + GAP)).saturating_sub(GAP);
    let mut sheet = RgbImage::from_pixel(extent(columns, width), extent(count.div_ceil(COLUMNS), height), PAPER);
    for (picture, number) in pictures.iter().zip(0..) {
        let (column, row) = (number % COLUMNS, number / COLUMNS);
        imageops::replace(
            &mut sheet,
            picture,
            i64::from(column * (width + GAP)),
            i64::from(row * (height + GAP)),
        );
    }
    sheet
}

/// A picture half as wide and half as high, each pixel the mean of the light of four.
#[must_use]
pub fn halved(picture: &RgbImage) -> RgbImage {
    let (width, height) = picture.dimensions();
    RgbImage::from_fn(width.div_ceil(2), height.div_ceil(2), |x, y| {
        let light = |right: u32, down: u32| {
            let pixel = picture.get_pixel((2 * x + right).min(width - 1), (2 * y + down).min(height - 1));
            from_srgb(pixel.0)
        };
        let sum: Vec3 = [light(0, 0), light(1, 0), light(0, 1), light(1, 1)].into_iter().sum();
        Rgb(to_srgb(sum / 4.0))
    })
}

#[cfg(test)]
mod tests {
    use super::{GAP, sheet};
    use image::{Rgb, RgbImage};

    #[test]
    fn pictures_stand_in_rows_with_gaps() {
        let pictures: Vec<_> = (0..6).map(|shade| RgbImage::from_pixel(8, 8, Rgb([40 * shade; 3]))).collect();
        let sheet = sheet(&pictures);
        assert_eq!(sheet.dimensions(), (4 * 4 + 3 * GAP, 2 * 4 + GAP));
        assert_eq!(sheet.get_pixel(4 + GAP, 0).0, [40; 3]);
        assert_eq!(sheet.get_pixel(4, 0).0, [255; 3]);
        assert_eq!(sheet.get_pixel(4 + GAP, 4 + GAP).0, [200; 3]);
        assert_eq!(sheet.get_pixel(3 * (4 + GAP), 4 + GAP).0, [255; 3]);
    }

    #[test]
    fn light_is_averaged_and_not_its_numbers() {
        let checks = RgbImage::from_fn(2, 2, |x, y| Rgb([if x == y { 255 } else { 0 }; 3]));
        assert_eq!(sheet(&[checks]).get_pixel(0, 0).0, [188; 3]);
    }

    #[test]
    fn any_number_of_pictures_of_any_size_makes_a_sheet() {
        assert_eq!(sheet(&[]).dimensions(), (0, 0));
        assert_eq!(sheet(&[RgbImage::new(1, 1)]).dimensions(), (1, 1));
    }
}
