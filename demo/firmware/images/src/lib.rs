//! What the images share: the board they run on, what they count by, and the query whose size they measure.
#![no_std]

pub mod balls;
pub mod board;
mod instructions;
mod query;
mod rows;

pub use instructions::{FPU, Instructions};
pub use query::{ask, ask_distance};
pub use rows::all_are_right;
