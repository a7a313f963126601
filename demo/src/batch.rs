//! Rays that are cast together, in arrays: from anywhere, or on from the surfaces that earlier ones have met.

use crate::frame::Met;
use glam::Vec3;
use gsdf_nostd::{Leaf, OnSurface, Ray};
use gsdf_simd::{Caster, Leaving, Pixel, RayHits, Rays};

/// A place on a surface.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Where it is.
    pub point: Vec3,
    /// The unit normal, outward from the solid.
    pub normal: Vec3,
    /// The leaf whose surface it is.
    pub leaf: u32,
    /// The face of that leaf.
    pub face: u8,
    /// How far the point may be off the surface by rounding alone.
    slack: f32,
}

impl Place {
    /// Where the ray meets what it meets.
    #[must_use]
    pub fn on(ray: &Ray, met: Met) -> Self {
        Self::between(ray.origin(), ray.at(met.t), met)
    }

    /// The point at which a ray from an origin meets what it meets.
    #[must_use]
    pub fn between(origin: Vec3, point: Vec3, met: Met) -> Self {
        Self {
            point,
            normal: met.normal,
            leaf: met.leaf,
            face: met.face,
            slack: OnSurface::slack(origin, point),
        }
    }
}

/// Rays in arrays. Either all of them leave places, or none does.
///
/// There is no epsilon: one that leaves a place knows the leaf and the face it starts on, where its root is 0 exactly.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    origin: [Vec<f32>; 3],
    direction: [Vec<f32>; 3],
    leaf: Vec<u32>,
    face: Vec<u32>,
    slack: Vec<f32>,
}

impl Batch {
    /// Adds a ray that starts anywhere; none where the direction is zero.
    pub fn push(&mut self, origin: Vec3, direction: Vec3) {
        for axis in 0..3 {
            self.origin[axis].push(origin[axis]);
            self.direction[axis].push(direction[axis]);
        }
    }

    /// Adds a ray that leaves a place.
    pub fn leave(&mut self, place: &Place, direction: Vec3) {
        self.push(place.point, direction);
        self.leaf.push(place.leaf);
        self.face.push(place.face.into());
        self.slack.push(place.slack);
    }

    /// Forgets all rays, and keeps the memory.
    pub fn clear(&mut self) {
        self.origin.iter_mut().chain(&mut self.direction).for_each(Vec::clear);
        self.leaf.clear();
        self.face.clear();
        self.slack.clear();
    }

    fn rays(&self) -> Rays<'_> {
        let leaving = (!self.leaf.is_empty()).then_some(Leaving {
            leaf: &self.leaf,
            face: &self.face,
            slack: &self.slack,
        });
        Rays {
            leaving,
            ..Rays::new(
                self.origin.each_ref().map(Vec::as_slice),
                self.direction.each_ref().map(Vec::as_slice),
            )
        }
    }

    /// Whether each of them meets something.
    #[must_use]
    pub fn any(&self, caster: &Caster<'_, '_, Leaf>) -> Vec<bool> {
        let mut hits = vec![false; self.rays().len()];
        // All slices are equally long.
        let _ = caster.any(&self.rays(), &mut hits);
        hits
    }

    /// What each of them meets first.
    #[must_use]
    pub fn cast(&self, caster: &Caster<'_, '_, Leaf>) -> Vec<Option<Met>> {
        let count = self.rays().len();
        let mut distance = vec![0.0; count];
        let (mut leaf, mut face) = (vec![0; count], vec![0; count]);
        let [mut x, mut y, mut z] = core::array::from_fn(|_| vec![0.0; count]);
        let hits = RayHits {
            distance: &mut distance,
            normal: Some([&mut x, &mut y, &mut z]),
            leaf: Some(&mut leaf),
            face: Some(&mut face),
        };
        // All slices are equally long.
        let _ = caster.cast(&self.rays(), hits);
        let met = |number: usize| {
            (leaf[number] != Pixel::NO_LEAF).then(|| Met {
                t: distance[number],
                normal: Vec3::new(x[number], y[number], z[number]),
                leaf: leaf[number],
                face: face[number] as u8,
            })
        };
        (0..count).map(met).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Batch, Place};
    use crate::frame::Met;
    use crate::scenes;
    use anyhow::Result;
    use glam::{Vec3, vec3};
    use gsdf_nostd::{Departure, Hit, Span};
    use gsdf_simd::{Caster, Scene};

    #[test]
    fn rays_leave_together_as_they_do_alone() -> Result<()> {
        for scene in [scenes::s2(), scenes::s3(), scenes::snowcone(), scenes::planetary()] {
            let (program, raster) = (scene.program()?, scene.camera.raster(48, 48));
            let mut spans = vec![Span::EMPTY; program.leaves()];
            let (mut batch, mut expected) = (Batch::default(), Vec::<Option<Hit>>::new());
            for pixel in 0..48 * 48 {
                let ray = raster.ray(pixel % 48, pixel / 48)?;
                let Some(hit) = program.along(ray, &mut spans)?.cast() else {
                    continue;
                };
                // Up, and back to where the ray came from, a little aside.
                for direction in [Vec3::Y, vec3(0.05, 0.02, -0.01) - ray.direction()] {
                    let direction = direction.normalize();
                    batch.leave(&Place::on(&ray, hit.into()), direction);
                    expected.push(program.along(Departure::new(&hit, direction)?, &mut spans)?.cast());
                }
            }
            assert!(expected.len() > 1000);
            let prepared = Scene::new(program);
            let caster = Caster::new(&prepared);
            let any = batch.any(&caster);
            assert_eq!(any, expected.iter().map(Option::is_some).collect::<Vec<_>>(), "{}", scene.name);
            for (met, hit) in batch.cast(&caster).into_iter().zip(&expected) {
                assert_eq!(met, hit.map(Met::from), "{}", scene.name);
            }
        }
        Ok(())
    }
}
