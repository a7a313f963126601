//! Scenes and pictures of gsdf, for its command line, its tests and its benchmarks.
//!
//! - [`scenes`]: what is looked at and from where, as data; nothing in it draws.
//! - [`render`]: a scene to pixels, with the work it took counted apart from the light.
//! - [`shade`] and [`palette`]: the light and the colours.
//! - [`gallery`] and [`output`]: the pictures as files, and the table about them.

pub mod gallery;
pub mod output;
pub mod palette;
pub mod render;
pub mod scenes;
pub mod shade;
