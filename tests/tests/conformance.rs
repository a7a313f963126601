//! Every arithmetic and every leaf type, the library's and a user's own, held to its duties. To hold another one to
//! them, add a line.

use gsdf_nostd::{Leaf, Sphere, leaf_set};
use gsdf_parts::Fpu;
use gsdf_simd::F32x8;
use gsdf_tests::conformance::octahedron::Octahedron;
use gsdf_tests::conformance::specimen::{Specimen, of_kind};
use gsdf_tests::shape::SOLIDS;
use gsdf_tests::{arithmetic_conformance, facet_conformance, leaf_conformance};
use rand::RngExt;
use rand_pcg::Pcg64;

arithmetic_conformance!(single: f32);
arithmetic_conformance!(double: f64);
arithmetic_conformance!(fpu: Fpu);
arithmetic_conformance!(packet_of_eight: F32x8);
#[cfg(target_arch = "x86_64")]
arithmetic_conformance!(packet_of_eight_in_avx2: gsdf_simd::Avx2x8);
#[cfg(target_arch = "x86_64")]
arithmetic_conformance!(packet_of_sixteen_in_avx512: gsdf_simd::Avx512x16);

/// A leaf of the library: its number among [`KINDS`], and how it is found in a [`Leaf`].
macro_rules! library_leaf {
    ($name:ident: $kind:literal, $variant:ident) => {
        library_leaf!($name: $kind, $variant, leaf_conformance);
    };
    ($name:ident: $kind:literal, $variant:ident, $duties:ident) => {
        $duties!($name: |rng: &mut Pcg64| of_kind(rng, $kind, |leaf| match leaf {
            Leaf::$variant(solid) => Some(solid),
            _ => None,
        }));
    };
}

library_leaf!(half_space: 0, HalfSpace);
library_leaf!(sphere: 1, Sphere);
library_leaf!(cylinder: 2, Cylinder);
library_leaf!(nappe: 3, Nappe);
library_leaf!(cuboid: 4, Cuboid);
library_leaf!(capped_cylinder: 5, CappedCylinder);
library_leaf!(cone: 6, Cone);
library_leaf!(capped_cone: 7, CappedCone);
library_leaf!(capsule: 8, Capsule);
library_leaf!(hexagonal_prism: 9, HexagonalPrism);
library_leaf!(triangular_prism: 10, TriangularPrism);
library_leaf!(octahedron: 11, Octahedron);
library_leaf!(pyramid: 12, Pyramid);
library_leaf!(rhombus: 13, Rhombus);
library_leaf!(rounded_cone: 14, RoundedCone);
library_leaf!(solid_angle: 15, SolidAngle);
library_leaf!(triangle: 16, Triangle, facet_conformance);
library_leaf!(quad: 17, Quad, facet_conformance);

/// Any leaf of the library that has an inside, as programs hold it.
fn any_leaf(rng: &mut Pcg64) -> Specimen<Leaf> {
    let kind = rng.random_range(0..SOLIDS);
    of_kind(rng, kind, Some)
}

leaf_conformance!(leaf: any_leaf);

leaf_set! {
    /// A leaf type of a user's: a solid of the library and one of the user's own.
    pub enum Gem { Sphere(Sphere), Octahedron(Octahedron) }
}

fn gem(rng: &mut Pcg64) -> Specimen<Gem> {
    if rng.random() {
        Octahedron::specimen(rng).map(Gem::from)
    } else {
        let sphere = |leaf| match leaf {
            Leaf::Sphere(sphere) => Some(Gem::from(sphere)),
            _ => None,
        };
        of_kind(rng, 1, sphere)
    }
}

leaf_conformance!(octahedron_of_a_user: Octahedron::specimen);
leaf_conformance!(gem: gem);
