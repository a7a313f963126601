//! Solids whose spans can be asked for more often than once, or not at all: what a stage costs is what a picture takes longer with twice as much of it.

use crate::scenes::Primitive;
use gsdf_nostd::{Bounds, Ground, Line, Node, Real, Solid, Span, Surface, Toward, V3};
use std::hint::black_box;

/// A solid that is asked for its spans so many times.
#[derive(Clone, Copy, Debug)]
pub struct Staged {
    solid: Primitive,
    /// How often its spans are computed; never: they are empty, and nothing is computed.
    times: u32,
}

gsdf_simd::vectorized!(Staged);

/// A program whose solids are asked for their spans so many times.
#[must_use]
pub fn asked(nodes: &[Node<Primitive>], times: u32) -> Vec<Node<Staged>> {
    nodes.iter().map(|node| staged(node, times)).collect()
}

/// A program with another copy of each part which is found and visited where the part is, and which nothing meets.
#[must_use]
pub fn with_empty_parts(nodes: &[Node<Primitive>]) -> Vec<Node<Staged>> {
    let copy = nodes.iter().map(|node| staged(node, 0));
    asked(nodes, 1).into_iter().chain(copy).chain([Node::Union]).collect()
}

/// A program in which each solid that is subtracted is followed by a copy which is found where it is, and which takes nothing away.
#[must_use]
pub fn with_empty_cuts(nodes: &[Node<Primitive>]) -> Vec<Node<Staged>> {
    let mut made = Vec::with_capacity(2 * nodes.len());
    let mut before: Option<&Node<Primitive>> = None;
    for node in nodes {
        made.push(staged(node, 1));
        if let (Some(cut), Node::Difference) = (before.filter(|node| matches!(node, Node::Leaf { .. })), node) {
            made.extend([staged(cut, 0), Node::Difference]);
        }
        before = Some(node);
    }
    made
}

fn staged(node: &Node<Primitive>, times: u32) -> Node<Staged> {
    match node {
        Node::Leaf { solid, frame } => Node::Leaf {
            solid: Staged { solid: *solid, times },
            frame: *frame,
        },
        Node::Union => Node::Union,
        Node::Intersection => Node::Intersection,
        Node::Difference => Node::Difference,
        Node::Complement => Node::Complement,
    }
}

impl Solid for Staged {
    type Seen<T: Real> = <Primitive as Solid>::Seen<T>;

    #[inline(always)]
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        self.solid.distance(p)
    }

    #[inline(always)]
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T> {
        self.solid.seen_from(origin)
    }

    #[inline(always)]
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T> {
        Primitive::lift(seen, like)
    }

    #[inline(always)]
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T> {
        self.solid.grounded(seen, ground)
    }

    #[inline(always)]
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T> {
        self.solid.span(seen, toward)
    }

    #[inline(always)]
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        self.solid.surface(seen, toward, t)
    }

    fn bounds(&self) -> Option<Bounds> {
        self.solid.bounds()
    }

    fn divides_by_components(&self) -> bool {
        self.solid.divides_by_components()
    }

    #[inline(always)]
    fn spans<T: Real>(
        &self,
        seen: Option<&Self::Seen<T::Scalar>>,
        lines: &[Line<T>; u32::BITS as usize],
        which: u32,
        mut each: impl FnMut(usize, Span<T>),
    ) {
        let Some(more) = self.times.checked_sub(1) else {
            let nothing = Span::empty_like(lines[0].toward.vv);
            let bits = (0..lines.len()).filter(|line| which >> line & 1 == 1);
            return bits.for_each(|line| each(line, nothing));
        };
        // What is behind the box cannot be known to be the same as before, so that it is all done again.
        for _ in 0..more {
            let ignore = |_, span| {
                black_box(span);
            };
            self.solid.spans(black_box(seen), black_box(lines), which, ignore);
        }
        self.solid.spans(black_box(seen), black_box(lines), which, each);
    }

    #[inline(always)]
    fn surface_on<T: Real>(&self, seen: Option<&Self::Seen<T::Scalar>>, line: &Line<T>, t: T) -> Surface<T> {
        self.solid.surface_on(seen, line, t)
    }
}

#[cfg(test)]
mod tests {
    use super::{asked, with_empty_cuts, with_empty_parts};
    use crate::scenes::Scene;
    use anyhow::Result;
    use gsdf_nostd::Program;
    use gsdf_simd::{Effort, Renderer, Tiles, Vectorized};

    fn picture<L: Vectorized>(nodes: &[gsdf_nostd::Node<L>], scene: &Scene) -> Result<(Tiles, Effort)> {
        let prepared = gsdf_simd::Scene::new(Program::new(nodes)?);
        let mut tiles = Tiles::new(48, 48);
        let effort = Renderer::new(&prepared, scene.camera.raster(48, 48)).render(tiles.as_target());
        Ok((tiles, effort))
    }

    /// All the programs show the same surfaces; leaves are numbered anew.
    #[test]
    fn more_work_makes_the_same_picture() -> Result<()> {
        for name in ["s1", "s2", "s3", "s5"] {
            let scene = Scene::by_name(name)?;
            let (expected, once) = picture(&scene.nodes, &scene)?;
            for (nodes, is_renumbered) in [
                (asked(&scene.nodes, 1), false),
                (asked(&scene.nodes, 2), false),
                (with_empty_parts(&scene.nodes), false),
                (with_empty_cuts(&scene.nodes), true),
            ] {
                let (found, effort) = picture(&nodes, &scene)?;
                assert!(
                    effort.hits == once.hits && effort.spans >= once.spans,
                    "{name}: {effort:?}, {once:?}"
                );
                for (found, expected) in found.tiles().iter().zip(expected.tiles()) {
                    assert!(found.distance == expected.distance && found.normal == expected.normal, "{name}");
                    assert!(is_renumbered || found.leaf == expected.leaf, "{name}");
                }
            }
        }
        Ok(())
    }
}
