//! One solid of each kind, under its name: what costs, hashes and tables run over.
//!
//! A new kind of solid is one more line in the list below, and from then on in every bench, table and hash.

use glam::{Vec3, vec3};
use gsdf_nostd::{
    CappedCone, CappedCylinder, Capsule, Cone, Csg, Cuboid, Cylinder, HalfSpace, HexagonalPrism, Leaf, Nappe, Node, Octahedron, Pyramid,
    Quad, Rhombus, RoundedCone, Solid, SolidAngle, Sphere, Triangle, TriangularPrism, valid,
};

/// Something done with a solid of each kind.
pub trait Visitor {
    /// Does it with one of them.
    fn leaf<S: Solid>(&mut self, name: &'static str, solid: S);
}

macro_rules! solids {
    ($($constant:ident: $solid:ident, $name:literal, $made:expr;)+) => {
        $(
            #[doc = concat!("A ", $name, ": [`", stringify!($solid), "`].")]
            pub const $constant: $solid = valid!($made);
        )+

        /// The names, in the order of the list.
        pub const NAMES: [&str; [$($name),+].len()] = [$($name),+];

        /// Programs of one solid each, in the order of [`NAMES`].
        pub static ALONE: [Csg<1>; NAMES.len()] = [$(
            valid!(Csg::new([Node::leaf(Leaf::$solid($constant))]))
        ),+];

        /// Shows each solid under its own type to the visitor, in the order of [`NAMES`].
        pub fn visit(visitor: &mut impl Visitor) {
            $(visitor.leaf($name, $constant);)+
        }
    };
}

const LOW: Vec3 = vec3(0.0, -0.75, 0.0);
const HIGH: Vec3 = vec3(0.0, 0.75, 0.0);

// All stand upright around the origin and are about one unit in size; faces, edges and tips lie at multiples of a quarter.
solids! {
    HALF_SPACE: HalfSpace, "half-space", HalfSpace::new(Vec3::ZERO, Vec3::Y);
    SPHERE: Sphere, "sphere", Sphere::new(Vec3::ZERO, 1.0);
    CYLINDER: Cylinder, "cylinder", Cylinder::new(Vec3::ZERO, Vec3::Y, 0.75);
    NAPPE: Nappe, "nappe", Nappe::new(LOW, Vec3::Y, 0.5, 1.0);
    CUBOID: Cuboid, "cuboid", Cuboid::new(vec3(-0.75, -0.5, -1.0), vec3(0.75, 0.5, 1.0));
    CAPPED_CYLINDER: CappedCylinder, "capped cylinder", CappedCylinder::new(LOW, HIGH, Vec3::Y, 0.75);
    CONE: Cone, "cone", Cone::new(HIGH, LOW, Vec3::NEG_Y, 0.75);
    CAPPED_CONE: CappedCone, "capped cone", CappedCone::new(LOW, HIGH, Vec3::Y, 0.75, 0.25);
    CAPSULE: Capsule, "capsule", Capsule::new(LOW, HIGH, 0.5);
    HEXAGONAL_PRISM: HexagonalPrism, "hexagonal prism", HexagonalPrism::new(LOW, HIGH.y, 0.75);
    TRIANGULAR_PRISM: TriangularPrism, "triangular prism", TriangularPrism::new(LOW, HIGH.y, 0.5);
    OCTAHEDRON: Octahedron, "octahedron", Octahedron::new(Vec3::ZERO, 1.0);
    PYRAMID: Pyramid, "pyramid", Pyramid::new(LOW, 0.75, 1.5);
    RHOMBUS: Rhombus, "rhombus", Rhombus::new(LOW, HIGH.y, 1.0, 0.625, 0.0);
    ROUNDED_RHOMBUS: Rhombus, "rounded rhombus", Rhombus::new(LOW, HIGH.y, 0.75, 0.5, 0.25);
    ROUNDED_CONE: RoundedCone, "rounded cone", RoundedCone::new(LOW, HIGH, 0.75, 0.25);
    SOLID_ANGLE: SolidAngle, "solid angle", SolidAngle::new(LOW, Vec3::Y, 1.5, 0.75, 1.0);
    TRIANGLE: Triangle, "triangle", Triangle::new(vec3(-1.0, -0.5, 0.25), vec3(1.0, -0.5, -0.25), vec3(0.0, 1.0, 0.0));
    QUAD: Quad, "quad", Quad::new(vec3(-1.0, -0.5, 0.25), vec3(1.0, -0.5, 0.25), vec3(0.75, 0.75, -0.25), vec3(-0.75, 0.75, -0.25));
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{ALONE, NAMES, Visitor, visit};
    use glam::vec3;
    use gsdf_nostd::Solid;
    use std::vec::Vec;

    struct Seen(Vec<(&'static str, f32)>);

    impl Visitor for Seen {
        fn leaf<S: Solid>(&mut self, name: &'static str, solid: S) {
            self.0.push((name, solid.sdf(vec3(0.4, 0.3, 0.2))));
        }
    }

    #[test]
    fn names_programs_and_visits_are_in_one_order() {
        let mut seen = Seen(Vec::new());
        visit(&mut seen);
        let listed = NAMES
            .iter()
            .zip(&ALONE)
            .map(|(name, program)| (*name, program.sdf(vec3(0.4, 0.3, 0.2))));
        assert_eq!(seen.0, listed.collect::<Vec<_>>());
    }

    #[test]
    fn no_two_have_one_name() {
        assert!((1..NAMES.len()).all(|place| !NAMES[..place].contains(&NAMES[place])));
    }
}
