//! A scene as rays see it that have something in common.

use super::Scene;
use glam::Vec3;
use gsdf_nostd::{MAX_LENGTH, MAX_SPEED, Projection, Raster, Solid, Transform, V3};

/// Up to how many leaves all are seen from the eye once for the whole picture. Of more than these the caches hold few,
/// and most are never looked at.
const MOST_SEEN: usize = 4096;

/// A scene as some rays see it, with what they have in common.
#[derive(Debug)]
pub(crate) struct View<'s, 'a, L: Solid> {
    pub(crate) scene: &'s Scene<'a, L>,
    /// The picture that they are the rays of, if they are.
    pub(crate) picture: Option<Picture>,
    /// Where they all start, if they do.
    eye: Option<Vec3>,
    /// The leaves as seen from there, in the order of the scene; empty where they are too many.
    seen: Vec<L::Seen<f32>>,
}

/// A picture to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Picture {
    pub(crate) raster: Raster,
    /// Whether the raster makes valid rays of all its pixels, whatever they are.
    pub(crate) valid: bool,
    /// How far from the middle of the world they start, at the most.
    pub(crate) reach: f32,
}

impl<'s, 'a, L: Solid> View<'s, 'a, L> {
    /// A scene seen by rays that have nothing in common.
    pub(crate) fn of_any_rays(scene: &'s Scene<'a, L>) -> Self {
        Self {
            scene,
            picture: None,
            eye: None,
            seen: Vec::new(),
        }
    }

    /// Looks through a raster from now on. Of no more leaves than before nothing is allocated.
    pub(crate) fn look(&mut self, raster: Raster) {
        self.picture = Some(Picture {
            raster,
            valid: makes_valid_rays(&raster),
            reach: reach(&raster),
        });
        let camera = raster.camera();
        self.eye = (camera.projection() == Projection::Pinhole).then_some(camera.eye());
        self.seen.clear();
        if let Some(eye) = self.eye.filter(|_| self.scene.leaves.len() <= MOST_SEEN) {
            let (scene, seen) = (self.scene, &mut self.seen);
            for literal in &scene.leaves {
                seen.push(seen_from(&literal.solid, scene.program.pose(literal.frame), eye));
            }
        }
    }

    /// Where all rays start, if they do so in one place.
    #[inline(always)]
    pub(crate) fn eye(&self) -> Option<Vec3> {
        self.eye
    }

    /// The leaf in a place of the scene as it was seen from the eye for the whole picture, if it was.
    #[inline(always)]
    pub(crate) fn seen_before(&self, place: u32) -> Option<&L::Seen<f32>> {
        self.seen.get(place as usize)
    }

    /// A solid in a frame as seen from where all rays start, if they do so in one place.
    #[inline(always)]
    pub(crate) fn see(&self, solid: &L, frame: u16) -> Option<L::Seen<f32>> {
        Some(seen_from(solid, self.scene.program.pose(frame), self.eye?))
    }
}

/// A solid as seen from a point of the world.
#[inline]
fn seen_from<L: Solid>(solid: &L, pose: Option<&Transform>, eye: Vec3) -> L::Seen<f32> {
    let eye = V3::from(eye);
    // No closure: it would be compiled apart from what is compiled for a level.
    let eye = match pose {
        Some(pose) => pose.point_to_local(eye),
        None => eye,
    };
    solid.seen_from(eye)
}

/// How far from the middle of the world rays start, at the most.
fn reach(raster: &Raster) -> f32 {
    let eye = raster.camera().eye().length();
    match raster.camera().projection() {
        Projection::Pinhole => eye,
        Projection::Orthographic => eye + raster.pixel() * (raster.width() as f32 + raster.height() as f32),
    }
}

/// Whether a raster's numbers stay so far within the range of rays that none of its rays need be looked at.
fn makes_valid_rays(raster: &Raster) -> bool {
    // From the middle to any corner, and that again for the rounding of it.
    let reach = raster.pixel() * (raster.width() as f32 + raster.height() as f32);
    match raster.camera().projection() {
        Projection::Pinhole => reach < MAX_SPEED / 4.0,
        Projection::Orthographic => raster.camera().eye().abs().max_element() + reach < MAX_LENGTH,
    }
}
