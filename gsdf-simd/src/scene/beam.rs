//! The rays of a rectangle of pixels, as one thing that meets boxes or does not.

use super::border::Border;
use super::reduce::Known;
use super::tree::{FANOUT, Group};
use super::walk::{Meets, Met, OF_DISTANCE};
use crate::lanes::{LaneMask, Lanes, MOST_LANES};
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
    /// The direction of the ray through the middle, and what is across the picture.
    toward: Vec3,
    sides: [Vec3; 2],
    /// What is to be subtracted from coordinates along `right` and `up`, where the rays are parallel.
    middle: [f32; 2],
    /// Half the side of the square, where the depth is one.
    half: f32,
    /// How many pixels one unit across makes, where the depth is one.
    pixels: f32,
    spread: bool,
    /// How packets lie in the square.
    packets: Grid,
    /// How much longer than a unit vector `right` and `up` may be.
    skew: f32,
}

/// How the packets of a tile cover its pixels: four side by side, row by row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    /// The number of rows of pixels that a packet has, as a power of two.
    height_bits: u32,
}

impl Grid {
    /// The side of a tile, in pixels.
    pub(crate) const SIDE: u32 = 16;

    /// The grid of packets that have so many rows of pixels: a power of two.
    pub(crate) const fn new(height: u32) -> Self {
        Self {
            height_bits: height.trailing_zeros(),
        }
    }

    /// The bits of the packets between these pixels, both included.
    #[inline(always)]
    fn within(self, left: u32, right: u32, top: u32, bottom: u32) -> u32 {
        let (first, last) = (left >> 2 & 3, right >> 2 & 3);
        let columns = (2_u32 << last).wrapping_sub(1 << first) & 0xf;
        let (highest, lowest) = (top >> self.height_bits & 7, bottom >> self.height_bits & 7);
        let rows = (2_u64 << (4 * lowest + 3)).wrapping_sub(1 << (4 * highest)) as u32;
        (columns * 0x1111_1111) & rows
    }
}

/// How far, in pixels, a ray may be off its place in the square by rounding.
const OF_PIXEL: f32 = 1.0 / 64.0;

impl Beam {
    /// The beam through the square of `side` pixels whose left upper corner is pixel (`x`, `y`). Which packets touch a box is
    /// told for the side of a tile alone.
    #[inline(always)]
    pub(crate) fn new(raster: &Raster, x: u32, y: u32, side: u32, packets: Grid) -> Self {
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
        let sides = [camera.right(), camera.up()];
        Self {
            eye: camera.eye(),
            toward: if spread {
                forward + sides[0] * across + sides[1] * upward
            } else {
                forward
            },
            sides,
            right,
            up,
            forward,
            middle,
            half: (half + OF_PIXEL) * pixel,
            pixels: 1.0 / pixel,
            spread,
            packets,
            skew: 1.0 + across.abs().max(upward.abs()),
        }
    }

    #[inline(always)]
    fn meet_some<T: Lanes>(&self, token: T::Token, group: &Group, from: usize, items: bool, met: &mut Met) {
        let some = from..from + T::LANES;
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
        near.max(zero).store(&mut met.near[some]);
        if !items {
            return;
        }

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
        let last = like.splat_like(Grid::SIDE as f32 - 1.0);
        let least = T::select(bounded, middle + (left * per_near).min(left * per_far) * pixels, zero);
        let most = T::select(bounded, middle + (right * per_near).max(right * per_far) * pixels, last);
        let highest = T::select(bounded, middle - (top * per_near).max(top * per_far) * pixels, zero);
        let lowest = T::select(bounded, middle - (bottom * per_near).min(bottom * per_far) * pixels, last);
        let mut sides = [[0; MOST_LANES]; 4];
        least.max(zero).min(last).store_numbers(&mut sides[0]);
        most.max(zero).min(last).store_numbers(&mut sides[1]);
        highest.max(zero).min(last).store_numbers(&mut sides[2]);
        lowest.max(zero).min(last).store_numbers(&mut sides[3]);
        let [left, right, top, bottom] = &sides;
        for place in 0..T::LANES {
            let touched = self.packets.within(left[place], right[place], top[place], bottom[place]);
            met.touched[(from + place) % FANOUT] = touched;
        }
    }
}

impl Beam {
    /// What all of the rays see of a half-space.
    #[inline(always)]
    pub(crate) fn see(&self, border: &Border) -> Known {
        let [right, up] = self.sides;
        let middle = self.eye + right * self.middle[0] + up * self.middle[1];
        let (apart, spread) = if self.spread { (0.0, self.half) } else { (self.half, 0.0) };
        border.seen(middle, apart, self.toward, spread, self.sides)
    }
}

impl<T: Lanes> Meets<T> for Beam {
    #[inline(always)]
    fn see(&self, border: &Border) -> Known {
        Beam::see(self, border)
    }

    #[inline(always)]
    fn meet(&self, token: T::Token, group: &Group, items: bool, met: &mut Met) {
        met.bits = 0;
        let mut from = 0;
        while from < FANOUT {
            self.meet_some::<T>(token, group, from, items, met);
            from += T::LANES;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Grid;

    #[test]
    fn rectangles_touch_packets() {
        let touched = |left, right, top, bottom| Grid::new(2).within(left, right, top, bottom);
        assert_eq!(touched(0, 15, 0, 15), u32::MAX);
        assert_eq!(touched(0, 0, 0, 0), 1);
        assert_eq!(touched(4, 4, 2, 2), 1 << 5);
        assert_eq!(touched(3, 4, 0, 1), 0b11);
        assert_eq!(touched(15, 15, 15, 15), 1 << 31);
        assert_eq!(touched(0, 1, 1, 2), 0b1_0001);
        assert_eq!(Grid::new(4).within(0, 15, 0, 15) & 0xffff, 0xffff);
        assert_eq!(Grid::new(4).within(5, 9, 5, 13), 0x6660);
    }
}
