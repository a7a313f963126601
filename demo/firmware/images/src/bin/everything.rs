//! The ray and the balls of `spheres`, with the leaf type of all solids: what it costs not to choose.
#![no_std]
#![no_main]

use gsdf_firmware::{ask, board, four_balls};
use gsdf_nostd::{Leaf, Sphere};

four_balls!(Leaf);

#[board::entry]
fn main() -> ! {
    ask(&SCENE);
    board::stop()
}
