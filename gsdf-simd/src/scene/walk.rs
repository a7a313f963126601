//! From the top of a tree of boxes to those that some rays meet.

use super::border::Border;
use super::reduce::Known;
use super::tree::{FANOUT, Group, MOST_LEVELS, Tree};
use crate::lanes::Lanes;

/// By how much a box is widened, as a share of how far it is and how large, for all that is rounded on the way of a ray
/// to it and of its spans: 256 units roundoff, where the formulas of this crate promise far fewer.
pub(crate) const OF_DISTANCE: f32 = 1.0 / 65_536.0;

/// Rays that are taken together through a tree.
pub(crate) trait Meets<T: Lanes> {
    /// Which of a group's boxes any of the rays may meet, and from where on; where the boxes are those of `items`, by the
    /// rays of which packets.
    fn meet(&self, token: T::Token, group: &Group, items: bool, met: &mut Met);

    /// What all of the rays see of a half-space, all the way.
    #[inline(always)]
    fn see(&self, _: &Border) -> Known {
        Known::Open
    }
}

/// For the boxes of a group: which are met, from where on, and by whom.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met {
    /// The bits of the boxes that are met.
    pub(crate) bits: u32,
    /// The least parameter at which a ray meets each.
    pub(crate) near: [f32; FANOUT],
    /// The bits of the packets whose rays may meet each.
    pub(crate) touched: [u32; FANOUT],
}

impl Met {
    /// None of the boxes.
    pub(crate) const NOTHING: Self = Self {
        bits: 0,
        near: [0.0; FANOUT],
        touched: [0; FANOUT],
    };
}

/// A walk of rays through a tree, roughly from near to far.
#[derive(Debug)]
pub(crate) struct Walk {
    /// Groups still to be visited: level, number, and the least parameter at which a ray meets them.
    waiting: [(u8, u32, f32); MOST_LEVELS * FANOUT],
    length: usize,
    /// What the rays meet in the group at hand.
    pub(crate) met: Met,
}

impl Walk {
    /// A walk that is over.
    pub(crate) fn new() -> Self {
        Self {
            waiting: [(0, 0, 0.0); MOST_LEVELS * FANOUT],
            length: 0,
            met: Met::NOTHING,
        }
    }

    /// Begins at the top of a tree.
    #[inline(always)]
    pub(crate) fn begin(&mut self, tree: &Tree) {
        self.length = 0;
        if let Some(top) = tree.top() {
            self.push(top, 0, 0.0);
        }
    }

    #[inline(always)]
    fn push(&mut self, level: usize, group: usize, near: f32) {
        if let Some(place) = self.waiting.get_mut(self.length) {
            *place = (level as u8, group as u32, near);
            self.length += 1;
        }
    }

    /// Whether there is no group left to visit.
    #[inline(always)]
    pub(crate) fn is_over(&self) -> bool {
        self.length == 0
    }

    /// Goes on to the next group of items that a ray meets nearer than `far`, and tells the number of its first item;
    /// its boxes are in `met`.
    #[inline(always)]
    pub(crate) fn next<T: Lanes, M: Meets<T>>(&mut self, token: T::Token, tree: &Tree, rays: &M, far: f32) -> Option<usize> {
        while let Some(last) = self.length.checked_sub(1) {
            self.length = last;
            let (level, number, near) = *self.waiting.get(last)?;
            if far <= near {
                continue;
            }
            let (level, number) = (usize::from(level), number as usize);
            let (group, held) = tree.group(level, number)?;
            rays.meet(token, group, level == 0, &mut self.met);
            self.met.bits &= held;
            if level == 0 {
                return Some(number * FANOUT);
            }
            // The nearest is pushed last, to be visited first.
            let mut order = Nearest::new(&self.met);
            let from = self.length;
            while let Some(place) = order.next() {
                self.push(level - 1, number * FANOUT + place, self.met.near[place]);
            }
            if let Some(pushed) = self.waiting.get_mut(from..self.length) {
                pushed.reverse();
            }
        }
        None
    }
}

/// The places of the boxes that are met, from near to far.
#[derive(Debug)]
pub(crate) struct Nearest {
    places: [u8; FANOUT],
    length: usize,
    given: usize,
}

impl Nearest {
    /// None.
    pub(crate) const NONE: Self = Self {
        places: [0; FANOUT],
        length: 0,
        given: 0,
    };

    #[inline(always)]
    pub(crate) fn new(met: &Met) -> Self {
        let mut sorted = Self::NONE;
        let mut bits = met.bits;
        while bits != 0 {
            let place = bits.trailing_zeros() as usize & (FANOUT - 1);
            bits &= bits - 1;
            let mut at = sorted.length;
            while at > 0 && met.near[place] < met.near[usize::from(sorted.places[at - 1]) & (FANOUT - 1)] {
                sorted.places[at] = sorted.places[at - 1];
                at -= 1;
            }
            sorted.places[at] = place as u8;
            sorted.length += 1;
        }
        sorted
    }

    #[inline(always)]
    pub(crate) fn next(&mut self) -> Option<usize> {
        if self.given == self.length {
            return None;
        }
        let place = usize::from(self.places[self.given]) & (FANOUT - 1);
        self.given += 1;
        Some(place)
    }
}
