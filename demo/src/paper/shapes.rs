//! The shapes the paper composes, and some it only names, of half-spaces, spheres, cylinders and nappes alone.

use glam::{Vec3, vec3};
use gsdf_nostd::{Cylinder, HalfSpace, Nappe, Node, Program, ProgramError, Sphere, csg};

/// A shape to be read.
#[derive(Clone, Debug)]
pub struct Shape {
    /// What it is.
    pub name: &'static str,
    /// The program, every leaf of which is one of the paper's four primitives.
    pub nodes: Vec<Node>,
    /// The middle of the ball within which all that matters of it lies.
    pub middle: Vec3,
    /// The radius of that ball.
    pub radius: f32,
    /// The direction of the eye of a picture from outside, as seen from the middle.
    pub from: Vec3,
    /// The eye of a picture from inside, towards the middle.
    pub within: Vec3,
}

impl Shape {
    /// Its program.
    ///
    /// # Errors
    /// Where the nodes are none.
    pub const fn program(&self) -> Result<Program<'_>, ProgramError> {
        Program::new(self.nodes.as_slice())
    }
}

csg! { const HALF_SPACE = HalfSpace::new(Vec3::ZERO, Vec3::Y) }

csg! { const BALL = Sphere::new(Vec3::ZERO, 1.0) }

csg! {
    const BOX = intersection(
        HalfSpace::new(vec3(1.0, 0.0, 0.0), Vec3::X),
        HalfSpace::new(vec3(-1.0, 0.0, 0.0), Vec3::NEG_X),
        HalfSpace::new(vec3(0.0, 1.0, 0.0), Vec3::Y),
        HalfSpace::new(vec3(0.0, -1.0, 0.0), Vec3::NEG_Y),
        HalfSpace::new(vec3(0.0, 0.0, 1.0), Vec3::Z),
        HalfSpace::new(vec3(0.0, 0.0, -1.0), Vec3::NEG_Z)
    )
}

csg! {
    const FINITE_CYLINDER = intersection(
        Cylinder::new(Vec3::ZERO, Vec3::Y, 0.7),
        HalfSpace::new(vec3(0.0, 1.0, 0.0), Vec3::Y),
        HalfSpace::new(vec3(0.0, -1.0, 0.0), Vec3::NEG_Y)
    )
}

csg! {
    const FINITE_CONE = intersection(
        Nappe::new(vec3(0.0, 1.0, 0.0), Vec3::NEG_Y, 1.0, 2.0),
        HalfSpace::new(vec3(0.0, -1.0, 0.0), Vec3::NEG_Y)
    )
}

csg! {
    /// Both planes point from one end to the other, and minus turns them over: the paper's formula for the capsule.
    const CAPSULE = union(
        intersection(Sphere::new(vec3(0.0, 0.7, 0.0), 0.6), complement(HalfSpace::new(vec3(0.0, 0.7, 0.0), Vec3::Y))),
        intersection(
            HalfSpace::new(vec3(0.0, 0.7, 0.0), Vec3::Y),
            Cylinder::new(Vec3::ZERO, Vec3::Y, 0.6),
            complement(HalfSpace::new(vec3(0.0, -0.7, 0.0), Vec3::Y))
        ),
        intersection(Sphere::new(vec3(0.0, -0.7, 0.0), 0.6), HalfSpace::new(vec3(0.0, -0.7, 0.0), Vec3::Y))
    )
}

csg! { const LEFT = Sphere::new(vec3(-0.45, 0.0, 0.0), 0.9) }

csg! { const RIGHT = Sphere::new(vec3(0.45, 0.0, 0.0), 0.9) }

csg! { const OVERLAPPING = union(LEFT, RIGHT) }

csg! { const DISJOINT = union(Sphere::new(vec3(-0.7, 0.0, 0.0), 0.6), Sphere::new(vec3(0.7, 0.0, 0.0), 0.6)) }

csg! { const LENS = intersection(LEFT, RIGHT) }

csg! { const BITTEN = difference(BALL, Sphere::new(vec3(0.7, 0.5, -0.5), 0.75)) }

csg! {
    const SNOW_CONE = union(
        intersection(
            Nappe::new(vec3(0.0, -1.3, 0.0), Vec3::Y, 1.0, 2.4),
            HalfSpace::new(vec3(0.0, 0.4, 0.0), Vec3::Y)
        ),
        Sphere::new(vec3(0.0, 0.55, 0.0), 0.68)
    )
}

csg! {
    const DIE = difference(
        intersection(BOX, Sphere::new(Vec3::ZERO, 1.4)),
        Cylinder::new(Vec3::ZERO, Vec3::X, 0.45),
        Cylinder::new(Vec3::ZERO, Vec3::Y, 0.45),
        Cylinder::new(Vec3::ZERO, Vec3::Z, 0.45)
    )
}

/// One slab of a tunnel each.
mod slab {
    use super::{HalfSpace, Vec3, csg};

    csg! { pub(super) const X = intersection(HalfSpace::new(Vec3::splat(0.7), Vec3::X), HalfSpace::new(Vec3::splat(-0.7), Vec3::NEG_X)) }
    csg! { pub(super) const Y = intersection(HalfSpace::new(Vec3::splat(0.7), Vec3::Y), HalfSpace::new(Vec3::splat(-0.7), Vec3::NEG_Y)) }
    csg! { pub(super) const Z = intersection(HalfSpace::new(Vec3::splat(0.7), Vec3::Z), HalfSpace::new(Vec3::splat(-0.7), Vec3::NEG_Z)) }
}

csg! {
    const BOX_FRAME = difference(
        BOX,
        intersection(slab::Y, slab::Z),
        intersection(slab::X, slab::Z),
        intersection(slab::X, slab::Y)
    )
}

/// All of them, the primitives first.
#[must_use]
pub fn shapes() -> Vec<Shape> {
    let shape = |name, nodes: &[Node], radius, within: [f32; 3]| Shape {
        name,
        nodes: nodes.to_vec(),
        middle: Vec3::ZERO,
        radius,
        from: vec3(0.5, 0.42, -0.757),
        within: within.into(),
    };
    vec![
        // From so low that the horizon is seen.
        Shape {
            from: vec3(0.28, 0.12, -0.95),
            ..shape("half-space", HALF_SPACE.nodes(), 1.0, [0.0, -0.4, -1.6])
        },
        shape("sphere", BALL.nodes(), 1.0, [0.3, 0.2, -0.8]),
        shape("box, 6 planes", BOX.nodes(), 1.74, [0.5, 0.6, -0.9]),
        shape("finite cylinder", FINITE_CYLINDER.nodes(), 1.23, [0.1, 0.6, -0.5]),
        shape("finite cone", FINITE_CONE.nodes(), 1.42, [0.2, -0.8, -0.6]),
        shape("capsule as printed", CAPSULE.nodes(), 1.3, [0.1, 1.0, -0.2]),
        shape("overlapping spheres", OVERLAPPING.nodes(), 1.35, [-1.1, 0.2, -0.2]),
        shape("disjoint spheres", DISJOINT.nodes(), 1.3, [-1.1, 0.1, -0.2]),
        shape("sphere and sphere", LENS.nodes(), 0.78, [0.1, 0.2, -0.6]),
        shape("sphere minus sphere", BITTEN.nodes(), 1.0, [-0.6, -0.3, -0.4]),
        shape("snow cone", SNOW_CONE.nodes(), 1.31, [-0.2, 0.9, -0.3]),
        shape("die", DIE.nodes(), 1.4, [0.75, 0.7, -0.6]),
        shape("box frame", BOX_FRAME.nodes(), 1.74, [0.85, 0.85, -0.9]),
    ]
}

#[cfg(test)]
mod tests {
    use super::shapes;
    use anyhow::Result;
    use glam::Vec3;
    use gsdf_nostd::{Leaf, Node};

    #[test]
    fn shapes_are_made_of_the_papers_primitives_alone() -> Result<()> {
        for shape in shapes() {
            shape.program()?;
            for node in &shape.nodes {
                if let Node::Leaf { solid, frame } = node {
                    let primitive = matches!(solid, Leaf::HalfSpace(_) | Leaf::Sphere(_) | Leaf::Cylinder(_) | Leaf::Nappe(_));
                    assert!(primitive && *frame == 0, "{}: {solid:?}", shape.name);
                }
            }
        }
        Ok(())
    }

    #[test]
    fn shapes_lie_within_their_balls() -> Result<()> {
        for shape in shapes().into_iter().skip(1) {
            let program = shape.program()?;
            for step in 0..4096 {
                let spread = |factor: f32| 2.0 * (step as f32 * factor).fract() - 1.0;
                // Irrational steps fill the sphere of directions.
                let direction = Vec3::new(spread(0.618_034), spread(0.754_878), spread(0.569_84));
                let point = shape.middle + direction.normalize() * 1.0001 * shape.radius;
                assert!(!program.contains(point), "{} at {point}", shape.name);
            }
            assert!(program.contains(shape.within), "{}", shape.name);
        }
        Ok(())
    }
}
