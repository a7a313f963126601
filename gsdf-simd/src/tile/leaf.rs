//! One leaf along the packets of a tile: the only places where the formulas of the solids stand, each in a function of its
//! own.

use super::rays::Rays;
use crate::lanes::Lanes;
use crate::scene::View;
use gsdf_nostd::{Solid, Span, V3};

/// The spans of the leaf in a place of the scene along some packets, in ascending order, into every `step`-th of `spans`.
#[inline(always)]
pub(crate) fn spans<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    place: u32,
    which: u32,
    rays: &mut Rays<T>,
    spans: &mut [Span<T>],
    step: usize,
) {
    let Some((solid, frame)) = view.scene.leaf(place) else { return };
    let lines = rays.lines_in(frame, view.scene.program(), which);
    let mut now = None;
    let seen = view.seen(place, solid, frame, &mut now);
    T::vectorize(
        token,
        #[inline(always)]
        || solid.spans(seen, lines, which, spans, step),
    );
}

/// The outward normals of the leaf in a place of the scene where the rays of a packet cross its surface.
#[inline(always)]
pub(crate) fn normals<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    place: u32,
    packet: usize,
    rays: &mut Rays<T>,
    t: T,
) -> V3<T> {
    let Some((solid, frame)) = view.scene.leaf(place) else { return V3::new(t, t, t) };
    let line = rays.line_in(frame, view.scene.program(), packet);
    let mut now = None;
    let seen = view.seen(place, solid, frame, &mut now);
    let normal = T::vectorize(
        token,
        #[inline(always)]
        || solid.surface_on(seen, line, t).normal,
    );
    match view.scene.program().pose(frame) {
        Some(pose) => pose.normal_to_world(normal),
        None => normal,
    }
}
