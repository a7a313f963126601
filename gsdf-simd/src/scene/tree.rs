//! Boxes in groups of sixteen, the groups in boxes again: what a beam of rays asks which of many things it can meet.

use super::reach::Reach;
use glam::Vec3;

/// How many boxes are tested at once.
pub(crate) const FANOUT: usize = 16;

/// The most levels of groups: sixteen to the sixth is the most leaves that a program has.
pub(crate) const MOST_LEVELS: usize = 6;

/// Sixteen boxes, coordinate by coordinate. Those beyond the last one are of any size.
#[derive(Clone, Debug)]
pub(crate) struct Group {
    pub(crate) center: [[f32; FANOUT]; 3],
    pub(crate) half: [[f32; FANOUT]; 3],
}

/// Boxes of items, packed: item `i` is in place `i % 16` of group `i / 16` of the lowest level, and so on up to the one
/// group at the top.
///
/// Nothing but the order of the items decides which are together; [`order`] finds a good one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tree {
    /// The levels, from the lowest, one after the other.
    groups: Vec<Group>,
    /// Of each level where it starts in `groups`, and how many boxes it holds.
    levels: Vec<(u32, u32)>,
}

impl Tree {
    /// The tree over these boxes, which must be at most 2^24.
    pub(crate) fn new(boxes: &[Reach]) -> Self {
        let mut tree = Self::default();
        let mut level = boxes.to_vec();
        while !level.is_empty() {
            tree.levels.push((tree.groups.len() as u32, level.len() as u32));
            let above: Vec<Reach> = level
                .chunks(FANOUT)
                .map(|boxes| {
                    tree.groups.push(Group::new(boxes));
                    boxes.iter().copied().reduce(Reach::joined).unwrap_or(Reach::EVERYWHERE)
                })
                .collect();
            level = if above.len() > 1 { above } else { Vec::new() };
        }
        tree
    }

    /// The level of the group at the top; `None` where there is nothing.
    #[inline(always)]
    pub(crate) fn top(&self) -> Option<usize> {
        self.levels.len().checked_sub(1)
    }

    /// A group of a level, with the bits of those of its places that hold a box.
    #[inline(always)]
    pub(crate) fn group(&self, level: usize, group: usize) -> Option<(&Group, u32)> {
        let (start, boxes) = *self.levels.get(level)?;
        let held = (boxes as usize).checked_sub(group * FANOUT)?.min(FANOUT);
        Some((self.groups.get(start as usize + group)?, (1 << held) - 1))
    }

    /// How many bytes it takes.
    pub(crate) fn bytes(&self) -> usize {
        self.groups.capacity() * size_of::<Group>()
    }
}

impl Group {
    fn new(boxes: &[Reach]) -> Self {
        let mut group = Self {
            center: [[0.0; FANOUT]; 3],
            half: [[0.0; FANOUT]; 3],
        };
        for (place, reach) in boxes.iter().enumerate().take(FANOUT) {
            for axis in 0..3 {
                group.center[axis][place] = reach.center[axis];
                group.half[axis][place] = reach.half[axis];
            }
        }
        group
    }
}

/// The numbers of the boxes in an order in which neighbours in space are near each other: along the curve of G. M. Morton
/// (1966), through their centres.
pub(crate) fn order(boxes: &[Reach]) -> Vec<u32> {
    let bounded = || boxes.iter().filter(|reach| !reach.is_everywhere()).map(|reach| reach.center);
    let least = bounded().reduce(Vec3::min).unwrap_or(Vec3::ZERO);
    let extent = (bounded().reduce(Vec3::max).unwrap_or(Vec3::ZERO) - least).max_element();
    // One scale for all axes: what is flat is divided along its plane alone.
    let scale = if extent > 0.0 { CELLS / extent } else { 0.0 };
    let mut keys: Vec<(u64, u32)> = (boxes.iter().zip(0..))
        .map(|(reach, number)| {
            let [x, y, z] = ((reach.center - least) * scale).to_array().map(|cell| spread(cell as u64));
            (x | y << 1 | z << 2, number)
        })
        .collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, number)| number).collect()
}

/// The cells along each axis of the curve, less a half: 21 bits.
const CELLS: f32 = 2_097_151.5;

/// The lowest 21 bits of a number, each three places from the next.
fn spread(cell: u64) -> u64 {
    let mut bits = cell & 0x1f_ffff;
    for (shift, mask) in [
        (32, 0x001f_0000_0000_ffff),
        (16, 0x001f_0000_ff00_00ff),
        (8, 0x100f_00f0_0f00_f00f),
        (4, 0x10c3_0c30_c30c_30c3),
        (2, 0x1249_2492_4924_9249),
    ] {
        bits = (bits | bits << shift) & mask;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::{FANOUT, Tree, order, spread};
    use crate::scene::reach::Reach;
    use glam::{Vec3, vec3};

    fn at(x: f32, y: f32, z: f32) -> Reach {
        Reach {
            center: vec3(x, y, z),
            half: Vec3::splat(0.25),
        }
    }

    #[test]
    fn bits_are_spread_three_apart() {
        for cell in [0, 1, 0b101, 0x1f_ffff, 0x15_5555] {
            let expected = (0..21).filter(|bit| cell >> bit & 1 == 1).map(|bit| 1 << (3 * bit)).sum::<u64>();
            assert_eq!(spread(cell), expected);
        }
    }

    #[test]
    fn every_box_is_in_its_place_and_in_the_boxes_above() {
        let boxes: Vec<_> = (0..1000_u16)
            .map(|i| at(f32::from(i % 10), f32::from(i / 10 % 10), f32::from(i / 100)))
            .collect();
        let order = order(&boxes);
        let sorted: Vec<_> = order.iter().map(|&number| boxes[number as usize]).collect();
        let tree = Tree::new(&sorted);
        assert_eq!(tree.top(), Some(2));
        for (item, reach) in sorted.iter().enumerate() {
            let mut index = item;
            for level in 0..3 {
                let (group, held) = tree.group(level, index / FANOUT).unwrap();
                let place = index % FANOUT;
                assert!(held >> place & 1 == 1);
                for axis in 0..3 {
                    let (center, half) = (group.center[axis][place], group.half[axis][place]);
                    assert!(center - half <= reach.center[axis] - reach.half[axis]);
                    assert!(center + half >= reach.center[axis] + reach.half[axis]);
                }
                index /= FANOUT;
            }
        }
        let (_, held) = tree.group(0, 999 / FANOUT).unwrap();
        assert_eq!(held.count_ones() as usize, 1000 % FANOUT);
        assert!(tree.group(0, 1000 / FANOUT + 1).is_none() && tree.group(3, 0).is_none());
    }

    #[test]
    fn the_order_keeps_cubes_of_neighbours_together() {
        let boxes: Vec<_> = (0..4096_u16)
            .map(|i| at(f32::from(i % 16), f32::from(i / 16 % 16), f32::from(i / 256)))
            .collect();
        let order = order(&boxes);
        for sixteen in order.chunks(16) {
            let centers = || sixteen.iter().map(|&number| boxes[number as usize].center);
            let extent = centers().reduce(Vec3::max).unwrap() - centers().reduce(Vec3::min).unwrap();
            assert!(extent.max_element() <= 3.0 && extent.element_sum() <= 5.0, "{extent}");
        }
    }

    #[test]
    fn what_is_everywhere_disturbs_no_order() {
        let boxes = [at(5.0, 0.0, 0.0), Reach::EVERYWHERE, at(1.0, 0.0, 0.0)];
        assert_eq!(order(&boxes).len(), 3);
        let flat = [at(1.0, 1.0, 1.0); 3];
        assert_eq!(order(&flat), [0, 1, 2]);
    }
}
