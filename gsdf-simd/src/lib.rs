//! Packets of eight rays through the formulas of [`gsdf_nostd`].
//!
//! There is no formula in this crate: [`F32x8`] implements [`gsdf_nostd::Real`], and the text that computes one ray
//! computes eight. Each lane gets the bits that the scalar query gets, on every target.
//!
//! ```
//! use glam::{Vec3, vec3};
//! use gsdf_nostd::{Ray, Sphere, csg};
//! use gsdf_simd::{Packet, scratch};
//!
//! csg! { const BALL = Sphere::new(Vec3::ZERO, 1.0) }
//! let rays: [Ray; 8] = core::array::from_fn(|lane| Ray::new(vec3(0.3 * lane as f32, 0.0, 5.0), Vec3::NEG_Z).unwrap());
//! let hits = Packet::new(&rays).cast(&BALL.program(), &mut scratch(BALL.leaves()))?;
//! for (lane, ray) in rays.iter().enumerate() {
//!     assert_eq!(hits.lane(lane, ray), BALL.cast(ray));
//! }
//! # Ok::<(), gsdf_nostd::ProgramError>(())
//! ```
//!
//! Without the feature `std` (on by default) the crate is `no_std` and does not allocate: packets and their queries.
//! With it come [prepared scenes](Scene) and whole pictures of them on all cores ([`Renderer`]).
#![cfg_attr(not(feature = "std"), no_std)]
#![forbid(unsafe_code)]

mod lanes;
mod level;
mod packet;
#[cfg(feature = "std")]
mod renderer;
#[cfg(feature = "std")]
mod scene;
#[cfg(feature = "std")]
mod target;
#[cfg(feature = "std")]
mod tile;

#[cfg(all(feature = "std", target_arch = "x86_64"))]
pub use lanes::{Avx2Mask, Avx2x8, Avx512Mask, Avx512x16};
pub use lanes::{F32x8, LaneMask, Lanes, MOST_LANES, Mask8};
pub use level::{Level, LevelError, Work};
#[cfg(feature = "std")]
pub use packet::scratch;
#[cfg(feature = "std")]
pub use renderer::{Effort, Renderer};
#[cfg(feature = "std")]
pub use scene::Scene;
#[cfg(feature = "std")]
pub use target::{Planes, Records, Target, Tiles, TilesMut, Wants};
#[cfg(feature = "std")]
pub use tile::{Pixel, TILE_PIXELS, TILE_SIDE, Tile};
pub use packet::{EMPTY, Hits, Packet};
