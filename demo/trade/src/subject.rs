//! What contenders are measured on: a program, and the rays through the pixels of a picture of it.

use crate::solids::{Primitive, Solids};
use anyhow::Result;
use gsdf_nostd::{Leaf, Program, Raster, Ray};
use gsdf_simd::{MOST_LANES, Scene};

/// A program and the rays it is asked about.
#[derive(Debug)]
pub struct Subject<'a> {
    name: String,
    prepared: Scene<'a, Leaf>,
    solids: Solids,
    far: f32,
    raster: Raster,
    pixels: Vec<u32>,
    rays: Vec<Ray>,
}

impl<'a> Subject<'a> {
    /// A program by a name, as a raster sees it, with nothing to be seen beyond the distance `far`.
    ///
    /// # Errors
    /// As [`Solids::of`], or where the raster's camera sees along no ray.
    pub fn new(name: &str, program: Program<'a>, raster: Raster, far: f32) -> Result<Self> {
        let mut subject = Self {
            name: name.to_owned(),
            solids: Solids::of(&program)?,
            prepared: Scene::new(program),
            far,
            raster,
            pixels: Vec::new(),
            rays: Vec::new(),
        };
        subject.look(raster)?;
        Ok(subject)
    }

    /// Looks through another raster from now on.
    ///
    /// # Errors
    /// Where its camera sees along no ray.
    pub fn look(&mut self, raster: Raster) -> Result<()> {
        let width = raster.width();
        self.pixels = spread(width * raster.height());
        let ray = |pixel: &u32| raster.ray(pixel % width, pixel / width);
        self.rays = self.pixels.iter().map(ray).collect::<Result<_, _>>()?;
        self.raster = raster;
        Ok(())
    }

    /// What it is called.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The program, prepared for tiles.
    #[must_use]
    pub fn prepared(&self) -> &Scene<'a, Leaf> {
        &self.prepared
    }

    /// The program.
    ///
    /// # Errors
    /// As [`Solids::program`].
    pub fn program(&self) -> Result<Program<'_, Primitive>> {
        self.solids.program()
    }

    /// Beyond what distance nothing is to be seen, in units of the rays' parameters.
    #[must_use]
    pub fn far(&self) -> f32 {
        self.far
    }

    /// The picture.
    #[must_use]
    pub fn raster(&self) -> Raster {
        self.raster
    }

    /// A ray through the middle of each pixel: neighbours of a row by the packet, and the packets in an order of which every
    /// beginning is spread over all of the picture.
    #[must_use]
    pub fn rays(&self) -> &[Ray] {
        &self.rays
    }

    /// For each ray the number of its pixel, row by row.
    #[must_use]
    pub fn pixels(&self) -> &[u32] {
        &self.pixels
    }
}

/// The numbers below one, in runs as long as a packet.
fn spread(count: u32) -> Vec<u32> {
    const RUN: u32 = MOST_LANES as u32;
    let runs = count / RUN;
    // Steps of the golden section leave no gap that is much larger than the others.
    let golden = (f64::from(runs) * 0.618_034) as u32;
    let step = (golden.max(1)..).find(|step| coprime(*step, runs.max(1))).unwrap_or(1);
    let start = |run: u32| (u64::from(run) * u64::from(step) % u64::from(runs.max(1))) as u32 * RUN;
    let whole = (0..runs).flat_map(|run| start(run)..start(run) + RUN);
    whole.chain(runs * RUN..count).collect()
}

fn coprime(mut a: u32, mut b: u32) -> bool {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a == 1
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn every_pixel_comes_once_and_early_ones_are_far_apart() {
        for count in [0, 1, 15, 16, 17, 31, 32, 320, 4096, 10_001] {
            let mut pixels = spread(count);
            pixels.sort_unstable();
            assert!(pixels.into_iter().eq(0..count), "{count}");
        }
        let mut early: Vec<u32> = spread(1 << 16).into_iter().take(8 * 16).step_by(16).collect();
        early.sort_unstable();
        assert!(
            early.windows(2).all(|pair| (4096..16_384).contains(&(pair[1] - pair[0]))),
            "{early:?}"
        );
    }
}
