//! How far a model reaches.

use super::Model;
use glam::{Mat3, Vec3};
use gsdf_nostd::{Bounds, Node, Solid};

/// How far a solid reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// Nowhere.
    Empty,
    /// No farther than a box.
    Within(Bounds),
    /// Without end, in some direction.
    Endless,
}

impl Reach {
    fn union(self, other: Self) -> Self {
        match (self, other) {
            (Self::Empty, reach) | (reach, Self::Empty) => reach,
            (Self::Within(a), Self::Within(b)) => Self::Within(a.joined(b)),
            _ => Self::Endless,
        }
    }

    fn intersection(self, other: Self) -> Self {
        match (self, other) {
            (Self::Endless, reach) | (reach, Self::Endless) => reach,
            (Self::Within(a), Self::Within(b)) => {
                let (min, max) = (a.min.max(b.min), a.max.min(b.max));
                if min.cmplt(max).all() { Self::Within(Bounds { min, max }) } else { Self::Empty }
            }
            _ => Self::Empty,
        }
    }
}

impl Model {
    /// A box around the model: one of the boxes of its leaves, joined as they are, which may be too large and is never too
    /// small.
    #[must_use]
    pub fn reach(&self) -> Reach {
        let mut waiting: Vec<(Reach, Reach)> = Vec::new();
        for node in &self.nodes {
            // Of each operand how far it reaches, and how far what is not in it.
            let made = match node {
                Node::Leaf { solid, frame } => {
                    let pose = usize::from(*frame).checked_sub(1).and_then(|index| self.matrices.get(index));
                    let bounds = solid.bounds().map(|bounds| pose.map_or(bounds, |pose| posed(bounds, pose)));
                    (bounds.map_or(Reach::Endless, Reach::Within), Reach::Endless)
                }
                Node::Complement => match waiting.pop() {
                    Some((inside, outside)) => (outside, inside),
                    None => return Reach::Empty,
                },
                operator => {
                    let (Some(second), Some(first)) = (waiting.pop(), waiting.pop()) else {
                        return Reach::Empty;
                    };
                    match operator {
                        Node::Union => (first.0.union(second.0), first.1.intersection(second.1)),
                        Node::Difference => (first.0.intersection(second.1), first.1.union(second.0)),
                        _ => (first.0.intersection(second.0), first.1.union(second.1)),
                    }
                }
            };
            waiting.push(made);
        }
        waiting.pop().map_or(Reach::Empty, |(inside, _)| inside)
    }
}

/// The box around a box in a frame.
fn posed(bounds: Bounds, frame: &Mat3) -> Bounds {
    let corner = |number: usize| {
        let side = |axis: usize| if number >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] };
        *frame * Vec3::new(side(0), side(1), side(2))
    };
    let corners = (0..8).map(corner);
    let of = |choose: fn(Vec3, Vec3) -> Vec3| corners.clone().reduce(choose).unwrap_or(Vec3::ZERO);
    let (min, max) = (of(Vec3::min), of(Vec3::max));
    // Three products and two sums are off by less than that.
    let slack = Vec3::splat(4.0 * f32::EPSILON * min.abs().max(max.abs()).max_element());
    Bounds {
        min: min - slack,
        max: max + slack,
    }
}

#[cfg(test)]
mod tests {
    use super::Reach;
    use crate::model::Model;
    use crate::model::evaluate::Reading;
    use glam::{Vec3, vec3};

    fn reach(text: &str) -> Reach {
        Model::read(text, Reading::default()).expect("it is a model").reach()
    }

    fn assert_within(text: &str, min: Vec3, max: Vec3) {
        let Reach::Within(bounds) = reach(text) else {
            panic!("{text} has no bounds")
        };
        assert!(bounds.min.abs_diff_eq(min, 1e-5) && bounds.max.abs_diff_eq(max, 1e-5), "{text}: {bounds:?}");
    }

    #[test]
    fn bounds_are_those_of_what_is_left() {
        assert_within("cube(2); multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0]]) cube(1);", Vec3::ZERO, vec3(4.0, 2.0, 2.0));
        assert_within("difference() { cube(2); cube(9, true); }", Vec3::ZERO, Vec3::splat(2.0));
        assert_within("intersection() { cube(2); cube(2, true); }", Vec3::ZERO, Vec3::ONE);
        // What is cut away is heavier than what it is cut from.
        assert_within("difference() { cube(2); union() { cube(1); sphere(1); } }", Vec3::ZERO, Vec3::splat(2.0));
        assert_within("multmatrix([[0.6,-0.8,0,0],[0.8,0.6,0,0],[0,0,1,0]]) cube(1);", vec3(-0.8, 0.0, 0.0), vec3(0.6, 1.4, 1.0));
        assert_eq!(reach("intersection() { cube(1); multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0]]) cube(1); }"), Reach::Empty);
        assert_eq!(reach(""), Reach::Empty);
    }
}
