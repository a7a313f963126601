//! A ray cast at four balls, with a leaf type of spheres alone.
#![no_std]
#![no_main]

use gsdf_firmware::balls::SPHERES;
use gsdf_firmware::{ask, board};

#[board::entry]
fn main() -> ! {
    ask(&SPHERES);
    board::stop()
}
