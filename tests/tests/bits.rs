//! What must have the same bits, or hold, whatever the processor: every arithmetic, every leaf, packets, and what boards
//! compute. CI runs it in native builds too.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod boards;
mod conformance;
mod golden;
mod lanes;
mod packets;
