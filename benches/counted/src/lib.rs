//! An arithmetic that counts: `f32` that keeps a tally of what is done with it.

use core::cell::Cell;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub};
use gsdf_nostd::{Lane, Real};

/// How many operations of each kind there were.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Operations {
    /// Sums and differences.
    pub additions: u64,
    /// Products.
    pub multiplications: u64,
    /// Quotients.
    pub divisions: u64,
    /// Square roots.
    pub square_roots: u64,
    /// Comparisons of two numbers.
    pub comparisons: u64,
    /// Choices by a truth value.
    pub selections: u64,
    /// Minima and maxima: one instruction where there is one, a comparison and a selection elsewhere.
    pub extrema: u64,
    /// Signs that were flipped, cleared or copied.
    pub signs: u64,
}

impl AddAssign for Operations {
    fn add_assign(&mut self, other: Self) {
        self.additions += other.additions;
        self.multiplications += other.multiplications;
        self.divisions += other.divisions;
        self.square_roots += other.square_roots;
        self.comparisons += other.comparisons;
        self.selections += other.selections;
        self.extrema += other.extrema;
        self.signs += other.signs;
    }
}

#[derive(Clone, Copy)]
enum Kind {
    Addition,
    Multiplication,
    Division,
    SquareRoot,
    Comparison,
    Selection,
    Extremum,
    Sign,
}

thread_local! {
    /// By [`Kind`]: cells of their own, since a scene of thousands of leaves is billions of operations.
    static DONE: [Cell<u64>; 8] = const { [const { Cell::new(0) }; 8] };
}

/// What `work` returns, and the operations on [`Counted`] numbers that it took, on this thread.
pub fn counting<R>(work: impl FnOnce() -> R) -> (R, Operations) {
    let outer = DONE.with(|done| done.each_ref().map(Cell::take));
    let result = work();
    let done = DONE.with(|done| core::array::from_fn(|kind| done[kind].replace(outer[kind])));
    let [
        additions,
        multiplications,
        divisions,
        square_roots,
        comparisons,
        selections,
        extrema,
        signs,
    ] = done;
    let operations = Operations {
        additions,
        multiplications,
        divisions,
        square_roots,
        comparisons,
        selections,
        extrema,
        signs,
    };
    (result, operations)
}

fn count(kind: Kind) {
    DONE.with(|done| {
        let cell = &done[kind as usize];
        cell.set(cell.get() + 1);
    });
}

/// An `f32` that counts what is done with it: the same bits, and a tally per thread ([`counting`]).
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Counted(pub f32);

impl From<f32> for Counted {
    fn from(value: f32) -> Self {
        Self(value)
    }
}

macro_rules! counted_operator {
    ($operator:ident, $method:ident, $kind:ident) => {
        impl $operator for Counted {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                count(Kind::$kind);
                Self($operator::$method(self.0, other.0))
            }
        }
    };
}

counted_operator!(Add, add, Addition);
counted_operator!(Sub, sub, Addition);
counted_operator!(Mul, mul, Multiplication);
counted_operator!(Div, div, Division);

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        count(Kind::Sign);
        Self(-self.0)
    }
}

impl Real for Counted {
    const LANES: usize = 1;
    type Mask = bool;
    type Scalar = Self;

    fn splat_like(self, value: f32) -> Self {
        Self(value)
    }
    fn lift_like(self, value: Self) -> Self {
        value
    }
    fn sqrt(self) -> Self {
        count(Kind::SquareRoot);
        Self(Real::sqrt(self.0))
    }
    fn abs(self) -> Self {
        count(Kind::Sign);
        Self(Real::abs(self.0))
    }
    fn copysign(self, sign: Self) -> Self {
        count(Kind::Sign);
        Self(Real::copysign(self.0, sign.0))
    }
    fn next_up(self) -> Self {
        count(Kind::Addition);
        Self(Real::next_up(self.0))
    }
    fn lt(self, other: Self) -> bool {
        count(Kind::Comparison);
        self.0 < other.0
    }
    fn le(self, other: Self) -> bool {
        count(Kind::Comparison);
        self.0 <= other.0
    }
    fn eq(self, other: Self) -> bool {
        count(Kind::Comparison);
        self.0 == other.0
    }
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        count(Kind::Selection);
        if mask { yes } else { no }
    }
    fn min(self, other: Self) -> Self {
        count(Kind::Extremum);
        Self(Real::min(self.0, other.0))
    }
    fn max(self, other: Self) -> Self {
        count(Kind::Extremum);
        Self(Real::max(self.0, other.0))
    }
}

impl Lane for Counted {
    fn to_f32(self) -> f32 {
        self.0
    }
    fn to_index(self) -> u32 {
        self.0.to_index()
    }
}

#[cfg(test)]
mod tests {
    use super::{Counted, Operations, counting};
    use gsdf_nostd::Real;

    #[test]
    fn every_operation_is_counted_once_under_its_kind() {
        let (a, b) = (Counted(3.0), Counted(4.0));
        let (result, done) = counting(|| {
            let hypotenuse = (a * a + b * b).sqrt();
            let kept = Counted::select(a.lt(b), hypotenuse - a, hypotenuse / b);
            kept.max(-a).min(b)
        });
        assert_eq!(result, Counted(2.0));
        let expected = Operations {
            additions: 2,
            multiplications: 2,
            divisions: 1,
            square_roots: 1,
            comparisons: 1,
            selections: 1,
            extrema: 2,
            signs: 1,
        };
        assert_eq!(done, expected);
    }

    #[test]
    fn countings_nest_and_leave_nothing_behind() {
        let (inner, outer) = counting(|| {
            let _ = Counted(1.0) + Counted(1.0);
            counting(|| Counted(1.0) / Counted(3.0)).1
        });
        assert_eq!((inner.divisions, inner.additions), (1, 0));
        assert_eq!((outer.divisions, outer.additions), (0, 1));
        assert_eq!(counting(|| ()).1, Operations::default());
    }
}
