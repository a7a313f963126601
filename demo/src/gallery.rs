//! The gallery: scene after scene to its file, with a table of what each took.

use crate::output::{prepare, say, write_png};
use crate::render::{Picture, render};
use crate::scenes::{self, Scene};
use anyhow::{Context, Result};
use indicatif::{ProgressBar, ProgressStyle};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What to render, and where to.
#[derive(Clone, Debug)]
pub struct Gallery {
    /// The names of the scenes; none for all.
    pub scenes: Vec<String>,
    /// The pixels along each side of a picture.
    pub size: u32,
    /// The directory of the pictures, which is made if need be.
    pub directory: PathBuf,
    /// The number of threads; `None` for as many as there are cores.
    pub threads: Option<usize>,
}

impl Gallery {
    /// Renders it, with a table on standard output and a progress bar on standard error, which is silent where that is no terminal.
    ///
    /// # Errors
    /// Where a scene is not known, a file cannot be written, or there are no threads to be had.
    pub fn render(&self) -> Result<()> {
        let names = if self.scenes.is_empty() {
            scenes::names().map(String::from).to_vec()
        } else {
            self.scenes.clone()
        };
        prepare(&self.directory)?;
        let pool = ThreadPoolBuilder::new()
            .num_threads(self.threads.unwrap_or_default())
            .build()
            .context("cannot start the threads")?;
        say(&self.header(&pool))?;

        let bar = progress_bar(u64::from(self.size) * names.len() as u64);
        for name in names {
            let scene =
                scenes::by_name(&name).with_context(|| format!("there is no scene {name}: there are {}", scenes::names().join(", ")))?;
            bar.set_message(scene.title);
            let begin = Instant::now();
            let picture = pool.install(|| render(&scene, self.size, || bar.inc(1)))?;
            let path = self.directory.join(scene.name).with_extension("png");
            write_png(&picture.image, &path)?;
            let line = row(&scene, &picture, begin.elapsed().as_secs_f64(), &path)?;
            bar.suspend(|| say(&line))?;
        }
        bar.finish_and_clear();
        Ok(())
    }

    /// What the numbers of the table mean, and its head.
    fn header(&self, pool: &ThreadPool) -> String {
        format!(
            "Scalar f32, every ray against every leaf. {size} x {size} pixels, threads: {threads}.\n\
             ns/ray: what one thread spends on a primary ray (making and casting it, with normal; no light), their time added up over all pixels.\n\
             sweeps: walks over the program per ray, on average and at most. seconds: the whole picture, with light, shadows and file.\n\
             {:<9} {:>6} {:>9} {:>9} {:>7} {:>6} {:>8}  {}",
            "scene",
            "leaves",
            "hits",
            "ns/ray",
            "sweeps",
            "most",
            "seconds",
            "file",
            size = self.size,
            threads = pool.current_num_threads(),
        )
    }
}

/// The line of the table about a picture.
fn row(scene: &Scene, picture: &Picture, seconds: f64, path: &Path) -> Result<String> {
    let tally = picture.tally;
    Ok(format!(
        "{:<9} {:>6} {:>9} {:>9.1} {:>7.2} {:>6} {:>8.2}  {}",
        scene.name,
        scene.program()?.leaves(),
        tally.hits,
        tally.nanoseconds_per_ray(),
        tally.mean_sweeps(),
        tally.most_sweeps,
        seconds,
        path.display()
    ))
}

/// A bar over the rows of all pictures.
fn progress_bar(rows: u64) -> ProgressBar {
    let bar = ProgressBar::new(rows);
    // A template that does not parse would only cost the looks.
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed}  {msg}") {
        bar.set_style(style);
    }
    bar
}
