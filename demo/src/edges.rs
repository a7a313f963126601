//! Which pixels want more than one ray, and where the rays go.

use crate::frame::Met;
use crate::palette::to_srgb;
use glam::Vec3;

/// The difference of two bytes of a picture from which on an edge between them is seen.
const CONTRAST: u8 = 9;

/// A row as it is before edges are looked for: what its rays met, and the bytes it would become.
#[derive(Clone, Copy, Debug)]
pub struct Row<'a> {
    /// What the ray of each pixel met.
    pub met: &'a [Option<Met>],
    /// Its colour, as [`bytes`] gives it.
    pub bytes: &'a [[u8; 3]],
}

/// Linear colours as the bytes of a picture.
#[must_use]
pub fn bytes(colours: &[Vec3]) -> Vec<[u8; 3]> {
    colours.iter().map(|&colour| to_srgb(colour)).collect()
}

impl Row<'_> {
    /// Whether pixel `x` of this row differs from pixel `other_x` of another: by what it shows, or by its light.
    fn differs(&self, x: usize, other: &Row<'_>, other_x: usize) -> bool {
        let leaf = |row: &Row<'_>, x: usize| row.met.get(x).map(|met| met.map(|met| (met.leaf, met.face)));
        let (Some(here), Some(there)) = (self.bytes.get(x), other.bytes.get(other_x)) else {
            return false;
        };
        leaf(self, x) != leaf(other, other_x) || here.iter().zip(there).any(|(a, b)| a.abs_diff(*b) > CONTRAST)
    }

    /// The pixels of this row that differ from one of their eight neighbours; `around` are the rows above and below, as far as there are any.
    pub fn edges<'l>(&'l self, around: &'l [Row<'l>]) -> impl Iterator<Item = usize> + 'l {
        (0..self.bytes.len()).filter(move |&x| {
            // What would be left of the first pixel is beyond the end of the row.
            let columns = [x.wrapping_sub(1), x, x + 1];
            let beside = columns.iter().any(|&column| self.differs(x, self, column));
            beside || around.iter().any(|row| columns.iter().any(|&column| self.differs(x, row, column)))
        })
    }
}

/// `side` x `side` places of the unit square, one in each of as many cells, no two in one fine row or column: an edge of any slope has as many shades.
pub fn grid(side: u32) -> impl Iterator<Item = [f32; 2]> {
    let fine = move |coarse: u32, within: u32| (coarse as f32 + (within as f32 + 0.5) / side as f32) / side as f32;
    (0..side * side).map(move |number| {
        let (row, column) = (number / side, number % side);
        [fine(column, row), fine(row, side - 1 - column)]
    })
}

#[cfg(test)]
mod tests {
    use super::{Row, grid};

    #[test]
    fn places_share_neither_rows_nor_columns() {
        for side in [1, 2, 4] {
            let count = side * side;
            for axis in [0, 1] {
                let mut cells: Vec<_> = grid(side).map(|place| (place[axis] * count as f32) as u32).collect();
                cells.sort_unstable();
                assert_eq!(cells, (0..count).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn edges_are_where_neighbours_differ() {
        let (dark, light) = ([10; 3], [200; 3]);
        let even = [dark; 5];
        fn row(bytes: &[[u8; 3]; 5]) -> Row<'_> {
            Row { met: &[None; 5], bytes }
        }
        let edges = |row: Row<'_>, around: &[Row<'_>]| row.edges(around).collect::<Vec<_>>();
        assert_eq!(edges(row(&[dark, dark, light, light, light]), &[]), [1, 2]);
        assert_eq!(edges(row(&even), &[row(&[dark, dark, dark, dark, light])]), [3, 4]);
        assert!(edges(row(&even), &[row(&even); 2]).is_empty());
    }
}
