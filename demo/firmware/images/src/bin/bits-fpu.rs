//! As `bits`, with the square root of the FPU where the board has one.
#![no_std]
#![no_main]

use gsdf_firmware::{all_are_right, board};
use gsdf_parts::Fpu;

#[board::entry]
fn main() -> ! {
    board::exit(all_are_right::<Fpu>())
}
