//! The rays of a rectangle of pixels, as one thing that meets boxes or does not.

use super::tree::{FANOUT, Group, MOST_LEVELS, Tree};
use crate::lanes::{LaneMask, Lanes};
use glam::Vec3;
use gsdf_nostd::{Mask, Projection, Raster, V3};

/// The beam of all rays through a square of pixels of a raster: all that a pyramid (or for parallel rays a prism) holds
/// whose axis goes through the middle of the square.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Beam {
    eye: Vec3,
    /// Across the picture, as seen from a ray through the middle: zero on that ray.
    right: Vec3,
    up: Vec3,
    forward: Vec3,
    /// What is to be subtracted from coordinates along `right` and `up`, where the rays are parallel.
    middle: [f32; 2],
    /// Half the side of the square, where the depth is one.
    half: f32,
    /// How many pixels one unit across makes, where the depth is one.
    pixels: f32,
    spread: bool,
    /// How much longer than a unit vector `right` and `up` may be.
    skew: f32,
}

/// For the boxes of a group: which the beam may meet, where in its square, and from which depth on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Met {
    /// The bits of the boxes that are met.
    pub(crate) bits: u32,
    /// The least depth of each.
    pub(crate) near: [f32; FANOUT],
    /// From where to where it reaches in the square, in pixels from its left upper corner; perhaps beyond it.
    pub(crate) left: [f32; FANOUT],
    pub(crate) right: [f32; FANOUT],
    pub(crate) top: [f32; FANOUT],
    pub(crate) bottom: [f32; FANOUT],
}

impl Met {
    /// None of the boxes.
    pub(crate) const NOTHING: Self = Self {
        bits: 0,
        near: [0.0; FANOUT],
        left: [0.0; FANOUT],
        right: [0.0; FANOUT],
        top: [0.0; FANOUT],
        bottom: [0.0; FANOUT],
    };
}

/// By how much a box is widened, as a share of how far it is and how large, for all that is rounded on the way of a ray
/// to it and of its spans: 256 units roundoff, where the formulas of this crate promise far fewer.
const OF_DISTANCE: f32 = 1.0 / 65_536.0;

/// How far, in pixels, a ray may be off its place in the square by rounding.
const OF_PIXEL: f32 = 1.0 / 64.0;

impl Beam {
    /// The beam through the square of `side` pixels whose left upper corner is pixel (`x`, `y`).
    pub(crate) fn new(raster: &Raster, x: u32, y: u32, side: u32) -> Self {
        let camera = raster.camera();
        let pixel = raster.pixel();
        let half = 0.5 * side as f32;
        let across = (x as f32 + half - 0.5 * raster.width() as f32) * pixel;
        let upward = (0.5 * raster.height() as f32 - y as f32 - half) * pixel;
        let spread = camera.projection() == Projection::Pinhole;
        let forward = camera.forward();
        let (right, up, middle) = if spread {
            (camera.right() - forward * across, camera.up() - forward * upward, [0.0, 0.0])
        } else {
            (camera.right(), camera.up(), [across, upward])
        };
        Self {
            eye: camera.eye(),
            right,
            up,
            forward,
            middle,
            half: (half + OF_PIXEL) * pixel,
            pixels: 1.0 / pixel,
            spread,
            skew: 1.0 + across.abs().max(upward.abs()),
        }
    }

    /// Which of a group's boxes the beam may meet.
    #[inline(always)]
    pub(crate) fn meet<T: Lanes>(&self, token: T::Token, group: &Group, met: &mut Met) {
        met.bits = 0;
        let mut from = 0;
        while from < FANOUT {
            let to = from + T::LANES;
            self.meet_some::<T>(token, group, from, to, met);
            from = to;
        }
    }

    #[inline(always)]
    fn meet_some<T: Lanes>(&self, token: T::Token, group: &Group, from: usize, to: usize, met: &mut Met) {
        let some = from..to;
        let [x, y, z] = &group.center;
        let center = V3::new(
            T::load(token, &x[some.clone()]),
            T::load(token, &y[some.clone()]),
            T::load(token, &z[some.clone()]),
        );
        let [x, y, z] = &group.half;
        let half = V3::new(
            T::load(token, &x[some.clone()]),
            T::load(token, &y[some.clone()]),
            T::load(token, &z[some.clone()]),
        );
        let like = center.x;
        let (zero, one) = (like.splat_like(0.0), like.splat_like(1.0));
        let away = center - V3::splat(like, self.eye);
        let distance = (away.x.abs() + away.y.abs() + away.z.abs()) + (half.x + half.y + half.z);
        let margin = distance * like.splat_like(OF_DISTANCE * self.skew);
        let depth = away.dot(V3::splat(like, self.forward));
        let depth_half = half.dot(V3::splat(like, self.forward.abs())) + margin;
        let (near, far) = (depth - depth_half, depth + depth_half);
        let across = away.dot(V3::splat(like, self.right)) - like.splat_like(self.middle[0]);
        let across_half = half.dot(V3::splat(like, self.right.abs())) + margin;
        let upward = away.dot(V3::splat(like, self.up)) - like.splat_like(self.middle[1]);
        let upward_half = half.dot(V3::splat(like, self.up.abs())) + margin;
        let (left, right) = (across - across_half, across + across_half);
        let (bottom, top) = (upward - upward_half, upward + upward_half);

        // How wide the beam is at the far side of each box: nowhere wider within it.
        let reach = like.splat_like(self.half);
        let reach = if self.spread { reach * far } else { reach };
        let live = zero.le(far) & left.le(reach) & (-reach).le(right) & bottom.le(reach) & (-reach).le(top);
        met.bits |= (live.to_bits() & ((1 << T::LANES) - 1)) << from;
        if !live.any() {
            return;
        }
        near.max(zero).store(&mut met.near[some.clone()]);

        // Of a box in front of the eye the picture lies between those of its sides at the near and the far depth.
        let ahead = zero.lt(near);
        let (per_near, per_far) = if self.spread {
            (one / T::select(ahead, near, one), one / T::select(ahead, far, one))
        } else {
            (one, one)
        };
        let bounded = if self.spread { ahead } else { ahead.splat_like(true) };
        let pixels = like.splat_like(self.pixels);
        let middle = like.splat_like(self.half * self.pixels);
        let beyond = like.splat_like(1e6);
        let least = T::select(bounded, (left * per_near).min(left * per_far) * pixels, -beyond);
        let most = T::select(bounded, (right * per_near).max(right * per_far) * pixels, beyond);
        let lowest = T::select(bounded, (bottom * per_near).min(bottom * per_far) * pixels, -beyond);
        let highest = T::select(bounded, (top * per_near).max(top * per_far) * pixels, beyond);
        (middle + least).store(&mut met.left[some.clone()]);
        (middle + most).store(&mut met.right[some.clone()]);
        (middle - highest).store(&mut met.top[some.clone()]);
        (middle - lowest).store(&mut met.bottom[some]);
    }
}

/// A walk of a beam through a tree, roughly from near to far.
#[derive(Debug)]
pub(crate) struct Walk {
    /// Groups still to be visited: level, number, and the least depth at which the beam meets them.
    waiting: [(u8, u32, f32); MOST_LEVELS * FANOUT],
    length: usize,
    /// What the beam meets in the group at hand.
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

    /// Goes on to the next group of items that the beam meets nearer than `far`, and tells the number of its first item;
    /// its boxes are in `met`.
    #[inline(always)]
    pub(crate) fn next<T: Lanes>(&mut self, token: T::Token, tree: &Tree, beam: &Beam, far: f32) -> Option<usize> {
        while let Some(last) = self.length.checked_sub(1) {
            self.length = last;
            let (level, number, near) = *self.waiting.get(last)?;
            if far <= near {
                continue;
            }
            let (level, number) = (usize::from(level), number as usize);
            let (group, held) = tree.group(level, number)?;
            beam.meet::<T>(token, group, &mut self.met);
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
