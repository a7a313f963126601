//! One leaf along the packets of a tile: the only places where the formulas of the solids stand, each in a function of its
//! own.

use super::rays::Rays;
use crate::lanes::Lanes;
use crate::scene::View;
use gsdf_nostd::{Solid, Span, Surface, V3};

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
    let now;
    let seen = match view.seen_before(place) {
        None => {
            now = view.see(solid, frame);
            now.as_ref()
        }
        before => before,
    };
    T::vectorize(
        token,
        #[inline(always)]
        || solid.spans(seen, lines, which, spans, step),
    );
    if view.scene.program().pose(frame).is_some() {
        to_world(rays, which, spans, step);
    }
}

/// Takes spans in a frame to the parameters of the world.
#[inline(always)]
fn to_world<T: Lanes>(rays: &Rays<T>, which: u32, spans: &mut [Span<T>], step: usize) {
    let mut bits = which;
    let mut place = 0;
    while bits != 0 {
        let scale = rays.local_scale(bits.trailing_zeros() as usize);
        bits &= bits - 1;
        if let Some(span) = spans.get_mut(place) {
            (span.enter, span.exit) = (span.enter * scale, span.exit * scale);
        }
        place += step;
    }
}

/// The surface of the leaf of a number where the rays of a packet cross it, with its normals outward from the program.
#[inline(always)]
pub(crate) fn surface<'v, T: Lanes, L: Solid>(
    token: T::Token,
    view: &'v View<'_, '_, L>,
    asked: &mut Asked<'v, L>,
    number: u32,
    packet: usize,
    rays: &mut Rays<T>,
    t: T,
) -> Surface<T> {
    if asked.number != number {
        asked.ask(view, number);
    }
    let Some(solid) = asked.solid else {
        return Surface {
            normal: V3::new(t, t, t),
            face: t,
        };
    };
    let pose = view.scene.program().pose(asked.frame);
    rays.lines_in(asked.frame, view.scene.program(), 1 << packet);
    let t = if pose.is_some() { t / rays.local_scale(packet) } else { t };
    let line = rays.line_in(asked.frame, view.scene.program(), packet);
    let seen = asked.seen_before.or(asked.seen_now.as_ref());
    let own = T::vectorize(
        token,
        #[inline(always)]
        || solid.surface_on(seen, line, t),
    );
    let outward = match pose {
        Some(pose) => pose.normal_to_world(own.normal),
        None => own.normal,
    };
    Surface {
        normal: if asked.negative { -outward } else { outward },
        ..own
    }
}

/// The leaf that was asked for its surface last: most likely the next packet will ask it again.
pub(crate) struct Asked<'v, L: Solid> {
    number: u32,
    solid: Option<&'v L>,
    frame: u16,
    negative: bool,
    seen_before: Option<&'v L::Seen<f32>>,
    seen_now: Option<L::Seen<f32>>,
}

impl<'v, L: Solid> Asked<'v, L> {
    /// None was asked.
    #[inline(always)]
    pub(crate) fn none() -> Self {
        Self {
            number: u32::MAX,
            solid: None,
            frame: 0,
            negative: false,
            seen_before: None,
            seen_now: None,
        }
    }

    #[inline(always)]
    fn ask(&mut self, view: &'v View<'_, '_, L>, number: u32) {
        let Some((place, literal)) = view.scene.literal(number) else {
            return;
        };
        let Some((solid, frame)) = view.scene.leaf(place) else { return };
        self.number = number;
        self.solid = Some(solid);
        self.frame = frame;
        self.negative = literal.negative;
        self.seen_before = view.seen_before(place);
        if self.seen_before.is_none() {
            self.seen_now = view.see(solid, frame);
        }
    }
}
