//! What a device needs around `gsdf-nostd`: a picture for any display driver, a time-of-flight reading, the square
//! root of the FPU; and a small [device] made of them.
#![no_std]

mod braille;
pub mod device;
mod fpu;
mod picture;
mod range_finder;
pub mod shade;

pub use braille::braille;
pub use fpu::Fpu;
pub use picture::{Picture, PictureError};
pub use range_finder::{RangeFinder, RangeFinderError, millimetres};
