//! Whole images, on all cores.

use crate::lanes::{LaneMask, Lanes, MOST_LANES};
use crate::level::{Level, Work};
use crate::packet::{Hits, Packet};
use core::ops::Range;
use gsdf_nostd::{Anywhere, Footing, Program, Projection, Raster, SeenFrom, Solid, Span, V3};
use rayon::prelude::*;

/// How many rows a thread takes at a time.
const BAND_ROWS: u32 = 16;

/// An image to be: a program seen through a camera's raster, of any width and height.
#[derive(Debug)]
pub struct Image<'a, L> {
    program: Program<'a, L>,
    raster: Raster,
    level: Level,
}

/// One pixel as a record of 20 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Pixel {
    /// The parameter of the ray: depth, for the cameras of `gsdf_nostd`. Infinite where it hits nothing.
    pub distance: f32,
    /// The unit normal, outward from the program; zero where the ray hits nothing.
    pub normal: [f32; 3],
    /// The number of the leaf; [`Pixel::NO_LEAF`] where the ray hits nothing.
    pub leaf: u32,
}

impl Pixel {
    /// The leaf of a pixel that shows nothing.
    pub const NO_LEAF: u32 = u32::MAX;

    /// A pixel that shows nothing.
    pub const NOTHING: Self = Self {
        distance: f32::INFINITY,
        normal: [0.0; 3],
        leaf: Self::NO_LEAF,
    };
}

/// What an image took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// The pixels that show something.
    pub hits: u64,
    /// The packets cast.
    pub packets: u64,
    /// The sweeps over the program that they took, each in its slowest lane.
    pub sweeps: u64,
    /// The sweeps of the packet that took the most.
    pub most_sweeps: u32,
}

impl Tally {
    /// This and another one, of other pixels.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            hits: self.hits + other.hits,
            packets: self.packets + other.packets,
            sweeps: self.sweeps + other.sweeps,
            most_sweeps: self.most_sweeps.max(other.most_sweeps),
        }
    }
}

/// Where the pixels of an image go, in a layout of its own.
///
/// Implemented here by [`Planes`] and by slices of [`Pixel`]s; implement it for a frame buffer of yours.
pub trait Canvas {
    /// A horizontal part of the canvas, which one thread fills.
    type Band<'b>: Band + Send
    where
        Self: 'b;

    /// Cuts the canvas, which is `width` pixels wide, into bands of `rows` rows, from the top. The last may be lower.
    fn bands(&mut self, width: u32, rows: u32) -> Vec<Self::Band<'_>>;
}

/// A horizontal part of a [`Canvas`].
pub trait Band {
    /// Takes the first `count` lanes: the pixels from `x` on in row `y` of the band.
    ///
    /// Runs in the midst of what is compiled for the lanes' instructions, if it is `#[inline(always)]`.
    fn put<T: Lanes>(&mut self, x: u32, y: u32, count: usize, hits: &Hits<T>);
}

impl<'a, L: Solid + Sync> Image<'a, L> {
    /// The image of a program, rendered at the [best level](Level::best) of this machine.
    #[must_use]
    pub fn new(program: Program<'a, L>, raster: Raster) -> Self {
        Self {
            program,
            raster,
            level: Level::best(),
        }
    }

    /// The same image rendered at another level; its pixels are the same.
    #[must_use]
    pub fn at_level(self, level: Level) -> Self {
        Self { level, ..self }
    }

    /// The level at which it is rendered.
    #[must_use]
    pub fn level(&self) -> Level {
        self.level
    }

    /// Casts a ray through the centre of every pixel, on the threads of the current `rayon` pool. The pixels do not
    /// depend on their number.
    pub fn render<C: Canvas + ?Sized>(&self, canvas: &mut C) -> Tally
    where
        L::Seen<f32>: Send + Sync,
    {
        self.level.run(Rendering { image: self, canvas })
    }

    /// What depends on the origin alone, if all rays share it: once per image.
    fn seen(&self) -> Option<Vec<L::Seen<f32>>> {
        let eye = V3::from(self.raster.camera().eye());
        let shared = self.raster.camera().projection() == Projection::Pinhole;
        shared.then(|| self.program.seen_from(eye).collect())
    }

    /// Renders rows of pixels, with scratch memory for the spans of one packet.
    #[inline(always)]
    fn render_rows<T: Lanes, F: Footing<L, T>, B: Band>(
        &self,
        token: T::Token,
        rows: Range<u32>,
        footing: F,
        spans: &mut [Span<T>],
        band: &mut B,
    ) -> Tally {
        let mut tally = Tally::default();
        let width = self.raster.width();
        let places = T::load(token, &CENTERS);
        for y in rows.clone() {
            let mut x = 0;
            while x < width {
                let packet = Packet::through(&self.raster, places + T::splat(token, x as f32), T::splat(token, y as f32 + 0.5));
                let hits = packet.cast_in(&self.program, footing, spans);
                let count = (width - x).min(T::LANES as u32);
                band.put(x, y - rows.start, count as usize, &hits);
                tally = tally.joined(Tally {
                    hits: u64::from((hits.hit.to_bits() & ((1 << count) - 1)).count_ones()),
                    packets: 1,
                    sweeps: u64::from(hits.sweeps),
                    most_sweeps: hits.sweeps,
                });
                x += count;
            }
        }
        tally
    }
}

/// The abscissas of the centres of the first pixels of a row.
const CENTERS: [f32; MOST_LANES] = [0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5];

/// An image on its way to a canvas.
struct Rendering<'i, 'a, L, C: ?Sized> {
    image: &'i Image<'a, L>,
    canvas: &'i mut C,
}

impl<L: Solid + Sync, C: Canvas + ?Sized> Work for Rendering<'_, '_, L, C>
where
    L::Seen<f32>: Send + Sync,
{
    type Output = Tally;

    fn run<T: Lanes>(self, token: T::Token) -> Tally {
        let Self { image, canvas } = self;
        let (width, height) = (image.raster.width(), image.raster.height());
        let seen = image.seen();
        let bands = canvas.bands(width, BAND_ROWS);
        bands
            .into_par_iter()
            .zip((0..height).into_par_iter().step_by(BAND_ROWS as usize))
            .map_init(
                || vec![Span::empty_like(T::splat(token, 0.0)); image.program.leaves()],
                |spans, (mut band, top)| {
                    let rows = top..(top + BAND_ROWS).min(height);
                    match &seen {
                        Some(seen) => T::vectorize(
                            token,
                            #[inline(always)]
                            || image.render_rows(token, rows, SeenFrom(seen), spans, &mut band),
                        ),
                        None => T::vectorize(
                            token,
                            #[inline(always)]
                            || image.render_rows(token, rows, Anywhere, spans, &mut band),
                        ),
                    }
                },
            )
            .reduce(Tally::default, Tally::joined)
    }
}

impl Canvas for [Pixel] {
    type Band<'b> = PixelBand<'b>;

    fn bands(&mut self, width: u32, rows: u32) -> Vec<PixelBand<'_>> {
        let width = width.max(1) as usize;
        (self.chunks_mut(width * rows as usize))
            .map(|pixels| PixelBand { pixels, width })
            .collect()
    }
}

/// Rows of records.
#[derive(Debug)]
pub struct PixelBand<'b> {
    pixels: &'b mut [Pixel],
    width: usize,
}

impl Band for PixelBand<'_> {
    #[inline(always)]
    fn put<T: Lanes>(&mut self, x: u32, y: u32, count: usize, hits: &Hits<T>) {
        let start = y as usize * self.width + x as usize;
        let normal = hits.met.surface.normal;
        let [distance, nx, ny, nz, leaf] = [hits.t, normal.x, normal.y, normal.z, hits.met.leaf].map(T::to_array);
        let lanes = (distance.as_ref().iter())
            .zip(nx.as_ref())
            .zip(ny.as_ref())
            .zip(nz.as_ref())
            .zip(leaf.as_ref());
        let bits = hits.hit.to_bits();
        for ((lane, pixel), ((((distance, nx), ny), nz), leaf)) in (self.pixels.iter_mut().skip(start).take(count).enumerate()).zip(lanes) {
            *pixel = if bits >> lane & 1 == 1 {
                Pixel {
                    distance: *distance,
                    normal: [*nx, *ny, *nz],
                    leaf: *leaf as u32,
                }
            } else {
                Pixel::NOTHING
            };
        }
    }
}

/// Planes of the caller's, row by row, each row `stride` numbers long; those that are not wanted are left out.
#[derive(Debug)]
pub struct Planes<'p> {
    /// The parameters of the rays, infinite where they hit nothing.
    pub distance: &'p mut [f32],
    /// The components of the normals, zero where a ray hits nothing.
    pub normal: Option<[&'p mut [f32]; 3]>,
    /// The numbers of the leaves, [`Pixel::NO_LEAF`] where a ray hits nothing.
    pub leaf: Option<&'p mut [u32]>,
    /// How far the rows are apart; at least the width of the image.
    pub stride: usize,
    /// The width of the image.
    pub width: u32,
}

impl Canvas for Planes<'_> {
    type Band<'b>
        = Planes<'b>
    where
        Self: 'b;

    fn bands(&mut self, _: u32, rows: u32) -> Vec<Planes<'_>> {
        let stride = self.stride.max(1);
        let length = stride * rows as usize;
        let mut normal = (self.normal.as_mut()).map(|planes| planes.each_mut().map(|plane| plane.chunks_mut(length)));
        let mut leaf = self.leaf.as_mut().map(|plane| plane.chunks_mut(length));
        let mut next_normal = || {
            let [x, y, z] = normal.as_mut()?;
            Some([x.next()?, y.next()?, z.next()?])
        };
        (self.distance.chunks_mut(length))
            .map(|distance| Planes {
                distance,
                normal: next_normal(),
                leaf: leaf.as_mut().and_then(Iterator::next),
                stride,
                width: self.width,
            })
            .collect()
    }
}

impl Band for Planes<'_> {
    #[inline(always)]
    fn put<T: Lanes>(&mut self, x: u32, y: u32, count: usize, hits: &Hits<T>) {
        let start = y as usize * self.stride + x as usize;
        let zero = hits.t.splat_like(0.0);
        hits.t.store(part(self.distance, start, count));
        if let Some([x, y, z]) = &mut self.normal {
            let shown = V3::select(hits.hit, hits.met.surface.normal, V3::new(zero, zero, zero));
            shown.x.store(part(x, start, count));
            shown.y.store(part(y, start, count));
            shown.z.store(part(z, start, count));
        }
        if let Some(leaf) = &mut self.leaf {
            let bits = hits.hit.to_bits();
            let numbers = hits.met.leaf.to_array();
            for ((lane, place), number) in part(leaf, start, count).iter_mut().enumerate().zip(numbers.as_ref()) {
                *place = if bits >> lane & 1 == 1 { *number as u32 } else { Pixel::NO_LEAF };
            }
        }
    }
}

/// The places of some lanes, as far as the plane reaches.
#[inline(always)]
fn part<N>(plane: &mut [N], start: usize, count: usize) -> &mut [N] {
    let end = plane.len().min(start + count);
    plane.get_mut(start..end).unwrap_or_default()
}
