//! A scene as one camera sees it.

use super::Scene;
use gsdf_nostd::{MAX_LENGTH, MAX_SPEED, Projection, Raster, Solid, Transform, V3};

/// Up to how many leaves all are seen from the eye once for the whole picture. Of more than these the caches hold few,
/// and most are never looked at.
const MOST_SEEN: usize = 4096;

/// A scene and a raster, with what depends on the camera alone.
#[derive(Debug)]
pub(crate) struct View<'s, 'a, L: Solid> {
    pub(crate) scene: &'s Scene<'a, L>,
    pub(crate) raster: Raster,
    /// The leaves as seen from the eye, in the order of the scene; empty where they are too many, or the rays have no
    /// origin in common.
    seen: Vec<L::Seen<f32>>,
    /// Whether the raster makes valid rays of all its pixels, whatever they are.
    pub(crate) valid: bool,
}

impl<'s, 'a, L: Solid> View<'s, 'a, L> {
    pub(crate) fn new(scene: &'s Scene<'a, L>, raster: Raster) -> Self {
        let mut view = Self {
            scene,
            raster,
            seen: Vec::new(),
            valid: false,
        };
        view.look(raster);
        view
    }

    /// Looks through another raster. Of no more leaves than before nothing is allocated.
    pub(crate) fn look(&mut self, raster: Raster) {
        self.raster = raster;
        self.valid = makes_valid_rays(&raster);
        self.seen.clear();
        if self.shares_origin() && self.scene.leaves.len() <= MOST_SEEN {
            let (scene, seen) = (self.scene, &mut self.seen);
            for literal in &scene.leaves {
                seen.push(seen_from(&literal.solid, scene.program.pose(literal.frame), &raster));
            }
        }
    }

    /// Whether all rays start at the eye.
    #[inline(always)]
    pub(crate) fn shares_origin(&self) -> bool {
        self.raster.camera().projection() == Projection::Pinhole
    }

    /// The leaf in a place of the scene as it was seen from the eye for the whole picture, if it was.
    #[inline(always)]
    pub(crate) fn seen_before(&self, place: u32) -> Option<&L::Seen<f32>> {
        self.seen.get(place as usize)
    }

    /// A solid in a frame, as seen from the eye.
    #[inline(always)]
    pub(crate) fn see(&self, solid: &L, frame: u16) -> L::Seen<f32> {
        seen_from(solid, self.scene.program.pose(frame), &self.raster)
    }
}

/// A solid as seen from the eye of a camera.
#[inline]
fn seen_from<L: Solid>(solid: &L, pose: Option<&Transform>, raster: &Raster) -> L::Seen<f32> {
    let eye = V3::from(raster.camera().eye());
    solid.seen_from(pose.map_or(eye, |pose| pose.point_to_local(eye)))
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
