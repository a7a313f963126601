//! The program of what can be met through a square of pixels: all that others who cast rays there need to know of a scene.

use super::outline::{Open, Remainder};
use super::reduce::Known;
use super::{Beam, Form, Grid, Part, Scene, Tree, Walk};
use crate::lanes::F32x8;
use core::ops::Range;
use gsdf_nostd::{Node, Raster, Solid};

/// The part of a scene that can be met through a square of pixels, as a program of its own: see [`Scene::visible`].
///
/// Kept from one square to the next, so that its memory is allocated once.
#[derive(Debug)]
pub struct Visible<L> {
    nodes: Vec<Node<L>>,
    leaves: Vec<u32>,
    walk: Walk,
    /// The numbers of the boxes of a tree that the beam meets.
    met: Vec<u32>,
    /// The parts that it meets.
    parts: Vec<u32>,
    /// The leaves of the part at hand: of a product their places, of one that is marched their numbers.
    places: Vec<u32>,
    /// What the reduction of a marched part works in: what is known of its leaves, and the outcome.
    known: Vec<(u32, Known)>,
    reduced: Vec<Node<L>>,
    open: Vec<Open>,
}

impl<L> Default for Visible<L> {
    fn default() -> Self {
        Self::new()
    }
}

impl<L> Visible<L> {
    /// Nothing.
    #[must_use]
    pub fn new() -> Self {
        Self {
            nodes: Vec::new(),
            leaves: Vec::new(),
            walk: Walk::new(),
            met: Vec::new(),
            parts: Vec::new(),
            places: Vec::new(),
            known: Vec::new(),
            reduced: Vec::new(),
            open: Vec::new(),
        }
    }

    /// The nodes of the program, in postfix order, in the frames of the scene's program: to be posed like that. None
    /// where there is no surface to be met.
    #[must_use]
    pub fn nodes(&self) -> &[Node<L>] {
        &self.nodes
    }

    /// The numbers that its leaves have in the scene's program, in ascending order.
    #[must_use]
    pub fn leaves(&self) -> &[u32] {
        &self.leaves
    }

    /// Forgets what was visible.
    fn clear(&mut self) {
        self.nodes.clear();
        self.leaves.clear();
    }

    /// The boxes of a tree that a beam meets, in ascending order.
    fn meet(&mut self, beam: &Beam, tree: &Tree) {
        self.met.clear();
        self.walk.begin(tree);
        while let Some(first) = self.walk.next::<F32x8, Beam>((), tree, beam, f32::INFINITY) {
            let mut bits = self.walk.met.bits;
            while bits != 0 {
                self.met.push(first as u32 + bits.trailing_zeros());
                bits &= bits - 1;
            }
        }
        self.met.sort_unstable();
    }

    /// Adds an operand that is complete to the union of those before it.
    fn unite(&mut self, is_first: bool) {
        if !is_first {
            self.nodes.push(Node::Union);
        }
    }
}

impl<L: Solid> Scene<'_, L> {
    /// Finds what rays through a square of pixels can meet: `side` by `side` pixels of `raster`, of which (`x`, `y`) is
    /// the left upper one.
    ///
    /// Along the rays through the square, and as far as these alone are concerned, the program that is found is the
    /// scene's: it has the same crossings with the same bits, in the same order of leaves. So it may be cast at, and
    /// spheres may be traced over it: its standard distance is a step that passes no surface which these rays cross, and
    /// as a rule a longer one than that of the whole program. What hides behind something else is part of it.
    ///
    /// Takes time proportional to what is found (for parts that are marched, also to their half-spaces) and to the logarithm of
    /// all.
    ///
    /// ```
    /// use gsdf_nostd::{Camera, Program, Sphere, csg};
    /// use gsdf_simd::{Scene, Visible};
    /// use glam::{Vec3, vec3};
    ///
    /// csg! { const BALLS = union(Sphere::new(vec3(-2.0, 0.0, 0.0), 1.0), Sphere::new(vec3(2.0, 0.0, 0.0), 1.0)) }
    ///
    /// let program = BALLS.program();
    /// let scene = Scene::new(program);
    /// let raster = Camera::pinhole(vec3(0.0, 0.0, -9.0), Vec3::ZERO, Vec3::Y, 0.5)?.raster(64, 64);
    /// let mut visible = Visible::new();
    /// scene.visible(&raster, 48, 24, 16, &mut visible);
    /// assert_eq!(visible.leaves(), [1]);
    /// // In the middle there is nothing.
    /// scene.visible(&raster, 30, 30, 4, &mut visible);
    /// assert!(visible.nodes().is_empty());
    /// # Ok::<(), gsdf_nostd::Invalid>(())
    /// ```
    pub fn visible(&self, raster: &Raster, x: u32, y: u32, side: u32, visible: &mut Visible<L>) {
        let beam = Beam::new(raster, x, y, side, Grid::new(2));
        visible.clear();
        visible.meet(&beam, self.tree());
        visible.parts.clear();
        visible.parts.extend_from_slice(&visible.met);
        visible.parts.extend(self.unbounded().map(|part| part as u32));
        // The order of the program: of leaves that are met at one place the lowest number counts, and of all parts the
        // first may let the most operands wait.
        let first_leaf = |number: &u32| self.part(*number as usize).map_or(u32::MAX, |part| self.number(part.leaves.start));
        visible.parts.sort_unstable_by_key(first_leaf);
        for index in 0..visible.parts.len() {
            let part = visible.parts.get(index).and_then(|&number| self.part(number as usize));
            let Some(Part { leaves, form }) = part else { continue };
            let known = match form {
                Form::Product { positives, cuts } => self.add_product(&beam, leaves, *positives, *cuts, visible),
                Form::March { outline, cuts } => self.add_marched(&beam, leaves, *outline, *cuts, visible),
                Form::Whole => Known::Outside,
            };
            if known == Known::Inside {
                // All of the rays are inside of this part all the way, and so of the union.
                visible.clear();
                return;
            }
        }
    }

    /// Adds a product: its positive factors, and the complements that the beam meets.
    fn add_product(&self, beam: &Beam, leaves: &Range<u32>, positives: u32, cuts: u32, visible: &mut Visible<L>) -> Known {
        let first_cut = leaves.start + positives;
        if self.is_missed(leaves, first_cut, |border| beam.see(border)) {
            return Known::Outside;
        }
        visible.met.clear();
        if let Some(cuts) = self.cuts(cuts) {
            visible.meet(beam, cuts);
        }
        visible.places.clear();
        visible.places.extend(leaves.start..first_cut);
        visible.places.extend(visible.met.iter().map(|cut| first_cut + cut));
        visible.places.sort_unstable_by_key(|place| self.number(*place));
        let is_first = visible.nodes.is_empty();
        for (index, place) in visible.places.iter().enumerate() {
            let Some((solid, frame)) = self.leaf(*place) else { continue };
            visible.nodes.push(Node::Leaf { solid: *solid, frame });
            visible.leaves.push(self.number(*place));
            match (index, *place >= first_cut) {
                (0, false) => {}
                (0, true) => visible.nodes.push(Node::Complement),
                (_, false) => visible.nodes.push(Node::Intersection),
                (_, true) => visible.nodes.push(Node::Difference),
            }
        }
        if visible.places.is_empty() {
            return Known::Inside;
        }
        visible.unite(is_first);
        Known::Open
    }

    /// Adds any other part, reduced to the leaves that the beam meets.
    fn add_marched(&self, beam: &Beam, leaves: &Range<u32>, outline: u32, cuts: u32, visible: &mut Visible<L>) -> Known {
        let (Some(outline), Some(tree)) = (self.outline(outline), self.cuts(cuts)) else {
            return Known::Outside;
        };
        visible.meet(beam, tree);
        visible.known.clear();
        visible.known.extend(visible.met.iter().map(|leaf| (*leaf, Known::Open)));
        self.know(leaves, |border| beam.see(border), &mut visible.known);
        let mut remainder = Remainder {
            nodes: &mut visible.reduced,
            leaves: &mut visible.places,
            open: &mut visible.open,
        };
        let known = outline.reduce(&visible.known, &mut remainder, |leaf| self.node(leaves.start + leaf));
        if known == Known::Open {
            let is_first = visible.nodes.is_empty();
            visible.nodes.append(&mut visible.reduced);
            visible
                .leaves
                .extend(visible.places.iter().map(|leaf| self.number(leaves.start + leaf)));
            visible.unite(is_first);
        }
        known
    }
}

#[cfg(test)]
mod tests {
    use super::{Scene, Visible};
    use glam::{Vec3, vec3};
    use gsdf_nostd::{Camera, Leaf, Node, Program, Raster, Sphere};

    fn ball(x: f32, radius: f32) -> Node {
        Node::leaf(Leaf::Sphere(Sphere::new(vec3(x, 0.0, 0.0), radius).unwrap()))
    }

    /// Balls at 0, 4 and 8, seen from the front with 4 pixels to the unit.
    fn raster() -> Raster {
        Camera::orthographic(vec3(4.0, 0.0, -10.0), vec3(4.0, 0.0, 0.0), Vec3::Y, 8.0)
            .unwrap()
            .raster(64, 64)
    }

    fn seen(nodes: &[Node], x: u32, side: u32) -> (Vec<Node>, Vec<u32>) {
        let mut visible = Visible::new();
        Scene::new(Program::new(nodes).unwrap()).visible(&raster(), x, 32 - side / 2, side, &mut visible);
        (visible.nodes().to_vec(), visible.leaves().to_vec())
    }

    #[test]
    fn parts_come_in_the_order_of_the_program() {
        let [a, b, c] = [ball(8.0, 1.0), ball(4.0, 1.0), ball(0.0, 1.0)];
        let nodes = [a, b, Node::Union, c, Node::Union];
        assert_eq!(seen(&nodes, 0, 64), (nodes.to_vec(), vec![0, 1, 2]));
        assert_eq!(seen(&nodes, 0, 32), (vec![b, c, Node::Union], vec![1, 2]));
        assert_eq!(seen(&nodes, 28, 8), (vec![b], vec![1]));
        assert_eq!(seen(&nodes, 23, 2), (vec![], vec![]));
    }

    #[test]
    fn of_a_product_there_are_the_complements_that_are_met() {
        let [body, left, middle] = [ball(4.0, 5.0), ball(0.0, 1.0), ball(4.0, 1.0)];
        let nodes = [body, left, Node::Difference, middle, Node::Difference];
        assert_eq!(seen(&nodes, 30, 4), (vec![body, middle, Node::Difference], vec![0, 2]));
        // (not left) & body: the factor in front is not there.
        let nodes = [left, Node::Complement, body, Node::Intersection];
        assert_eq!(seen(&nodes, 30, 4), (vec![body], vec![1]));
        assert_eq!(seen(&nodes, 12, 8), (nodes.to_vec(), vec![0, 1]));
    }

    #[test]
    fn who_is_inside_all_the_way_meets_nothing() {
        let [a, b] = [ball(4.0, 1.0), ball(0.0, 1.0)];
        // b + not a, through b alone.
        let nodes = [b, a, Node::Complement, Node::Union];
        assert_eq!(seen(&nodes, 14, 4), (vec![], vec![]));
        assert_eq!(seen(&nodes, 30, 4), (vec![a, Node::Complement], vec![1]));
        // The same as one part that is no product: not (a - b), then b.
        let nodes = [a, b, Node::Difference, Node::Complement, b, Node::Union];
        assert_eq!(seen(&nodes, 14, 4), (vec![], vec![]));
        assert_eq!(seen(&nodes, 30, 4), (vec![a, Node::Complement], vec![0]));
    }

    #[test]
    fn of_a_marched_part_there_is_what_is_met() {
        let [a, b, c] = [ball(0.0, 1.0), ball(4.0, 1.0), ball(4.0, 0.5)];
        // (a + b) - c, which is not a product; and a ball.
        let part = [a, b, Node::Union, c, Node::Difference];
        let nodes = [&[ball(8.0, 1.0)][..], &part[..], &[Node::Union]].concat();
        assert_eq!(seen(&nodes, 30, 4), (vec![b, c, Node::Difference], vec![2, 3]));
        assert_eq!(seen(&nodes, 0, 32), (part.to_vec(), vec![1, 2, 3]));
        assert_eq!(seen(&nodes, 14, 50).1, [0, 1, 2, 3]);
    }
}
