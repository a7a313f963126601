//! A model in the light of a lamp over the camera's shoulder, with its own colours, and smooth where pixels differ.

use crate::batch::{Batch, Place};
use crate::commands::tier::{Alone, Tier};
use crate::edges::{Row, bytes, grid};
use crate::frame::{Frame, Met};
use crate::light::Light;
use crate::model::Model;
use crate::palette::{SAND, to_srgb};
use core::ops::Range;
use core::str::FromStr;
use glam::{Vec3, vec3};
use gsdf_nostd::{Program, Raster, Ray};
use gsdf_simd::{Caster, Level, Scene};
use gsdf_trade::Primitive;
use image::RgbImage;
use indicatif::ProgressBar;
use rayon::prelude::*;

/// How many rays go through a pixel that differs from its neighbours: the square of this number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Samples(u32);

impl FromStr for Samples {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let side = (1..=8).find(|side: &u32| text.parse() == Ok(side * side));
        side.map(Self)
            .ok_or_else(|| "it is a square: 1, 4, 9, 16, 25, 36, 49 or 64".to_owned())
    }
}

/// The colours of what a model does not paint.
const UNPAINTED: Vec3 = SAND;

/// Over the camera's left shoulder: to its right, up and back. Of a box that is framed front, side and top get three different
/// lights.
const TO_LAMP: Vec3 = vec3(-0.12, 0.55, 0.8);

/// How many rows are lit at a time: enough for all threads, and little memory.
const ROWS: u32 = 64;

/// Paints pictures of a model.
pub struct Painter<'m> {
    colours: Vec<Vec3>,
    solids: Program<'m, Primitive>,
    caster: Caster<'m, 'm, gsdf_nostd::Leaf>,
    tier: Tier,
    raster: Raster,
    light: Light,
    samples: Samples,
}

/// What a ray that goes through the picture meets.
struct Sight {
    ray: Ray,
    met: Option<Met>,
    /// The place in the picture from its top, from 0 to 1.
    height: f32,
}

impl<'m> Painter<'m> {
    /// For pictures of a model, as this raster sees it, with its rays cast in a tier; `solids` are the program of its scene.
    #[must_use]
    pub fn new(
        model: &Model,
        scene: &'m Scene<'m, gsdf_nostd::Leaf>,
        solids: Program<'m, Primitive>,
        raster: Raster,
        level: Level,
        tier: Tier,
        samples: Samples,
    ) -> Self {
        let camera = raster.camera();
        // The camera's own right is on the left in a picture of right-handed axes.
        let toward = -TO_LAMP.x * camera.right() + TO_LAMP.y * camera.up() - TO_LAMP.z * camera.forward();
        Self {
            colours: model.leaves().iter().map(|leaf| leaf.colour.unwrap_or(UNPAINTED)).collect(),
            solids,
            caster: Caster::at_level(scene, level),
            tier,
            raster,
            light: Light {
                toward: toward.normalize(),
                ..Light::OUTDOORS
            },
            samples,
        }
    }

    /// The picture of what the pixels met, and how many of them more rays went through. Every finished row is told.
    #[must_use]
    pub fn paint(&self, frame: &Frame, bar: &ProgressBar) -> (RgbImage, u64) {
        let (width, height) = (self.raster.width(), self.raster.height());
        let bands = || (0..height).step_by(ROWS as usize).map(|top| top..(top + ROWS).min(height));
        let mut rows: Vec<Vec<[u8; 3]>> = Vec::with_capacity(height as usize);
        for band in bands() {
            let colours = self.shade(&self.sights(frame, band.clone()));
            rows.extend(colours.chunks(width as usize).map(bytes));
            bar.inc(u64::from(band.end - band.start));
        }
        let mut image = RgbImage::from_fn(width, height, |x, y| image::Rgb(rows[y as usize][x as usize]));
        if self.samples.0 == 1 {
            return (image, 0);
        }
        let row = |y: u32| rows.get(y as usize).map(|bytes| Row { met: frame.row(y), bytes });
        let edges_of = |y: u32| -> Vec<[u32; 2]> {
            let around: Vec<_> = [y.wrapping_sub(1), y + 1].into_iter().filter_map(row).collect();
            row(y).map_or(Vec::new(), |here| here.edges(&around).map(|x| [x as u32, y]).collect())
        };
        let mut smoothed = 0;
        for band in bands() {
            let edges: Vec<[u32; 2]> = band.into_par_iter().flat_map_iter(edges_of).collect();
            for ([x, y], colour) in edges.iter().zip(self.smooth(&edges)) {
                image.put_pixel(*x, *y, image::Rgb(to_srgb(colour)));
            }
            smoothed += edges.len() as u64;
        }
        (image, smoothed)
    }

    /// What the rays through the middles of some rows' pixels meet.
    fn sights(&self, frame: &Frame, rows: Range<u32>) -> Vec<Option<Sight>> {
        let of_row = |y: u32| {
            let seen = frame.row(y).iter().zip(0..);
            seen.map(move |(met, x)| self.sight([x as f32 + 0.5, y as f32 + 0.5], *met))
        };
        rows.into_par_iter().flat_map_iter(of_row).collect()
    }

    fn sight(&self, [x, y]: [f32; 2], met: Option<Met>) -> Option<Sight> {
        let ray = self.raster.ray_through(x, y).ok()?;
        let height = y / self.raster.height() as f32;
        Some(Sight { ray, met, height })
    }

    /// The colours of some pixels, each the mean of many rays.
    fn smooth(&self, pixels: &[[u32; 2]]) -> Vec<Vec3> {
        let places: Vec<[f32; 2]> = pixels
            .iter()
            .flat_map(|[x, y]| grid(self.samples.0).map(move |[right, down]| [*x as f32 + right, *y as f32 + down]))
            .collect();
        let mut sights: Vec<Option<Sight>> = places.into_par_iter().map(|place| self.sight(place, None)).collect();
        self.meet(&mut sights);
        let colours = self.shade(&sights);
        let share = (self.samples.0 * self.samples.0) as usize;
        // What is brighter than the picture can show must not outshine the rest of its pixel.
        let mean = |colours: &[Vec3]| colours.iter().map(|colour| colour.clamp(Vec3::ZERO, Vec3::ONE)).sum::<Vec3>() / share as f32;
        colours.chunks(share).map(mean).collect()
    }

    /// Finds what some rays meet.
    fn meet(&self, sights: &mut [Option<Sight>]) {
        if !matches!(self.tier, Tier::Robust | Tier::Certified) {
            sights.par_iter_mut().flatten().for_each_init(
                || Alone::new(self.solids, self.tier),
                |alone, sight| sight.met = alone.first(&sight.ray).0.map(|crossing| crossing.hit.into()),
            );
            return;
        }
        let mut rays = Batch::default();
        for sight in &*sights {
            match sight {
                Some(sight) => rays.push(sight.ray.origin(), sight.ray.direction()),
                None => rays.push(Vec3::ZERO, Vec3::ZERO),
            }
        }
        for (sight, met) in sights.iter_mut().zip(rays.cast(&self.caster)) {
            if let Some(sight) = sight {
                sight.met = met;
            }
        }
    }

    /// The linear colours of what is seen.
    fn shade(&self, sights: &[Option<Sight>]) -> Vec<Vec3> {
        let lit: Vec<Option<(Place, Vec3)>> = sights
            .par_iter()
            .map(|sight| sight.as_ref().and_then(|sight| self.lit(sight)))
            .collect();
        let mut rays = Batch::default();
        for (place, _) in lit.iter().flatten() {
            rays.leave(place, self.light.toward);
        }
        let mut shaded = rays.any(&self.caster).into_iter();
        let colour = |(sight, lit): (&Option<Sight>, &Option<(Place, Vec3)>)| {
            let from_lamp = match lit {
                Some((_, brings)) if shaded.next() == Some(false) => *brings,
                _ => Vec3::ZERO,
            };
            let Some(sight) = sight else { return self.light.behind(0.5) };
            match sight.met {
                Some(met) => from_lamp + self.colour(&met) * self.ambient(met.normal),
                None => self.light.behind(sight.height),
            }
        };
        sights.iter().zip(&lit).map(colour).collect()
    }

    /// The place that sees the lamp, and what that brings if nothing is in between; `None` where it faces away.
    fn lit(&self, sight: &Sight) -> Option<(Place, Vec3)> {
        let met = sight.met?;
        let (way, view) = (self.light.toward, sight.ray.direction().normalize());
        let brings = self.light.from_lamp(self.colour(&met), 1.0, met.normal, way, view)?;
        Some((Place::on(&sight.ray, met), brings))
    }

    fn colour(&self, met: &Met) -> Vec3 {
        self.colours.get(met.leaf as usize).copied().unwrap_or(UNPAINTED)
    }

    /// What comes from all around: the sky is where z leads.
    fn ambient(&self, normal: Vec3) -> Vec3 {
        self.light.ambient(vec3(normal.x, normal.z, -normal.y))
    }
}
