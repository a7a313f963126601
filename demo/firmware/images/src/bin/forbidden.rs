//! What the measured images must not hold: a panic, arithmetic in `f64`, an allocator. The guards that find none of it
//! in the others must find all of it here.
#![no_std]
#![no_main]
#![allow(unsafe_code)]

extern crate alloc;

use alloc::boxed::Box;
use core::alloc::{GlobalAlloc, Layout};
use core::hint::black_box;
use core::ptr::null_mut;

use gsdf_firmware::board;

/// An allocator that has no memory.
struct Exhausted;

// SAFETY: no memory is ever handed out, so none is shared, too small, or given back.
unsafe impl GlobalAlloc for Exhausted {
    #[inline(never)]
    unsafe fn alloc(&self, _: Layout) -> *mut u8 {
        // The compiler may not know that whatever follows is never reached, or it would leave it out.
        black_box(null_mut())
    }
    unsafe fn dealloc(&self, _: *mut u8, _: Layout) {}
}

#[global_allocator]
static HEAP: Exhausted = Exhausted;

#[board::entry]
fn main() -> ! {
    let numbers = black_box([1.0_f64, 2.0, 3.0]);
    let quotient = black_box(numbers[black_box(1_usize)] / numbers[0]);
    black_box(Box::new(quotient));
    board::stop()
}
