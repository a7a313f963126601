//! Packets of rays that leave surfaces: the [`Departure`](gsdf_nostd::Departure) of the scalar queries, eight at a time.
//!
//! There is no epsilon: each lane knows the leaf and the face it starts on, where its root is 0 exactly. All that takes is an [`OnSurface`] of lanes.

use crate::frame::{Met, met};
use glam::Vec3;
use gsdf_nostd::{Line, Mask, OnSurface, Program, Ray, Real, Span, Toward, V3, march};
use gsdf_simd::{F32x8, Hits, MOST_LANES, scratch};

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

    fn between(origin: Vec3, point: Vec3, met: Met) -> Self {
        Self {
            point,
            normal: met.normal,
            leaf: met.leaf,
            face: met.face,
            slack: OnSurface::slack(origin, point),
        }
    }
}

/// Sends rays on from places, eight at a time, with the scratch memory that takes.
#[derive(Debug)]
pub struct Leaver<'a> {
    program: Program<'a>,
    spans: Vec<Span<F32x8>>,
}

impl<'a> Leaver<'a> {
    /// For the places on a program's surface.
    #[must_use]
    pub fn new(program: Program<'a>) -> Self {
        Self {
            program,
            spans: scratch(program.leaves()),
        }
    }

    /// Which of these ways, each from a place in a direction of unit length, meet nothing.
    pub fn free<'w>(&'w mut self, ways: &'w [(Place, Vec3)]) -> impl Iterator<Item = bool> + 'w {
        ways.chunks(8).flat_map(|ways| {
            let (line, footing) = lanes(ways);
            self.program.spans_along(&line, footing, &mut self.spans);
            let found = march(self.program.nodes(), &self.spans, F32x8::splat(0.0));
            let blocked = found.t.lt(F32x8::INFINITY).to_bits();
            (0..ways.len()).map(move |lane| blocked >> lane & 1 == 0)
        })
    }

    /// The places to which these ways lead.
    pub fn cast<'w>(&'w mut self, ways: &'w [(Place, Vec3)]) -> impl Iterator<Item = Option<Place>> + 'w {
        ways.chunks(8).flat_map(|ways| {
            let (line, footing) = lanes(ways);
            self.program.spans_along(&line, footing, &mut self.spans);
            let found = march(self.program.nodes(), &self.spans, F32x8::splat(0.0));
            let hit = found.t.lt(F32x8::INFINITY);
            let seen = if hit.any() {
                met(&Hits {
                    t: found.t,
                    hit,
                    met: self.program.surface_at(&line, footing, &self.spans, found.t),
                    sweeps: found.sweeps,
                })
            } else {
                [None; MOST_LANES]
            };
            ways.iter()
                .zip(seen)
                .map(|(&(from, direction), seen)| seen.map(|met| Place::between(from.point, from.point + met.t * direction, met)))
        })
    }
}

/// Up to eight ways as lanes; those beyond the last repeat it.
fn lanes(ways: &[(Place, Vec3)]) -> (Line<F32x8>, OnSurface<F32x8>) {
    let of = |value: &dyn Fn(&(Place, Vec3)) -> f32| F32x8::new(core::array::from_fn(|lane| value(&ways[lane.min(ways.len() - 1)])));
    let vector =
        |value: &dyn Fn(&(Place, Vec3)) -> Vec3| V3::new(of(&|way| value(way).x), of(&|way| value(way).y), of(&|way| value(way).z));
    let line = Line {
        origin: vector(&|way| way.0.point),
        toward: Toward::new(vector(&|way| way.1)),
    };
    let footing = OnSurface {
        leaf: of(&|way| way.0.leaf as f32),
        face: of(&|way| f32::from(way.0.face)),
        slack: of(&|way| way.0.slack),
    };
    (line, footing)
}

#[cfg(test)]
mod tests {
    use super::{Leaver, Place};
    use crate::frame::Met;
    use crate::scenes;
    use anyhow::Result;
    use glam::{Vec3, vec3};
    use gsdf_nostd::{Departure, Hit, Span};

    #[test]
    fn packets_leave_as_single_rays_do() -> Result<()> {
        for scene in [scenes::s2(), scenes::s3(), scenes::snowcone(), scenes::planetary()] {
            let (program, raster) = (scene.program()?, scene.camera.raster(48, 48));
            let mut spans = vec![Span::EMPTY; program.leaves()];
            let (mut ways, mut expected) = (Vec::new(), Vec::<Option<Hit>>::new());
            for pixel in 0..48 * 48 {
                let ray = raster.ray(pixel % 48, pixel / 48)?;
                let Some(hit) = program.along(ray, &mut spans)?.cast() else {
                    continue;
                };
                let met = Met {
                    t: hit.t,
                    normal: hit.normal,
                    leaf: hit.leaf,
                    face: hit.face,
                };
                // Up, and back to where the ray came from, a little aside.
                for direction in [Vec3::Y, vec3(0.05, 0.02, -0.01) - ray.direction()] {
                    let direction = direction.normalize();
                    ways.push((Place::on(&ray, met), direction));
                    expected.push(program.along(Departure::new(&hit, direction)?, &mut spans)?.cast());
                }
            }
            assert!(ways.len() > 1000 && ways.len() % 8 != 1);
            let mut leaver = Leaver::new(program);
            let free: Vec<_> = leaver.free(&ways).collect();
            assert_eq!(free, expected.iter().map(Option::is_none).collect::<Vec<_>>(), "{}", scene.name);
            for (place, hit) in leaver.cast(&ways).zip(&expected) {
                assert_eq!(place.map(|place| place.leaf), hit.map(|hit| hit.leaf), "{}", scene.name);
            }
        }
        Ok(())
    }
}
