//! How deep the stack was: paint what is free of it, let work be done, look how far the paint is gone.
#![allow(unsafe_code)]

use super::{call, processor};

/// The paint: no address, no float that computations produce, no small number.
const PAINT: u32 = 0xdeca_fbad;

/// How many bytes of stack `work` takes: the frame of the function it is called in, and all below.
///
/// What `work` only captures lies in the caller's frame and does not count. A word that is reserved but never written
/// is not seen, nor is one that holds the very paint. Not while [`super::instructions_of`] counts.
#[inline(never)]
pub fn stack_used_by(work: impl FnOnce()) -> usize {
    let bottom = processor::stack_bottom();
    // SAFETY: the memory from the end of the variables up to the stack pointer belongs to the stack and is not in use:
    // neither processor's calling convention has a red zone, there is no heap, and no interrupt is on. The assembler
    // itself uses no stack and takes no memory from the compiler that it would not expect to change. Nothing is
    // painted if the stack has already run past its end.
    let top = unsafe { processor::paint(bottom, PAINT) };
    call(work);
    // SAFETY: as above; this only reads.
    let deepest = unsafe { processor::first_unpainted(bottom, top, PAINT) };
    top - deepest
}
