//! Where the light comes from: a lamp with or without an extent, and all that surrounds the scene.

use core::f32::consts::{PI, TAU};
use glam::{Vec3, vec3};

/// The light on a scene, all of it from infinitely far away.
#[derive(Clone, Copy, Debug)]
pub struct Light {
    /// Towards the middle of the lamp; of unit length.
    pub toward: Vec3,
    /// What the lamp gives to a surface that meets it squarely.
    pub lamp: Vec3,
    /// The radius of the lamp as seen from a distance of one. With 0 its shadows are hard.
    pub extent: f32,
    /// How many rays go to the lamp from each place.
    pub lamp_rays: u32,
    /// What the sky gives to a surface that faces up.
    pub sky: Vec3,
    /// What the ground throws back to a surface that faces down.
    pub ground: Vec3,
    /// How many rays ask, from each place, how much of the sky it sees. With 0 it sees all of it.
    pub sky_rays: u32,
    /// How strong the glint of the lamp is, and how narrow.
    pub glint: (f32, i32),
    /// The background at the top of the picture, and at the bottom.
    pub backdrop: [Vec3; 2],
}

impl Light {
    /// One sun with hard shadows, over the right shoulder of the cameras, so that three faces of a box get three different lights.
    pub const OUTDOORS: Self = Self {
        toward: vec3(0.56, 0.74, -0.372_6),
        lamp: vec3(0.92, 0.85, 0.74),
        extent: 0.0,
        lamp_rays: 1,
        sky: vec3(0.24, 0.29, 0.36),
        ground: vec3(0.12, 0.11, 0.10),
        sky_rays: 0,
        glint: (0.14, 90),
        backdrop: [vec3(0.22, 0.34, 0.48), vec3(0.78, 0.79, 0.77)],
    };

    /// A large warm lamp from the left, in a pale room.
    pub const STUDIO: Self = Self {
        toward: vec3(-0.48, 0.8, -0.36),
        lamp: vec3(1.12, 0.96, 0.76),
        extent: 0.18,
        lamp_rays: 24,
        sky: vec3(0.27, 0.29, 0.33),
        ground: vec3(0.16, 0.12, 0.09),
        sky_rays: 16,
        glint: (0.10, 40),
        backdrop: [vec3(0.36, 0.33, 0.30), vec3(0.80, 0.74, 0.66)],
    };

    /// The background at a height of the picture, from 0 at the top to 1 at the bottom.
    #[must_use]
    pub fn behind(&self, height: f32) -> Vec3 {
        self.backdrop[0].lerp(self.backdrop[1], smooth(height))
    }

    /// What a mirror shows where the scene is not: the backdrop bent into a room, and the lamp in it.
    #[must_use]
    pub fn around(&self, direction: Vec3) -> Vec3 {
        let room = self.backdrop[1].lerp(self.backdrop[0], smooth(direction.y.clamp(0.0, 1.0)));
        let near = (direction.dot(self.toward) - 0.80) / 0.16;
        room + 1.4 * self.lamp * smooth(near.clamp(0.0, 1.0))
    }

    /// What comes from all around to a surface that sees all of it.
    #[must_use]
    pub fn ambient(&self, normal: Vec3) -> Vec3 {
        self.sky.lerp(self.ground, 0.5 - 0.5 * normal.y)
    }

    /// What a surface of this colour sends along the line of sight `view` of the lamp in direction `way`; `None` where it faces
    /// away. Only `dull` of the light goes through its colour.
    #[must_use]
    pub fn from_lamp(&self, albedo: Vec3, dull: f32, normal: Vec3, way: Vec3, view: Vec3) -> Option<Vec3> {
        let facing = normal.dot(way);
        let half = (way - view).normalize();
        let glint = || self.glint.0 * normal.dot(half).max(0.0).powi(self.glint.1);
        (facing > 0.0).then(|| self.lamp * (albedo * facing * dull + glint()))
    }

    /// Towards `count` places of the lamp, spread evenly and turned by `turn`.
    pub fn to_lamp(&self, count: u32, turn: f32) -> impl Iterator<Item = Vec3> + use<> {
        let (toward, extent) = (self.toward, self.extent);
        let (right, up) = toward.any_orthonormal_pair();
        spiral(count, turn).map(move |[x, y]| (toward + extent * (x * right + y * up)).normalize())
    }

    /// Into `count` directions of the half-space over a surface, the more of them the steeper they are, as light counts there.
    pub fn to_sky(normal: Vec3, count: u32, turn: f32) -> impl Iterator<Item = Vec3> {
        let (right, up) = normal.any_orthonormal_pair();
        spiral(count, turn).map(move |[x, y]| (x * right + y * up + (1.0 - x * x - y * y).max(0.0).sqrt() * normal).normalize())
    }
}

/// A turn that looks like chance and is the same in every run, from 0 to a full one.
#[must_use]
pub fn turn(seed: u32) -> f32 {
    // The finalizer of MurmurHash3.
    let mut hash = seed.wrapping_mul(0x9e37_79b9);
    for factor in [0x85eb_ca6b, 0xc2b2_ae35] {
        hash = (hash ^ hash >> 15).wrapping_mul(factor);
    }
    (hash ^ hash >> 16) as f32 * (TAU / 4_294_967_296.0)
}

/// `count` places of the unit disc, evenly spread: the seeds of a sunflower.
fn spiral(count: u32, turn: f32) -> impl Iterator<Item = [f32; 2]> {
    // The golden angle.
    let step = PI * (3.0 - 5.0_f32.sqrt());
    (0..count).map(move |number| {
        let radius = ((number as f32 + 0.5) / count as f32).sqrt();
        let (sine, cosine) = (turn + number as f32 * step).sin_cos();
        [radius * cosine, radius * sine]
    })
}

/// From 0 to 1, level at both ends.
fn smooth(place: f32) -> f32 {
    place * place * (3.0 - 2.0 * place)
}

#[cfg(test)]
mod tests {
    use super::{Light, spiral, turn};
    use core::f32::consts::TAU;
    use glam::Vec3;

    #[test]
    fn lamps_are_in_a_direction() {
        for light in [Light::OUTDOORS, Light::STUDIO] {
            assert!((light.toward.length() - 1.0).abs() < 1e-3);
        }
    }

    #[test]
    fn the_backdrop_runs_from_end_to_end() {
        let light = Light::OUTDOORS;
        assert_eq!([light.behind(0.0), light.behind(1.0)], light.backdrop);
    }

    #[test]
    fn a_lamp_without_extent_is_one_point() {
        assert!(
            Light::OUTDOORS
                .to_lamp(5, 1.0)
                .all(|way| way.abs_diff_eq(Light::OUTDOORS.toward, 1e-3))
        );
    }

    #[test]
    fn spirals_are_even_and_turns_are_turns() {
        let places: Vec<_> = spiral(64, 0.7).collect();
        let middle = |axis: usize| places.iter().map(|place| place[axis]).sum::<f32>() / 64.0;
        assert!(middle(0).abs() < 0.02 && middle(1).abs() < 0.02);
        let mean = (0..4096).map(turn).inspect(|turn| assert!((0.0..=TAU).contains(turn))).sum::<f32>() / 4096.0;
        assert!((mean - TAU / 2.0).abs() < 0.1, "{mean}");
    }

    #[test]
    fn the_sky_is_over_the_surface() {
        for normal in [Vec3::Y, Vec3::NEG_X, Vec3::new(0.6, 0.0, -0.8)] {
            assert!(Light::to_sky(normal, 32, 0.3).all(|way| way.dot(normal) > 0.0));
        }
    }
}
