//! What tiles leave out changes no pixel: pictures of random scenes against one scalar query per pixel, bit for bit, at every
//! level. Solids on grids, whose surfaces coincide and whose pixels tie; copies of copies; eyes inside of solids, on their
//! surfaces and far away; poses; solids and complements without bounds; parts that are products and parts that are not.
//! And what a scene says is visible through squares of pixels is enough for these pixels.

use crate::crowds::{coarse, riddled, scattered};
use glam::{Mat3, Vec3, vec3};
use gsdf_nostd::{Camera, Cuboid, HalfSpace, Leaf, Node, Program, Raster, Solid, Span, Sphere, Toward, Transform, V3, csg, leaf_set};
use gsdf_simd::{Level, Pixel, Renderer, Scene, Tiles, Visible};
use gsdf_tests::conformance::packet::Composed;
use gsdf_tests::shape::{KINDS, Shape, unit};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

fn scalar(program: &Program<'_>, raster: &Raster) -> Vec<Pixel> {
    let mut spans = vec![Span::EMPTY; program.leaves()];
    let places = (0..raster.height()).flat_map(|y| (0..raster.width()).map(move |x| (x, y)));
    let mut pixel = |(x, y)| {
        let ray = raster.ray(x, y).ok()?;
        let hit = program.along(ray, &mut spans).unwrap().cast()?;
        Some(Pixel {
            distance: hit.t,
            normal: hit.normal.to_array(),
            leaf: hit.leaf,
        })
    };
    places.map(|place| pixel(place).unwrap_or(Pixel::NOTHING)).collect()
}

fn bits(pixel: &Pixel) -> [u32; 5] {
    let [x, y, z] = pixel.normal.map(f32::to_bits);
    [pixel.distance.to_bits(), x, y, z, pixel.leaf]
}

/// What a picture showed.
#[derive(Clone, Copy, Debug, Default)]
struct Shown {
    pictures: u64,
    hits: u64,
    misses: u64,
    leaving: u64,
}

impl Shown {
    fn joined(self, other: Self) -> Self {
        Self {
            pictures: self.pictures + other.pictures,
            hits: self.hits + other.hits,
            misses: self.misses + other.misses,
            leaving: self.leaving + other.leaving,
        }
    }
}

fn check(program: &Program<'_>, raster: &Raster, what: &str) -> Shown {
    let expected = scalar(program, raster);
    let scene = Scene::new(*program);
    for level in Level::available() {
        let mut tiles = Tiles::new(raster.width(), raster.height());
        Renderer::at_level(&scene, *raster, level).render(tiles.as_target());
        for (index, expected) in (0..).zip(&expected) {
            let (x, y) = (index % raster.width(), index / raster.width());
            let found = tiles.pixel(x, y).unwrap();
            assert_eq!(
                bits(&found),
                bits(expected),
                "{what}, {level}, pixel {x}, {y} of {raster:?}: {found:?}, not {expected:?}"
            );
        }
    }
    check_visible(&scene, raster, &expected, what);
    let hits = expected.iter().filter(|pixel| pixel.leaf != Pixel::NO_LEAF).count() as u64;
    let leaves = |pixel: &&Pixel| raster.camera().forward().dot(Vec3::from(pixel.normal)) > 0.5;
    Shown {
        pictures: 1,
        hits,
        misses: expected.len() as u64 - hits,
        leaving: expected.iter().filter(leaves).count() as u64,
    }
}

/// The pixels of each square, cast at what is visible there alone; and its standard distance on the way to them, which no
/// marcher's step may exceed what is left of it.
fn check_visible(scene: &Scene<'_, Leaf>, raster: &Raster, expected: &[Pixel], what: &str) {
    let poses: Vec<_> = (1..).map_while(|frame| scene.program().pose(frame).copied()).collect();
    let mut visible = Visible::new();
    // Squares of all sizes, also some that reach beyond the picture.
    let side = 1 + (7 * raster.width() + raster.height()) % 20;
    for (left, top) in
        (0..raster.height().div_ceil(side)).flat_map(|y| (0..raster.width().div_ceil(side)).map(move |x| (x * side, y * side)))
    {
        scene.visible(raster, left, top, side, &mut visible);
        let program = Program::new(visible.nodes()).ok().map(|program| program.posed(&poses).unwrap());
        assert_eq!(program.is_none(), visible.nodes().is_empty(), "{what}");
        assert!(visible.leaves().is_sorted_by(|a, b| a < b), "{what}");
        let mut spans = vec![Span::EMPTY; visible.leaves().len()];
        for (x, y) in (top..raster.height().min(top + side)).flat_map(|y| (left..raster.width().min(left + side)).map(move |x| (x, y))) {
            let ray = raster.ray(x, y).ok();
            let hit = program.and_then(|program| program.along(ray?, &mut spans).unwrap().cast());
            let found = hit.map_or(Pixel::NOTHING, |hit| Pixel {
                distance: hit.t,
                normal: hit.normal.to_array(),
                leaf: visible.leaves()[hit.leaf as usize],
            });
            let expected = &expected[(y * raster.width() + x) as usize];
            assert_eq!(bits(&found), bits(expected), "{what}, visible, pixel {x}, {y} of {raster:?}");
            let (Some(program), Some(ray), Some(hit)) = (program, ray, hit) else {
                continue;
            };
            for share in [0.0, 0.5, 0.9] {
                let left = f64::from(hit.t) * (1.0 - share) * ray.direction().as_dvec3().length();
                let p = ray.origin().as_dvec3() + ray.direction().as_dvec3() * (share * f64::from(hit.t));
                let step = program.distance(V3::new(p.x, p.y, p.z)).abs();
                let extent = p.abs().max_element() + left;
                assert!(
                    step <= left + 1e-4 * extent,
                    "{what}, visible, pixel {x}, {y}: {step} with {left} left"
                );
            }
        }
    }
}

fn camera(rng: &mut Pcg64, eye: Vec3, target: Vec3, size: f32) -> Camera {
    let up = unit(rng).as_vec3();
    let made = if rng.random_range(0..4) == 0 {
        Camera::orthographic(eye, target, up, size)
    } else {
        Camera::pinhole(eye, target, up, rng.random_range(0.05_f32..1.5))
    };
    made.unwrap_or_else(|_| camera(rng, eye + Vec3::X, target, size))
}

#[test]
fn random_programs() {
    let shown = (0..1500_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let composed = Composed::random(&mut rng);
        let program = composed.program();
        let ray = composed.aimed(&mut rng);
        let (eye, target) = (ray.origin, ray.origin + ray.direction);
        if !(eye.is_finite() && target.is_finite() && eye.abs().max_element() < 1e8 && target.abs().max_element() < 1e8) {
            return Shown::default();
        }
        let camera = camera(&mut rng, eye, target, 2.0);
        let raster = camera.raster(rng.random_range(1..24), rng.random_range(1..24));
        check(&program, &raster, &format!("seed {seed}"))
    });
    let shown = shown.reduce(Shown::default, Shown::joined);
    assert!(shown.pictures > 1000 && shown.hits > 30_000 && shown.misses > 100_000, "{shown:?}");
}

#[test]
fn scenes_of_many_parts() {
    let shown = (0..600_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let (parts, reach) = [(1, 1), (3, 1), (20, 2), (80, 4), (300, 8)][rng.random_range(0..5)];
        let nodes = scattered(&mut rng, parts, reach);
        // A quarter turn leaves a box no room around its solid.
        let turn = if rng.random_range(0..2) == 0 {
            Mat3::from_cols(Vec3::Y, Vec3::Z, Vec3::X)
        } else {
            Mat3::from_axis_angle(unit(&mut rng).as_vec3(), rng.random_range(0.0_f32..3.0))
        };
        let shear = Mat3::from_cols(vec3(1.0, 0.25, 0.0), vec3(0.0, 2.0, 0.5), vec3(0.125, 0.0, 0.5));
        let poses = [
            Transform::affine(turn, vec3(0.5, 0.25, -0.5)).unwrap(),
            Transform::affine(turn * shear, Vec3::ZERO).unwrap(),
        ];
        let program = Program::new(&nodes).unwrap().posed(&poses).unwrap();
        let size = reach as f32;
        let target = vec3(coarse(&mut rng, reach), coarse(&mut rng, reach), coarse(&mut rng, reach));
        // Far away, near, and in the midst of it: on the grid, where eyes lie on surfaces.
        let eye = match rng.random_range(0..4) {
            0 => unit(&mut rng).as_vec3() * size * rng.random_range(30.0_f32..3000.0),
            1..3 => unit(&mut rng).as_vec3() * size * rng.random_range(1.0_f32..4.0),
            _ => vec3(coarse(&mut rng, reach), coarse(&mut rng, reach), coarse(&mut rng, reach)),
        };
        let eye = if eye == target { eye + Vec3::X } else { eye };
        let camera = camera(&mut rng, eye, target, size);
        let raster = camera.raster(rng.random_range(1..50), rng.random_range(1..40));
        check(&program, &raster, &format!("seed {seed}"))
    });
    let shown = shown.reduce(Shown::default, Shown::joined);
    assert!(
        shown.pictures == 600 && shown.hits > 60_000 && shown.misses > 50_000 && shown.leaving > 5_000,
        "{shown:?}"
    );
}

/// Products of blocks on a grid, whose faces coincide, and of their complements, in any order: of all that begin or end where
/// the product is entered the lowest number counts.
#[test]
fn faces_that_coincide() {
    let shown = (0..400_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut nodes: Vec<Node> = Vec::new();
        let body = rng.random_range(0..3);
        for number in 0..rng.random_range(3..8) {
            let at = vec3(coarse(&mut rng, 1), coarse(&mut rng, 1), coarse(&mut rng, 1));
            let is_positive = number == body || rng.random_range(0..3) == 0;
            let size = if is_positive { 2.0 } else { rng.random_range(1..=3) as f32 * 0.5 };
            let first = nodes.is_empty();
            nodes.push(Node::leaf(
                Cuboid::new(at - Vec3::splat(size), at + Vec3::splat(size)).unwrap().into(),
            ));
            if !is_positive {
                nodes.push(Node::Complement);
            }
            if !first {
                nodes.push(Node::Intersection);
            }
        }
        let program = Program::new(&nodes).unwrap();
        let eye = unit(&mut rng).as_vec3() * 7.0;
        let raster = camera(&mut rng, eye, Vec3::ZERO, 2.0).raster(24, 24);
        check(&program, &raster, &format!("seed {seed}"))
    });
    let shown = shown.reduce(Shown::default, Shown::joined);
    assert!(shown.hits > 10_000, "{shown:?}");
}

/// Far away, before a wall that every ray meets: what lies nearer is looked for only where it can be, and is nearer by little.
#[test]
fn in_front_of_a_wall() {
    let shown = (0..100_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut nodes = scattered(&mut rng, 60, 4);
        let wall = Cuboid::new(vec3(-900.0, -900.0, 6.0), vec3(900.0, 900.0, 8.0)).unwrap();
        nodes.extend([Node::leaf(wall.into()), Node::Union]);
        let poses = [Transform::translation(Vec3::X).unwrap(), Transform::translation(Vec3::Y).unwrap()];
        let program = Program::new(&nodes).unwrap().posed(&poses).unwrap();
        let distance = rng.random_range(20.0_f32..1000.0);
        let eye = vec3(coarse(&mut rng, 8), coarse(&mut rng, 8), -distance);
        let camera = Camera::pinhole(eye, Vec3::ZERO, unit(&mut rng).as_vec3(), 7.0 / distance).unwrap();
        check(&program, &camera.raster(48, 48), &format!("seed {seed}"))
    });
    let shown = shown.reduce(Shown::default, Shown::joined);
    assert!(shown.hits > 120_000, "{shown:?}");
}

/// Half-spaces seen from both sides and along their planes, alone, in wedges, drilled, in frames and in what is no product: of
/// what has no box a tile still leaves out what all of its rays miss, and what they are inside of all the way.
#[test]
fn half_spaces_and_their_horizons() {
    let shown = (0..400_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let leaf = |rng: &mut Pcg64| {
            let at = vec3(coarse(rng, 2), coarse(rng, 2), coarse(rng, 2));
            let normal = [Vec3::X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, unit(rng).as_vec3()][rng.random_range(0..5)];
            let solid: Leaf = match rng.random_range(0..4) {
                0 => Sphere::new(at, 1.5).unwrap().into(),
                _ => HalfSpace::new(at, normal).unwrap().into(),
            };
            let frame = rng.random_range(0..3_u16).saturating_sub(1);
            Node::Leaf { solid, frame }
        };
        let mut nodes = vec![leaf(&mut rng)];
        for _ in 0..rng.random_range(0..5) {
            nodes.push(leaf(&mut rng));
            if rng.random_range(0..3) == 0 {
                nodes.extend([leaf(&mut rng), Node::Union]);
            }
            nodes.push([Node::Union, Node::Intersection, Node::Difference][rng.random_range(0..3)]);
        }
        let shear = Mat3::from_cols(vec3(1.0, 0.0, 0.0), vec3(0.0, 0.001, 3.0), vec3(0.0, 0.0, 100.0));
        let pose = [Transform::affine(shear, vec3(0.5, 1.0, 0.0)).unwrap()];
        let program = Program::new(&nodes).unwrap().posed(&pose).unwrap();
        let eye = vec3(coarse(&mut rng, 4), coarse(&mut rng, 4), coarse(&mut rng, 4));
        let target = [Vec3::ZERO, eye + Vec3::X, eye + Vec3::Z, eye + unit(&mut rng).as_vec3()][rng.random_range(0..4)];
        let target = if target == eye { eye + Vec3::Y } else { target };
        let raster = camera(&mut rng, eye, target, 4.0).raster(48, 48);
        check(&program, &raster, &format!("seed {seed}"))
    });
    let shown = shown.reduce(Shown::default, Shown::joined);
    assert!(shown.hits > 100_000 && shown.misses > 100_000, "{shown:?}");
}

#[test]
fn blocks_full_of_holes() {
    let shown = (0..60_u64).into_par_iter().map(|seed| {
        let mut rng = Pcg64::seed_from_u64(seed);
        let balls = [20, 60, 150][rng.random_range(0..3)];
        let nodes = riddled(&mut rng, balls);
        let program = Program::new(&nodes).unwrap();
        let eye = unit(&mut rng).as_vec3() * 12.0;
        let raster = camera(&mut rng, eye, Vec3::ZERO, 5.0).raster(30, 20);
        check(&program, &raster, &format!("seed {seed}"))
    });
    let shown = shown.reduce(Shown::default, Shown::joined);
    assert!(shown.hits > 5_000, "{shown:?}");
}

leaf_set! {
    /// A leaf type of a user's.
    pub enum Gem { Sphere(Sphere), Cuboid(Cuboid) }
}
gsdf_simd::vectorized!(Gem);

csg! { const CUT_GEM: Gem = difference(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(Vec3::X, 0.6)) }

#[test]
fn a_leaf_type_of_ones_own_is_rendered_too() {
    let scene = Scene::new(CUT_GEM.program());
    let raster = Camera::pinhole(vec3(2.0, 1.0, -3.0), Vec3::ZERO, Vec3::Y, 0.4)
        .unwrap()
        .raster(40, 30);
    for level in Level::available() {
        let mut tiles = Tiles::new(40, 30);
        Renderer::at_level(&scene, raster, level).render(tiles.as_target());
        for (x, y) in (0..30).flat_map(|y| (0..40).map(move |x| (x, y))) {
            let expected = CUT_GEM.cast(&raster.ray(x, y).unwrap()).map_or(Pixel::NOTHING, |hit| Pixel {
                distance: hit.t,
                normal: hit.normal.to_array(),
                leaf: hit.leaf,
            });
            assert_eq!(
                tiles.pixel(x, y).map(|pixel| bits(&pixel)),
                Some(bits(&expected)),
                "{level}, {x}, {y}"
            );
        }
    }
}

/// Where no solid of a scene asks for the reciprocals of a direction's components they are left out: those that say they do
/// not ask really do not.
#[test]
fn who_does_not_divide_by_components_never_looks_at_them() {
    let mut rng = Pcg64::seed_from_u64(3);
    let mut silent = 0;
    for round in 0..200 {
        let leaf = Shape::random(&mut rng, round % KINDS.len(), 1.0, 1.5).leaf().unwrap();
        if leaf.divides_by_components() {
            continue;
        }
        silent += 1;
        for _ in 0..50 {
            let origin = unit(&mut rng).as_vec3() * 5.0;
            let direction = V3::from(unit(&mut rng).as_vec3() * 0.5 - origin);
            let (with, nan) = (Toward::new(direction), V3::new(f32::NAN, f32::NAN, f32::NAN));
            let without = Toward {
                per_component: nan,
                ..Toward::without_components(direction)
            };
            let seen = leaf.seen_from(V3::from(origin));
            let span = leaf.span(&seen, &with);
            assert_eq!(span, leaf.span(&seen, &without), "{leaf:?}");
            if span.enter < span.exit {
                let surfaces = [with, without].map(|toward| leaf.surface(&seen, &toward, span.enter));
                assert_eq!(surfaces[0], surfaces[1], "{leaf:?}");
            }
        }
    }
    assert!(silent > 50);
}
