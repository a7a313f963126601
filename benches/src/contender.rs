//! The contenders: two methods, each with one ray at a time and with packets.

use crate::arena::Arena;
use crate::frame::Frame;
use gsdf_nostd::{Ray, Span};
use gsdf_simd::{Lanes, MOST_LANES, Packet, Pixel, Records, Renderer, Scene, Work};
use rayon::prelude::*;

/// Who renders.
///
/// All cast one ray through the centre of each pixel, brute force: every leaf at every step. The closed form finds distance, normal and leaf; the marcher is let
/// off with the distance. All work in bands of 16 rows on the threads of the current pool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contender {
    /// Closed form, as many rays at once as the level has lanes: [`Renderer`].
    ClosedPackets,
    /// Closed form, ray by ray: [`Program::along`](gsdf_nostd::Program::along) and `cast`.
    ClosedRays,
    /// Sphere tracing, as many rays at once: [`Packet::trace`].
    TracedPackets,
    /// Sphere tracing, ray by ray: [`SphereTracer::cast`](gsdf_nostd::SphereTracer::cast).
    TracedRays,
}

/// How many rows a thread takes at a time.
const BAND_ROWS: usize = 16;

impl Contender {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::ClosedPackets, Self::ClosedRays, Self::TracedPackets, Self::TracedRays];

    /// Its name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ClosedPackets => "closed form, packets",
            Self::ClosedRays => "closed form, rays",
            Self::TracedPackets => "sphere tracing, packets",
            Self::TracedRays => "sphere tracing, rays",
        }
    }

    /// Whether it marches.
    #[must_use]
    pub const fn is_traced(self) -> bool {
        matches!(self, Self::TracedPackets | Self::TracedRays)
    }

    /// Renders the arena's picture into its part of the frame.
    pub fn render(self, arena: &Arena<'_>, frame: &mut Frame) {
        let width = arena.raster.width() as usize;
        match self {
            Self::ClosedPackets => {
                let scene = Scene::new(arena.program);
                let (width, height) = (arena.raster.width(), arena.raster.height());
                Renderer::at_level(&scene, arena.raster, arena.level).render(Records::new(&mut frame.pixels, width, height));
            }
            Self::ClosedRays => in_bands(
                &mut frame.pixels,
                width,
                || vec![Span::EMPTY; arena.program.leaves()],
                |spans, y, row| closed_rays(arena, spans, y, row),
            ),
            Self::TracedPackets => arena.level.run(TracedPackets {
                arena,
                depths: &mut frame.depths,
            }),
            Self::TracedRays => in_bands(&mut frame.depths, width, || (), |(), y, row| traced_rays(arena, y, row)),
        }
    }
}

/// Renders row by row, in bands like those of [`Renderer`], with something of its own for each thread.
fn in_bands<P: Send, S>(
    plane: &mut [P],
    width: usize,
    own: impl Fn() -> S + Sync + Send,
    row: impl Fn(&mut S, u32, &mut [P]) + Sync + Send,
) {
    let bands = plane.par_chunks_mut(width * BAND_ROWS).enumerate();
    bands.for_each_init(own, |own, (band, pixels)| {
        for (index, pixels) in pixels.chunks_mut(width).enumerate() {
            row(own, (band * BAND_ROWS + index) as u32, pixels);
        }
    });
}

fn closed_rays(arena: &Arena<'_>, spans: &mut [Span<f32>], y: u32, row: &mut [Pixel]) {
    for (x, pixel) in (0..).zip(row) {
        let hit = ray(arena, x, y).and_then(|ray| arena.program.along(ray, spans).ok()?.cast());
        *pixel = hit.map_or(Pixel::NOTHING, |hit| Pixel {
            distance: hit.t,
            normal: hit.normal.into(),
            leaf: hit.leaf,
        });
    }
}

/// A picture to be traced in packets of some width.
struct TracedPackets<'a, 'p> {
    arena: &'a Arena<'p>,
    depths: &'a mut [f32],
}

impl Work for TracedPackets<'_, '_> {
    type Output = ();

    fn run<T: Lanes>(self, token: T::Token) {
        let Self { arena, depths } = self;
        let width = arena.raster.width() as usize;
        in_bands(
            depths,
            width,
            || (),
            |(), y, row| {
                T::vectorize(
                    token,
                    #[inline(always)]
                    || traced_packets::<T>(arena, token, y, row),
                );
            },
        );
    }
}

/// The abscissas of the centres of the first pixels of a row.
const CENTERS: [f32; MOST_LANES] = [0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5];

#[inline(always)]
fn traced_packets<T: Lanes>(arena: &Arena<'_>, token: T::Token, y: u32, row: &mut [f32]) {
    let (zero, infinity) = (T::splat(token, 0.0), T::splat(token, f32::INFINITY));
    let (centers, end) = (T::load(token, &CENTERS), T::splat(token, arena.end));
    let mut left = 0;
    for depths in row.chunks_mut(T::LANES) {
        let x = centers + T::splat(token, left as f32);
        let (origin, direction) = arena.raster.line(x, T::splat(token, y as f32 + 0.5));
        let traced = Packet::from_lanes(origin, direction, zero, end).trace(&arena.tracer, &arena.program);
        T::select(traced.hit, traced.t, infinity).store(depths);
        left += T::LANES;
    }
}

fn traced_rays(arena: &Arena<'_>, y: u32, row: &mut [f32]) {
    for (x, depth) in (0..).zip(row) {
        let traced = ray(arena, x, y)
            .and_then(|ray| ray.within(0.0..arena.end).ok())
            .map(|ray| arena.tracer.cast(&arena.program, &ray));
        *depth = traced.filter(|traced| traced.hit).map_or(f32::INFINITY, |traced| traced.t);
    }
}

fn ray(arena: &Arena<'_>, x: u32, y: u32) -> Option<Ray> {
    arena.raster.ray(x, y).ok()
}

#[cfg(test)]
mod tests {
    use super::Contender;
    use crate::arena::Arena;
    use crate::frame::Frame;
    use anyhow::Result;
    use gsdf_demo::scenes;
    use gsdf_simd::Level;

    #[test]
    fn rays_and_packets_show_the_same_picture_bit_for_bit() -> Result<()> {
        for scene in [scenes::s1(), scenes::s2(), scenes::s3()] {
            // A width that is no multiple of eight, and a last band that is not full.
            let arena = Arena::new(&scene, 37)?.relaxed(1.2);
            let (mut packets, mut rays) = (Frame::new(arena.pixels()), Frame::new(arena.pixels()));
            Contender::ClosedRays.render(&arena, &mut rays);
            Contender::TracedRays.render(&arena, &mut rays);
            for level in Level::available() {
                let arena = arena.at_level(level);
                Contender::ClosedPackets.render(&arena, &mut packets);
                Contender::TracedPackets.render(&arena, &mut packets);
                assert_eq!(packets.pixels, rays.pixels, "{}, {level}", arena.name);
                assert_eq!(packets.depths, rays.depths, "{}, {level}", arena.name);
            }
        }
        Ok(())
    }

    #[test]
    fn the_marcher_is_nearly_right() -> Result<()> {
        let scene = scenes::s2();
        let arena = Arena::new(&scene, 64)?;
        let mut frame = arena.exact();
        Contender::TracedRays.render(&arena, &mut frame);
        let wrong = frame.wrong().total();
        assert!(wrong < 64 * 64 / 100, "{wrong} wrong pixels");
        assert!(arena.end.is_finite());
        Ok(())
    }
}
