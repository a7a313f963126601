//! Leaf types that are cast at in vectors: where the code of that is compiled.

use crate::batch::RayCaster;
use crate::level::Level;
use crate::renderer::RowRenderer;
use gsdf_nostd::{Leaf, Solid};

/// A leaf type whose programs a [`Renderer`](crate::Renderer) and a [`Caster`](crate::Caster) take.
///
/// Their code for each solid at each level is much, and takes its time to compile. So it is compiled once, in the crate that
/// implements this trait: for [`Leaf`] in this one, for a leaf type of yours where you write
///
/// ```
/// use gsdf_nostd::{Cuboid, Sphere, leaf_set};
///
/// leaf_set! {
///     /// All that my device has to recognise.
///     pub enum Obstacle { Sphere(Sphere), Cuboid(Cuboid) }
/// }
/// gsdf_simd::vectorized!(Obstacle);
/// ```
pub trait Vectorized: Solid<Seen<f32>: Send + Sync> + Send + Sync + 'static {
    /// What renders rows of tiles at a level, and certifies them if it is to.
    #[doc(hidden)]
    fn row_renderer(level: Level, certifies: bool) -> RowRenderer<Self>;

    /// What casts batches of rays at a level.
    #[doc(hidden)]
    fn ray_caster(level: Level) -> RayCaster<Self>;
}

/// Makes a leaf type one that a [`Renderer`](crate::Renderer) and a [`Caster`](crate::Caster) take, and compiles their code
/// for it here: see [`Vectorized`].
#[macro_export]
macro_rules! vectorized {
    ($leaf:ty) => {
        impl $crate::Vectorized for $leaf {
            fn row_renderer(level: $crate::Level, certifies: bool) -> $crate::RowRenderer<Self> {
                $crate::RowRenderer::new(level, certifies)
            }

            fn ray_caster(level: $crate::Level) -> $crate::RayCaster<Self> {
                $crate::RayCaster::new(level)
            }
        }
    };
}

impl Vectorized for Leaf {
    fn row_renderer(level: Level, certifies: bool) -> RowRenderer<Self> {
        RowRenderer::new(level, certifies)
    }

    fn ray_caster(level: Level) -> RayCaster<Self> {
        RayCaster::new(level)
    }
}
