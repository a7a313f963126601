//! What accuracy costs: every tier and a ladder of sphere tracers, on the same rays.
//!
//! A package of its own, because packets in every tier at every level are much to compile.
//!
//! - [`Solids`]: what programs are made of here. [`Subject`]: a program and the rays through the pixels of a picture of it. [`reference()`]: those that are always at hand.
//! - [`Contender`]: who casts the rays. [`Ready`]: one at work.
//! - [`measure()`]: times and errors, by turns. [`svg`]: the chart of them.

mod cast;
mod contender;
mod measure;
mod plot;
mod reference;
mod solids;
mod statistics;
mod subject;

pub use cast::{Ready, Seen};
pub use contender::{Contender, Method, Way};
pub use measure::{Measured, measure};
pub use plot::svg;
pub use reference::{NAMES, reference};
pub use solids::{Primitive, Solids};
pub use statistics::Estimate;
pub use subject::Subject;
