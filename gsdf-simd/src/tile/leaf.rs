//! One leaf along the packets of a tile: the only places where the formulas of the solids stand, each in a function of its
//! own.

use super::product::Product;
use super::rays::{MOST_PACKETS, Rays};
use super::state::Met;
use crate::lanes::Lanes;
use crate::scene::View;
use gsdf_nostd::{Footing, Line, OnSurface, Solid, Span, Surface, Transform, V3};

/// What becomes of the spans of a leaf.
#[derive(Debug)]
pub(crate) enum Use<'u, T: Lanes> {
    /// The leaf is a part of the program: where it is entered the program is. Its number.
    Enter(&'u mut Met<T>, T),
    /// It begins a product. Its number.
    Begin(&'u mut Product<T>, T),
    /// It is another solid of a product. Its number.
    Intersect(&'u mut Product<T>, T),
    /// It is what a product is the complement of.
    Cut {
        product: &'u mut Product<T>,
        /// Its number.
        number: T,
        /// The packets of which a ray enters the product later for it.
        moved: &'u mut u32,
        /// Where its spans are kept, one after the other.
        spans: &'u mut [Span<T>],
    },
    /// They are kept in every so many-th place.
    Keep(&'u mut [Span<T>], usize),
}

impl<T: Lanes> Use<'_, T> {
    /// Takes the span along a packet, which is the one of this rank among those asked for; its rays start at `start`.
    #[inline(always)]
    fn take(&mut self, packet: usize, rank: usize, span: Span<T>, start: T) {
        match self {
            Self::Enter(met, number) => met.enter_span(packet, span, *number, start),
            Self::Begin(product, number) => product.begin(packet, span, *number),
            Self::Intersect(product, number) => product.intersect(packet, span, *number),
            Self::Cut {
                product,
                number,
                moved,
                spans,
            } => {
                **moved |= u32::from(product.cut(packet, span, *number)) << packet;
                product.settle_tie(packet, span, *number);
                if let Some(place) = spans.get_mut(rank) {
                    *place = span;
                }
            }
            Self::Keep(spans, step) => {
                if let Some(place) = spans.get_mut(rank * *step) {
                    *place = span;
                }
            }
        }
    }
}

/// The spans of the leaf in a place of the scene along some packets, in ascending order.
#[inline(always)]
pub(crate) fn spans<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    place: u32,
    which: u32,
    rays: &mut Rays<T>,
    mut used: Use<'_, T>,
) {
    let Some((solid, frame)) = view.scene.leaf(place) else { return };
    let pose = view.scene.program().pose(frame);
    if let Some(pose) = pose {
        rays.pose(frame, pose, which);
    }
    let (local, scales) = rays.local();
    let lines = if pose.is_some() { local } else { rays.lines() };
    let starts = rays.starts();
    if let Some(leaving) = rays.leaving() {
        let mut span = leaving_span(token, solid, view.scene.number(place), &lines[0], pose, &leaving);
        if pose.is_some() {
            (span.enter, span.exit) = (span.enter * scales[0], span.exit * scales[0]);
        }
        used.take(0, 0, span, starts[0]);
        return;
    }
    let now;
    let seen = match view.seen_before(place) {
        None => {
            now = view.see(solid, frame);
            now.as_ref()
        }
        before => before,
    };
    let is_posed = pose.is_some();
    let mut rank = 0;
    T::vectorize(
        token,
        #[inline(always)]
        || {
            solid.spans(
                seen,
                lines,
                which,
                #[inline(always)]
                |packet: usize, own: Span<T>| {
                    let mut span = own;
                    if is_posed {
                        let scale = scales[packet % MOST_PACKETS];
                        (span.enter, span.exit) = (own.enter * scale, own.exit * scale);
                    }
                    used.take(packet, rank, span, starts[packet % MOST_PACKETS]);
                    rank += 1;
                },
            );
        },
    );
}

/// The span of a leaf along rays that start on surfaces. Rays of pictures do not: what they never ask for stays out of their way.
#[inline(never)]
fn leaving_span<T: Lanes, L: Solid>(
    token: T::Token,
    solid: &L,
    number: u32,
    line: &Line<T>,
    pose: Option<&Transform>,
    leaving: &OnSurface<T>,
) -> Span<T> {
    T::vectorize(
        token,
        #[inline(always)]
        || leaving.span(number, solid, line, pose),
    )
}

/// The surface of a leaf where rays that start on surfaces cross it.
#[inline(never)]
fn leaving_surface<T: Lanes, L: Solid>(
    token: T::Token,
    solid: &L,
    number: u32,
    (line, t): (&Line<T>, T),
    pose: Option<&Transform>,
    leaving: &OnSurface<T>,
) -> Surface<T> {
    T::vectorize(
        token,
        #[inline(always)]
        || leaving.surface(number, solid, line, pose, t),
    )
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
    if let Some(pose) = pose {
        rays.pose(asked.frame, pose, 1 << packet);
    }
    let packet = packet % MOST_PACKETS;
    let (line, t) = match pose {
        Some(_) => (&rays.local().0[packet], t / rays.local().1[packet]),
        None => (&rays.lines()[packet], t),
    };
    let own = match rays.leaving() {
        Some(leaving) => leaving_surface(token, solid, number, (line, t), pose, &leaving),
        None => {
            let seen = asked.seen_before.or(asked.seen_now.as_ref());
            T::vectorize(
                token,
                #[inline(always)]
                || solid.surface_on(seen, line, t),
            )
        }
    };
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
