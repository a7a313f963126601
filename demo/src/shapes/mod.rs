//! A picture of every shape there is: all on one sheet, and each by itself for its documentation.

mod caption;
mod exhibit;

pub use exhibit::{Exhibit, all};

use crate::output::{prepare, say, write_png};
use crate::render::render;
use crate::sheet::{halved, side_by_side};
use anyhow::{Context, Result};
use base64::prelude::{BASE64_STANDARD, Engine};
use caption::captioned;
use gsdf_simd::Level;
use image::{RgbImage, imageops};
use rayon::ThreadPoolBuilder;
use std::fs;
use std::path::{Path, PathBuf};

/// The pixels across a picture in the documentation; it is three quarters as high.
const IN_DOCUMENTATION: u32 = 160;

/// The sheet of all shapes, and where it goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Shapes {
    /// The pixels across each picture; the sheet's are half as wide.
    pub size: u32,
    /// The file of the sheet.
    pub sheet: PathBuf,
    /// The directory of a small picture of each shape, as a PNG file and as Markdown that holds it; `None` for none.
    pub each: Option<PathBuf>,
    /// The number of threads; `None` for as many as there are cores.
    pub threads: Option<usize>,
    /// The level at which primary rays are cast.
    pub level: Level,
}

impl Shapes {
    /// Renders it, and says where it is on standard output.
    ///
    /// # Errors
    /// Where a file cannot be written, or there are no threads to be had.
    pub fn render(&self) -> Result<()> {
        let of_sheet = self.sheet.parent().filter(|path| !path.as_os_str().is_empty());
        for directory in [of_sheet.unwrap_or(Path::new(".")).into(), self.each.clone().unwrap_or(".".into())] {
            prepare(&directory)?;
        }
        let pool = ThreadPoolBuilder::new()
            .num_threads(self.threads.unwrap_or_default())
            .build()
            .context("cannot start the threads")?;
        let exhibits = all();
        let mut tiles = Vec::new();
        for exhibit in &exhibits {
            let tile = pool.install(|| picture(exhibit, self.size, self.level))?;
            tiles.push(captioned(&tile, exhibit.name));
            if let Some(directory) = &self.each {
                let small = few_colours(&pool.install(|| picture(exhibit, 2 * IN_DOCUMENTATION, self.level))?);
                let path = directory.join(exhibit.file_name()).with_extension("png");
                write_png(&small, &path)?;
                let png = fs::read(&path).with_context(|| format!("cannot read {}", path.display()))?;
                let path = path.with_extension("md");
                fs::write(&path, markdown(exhibit.name, &png)).with_context(|| format!("cannot write {}", path.display()))?;
            }
        }
        write_png(&side_by_side(&tiles), &self.sheet)?;
        say(&format!(
            "{} shapes on one sheet, cast at level {}: {}",
            exhibits.len(),
            self.level,
            self.sheet.display()
        ))
    }
}

/// A picture of a shape, three quarters as high as wide: half as wide as `size`, each pixel the mean of four.
///
/// # Errors
/// Where the shape is not a program.
pub fn picture(exhibit: &Exhibit, size: u32, level: Level) -> Result<RgbImage> {
    let square = render(&exhibit.scene()?, size, level, || ())?.image;
    Ok(halved(&imageops::crop_imm(&square, 0, size / 8, size, size - size / 4).to_image()))
}

/// A picture with a few bits of each channel's value, which makes its file small.
fn few_colours(picture: &RgbImage) -> RgbImage {
    const STEP: u32 = 5;
    let mut picture = picture.clone();
    for channel in picture.iter_mut() {
        let level = (u32::from(*channel) + STEP / 2) / STEP;
        *channel = (level * STEP).min(255) as u8;
    }
    picture
}

/// A line of Markdown that shows a PNG file it holds.
fn markdown(name: &str, png: &[u8]) -> String {
    format!(
        "<img alt=\"A picture of the shape: {name}\" width=\"{IN_DOCUMENTATION}\" src=\"data:image/png;base64,{}\">\n",
        BASE64_STANDARD.encode(png)
    )
}

#[cfg(test)]
mod tests {
    use super::{IN_DOCUMENTATION, all, few_colours, markdown, picture};
    use anyhow::{Context, Result};
    use gsdf_nostd::Span;
    use gsdf_simd::Level;
    use std::fs;
    use std::path::Path;

    /// Where the pictures of the documentation lie, and the sources that show them.
    const LIBRARY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../gsdf-nostd");

    #[test]
    fn every_shape_is_in_its_picture_and_whole_if_it_is_bounded() -> Result<()> {
        for exhibit in all() {
            let scene = exhibit.scene()?;
            let (program, raster) = (scene.program()?, scene.camera.raster(64, 64));
            let mut spans = vec![Span::EMPTY; program.leaves()];
            let grounds = u32::from(program.leaves() > exhibit.leaves());
            let (mut seen, mut at_the_edge) = (0, 0);
            // The rows that are left of the square.
            for (x, y) in (8..56).flat_map(|y| (0..64).map(move |x| (x, y))) {
                let hit = program.along(raster.ray(x, y)?, &mut spans)?.cast();
                if hit.is_some_and(|hit| hit.leaf >= grounds) {
                    seen += 1;
                    at_the_edge += u32::from([8, 55].contains(&y) || [0, 63].contains(&x));
                }
            }
            let name = exhibit.name;
            assert!(seen > 64 * 48 / 20, "{name}: {seen} pixels");
            assert_eq!(at_the_edge == 0, exhibit.bounds.is_some(), "{name}: {at_the_edge} pixels");
        }
        Ok(())
    }

    #[test]
    fn the_documentation_shows_every_shape_as_it_is() -> Result<()> {
        let mut sources = String::new();
        for folder in ["leaf", "shape"] {
            for entry in fs::read_dir(Path::new(LIBRARY).join("src").join(folder))? {
                sources += &fs::read_to_string(entry?.path())?;
            }
        }
        let pictures = Path::new(LIBRARY).join("pictures");
        for exhibit in all() {
            let (name, file) = (exhibit.name, exhibit.file_name());
            assert!(sources.contains(&format!("pictures/{file}.md")), "{name} is not shown");
            let path = pictures.join(&file).with_extension("png");
            let png = fs::read(&path).with_context(|| path.display().to_string())?;
            let kept = image::load_from_memory(&png)?.to_rgb8();
            assert!(
                kept == few_colours(&picture(&exhibit, 2 * IN_DOCUMENTATION, Level::best())?),
                "{name}: not the picture of today"
            );
            let held = fs::read_to_string(path.with_extension("md"))?;
            assert_eq!(held, markdown(name, &png), "{name}");
            assert!(held.len() < 8192, "{name}: {} bytes", held.len());
        }
        assert_eq!(fs::read_dir(pictures)?.count(), 2 * all().len(), "a picture of nothing");
        Ok(())
    }
}
