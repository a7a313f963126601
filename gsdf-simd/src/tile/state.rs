//! What is known of a tile while its parts are visited, and where it is kept.

use super::product::Product;
use super::rays::{MOST_PACKETS, Rays};
use crate::lanes::Lanes;
use crate::scene::{Known, Most, Open, Waiting, Walk};
use gsdf_nostd::{Mask, Node, Span};

/// How many spans a march keeps at once; of programs with more leaves fewer packets are marched together.
pub(crate) const MOST_SPANS: usize = 8192;

/// How many complements of a part are looked at together.
pub(crate) const MOST_CUTS: usize = 64;

/// The nearest that the rays of a tile have met so far.
#[derive(Debug)]
pub(crate) struct Met<T: Lanes> {
    /// Where each ray first enters what was visited, in the parameter of its line; infinite where it does not.
    t: [T; MOST_PACKETS],
    /// The number of the leaf there.
    leaf: [T; MOST_PACKETS],
    /// The packets of which that is known. The rays of all others have met nothing.
    pub(crate) touched: u32,
    /// The packets of which a ray starts inside what was visited.
    pub(crate) inside: u32,
}

impl<T: Lanes> Met<T> {
    #[inline(always)]
    pub(crate) fn new(token: T::Token) -> Self {
        let infinity = T::splat(token, f32::INFINITY);
        Self {
            t: [infinity; MOST_PACKETS],
            leaf: [infinity; MOST_PACKETS],
            touched: 0,
            inside: 0,
        }
    }

    /// Forgets everything.
    #[inline(always)]
    pub(crate) fn clear(&mut self) {
        (self.touched, self.inside) = (0, 0);
    }

    /// Where the rays of a packet that was touched first enter what was visited, and the leaf they meet there.
    #[inline(always)]
    pub(crate) fn packet(&self, packet: usize) -> (T, T) {
        let packet = packet % MOST_PACKETS;
        (self.t[packet], self.leaf[packet])
    }

    /// Beyond what the rays of a packet need not look for anything.
    #[inline(always)]
    pub(crate) fn nearest(&self, packet: usize, infinity: T) -> T {
        let packet = packet % MOST_PACKETS;
        if self.touched >> packet & 1 == 1 {
            self.t[packet]
        } else {
            infinity
        }
    }

    /// The rays of a packet are inside of another part, a leaf of this number, along a span.
    #[inline(always)]
    pub(crate) fn enter_span(&mut self, packet: usize, span: Span<T>, number: T, start: T) {
        let ahead = start.lt(span.enter);
        let entered = span.enter.lt(span.exit);
        if (entered & !ahead & start.lt(span.exit)).any() {
            self.inside |= 1 << packet;
        }
        let entered = entered & ahead;
        if entered.any() {
            self.enter(packet, T::select(entered, span.enter, start.splat_like(f32::INFINITY)), number);
        }
    }

    /// Where the rays of a packet enter another part, or do not, at +inf; and the leaf there. Of two at the same place
    /// the one with the lower number counts.
    #[inline(always)]
    pub(crate) fn enter(&mut self, packet: usize, t: T, leaf: T) {
        let packet = packet % MOST_PACKETS;
        if self.touched >> packet & 1 == 0 {
            self.replace(packet, t, leaf);
            return;
        }
        let (before, other) = (self.t[packet], self.leaf[packet]);
        let nearer = t.lt(before) | (t.eq(before) & leaf.lt(other));
        self.t[packet] = T::select(nearer, t, before);
        self.leaf[packet] = T::select(nearer, leaf, other);
    }

    /// The same, whatever was before.
    #[inline(always)]
    pub(crate) fn replace(&mut self, packet: usize, t: T, leaf: T) {
        let packet = packet % MOST_PACKETS;
        self.touched |= 1 << packet;
        (self.t[packet], self.leaf[packet]) = (t, leaf);
    }

    /// Those of some packets that still have a ray which has met nothing nearer than `depth`.
    #[inline(always)]
    pub(crate) fn open(&self, rays: &Rays<T>, which: u32, depth: f32) -> u32 {
        let mut open = which & !self.touched;
        let mut bits = which & self.touched;
        while bits != 0 {
            let packet = bits.trailing_zeros() as usize % MOST_PACKETS;
            bits &= bits - 1;
            let (_, scale, _) = rays.packet(packet);
            if scale.splat_like(depth).le(self.t[packet] * scale).any() {
                open |= 1 << packet;
            }
        }
        open
    }

    /// The depth beyond which no ray of the tile looks for anything.
    #[inline(always)]
    pub(crate) fn farthest(&self, rays: &Rays<T>) -> f32 {
        if self.touched != rays.present() {
            return f32::INFINITY;
        }
        let (_, scale, _) = rays.packet(0);
        let mut farthest = self.t[0] * scale;
        let mut bits = self.touched & !1;
        while bits != 0 {
            let packet = bits.trailing_zeros() as usize % MOST_PACKETS;
            bits &= bits - 1;
            let (_, scale, _) = rays.packet(packet);
            farthest = farthest.max(self.t[packet] * scale);
        }
        farthest.greatest()
    }

    /// The depth beyond which no ray of a packet looks for anything.
    #[inline(always)]
    pub(crate) fn farthest_of(&self, rays: &Rays<T>, packet: usize) -> f32 {
        if self.touched >> packet & 1 == 0 {
            return f32::INFINITY;
        }
        let (_, scale, _) = rays.packet(packet);
        (self.t[packet % MOST_PACKETS] * scale).greatest()
    }

    /// Whether every ray of a packet has met something nearer than a limit, but for those in some lanes.
    #[inline(always)]
    pub(crate) fn all_nearer(&self, packet: usize, limit: T, others: T::Mask) -> bool {
        (self.t[packet % MOST_PACKETS].lt(limit) | others).all()
    }
}

/// Memory for the rendering of tiles, kept from one to the next.
#[derive(Debug)]
pub(crate) struct Workspace<T: Lanes, L> {
    pub(crate) rays: Rays<T>,
    pub(crate) met: Met<T>,
    /// The walk through the parts of the scene, and those through the leaves of a part.
    pub(crate) walk: Walk,
    pub(crate) inner_walk: Walk,
    /// Spans, packet by packet or leaf by leaf.
    pub(crate) spans: Vec<Span<T>>,
    /// The product at hand.
    pub(crate) product: Product<T>,
    /// What a march walks: a program without what the tile's rays cannot meet.
    pub(crate) nodes: Vec<Node<L>>,
    /// The places of its leaves in the scene.
    pub(crate) places: Vec<u32>,
    /// What the tile's rays see of the leaves of the whole program.
    pub(crate) known: Vec<Known>,
    /// Those of a part that they meet.
    pub(crate) met_leaves: Vec<(u32, Known)>,
    /// The joints that are open while a part is reduced.
    pub(crate) open: Vec<Open>,
    /// The operands that wait while a program is reduced: whether they are known to be inside or outside, and where
    /// their nodes and leaves start.
    pub(crate) waiting: Vec<Waiting>,
    /// The complements that the tile's rays may meet, with the packets they touch.
    pub(crate) cuts: Vec<(u32, u32)>,
    /// How many spans of packets were computed.
    pub(crate) computed: u64,
}

impl<T: Lanes, L> Workspace<T, L> {
    #[inline(always)]
    pub(crate) fn new(token: T::Token) -> Self {
        let nothing = T::splat(token, f32::INFINITY);
        let empty = Span {
            enter: nothing,
            exit: -nothing,
        };
        Self {
            rays: Rays::new(token),
            met: Met::new(token),
            walk: Walk::new(),
            inner_walk: Walk::new(),
            spans: vec![empty; MOST_CUTS * MOST_PACKETS],
            product: Product::new(token),
            nodes: Vec::new(),
            places: Vec::new(),
            known: Vec::new(),
            met_leaves: Vec::new(),
            open: Vec::new(),
            waiting: Vec::new(),
            cuts: Vec::new(),
            computed: 0,
        }
    }

    /// Makes room for parts of so many complements, and for marches of parts of so many leaves.
    pub(crate) fn make_room(&mut self, most: Most) {
        let Most { cuts, marched } = most;
        self.cuts.reserve(cuts);
        self.nodes.reserve(2 * marched);
        self.places.reserve(marched);
        self.met_leaves.reserve(marched);
        self.open.reserve(marched);
        let spans = (marched * MOST_PACKETS).min(marched.max(MOST_SPANS));
        if let (Some(empty), true) = (self.spans.first().copied(), self.spans.len() < spans) {
            self.spans.resize(spans, empty);
        }
    }
}
