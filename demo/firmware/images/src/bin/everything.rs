//! The ray and the balls of `spheres`, with the leaf type of all solids: what it costs not to choose.
#![no_std]
#![no_main]

use gsdf_firmware::balls::EVERYTHING;
use gsdf_firmware::{ask, board};

#[board::entry]
fn main() -> ! {
    ask(&EVERYTHING);
    board::stop()
}
