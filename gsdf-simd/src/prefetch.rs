//! A word to the processor about what is written next.
//!
//! A picture is larger than the caches that are near, and a store to what is in none of them waits for it. The pixels of a
//! tile take so little time that there are more such waits than the processor can have at once, unless it is told of them
//! ahead and a few at a time.
#![allow(unsafe_code, reason = "no safe function says it, and it can do no harm: see below")]

/// Memory that is written soon: where a place is, and nothing that could be read or written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ahead(usize);

impl Ahead {
    /// What is written soon.
    #[inline(always)]
    pub(crate) fn of<P>(place: &mut P) -> Self {
        Self(core::ptr::from_mut(place).addr())
    }

    /// Has the processor fetch the memory so many bytes after the start of the place. Does nothing where there is no word
    /// for that.
    #[inline(always)]
    pub(crate) fn fetch(self, offset: usize) {
        #[cfg(target_arch = "x86_64")]
        {
            use core::arch::x86_64::{_MM_HINT_ET0, _mm_prefetch};
            let address = core::ptr::without_provenance(self.0.wrapping_add(offset));
            // SAFETY: the instruction changes nothing that a program can see and faults at no address; that its argument is
            // a pointer promises nothing, and it needs none to what may be accessed.
            unsafe { _mm_prefetch::<_MM_HINT_ET0>(address) };
        }
        #[cfg(not(target_arch = "x86_64"))]
        let _ = (self.0, offset);
    }
}
