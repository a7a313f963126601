//! The spans of one leaf along the packets of a tile.

use super::rays::Rays;
use crate::lanes::Lanes;
use crate::scene::View;
use gsdf_nostd::{Solid, Span};

/// The spans of the leaf in a place of the scene along some packets, in ascending order, into every `step`-th of `spans`.
#[inline(always)]
pub(crate) fn leaf_spans<T: Lanes, L: Solid>(
    view: &View<'_, '_, L>,
    place: u32,
    which: u32,
    rays: &mut Rays<T>,
    spans: &mut [Span<T>],
    step: usize,
) {
    let Some((solid, frame)) = view.scene.leaf(place) else { return };
    let lines = rays.lines_in(frame, view.scene.program(), which);
    if view.shares_origin() {
        solid.spans_lifted(&view.seen(place, solid, frame), lines, which, spans, step);
    } else {
        solid.spans_along(lines, which, spans, step);
    }
}
