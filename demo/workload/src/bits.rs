//! The rows that every target computes and holds against one committed number each.

use crate::corpus;
use crate::digest::Digest;
use crate::scenes::{S1, S2, S3, S4, S5, Scene};
use gsdf_nostd::{Lane, ProgramError, Span};

/// Something to compute in an arithmetic that is `f32` or behaves as it, and the hash that must come out, whatever the
/// target, the optimisation and the processor.
#[derive(Clone, Copy, Debug)]
pub struct Row<T = f32> {
    /// Its name.
    pub name: &'static str,
    /// The hash that must come out.
    pub golden: u64,
    /// How many spans of scratch memory it takes: one per leaf of its largest program.
    pub spans: usize,
    compute: Compute<T>,
}

/// How a hash is computed in scratch memory.
type Compute<T> = fn(&mut [Span<T>]) -> Result<u64, ProgramError>;

impl<T: Lane> Row<T> {
    const fn of_scene(scene: &Scene, compute: Compute<T>, golden: u64) -> Self {
        Self {
            name: scene.name,
            golden,
            spans: scene.program.leaves(),
            compute,
        }
    }

    const fn of_corpus(name: &'static str, compute: Compute<T>, golden: u64) -> Self {
        Self {
            name,
            golden,
            spans: corpus::SPANS,
            compute,
        }
    }

    /// [`SMALL`], in this arithmetic.
    #[must_use]
    pub const fn small() -> [Self; 5] {
        [
            Self::of_scene(&S1, |scratch| picture(&S1, scratch), 0xb8ca_21da_c51e_8a15),
            Self::of_scene(&S2, |scratch| picture(&S2, scratch), 0x3c48_0aa8_a7b5_ceb9),
            Self::of_scene(&S3, |scratch| picture(&S3, scratch), 0x3a43_415d_1f94_7124),
            Self::of_corpus("corpus", corpus::hits, 0x89dd_6287_3637_29f4),
            Self::of_corpus("corpus-readings", corpus::readings, 0x6355_5c19_4300_8f75),
        ]
    }

    /// [`MEDIUM`], in this arithmetic.
    #[must_use]
    pub const fn medium() -> [Self; 1] {
        [Self::of_corpus("corpus-departures", corpus::departures, 0xa3ac_4e81_fbe5_6413)]
    }

    /// [`LARGE`], in this arithmetic.
    #[must_use]
    pub const fn large() -> [Self; 2] {
        [
            Self::of_scene(&S4, |scratch| picture(&S4, scratch), 0x3d9b_4efd_66c7_230c),
            Self::of_scene(&S5, |scratch| picture(&S5, scratch), 0xde1c_1dd3_7050_12fc),
        ]
    }

    /// The hash that does come out.
    ///
    /// # Errors
    /// Where `scratch` is shorter than [`spans`](Self::spans).
    pub fn compute(&self, scratch: &mut [Span<T>]) -> Result<u64, ProgramError> {
        (self.compute)(scratch)
    }
}

/// The rows for targets with 256 KB of flash and 16 KB of memory, even without optimisation.
///
/// The corpus has another hash with every kind of solid that is added to [`solids`](crate::solids), and only then.
pub static SMALL: [Row; 5] = Row::small();

/// The rows for targets with 256 KB of flash and optimisation: without, departures are as much code again as all else.
pub static MEDIUM: [Row; 1] = Row::medium();

/// The rows with large programs: more than half a megabyte of flash, 32 KB of scratch memory.
pub static LARGE: [Row; 2] = Row::large();

/// The spans of scratch memory that every row of [`SMALL`] does with.
pub const SMALL_SPANS: usize = most_spans(&SMALL);

/// The spans of scratch memory that every row of [`MEDIUM`] does with.
pub const MEDIUM_SPANS: usize = most_spans(&MEDIUM);

/// The spans of scratch memory that every row of [`LARGE`] does with.
pub const LARGE_SPANS: usize = most_spans(&LARGE);

const fn most_spans(rows: &[Row]) -> usize {
    let mut most = 0;
    let mut index = 0;
    while index < rows.len() {
        if rows[index].spans > most {
            most = rows[index].spans;
        }
        index += 1;
    }
    most
}

/// The hash of a scene's [small picture](Scene::side), misses included.
fn picture<T: Lane>(scene: &Scene, scratch: &mut [Span<T>]) -> Result<u64, ProgramError> {
    let raster = scene.raster();
    let mut digest = Digest::new();
    for y in 0..scene.side {
        for x in 0..scene.side {
            match raster.ok().and_then(|raster| raster.ray(x, y).ok()) {
                Some(ray) => digest.cast(scene.program.along(ray, &mut *scratch)?.cast().as_ref()),
                None => digest.refused(),
            }
        }
    }
    Ok(digest.finish())
}
