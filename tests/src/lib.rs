//! What holds gsdf to its promises: an exact reference, generators of solids and rays, and the properties built on
//! them.

pub mod accuracy;
pub mod arrangements;
pub mod conformance;
pub mod corpus;
pub mod doubled;
pub mod fuzzed;
pub mod golden;
pub mod laws;
pub mod leaks;
pub mod poses;
pub mod reference;
pub mod sandwich;
pub mod shape;
pub mod tiles;
pub mod trees;

/// The README's code, compiled and run as it stands.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
pub struct Readme;
