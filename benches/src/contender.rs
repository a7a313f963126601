//! The contenders: two methods, each over tiles that see only part of a scene, in packets and one ray at a time.

use crate::arena::Arena;
use crate::frame::Frame;
use crate::scenes::Primitive;
use gsdf_nostd::{Program, Ray, SeenFrom, Span, V3};
use gsdf_simd::{Lanes, MOST_LANES, Packet, Pixel, Renderer, TILE_PIXELS, TILE_SIDE, Visible, Wants, Work};
use rayon::prelude::*;

/// Who renders.
///
/// All cast one ray through the centre of each pixel. The closed form finds distance, normal and leaf, unless it is said to be bare; the marcher is let off with the distance. All
/// work in bands of 16 rows on the threads of the current pool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contender {
    /// Closed form, tile by tile: [`Renderer`].
    ClosedTiles,
    /// The same without normals.
    ClosedTilesBare,
    /// Closed form, as many rays at once as the level has lanes, brute force: every leaf along every ray, with what depends on the eye alone done once per picture.
    ClosedPackets,
    /// Closed form, ray by ray, brute force: [`Program::along`] and `cast`.
    ClosedRays,
    /// Sphere tracing, as many rays at once, over the program of what a tile can see: [`Visible`].
    TracedTiles,
    /// Sphere tracing, as many rays at once, brute force: [`Packet::trace`].
    TracedPackets,
    /// Sphere tracing, ray by ray, brute force: [`SphereTracer::cast`](gsdf_nostd::SphereTracer::cast).
    TracedRays,
}

/// A contender with all it keeps from one picture to the next.
pub type Painter<'a> = Box<dyn FnMut(&mut Frame) + Send + 'a>;

impl Contender {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::ClosedTiles,
        Self::ClosedTilesBare,
        Self::ClosedPackets,
        Self::ClosedRays,
        Self::TracedTiles,
        Self::TracedPackets,
        Self::TracedRays,
    ];

    /// Its name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ClosedTiles => "closed form, tiles",
            Self::ClosedTilesBare => "closed form, tiles, bare",
            Self::ClosedPackets => "closed form, packets",
            Self::ClosedRays => "closed form, rays",
            Self::TracedTiles => "sphere tracing, tiles",
            Self::TracedPackets => "sphere tracing, packets",
            Self::TracedRays => "sphere tracing, rays",
        }
    }

    /// Whether it marches.
    #[must_use]
    pub const fn is_traced(self) -> bool {
        matches!(self, Self::TracedTiles | Self::TracedPackets | Self::TracedRays)
    }

    /// Whether it looks at all leaves along every ray.
    #[must_use]
    pub const fn is_brute(self) -> bool {
        !matches!(self, Self::ClosedTiles | Self::ClosedTilesBare | Self::TracedTiles)
    }

    /// The contender at the start: it fills a frame with the arena's picture as often as it is asked to. Whatever depends on the camera it does anew each time.
    #[must_use]
    pub fn ready<'a>(self, arena: &'a Arena<'_>) -> Painter<'a> {
        let width = arena.raster.width() as usize;
        match self {
            Self::ClosedTiles | Self::ClosedTilesBare => {
                let wants = if self == Self::ClosedTiles {
                    Wants::NORMALS
                } else {
                    Wants::NOTHING_ELSE
                };
                let mut renderer = Renderer::at_level(&arena.prepared, arena.raster, arena.level);
                Box::new(move |frame| {
                    renderer.look(arena.raster);
                    renderer.render(frame.tiles.as_target().wanting(wants));
                })
            }
            Self::ClosedPackets => {
                let mut seen = Vec::with_capacity(arena.program.leaves());
                Box::new(move |frame| {
                    seen.clear();
                    seen.extend(arena.program.seen_from(V3::<f32>::from(arena.camera.eye())));
                    arena.level.run(CastPackets {
                        arena,
                        seen: SeenFrom(&seen),
                        pixels: &mut frame.pixels,
                    });
                })
            }
            Self::ClosedRays => Box::new(move |frame| {
                let spans = || vec![Span::EMPTY; arena.program.leaves()];
                in_bands(&mut frame.pixels, width, spans, |spans, y, row| closed_rays(arena, spans, y, row));
            }),
            Self::TracedTiles => Box::new(move |frame| {
                arena.level.run(TraceTiles {
                    arena,
                    tiles: &mut frame.traced,
                });
            }),
            Self::TracedPackets => Box::new(move |frame| {
                arena.level.run(TracePackets {
                    arena,
                    depths: &mut frame.depths,
                });
            }),
            Self::TracedRays => Box::new(move |frame| in_bands(&mut frame.depths, width, || (), |(), y, row| traced_rays(arena, y, row))),
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
    let bands = plane.par_chunks_mut(width * TILE_SIDE).enumerate();
    bands.for_each_init(own, |own, (band, pixels)| {
        for (index, pixels) in pixels.chunks_mut(width).enumerate() {
            row(own, (band * TILE_SIDE + index) as u32, pixels);
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

/// Where the centres of a packet's pixels are, from the corner of the first one.
struct Places {
    across: [f32; MOST_LANES],
    down: [f32; MOST_LANES],
}

/// Pixels side by side.
const ROW: Places = Places {
    across: [0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5, 7.5, 8.5, 9.5, 10.5, 11.5, 12.5, 13.5, 14.5, 15.5],
    down: [0.5; MOST_LANES],
};

/// Four by four pixels, or four by two: as they follow each other in a tile.
const BLOCK: Places = Places {
    across: [0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5],
    down: [0.5, 0.5, 0.5, 0.5, 1.5, 1.5, 1.5, 1.5, 2.5, 2.5, 2.5, 2.5, 3.5, 3.5, 3.5, 3.5],
};

/// The rays through the pixels from column `left` and row `top` on, up to a parameter.
#[inline(always)]
fn packet<T: Lanes>(token: T::Token, arena: &Arena<'_>, places: &Places, [left, top]: [f32; 2], end: f32) -> Packet<T> {
    let x = T::load(token, &places.across) + T::splat(token, left);
    let y = T::load(token, &places.down) + T::splat(token, top);
    let (origin, direction) = arena.raster.line(x, y);
    Packet::from_lanes(origin, direction, T::splat(token, 0.0), T::splat(token, end))
}

/// A picture to be cast in packets of some width.
struct CastPackets<'a, 'p> {
    arena: &'a Arena<'p>,
    seen: SeenFrom<'a, <Primitive as gsdf_nostd::Solid>::Seen<f32>>,
    pixels: &'a mut [Pixel],
}

impl Work for CastPackets<'_, '_> {
    type Output = ();

    fn run<T: Lanes>(self, token: T::Token) {
        let Self { arena, seen, pixels } = self;
        let nothing = Span::empty_like(T::splat(token, 0.0));
        in_bands(
            pixels,
            arena.raster.width() as usize,
            || vec![nothing; arena.program.leaves()],
            |spans, y, row| {
                T::vectorize(
                    token,
                    #[inline(always)]
                    || cast_row::<T>(token, arena, seen, spans, y, row),
                );
            },
        );
    }
}

#[inline(always)]
fn cast_row<T: Lanes>(
    token: T::Token,
    arena: &Arena<'_>,
    seen: SeenFrom<'_, <Primitive as gsdf_nostd::Solid>::Seen<f32>>,
    spans: &mut [Span<T>],
    y: u32,
    row: &mut [Pixel],
) {
    let zero = T::splat(token, 0.0);
    let mut left = 0;
    for pixels in row.chunks_mut(T::LANES) {
        let packet = packet::<T>(token, arena, &ROW, [left as f32, y as f32], f32::INFINITY);
        left += T::LANES;
        let Ok(hits) = packet.cast_in(&arena.program, seen, spans) else {
            return;
        };
        let (mut distances, mut leaves, mut normals) = ([0.0; MOST_LANES], [0; MOST_LANES], [[0.0; MOST_LANES]; 3]);
        hits.t.store(&mut distances);
        hits.met.leaf.store_numbers(&mut leaves);
        let normal = hits.met.surface.normal;
        for (component, place) in [normal.x, normal.y, normal.z].into_iter().zip(&mut normals) {
            T::select(hits.hit, component, zero).store(place);
        }
        for (lane, pixel) in pixels.iter_mut().enumerate() {
            *pixel = Pixel {
                distance: distances[lane],
                normal: [normals[0][lane], normals[1][lane], normals[2][lane]],
                leaf: leaves[lane],
            };
        }
    }
}

/// Traces a packet and stores its depths: in a function of its own, the only one in which the distances of all solids stand.
#[inline(always)]
fn trace<T: Lanes>(
    token: T::Token,
    arena: &Arena<'_>,
    program: &Program<'_, Primitive>,
    places: &Places,
    corner: [f32; 2],
    depths: &mut [f32],
) {
    T::vectorize(
        token,
        #[inline(always)]
        || {
            let traced = packet::<T>(token, arena, places, corner, arena.end).trace(&arena.tracer, program);
            T::select(traced.hit, traced.t, T::splat(token, f32::INFINITY)).store(depths);
        },
    );
}

/// A picture to be traced in packets of some width.
struct TracePackets<'a, 'p> {
    arena: &'a Arena<'p>,
    depths: &'a mut [f32],
}

impl Work for TracePackets<'_, '_> {
    type Output = ();

    fn run<T: Lanes>(self, token: T::Token) {
        let Self { arena, depths } = self;
        let row = |(): &mut (), y: u32, row: &mut [f32]| {
            for (packet, depths) in row.chunks_mut(T::LANES).enumerate() {
                let corner = [(packet * T::LANES) as f32, y as f32];
                trace::<T>(token, arena, &arena.program, &ROW, corner, depths);
            }
        };
        in_bands(depths, arena.raster.width() as usize, || (), row);
    }
}

/// A picture to be traced in packets of some width, tile by tile.
struct TraceTiles<'a, 'p> {
    arena: &'a Arena<'p>,
    tiles: &'a mut [[f32; TILE_PIXELS]],
}

impl Work for TraceTiles<'_, '_> {
    type Output = ();

    fn run<T: Lanes>(self, token: T::Token) {
        let Self { arena, tiles } = self;
        let columns = (arena.raster.width() as usize).div_ceil(TILE_SIDE);
        let rows = tiles.par_chunks_mut(columns).enumerate();
        rows.for_each_init(Visible::new, |visible, (row, tiles)| {
            for (column, tile) in tiles.iter_mut().enumerate() {
                let corner = [column, row].map(|tile| tile * TILE_SIDE);
                arena
                    .prepared
                    .visible(&arena.raster, corner[0] as u32, corner[1] as u32, TILE_SIDE as u32, visible);
                // Where nothing is visible there is no program.
                let Ok(program) = Program::new(visible.nodes()) else {
                    tile.fill(f32::INFINITY);
                    continue;
                };
                for (packet, depths) in tile.chunks_mut(T::LANES).enumerate() {
                    let [x, y] = within_tile(packet * T::LANES);
                    trace::<T>(
                        token,
                        arena,
                        &program,
                        &BLOCK,
                        [(corner[0] + x) as f32, (corner[1] + y) as f32],
                        depths,
                    );
                }
            }
        });
    }
}

/// Column and row of the pixel that stands in a place of a tile's plane: the inverse of [`Tile::index`](gsdf_simd::Tile::index).
const fn within_tile(index: usize) -> [usize; 2] {
    let (block, within) = (index / 16, index % 16);
    [block % 4 * 4 + within % 4, block / 4 * 4 + within / 4]
}

#[cfg(test)]
mod tests {
    use super::{Contender, within_tile};
    use crate::arena::Arena;
    use crate::frame::Frame;
    use crate::scenes::Scene;
    use anyhow::Result;
    use gsdf_simd::{Level, TILE_PIXELS, Tile};

    #[test]
    fn places_in_tiles_are_those_of_their_index() {
        for index in 0..TILE_PIXELS {
            let [x, y] = within_tile(index);
            assert_eq!(Tile::index(x, y), index);
        }
    }

    #[test]
    fn all_closed_forms_show_the_same_picture_bit_for_bit_and_packets_trace_what_rays_do() -> Result<()> {
        for name in ["s1", "s2", "s3", "s5"] {
            let scene = Scene::by_name(name)?;
            // A width that is no multiple of eight, and a last band that is not full.
            let arena = Arena::new(&scene, if name == "s5" { 19 } else { 37 })?.relaxed(1.2);
            let mut rays = Frame::new(&arena.raster);
            Contender::ClosedRays.ready(&arena)(&mut rays);
            Contender::TracedRays.ready(&arena)(&mut rays);
            for level in Level::available() {
                let arena = arena.at_level(level);
                for contender in [Contender::ClosedTiles, Contender::ClosedPackets] {
                    let mut frame = Frame::new(&arena.raster);
                    contender.ready(&arena)(&mut frame);
                    frame.settle(contender);
                    assert_eq!(frame.pixels, rays.pixels, "{name}, {contender:?}, {level}");
                }
                let mut frame = Frame::new(&arena.raster);
                Contender::TracedPackets.ready(&arena)(&mut frame);
                assert_eq!(frame.depths, rays.depths, "{name}, {level}");
                let bare = Contender::ClosedTilesBare;
                bare.ready(&arena)(&mut frame);
                frame.settle(bare);
                for (found, expected) in frame.pixels.iter().zip(&rays.pixels) {
                    assert_eq!((found.distance, found.leaf), (expected.distance, expected.leaf), "{name}, {level}");
                }
            }
        }
        Ok(())
    }

    #[test]
    fn the_marchers_are_nearly_right() -> Result<()> {
        for (name, size) in [("s2", 64), ("s3", 64), ("s5", 64), ("s6-10", 48), ("s7", 64)] {
            let scene = Scene::by_name(name)?;
            let arena = Arena::new(&scene, size)?;
            assert!(arena.end.is_finite());
            for level in Level::available() {
                let arena = arena.at_level(level);
                let mut frame = arena.exact();
                Contender::TracedTiles.ready(&arena)(&mut frame);
                frame.settle(Contender::TracedTiles);
                let wrong = frame.wrong().total();
                assert!(wrong < arena.pixels() as u64 / 50, "{name}, {level}: {wrong} wrong pixels");
            }
        }
        Ok(())
    }
}
