//! The leaves that the packets of a tile may meet, as programs, and between what rounding keeps them.

use crate::lanes::Lanes;
use crate::scene::{FANOUT, Form, Known, Meets, Scene};
use crate::tile::march::remainder;
use crate::tile::state::Workspace;
use core::ops::Range;
use gsdf_nostd::{HalfSpace, Node, Solid};

/// What the rays of a tile may meet of a scene: reduced parts, which are joined.
#[derive(Debug)]
pub(super) struct Gathered<L> {
    steps: Vec<Step>,
    parts: Vec<Reduced>,
    /// The leaves among the steps.
    leaves: Vec<Gathering<L>>,
    /// How far from the middle of the world the rays start, at the most.
    reach: f32,
    /// The packets that are inside of a part all the way, for all that is gathered of it.
    inside: u32,
}

/// A node of a part, in postfix order.
#[derive(Clone, Copy, Debug)]
struct Step {
    node: Node<()>,
    /// If it is a leaf, its number among those gathered.
    leaf: u32,
    /// The packets for which it counts: all of the part's, or those that touch a complement.
    touched: u32,
}

/// A part of the scene, as far as rays may meet it.
#[derive(Clone, Debug)]
struct Reduced {
    steps: Range<u32>,
    /// The packets that touch it, and from where on.
    touched: u32,
    near: f32,
    /// The number of its first leaf in the scene.
    first: u32,
}

/// A leaf that was gathered.
#[derive(Debug)]
pub(super) struct Gathering<L> {
    /// Its place in the scene.
    pub(super) place: u32,
    pub(super) moved: Moved<L>,
}

/// Between what a leaf is as far as rounding moves it.
#[derive(Debug)]
pub(super) enum Moved<L> {
    /// It is [between](Solid::between) these.
    Between([L; 2]),
    /// Rounding moves a plane by the more the farther away it is met: there is no such pair.
    HalfSpace(HalfSpace),
    Unknown,
}

impl<L: Solid> Moved<L> {
    fn of(scene: &Scene<'_, L>, place: u32, reach: f32) -> Self {
        let Some((solid, frame)) = scene.leaf(place) else {
            return Self::Unknown;
        };
        let pose = scene.program().pose(frame);
        match (solid.as_half_space(), solid.between(reach, pose)) {
            (Some(plane), _) if pose.is_none() => Self::HalfSpace(plane),
            (_, Some(moved)) => Self::Between(moved),
            _ => Self::Unknown,
        }
    }
}

const LEAF: Node<()> = Node::Leaf { solid: (), frame: 0 };

impl<L: Solid> Gathered<L> {
    pub(super) const fn new() -> Self {
        Self {
            steps: Vec::new(),
            parts: Vec::new(),
            leaves: Vec::new(),
            reach: 0.0,
            inside: 0,
        }
    }

    /// Gathers what the rays of a tile may meet nearer than `far`. They start within `reach` of the middle of the world.
    #[inline(always)]
    pub(super) fn gather<T: Lanes, M: Meets<T>>(
        &mut self,
        token: T::Token,
        scene: &Scene<'_, L>,
        rays: &M,
        (far, reach): (f32, f32),
        work: &mut Workspace<T, L>,
    ) {
        self.steps.clear();
        self.parts.clear();
        self.leaves.clear();
        (self.inside, self.reach) = (0, reach);
        work.walk.begin(scene.tree());
        // There is one place where a part is added: what is inlined there is compiled once.
        let (mut first, mut left) = (0, 0_u32);
        let mut unbounded = scene.unbounded();
        loop {
            let (number, touched, near) = if left != 0 {
                let place = left.trailing_zeros() as usize % FANOUT;
                left &= left - 1;
                let met = &work.walk.met;
                if far <= met.near[place] {
                    continue;
                }
                (first + place, met.touched[place] & work.rays.present(), met.near[place])
            } else if !work.walk.is_over() {
                if let Some(item) = work.walk.next::<T, M>(token, scene.tree(), rays, far) {
                    (first, left) = (item, work.walk.met.bits);
                }
                continue;
            } else if let Some(number) = unbounded.next() {
                (number, work.rays.present(), 0.0)
            } else {
                break;
            };
            let (start, first_leaf) = (self.steps.len() as u32, self.leaves.len());
            if self.add(token, scene, rays, number, touched, work) == Known::Inside {
                self.inside |= touched;
            }
            let steps = start..self.steps.len() as u32;
            if let Some(Gathering { place, .. }) = self.leaves.get(first_leaf) {
                let first = scene.number(*place);
                self.parts.push(Reduced {
                    steps,
                    touched,
                    near,
                    first,
                });
            }
        }
        self.sort_parts();
    }

    /// Puts the parts in the order of the program, so that where roots coincide the rule is the same. Apart, since it has no lanes.
    #[inline(never)]
    fn sort_parts(&mut self) {
        self.parts.sort_unstable_by_key(|part| part.first);
    }

    /// The same for what is subtracted from a part.
    #[inline(never)]
    fn sort_cuts(scene: &Scene<'_, L>, cuts: &mut [(u32, u32)]) {
        cuts.sort_unstable_by_key(|(place, _)| scene.number(*place));
    }

    /// Adds what some packets may meet of a part: nothing where they miss it, or are inside of it all the way.
    #[inline(always)]
    fn add<T: Lanes, M: Meets<T>>(
        &mut self,
        token: T::Token,
        scene: &Scene<'_, L>,
        rays: &M,
        number: usize,
        touched: u32,
        work: &mut Workspace<T, L>,
    ) -> Known {
        let Some(part) = scene.part(number) else {
            return Known::Outside;
        };
        let places = part.leaves.clone();
        match part.form {
            Form::Product { positives, cuts } => {
                let first_cut = places.start + positives;
                if scene.is_missed(
                    &places,
                    first_cut,
                    #[inline(always)]
                    |border| rays.see(border),
                ) {
                    return Known::Outside;
                }
                for place in places.start..first_cut {
                    self.add_leaf(scene, place, touched);
                    if place > places.start {
                        self.operator(Node::Intersection, touched);
                    }
                }
                let mut is_first = positives == 0;
                let Some(cuts) = scene.cuts(cuts) else { return Known::Open };
                work.cuts.clear();
                work.inner_walk.begin(cuts);
                while let Some(item) = work.inner_walk.next::<T, M>(token, cuts, rays, f32::INFINITY) {
                    let met = work.inner_walk.met;
                    for place in (0..FANOUT).filter(|place| met.bits >> place & 1 == 1) {
                        let of_these = met.touched[place] & touched;
                        if of_these != 0 {
                            work.cuts.push((first_cut + (item + place) as u32, of_these));
                        }
                    }
                }
                Self::sort_cuts(scene, &mut work.cuts);
                for &(place, of_these) in &work.cuts {
                    // The first operand of a complement alone stands for all packets.
                    let of_these = if is_first { touched } else { of_these };
                    self.add_leaf(scene, place, of_these);
                    self.operator(if is_first { Node::Complement } else { Node::Difference }, of_these);
                    is_first = false;
                }
                // Rays that meet none of nothing but complements are inside.
                if is_first { Known::Inside } else { Known::Open }
            }
            Form::March { outline, cuts } => {
                let (Some(outline), Some(tree)) = (scene.outline(outline), scene.cuts(cuts)) else {
                    return Known::Outside;
                };
                work.met_leaves.clear();
                work.inner_walk.begin(tree);
                while let Some(item) = work.inner_walk.next::<T, M>(token, tree, rays, f32::INFINITY) {
                    let bits = work.inner_walk.met.bits;
                    let open = (0..FANOUT).filter(|place| bits >> place & 1 == 1);
                    work.met_leaves.extend(open.map(|place| ((item + place) as u32, Known::Open)));
                }
                scene.know(
                    &places,
                    #[inline(always)]
                    |border| rays.see(border),
                    &mut work.met_leaves,
                );
                let known = remainder(scene, outline, places.start, work);
                if known == Known::Open {
                    let mut leaves = work.places.iter();
                    for node in &work.nodes {
                        match node {
                            Node::Leaf { .. } => self.add_leaf(scene, leaves.next().copied().unwrap_or_default(), touched),
                            operator => self.operator(bare(operator), touched),
                        }
                    }
                }
                known
            }
            Form::Whole => Known::Outside,
        }
    }

    fn add_leaf(&mut self, scene: &Scene<'_, L>, place: u32, touched: u32) {
        self.steps.push(Step {
            node: LEAF,
            leaf: self.leaves.len() as u32,
            touched,
        });
        let moved = Moved::of(scene, place, self.reach);
        self.leaves.push(Gathering { place, moved });
    }

    fn operator(&mut self, node: Node<()>, touched: u32) {
        self.steps.push(Step { node, leaf: 0, touched });
    }

    /// Whether rays of a packet are inside of a part all the way. What they leave is not among what was gathered.
    #[inline(always)]
    pub(super) fn is_inside(&self, packet: usize) -> bool {
        self.inside >> packet & 1 == 1
    }

    /// Whether leaves are in the order of the scene.
    pub(super) fn are_in_order(&self, scene: &Scene<'_, L>, leaves: &[u32]) -> bool {
        leaves
            .iter()
            .filter_map(|leaf| Some(scene.number(self.leaf(*leaf)?.place)))
            .is_sorted_by(|a, b| a < b)
    }

    /// A program of some leaves with their solids.
    pub(super) fn solids(&self, scene: &Scene<'_, L>, bare: &[Node<()>], leaves: &[u32], nodes: &mut Vec<Node<L>>) {
        nodes.clear();
        let mut leaves = leaves.iter();
        nodes.extend(bare.iter().filter_map(|node| match node {
            Node::Leaf { .. } => scene.node(self.leaf(*leaves.next()?)?.place),
            Node::Union => Some(Node::Union),
            Node::Intersection => Some(Node::Intersection),
            Node::Difference => Some(Node::Difference),
            Node::Complement => Some(Node::Complement),
        }));
    }

    /// The leaf of a number.
    #[inline(always)]
    pub(super) fn leaf(&self, leaf: u32) -> Option<&Gathering<L>> {
        self.leaves.get(leaf as usize)
    }

    /// The program that the rays of a packet may meet nearer than `far`, and the numbers of its leaves.
    pub(super) fn packet(&self, packet: usize, far: f32, nodes: &mut Vec<Node<()>>, leaves: &mut Vec<u32>) {
        nodes.clear();
        leaves.clear();
        for part in &self.parts {
            if part.touched >> packet & 1 == 0 || far <= part.near {
                continue;
            }
            let joined = !nodes.is_empty();
            let steps = self.steps.get(part.steps.start as usize..part.steps.end as usize);
            for step in steps.unwrap_or_default() {
                if step.touched >> packet & 1 == 0 {
                    continue;
                }
                nodes.push(step.node);
                if matches!(step.node, Node::Leaf { .. }) {
                    leaves.push(step.leaf);
                }
            }
            if joined {
                nodes.push(Node::Union);
            }
        }
    }
}

/// An operator.
fn bare<L>(node: &Node<L>) -> Node<()> {
    match node {
        Node::Leaf { .. } => LEAF,
        Node::Union => Node::Union,
        Node::Intersection => Node::Intersection,
        Node::Difference => Node::Difference,
        Node::Complement => Node::Complement,
    }
}
