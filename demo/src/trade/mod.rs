//! What accuracy costs: every tier and a ladder of sphere tracers, on the same rays.

pub mod command;
mod contender;
mod measure;
mod plot;
mod scene;

pub use contender::Contender;
pub use measure::{Measured, Truth, measure};
pub use plot::svg;
pub use scene::{NAMES, Scene};
