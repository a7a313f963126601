//! A scene made ready for the contenders: what both sides get before the clock starts.

use crate::contender::Contender;
use crate::frame::Frame;
use crate::scenes::{Primitive, Scene};
use anyhow::Result;
use gsdf_nostd::{Camera, Program, Raster, SphereTracer};
use gsdf_simd::Level;
use std::sync::Arc;

/// The marcher's tolerance, relative to the distance travelled.
pub const EPSILON: f32 = 1e-4;

/// The most steps the marcher may take.
pub const MAX_STEPS: u32 = 128;

/// A scene, the size of its picture, and the marcher's settings for it.
#[derive(Clone, Debug)]
pub struct Arena<'a> {
    /// The name of the scene.
    pub name: &'static str,
    /// The program, the same for all contenders.
    pub program: Program<'a, Primitive>,
    /// The program prepared, for those who look at what a tile can see.
    pub prepared: Arc<gsdf_simd::Scene<'a, Primitive>>,
    /// From where it is seen.
    pub camera: Camera,
    /// The picture.
    pub raster: Raster,
    /// Where the marcher gives up: a hundredth beyond the farthest thing in the picture, which it is told for nothing, so that its misses end early.
    pub end: f32,
    /// The marcher.
    pub tracer: SphereTracer,
    /// The level at which packets are cast and traced.
    pub level: Level,
}

impl<'a> Arena<'a> {
    /// A scene as a square of `size` by `size` pixels, with a marcher that does not over-relax.
    ///
    /// # Errors
    /// Where the scene is not a program.
    pub fn new(scene: &'a Scene, size: u32) -> Result<Self> {
        let program = scene.program()?;
        let arena = Self {
            name: scene.name,
            program,
            prepared: Arc::new(gsdf_simd::Scene::new(program)),
            camera: scene.camera,
            raster: scene.camera.raster(size, size),
            end: f32::INFINITY,
            tracer: tracer(1.0),
            level: Level::best(),
        };
        Ok(arena.sized(size))
    }

    /// The same in another size.
    #[must_use]
    pub fn sized(&self, size: u32) -> Self {
        let mut arena = Self {
            raster: self.camera.raster(size, size),
            ..self.clone()
        };
        arena.end = 1.01 * arena.exact().farthest().unwrap_or(1.0);
        arena
    }

    /// The same at another level.
    #[must_use]
    pub fn at_level(&self, level: Level) -> Self {
        Self { level, ..self.clone() }
    }

    /// The same with another relaxation of the marcher.
    #[must_use]
    pub fn relaxed(&self, relaxation: f32) -> Self {
        Self {
            tracer: tracer(relaxation),
            ..self.clone()
        }
    }

    /// How many pixels the picture has.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.raster.width() as usize * self.raster.height() as usize
    }

    /// The picture as the closed form has it, in records.
    #[must_use]
    pub fn exact(&self) -> Frame {
        let mut frame = Frame::new(&self.raster);
        Contender::ClosedTiles.ready(self)(&mut frame);
        frame.settle(Contender::ClosedTiles);
        frame
    }
}

/// The marcher with a relaxation.
#[must_use]
pub const fn tracer(relaxation: f32) -> SphereTracer {
    SphereTracer {
        epsilon: EPSILON,
        max_steps: MAX_STEPS,
        relaxation,
    }
}
