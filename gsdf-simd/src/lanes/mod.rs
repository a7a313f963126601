//! Lane types: how eight numbers are one.

mod wide;

pub use wide::{F32x8, Mask8};
