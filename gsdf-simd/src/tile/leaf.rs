//! One leaf along the packets of a tile: the only places where the formulas of the solids stand.

use super::rays::Rays;
use crate::lanes::{Lanes, Work};
use crate::scene::View;
use gsdf_nostd::{Line, Solid, Span, V3};

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
    T::outline(
        token,
        Spans {
            solid,
            seen,
            lines,
            which,
            spans,
            step,
        },
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
    let normal = T::outline(
        token,
        Normals {
            solid,
            seen,
            line,
            t,
        },
    );
    match view.scene.program().pose(frame) {
        Some(pose) => pose.normal_to_world(normal),
        None => normal,
    }
}

/// The spans of a solid along some lines.
struct Spans<'w, T: Lanes, L: Solid> {
    solid: &'w L,
    seen: Option<&'w L::Seen<f32>>,
    lines: &'w [Line<T>],
    which: u32,
    spans: &'w mut [Span<T>],
    step: usize,
}

impl<T: Lanes, L: Solid> Work<T> for Spans<'_, T, L> {
    type Output = ();

    #[inline(always)]
    fn work(self, _: T::Token) {
        self.solid.spans(self.seen, self.lines, self.which, self.spans, self.step);
    }
}

/// The normals of a solid where some lines cross its surface.
struct Normals<'w, T: Lanes, L: Solid> {
    solid: &'w L,
    seen: Option<&'w L::Seen<f32>>,
    line: &'w Line<T>,
    t: T,
}

impl<T: Lanes, L: Solid> Work<T> for Normals<'_, T, L> {
    type Output = V3<T>;

    #[inline(always)]
    fn work(self, _: T::Token) -> V3<T> {
        self.solid.surface_on(self.seen, self.line, self.t).normal
    }
}
