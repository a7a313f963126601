//! A product seen from outside: it is entered at the last of the entries of what must be inside, or where the last of the
//! complements in the way ends.

use super::leaf::{self, Use};
use super::rays::MOST_PACKETS;
use super::state::{MOST_CUTS, Workspace};
use crate::lanes::Lanes;
use crate::scene::{FANOUT, Meets, Tree, View};
use core::ops::Range;
use gsdf_nostd::{Mask, Solid, Span};

/// Where the rays of a tile enter and leave a product, as far as it was looked at.
#[derive(Debug)]
pub(crate) struct Product<T: Lanes> {
    spans: [Span<T>; MOST_PACKETS],
    /// The numbers of the leaves at the entries.
    leaves: [T; MOST_PACKETS],
}

impl<T: Lanes> Product<T> {
    #[inline(always)]
    pub(crate) fn new(token: T::Token) -> Self {
        let infinity = T::splat(token, f32::INFINITY);
        Self {
            spans: [Span::empty_like(infinity); MOST_PACKETS],
            leaves: [infinity; MOST_PACKETS],
        }
    }

    /// The first solid of the product, or none yet.
    #[inline(always)]
    pub(crate) fn begin(&mut self, packet: usize, own: Span<T>, number: T) {
        (self.spans[packet % MOST_PACKETS], self.leaves[packet % MOST_PACKETS]) = (own, number);
    }

    /// Another solid: what is in both is left. Of two entries at the same place that with the lower number counts, which is
    /// that of the solid before: a product's come in the order of the program.
    #[inline(always)]
    pub(crate) fn intersect(&mut self, packet: usize, own: Span<T>, number: T) {
        let (all, leaf) = (self.spans[packet % MOST_PACKETS], self.leaves[packet % MOST_PACKETS]);
        self.leaves[packet % MOST_PACKETS] = T::select(all.enter.lt(own.enter), number, leaf);
        self.spans[packet % MOST_PACKETS] = all.intersection(own);
    }

    /// The complement of a solid: who would enter within it enters where it ends. Says whether anyone does.
    #[inline(always)]
    pub(crate) fn cut(&mut self, packet: usize, own: Span<T>, number: T) -> bool {
        let Span { enter, exit } = self.spans[packet % MOST_PACKETS];
        let within = own.contains_after(enter) & enter.lt(exit);
        let moves = within.any();
        if moves {
            self.spans[packet % MOST_PACKETS].enter = T::select(within, own.exit, enter);
            self.leaves[packet % MOST_PACKETS] = T::select(within, number, self.leaves[packet % MOST_PACKETS]);
        }
        moves
    }

    /// Of all complements that end where the product is entered the lowest number counts.
    #[inline(always)]
    pub(crate) fn settle_tie(&mut self, packet: usize, own: Span<T>, number: T) {
        let leaf = self.leaves[packet % MOST_PACKETS];
        let tie = own.exit.eq(self.spans[packet % MOST_PACKETS].enter) & number.lt(leaf);
        self.leaves[packet % MOST_PACKETS] = T::select(tie, number, leaf);
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
    if positives == 0 {
        let infinity = T::splat(token, f32::INFINITY);
        let everywhere = Span {
            enter: -infinity,
            exit: infinity,
        };
        for packet in 0..MOST_PACKETS {
            work.product.begin(packet, everywhere, infinity);
        }
    }
    let mut begun = false;
    for place in part.start..first_cut {
        // Of a solid that the rays are inside of all the way the product has nothing, as long as there is another one.
        if (begun || place + 1 < first_cut)
            && view.scene.is_inside(
                place,
                #[inline(always)]
                |border| rays.see(border),
            )
        {
            continue;
        }
        let number = T::splat(token, view.scene.number(place) as f32);
        let used = match (begun, positives, cuts) {
            (false, 1, None) => Use::Enter(&mut work.met, number),
            (false, ..) => Use::Begin(&mut work.product, number),
            (true, ..) => Use::Intersect(&mut work.product, number),
        };
        begun = true;
        leaf::spans(token, view, place, which, &mut work.rays, used);
        work.computed += u64::from(which.count_ones());
    }
    if let (1, None) = (positives, cuts) {
        return;
    }

    let mut entering = which;
    if let Some(cuts) = cuts {
        entering = approach(which, work);
        if entering == 0 {
            return;
        }
        gather(token, cuts, rays, first_cut, entering, work);
        loop {
            let mut moved = 0;
            let mut from = 0;
            while from < work.cuts.len() {
                let to = (from + MOST_CUTS).min(work.cuts.len());
                moved |= push(token, view, from..to, work);
                from = to;
            }
            // What was moved by some may have come into others that were looked at before; up to 64 see to that
            // themselves.
            if moved == 0 || work.cuts.len() <= MOST_CUTS {
                break;
            }
        }
    }

    while entering != 0 {
        let packet = entering.trailing_zeros() as usize % MOST_PACKETS;
        entering &= entering - 1;
        let (_, _, start) = work.rays.packet(packet);
        work.met
            .enter_span(packet, work.product.spans[packet], work.product.leaves[packet], start);
    }
}

/// Moves the entries of some packets to where their rays start, if that is later, and says which packets have a ray that is
/// then inside of all solids and not yet nearer elsewhere.
#[inline(always)]
fn approach<T: Lanes, L>(which: u32, work: &mut Workspace<T, L>) -> u32 {
    let mut alive = 0;
    let mut bits = which;
    while bits != 0 {
        let packet = bits.trailing_zeros() as usize % MOST_PACKETS;
        bits &= bits - 1;
        let span = &mut work.product.spans[packet];
        let (_, _, start) = work.rays.packet(packet);
        let nearest = work.met.nearest(packet, start.splat_like(f32::INFINITY));
        span.enter = span.enter.max(start);
        if (span.enter.lt(span.exit) & span.enter.le(nearest)).any() {
            alive |= 1 << packet;
        }
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

/// Moves the entries of the packets out of up to 64 complements, until they are in none, and notes who moved them last;
/// says which packets have one that was moved.
#[inline(always)]
fn push<T: Lanes, L: Solid>(token: T::Token, view: &View<'_, '_, L>, some: Range<usize>, work: &mut Workspace<T, L>) -> u32 {
    // The spans of each complement lie one after the other, packet by packet.
    let mut starts = [0_usize; MOST_CUTS];
    let mut end = 0;
    let mut moved = 0;
    let (mut touched_once, mut touched_again) = (0, 0);
    for cut in 0..some.len() {
        let (place, touched) = work.cuts[some.start + cut];
        starts[cut % MOST_CUTS] = end;
        let number = T::splat(token, view.scene.number(place) as f32);
        let used = Use::Cut {
            product: &mut work.product,
            number,
            moved: &mut moved,
            spans: &mut work.spans[end..],
        };
        leaf::spans(token, view, place, touched, &mut work.rays, used);
        end += touched.count_ones() as usize;
        touched_again |= touched_once & touched;
        touched_once |= touched;
    }
    work.computed += end as u64;

    // One complement alone is left for good. Of the others `seen_by` says of each packet by which it is touched.
    let again = moved & touched_again;
    if again == 0 {
        return moved;
    }
    let mut seen_by = [0_u64; MOST_PACKETS];
    for cut in 0..some.len() {
        let mut bits = work.cuts[some.start + cut].1 & again;
        while bits != 0 {
            seen_by[bits.trailing_zeros() as usize % MOST_PACKETS] |= 1 << cut;
            bits &= bits - 1;
        }
    }
    let mut bits = again;
    while bits != 0 {
        let packet = bits.trailing_zeros() as usize % MOST_PACKETS;
        bits &= bits - 1;
        let all = seen_by[packet];
        let mut pushed = true;
        while pushed {
            pushed = false;
            let mut waiting = all;
            while waiting != 0 {
                let cut = waiting.trailing_zeros() as usize;
                waiting &= waiting - 1;
                let (span, number) = kept(token, view, work, some.start + cut, starts[cut % MOST_CUTS], packet);
                pushed |= work.product.cut(packet, span, number);
            }
        }
        let mut waiting = all;
        while waiting != 0 {
            let cut = waiting.trailing_zeros() as usize;
            waiting &= waiting - 1;
            let (span, number) = kept(token, view, work, some.start + cut, starts[cut % MOST_CUTS], packet);
            work.product.settle_tie(packet, span, number);
        }
    }
    moved
}

/// The span of a complement along a packet, one of those that start at `start`, and the number of the leaf.
#[inline(always)]
fn kept<T: Lanes, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    work: &Workspace<T, L>,
    cut: usize,
    start: usize,
    packet: usize,
) -> (Span<T>, T) {
    let (place, touched) = work.cuts[cut];
    let rank = (touched & ((1 << packet) - 1)).count_ones() as usize;
    (work.spans[start + rank], T::splat(token, view.scene.number(place) as f32))
}
