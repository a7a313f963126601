//! The gallery: scene after scene to its file, with a table of what each took, and all of them on one sheet.

use crate::output::{prepare, say, write_png};
use crate::progress::progress_bar;
use crate::render::{Picture, render, steps};
use crate::scenes::{self, Scene};
use crate::sheet::sheet;
use anyhow::{Context, Result};
use gsdf_simd::Level;
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
    /// The directory of the pictures, which is made if need be; without one they only go on the sheet.
    pub directory: Option<PathBuf>,
    /// The file of the sheet, on which the pictures are half as wide.
    pub sheet: Option<PathBuf>,
    /// The number of threads; `None` for as many as there are cores.
    pub threads: Option<usize>,
    /// The level at which primary rays are cast.
    pub level: Level,
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
        for directory in self.directories() {
            prepare(directory)?;
        }
        let pool = ThreadPoolBuilder::new()
            .num_threads(self.threads.unwrap_or_default())
            .build()
            .context("cannot start the threads")?;
        say(&self.header(&pool))?;

        let begin = Instant::now();
        let bar = progress_bar(steps(self.size) * names.len() as u64);
        let mut pictures = Vec::new();
        for name in names {
            let scene =
                scenes::by_name(&name).with_context(|| format!("there is no scene {name}: there are {}", scenes::names().join(", ")))?;
            bar.set_message(scene.title);
            let begin = Instant::now();
            let picture = pool.install(|| render(&scene, self.size, self.level, || bar.inc(1)))?;
            let path = self
                .directory
                .as_ref()
                .map(|directory| directory.join(scene.name).with_extension("png"));
            if let Some(path) = &path {
                write_png(&picture.image, path)?;
            }
            let line = row(&scene, &picture, begin.elapsed().as_secs_f64(), path.as_deref())?;
            bar.suspend(|| say(&line))?;
            if self.sheet.is_some() {
                pictures.push(picture.image);
            }
        }
        bar.finish_and_clear();
        let mut closing = format!("{:.1} s", begin.elapsed().as_secs_f64());
        if let Some(path) = &self.sheet {
            write_png(&sheet(&pictures), path)?;
            closing += &format!("; all on one sheet: {}", path.display());
        }
        say(&closing)
    }

    /// The directories that are written to.
    fn directories(&self) -> impl Iterator<Item = &Path> {
        let of_sheet = self.sheet.as_deref().and_then(Path::parent);
        // The parent of a bare file name is empty, and means the current directory.
        let of_sheet = of_sheet.map(|path| if path.as_os_str().is_empty() { Path::new(".") } else { path });
        self.directory.as_deref().into_iter().chain(of_sheet)
    }

    /// What the numbers of the table mean, and its head.
    fn header(&self, pool: &ThreadPool) -> String {
        format!(
            "{size} x {size} pixels, threads: {threads}, level: {level}. Packets of {lanes} f32 rays, at the scene as it was prepared.\n\
             ns/pixel: casting one ray per pixel, with normal and leaf but no light, from the first pixel to the last on all threads; the\n\
             least of the repeats that fit into 0.2 s. thread: the same times the threads, what a pixel costs one of them.\n\
             sweeps: walks over the whole program, on average and at most, of every fourth ray of every fourth row. seconds: the whole picture, with light and smooth edges.\n\
             {:<9} {:>6} {:>9} {:>9} {:>9} {:>7} {:>6} {:>8}  {}",
            "scene",
            "leaves",
            "hits",
            "ns/pixel",
            "thread",
            "sweeps",
            "most",
            "seconds",
            if self.directory.is_some() { "file" } else { "" },
            size = self.size,
            threads = pool.current_num_threads(),
            level = self.level,
            lanes = self.level.lanes(),
        )
        .trim_end()
        .to_owned()
    }
}

/// The line of the table about a picture.
fn row(scene: &Scene, picture: &Picture, seconds: f64, path: Option<&Path>) -> Result<String> {
    let cost = picture.cost;
    let line = format!(
        "{:<9} {:>6} {:>9} {:>9.1} {:>9.1} {:>7.2} {:>6} {:>8.2}  {}",
        scene.name,
        scene.program()?.leaves(),
        cost.hits,
        cost.nanoseconds(),
        cost.nanoseconds() * cost.threads as f64,
        cost.sweeps.mean(),
        cost.sweeps.most,
        seconds,
        path.unwrap_or(Path::new("")).display()
    );
    Ok(line.trim_end().to_owned())
}
