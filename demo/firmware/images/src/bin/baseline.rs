//! The empty image: start-up code alone. What the others have beyond it is what they cost in flash.
#![no_std]
#![no_main]

use gsdf_firmware::board;

#[board::entry]
fn main() -> ! {
    board::stop()
}
