//! Whole images against one scalar query per pixel, bit for bit: every size, layout, camera, level and number of threads.

use core::slice::ChunksMut;
use glam::{Mat3, Vec3, vec3};
use gsdf_demo::scenes;
use gsdf_nostd::{Camera, Csg, Leaf, Node, Program, Raster, Span, Transform};
use gsdf_simd::{Band, Canvas, F32x8, Hits, Image, LaneMask, Lanes, Level, Mask8, Packet, Pixel, Planes, Tally};
use rayon::ThreadPoolBuilder;

const SIZES: [(u32, u32); 7] = [(1, 1), (7, 3), (8, 8), (9, 17), (33, 20), (3, 50), (64, 1)];

/// What no image writes.
const UNTOUCHED: f32 = -77.0;

fn cameras() -> [Camera; 2] {
    let eye = vec3(2.5, 2.2, -3.5);
    [
        Camera::pinhole(eye, Vec3::ZERO, Vec3::Y, 0.36).unwrap(),
        Camera::orthographic(eye, Vec3::ZERO, Vec3::Y, 1.6).unwrap(),
    ]
}

/// A part in the world and one in a turned frame.
fn nodes() -> Vec<Node> {
    let part = scenes::PART;
    let posed = part.nodes().iter().map(|node| match node {
        Node::Leaf { solid, .. } => Node::Leaf { solid: *solid, frame: 1 },
        other => *other,
    });
    part.nodes().iter().copied().chain(posed).chain([Node::Union]).collect()
}

/// A program and every camera's picture of it in every size, at every level.
fn for_pictures(check: impl Fn(&Program<'_>, &Raster, Level)) {
    let nodes = nodes();
    let turn = Mat3::from_axis_angle(vec3(0.6, 0.0, 0.8), 0.7);
    let poses = [Transform::affine(turn * 0.5, vec3(0.2, 0.9, 0.1)).unwrap()];
    let program = Program::new(&nodes).unwrap().posed(&poses).unwrap();
    for raster in cameras()
        .iter()
        .flat_map(|camera| SIZES.map(|(width, height)| camera.raster(width, height)))
    {
        for level in Level::available() {
            check(&program, &raster, level);
        }
    }
}

fn scalar(program: &Program<'_>, raster: &Raster) -> Vec<Pixel> {
    let mut spans = vec![Span::EMPTY; program.leaves()];
    let places = (0..raster.height()).flat_map(|y| (0..raster.width()).map(move |x| (x, y)));
    let mut pixel = |(x, y)| {
        let hit = program.along(raster.ray(x, y).unwrap(), &mut spans).unwrap().cast();
        hit.map_or(Pixel::NOTHING, |hit| Pixel {
            distance: hit.t,
            normal: hit.normal.to_array(),
            leaf: hit.leaf,
        })
    };
    places.map(&mut pixel).collect()
}

fn bits(pixel: &Pixel) -> [u32; 5] {
    let [x, y, z] = pixel.normal.map(f32::to_bits);
    [pixel.distance.to_bits(), x, y, z, pixel.leaf]
}

fn assert_same(found: &[Pixel], expected: &[Pixel], raster: &Raster) {
    let (found, expected): (Vec<_>, Vec<_>) = (found.iter().map(bits).collect(), expected.iter().map(bits).collect());
    let first = found.iter().zip(&expected).position(|(found, expected)| found != expected);
    let place = first.map(|index| (index as u32 % raster.width(), index as u32 / raster.width()));
    assert_eq!(
        (found.len(), place),
        (expected.len(), None),
        "the first pixel that differs, of {raster:?}"
    );
}

fn on_threads<R: Send>(threads: usize, render: impl FnOnce() -> R + Send) -> R {
    ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(render)
}

#[test]
fn records_are_the_scalar_pixels_on_any_number_of_threads() {
    for_pictures(|program, raster, level| {
        let expected = scalar(program, raster);
        let hits = expected.iter().filter(|pixel| pixel.leaf != Pixel::NO_LEAF).count();
        assert!(
            raster.width() < 8 || raster.height() < 8 || hits * 4 > expected.len(),
            "the camera looks past it"
        );
        for threads in 1..=3 {
            let mut pixels = vec![
                Pixel {
                    distance: UNTOUCHED,
                    ..Pixel::NOTHING
                };
                expected.len()
            ];
            let tally = on_threads(threads, || Image::new(*program, *raster).at_level(level).render(&mut pixels[..]));
            assert_same(&pixels, &expected, raster);
            assert_eq!(
                (tally.hits, tally.packets),
                (
                    hits as u64,
                    u64::from(raster.width().div_ceil(level.lanes() as u32) * raster.height())
                )
            );
            assert!(u64::from(tally.most_sweeps) <= tally.sweeps && tally.most_sweeps as usize <= program.max_sweeps());
        }
    });
}

/// Planes as long as `height` rows of `stride`, untouched.
fn plane(raster: &Raster, stride: usize) -> Vec<f32> {
    vec![UNTOUCHED; stride * raster.height() as usize]
}

#[test]
fn planes_are_the_same_pixels_and_nothing_between_rows_is_touched() {
    for_pictures(|program, raster, level| {
        let expected = scalar(program, raster);
        let width = raster.width() as usize;
        for (stride, threads) in [(width, 1), (width + 1, 2), (width + 13, 3)] {
            let mut distance = plane(raster, stride);
            let (mut x, mut y, mut z) = (distance.clone(), distance.clone(), distance.clone());
            let mut leaf = vec![4_000_000_000; distance.len()];
            let mut planes = Planes {
                distance: &mut distance,
                normal: Some([&mut x, &mut y, &mut z]),
                leaf: Some(&mut leaf),
                stride,
            };
            on_threads(threads, || Image::new(*program, *raster).at_level(level).render(&mut planes));
            for row in 0..raster.height() as usize {
                let place = |x: usize| row * stride + x;
                let pixel = |column: usize| Pixel {
                    distance: distance[place(column)],
                    normal: [x[place(column)], y[place(column)], z[place(column)]],
                    leaf: leaf[place(column)],
                };
                let found: Vec<_> = (0..width).map(pixel).collect();
                assert_same(&found, &expected[row * width..][..width], raster);
                for gap in place(width)..place(stride) {
                    assert_eq!(
                        [distance[gap], x[gap], y[gap], z[gap]],
                        [UNTOUCHED; 4],
                        "row {row}, stride {stride}"
                    );
                    assert_eq!(leaf[gap], 4_000_000_000, "row {row}, stride {stride}");
                }
            }
        }
    });
}

#[test]
fn planes_that_are_not_wanted_are_left_out() {
    for_pictures(|program, raster, level| {
        let expected = scalar(program, raster);
        let stride = raster.width() as usize;
        let image = Image::new(*program, *raster).at_level(level);
        let mut distance = plane(raster, stride);
        let (normal, leaf) = (None, None);
        image.render(&mut Planes {
            distance: &mut distance,
            normal,
            leaf,
            stride,
        });
        assert!(
            distance
                .iter()
                .zip(&expected)
                .all(|(found, pixel)| found.to_bits() == pixel.distance.to_bits())
        );

        let (mut distance, mut leaf) = (plane(raster, stride), vec![0; expected.len()]);
        image.render(&mut Planes {
            distance: &mut distance,
            normal: None,
            leaf: Some(&mut leaf),
            stride,
        });
        assert!(leaf.iter().zip(&expected).all(|(found, pixel)| *found == pixel.leaf));

        let (mut distance, mut x, mut y, mut z) = (
            plane(raster, stride),
            plane(raster, stride),
            plane(raster, stride),
            plane(raster, stride),
        );
        image.render(&mut Planes {
            distance: &mut distance,
            normal: Some([&mut x, &mut y, &mut z]),
            leaf: None,
            stride,
        });
        assert!((0..expected.len()).all(|index| [x[index], y[index], z[index]] == expected[index].normal));
    });
}

/// A frame buffer of a user's: one byte per pixel, the leaf's number plus one, rows of 40 bytes of which the first two
/// are someone else's.
struct Screen(Vec<u8>);

struct ScreenBand<'b>(&'b mut [u8]);

impl Screen {
    const STRIDE: usize = 80;
    const MARGIN: usize = 2;
}

impl Canvas for Screen {
    type Band<'b> = ScreenBand<'b>;

    fn bands(&mut self, _: u32, rows: u32) -> Vec<ScreenBand<'_>> {
        let chunks: ChunksMut<'_, u8> = self.0.chunks_mut(Self::STRIDE * rows as usize);
        chunks.map(ScreenBand).collect()
    }
}

impl Band for ScreenBand<'_> {
    fn put<T: Lanes>(&mut self, x: u32, y: u32, count: usize, hits: &Hits<T>) {
        let start = y as usize * Screen::STRIDE + Screen::MARGIN + x as usize;
        let (leaves, shown) = (hits.met.leaf.to_array(), hits.hit.to_bits());
        for (lane, byte) in self.0[start..start + count].iter_mut().enumerate() {
            *byte = if shown >> lane & 1 == 1 {
                leaves.as_ref()[lane] as u8 + 1
            } else {
                0
            };
        }
    }
}

#[test]
fn a_canvas_of_ones_own_gets_every_pixel_once() {
    for_pictures(|program, raster, level| {
        let expected = scalar(program, raster);
        for threads in [1, 3] {
            let mut screen = Screen(vec![99; Screen::STRIDE * raster.height() as usize]);
            on_threads(threads, || Image::new(*program, *raster).at_level(level).render(&mut screen));
            for (row, bytes) in screen.0.chunks(Screen::STRIDE).enumerate() {
                let width = raster.width() as usize;
                let shown = expected[row * width..][..width]
                    .iter()
                    .map(|pixel| pixel.leaf.wrapping_add(1) as u8);
                let margin = |count: usize| core::iter::repeat_n(99, count);
                let whole: Vec<u8> = margin(Screen::MARGIN)
                    .chain(shown)
                    .chain(margin(Screen::STRIDE - Screen::MARGIN - width))
                    .collect();
                assert_eq!(bytes, whole, "row {row} of {raster:?}");
            }
        }
    });
}

/// A canvas that is too small gets what it has room for, one that is too large keeps the rest, and no size is too
/// small.
#[test]
fn no_canvas_is_written_beyond_image_or_end() {
    let nodes = nodes();
    let poses = [Transform::IDENTITY];
    let program = Program::new(&nodes).unwrap().posed(&poses).unwrap();
    let raster = cameras()[0].raster(21, 35);
    let expected = scalar(&program, &raster);
    for room in [0, 1, 20, 21, 22, 21 * 16, 21 * 16 + 5, 21 * 35 - 1, 21 * 35, 21 * 35 + 1, 21 * 40] {
        let untouched = Pixel {
            distance: UNTOUCHED,
            ..Pixel::NOTHING
        };
        let mut pixels = vec![untouched; room];
        Image::new(program, raster).render(&mut pixels[..]);
        let held = room.min(expected.len());
        assert_same(&pixels[..held], &expected[..held], &raster);
        assert!(pixels[held..].iter().all(|pixel| *pixel == untouched), "room for {room}");
    }
    for (width, height) in [(0, 0), (0, 5), (5, 0)] {
        let tally = Image::new(program, cameras()[1].raster(width, height)).render(&mut [Pixel::NOTHING; 9][..]);
        assert_eq!(tally, Tally::default());
    }
}

/// An image is rendered at the widest level, unless told otherwise; it says which.
#[test]
fn the_level_can_be_read_and_forced() {
    let image = || Image::new(scenes::PART.program(), cameras()[0].raster(8, 8));
    assert_eq!(image().level(), Level::best());
    for level in Level::available() {
        assert_eq!(image().at_level(level).level(), level);
    }
}

/// Everything a thread may want to take along or share.
#[test]
fn public_types_are_send_and_sync() {
    fn check<T: Send + Sync>() {}
    check::<(F32x8, Mask8, Packet, Hits, Pixel, Tally, Level)>();
    check::<(
        Image<'_, Leaf>,
        Planes<'_>,
        Program<'_>,
        Csg<9>,
        Raster,
        Camera,
        Transform,
        Span<F32x8>,
    )>();
}
