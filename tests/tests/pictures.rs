//! Tiles, whole pictures and batches of rays, at every level the processor has, against every ray cast by itself.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod batches;
mod certified_pictures;
mod crowds;
mod images;
mod leaving;
mod tiled;
