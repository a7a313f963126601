//! The directional reading in any arithmetic: the three stages of a query, one lane or many at a time.

use super::footing::Footing;
use super::node::Node;
use super::program::Program;
use super::sweep::{Attribution, attribute};
use crate::leaf::{Solid, Surface};
use crate::ray::Line;
use crate::real::{Lane, Mask, Real};
use crate::span::Span;
use crate::transform::{LocalLine, Transform};
use crate::vec3::V3;

/// A line in the world and in the frame of the last leaf, where the next one probably is too.
struct Framed<T> {
    world: Line<T>,
    frame: u16,
    local: LocalLine<T>,
}

impl<T: Real> Framed<T> {
    #[inline(always)]
    fn new(world: &Line<T>) -> Self {
        Self {
            world: *world,
            frame: 0,
            local: LocalLine::of_world(world),
        }
    }

    /// Takes the line into a frame, and says how that stands in the world.
    #[inline(always)]
    fn enter<'a, L>(&mut self, frame: u16, program: &Program<'a, L>) -> Option<&'a Transform> {
        let pose = program.pose(frame);
        if frame != self.frame {
            self.frame = frame;
            self.local = match pose {
                Some(pose) => pose.line_to_local(&self.world),
                None => LocalLine::of_world(&self.world),
            };
        }
        pose
    }
}

impl<L: Solid> Program<'_, L> {
    /// All leaves, in order, as seen from one origin in the world: for many lines from there. To be used as
    /// [`SeenFrom`](super::SeenFrom).
    pub fn seen_from<S: Lane>(&self, origin: V3<S>) -> impl Iterator<Item = L::Seen<S>> {
        self.nodes.iter().filter_map(move |node| match node {
            Node::Leaf { solid, frame } => {
                let local = self.pose(*frame).map_or(origin, |pose| pose.point_to_local(origin));
                Some(solid.seen_from(local))
            }
            _ => None,
        })
    }

    /// First stage: the span of every leaf along a line in the world, into `spans`, which should hold one per leaf.
    #[inline(always)]
    pub fn spans_along<T: Real, F: Footing<L, T>>(&self, line: &Line<T>, footing: F, spans: &mut [Span<T>]) {
        let mut framed = Framed::new(line);
        let mut spans = spans.iter_mut();
        let mut number = 0;
        for node in self.nodes {
            let Node::Leaf { solid, frame } = node else { continue };
            let Some(span) = spans.next() else { break };
            let pose = framed.enter(*frame, self);
            let own = footing.span(number, solid, &framed.local.line, pose);
            *span = if pose.is_some() { framed.local.span_in_world(own) } else { own };
            number += 1;
        }
    }

    /// A leaf by its number, with its pose.
    pub(super) fn leaf(&self, number: u32) -> Option<(&L, Option<&Transform>)> {
        let mut leaves = self.nodes.iter().filter_map(|node| match node {
            Node::Leaf { solid, frame } => Some((solid, *frame)),
            _ => None,
        });
        let (solid, frame) = leaves.nth(number as usize)?;
        Some((solid, self.pose(frame)))
    }

    /// Third stage: the surface at the crossing `t`, which [`march`](super::march::march) found, with its normal
    /// outward from the program. Second come that and [`attribute`].
    ///
    /// Lanes without a crossing get the reversed direction for a normal, and leaf +inf.
    #[inline(always)]
    pub fn surface_at<T: Real, F: Footing<L, T>>(&self, line: &Line<T>, footing: F, spans: &[Span<T>], t: T) -> Encounter<T> {
        let Attribution { after, leaf, .. } = attribute(self.nodes, spans, t);
        let mut surface = Surface {
            normal: -line.toward.v,
            face: t.splat_like(0.0),
        };
        let mut missing = leaf.lt(t.splat_like(f32::INFINITY));
        let mut framed = Framed::new(line);
        let mut spans = spans.iter();
        let mut number = 0;
        for node in self.nodes {
            let Node::Leaf { solid, frame } = node else { continue };
            let Some(span) = spans.next() else { break };
            let here = leaf.eq(t.splat_like(number as f32));
            if here.any() {
                let pose = framed.enter(*frame, self);
                let own_t = if pose.is_some() { framed.local.parameter(t) } else { t };
                let own = footing.surface(number, solid, &framed.local.line, pose, own_t);
                let outward = match pose {
                    Some(pose) => pose.normal_to_world(own.normal),
                    None => own.normal,
                };
                // Where the leaf is complemented the program lies on the other side of its surface.
                let complemented = span.enter.eq(t).differs_from(after);
                let normal = V3::select(complemented, -outward, outward);
                surface = Surface { normal, face: own.face }.or_else(here, surface);
                missing = missing & !here;
                if !missing.any() {
                    break;
                }
            }
            number += 1;
        }
        Encounter {
            leaf,
            entering: after,
            surface,
        }
    }
}

/// What a line meets where it crosses the boundary of a program.
#[derive(Clone, Copy, Debug)]
pub struct Encounter<T: Real> {
    /// The number of the leaf whose surface it is, +inf where there is no crossing.
    pub leaf: T,
    /// Whether the line enters the program there.
    pub entering: T::Mask,
    /// The surface, its normal outward from the program.
    pub surface: Surface<T>,
}
