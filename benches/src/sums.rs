//! "As costly as the sum of its parts": every composed shape as its parts alone, as a program of them, and by its own span.

mod made_of;
mod measure;

pub use made_of::{Composed, all};
pub use measure::{Costs, Counts, Rays, costs, counts, distances_of, inputs_for};
