//! Random expressions over the spans of one ray, and what is true of them by definition: the oracles share nothing
//! with the library's evaluators.

use core::fmt::Debug;
use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCylinder, Cuboid, HalfSpace, Lane, Leaf, Node, Span, Sphere};
use rand::{Rng, RngExt};

/// A set expression over numbered leaves.
#[derive(Clone, Debug, PartialEq)]
pub enum Tree {
    /// The leaf with this number.
    Leaf(usize),
    /// What is in either.
    Union(Box<Tree>, Box<Tree>),
    /// What is in both.
    Intersection(Box<Tree>, Box<Tree>),
    /// What is in the first and not in the second.
    Difference(Box<Tree>, Box<Tree>),
    /// What is not in it.
    Complement(Box<Tree>),
}

/// A crossing as the definition has it.
#[derive(Clone, Debug, PartialEq)]
pub struct TrueCrossing<T> {
    /// Where membership changes.
    pub t: T,
    /// Whether to inside.
    pub entering: bool,
    /// Every leaf whose own change makes the whole's, ascending; the library must name the first.
    pub culprits: Vec<usize>,
}

/// An arithmetic with bits to compare.
pub trait Number: Lane + Debug {
    /// The nearest number.
    fn nearest(value: f64) -> Self;
    /// The bits; of `f64`'s width, so that one signature fits all.
    fn bits(self) -> u64;
}

impl Number for f32 {
    fn nearest(value: f64) -> Self {
        value as Self
    }
    fn bits(self) -> u64 {
        self.to_bits().into()
    }
}

impl Number for f64 {
    fn nearest(value: f64) -> Self {
        value
    }
    fn bits(self) -> u64 {
        self.to_bits()
    }
}

impl Tree {
    /// What is in either.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self::Union(self.into(), other.into())
    }

    /// What is in both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        Self::Intersection(self.into(), other.into())
    }

    /// What is in the first and not in the second.
    #[must_use]
    pub fn without(self, other: Self) -> Self {
        Self::Difference(self.into(), other.into())
    }

    /// What is not in it.
    #[must_use]
    pub fn inverted(self) -> Self {
        Self::Complement(self.into())
    }

    /// A tree of so many leaves, numbered from left to right, that no postfix evaluation needs more than 32 operands
    /// for.
    pub fn random(rng: &mut impl Rng, leaves: usize) -> Self {
        loop {
            let tree = Self::grown(rng, 0, leaves);
            if tree.depth() <= 32 {
                return tree;
            }
        }
    }

    fn grown(rng: &mut impl Rng, first: usize, leaves: usize) -> Self {
        let tree = if leaves == 1 {
            Self::Leaf(first)
        } else {
            let split = rng.random_range(1..leaves);
            let (left, right) = (Self::grown(rng, first, split), Self::grown(rng, first + split, leaves - split));
            // Mostly unions: what is cut away too often is empty.
            match rng.random_range(0..4) {
                0..2 => left.or(right),
                2 => left.and(right),
                _ => left.without(right),
            }
        };
        if rng.random_range(0..8) == 0 { tree.inverted() } else { tree }
    }

    /// How many leaves: mostly up to 12, one in eight up to 64.
    pub fn random_size(rng: &mut impl Rng) -> usize {
        if rng.random_range(0..8) == 0 {
            rng.random_range(13..=64)
        } else {
            rng.random_range(1..=12)
        }
    }

    /// The same expression with the operands of about half of its unions and intersections swapped; leaves keep their
    /// numbers.
    #[must_use]
    pub fn shuffled(&self, rng: &mut impl Rng) -> Self {
        let keep = rng.random_range(0..2) == 0;
        let ordered = |a: Self, b: Self| if keep { (a, b) } else { (b, a) };
        match self {
            Self::Leaf(number) => Self::Leaf(*number),
            Self::Union(a, b) => {
                let (a, b) = ordered(a.shuffled(rng), b.shuffled(rng));
                a.or(b)
            }
            Self::Intersection(a, b) => {
                let (a, b) = ordered(a.shuffled(rng), b.shuffled(rng));
                a.and(b)
            }
            Self::Difference(a, b) => a.shuffled(rng).without(b.shuffled(rng)),
            Self::Complement(a) => a.shuffled(rng).inverted(),
        }
    }

    /// The same expression with every leaf's number raised.
    #[must_use]
    pub fn shifted(&self, by: usize) -> Self {
        let shift = |tree: &Self| Box::new(tree.shifted(by));
        match self {
            Self::Leaf(number) => Self::Leaf(number + by),
            Self::Union(a, b) => Self::Union(shift(a), shift(b)),
            Self::Intersection(a, b) => Self::Intersection(shift(a), shift(b)),
            Self::Difference(a, b) => Self::Difference(shift(a), shift(b)),
            Self::Complement(a) => Self::Complement(shift(a)),
        }
    }

    /// The numbers of the leaves from left to right: the order in which a program has them.
    #[must_use]
    pub fn order(&self) -> Vec<usize> {
        match self {
            Self::Leaf(number) => vec![*number],
            Self::Union(a, b) | Self::Intersection(a, b) | Self::Difference(a, b) => [a.order(), b.order()].concat(),
            Self::Complement(a) => a.order(),
        }
    }

    /// How many operands its postfix evaluation holds at once.
    #[must_use]
    pub fn depth(&self) -> usize {
        match self {
            Self::Leaf(_) => 1,
            Self::Union(a, b) | Self::Intersection(a, b) | Self::Difference(a, b) => a.depth().max(1 + b.depth()),
            Self::Complement(a) => a.depth(),
        }
    }

    /// The program; leaf `i` is `solids[i]`, in the world.
    #[must_use]
    pub fn postfix<L: Clone>(&self, solids: &[L]) -> Vec<Node<L>> {
        let joined = |a: &Self, b: &Self, operator: Node<L>| [a.postfix(solids), b.postfix(solids), vec![operator]].concat();
        match self {
            Self::Leaf(number) => vec![Node::leaf(solids[*number].clone())],
            Self::Union(a, b) => joined(a, b, Node::Union),
            Self::Intersection(a, b) => joined(a, b, Node::Intersection),
            Self::Difference(a, b) => joined(a, b, Node::Difference),
            Self::Complement(a) => [a.postfix(solids), vec![Node::Complement]].concat(),
        }
    }

    /// The program alone, for evaluators that are given the spans: they come in [`order`](Self::order).
    #[must_use]
    pub fn nodes(&self) -> Vec<Node<()>> {
        self.postfix(&vec![(); 1 + self.order().into_iter().max().unwrap_or(0)])
    }

    /// Membership at `t` and just after it, leaf by leaf from half-open spans.
    #[must_use]
    pub fn contains<T: Number>(&self, spans: &[Span<T>], t: T) -> bool {
        match self {
            Self::Leaf(number) => spans[*number].enter <= t && t < spans[*number].exit,
            Self::Union(a, b) => a.contains(spans, t) || b.contains(spans, t),
            Self::Intersection(a, b) => a.contains(spans, t) && b.contains(spans, t),
            Self::Difference(a, b) => a.contains(spans, t) && !b.contains(spans, t),
            Self::Complement(a) => !a.contains(spans, t),
        }
    }

    /// All crossings from -inf to inf: membership compared between every two neighbouring pieces into which the ends
    /// of spans cut the line.
    #[must_use]
    pub fn crossings<T: Number>(&self, spans: &[Span<T>]) -> Vec<TrueCrossing<T>> {
        let ends = finite_ends(spans);
        let infinity = T::from(f32::INFINITY);
        let mut before = -infinity;
        let mut found = Vec::new();
        for (index, &t) in ends.iter().enumerate() {
            let after = within(t, ends.get(index + 1).copied().unwrap_or(infinity));
            if self.contains(spans, before) != self.contains(spans, after) {
                let mut culprits = Vec::new();
                self.blame(spans, before, after, &mut culprits);
                culprits.sort_unstable();
                found.push(TrueCrossing {
                    t,
                    entering: self.contains(spans, after),
                    culprits,
                });
            }
            before = after;
        }
        found
    }

    /// The leaves to blame for a change between two places: those of all operands that change, if the whole does; a
    /// leaf blames itself.
    fn blame<T: Number>(&self, spans: &[Span<T>], before: T, after: T, culprits: &mut Vec<usize>) {
        if self.contains(spans, before) == self.contains(spans, after) {
            return;
        }
        match self {
            Self::Leaf(number) => culprits.push(*number),
            Self::Union(a, b) | Self::Intersection(a, b) | Self::Difference(a, b) => {
                a.blame(spans, before, after, culprits);
                b.blame(spans, before, after, culprits);
            }
            Self::Complement(a) => a.blame(spans, before, after, culprits),
        }
    }
}

/// A random expression with its program and one span per leaf.
#[derive(Clone, Debug)]
pub struct Case<T> {
    /// The expression; its leaves are numbered from left to right.
    pub tree: Tree,
    /// The same as a program.
    pub nodes: Vec<Node<()>>,
    /// What the ray sees of leaf `i`.
    pub spans: Vec<Span<T>>,
}

impl<T: Number> Case<T> {
    /// A random expression; in two of three all ends are whole.
    pub fn random(rng: &mut impl Rng) -> Self {
        let leaves = Tree::random_size(rng);
        let tree = Tree::random(rng, leaves);
        let grid = rng.random_range(0..3) > 0;
        let spans = (0..leaves).map(|_| random_span(rng, grid)).collect();
        Self::of(tree, spans)
    }

    /// A given expression, its leaves numbered from left to right, over given spans.
    #[must_use]
    pub fn of(tree: Tree, spans: Vec<Span<T>>) -> Self {
        let nodes = tree.nodes();
        Self { tree, nodes, spans }
    }

    /// The spans for another expression over the same leaves, in the order in which they stand there.
    #[must_use]
    pub fn restated(&self, tree: &Tree) -> Vec<Span<T>> {
        tree.order().into_iter().map(|number| self.spans[number]).collect()
    }

    /// Zeros of both signs, every end, places just beside the ends, and some between.
    pub fn places(&self, rng: &mut impl Rng) -> Vec<T> {
        let mut places = vec![T::from(0.0), -T::from(0.0), T::from(1e30)];
        for end in finite_ends(&self.spans) {
            places.extend([end, T::nearest(rng.random_range(0.0..12.0)), end + T::from(0.5)]);
        }
        places.retain(|&place| place >= T::from(0.0));
        places
    }
}

/// The finite ends of the spans, ascending, each once.
pub fn finite_ends<T: Number>(spans: &[Span<T>]) -> Vec<T> {
    let infinity = T::from(f32::INFINITY);
    let mut ends: Vec<T> = spans.iter().flat_map(|span| [span.enter, span.exit]).collect();
    ends.retain(|&end| -infinity < end && end < infinity);
    ends.sort_by(|a, b| a.partial_cmp(b).unwrap_or(core::cmp::Ordering::Equal));
    // Zeros of both signs are one end.
    ends.dedup_by(|a, b| *a == *b);
    ends
}

/// A place from `low` on and before `high`: the middle, unless there is nothing between the two.
fn within<T: Number>(low: T, high: T) -> T {
    let middle = low + (high - low) * T::from(0.5);
    if middle < high { middle } else { low }
}

/// A span from -1 to 10 or so, one in six of them a special case; `grid` picks ends that are whole, so that many
/// coincide.
pub fn random_span<T: Number>(rng: &mut impl Rng, grid: bool) -> Span<T> {
    let mut place = |low: f64, high: f64| {
        let place = rng.random_range(low..high);
        if grid { place.floor() } else { place }
    };
    let (enter, length) = (place(-1.0, 5.0), place(0.0, 5.0));
    let (enter, exit) = (T::nearest(enter), T::nearest(enter + length));
    let (infinity, zero) = (T::from(f32::INFINITY), T::from(0.0));
    match rng.random_range(0..42) {
        0 => Span::between(infinity, -infinity),
        1 => Span::between(-infinity, infinity),
        2 => Span::between(enter, infinity),
        3 => Span::between(-infinity, exit),
        4 => Span::between(-zero, exit),
        5 => Span::between(enter, -zero),
        6 => Span::between(zero, exit),
        _ => Span::between(enter, exit),
    }
}

/// A solid of whole numbers near the origin, so that faces coincide and rays along the grid run in them.
pub fn random_solid(rng: &mut impl Rng) -> Leaf {
    let mut whole = |low: i8, high: i8| f32::from(rng.random_range(low..=high));
    let place = vec3(whole(-3, 3), whole(-3, 3), whole(-3, 3));
    let size = vec3(whole(1, 4), whole(1, 4), whole(1, 4));
    let axis = [Vec3::X, Vec3::NEG_Y, Vec3::Z][rng.random_range(0..3)];
    match rng.random_range(0..8) {
        0..3 => Cuboid::new(place, place + size).map(Leaf::from),
        3..5 => Sphere::new(place, size.x).map(Leaf::from),
        5..7 => CappedCylinder::new(place, place + axis * size.x, axis, size.y).map(Leaf::from),
        _ => HalfSpace::new(place, axis).map(Leaf::from),
    }
    .unwrap_or_else(|error| unreachable!("whole numbers are in range: {error}"))
}

/// A ray through a place on the grid or half way, along it or aslant; the largest component is 1, so that a line sees
/// it as it is.
pub fn random_ray(rng: &mut impl Rng) -> (Vec3, Vec3) {
    let mut halves = |most: i8| f32::from(rng.random_range(-most..=most)) * 0.5;
    let place = vec3(halves(5), halves(5), halves(5));
    let back = halves(12).abs();
    let mut direction = if halves(3) > 0.0 {
        Vec3::ZERO
    } else {
        vec3(halves(2), halves(2), halves(2))
    };
    direction[rng.random_range(0..3)] = if rng.random_range(0..2) == 0 { 1.0 } else { -1.0 };
    (place - direction * back, direction)
}
