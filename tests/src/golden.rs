//! One number for a whole picture: a hash over the bits of every pixel, for pictures that must never change.

use crate::tiles::{cut, parts};
use gsdf_nostd::{Anywhere, Lane, Program, Raster, RayError, Span, V3, march};
use gsdf_simd::Pixel;
use gsdf_workload::digest::Digest;

/// The side of the tiles a scalar picture is cut into.
const TILE: u32 = 16;

/// The [`Digest`] of distance, normal and leaf of every pixel, in the order of the rows.
#[must_use]
pub fn hash(pixels: &[Pixel]) -> u64 {
    let mut digest = Digest::new();
    for pixel in pixels {
        digest.hit(pixel.distance, pixel.normal, pixel.leaf);
    }
    digest.finish()
}

/// A picture of a program in the world, cast ray by ray through the scalar query; each tile with the part of the
/// program that it sees, which changes no pixel and makes large scenes affordable.
///
/// # Panics
/// Where the program is none, or its leaves are posed.
///
/// # Errors
/// Where the camera's rays are none.
pub fn scalar_picture(program: &Program<'_>, raster: &Raster) -> Result<Vec<Pixel>, RayError> {
    picture(program, raster, |program, raster, x, y| {
        let mut scratch = vec![Span::EMPTY; program.leaves()];
        let sight = program
            .along(raster.ray(x, y)?, &mut scratch)
            .expect("there is a span for every leaf");
        let pixel = |hit: gsdf_nostd::Hit| Pixel {
            distance: hit.t,
            normal: hit.normal.to_array(),
            leaf: hit.leaf,
        };
        Ok(sight.cast().map_or(Pixel::NOTHING, pixel))
    })
}

/// The same picture in the arithmetic of `like`, put together from the three stages of a query; the rays are those of
/// the scalar picture.
///
/// # Panics
/// As [`scalar_picture`].
///
/// # Errors
/// Where the camera's rays are none.
pub fn staged_picture<T: Lane>(program: &Program<'_>, raster: &Raster, like: T) -> Result<Vec<Pixel>, RayError> {
    picture(program, raster, |program, raster, x, y| {
        let ray = raster.ray(x, y)?;
        let line = ray.line(like);
        let mut spans = vec![Span::empty_like(like); program.leaves()];
        program.spans_along(&line, Anywhere, &mut spans);
        let t = march(program.nodes(), &spans, like.splat_like(0.0)).t;
        if t.to_f32() == f32::INFINITY {
            return Ok(Pixel::NOTHING);
        }
        let met = program.surface_at(&line, Anywhere, &spans, t);
        let V3 { x, y, z } = met.surface.normal;
        Ok(Pixel {
            distance: ray.parameter_of(t).to_f32(),
            normal: [x, y, z].map(Lane::to_f32),
            leaf: met.leaf.to_index(),
        })
    })
}

/// A picture, pixel by pixel, tile by tile.
fn picture(
    program: &Program<'_>,
    raster: &Raster,
    cast: impl Fn(&Program<'_>, &Raster, u32, u32) -> Result<Pixel, RayError>,
) -> Result<Vec<Pixel>, RayError> {
    let (width, height) = (raster.width(), raster.height());
    let parts = parts(program.nodes());
    let mut pixels = vec![Pixel::NOTHING; width as usize * height as usize];
    for (top, left) in (0..height)
        .step_by(TILE as usize)
        .flat_map(|top| (0..width).step_by(TILE as usize).map(move |left| (top, left)))
    {
        let (right, bottom) = ((left + TILE).min(width), (top + TILE).min(height));
        let cut = cut(&parts, raster, (left, top), (right, bottom))?;
        if cut.nodes.is_empty() {
            continue;
        }
        let seen = Program::new(&cut.nodes).expect("parts of a program make a program");
        for (y, x) in (top..bottom).flat_map(|y| (left..right).map(move |x| (y, x))) {
            let found = cast(&seen, raster, x, y)?;
            let leaf = cut.leaves.get(found.leaf as usize).copied().unwrap_or(Pixel::NO_LEAF);
            pixels[y as usize * width as usize + x as usize] = Pixel { leaf, ..found };
        }
    }
    Ok(pixels)
}
