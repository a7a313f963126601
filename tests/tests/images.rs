//! Whole images against one scalar query per pixel, bit for bit: every size, layout, camera, level and number of threads.

use glam::{Mat3, Vec3, vec3};
use gsdf_demo::scenes;
use gsdf_nostd::{Camera, Csg, Leaf, Node, Program, Raster, Span, Transform};
use gsdf_simd::{
    Effort, F32x8, Hits, Level, Mask8, Packet, Pixel, Planes, Records, Renderer, Scene, TILE_SIDE, Target, Tile, Tiles, Wants,
};
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
        let scene = Scene::new(*program);
        for threads in 1..=3 {
            let mut pixels = vec![
                Pixel {
                    distance: UNTOUCHED,
                    ..Pixel::NOTHING
                };
                expected.len()
            ];
            let mut renderer = Renderer::at_level(&scene, *raster, level);
            let effort = on_threads(threads, || {
                renderer.render(Records::new(&mut pixels, raster.width(), raster.height()))
            });
            assert_same(&pixels, &expected, raster);
            assert_eq!(effort.hits, hits as u64);
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
        let scene = Scene::new(*program);
        let width = raster.width() as usize;
        for (stride, threads) in [(width, 1), (width + 1, 2), (width + 13, 3)] {
            let mut distance = plane(raster, stride);
            let (mut x, mut y, mut z) = (distance.clone(), distance.clone(), distance.clone());
            let mut leaf = vec![4_000_000_000; distance.len()];
            let planes = Planes {
                distance: &mut distance,
                normal: Some([&mut x, &mut y, &mut z]),
                leaf: Some(&mut leaf),
                stride,
                width: raster.width(),
                height: raster.height(),
            };
            let mut renderer = Renderer::at_level(&scene, *raster, level);
            on_threads(threads, || renderer.render(planes));
            for row in 0..raster.height() as usize {
                let place = |column: usize| row * stride + column;
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
        let scene = Scene::new(*program);
        let mut renderer = Renderer::at_level(&scene, *raster, level);
        for (with_normals, with_leaves) in [(false, false), (false, true), (true, false)] {
            let mut distance = plane(raster, stride);
            let (mut x, mut y, mut z) = (distance.clone(), distance.clone(), distance.clone());
            let mut leaf = vec![0; expected.len()];
            renderer.render(Planes {
                distance: &mut distance,
                normal: with_normals.then_some([&mut x, &mut y, &mut z]),
                leaf: with_leaves.then_some(&mut leaf),
                stride,
                width: raster.width(),
                height: raster.height(),
            });
            for (index, pixel) in expected.iter().enumerate() {
                assert_eq!(distance[index].to_bits(), pixel.distance.to_bits());
                assert!(!with_leaves || leaf[index] == pixel.leaf);
                assert!(!with_normals || [x[index], y[index], z[index]] == pixel.normal);
            }
        }
    });
}

/// Tiles are the same pixels too; what is not wanted of them stays as it was.
#[test]
fn tiles_are_filled_in_place() {
    for_pictures(|program, raster, level| {
        let expected = scalar(program, raster);
        let scene = Scene::new(*program);
        let mut renderer = Renderer::at_level(&scene, *raster, level);
        let mut tiles = Tiles::new(raster.width(), raster.height());
        let pixels = |tiles: &Tiles| -> Vec<Pixel> {
            let places = (0..raster.height()).flat_map(|y| (0..raster.width()).map(move |x| (x, y)));
            places.map(|(x, y)| tiles.pixel(x, y).unwrap()).collect()
        };
        on_threads(2, || renderer.render(tiles.as_target().wanting(Wants::NOTHING_ELSE)));
        for (found, expected) in pixels(&tiles).iter().zip(&expected) {
            let without = Pixel {
                normal: [0.0; 3],
                ..*expected
            };
            assert_eq!(bits(found), bits(&without));
        }
        on_threads(2, || renderer.render(tiles.as_target()));
        assert_same(&pixels(&tiles), &expected, raster);
        assert_eq!(tiles.pixel(raster.width(), 0), None);
        assert_eq!(tiles.pixel(0, raster.height()), None);
    });
}

/// A frame buffer of a user's: one byte per pixel, the leaf's number plus one, rows of 80 bytes of which the first two
/// are someone else's.
struct Screen<'b>(&'b mut [u8]);

impl Screen<'_> {
    const STRIDE: usize = 80;
    const MARGIN: usize = 2;
}

impl Target for Screen<'_> {
    fn wants(&self) -> Wants {
        Wants::NOTHING_ELSE
    }

    fn split_at(self, row: u32) -> (Self, Self) {
        let (above, below) = self.0.split_at_mut(row as usize * Self::STRIDE);
        (Screen(above), Screen(below))
    }

    fn put(&mut self, x: u32, y: u32, tile: &Tile) {
        let rows = self.0.chunks_mut(Self::STRIDE).skip(y as usize).take(TILE_SIDE);
        for (y, row) in rows.enumerate() {
            let left = Self::MARGIN + x as usize;
            let width = (Self::STRIDE - left).min(TILE_SIDE);
            for (x, byte) in row[left..left + width].iter_mut().enumerate() {
                // Every pixel is put once.
                assert_eq!(*byte, 99);
                *byte = tile.pixel(x, y).leaf.wrapping_add(1) as u8;
            }
        }
    }
}

#[test]
fn a_target_of_ones_own_gets_every_pixel_once() {
    for_pictures(|program, raster, level| {
        let expected = scalar(program, raster);
        let scene = Scene::new(*program);
        for threads in [1, 3] {
            let mut bytes = vec![99; Screen::STRIDE * raster.height() as usize];
            let mut renderer = Renderer::at_level(&scene, *raster, level);
            on_threads(threads, || renderer.render(Screen(&mut bytes)));
            for (row, bytes) in bytes.chunks(Screen::STRIDE).enumerate() {
                let width = raster.width() as usize;
                let shown = expected[row * width..][..width]
                    .iter()
                    .map(|pixel| pixel.leaf.wrapping_add(1) as u8);
                assert_eq!(bytes[..Screen::MARGIN], [99; Screen::MARGIN]);
                let found = &bytes[Screen::MARGIN..][..width];
                assert!(found.iter().copied().eq(shown), "row {row} of {raster:?}");
            }
        }
    });
}

/// A target that is too small gets what it has room for, one that is too large keeps the rest, and no size is too small.
#[test]
fn no_target_is_written_beyond_picture_or_end() {
    let nodes = nodes();
    let poses = [Transform::IDENTITY];
    let program = Program::new(&nodes).unwrap().posed(&poses).unwrap();
    let scene = Scene::new(program);
    let raster = cameras()[0].raster(21, 35);
    let expected = scalar(&program, &raster);
    for room in [0, 1, 20, 21, 22, 21 * 16, 21 * 16 + 5, 21 * 35 - 1, 21 * 35, 21 * 35 + 1, 21 * 40] {
        let untouched = Pixel {
            distance: UNTOUCHED,
            ..Pixel::NOTHING
        };
        let mut pixels = vec![untouched; room];
        Renderer::new(&scene, raster).render(Records::new(&mut pixels, 21, 35));
        // Whole rows, and no more than there are.
        let held = (room / 21 * 21).min(expected.len());
        assert_same(&pixels[..held], &expected[..held], &raster);
        assert!(
            pixels[expected.len().min(room)..].iter().all(|pixel| *pixel == untouched),
            "room for {room}"
        );
    }
    for (width, height) in [(0, 0), (0, 5), (5, 0)] {
        let mut renderer = Renderer::new(&scene, cameras()[1].raster(width, height));
        let effort = renderer.render(Records::new(&mut [Pixel::NOTHING; 9], width, height));
        assert_eq!(effort, Effort::default());
    }
}

/// One renderer, picture after picture: of other sizes, from elsewhere, and as if it were new each time.
#[test]
fn a_renderer_looks_again() {
    let nodes = nodes();
    let poses = [Transform::IDENTITY];
    let program = Program::new(&nodes).unwrap().posed(&poses).unwrap();
    let scene = Scene::new(program);
    let mut renderer = Renderer::new(&scene, cameras()[0].raster(5, 5));
    for (width, height) in [(40, 30), (8, 70), (100, 3), (33, 33)] {
        for camera in cameras() {
            let raster = camera.raster(width, height);
            renderer.look(raster);
            let mut pixels = vec![Pixel::NOTHING; (width * height) as usize];
            renderer.render(Records::new(&mut pixels, width, height));
            assert_same(&pixels, &scalar(&program, &raster), &raster);
        }
    }
}

/// A picture is rendered at the widest level, unless told otherwise; the renderer says which.
#[test]
fn the_level_can_be_read_and_forced() {
    let scene = Scene::new(scenes::PART.program());
    let raster = cameras()[0].raster(8, 8);
    assert_eq!(Renderer::new(&scene, raster).level(), Level::best());
    for level in Level::available() {
        assert_eq!(Renderer::at_level(&scene, raster, level).level(), level);
    }
}

/// Everything a thread may want to take along or share.
#[test]
fn public_types_are_send_and_sync() {
    fn check<T: Send + Sync>() {}
    check::<(F32x8, Mask8, Packet, Hits, Pixel, Effort, Level, Tile, Tiles)>();
    check::<(
        Scene<'_, Leaf>,
        Planes<'_>,
        Program<'_>,
        Csg<9>,
        Raster,
        Camera,
        Transform,
        Span<F32x8>,
    )>();
    fn check_send<T: Send>() {}
    check_send::<Renderer<'_, '_, Leaf>>();
}
