//! What the images share: the board they run on, and the query whose size they measure.
#![no_std]

pub mod balls;
pub mod board;
mod query;
mod rows;

pub use query::{ask, ask_distance};
pub use rows::all_are_right;
