//! `gsdf paper`: the table and the sheet.

use super::cameras::{Side, distribution};
use super::measure::{Count, Each, Effort, nanoseconds, wrong};
use super::picture::{Row, inner, outer, percent, pictures, table};
use super::reading::Reading;
use super::shapes::{Shape, shapes};
use crate::output::{prepare, say, write_png};
use anyhow::{Context, Result};
use rayon::ThreadPoolBuilder;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to measure, and where to draw it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Paper {
    /// The pixels along each side of a picture, which is half as wide on the sheet.
    pub size: u32,
    /// The file of the sheet.
    pub sheet: PathBuf,
    /// The number of threads; `None` for as many as there are cores. One ray's time is always one thread's.
    pub threads: Option<usize>,
}

impl Paper {
    /// The sizes at which the sheet can be read and fits into memory.
    pub const SIZES: core::ops::RangeInclusive<u32> = 192..=1024;

    /// Measures every shape under every reading and prints the table; then draws the sheet.
    ///
    /// # Errors
    /// Where a file cannot be written, or there are no threads to be had.
    pub fn run(&self) -> Result<()> {
        // The parent of a bare file name is empty, and means the current directory.
        let directory = self.sheet.parent().filter(|path| !path.as_os_str().is_empty());
        prepare(directory.unwrap_or(Path::new(".")))?;
        let pool = ThreadPoolBuilder::new()
            .num_threads(self.threads.unwrap_or_default())
            .build()
            .context("cannot start the threads")?;
        let begin = Instant::now();
        say(&head())?;
        let mut rows = Vec::new();
        for shape in shapes() {
            let counts = pool.install(|| counts(&shape, EFFORT))?;
            let times = nanoseconds(&shape, outer(&shape)?, TIMED_PIXELS)?;
            for (number, reading) in Reading::ALL.into_iter().enumerate() {
                let name = if number == 0 { shape.name } else { "" };
                say(&line(name, reading, counts.map(|counts| counts[number]), times[number]))?;
            }
            let pictures = pool.install(|| drawn(&shape, self.size))?;
            rows.push(Row {
                name: shape.name,
                pictures,
                counts,
            });
        }
        write_png(&table(&rows), &self.sheet)?;
        say(&format!(
            "{:.1} s; the sheet: {}",
            begin.elapsed().as_secs_f64(),
            self.sheet.display()
        ))
    }
}

/// Many small pictures rather than few large ones: the pixels of a picture have their eye in common, and are no sample of eyes.
const EFFORT: Effort = Effort { cameras: 2048, pixels: 12 };
const TIMED_PIXELS: u32 = 64;

fn counts(shape: &Shape, effort: Effort) -> Result<[Each<Count>; 2]> {
    Ok([wrong(shape, Side::Outside, effort)?, wrong(shape, Side::Inside, effort)?])
}

fn drawn(shape: &Shape, size: u32) -> Result<[Vec<image::RgbImage>; 2]> {
    Ok([pictures(shape, outer(shape)?, size)?, pictures(shape, inner(shape)?, size)?])
}

/// What the numbers mean, and the head of the table.
fn head() -> String {
    let readings: String = Reading::ALL
        .iter()
        .map(|reading| format!("{:<12} {}\n", reading.name(), reading.meaning()))
        .collect();
    let Effort { cameras, pixels } = EFFORT;
    format!(
        "The paper's composition, one number per primitive and min, max, minus, in the ways it can be read:\n\
         {readings}\
         wrong: pixels, of {cameras} pictures of {pixels} x {pixels}, that show something else than the exact one; of those from outside which\n\
         are phantoms (a surface where none is), missed (none where one is) and misplaced (one at another distance).\n\
         {distribution}\n\
         The shares follow from that choice: the more sky in the pictures, the more rays there are to see phantoms on; the nearer the\n\
         eyes, the more roots lie behind them. What is proved does not: exact is right, and S never oversteps and is off only where it\n\
         stops at a root that is no surface of the whole.\n\
         ns/pixel: one ray through each pixel of the sheet's camera from outside, {TIMED_PIXELS} x {TIMED_PIXELS}, scalar, one thread: all spans and their composition.\n\
         {:<20} {:<12} {:>8} {:>8} {:>8} {:>9} {:>8} {:>9}",
        "shape",
        "reading",
        "outside",
        "phantom",
        "missed",
        "misplaced",
        "inside",
        "ns/pixel",
        distribution = distribution(),
    )
}

/// A line of the table.
fn line(name: &str, reading: Reading, [outside, inside]: [Count; 2], nanoseconds: f64) -> String {
    let share = |count: Count, some: u64| percent(count.percent(some));
    format!(
        "{:<20} {:<12} {:>8} {:>8} {:>8} {:>9} {:>8} {:>9.1}",
        name,
        reading.name(),
        share(outside, outside.wrong()),
        share(outside, outside.phantom),
        share(outside, outside.missed),
        share(outside, outside.misplaced),
        share(inside, inside.wrong()),
        nanoseconds,
    )
}
