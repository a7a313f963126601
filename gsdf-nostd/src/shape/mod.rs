//! Solids that are not convex: each a program of leaves, with a distance of its own.

mod box_frame;
mod double_cone;
mod wide_solid_angle;

pub use box_frame::BoxFrame;
pub use double_cone::DoubleCone;
pub use wide_solid_angle::WideSolidAngle;
