//! A ray cast at four balls, with a leaf type of spheres alone.
#![no_std]
#![no_main]

use gsdf_firmware::{ask, board, four_balls};
use gsdf_nostd::{Sphere, leaf_set};

leaf_set! {
    /// The solids of the scene, so that no others are linked.
    enum Ball { Sphere(Sphere) }
}

four_balls!(Ball);

#[board::entry]
fn main() -> ! {
    ask(&SCENE);
    board::stop()
}
