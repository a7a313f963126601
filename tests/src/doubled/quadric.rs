//! Polynomials of degree two in space, known by their values at ten places.

use super::ball::Ball;
use crate::reference::Exact;

/// The places at which the values of a polynomial determine it.
pub(super) const PLACES: [[i32; 3]; 10] = [
    [0, 0, 0],
    [1, 0, 0],
    [-1, 0, 0],
    [0, 1, 0],
    [0, -1, 0],
    [0, 0, 1],
    [0, 0, -1],
    [1, 1, 0],
    [1, 0, 1],
    [0, 1, 1],
];

/// `squares.(x², y², z²) + mixed.(xy, xz, yz) + linear.(x, y, z) + constant`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quadric<N> {
    squares: [N; 3],
    mixed: [N; 3],
    linear: [N; 3],
    constant: N,
}

impl Quadric<Exact> {
    /// The polynomial with these values at the [`PLACES`].
    pub(super) fn through(values: &[Exact; 10]) -> Self {
        let at_zero = &values[0];
        let ends = |axis: usize| (&values[2 * axis + 1], &values[2 * axis + 2]);
        let mixed = |place: usize, first: usize, second: usize| &(&values[place] - ends(first).0) - &(ends(second).0 - at_zero);
        Self {
            squares: [0, 1, 2].map(|axis| &(ends(axis).0 + ends(axis).1).scaled(-1) - at_zero),
            mixed: [mixed(7, 0, 1), mixed(8, 0, 2), mixed(9, 1, 2)],
            linear: [0, 1, 2].map(|axis| (ends(axis).0 - ends(axis).1).scaled(-1)),
            constant: at_zero.clone(),
        }
    }

    /// The coefficients in another arithmetic.
    pub(super) fn map<N>(&self, convert: impl Fn(&Exact) -> N) -> Quadric<N> {
        let three = |numbers: &[Exact; 3]| numbers.each_ref().map(&convert);
        Quadric {
            squares: three(&self.squares),
            mixed: three(&self.mixed),
            linear: three(&self.linear),
            constant: convert(&self.constant),
        }
    }

    /// The polynomial less another one, times a factor.
    pub(super) fn difference(&self, other: &Self, factor: &Exact) -> Self {
        let three = |a: &[Exact; 3], b: &[Exact; 3]| [0, 1, 2].map(|index| &(&a[index] - &b[index]) * factor);
        Self {
            squares: three(&self.squares, &other.squares),
            mixed: three(&self.mixed, &other.mixed),
            linear: three(&self.linear, &other.linear),
            constant: &(&self.constant - &other.constant) * factor,
        }
    }

    /// Whether nothing of degree two is left.
    pub(super) fn is_flat(&self) -> bool {
        self.squares.iter().chain(&self.mixed).all(Exact::is_zero)
    }
}

impl Quadric<Ball> {
    /// How fast a polynomial of degree one grows along a vector.
    pub(super) fn slope(&self, [x, y, z]: [Ball; 3]) -> Ball {
        let [a, b, c] = self.linear;
        (a * x + b * y) + c * z
    }

    /// The value at zero.
    pub(super) fn constant(&self) -> Ball {
        self.constant
    }

    /// The value at a place.
    pub(super) fn value(&self, [x, y, z]: [Ball; 3]) -> Ball {
        let [a, b, c] = self.linear;
        let ([xx, yy, zz], [xy, xz, yz]) = (self.squares, self.mixed);
        let by_x = (xx * x + xy * y) + (xz * z + a);
        let by_y = (yy * y + yz * z) + b;
        let by_z = zz * z + c;
        (by_x * x + by_y * y) + (by_z * z + self.constant)
    }
}

impl Quadric<f64> {
    /// The value at a place.
    pub(super) fn value(&self, [x, y, z]: [f64; 3]) -> f64 {
        let ([xx, yy, zz], [xy, xz, yz], [a, b, c]) = (self.squares, self.mixed, self.linear);
        (xx * x + xy * y + xz * z + a) * x + (yy * y + yz * z + b) * y + (zz * z + c) * z + self.constant
    }

    /// The sum of the magnitudes of the terms of the value at a place.
    pub(super) fn weight(&self, [x, y, z]: [f64; 3]) -> f64 {
        let (squares, mixed, linear) = (self.squares.map(f64::abs), self.mixed.map(f64::abs), self.linear.map(f64::abs));
        let magnitudes = Self {
            squares,
            mixed,
            linear,
            constant: self.constant.abs(),
        };
        magnitudes.value([x.abs(), y.abs(), z.abs()])
    }

    /// What the terms of degree two make, at the most, of coordinates that may be off by so much.
    pub(super) fn bend(&self, [x, y, z]: [f64; 3]) -> f64 {
        let ([xx, yy, zz], [xy, xz, yz]) = (self.squares.map(f64::abs), self.mixed.map(f64::abs));
        (xx * x + xy * y + xz * z) * x + (yy * y + yz * z) * y + zz * z * z
    }

    /// The gradient at a place.
    pub(super) fn gradient(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let ([xx, yy, zz], [xy, xz, yz], [a, b, c]) = (self.squares, self.mixed, self.linear);
        [
            2.0 * xx * x + xy * y + xz * z + a,
            2.0 * yy * y + xy * x + yz * z + b,
            2.0 * zz * z + xz * x + yz * y + c,
        ]
    }
}
