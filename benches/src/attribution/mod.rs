//! Where the time of a picture goes, by whole pictures that differ in one stage.

mod staged;
mod walls;

pub use staged::{Staged, asked, with_empty_cuts, with_empty_parts};
pub use walls::{Operation, stores};

use crate::scenes::{Primitive, Scene};
use crate::stats::Estimate;
use anyhow::{Context, Result};
use gsdf_nostd::{Node, Program, Raster, Sphere};
use gsdf_simd::{Level, Pixel, Planes, Records, Renderer, Target, Tile, Tiles, Wants};
use std::hint::black_box;
use std::time::Instant;

/// A target that keeps no pixel: each thread's one tile is all that is ever written to.
#[derive(Clone, Copy, Debug)]
struct Dropped(Wants);

impl Target for Dropped {
    fn wants(&self) -> Wants {
        self.0
    }

    fn split_at(self, _row: u32) -> (Self, Self) {
        (self, self)
    }

    fn put(&mut self, _x: u32, _y: u32, tile: &Tile) {
        black_box(tile);
    }
}

/// The nanoseconds per pixel of the stages of a picture, on the thread that asks: medians of differences between neighbours in time.
///
/// `rays` + `parts` + `spans` + `cuts` + `rest` + `normals` + `stores` = `whole`.
#[derive(Clone, Copy, Debug)]
pub struct Stages {
    /// The picture, tile by tile: distance, normal and leaf.
    pub whole: f64,
    /// A picture of a scene of one ball, which is behind the eye: making rays, and writing that they hit nothing to one and the same tile.
    pub rays: f64,
    /// What the picture takes longer with a second, empty copy of every part: walking the tree to the parts, and visiting them.
    pub parts: f64,
    /// What it takes longer if every span is computed twice.
    pub spans: f64,
    /// What it takes longer with a second, empty copy of everything that is subtracted: finding the complements a tile meets, and passing them.
    pub cuts: f64,
    /// What is left of a picture of distances and leaves: joining spans to products, moving entries out of complements, keeping the nearest.
    pub rest: f64,
    /// What a picture that is dropped takes longer with normals than without.
    pub normals: f64,
    /// What it takes longer if it is kept, as tiles.
    pub stores: f64,
    /// The same as records, row by row.
    pub records: f64,
    /// The same as planes, row by row.
    pub planes: f64,
    /// How many spans are computed per pixel, each for all rays of a packet.
    pub spans_per_pixel: f64,
}

/// Measures a scene at a level, in squares of `size` by `size` pixels.
///
/// # Errors
/// Where the scene is not a program.
pub fn stages(scene: &Scene, level: Level, size: u32, rounds: u32) -> Result<Stages> {
    let raster = scene.camera.raster(size, size);
    let behind = scene.camera.eye() - 10.0 * scene.camera.forward();
    let ball = Node::leaf(Primitive::Sphere(Sphere::new(behind, 1.0)?));
    let programs = [
        asked(&[ball], 1),
        asked(&scene.nodes, 1),
        with_empty_parts(&scene.nodes),
        asked(&scene.nodes, 2),
        with_empty_cuts(&scene.nodes),
    ];
    let mut prepared = Vec::new();
    for nodes in &programs {
        prepared.push(gsdf_simd::Scene::new(Program::new(nodes).with_context(|| scene.name)?));
    }
    let mut renderers: Vec<_> = prepared.iter().map(|scene| Renderer::at_level(scene, raster, level)).collect();
    let [nothing, once, parts, twice, cuts] = &mut renderers[..] else {
        anyhow::bail!("a renderer for each program");
    };

    let mut kept = Kept::new(&raster);
    let mut rows: Vec<[f64; 9]> = Vec::new();
    let mut spans = 0;
    for _ in 0..=rounds.max(1) {
        let bare = Dropped(Wants::NOTHING_ELSE);
        let normals = Dropped(Wants::NORMALS);
        let first = picture(once, bare, &mut spans);
        rows.push([
            picture(nothing, bare, &mut 0),
            first,
            picture(parts, bare, &mut 0),
            picture(twice, bare, &mut 0),
            picture(cuts, bare, &mut 0),
            picture(once, normals, &mut 0),
            picture(once, kept.tiles.as_target(), &mut 0),
            picture(once, Records::new(&mut kept.pixels, size, size), &mut 0),
            picture(once, kept.planes(size), &mut 0),
        ]);
    }
    // The first one made room.
    rows.remove(0);
    let pixels = f64::from(size) * f64::from(size);
    let median = |of: fn(&[f64; 9]) -> f64| {
        let sample: Vec<f64> = rows.iter().map(of).collect();
        1e9 / pixels * Estimate::new(&sample).unwrap_or(Estimate::UNKNOWN).median
    };
    let (rays, bare) = (median(|run| run[0]), median(|run| run[1]));
    let (parts, spans_once, cuts) = (
        median(|run| run[2] - run[1]),
        median(|run| run[3] - run[1]),
        median(|run| run[4] - run[1]),
    );
    let normals = median(|run| run[5] - run[1]);
    let stores = median(|run| run[6] - run[5]);
    Ok(Stages {
        whole: bare + normals + stores,
        rays,
        parts,
        spans: spans_once,
        cuts,
        rest: bare - rays - parts - spans_once - cuts,
        normals,
        stores,
        records: median(|run| run[7] - run[5]),
        planes: median(|run| run[8] - run[5]),
        spans_per_pixel: spans as f64 / pixels,
    })
}

/// The seconds that a picture takes, and the spans it computes.
fn picture<T: Target>(renderer: &mut Renderer<'_, '_, Staged>, target: T, spans: &mut u64) -> f64 {
    let begin = Instant::now();
    *spans = renderer.render(target).spans;
    begin.elapsed().as_secs_f64()
}

/// Pictures that are kept, in every layout.
struct Kept {
    tiles: Tiles,
    pixels: Vec<Pixel>,
    distance: Vec<f32>,
    normal: [Vec<f32>; 3],
    leaf: Vec<u32>,
}

impl Kept {
    fn new(raster: &Raster) -> Self {
        let (width, height) = (raster.width(), raster.height());
        let pixels = width as usize * height as usize;
        let plane = || vec![0.0; pixels];
        Self {
            tiles: Tiles::new(width, height),
            pixels: vec![Pixel::NOTHING; pixels],
            distance: plane(),
            normal: [plane(), plane(), plane()],
            leaf: vec![0; pixels],
        }
    }

    fn planes(&mut self, size: u32) -> Planes<'_> {
        let [x, y, z] = &mut self.normal;
        Planes {
            distance: &mut self.distance,
            normal: Some([x, y, z]),
            leaf: Some(&mut self.leaf),
            stride: size as usize,
            width: size,
            height: size,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::stages;
    use crate::scenes::Scene;
    use anyhow::Result;
    use gsdf_simd::Level;

    #[test]
    fn stages_are_all_of_a_picture() -> Result<()> {
        let found = stages(&Scene::by_name("s2")?, Level::best(), 128, 5)?;
        let sum = found.rays + found.parts + found.spans + found.cuts + found.rest + found.normals + found.stores;
        assert!(
            (sum - found.whole).abs() < 1e-6 * (found.whole.abs() + found.rest.abs() + 1.0),
            "{found:?}"
        );
        // Stages are differences of times: of a machine that others are on they may be anything.
        let stages = [found.parts, found.spans, found.cuts, found.rest, found.normals, found.stores];
        assert!(found.rays > 0.0 && stages.iter().all(|stage| stage.is_finite()), "{found:?}");
        assert!(found.spans_per_pixel > 0.1, "{found:?}");
        Ok(())
    }
}
