//! Cortex-M: M0, M3 and M4F.
#![allow(unsafe_code)]

use core::arch::asm;
use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::Peripherals;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
pub use cortex_m_rt::entry;

/// How long each instruction takes under QEMU's `-icount shift=7`, in picoseconds: more than two ticks of the system
/// timer, so that rounding gives the number of instructions exactly.
const INSTRUCTION: u64 = 128_000;

/// One tick of the system timer, in picoseconds: 16 MHz on the micro:bit, 25 MHz on the others.
const TICK: u64 = if cfg!(roomy) { 40_000 } else { 62_500 };

/// The system timer counts down through this many values.
const PERIOD: u64 = 1 << 24;

/// How often the system timer has come to zero.
static WRAPS: AtomicU32 = AtomicU32::new(0);

#[cortex_m_rt::exception]
fn SysTick() {
    WRAPS.store(WRAPS.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
}

/// The result of `work` and how many instructions it and reading the counter take; about ten
/// more every 5 million (8 million on the micro:bit), when the timer comes to zero. Its interrupt is on meanwhile.
pub(super) fn count<R>(work: impl FnOnce() -> R) -> (R, u64) {
    // SAFETY: nobody else uses the system timer, and it is given back before this returns.
    let timer = &mut unsafe { Peripherals::steal() }.SYST;
    timer.set_clock_source(SystClkSource::Core);
    timer.set_reload((PERIOD - 1) as u32);
    timer.clear_current();
    timer.enable_interrupt();
    timer.enable_counter();
    // Cleared, it is at zero once without having come to it.
    while SYST::get_current() == 0 {}
    let before = ticks();
    let result = work();
    let after = ticks();
    timer.disable_counter();
    timer.disable_interrupt();
    (result, ((after - before) * TICK + INSTRUCTION / 2) / INSTRUCTION)
}

/// The ticks of the system timer since some time.
#[inline(never)]
fn ticks() -> u64 {
    loop {
        let wraps = WRAPS.load(Ordering::Relaxed);
        let current = u64::from(SYST::get_current());
        if wraps == WRAPS.load(Ordering::Relaxed) {
            return u64::from(wraps) * PERIOD + (PERIOD - current) % PERIOD;
        }
    }
}

/// Where the stack must end.
pub(super) fn stack_bottom() -> usize {
    unsafe extern "C" {
        /// From the linker script: where the variables end.
        static _stack_end: u32;
    }
    (&raw const _stack_end).addr()
}

/// Writes `paint` into every word from `bottom` to the stack pointer, which is returned.
///
/// # Safety
/// That memory must not be in use.
#[inline(always)]
pub(super) unsafe fn paint(bottom: usize, paint: u32) -> usize {
    let top;
    // SAFETY: of this memory the caller has made sure; flags are clobbered by default.
    unsafe {
        asm!(
            "mov {top}, sp",
            "b 3f",
            "2: str {paint}, [{at}]",
            "adds {at}, #4",
            "3: cmp {at}, {top}",
            "blo 2b",
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
    // SAFETY: of this memory the caller has made sure; flags are clobbered by default.
    unsafe {
        asm!(
            "b 3f",
            "2: ldr {word}, [{at}]",
            "cmp {word}, {paint}",
            "bne 4f",
            "adds {at}, #4",
            "3: cmp {at}, {top}",
            "blo 2b",
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
