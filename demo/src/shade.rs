//! From places to colours, many places at a time, so that the rays that go on from them are cast together.

use crate::batch::{Batch, Place};
use crate::light::{Light, turn};
use crate::scenes::Look;
use glam::Vec3;
use gsdf_nostd::Leaf;
use gsdf_simd::Caster;

/// What one line of sight sees.
#[derive(Clone, Copy, Debug)]
pub struct Sample {
    /// The unit vector in which one looks.
    pub view: Vec3,
    /// How far it is to what is seen.
    pub distance: f32,
    /// What is seen, if not the background.
    pub place: Option<Place>,
    /// What is seen without it.
    pub behind: Vec3,
    /// What sets this sample apart from its neighbours.
    pub seed: u32,
}

/// Lights samples of one scene.
pub struct Shader<'c> {
    caster: &'c Caster<'c, 'c, Leaf>,
    look: Look,
    /// Rays that go on from places.
    ways: Batch,
    /// For each of the rays, whose it is and what it brings if it is free.
    brings: Vec<(usize, Vec3)>,
}

impl<'c> Shader<'c> {
    /// For samples of the scene that rays are cast at, which looks so.
    #[must_use]
    pub fn new(caster: &'c Caster<'c, 'c, Leaf>, look: Look) -> Self {
        Self {
            caster,
            look,
            ways: Batch::default(),
            brings: Vec::new(),
        }
    }

    /// The linear colours of samples. Where `share` of them make one pixel each of them sends so many times fewer rays to an extended light.
    #[must_use]
    pub fn shade(&mut self, samples: &[Sample], share: u32) -> Vec<Vec3> {
        let light = self.look.light;
        let mut colours = self.diffuse(samples, light.lamp_rays.div_ceil(share), light.sky_rays.div_ceil(share));
        self.mirror(samples, &mut colours);
        for (sample, colour) in samples.iter().zip(&mut colours) {
            *colour = self.through_haze(sample, *colour);
        }
        colours
    }

    /// What comes back from the places themselves, and the glint of the lamp on them.
    fn diffuse(&mut self, samples: &[Sample], lamp_rays: u32, sky_rays: u32) -> Vec<Vec3> {
        // Where no sky is seen there is some other surface, which is not black either.
        let unasked = if sky_rays == 0 { 1.0 } else { BOUNCE };
        let mut colours: Vec<_> = (samples.iter())
            .map(|sample| sample.place.map_or(Vec3::ZERO, |place| self.ambient(&place) * unasked))
            .collect();
        // The rays to a lamp go about the same way, and are cast together; those to the sky would only be among them.
        self.add_lamp(samples, lamp_rays, &mut colours);
        self.add_sky(samples, sky_rays, &mut colours);
        colours
    }

    /// What comes from all around to a place that sees all of it.
    fn ambient(&self, place: &Place) -> Vec3 {
        let dull = 1.0 - (self.look.mirror)(place.leaf);
        (self.look.paint)(place.leaf) * self.look.light.ambient(place.normal) * dull
    }

    fn add_lamp(&mut self, samples: &[Sample], rays: u32, colours: &mut [Vec3]) {
        let light = self.look.light;
        for (number, sample) in samples.iter().enumerate() {
            let Some(place) = &sample.place else { continue };
            let albedo = (self.look.paint)(place.leaf);
            let dull = 1.0 - (self.look.mirror)(place.leaf);
            for way in light.to_lamp(rays, turn(sample.seed)) {
                if let Some(brings) = light.from_lamp(albedo, dull, place.normal, way, sample.view) {
                    self.ways.leave(place, way);
                    self.brings.push((number, brings / rays as f32));
                }
            }
        }
        self.add_free(colours);
    }

    fn add_sky(&mut self, samples: &[Sample], rays: u32, colours: &mut [Vec3]) {
        for (number, sample) in samples.iter().enumerate() {
            let Some(place) = &sample.place else { continue };
            let ambient = self.ambient(place);
            for way in Light::to_sky(place.normal, rays, -turn(sample.seed)) {
                self.ways.leave(place, way);
                self.brings.push((number, ambient * (1.0 - BOUNCE) / rays as f32));
            }
        }
        self.add_free(colours);
    }

    /// Adds what those of the rays bring that meet nothing, and forgets them all.
    fn add_free(&mut self, colours: &mut [Vec3]) {
        for (blocked, (number, brings)) in self.ways.any(self.caster).into_iter().zip(&self.brings) {
            if !blocked {
                colours[*number] += *brings;
            }
        }
        self.ways.clear();
        self.brings.clear();
    }

    /// Adds what places that mirror show of the others, and of the room.
    fn mirror(&mut self, samples: &[Sample], colours: &mut [Vec3]) {
        let mut whose = Vec::new();
        for (number, sample) in samples.iter().enumerate() {
            let Some(place) = sample.place else { continue };
            let strength = (self.look.mirror)(place.leaf);
            if strength > 0.0 {
                let way = sample.view.reflect(place.normal).normalize();
                self.ways.leave(&place, way);
                whose.push((number, place.point, way, strength));
            }
        }
        let met = self.ways.cast(self.caster);
        self.ways.clear();
        let seen: Vec<_> = (met.into_iter().zip(&whose))
            .map(|(met, &(number, from, view, _))| {
                let place = met.map(|met| Place::between(from, from + met.t * view, met));
                Sample {
                    view,
                    distance: place.map_or(0.0, |place| place.point.distance(from)),
                    place,
                    behind: self.look.light.around(view),
                    seed: samples[number].seed.wrapping_add(0x5bd1_e995),
                }
            })
            .collect();
        let few = |rays: u32| rays.div_ceil(8);
        let shown = self.diffuse(&seen, few(self.look.light.lamp_rays), few(self.look.light.sky_rays));
        for ((sample, shown), (number, _, _, strength)) in seen.iter().zip(shown).zip(whose) {
            let Some(place) = samples[number].place else { continue };
            // Metals tint what they mirror, the less the flatter one looks at them.
            let flat = (1.0 + place.normal.dot(samples[number].view)).clamp(0.0, 1.0).powi(5);
            let tint = (self.look.paint)(place.leaf).lerp(Vec3::ONE, flat);
            colours[number] += strength * tint * self.through_haze(sample, shown);
        }
    }

    /// What is left of a colour at a distance.
    fn through_haze(&self, sample: &Sample, colour: Vec3) -> Vec3 {
        if sample.place.is_none() {
            return sample.behind;
        }
        let distance = sample.distance / self.look.haze;
        sample.behind.lerp(colour, (-distance * distance).exp())
    }
}

/// The part of the sky's light that reaches places which see nothing of it.
const BOUNCE: f32 = 0.22;

#[cfg(test)]
mod tests {
    use super::{Sample, Shader};
    use crate::batch::Place;
    use crate::light::Light;
    use crate::scenes::s1;
    use anyhow::{Context, Result};
    use glam::{Vec3, vec3};
    use gsdf_nostd::{Ray, Span};
    use gsdf_simd::{Caster, Scene};

    #[test]
    fn the_ball_throws_its_shadow_away_from_the_sun_and_none_on_its_lit_side() -> Result<()> {
        let scene = s1();
        let program = scene.program()?;
        let mut spans = vec![Span::EMPTY; program.leaves()];
        let prepared = Scene::new(program);
        let caster = Caster::new(&prepared);
        let mut shader = Shader::new(&caster, scene.look);
        let mut brightness = |from: Vec3, to: Vec3| {
            let ray = Ray::new(from, to - from)?;
            let hit = program.along(ray, &mut spans)?.cast().context("a miss")?;
            let sample = Sample {
                view: ray.direction().normalize(),
                distance: 0.0,
                place: Some(Place::on(&ray, hit.into())),
                behind: Vec3::ZERO,
                seed: 0,
            };
            anyhow::Ok(shader.shade(&[sample], 1)[0].element_sum())
        };
        let sun = Light::OUTDOORS.toward;
        let ball = vec3(0.0, 1.0, 0.0);
        let shadow = ball - sun / sun.y;
        let dark = brightness(shadow + vec3(-2.0, 1.0, 0.0), shadow)?;
        let lit = brightness(vec3(5.0, 5.0, -5.0), vec3(3.0, 0.0, 0.0))?;
        assert!(lit > 2.0 * dark, "{lit} {dark}");
        let towards = brightness(ball + 4.0 * sun, ball)?;
        let away = brightness(ball - 1.2 * sun, ball)?;
        assert!(towards > 2.0 * away, "{towards} {away}");
        Ok(())
    }

    #[test]
    fn without_a_place_there_is_the_background() -> Result<()> {
        let scene = s1();
        let sample = Sample {
            view: Vec3::Y,
            distance: 0.0,
            place: None,
            behind: vec3(0.1, 0.2, 0.3),
            seed: 0,
        };
        let prepared = Scene::new(scene.program()?);
        let caster = Caster::new(&prepared);
        assert_eq!(Shader::new(&caster, scene.look).shade(&[sample], 1), [sample.behind]);
        Ok(())
    }
}
