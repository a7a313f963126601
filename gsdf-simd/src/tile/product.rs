//! A product seen from outside: it is entered at the last of the entries of what must be inside, or where the last of the
//! complements in the way ends.

use super::leaf::{self, Use};
use super::rays::MOST_PACKETS;
use super::state::{MOST_CUTS, Workspace};
use crate::lanes::Lanes;
use crate::scene::{FANOUT, Meets, Tree, View};
use core::ops::Range;
use gsdf_nostd::{Mask, Solid, Span};

/// The intersection of the solids in some places, along some packets, one after the other at the start of `work.spans`; and
/// the numbers of the leaves at its entries.
#[inline(always)]
fn intersect<T: Lanes, L: Solid>(token: T::Token, view: &View<'_, '_, L>, places: Range<u32>, which: u32, work: &mut Workspace<T, L>) {
    let count = which.count_ones() as usize;
    let infinity = T::splat(token, f32::INFINITY);
    if places.is_empty() {
        for place in 0..count {
            work.spans[place] = Span {
                enter: -infinity,
                exit: infinity,
            };
            work.leaves[place % MOST_PACKETS] = infinity;
        }
        return;
    }
    for place in places.clone() {
        let number = T::splat(token, view.scene.number(place) as f32);
        let is_first = place == places.start;
        let own = if is_first { 0 } else { MOST_PACKETS };
        leaf::spans(token, view, place, which, &mut work.rays, Use::Keep(&mut work.spans[own..], 1));
        work.computed += count as u64;
        for packet in 0..count {
            if is_first {
                work.leaves[packet % MOST_PACKETS] = number;
                continue;
            }
            let (all, one, leaf) = (work.spans[packet], work.spans[own + packet], work.leaves[packet % MOST_PACKETS]);
            let lower = T::select(one.enter.eq(all.enter), number.min(leaf), leaf);
            work.leaves[packet % MOST_PACKETS] = T::select(all.enter.lt(one.enter), number, lower);
            work.spans[packet] = all.intersection(one);
        }
    }
}

/// A product of so many solids and of the complements of the part's other leaves, whose boxes are in `cuts`, cast at by
/// some packets of a tile.
#[inline(always)]
#[allow(clippy::too_many_arguments, reason = "what a tile is made of, passed through")]
pub(crate) fn cast<T: Lanes, L: Solid, M: Meets<T>>(
    token: T::Token,
    view: &View<'_, '_, L>,
    rays: &M,
    part: Range<u32>,
    positives: u32,
    cuts: Option<&Tree>,
    which: u32,
    work: &mut Workspace<T, L>,
) {
    let first_cut = part.start + positives;
    if let (1, None) = (positives, cuts) {
        let number = T::splat(token, view.scene.number(part.start) as f32);
        leaf::spans(token, view, part.start, which, &mut work.rays, Use::Enter(&mut work.met, number));
        work.computed += u64::from(which.count_ones());
        return;
    }
    intersect(token, view, part.start..first_cut, which, work);

    if let Some(cuts) = cuts {
        let alive = begin(which, work);
        if alive == 0 {
            return;
        }
        gather(token, cuts, rays, first_cut, alive, work);
        loop {
            let mut moved = false;
            let mut from = 0;
            while from < work.cuts.len() {
                let to = (from + MOST_CUTS).min(work.cuts.len());
                moved |= push(token, view, from..to, which, alive, work);
                from = to;
            }
            // What was moved by some may have come into others that were looked at before; up to 64 see to that
            // themselves.
            if !moved || work.cuts.len() <= MOST_CUTS {
                break;
            }
        }
    }

    let mut bits = which;
    let mut place = 0;
    while bits != 0 {
        let packet = bits.trailing_zeros() as usize;
        bits &= bits - 1;
        let (span, leaf) = (work.spans[place], work.leaves[place % MOST_PACKETS]);
        place += 1;
        let (_, _, start) = work.rays.packet(packet);
        work.met.enter_span(packet, span, leaf, start);
    }
}

/// Moves the entries of some packets to where their rays start, if that is later, and says which packets have a ray that is
/// then inside of all solids and not yet nearer elsewhere.
#[inline(always)]
fn begin<T: Lanes, L>(which: u32, work: &mut Workspace<T, L>) -> u32 {
    let mut alive = 0;
    let mut bits = which;
    let mut place = 0;
    while bits != 0 {
        let packet = bits.trailing_zeros() as usize;
        bits &= bits - 1;
        let span = work.spans[place];
        let (_, _, start) = work.rays.packet(packet);
        let nearest = work.met.nearest(packet, start.splat_like(f32::INFINITY));
        let enter = span.enter.max(start);
        work.spans[place].enter = enter;
        if (enter.lt(span.exit) & enter.le(nearest)).any() {
            alive |= 1 << packet;
        }
        place += 1;
    }
    alive
}

/// The complements that the rays may meet, with those of some packets that do.
#[inline(always)]
fn gather<T: Lanes, L, M: Meets<T>>(token: T::Token, cuts: &Tree, rays: &M, first: u32, which: u32, work: &mut Workspace<T, L>) {
    work.cuts.clear();
    work.inner_walk.begin(cuts);
    while let Some(item) = work.inner_walk.next::<T, M>(token, cuts, rays, f32::INFINITY) {
        let mut bits = work.inner_walk.met.bits;
        while bits != 0 {
            let place = bits.trailing_zeros() as usize % FANOUT;
            bits &= bits - 1;
            let met = &work.inner_walk.met;
            let touched = which & met.touched[place];
            if touched != 0 {
                work.cuts.push((first + (item + place) as u32, touched));
            }
        }
    }
}

/// Moves the entries of some packets out of up to 64 complements, until they are in none, and notes who moved them last;
/// says whether any was moved.
#[inline(always)]
fn push<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    some: Range<usize>,
    which: u32,
    alive: u32,
    work: &mut Workspace<T, L>,
) -> bool {
    // The spans of each complement lie one after the other, packet by packet; `seen_by` says of each packet by which
    // complements it is touched.
    let mut seen_by = [0_u64; MOST_PACKETS];
    let mut starts = [0_usize; MOST_CUTS];
    let mut end = MOST_PACKETS;
    let from = some.start;
    for cut in 0..some.len() {
        let (place, touched) = work.cuts[from + cut];
        let touched = touched & alive;
        starts[cut % MOST_CUTS] = end;
        if touched == 0 {
            continue;
        }
        leaf::spans(token, view, place, touched, &mut work.rays, Use::Keep(&mut work.spans[end..], 1));
        end += touched.count_ones() as usize;
        let mut bits = touched;
        while bits != 0 {
            seen_by[bits.trailing_zeros() as usize % MOST_PACKETS] |= 1 << cut;
            bits &= bits - 1;
        }
    }
    work.computed += (end - MOST_PACKETS) as u64;

    let mut moved = false;
    let mut bits = alive;
    while bits != 0 {
        let packet = bits.trailing_zeros() as usize;
        bits &= bits - 1;
        let below = (1_u32 << packet) - 1;
        let place = (which & below).count_ones() as usize;
        let Span { enter, exit } = work.spans[place];
        let (mut t, mut leaf) = (enter, work.leaves[place % MOST_PACKETS]);
        let all = seen_by[packet % MOST_PACKETS];
        let several = all & all.wrapping_sub(1) != 0;
        loop {
            let mut pushed = false;
            let mut waiting = all;
            while waiting != 0 {
                let cut = waiting.trailing_zeros() as usize;
                waiting &= waiting - 1;
                let (leaf_place, touched) = work.cuts[from + cut];
                let own = work.spans[starts[cut % MOST_CUTS] + (touched & alive & below).count_ones() as usize];
                let within = own.contains_after(t) & t.lt(exit);
                if within.any() {
                    let number = t.splat_like(view.scene.number(leaf_place) as f32);
                    t = T::select(within, own.exit, t);
                    leaf = T::select(within, number, leaf);
                    pushed = true;
                }
            }
            moved |= pushed;
            // One complement alone is left for good.
            if !pushed || !several {
                break;
            }
        }
        // Of all that end where the last one does the lowest number counts.
        let mut waiting = all;
        while waiting != 0 {
            let cut = waiting.trailing_zeros() as usize;
            waiting &= waiting - 1;
            let (leaf_place, touched) = work.cuts[from + cut];
            let own = work.spans[starts[cut % MOST_CUTS] + (touched & alive & below).count_ones() as usize];
            let number = t.splat_like(view.scene.number(leaf_place) as f32);
            leaf = T::select(own.exit.eq(t) & number.lt(leaf), number, leaf);
        }
        work.spans[place].enter = t;
        work.leaves[place % MOST_PACKETS] = leaf;
    }
    moved
}
