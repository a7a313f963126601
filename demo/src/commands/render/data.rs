//! Pictures that are data: 16 bits for each number, and 0 where a ray hits nothing.

use crate::commands::size::Size;
use crate::commands::tier::{Alone, Tier};
use crate::frame::{Frame, Met};
use anyhow::{Result, bail};
use gsdf_nostd::{Program, Raster};
use gsdf_trade::Primitive;
use image::{ImageBuffer, Luma, Pixel, Rgb};
use rayon::prelude::*;

/// A picture with numbers of 16 bits.
type Picture<P> = ImageBuffer<P, Vec<u16>>;

/// The largest number.
const MOST: f32 = 65_535.0;

/// The least and the greatest distance that is seen; `None` where nothing is.
#[must_use]
pub fn depths(frame: &Frame, height: u32) -> Option<[f32; 2]> {
    let seen = (0..height).flat_map(|y| frame.row(y)).flatten().map(|met| [met.t, met.t]);
    seen.reduce(|[near, far], [t, _]| [near.min(t), far.max(t)])
}

/// Distances, from 1 at the least to 65535 at the greatest: `near + (number - 1) / 65534 * (far - near)` of the number.
#[must_use]
pub fn depth(frame: &Frame, size: Size, depths: Option<[f32; 2]>) -> Picture<Luma<u16>> {
    let [near, far] = depths.unwrap_or([0.0, 1.0]);
    let extent = if far > near { far - near } else { 1.0 };
    picture(frame, size, |met| {
        Luma([(1.0 + (met.t - near) / extent * (MOST - 1.0)).round() as u16])
    })
}

/// Normals, each coordinate from 0 at -1 to 65535 at 1.
#[must_use]
pub fn normal(frame: &Frame, size: Size) -> Picture<Rgb<u16>> {
    picture(frame, size, |met| {
        Rgb(met.normal.to_array().map(|part| (0.5 * (part + 1.0) * MOST).round() as u16))
    })
}

/// Numbers of leaves, from 1.
///
/// # Errors
/// Where there are more of them than numbers.
pub fn id(frame: &Frame, size: Size, leaves: usize) -> Result<Picture<Luma<u16>>> {
    if leaves >= usize::from(u16::MAX) {
        bail!("the model has {leaves} leaves: 16 bits tell no more than 65534 of them apart");
    }
    // Checked above.
    Ok(picture(frame, size, |met| Luma([met.leaf as u16 + 1])))
}

/// The sweeps that every ray takes in a tier, and what to do with each finished row.
#[must_use]
pub fn sweeps(program: Program<'_, Primitive>, raster: Raster, tier: Tier, row_done: impl Fn(u64) + Sync) -> Picture<Luma<u16>> {
    let mut image = Picture::new(raster.width(), raster.height());
    image
        .par_chunks_mut(raster.width().max(1) as usize)
        .zip(0..raster.height())
        .for_each_init(
            || Alone::new(program, tier),
            |alone, (row, y)| {
                for (pixel, x) in row.iter_mut().zip(0..) {
                    let taken = raster.ray(x, y).map_or(0, |ray| alone.sweeps(&ray));
                    *pixel = u16::try_from(taken).unwrap_or(u16::MAX);
                }
                row_done(1);
            },
        );
    image
}

fn picture<P: Pixel<Subpixel = u16>>(frame: &Frame, size: Size, number: impl Fn(&Met) -> P) -> Picture<P> {
    let mut image = Picture::new(size.width, size.height);
    for (y, row) in image.rows_mut().enumerate() {
        for (pixel, met) in row.zip(frame.row(y as u32)) {
            if let Some(met) = met {
                *pixel = number(met);
            }
        }
    }
    image
}
