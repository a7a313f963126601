//! Programs: solids composed by union, intersection, difference and complement, and their two readings.

mod build;
mod cast;
mod check;
mod draft;
mod fold;
mod lanes;
mod march;
mod point;
mod program;
mod sight;
mod start;
mod sweep;

pub use cast::Hit;
pub use check::ProgramError;
pub use draft::Draft;
pub use lanes::Encounter;
pub use march::{March, march};
pub use program::{Csg, Node, Program};
pub use sight::{Crossing, Crossings, Sight};
pub use start::{Anywhere, Departure, Footing, OnSurface, SeenFrom, Start};
pub use sweep::{Attribution, attribute, sweep};
