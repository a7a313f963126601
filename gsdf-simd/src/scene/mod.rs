//! A program prepared for many rays: its parts, each in the form that is cheapest to cast rays at, and where they are.

mod beam;
mod border;
mod outline;
mod reach;
mod reduce;
mod split;
mod tree;
mod view;
mod visible;
mod walk;

pub(crate) use beam::{Beam, Grid};
pub(crate) use outline::{Open, Outline, Remainder};
pub(crate) use reduce::{Known, Reduced, Waiting};
pub(crate) use tree::Group;
pub(crate) use tree::{FANOUT, Tree};
pub(crate) use view::{Picture, View};
pub use visible::Visible;
pub(crate) use walk::{Meets, Met, OF_DISTANCE, Walk};

use border::Border;
use core::ops::Range;
use gsdf_nostd::{Node, Program, Solid, Transform};
use reach::Reach;
use split::{Factor, Starts, Subtree, parts, product};
use tree::order;

/// A program prepared for many rays, once, whatever the camera.
///
/// The program is taken apart at its outermost unions. A part that is a product, the intersection of some solids and of
/// the complements of others, needs no march: from outside it is entered at the last of the entries, or where the last
/// of the complements that are in the way ends. What a beam of rays cannot meet is found in a tree of boxes, for the
/// parts of the program as for the complements of a part.
///
/// Takes time proportional to `n log n` for `n` leaves, and some 150 bytes for each beside the program.
#[derive(Debug)]
pub struct Scene<'a, L> {
    program: Program<'a, L>,
    /// The leaves, part by part; those of a product that count positively first.
    leaves: Vec<Literal<L>>,
    /// For each leaf of the program, in order, where it is in `leaves`.
    places: Vec<u32>,
    /// The parts: those with bounds in the order of `tree`, then those without.
    parts: Vec<Part>,
    tree: Tree,
    /// How many parts have bounds.
    bounded: usize,
    /// The trees of the parts' complements, or of their leaves.
    cuts: Vec<Tree>,
    /// The outlines of the parts that are marched.
    outlines: Vec<Outline>,
    /// The places of the half-spaces among the leaves, in order, with their planes.
    borders: Vec<(u32, Border)>,
    /// How far the parts that have bounds reach, along the longest axis.
    extent: f32,
    divides_by_components: bool,
    /// By how much more than a ray's origin is off what it meets may be: see [`Reach::off_per_slack`].
    off_per_slack: f32,
    most: Most,
}

/// The most that one part has of something: for how much who visits parts needs room.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Most {
    /// Complements of a product.
    pub(crate) cuts: usize,
    /// Leaves of a part that is marched.
    pub(crate) marched: usize,
}

/// A leaf in a part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Literal<L> {
    /// A copy of the solid: what is near in space is near in memory.
    pub(crate) solid: L,
    /// The frame it is in.
    pub(crate) frame: u16,
    /// Its number among the leaves of the program.
    pub(crate) number: u32,
    /// Whether the program lies on the outer side of its surface.
    pub(crate) negative: bool,
}

/// A part of a program.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Where its leaves are among the scene's.
    pub(crate) leaves: Range<u32>,
    pub(crate) form: Form,
}

/// How rays are cast at a part.
#[derive(Clone, Debug)]
pub(crate) enum Form {
    /// A product of so many solids and of the complements of the other leaves, whose boxes are in a tree of the scene, in
    /// the order of the leaves; [`NO_CUTS`](Form::NO_CUTS) where there are none.
    Product { positives: u32, cuts: u32 },
    /// Anything: marched. Its leaves are in their order, with their boxes in a tree; of how they are joined there is an
    /// outline.
    March { outline: u32, cuts: u32 },
    /// The whole program.
    Whole,
}

impl Form {
    /// No tree.
    pub(crate) const NO_CUTS: u32 = u32::MAX;
}

impl<'a, L: Solid> Scene<'a, L> {
    /// Prepares a program.
    #[must_use]
    pub fn new(program: Program<'a, L>) -> Self {
        let nodes = program.nodes();
        let starts = Starts::of(nodes);
        let whole = Subtree {
            nodes: 0..nodes.len(),
            leaves: 0..program.leaves(),
        };
        let subtrees = parts(nodes, &starts, whole);
        let boxes: Vec<Reach> = (subtrees.iter())
            .map(|part| Reach::of_nodes(&program, nodes.get(part.nodes.clone()).unwrap_or_default()))
            .collect();
        let (bounded, everywhere): (Vec<u32>, Vec<u32>) = order(&boxes).into_iter().partition(|&part| !is_everywhere(&boxes, part));
        let sorted: Vec<Reach> = bounded.iter().filter_map(|&part| boxes.get(part as usize)).copied().collect();
        let mut scene = Self {
            program,
            leaves: Vec::with_capacity(program.leaves()),
            places: vec![0; program.leaves()],
            parts: Vec::with_capacity(subtrees.len()),
            bounded: bounded.len(),
            tree: Tree::new(&sorted),
            extent: sorted
                .iter()
                .copied()
                .reduce(Reach::joined)
                .map_or(0.0, |all| 2.0 * all.half.max_element()),
            cuts: Vec::new(),
            outlines: Vec::new(),
            borders: Vec::new(),
            divides_by_components: nodes
                .iter()
                .any(|node| matches!(node, Node::Leaf { solid, .. } if solid.divides_by_components())),
            off_per_slack: 0.0,
            most: Most::default(),
        };
        let negative = starts.negative(nodes);
        for number in bounded.into_iter().chain(everywhere) {
            if let Some(subtree) = subtrees.get(number as usize) {
                scene.add(subtree, &starts, &negative);
            }
        }
        scene
    }

    /// Adds a part.
    fn add(&mut self, subtree: &Subtree, starts: &Starts, negative: &[bool]) {
        let nodes = self.program.nodes();
        let first = self.leaves.len() as u32;
        let form = match product(nodes, starts, subtree) {
            Some(factors) => {
                let (negatives, positives): (Vec<Factor>, Vec<Factor>) = factors.into_iter().partition(|factor| factor.negative);
                // A complement counts only where all the solids are.
                let within = positives.iter().map(|factor| self.reach(factor.node));
                let within = within.fold(Reach::EVERYWHERE, Reach::common);
                let boxes: Vec<Reach> = negatives.iter().map(|factor| self.reach(factor.node).common(within)).collect();
                let order = order(&boxes);
                let sorted: Vec<Reach> = order.iter().filter_map(|&index| boxes.get(index as usize)).copied().collect();
                let negatives = order.iter().filter_map(|&index| negatives.get(index as usize));
                for factor in positives.iter().chain(negatives).copied() {
                    self.push(factor);
                }
                let cuts = if sorted.is_empty() {
                    Form::NO_CUTS
                } else {
                    self.cuts.push(Tree::new(&sorted));
                    self.cuts.len() as u32 - 1
                };
                Form::Product {
                    positives: positives.len() as u32,
                    cuts,
                }
            }
            None => {
                let mut boxes = Vec::new();
                let mut leaf = subtree.leaves.start;
                for node in subtree.nodes.clone() {
                    if let Some(Node::Leaf { .. }) = nodes.get(node) {
                        boxes.push(self.reach(node));
                        self.push(Factor {
                            node,
                            leaf,
                            negative: negative.get(leaf).copied().unwrap_or(false),
                        });
                        leaf += 1;
                    }
                }
                self.cuts.push(Tree::new(&boxes));
                let outline = self.outlines.len() as u32;
                self.outlines.extend(nodes.get(subtree.nodes.clone()).and_then(Outline::new));
                Form::March {
                    outline,
                    cuts: self.cuts.len() as u32 - 1,
                }
            }
        };
        let leaves = self.leaves.len() - first as usize;
        match form {
            Form::Product { positives, .. } => self.most.cuts = self.most.cuts.max(leaves - positives as usize),
            _ => self.most.marched = self.most.marched.max(leaves),
        }
        self.parts.push(Part {
            leaves: first..self.leaves.len() as u32,
            form,
        });
    }

    fn push(&mut self, factor: Factor) {
        let Some(Node::Leaf { solid, frame }) = self.program.nodes().get(factor.node) else {
            return;
        };
        if let Some(place) = self.places.get_mut(factor.leaf) {
            *place = self.leaves.len() as u32;
        }
        self.off_per_slack = self.off_per_slack.max(Reach::off_per_slack(self.program.pose(*frame)));
        if let Some(border) = Border::of_solid(solid, self.program.pose(*frame)) {
            self.borders.push((self.leaves.len() as u32, border));
        }
        self.leaves.push(Literal {
            solid: *solid,
            frame: *frame,
            number: factor.leaf as u32,
            negative: factor.negative,
        });
    }

    /// Where the leaf at a node can be met.
    fn reach(&self, node: usize) -> Reach {
        match self.program.nodes().get(node) {
            Some(Node::Leaf { solid, frame }) => Reach::of_solid(solid, self.program.pose(*frame)),
            _ => Reach::EVERYWHERE,
        }
    }

    /// The number of the leaf in a place.
    #[inline(always)]
    pub(crate) fn number(&self, place: u32) -> u32 {
        self.leaves.get(place as usize).map_or(u32::MAX, |literal| literal.number)
    }

    /// The leaf of a number: its place, and what it is to its part.
    #[inline(always)]
    pub(crate) fn literal(&self, number: u32) -> Option<(u32, &Literal<L>)> {
        let place = *self.places.get(number as usize)?;
        Some((place, self.leaves.get(place as usize)?))
    }

    /// The solid in a place, and the frame it is in.
    #[inline(always)]
    pub(crate) fn leaf(&self, place: u32) -> Option<(&L, u16)> {
        let literal = self.leaves.get(place as usize)?;
        Some((&literal.solid, literal.frame))
    }

    /// The pose of the solid in a place, if it has one.
    #[inline(always)]
    pub(crate) fn pose(&self, place: u32) -> Option<&Transform> {
        let (_, frame) = self.leaf(place)?;
        self.program.pose(frame)
    }

    /// The places of the leaves, by their numbers.
    pub(crate) fn places(&self) -> &[u32] {
        &self.places
    }

    /// The half-spaces among the leaves in some places, with their planes.
    #[inline(always)]
    pub(crate) fn borders(&self, places: &Range<u32>) -> &[(u32, Border)] {
        let before = |end: u32| self.borders.partition_point(|(place, _)| *place < end);
        self.borders.get(before(places.start)..before(places.end)).unwrap_or_default()
    }

    /// Whether rays miss a product of the solids in some places and of the complements of those from `first_cut` on, for all
    /// that they see of the half-spaces among them.
    #[inline(always)]
    pub(crate) fn is_missed(&self, places: &Range<u32>, first_cut: u32, see: impl Fn(&Border) -> Known) -> bool {
        // A loop: what an iterator calls would be compiled apart from what is compiled for a level.
        for (place, border) in self.borders(places) {
            let lost = if *place < first_cut { Known::Outside } else { Known::Inside };
            if see(border) == lost {
                return true;
            }
        }
        false
    }

    /// Whether rays are inside of the solid in a place all the way, as far as they see that.
    #[inline(always)]
    pub(crate) fn is_inside(&self, place: u32, see: impl Fn(&Border) -> Known) -> bool {
        for (_, border) in self.borders(&(place..place + 1)) {
            if see(border) == Known::Inside {
                return true;
            }
        }
        false
    }

    /// A part; those in the order of the tree come first.
    #[inline(always)]
    pub(crate) fn part(&self, number: usize) -> Option<&Part> {
        self.parts.get(number)
    }

    /// The numbers of the parts without bounds.
    #[inline(always)]
    pub(crate) fn unbounded(&self) -> Range<usize> {
        self.bounded..self.parts.len()
    }

    /// Marks the leaves of a part as open, by their numbers.
    pub(crate) fn mark(&self, part: usize, marked: &mut [Known]) {
        let Some(part) = self.parts.get(part) else { return };
        for place in part.leaves.clone() {
            if let Some(mark) = marked.get_mut(self.number(place) as usize) {
                *mark = Known::Open;
            }
        }
    }

    /// How far the parts that have bounds reach, along the longest axis.
    #[inline(always)]
    pub(crate) fn extent(&self) -> f32 {
        self.extent
    }

    /// The tree of the parts that have bounds.
    #[inline(always)]
    pub(crate) fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The tree of a part's complements, or of its leaves.
    #[inline(always)]
    pub(crate) fn cuts(&self, number: u32) -> Option<&Tree> {
        self.cuts.get(number as usize)
    }

    /// How a part that is marched is joined.
    pub(crate) fn outline(&self, number: u32) -> Option<&Outline> {
        self.outlines.get(number as usize)
    }

    /// The node of the leaf in a place.
    pub(crate) fn node(&self, place: u32) -> Option<Node<L>> {
        let (solid, frame) = self.leaf(place)?;
        Some(Node::Leaf { solid: *solid, frame })
    }

    /// Adds to the leaves of a marched part whose boxes rays meet, by their numbers in it, what they see of half-spaces, and
    /// puts all in order.
    #[inline(always)]
    pub(crate) fn know(&self, places: &Range<u32>, see: impl Fn(&Border) -> Known, known: &mut Vec<(u32, Known)>) {
        known.sort_unstable_by_key(|(leaf, _)| *leaf);
        for (place, border) in self.borders(places) {
            let (leaf, seen) = (place - places.start, see(border));
            match known.binary_search_by_key(&leaf, |(leaf, _)| *leaf) {
                Ok(index) => known[index].1 = seen,
                // They have no bounds, but what counts is what is seen of them.
                Err(index) => known.insert(index, (leaf, seen)),
            }
        }
    }

    /// By how much, at most, a solid is met beside where it is, for each unit by which a ray's origin may be off the surface it
    /// leaves.
    #[inline(always)]
    pub(crate) fn off_per_slack(&self) -> f32 {
        self.off_per_slack
    }

    /// For how much who visits the parts needs room.
    pub(crate) fn most(&self) -> Most {
        self.most
    }

    /// Whether a leaf looks at the reciprocals of a direction's components.
    #[inline(always)]
    pub(crate) fn divides_by_components(&self) -> bool {
        self.divides_by_components
    }

    /// The program.
    #[must_use]
    pub const fn program(&self) -> &Program<'a, L> {
        &self.program
    }

    /// How many parts the program has: the operands of its outermost unions.
    #[must_use]
    pub fn parts(&self) -> usize {
        self.parts.len()
    }

    /// How many bytes it takes beside the program.
    #[must_use]
    pub fn bytes(&self) -> usize {
        let trees: usize = self.cuts.iter().map(|tree| size_of::<Tree>() + tree.bytes()).sum();
        let outlines: usize = self.outlines.iter().map(|outline| size_of::<Outline>() + outline.bytes()).sum();
        self.leaves.capacity() * size_of::<Literal<L>>()
            + self.places.capacity() * size_of::<u32>()
            + self.parts.capacity() * size_of::<Part>()
            + self.borders.capacity() * size_of::<(u32, Border)>()
            + self.tree.bytes()
            + trees
            + outlines
    }
}

fn is_everywhere(boxes: &[Reach], number: u32) -> bool {
    boxes.get(number as usize).is_some_and(Reach::is_everywhere)
}
