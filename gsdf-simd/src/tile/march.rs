//! Any part of a program: what the rays of a tile can meet of it is marched.

use super::leaf::{self, Use};
use super::state::{MOST_SPANS, Workspace};
use crate::lanes::{Lanes, MOST_LANES};
use crate::scene::{FANOUT, Form, Known, Meets, Outline, Reduced, Remainder, Scene, View};
use core::ops::Range;
use gsdf_nostd::{Mask, Solid, Span, attribute, march};

/// A part of the program with its leaves in these places, or the whole of it, cast at by some packets of a tile. The
/// whole of it is for rays that start inside: it is found where they first leave or enter.
#[inline(always)]
pub(crate) fn cast<T: Lanes, L: Solid, M: Meets<T>>(
    token: T::Token,
    view: &View<'_, '_, L>,
    rays: &M,
    places: Range<u32>,
    form: &Form,
    which: u32,
    work: &mut Workspace<T, L>,
) {
    let scene = view.scene;
    let part = match form {
        Form::March { outline, cuts } => scene.outline(*outline).zip(scene.cuts(*cuts)),
        _ => None,
    };
    let tree = part.map_or(scene.tree(), |(_, tree)| tree);
    let all = part.is_none();
    work.known.clear();
    work.met_leaves.clear();
    if all {
        work.known.resize(scene.program().leaves(), Known::Outside);
    }
    work.inner_walk.begin(tree);
    while let Some(item) = work.inner_walk.next::<T, M>(token, tree, rays, f32::INFINITY) {
        let mut bits = work.inner_walk.met.bits;
        while bits != 0 {
            let place = bits.trailing_zeros() as usize % FANOUT;
            bits &= bits - 1;
            if all {
                scene.mark(item + place, &mut work.known);
            } else {
                work.met_leaves.push(((item + place) as u32, Known::Open));
            }
        }
    }
    let known = match part {
        Some((outline, _)) => {
            scene.know(
                &places,
                #[inline(always)]
                |border| rays.see(border),
                &mut work.met_leaves,
            );
            remainder(scene, outline, places.start, work)
        }
        None => {
            for part in scene.unbounded() {
                scene.mark(part, &mut work.known);
            }
            reduce(scene, work)
        }
    };
    march_reduced(token, view, known, which, all, work);
}

/// Reduces a part to the leaves that are met.
pub(super) fn remainder<T: Lanes, L: Solid>(scene: &Scene<'_, L>, outline: &Outline, first: u32, work: &mut Workspace<T, L>) -> Known {
    let mut remainder = Remainder {
        nodes: &mut work.nodes,
        leaves: &mut work.places,
        open: &mut work.open,
    };
    let known = outline.reduce(&work.met_leaves, &mut remainder, |leaf| scene.node(first + leaf));
    for leaf in &mut work.places {
        *leaf += first;
    }
    known
}

/// Reduces the whole program to its open leaves.
fn reduce<T: Lanes, L: Solid>(scene: &Scene<'_, L>, work: &mut Workspace<T, L>) -> Known {
    let mut reduced = Reduced {
        nodes: &mut work.nodes,
        places: &mut work.places,
        waiting: &mut work.waiting,
    };
    reduced.reduce(scene.program().nodes(), scene.places(), &work.known)
}

/// Marches some packets through the reduced program. Where that is `all` there is, what they meet replaces whatever was
/// found before.
#[inline(always)]
fn march_reduced<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    known: Known,
    which: u32,
    all: bool,
    work: &mut Workspace<T, L>,
) {
    let nothing = T::splat(token, f32::INFINITY);
    if known != Known::Open {
        if all {
            let mut bits = which;
            while bits != 0 {
                work.met.replace(bits.trailing_zeros() as usize, nothing, nothing);
                bits &= bits - 1;
            }
        } else if known == Known::Inside {
            work.met.inside |= which;
        }
        return;
    }
    let leaves = work.places.len();
    let together = (MOST_SPANS / leaves).max(1);
    let mut left = which;
    while left != 0 {
        // The next packets that are marched together.
        let mut some = 0;
        let mut count = 0;
        while left != 0 && count < together {
            some |= left & left.wrapping_neg();
            left &= left - 1;
            count += 1;
        }
        if work.spans.len() < count * leaves {
            work.spans.resize(
                count * leaves,
                Span {
                    enter: nothing,
                    exit: -nothing,
                },
            );
        }
        for number in 0..leaves {
            leaf::spans(
                token,
                view,
                work.places[number],
                some,
                &mut work.rays,
                Use::Keep(&mut work.spans[number..], leaves),
            );
        }
        work.computed += (count * leaves) as u64;

        let mut start_of_spans = 0;
        while some != 0 {
            let packet = some.trailing_zeros() as usize;
            some &= some - 1;
            let spans = &work.spans[start_of_spans..start_of_spans + leaves];
            start_of_spans += leaves;
            let (_, scale, start) = work.rays.packet(packet);
            let found = march(&work.nodes, spans, start);
            let mut t = found.t;
            if !all {
                // A lane without a ray starts, and ends, at infinity.
                if (found.inside & start.lt(nothing)).any() {
                    work.met.inside |= 1 << packet;
                }
                t = T::select(found.inside, nothing, t);
                let nearest = work.met.nearest(packet, nothing);
                if !(t.lt(nothing) & t.le(nearest)).any() {
                    continue;
                }
            } else if !(t * scale).lt(nothing).any() {
                work.met.replace(packet, nothing, nothing);
                continue;
            }
            let index = attribute(&work.nodes, spans, t).leaf;
            let mut lanes = [0.0; MOST_LANES];
            index.store(&mut lanes);
            for lane in &mut lanes {
                *lane = match work.places.get(*lane as usize) {
                    Some(place) => view.scene.number(*place) as f32,
                    None => f32::INFINITY,
                };
            }
            let leaf = T::load(token, &lanes);
            if all {
                work.met.replace(packet, t, leaf);
            } else {
                work.met.enter(packet, t, leaf);
            }
        }
    }
}
