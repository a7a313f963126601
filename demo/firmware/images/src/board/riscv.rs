//! RISC-V, 32 bits, with and without an FPU; the start-up code turns the FPU on where the target has one.
#![allow(unsafe_code)]

use core::arch::asm;

use riscv::register::minstret;
pub use riscv_rt::entry;

/// The result of `work` and how many instructions it and reading the counter take: the processor counts them itself,
/// though older QEMUs return the virtual time instead, in nanoseconds, and need `-icount shift=0` to make the two one.
pub(super) fn count<R>(work: impl FnOnce() -> R) -> (R, u64) {
    let before = instructions();
    let result = work();
    let after = instructions();
    (result, after.wrapping_sub(before))
}

/// The instructions since some time.
#[inline(never)]
fn instructions() -> u64 {
    minstret::read64()
}

/// Where the stack must end.
pub(super) fn stack_bottom() -> usize {
    unsafe extern "C" {
        /// From the linker script: the lower end of the memory for the stack.
        static __estack: u32;
    }
    (&raw const __estack).addr()
}

/// Writes `paint` into every word from `bottom` to the stack pointer, which is returned.
///
/// # Safety
/// That memory must not be in use.
#[inline(always)]
pub(super) unsafe fn paint(bottom: usize, paint: u32) -> usize {
    let top;
    // SAFETY: of this memory the caller has made sure.
    unsafe {
        asm!(
            "mv {top}, sp",
            "j 3f",
            "2: sw {paint}, 0({at})",
            "addi {at}, {at}, 4",
            "3: bltu {at}, {top}, 2b",
            at = inout(reg) bottom => _,
            top = out(reg) top,
            paint = in(reg) paint,
            options(nostack)
        );
    }
    top
}

/// The address of the first word from `bottom` that is not `paint`, or `top`.
///
/// # Safety
/// There must be memory from `bottom` to `top`, both multiples of four.
#[inline(always)]
pub(super) unsafe fn first_unpainted(bottom: usize, top: usize, paint: u32) -> usize {
    let deepest;
    // SAFETY: of this memory the caller has made sure.
    unsafe {
        asm!(
            "j 3f",
            "2: lw {word}, 0({at})",
            "bne {word}, {paint}, 4f",
            "addi {at}, {at}, 4",
            "3: bltu {at}, {top}, 2b",
            "4:",
            at = inout(reg) bottom => deepest,
            top = in(reg) top,
            paint = in(reg) paint,
            word = out(reg) _,
            options(nostack, readonly)
        );
    }
    deepest
}
