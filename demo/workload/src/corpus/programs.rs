//! The programs the corpus asks about, by turns.

use crate::scenes::PART;
use crate::shapes;
use crate::solids::ALONE;
use glam::{Mat3, Vec3, vec3};
use gsdf_nostd::{CappedCylinder, Capsule, Cuboid, Cylinder, HalfSpace, Nappe, Program, Sphere, Transform, csg, valid};

csg! {
    /// Two boxes that share a face, less one that ends in a face of theirs, and a peg that fills a hole: half-open
    /// spans decide whether there is a skin.
    const SHARED_FACES = union(
        difference(
            union(
                Cuboid::new(vec3(-1.0, -0.5, -1.0), vec3(0.0, 0.5, 1.0)),
                Cuboid::new(vec3(0.0, -0.5, -1.0), vec3(1.0, 0.5, 1.0))
            ),
            Cuboid::new(vec3(-0.5, 0.0, -0.5), vec3(0.5, 0.5, 0.5)),
            CappedCylinder::new(vec3(0.75, -0.5, 0.0), vec3(0.75, 0.5, 0.0), Vec3::Y, 0.25)
        ),
        CappedCylinder::new(vec3(0.75, -0.5, 0.0), vec3(0.75, 0.25, 0.0), Vec3::Y, 0.25)
    )
}

csg! {
    /// A solid at rest, one turned and moved, and one stretched and sheared.
    const POSED = difference(
        union(
            Sphere::new(Vec3::ZERO, 0.75),
            posed(1, intersection(Cuboid::new(Vec3::splat(-0.75), Vec3::splat(0.75)), Sphere::new(Vec3::ZERO, 1.0)))
        ),
        posed(2, Capsule::new(vec3(-1.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0), 0.25))
    )
}

/// A turn by the angle whose cosine and sine are 3/5 and 4/5, and a shear with scaling.
static POSES: [Transform; 2] = [
    valid!(Transform::affine(
        Mat3::from_cols(vec3(0.6, 0.8, 0.0), vec3(-0.8, 0.6, 0.0), Vec3::Z),
        vec3(0.25, -0.25, 0.5)
    )),
    valid!(Transform::affine(
        Mat3::from_cols(vec3(1.5, 0.25, 0.0), vec3(0.0, 0.75, 0.5), vec3(-0.25, 0.0, 2.0)),
        vec3(0.0, 0.25, 0.0)
    )),
];

csg! {
    /// All that is outside of a union: rays start inside, and solids without bounds take part.
    const OUTSIDE = complement(union(
        intersection(Nappe::new(vec3(0.0, 1.0, 0.0), Vec3::NEG_Y, 1.0, 1.0), HalfSpace::new(vec3(0.0, -0.5, 0.0), Vec3::NEG_Y)),
        intersection(Cylinder::new(Vec3::ZERO, Vec3::X, 0.25), Sphere::new(Vec3::ZERO, 1.25))
    ))
}

static COMPOSED: [Program<'static>; 4] = [
    const { &PART }.program(),
    const { &SHARED_FACES }.program(),
    valid!(const { &POSED }.program().posed(&POSES)),
    const { &OUTSIDE }.program(),
];

/// How many programs there are.
pub const PROGRAMS: usize = ALONE.len() + shapes::PROGRAMS.len() + COMPOSED.len();

/// The most leaves of any of them.
pub(super) const MOST_LEAVES: usize = {
    let (shapes, composed) = (most_leaves(&shapes::PROGRAMS), most_leaves(&COMPOSED));
    if shapes < composed { composed } else { shapes }
};

const fn most_leaves(programs: &[Program<'_>]) -> usize {
    let mut most = 1;
    let mut index = 0;
    while index < programs.len() {
        if most < programs[index].leaves() {
            most = programs[index].leaves();
        }
        index += 1;
    }
    most
}

/// The program of a number, counted modulo [`PROGRAMS`]: first each solid of [`solids`](crate::solids) alone, then those
/// of [`shapes`], then the larger ones.
#[must_use]
pub fn program(number: usize) -> Program<'static> {
    let number = number % PROGRAMS;
    match number.checked_sub(ALONE.len()) {
        None => ALONE[number].program(),
        Some(number) if number < shapes::PROGRAMS.len() => shapes::PROGRAMS[number],
        Some(number) => COMPOSED[number - shapes::PROGRAMS.len()],
    }
}
