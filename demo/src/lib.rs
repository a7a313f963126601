//! Scenes and pictures of gsdf, for its command line, its tests and its benchmarks.
//!
//! - [`scenes`]: what is looked at and from where, as data; nothing in it draws.
//! - [`render`]: a scene to pixels, with the work its primary rays took counted apart from the light.
//! - [`frame`]: what the rays of a picture meet. [`batch`]: rays of any kind that are cast together, those that go on from there
//!   among them.
//! - [`light`], [`shade`] and [`palette`]: the light and the colours. [`edges`]: where one ray per pixel is not enough.
//! - [`gallery`], [`sheet`], [`output`] and [`progress`]: the pictures as files, and the table about them.
//! - [`shapes`]: a picture of each shape there is, all on one sheet and each for its documentation.
//! - [`model`]: models of OpenSCAD, read from files.
//! - [`command_line`]: what one can ask for. [`job`]: what is meant by it. [`commands`]: what is done with models.
//! - [`paper`]: the composition of the paper this library repairs, in the ways it can be read, measured.

pub mod batch;
pub mod command_line;
pub mod commands;
pub mod edges;
pub mod frame;
pub mod gallery;
pub mod job;
pub mod light;
pub mod model;
pub mod output;
pub mod palette;
pub mod paper;
pub mod progress;
pub mod render;
pub mod scenes;
pub mod shade;
pub mod shapes;
pub mod sheet;
