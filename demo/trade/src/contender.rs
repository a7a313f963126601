//! The ways to find where a ray meets a scene.

use core::fmt;
use gsdf_nostd::SphereTracer;
use gsdf_simd::Level;

/// How much is spent on accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Textbook formulas in `f32`.
    Fast,
    /// Robust formulas in `f32`.
    Robust,
    /// Robust formulas in `f64`.
    Double,
    /// Robust formulas in `f32` with bounds on their errors, and `f64` where these leave a doubt.
    Certified,
    /// Sphere tracing.
    Traced(SphereTracer),
}

/// How many rays are taken at a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// One, past every leaf.
    Scalar,
    /// Those of a packet, past every leaf.
    Packets(Level),
    /// Those of a tile of the picture, past what they can meet: as pictures are rendered.
    Tiles(Level),
}

/// A method, and the way it is used.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contender {
    /// The method.
    pub method: Method,
    /// The way.
    pub way: Way,
}

/// The distances to the surface, relative to that to the eye, at which tracers stop.
const EPSILONS: [f32; 4] = [1e-2, 1e-3, 1e-4, 1e-5];

/// After how many steps tracers give up.
const STEPS: [u32; 2] = [64, 512];

impl Contender {
    /// All of them: tiers and tracers, single rays and packets, but for certified ones, of which each is completed by itself; and
    /// tiles, which there are in the robust tier and certified.
    pub fn all(level: Level) -> impl Iterator<Item = Self> {
        let tiers = [Method::Fast, Method::Robust, Method::Double, Method::Certified].into_iter();
        let tracers = EPSILONS.into_iter().flat_map(|epsilon| {
            STEPS.into_iter().map(move |max_steps| {
                Method::Traced(SphereTracer {
                    epsilon,
                    max_steps,
                    ..SphereTracer::default()
                })
            })
        });
        let ways = move |method| {
            let packets = (method != Method::Certified).then_some(Way::Packets(level));
            let tiles = matches!(method, Method::Robust | Method::Certified).then_some(Way::Tiles(level));
            let ways = core::iter::once(Way::Scalar).chain(packets).chain(tiles);
            ways.map(move |way| Self { method, way })
        };
        tiers.chain(tracers).flat_map(ways)
    }

    /// Pictures as they are rendered.
    #[must_use]
    pub fn tiles(level: Level) -> Self {
        Self {
            method: Method::Robust,
            way: Way::Tiles(level),
        }
    }

    /// Whether it is a tracer.
    #[must_use]
    pub fn is_traced(&self) -> bool {
        matches!(self.method, Method::Traced(_))
    }

    /// Whether it is what the others are compared with: robust tiles, in which pictures are rendered.
    #[must_use]
    pub fn is_base(&self) -> bool {
        self.method == Method::Robust && matches!(self.way, Way::Tiles(_))
    }
}

impl fmt::Display for Contender {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.method {
            Method::Fast => write!(f, "fast")?,
            Method::Robust => write!(f, "robust")?,
            Method::Double => write!(f, "f64")?,
            Method::Certified => write!(f, "certified")?,
            Method::Traced(tracer) => write!(f, "traced {:e} {}", tracer.epsilon, tracer.max_steps)?,
        }
        match self.way {
            Way::Scalar => write!(f, ", scalar"),
            Way::Packets(level) => write!(f, ", {level}"),
            Way::Tiles(_) => write!(f, ", tiles"),
        }
    }
}
