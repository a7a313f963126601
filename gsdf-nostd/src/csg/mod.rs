//! Programs: solids composed by union, intersection, difference and complement, and their two readings.

mod build;
mod cast;
mod certified;
mod certify;
mod check;
mod draft;
mod fold;
mod footing;
mod hit;
mod lanes;
mod march;
mod node;
mod point;
mod program;
mod sight;
mod start;
mod sweep;

pub use certified::{Certified, CertifiedScratch, Settled, half_ulp};
pub use certify::{Certificate, certify};
pub use check::ProgramError;
pub use draft::Draft;
pub use footing::{Anywhere, Footing, OnSurface, SeenFrom};
pub use hit::Hit;
pub use lanes::Encounter;
pub use march::{March, march};
pub use node::Node;
pub use program::{Csg, Program};
pub use sight::{Crossing, Crossings, Sight};
pub use start::{Departure, Start};
pub use sweep::{Attribution, attribute, sweep};
