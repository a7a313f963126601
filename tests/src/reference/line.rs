//! A solid along a line: where the line is inside, and which parts of the solid change there.

use super::Expr;
use super::number::Exact;
use super::polynomial::Quadratic;
use super::root::{Root, agree};
use super::vector::ExactVec3;

/// How many significant bits are enough for a place between two roots, unless these are very near to each other.
const SAMPLE_BITS: usize = 48;

/// Everything there is to know of a solid along the line `origin + t direction`.
///
/// The line is cut at every root of every polynomial of the solid. No membership changes within a piece, so one exact
/// look at any place within it decides.
#[derive(Clone, Debug)]
pub struct Line {
    /// The distinct roots in ascending order.
    cuts: Vec<Exact>,
    /// The pieces between them, one more than there are roots.
    pieces: Vec<Piece>,
}

/// What holds everywhere on an open piece of the line.
#[derive(Clone, Debug)]
struct Piece {
    inside: bool,
    /// Every tag of the solid, always in the same order, and whether the piece is inside what it names.
    tags: Vec<(u32, bool)>,
}

/// A place where the line goes into the solid or out of it.
#[derive(Clone, Debug)]
pub struct Crossing {
    /// Where.
    pub t: Root,
    /// Whether the line is inside the solid just after this place, and hence not before.
    pub entering: bool,
    /// The tags whose own membership is different just before and just after, in ascending order.
    pub leaves: Vec<u32>,
}

impl Line {
    pub(super) fn new(solid: &Expr, origin: &ExactVec3, direction: &ExactVec3) -> Self {
        let points = [&(origin - direction), origin, &(origin + direction)].map(ExactVec3::clone);
        let mut polynomials = Vec::new();
        solid.restrict(&points, &mut polynomials);

        let mut roots = Vec::new();
        for polynomial in &polynomials {
            polynomial.push_roots(&mut roots);
        }
        roots.sort_unstable();

        let (cuts, samples) = cut(roots);
        let pieces = samples.iter().map(|t| Piece::at(solid, &polynomials, t)).collect();
        Self { cuts, pieces }
    }

    /// The longest spans of the line that are inside, in ascending order, each from its entry to its exit.
    ///
    /// A single place counts neither inside nor outside: spans that touch are one span.
    #[must_use]
    pub fn spans(&self) -> Vec<(Root, Root)> {
        let mut spans = Vec::new();
        let mut entry = self.pieces.first().filter(|piece| piece.inside).map(|_| Root::NegativeInfinity);
        for crossing in self.crossings() {
            match entry.take() {
                Some(entry) => spans.push((entry, crossing.t)),
                None => entry = Some(crossing.t),
            }
        }
        spans.extend(entry.map(|entry| (entry, Root::PositiveInfinity)));
        spans
    }

    /// Every place where the line goes in or out, in ascending order.
    #[must_use]
    pub fn crossings(&self) -> Vec<Crossing> {
        self.crossings_from(0).collect()
    }

    /// The first crossing at a `t` larger than this one, which may be infinite but must be a number.
    #[must_use]
    pub fn first_crossing_after(&self, t_min: f64) -> Option<Crossing> {
        self.crossings_from(self.cuts_until(t_min)).next()
    }

    /// Whether the line is inside just after this place, which may be infinite but must be a number.
    #[must_use]
    pub fn inside_at(&self, t: f64) -> bool {
        self.pieces[self.cuts_until(t)].inside
    }

    /// How many roots are at most `t`, which is the index of the piece that begins there or contains it.
    fn cuts_until(&self, t: f64) -> usize {
        let t = Root::from(t);
        self.cuts.partition_point(|root| Root::Finite(root.clone()).compare(&t).is_le())
    }

    /// The crossings among the roots from this index on.
    fn crossings_from(&self, first: usize) -> impl Iterator<Item = Crossing> {
        let places = self.cuts.iter().zip(self.pieces.windows(2)).skip(first);
        places.filter_map(|(t, pieces)| {
            let [before, after] = pieces else {
                unreachable!("windows of two pieces have two pieces")
            };
            (before.inside != after.inside).then(|| Crossing {
                t: Root::Finite(t.clone()),
                entering: after.inside,
                leaves: changed_tags(before, after),
            })
        })
    }

    /// Whether this is one of the places where something may change.
    #[cfg(test)]
    pub(super) fn is_cut(&self, t: &Exact) -> bool {
        self.cuts.iter().any(|root| agree(root, t))
    }
}

impl Piece {
    /// What holds on the piece that contains `t`, which is a root of none of the polynomials that change.
    fn at(solid: &Expr, polynomials: &[Quadratic], t: &Exact) -> Self {
        let mut tags = Vec::new();
        let mut leaves = polynomials.iter().map(|polynomial| polynomial.sign_at(t).is_lt());
        let inside = solid.evaluate(&mut leaves, &mut tags);
        Self { inside, tags }
    }
}

/// The distinct roots among these ascending ones, and a place within each of the pieces they cut the line into.
fn cut(roots: Vec<Exact>) -> (Vec<Exact>, Vec<Exact>) {
    let mut cuts: Vec<Exact> = Vec::with_capacity(roots.len());
    let mut samples = Vec::with_capacity(roots.len() + 1);
    let mut last: Option<Exact> = None;
    for root in roots {
        match (&last, cuts.last()) {
            (Some(_), Some(cut)) if agree(cut, &root) => {}
            (Some(last), _) => {
                samples.push(between(last, &root));
                cuts.push(root.clone());
            }
            (None, _) => {
                samples.push((&root - &(root.abs() + Exact::ONE)).rounded(SAMPLE_BITS));
                cuts.push(root.clone());
            }
        }
        last = Some(root);
    }
    samples.push(last.map_or(Exact::ZERO, |root| (&root + &(root.abs() + Exact::ONE)).rounded(SAMPLE_BITS)));
    (cuts, samples)
}

/// A number well between two others: the one in the middle, or a shorter one near it, as short numbers multiply
/// faster.
fn between(low: &Exact, high: &Exact) -> Exact {
    let middle = (low + high).scaled(-1);
    let short = middle.rounded(SAMPLE_BITS);
    if (&short - &middle).abs().scaled(2) < high - low {
        short
    } else {
        middle
    }
}

/// The tags that are inside on exactly one of two pieces.
fn changed_tags(before: &Piece, after: &Piece) -> Vec<u32> {
    let pairs = before.tags.iter().zip(&after.tags);
    let mut changed: Vec<u32> = pairs
        .filter(|(before, after)| before.1 != after.1)
        .map(|(_, after)| after.0)
        .collect();
    changed.sort_unstable();
    changed.dedup();
    changed
}
