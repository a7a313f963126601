//! The balls of `spheres`, asked for no more than a distance: what halves flash and stack.
#![no_std]
#![no_main]

use gsdf_firmware::{ask_distance, board, four_balls};
use gsdf_nostd::{Sphere, leaf_set};

leaf_set! {
    /// The solids of the scene, so that no others are linked.
    enum Ball { Sphere(Sphere) }
}

four_balls!(Ball);

#[board::entry]
fn main() -> ! {
    ask_distance::<4, 7, _>(&SCENE);
    board::stop()
}
