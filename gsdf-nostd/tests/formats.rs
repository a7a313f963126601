//! What a firmware can log.
#![cfg(feature = "defmt")]

use gsdf_nostd::{Csg, Cuboid, Leaf, Node, Program, ProgramError, Sphere, leaf_set};

leaf_set! {
    /// Leaves of one's own, logged by an attribute.
    #[derive(defmt::Format)]
    enum Obstacle {
        Sphere(Sphere),
        Cuboid(Cuboid),
    }
}

fn is_logged<T: defmt::Format>() {}

#[test]
fn programs_of_any_logged_leaf_are_logged() {
    is_logged::<Node<Obstacle>>();
    is_logged::<Program<'_, Obstacle>>();
    is_logged::<Csg<3, Obstacle>>();
    is_logged::<Csg<3, Leaf>>();
    is_logged::<ProgramError>();
}
