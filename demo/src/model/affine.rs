//! Affine maps in double precision, and where a solid stands: in a frame that is turned, and within it without a turn.

/// A vector of the model.
pub type Vector = [f64; 3];

/// The map `x -> linear x + translation`, the matrix by rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// The matrix, by rows.
    pub linear: [Vector; 3],
    /// Where the origin goes.
    pub translation: Vector,
}

/// What is left of a sum by rounding alone is less than this part of its terms.
const CANCELLED: f64 = 1e-13;

/// A sum of products, and zero where its terms cancel but for their rounding: a face that is moved away and back is where
/// it was.
fn sum_of_products<const N: usize>(pairs: [(f64, f64); N]) -> f64 {
    let (sum, size) = pairs.iter().fold((0.0, 0.0), |(sum, size): (f64, f64), (a, b)| (sum + a * b, size + (a * b).abs()));
    // The negative zero, too, becomes zero.
    if sum.abs() <= CANCELLED * size { 0.0 } else { sum }
}

/// The scalar product.
#[must_use]
pub fn dot(a: Vector, b: Vector) -> f64 {
    sum_of_products([(a[0], b[0]), (a[1], b[1]), (a[2], b[2])])
}

/// The vector product.
#[must_use]
pub fn cross(a: Vector, b: Vector) -> Vector {
    core::array::from_fn(|axis| {
        let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
        sum_of_products([(a[next], b[last]), (-a[last], b[next])])
    })
}

/// The difference of two points.
#[must_use]
pub fn minus(a: Vector, b: Vector) -> Vector {
    core::array::from_fn(|axis| a[axis] - b[axis])
}

/// The length.
#[must_use]
pub fn length(v: Vector) -> f64 {
    v[0].hypot(v[1]).hypot(v[2])
}

impl Affine {
    /// The map that moves nothing.
    pub const IDENTITY: Self = Self::scaling([1.0; 3]);

    /// The map that stretches along the axes.
    #[must_use]
    pub const fn scaling(by: Vector) -> Self {
        Self {
            linear: [[by[0], 0.0, 0.0], [0.0, by[1], 0.0], [0.0, 0.0, by[2]]],
            translation: [0.0; 3],
        }
    }

    /// Where a point goes.
    #[must_use]
    pub fn point(&self, point: Vector) -> Vector {
        core::array::from_fn(|row| {
            let [x, y, z] = self.linear[row];
            sum_of_products([(x, point[0]), (y, point[1]), (z, point[2]), (1.0, self.translation[row])])
        })
    }

    /// Where a vector goes, which is no place.
    #[must_use]
    pub fn vector(&self, vector: Vector) -> Vector {
        self.linear.map(|row| dot(row, vector))
    }

    /// The map that does `first` and then this.
    #[must_use]
    pub fn after(&self, first: &Self) -> Self {
        let columns: [Vector; 3] = core::array::from_fn(|column| self.vector(first.linear.map(|row| row[column])));
        Self {
            linear: core::array::from_fn(|row| columns.map(|column| column[row])),
            translation: self.point(first.translation),
        }
    }

    /// The determinant of the matrix.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        dot(self.linear[0], cross(self.linear[1], self.linear[2]))
    }

    /// The matrix that takes normals of planes along: the inverse transposed, times the determinant.
    #[must_use]
    pub fn cofactors(&self) -> Self {
        let [x, y, z] = self.linear;
        Self {
            linear: [cross(y, z), cross(z, x), cross(x, y)],
            translation: [0.0; 3],
        }
    }

    /// The map that undoes this one, whose determinant must not be zero.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let (cofactors, determinant) = (self.cofactors().linear, self.determinant());
        let linear = core::array::from_fn(|row| cofactors.map(|column| column[row] / determinant));
        let turned = Self {
            linear,
            translation: [0.0; 3],
        };
        Self {
            translation: turned.point(self.translation).map(|coordinate| 0.0 - coordinate),
            ..turned
        }
    }

    /// The axis along which each axis goes, by their numbers, if it is axes they go along: then the map is made of quarter
    /// turns, mirrors, stretches along the axes and a translation.
    #[must_use]
    pub fn axes(&self) -> Option<[usize; 3]> {
        let mut axes = [3; 3];
        for (number, row) in self.linear.iter().enumerate() {
            let mut filled = (0..3).filter(|column| row[*column] != 0.0);
            match (filled.next(), filled.next()) {
                (Some(column), None) if axes[column] == 3 => axes[column] = number,
                _ => return None,
            }
        }
        Some(axes)
    }
}

/// Where a solid stands.
///
/// The frame is the world turned, sheared or stretched about its origin; within it solids are only moved, stretched and
/// turned by quarters, which can be written into their numbers: faces that coincide within a frame then have the same
/// numbers, and all that was turned alike shares a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The frame in the world: a matrix alone.
    pub frame: Affine,
    /// The solid in the frame.
    pub within: Affine,
}

impl Placement {
    /// As it is.
    pub const WORLD: Self = Self {
        frame: Affine::IDENTITY,
        within: Affine::IDENTITY,
    };

    /// What is placed by `inner` in what is placed like this; `None` where that leaves it no volume.
    #[must_use]
    pub fn then(&self, inner: &Affine) -> Option<Self> {
        if inner.axes().is_some() {
            let within = self.within.after(inner);
            return Some(Self { within, ..*self });
        }
        let whole = self.frame.after(&self.within.after(inner));
        Self::of(&whole)
    }

    /// The placement by a single map; `None` where that leaves no volume.
    fn of(whole: &Affine) -> Option<Self> {
        if whole.determinant() == 0.0 {
            return None;
        }
        if whole.axes().is_some() {
            return Some(Self {
                within: *whole,
                ..Self::WORLD
            });
        }
        let frame = Affine {
            translation: [0.0; 3],
            ..*whole
        };
        let within = Affine {
            translation: frame.inverse().point(whole.translation),
            ..Affine::IDENTITY
        };
        Some(Self { frame, within })
    }

    /// By how much each axis of the solid is stretched within the frame.
    #[must_use]
    pub fn stretches(&self) -> Vector {
        core::array::from_fn(|column| self.within.linear.iter().map(|row| row[column].abs()).sum())
    }

    /// The same place in a frame that is stretched so much more along the axes of the solid, and the solid so much less.
    #[must_use]
    pub fn stretched(&self, by: Vector) -> Self {
        let axes = self.within.axes().unwrap_or([0, 1, 2]);
        let mut along = [1.0; 3];
        for (axis, by) in axes.into_iter().zip(by) {
            along[axis] = by;
        }
        Self {
            frame: self.frame.after(&Affine::scaling(along)),
            within: Affine::scaling(along.map(f64::recip)).after(&self.within),
        }
    }

    /// The factor by which the frame stretches every length, if it is the same for all to the digits that OpenSCAD writes.
    #[must_use]
    pub fn similarity(&self) -> Option<f64> {
        /// OpenSCAD writes six digits.
        const WRITTEN: f64 = 4e-6;
        let factor = self.frame.determinant().abs().cbrt();
        let rows = self.frame.linear;
        let square = factor * factor;
        let is_similar = (0..3).all(|a| (0..3).all(|b| (dot(rows[a], rows[b]) / square - f64::from(u8::from(a == b))).abs() <= WRITTEN));
        is_similar.then_some(factor)
    }
}

#[cfg(test)]
mod tests {
    use super::{Affine, Placement, Vector};

    fn turned(degrees: f64) -> Affine {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        Affine {
            linear: [[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]],
            translation: [0.0; 3],
        }
    }

    fn moved(by: Vector) -> Affine {
        Affine {
            translation: by,
            ..Affine::IDENTITY
        }
    }

    fn is_near(a: Vector, b: Vector) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12)
    }

    #[test]
    fn what_is_moved_away_and_back_is_where_it_was() {
        let away = moved([0.1, 0.0, 0.0]).after(&moved([0.2, 0.0, 0.0]));
        assert_ne!(0.1 + 0.2 - 0.3, 0.0);
        assert_eq!(moved([-0.3, 0.0, 0.0]).after(&away), Affine::IDENTITY);
    }

    #[test]
    fn inverses_undo() {
        let map = moved([1.0, -2.0, 0.5]).after(&turned(30.0)).after(&Affine::scaling([2.0, -3.0, 0.25]));
        let point = [0.3, 0.7, -1.1];
        assert!(is_near(map.inverse().point(map.point(point)), point));
        assert!((map.determinant() + 1.5).abs() < 1e-12);
    }

    #[test]
    fn quarter_turns_and_mirrors_stay_within_the_frame() {
        let quarter = Affine {
            linear: [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -2.0]],
            translation: [1.0, 2.0, 3.0],
        };
        assert_eq!(quarter.axes(), Some([1, 0, 2]));
        let placed = Placement::WORLD.then(&quarter).expect("it has a volume");
        assert_eq!((placed.frame, placed.within), (Affine::IDENTITY, quarter));
        assert_eq!(placed.stretches(), [1.0, 1.0, 2.0]);
    }

    #[test]
    fn what_is_turned_alike_shares_a_frame_wherever_it_is() {
        let turn = turned(30.0);
        let here = Placement::WORLD.then(&turn).expect("it has a volume");
        let there = Placement::WORLD.then(&moved([5.0, 6.0, 7.0])).and_then(|moved| moved.then(&turn));
        let there = there.expect("it has a volume");
        assert_eq!(here.frame, there.frame);
        let back = there.frame.after(&there.within).point([0.0; 3]);
        assert!(is_near(back, [5.0, 6.0, 7.0]));
        assert!((there.similarity().expect("it is a turn") - 1.0).abs() < 1e-12);
    }

    #[test]
    fn stretching_the_frame_moves_nothing() {
        let placed = Placement {
            frame: turned(20.0),
            within: Affine {
                linear: [[0.0, 3.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 4.0]],
                translation: [1.0, 2.0, 3.0],
            },
        };
        let stretched = placed.stretched([1.0, 1.5, 1.0]);
        assert_eq!(stretched.stretches(), [2.0, 2.0, 4.0]);
        let point = [0.3, -0.2, 0.9];
        let [before, after] = [placed, stretched].map(|placed| placed.frame.after(&placed.within).point(point));
        assert!(is_near(before, after));
        assert_eq!(stretched.similarity(), None);
    }

    #[test]
    fn flat_maps_leave_nothing() {
        assert_eq!(Placement::WORLD.then(&Affine::scaling([1.0, 0.0, 1.0])), None);
    }
}
