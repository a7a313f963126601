//! What every target is held against: the reference scenes, a solid of each kind, rays, and a hash over what comes out.
//!
//! All of it is data in flash and code without an allocator, so that a Cortex-M0 computes the very rows a server does:
//!
//! ```
//! use gsdf_nostd::Span;
//! use gsdf_workload::bits;
//!
//! let mut scratch = [Span::EMPTY; bits::SMALL_SPANS];
//! let row = &bits::SMALL[0];
//! assert_eq!(row.compute(&mut scratch)?, row.golden, "{}", row.name);
//! # Ok::<(), gsdf_nostd::ProgramError>(())
//! ```
//!
//! An image links what it names and no more: who computes [`bits::SMALL`] carries no [`scenes::S4`].
#![no_std]
#![forbid(unsafe_code)]

pub mod bits;
pub mod corpus;
pub mod costs;
pub mod digest;
pub mod scenes;
pub mod shapes;
pub mod solids;
pub mod tiers;
