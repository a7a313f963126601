//! What both images share, so that it does not count in their difference: the panic handler and the end.

#![no_std]

use core::hint::spin_loop;
use core::panic::PanicInfo;

/// Where an image ends: there is no system to return to.
pub fn stop() -> ! {
    loop {
        spin_loop();
    }
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    stop()
}
