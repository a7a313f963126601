//! How accurate the library is, as a table: kinds of leaves, corpora of rays, and arithmetics.
//!
//! Every cell of the table has rows, one for each arithmetic, of what is allowed; rays by the thousand are measured against
//! the fast reference ([`doubled`](crate::doubled)) or, where that cannot tell, the exact one. Rays have numbers, and
//! any can be seen again by its cell and number.
//!
//! What is allowed is either derived, as the page `numerics` of the library's documentation has it, or four times the
//! largest that was measured. `tests/accuracy-bounds.csv` holds it; `tests/accuracy.csv` records what was measured, of
//! these rays and of all that were measured since.

mod backward;
mod certainty;
pub mod chart;
pub mod command;
mod corpus;
mod measure;
pub mod record;
mod solids;
mod statistics;
pub mod table;
mod trial;

pub use backward::Backward;
pub use certainty::Certainty;
pub use corpus::{Corpus, Target};
pub use measure::{Cell, Floor, Measured, PART, WELL_CONDITIONED, is_curved};
pub use statistics::{Statistics, Summary, Worst};
pub use trial::{Arithmetic, Placed, Reference, Trial};
