//! What every target is held against: the reference scenes, a solid of each kind, rays, and a hash over what comes out.
#![no_std]
#![forbid(unsafe_code)]
