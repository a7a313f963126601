//! A word to the processor about what is written next.
//!
//! A picture is larger than the caches that are near, and a store to what is in none of them waits for it. The pixels of a
//! tile take so little time that there are more such waits than the processor can have at once, unless it is told ahead.
#![allow(unsafe_code, reason = "no safe function says it, and it can do no harm: see below")]

/// Has the processor fetch the memory of `place`, to be written to soon. Does nothing where there is no word for it.
#[inline(always)]
pub(crate) fn for_writing<P>(place: &mut P) {
    #[cfg(target_arch = "x86_64")]
    {
        use core::arch::x86_64::{_MM_HINT_ET0, _mm_prefetch};
        const LINE: usize = 64;
        let start = core::ptr::from_mut(place).cast::<i8>().cast_const();
        for line in 0..size_of::<P>().div_ceil(LINE) {
            // SAFETY: the instruction changes nothing that a program can see, faults at no address, and is executed as
            // nothing by processors that do not know it; all that is asked of an address here is that it be one.
            unsafe { _mm_prefetch::<_MM_HINT_ET0>(start.wrapping_add(line * LINE)) };
        }
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = place;
}
