//! How accurate the library is, as a table: kinds of leaves, corpora of rays, and arithmetics.

mod corpus;
mod measure;
mod statistics;
mod trial;

pub use corpus::{Corpus, Target};
pub use measure::{Cell, Measured, WELL_CONDITIONED, is_curved};
pub use statistics::{Statistics, Worst};
pub use trial::{Arithmetic, Reference, Trial};
