//! `gsdf render`: a picture of a model, in colours or as data.

pub mod alone;
pub mod certified;
pub mod data;
pub mod paint;
pub mod view;

use super::size::Size;
use super::tier::Tier;
use super::{ModelFile, Settings};
use crate::frame::Frame;
use crate::model::Model;
use crate::output::{directory_of, encode, prepare, say, write_whole};
use crate::progress::progress_bar;
use alone::Settlements;
use anyhow::{Context, Result, bail};
use clap::{Args, ValueEnum};
use gsdf_simd::{Level, Renderer, Scene};
use gsdf_trade::Solids;
use image::codecs::png::CompressionType;
use image::imageops::flip_horizontal_in_place;
use indicatif::ProgressBar;
use paint::{Painter, Samples};
use rayon::ThreadPoolBuilder;
use serde::Serialize;
use std::path::PathBuf;
use std::time::Instant;
use view::View;

/// What `gsdf render` is told.
#[derive(Args, Clone, Debug, PartialEq)]
pub struct Render {
    /// Which model.
    #[command(flatten)]
    pub model: ModelFile,
    /// From where.
    #[command(flatten)]
    pub view: View,
    /// What of it a pixel shows
    #[arg(long, value_enum, default_value_t, value_name = "WHAT")]
    pub aov: Aov,
    /// In what arithmetic rays are cast. Shadows are always robust, and so are the rays that smooth edges of certified pictures
    #[arg(long, value_enum, default_value_t, value_name = "TIER")]
    pub tier: Tier,
    /// How many rays go through a pixel that differs from its neighbours: 1, 4, 9, 16 and on to 64
    #[arg(long, value_name = "N", default_value = "16")]
    pub samples: Samples,
    /// Sum up in JSON
    #[arg(long)]
    pub json: bool,
}

/// What of a model a pixel shows. All but colours are data: 16 bits for each number, and 0 where a pixel shows nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Aov {
    /// Its colours, in light
    #[default]
    Color,
    /// How far it is along the line of sight: 1 at the nearest, 65535 at the farthest
    Depth,
    /// Its normals: each coordinate from 0 at -1 to 65535 at 1
    Normal,
    /// Its leaves: their numbers, from 1
    Id,
    /// How many sweeps over the program the ray took, where it hit and where it missed
    Sweeps,
}

/// What came of a picture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// The file.
    pub file: PathBuf,
    /// The pixels in a row.
    pub width: u32,
    /// The pixels in a column.
    pub height: u32,
    /// The leaves of the model.
    pub leaves: usize,
    /// The pixels that show something.
    pub hits: u64,
    /// The pixels that more rays went through.
    pub smoothed: u64,
    /// The least distance along the line of sight, if something is seen.
    pub near: Option<f32>,
    /// The greatest one.
    pub far: Option<f32>,
    /// The arithmetic that rays were cast in.
    pub tier: Tier,
    /// How the rays through the middles of the pixels were settled, in the certified tier.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub settled: Option<Settlements>,
    /// What casting one ray through each pixel took, in milliseconds.
    pub cast_ms: f64,
    /// What all took, from reading the model to the written file.
    pub total_ms: f64,
    /// The threads.
    pub threads: usize,
    /// The vectors that rays are cast in where they are cast together.
    pub level: &'static str,
}

/// The pixels along each side if nothing is said.
const SIZE: u32 = 512;

impl Render {
    /// Renders it to a file and sums up on standard output.
    ///
    /// # Errors
    /// Where more is asked than the tier can tell, the model cannot be read, no camera sees it, or the file cannot be written.
    pub fn run(&self, settings: &Settings) -> Result<()> {
        let begin = Instant::now();
        if self.aov == Aov::Sweeps && self.tier == Tier::Certified {
            bail!("--aov sweeps --tier certified: it may take the sweeps of several tiers; take one of the two, or --tier f64");
        }
        let model = self.model.load()?;
        model.solid()?;
        let file = settings.out.clone().unwrap_or_else(|| self.usual_file());
        prepare(directory_of(&file))?;
        let pool = ThreadPoolBuilder::new()
            .num_threads(settings.threads.unwrap_or_default())
            .build()
            .context("cannot start the threads")?;
        let (png, summary) = pool.install(|| self.picture(&model, settings.size.unwrap_or(Size::from(SIZE)), settings.level))?;
        write_whole(&png, &file)?;
        let summary = Summary {
            file,
            total_ms: 1e3 * begin.elapsed().as_secs_f64(),
            ..summary
        };
        say(&if self.json {
            serde_json::to_string_pretty(&summary)?
        } else {
            told(&summary)
        })
    }

    /// The file of a picture: in the current directory, by the name of the model.
    fn usual_file(&self) -> PathBuf {
        let name = self.model.path.file_stem().unwrap_or_default().to_string_lossy();
        let what = self.aov.to_possible_value();
        let what = what.as_ref().map_or("", |value| value.get_name());
        match self.aov {
            Aov::Color => format!("{name}.png").into(),
            _ => format!("{name}-{what}.png").into(),
        }
    }

    /// The picture as a PNG file, and what came of it but for the file.
    fn picture(&self, model: &Model, size: Size, level: Level) -> Result<(Vec<u8>, Summary)> {
        let program = model.solid()?;
        let raster = self.view.raster(model.reach(), size)?;
        let solids = Solids::of(&program)?;
        let solids = solids.program()?;
        let scene = Scene::new(program);
        let mut frame = Frame::new(size.width, size.height);
        // Every row is cast, and then lit.
        let bar = progress_bar(2 * u64::from(size.height));
        let begin = Instant::now();
        let (hits, settled) = match self.tier {
            Tier::Robust => {
                let hits = Renderer::at_level(&scene, raster, level).render(frame.as_target()).hits;
                bar.inc(u64::from(size.height));
                (hits, None)
            }
            Tier::Certified => {
                let (hits, settled) = certified::cast(&mut frame, &scene, raster, level);
                bar.inc(u64::from(size.height));
                (hits, Some(settled))
            }
            tier => (alone::cast(&mut frame, solids, raster, tier, |rows| bar.inc(rows)), None),
        };
        let cast_ms = 1e3 * begin.elapsed().as_secs_f64();
        let depths = data::depths(&frame, size.height);
        let mut smoothed = 0;
        let png = match self.aov {
            Aov::Color => {
                let painter = Painter::new(model, &scene, solids, raster, level, self.tier, self.samples);
                let (image, count) = painter.paint(&frame, &bar);
                smoothed = count;
                seen(image)
            }
            Aov::Depth => seen(data::depth(&frame, size, depths)),
            Aov::Normal => seen(data::normal(&frame, size)),
            Aov::Id => seen(data::id(&frame, size, model.leaves().len())?),
            Aov::Sweeps => seen(data::sweeps(solids, raster, self.tier, |rows| bar.inc(rows))),
        }?;
        finish(&bar);
        let summary = Summary {
            file: PathBuf::new(),
            width: size.width,
            height: size.height,
            leaves: model.leaves().len(),
            hits,
            smoothed,
            near: depths.map(|[near, _]| near),
            far: depths.map(|[_, far]| far),
            tier: self.tier,
            settled,
            cast_ms,
            total_ms: 0.0,
            threads: rayon::current_num_threads(),
            level: level.name(),
        };
        Ok((png, summary))
    }
}

fn finish(bar: &ProgressBar) {
    bar.finish_and_clear();
}

/// A picture as a PNG file, as one sees it: the axes of a camera are left-handed, those of OpenSCAD right-handed.
fn seen<P>(mut image: image::ImageBuffer<P, Vec<P::Subpixel>>) -> Result<Vec<u8>>
where
    P: image::PixelWithColorType + 'static,
    [P::Subpixel]: image::EncodableLayout,
{
    flip_horizontal_in_place(&mut image);
    encode(&image, CompressionType::Fast)
}

/// A summary in a few lines.
fn told(summary: &Summary) -> String {
    let pixels = u64::from(summary.width) * u64::from(summary.height);
    let depths = match (summary.near, summary.far) {
        (Some(near), Some(far)) => format!("near {near}, far {far}"),
        _ => "nothing is seen".to_owned(),
    };
    let settled = summary.settled.map_or_else(String::new, |settled| format!("\n{settled}"));
    let tier = summary.tier.to_possible_value();
    let tier = tier.as_ref().map_or("", |tier| tier.get_name());
    format!(
        "{}: {} x {} pixels of {} leaves in {:.0} ms\n\
         {} of {pixels} pixels hit, {} smoothed; {depths}\n\
         casting one ray per pixel: {:.1} ms, {:.1} ns/pixel (tier: {tier}, threads: {}, level: {}){settled}",
        summary.file.display(),
        summary.width,
        summary.height,
        summary.leaves,
        summary.total_ms,
        summary.hits,
        summary.smoothed,
        summary.cast_ms,
        1e6 * summary.cast_ms / pixels.max(1) as f64,
        summary.threads,
        summary.level,
    )
}
