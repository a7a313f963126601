//! The balls of `spheres`, asked for no more than a distance: what halves flash and stack.
#![no_std]
#![no_main]

use gsdf_firmware::balls::SPHERES;
use gsdf_firmware::{ask_distance, board};

#[board::entry]
fn main() -> ! {
    ask_distance::<4, 7, _>(&SPHERES);
    board::stop()
}
