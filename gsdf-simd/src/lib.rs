//! Packets of rays through the formulas of [`gsdf_nostd`].
//!
//! There is no formula in this crate: [`F32x8`] implements [`gsdf_nostd::Real`], and the text that computes one ray
//! computes eight. Each lane gets the bits that the scalar query gets, on every target and at every [level](Level).
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
//! With it come [prepared scenes](Scene) and whole pictures of them on all cores ([`Renderer`]), and on x86-64 the vectors
//! that the processor turns out to have. There is one line of `unsafe` code, in a module of its own: it asks the processor to
//! fetch what is written next, which no program can see but by the clock.
//!
//! # Pictures and batches
//! A [`Scene`] is a program taken apart once: into the operands of its outermost unions, each in the form that is cheapest to
//! cast rays at, with trees of boxes over them and over what is cut from them. A [`Renderer`] then looks, tile by tile of a
//! picture, only at what the tile's rays can meet; a [`Caster`] does the same for rays that have nothing in common. What is
//! left out changes no bit.
//!
//! ```
//! use glam::{Vec3, vec3};
//! use gsdf_nostd::{Camera, Cuboid, Sphere, csg};
//! use gsdf_simd::{Renderer, Scene, Tiles};
//!
//! csg! { const DIE = difference(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(vec3(0.0, 0.0, -1.0), 0.3)) }
//! let scene = Scene::new(DIE.program());
//! let camera = Camera::pinhole(vec3(0.0, 0.0, -5.0), Vec3::ZERO, Vec3::Y, 0.5)?;
//! let mut renderer = Renderer::new(&scene, camera.raster(64, 64));
//! let mut picture = Tiles::new(64, 64);
//! renderer.render(picture.as_target());
//! // The middle of the picture shows the bottom of the pit, its border the face around it, and the corners nothing.
//! let pixel = |x, y| picture.pixel(x, y).map(|pixel| (pixel.leaf, pixel.distance));
//! assert!(matches!(pixel(32, 32), Some((1, depth)) if depth > 4.29 && depth <= 4.3));
//! assert_eq!(pixel(24, 32), Some((0, 4.0)));
//! assert!(matches!(pixel(0, 0), Some((_, f32::INFINITY))));
//! # Ok::<(), gsdf_nostd::Invalid>(())
//! ```
//!
//! [`Renderer::certified`] says of every pixel how certain it is. Rays that go on from a hit, to a light or as a mirror image,
//! leave it without an epsilon:
//!
//! ```
//! use glam::{Vec3, vec3};
//! use gsdf_nostd::{OnSurface, Sphere, csg};
//! use gsdf_simd::{Caster, Leaving, RayHits, Rays, Scene};
//!
//! csg! { const MOON = difference(Sphere::new(Vec3::ZERO, 1.0), Sphere::new(vec3(0.0, 0.0, -1.2), 0.6)) }
//! let scene = Scene::new(MOON.program());
//! let caster = Caster::new(&scene);
//! let (x, zero, five, one) = ([0.0_f32, 0.8], [0.0_f32; 2], [-5.0_f32; 2], [1.0_f32; 2]);
//! let (mut distance, mut leaf, mut face) = ([0.0; 2], [0; 2], [0; 2]);
//! let hits = RayHits { leaf: Some(&mut leaf), face: Some(&mut face), ..RayHits::distances(&mut distance) };
//! caster.cast(&Rays::new([&x, &zero, &five], [&zero, &zero, &one]), hits)?;
//! // The bottom of the crater, and the ball beside it.
//! assert_eq!(leaf, [1, 0]);
//! let z = [0, 1].map(|ray| five[ray] + distance[ray]);
//! let slack = [0, 1].map(|ray| OnSurface::slack(vec3(x[ray], 0.0, -5.0), vec3(x[ray], 0.0, z[ray])));
//! let leaving = Leaving { leaf: &leaf, face: &face, slack: &slack };
//! // Towards a sun in the middle of the sky both are free; a flat light does not come out of the crater.
//! let mut shaded = [true; 2];
//! let up = Rays { leaving: Some(leaving), ..Rays::new([&x, &zero, &z], [&zero, &zero, &[-1.0; 2]]) };
//! caster.any(&up, &mut shaded)?;
//! assert_eq!(shaded, [false, false]);
//! let aside = Rays { leaving: Some(leaving), ..Rays::new([&x, &zero, &z], [&one, &zero, &[-0.3; 2]]) };
//! caster.any(&aside, &mut shaded)?;
//! assert_eq!(shaded, [true, false]);
//! # Ok::<(), gsdf_simd::LengthsDiffer>(())
//! ```
//!
//! # Levels
//! A build for any x86-64 processor may only use SSE2. Renderers ask the processor what it has and run code that was
//! compiled for that: with AVX2 eight rays in one register, with AVX-512 sixteen. [`Level`] tells which, and
//! [`Renderer::at_level`] takes another. Code of one's own is written once over [`Lanes`] and runs at any level:
//!
//! ```
//! use gsdf_nostd::{Span, Sphere, V3, csg};
//! use gsdf_simd::{Lanes, Level, Packet, Work};
//!
//! csg! { const BALL = Sphere::new(glam::Vec3::ZERO, 1.0) }
//!
//! /// Distances to the ball along rays that start at these heights and go downward.
//! struct Soundings<'a>(&'a mut [f32]);
//!
//! impl Work for Soundings<'_> {
//!     type Output = ();
//!
//!     fn run<T: Lanes>(self, token: T::Token) {
//!         T::vectorize(token, #[inline(always)] || sound::<T>(token, self.0));
//!     }
//! }
//!
//! #[inline(always)]
//! fn sound<T: Lanes>(token: T::Token, heights: &mut [f32]) {
//!     let (zero, one) = (T::splat(token, 0.0), T::splat(token, 1.0));
//!     let mut spans = [Span::empty_like(zero)];
//!     for heights in heights.chunks_mut(T::LANES) {
//!         let (from, down) = (V3::new(zero, T::load(token, heights), zero), V3::new(zero, -one, zero));
//!         let packet = Packet::from_lanes(from, down, zero, T::splat(token, f32::INFINITY));
//!         if let Ok(distances) = packet.gsdf(&BALL.program(), &mut spans) {
//!             distances.store(heights);
//!         }
//!     }
//! }
//!
//! let mut heights = [3.0; 21];
//! Level::best().run(Soundings(&mut heights));
//! assert_eq!(heights, [2.0; 21]);
//! ```
#![cfg_attr(not(feature = "std"), no_std)]

#[cfg(feature = "std")]
mod batch;
mod certified;
mod lanes;
mod level;
mod packet;
#[cfg(feature = "std")]
mod prefetch;
#[cfg(feature = "std")]
mod renderer;
#[cfg(feature = "std")]
mod scene;
#[cfg(feature = "std")]
mod target;
mod tier;
#[cfg(feature = "std")]
mod tile;
#[cfg(feature = "std")]
mod vectorized;

#[cfg(feature = "std")]
#[doc(hidden)]
pub use batch::RayCaster;
#[cfg(feature = "std")]
pub use batch::{Caster, Leaving, LengthsDiffer, RayHits, Rays};
pub use certified::certificate_of;
#[cfg(all(feature = "std", target_arch = "x86_64"))]
pub use lanes::{Avx2Doubles, Avx2Mask, Avx2WideMask, Avx2x8, Avx512Doubles, Avx512Mask, Avx512WideMask, Avx512x16};
pub use lanes::{F32x8, F64x8, LaneMask, Lanes, MOST_LANES, Mask8, WideMask8};
pub use level::{Level, LevelError, Work};
#[cfg(feature = "std")]
pub use packet::scratch;
pub use packet::{EMPTY, Hits, Packet};
#[cfg(feature = "std")]
#[doc(hidden)]
pub use renderer::RowRenderer;
#[cfg(feature = "std")]
pub use renderer::{Effort, Renderer};
#[cfg(feature = "std")]
pub use scene::{Scene, Visible};
#[cfg(feature = "std")]
pub use target::{Planes, Records, Target, Tiles, TilesMut, Wants};
pub use tier::{Double, Fast, Robust, Tier};
#[cfg(feature = "std")]
pub use tile::{Certificates, Pixel, TILE_PIXELS, TILE_SIDE, Tile};
#[cfg(feature = "std")]
pub use vectorized::Vectorized;
