//! The board: its entry point, its output, its end, and two instruments, for instructions and for stack.
//!
//! All that differs between the processors is in [`entry`] and in the private module `processor`; all `unsafe` code of
//! this package is in this folder. There is one core, no second thread, and no interrupt but the one that
//! `processor` may turn on while it counts.

#[cfg_attr(target_arch = "arm", path = "arm.rs")]
#[cfg_attr(target_arch = "riscv32", path = "riscv.rs")]
mod processor;
mod stack;

use core::panic::PanicInfo;

pub use processor::entry;
pub use semihosting::println;
pub use stack::stack_used_by;

/// Ends the program, and QEMU with exit status 0 or, unless `ok`, 1.
pub fn exit(ok: bool) -> ! {
    semihosting::process::exit(i32::from(!ok))
}

/// Where an image ends that has no use for the host: there is no system to return to.
pub fn stop() -> ! {
    loop {
        core::hint::spin_loop();
    }
}

/// How many instructions `work` takes, beside its result: those of [`call`] with nothing to do are subtracted.
///
/// Exact and repeatable where QEMU runs with the `-icount` that `../run` gives it; elsewhere Cortex-M's figure is but a
/// time. On Cortex-M about ten more for every 5 million, for the timer's interrupt. Not to be nested. What `work` needs
/// should come from [`core::hint::black_box`] and its result go there, or the compiler does the work elsewhere or not
/// at all.
pub fn instructions_of<R>(work: impl FnOnce() -> R) -> (R, u64) {
    let ((), overhead) = processor::count(|| call(|| ()));
    let (result, all) = processor::count(|| call(work));
    (result, all.saturating_sub(overhead))
}

/// Calls `work`, whose code is here and not merged with that of the caller, which measures it.
#[inline(never)]
fn call<R>(work: impl FnOnce() -> R) -> R {
    work()
}

/// Not linked into an image that cannot panic.
#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    println!("{info}");
    exit(false)
}
