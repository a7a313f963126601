//! What accuracy costs: every tier and a ladder of sphere tracers, on the same rays.
//!
//! A package of its own, because packets in every tier at every level are much to compile.

mod contender;
mod measure;
mod plot;
mod scene;

pub use contender::{Contender, Method, Seen};
pub use measure::{Measured, Truth, measure};
pub use plot::svg;
pub use scene::{NAMES, Primitive, Scene};
