//! A fast reference: the exact one's answer in a thousandth of the time, or none.
//!
//! It takes a solid of the exact [`reference`](crate::reference) and knows nothing of shapes. Every inequality is a
//! polynomial of degree two in space, and is found from its exact values at ten places. Along a line it is interpolated
//! from its values at three places near the solid, in double-double arithmetic ([`Ball`]) that carries a bound of its own
//! error: so every decision, on the sign of a discriminant or the order of two roots, is either certain or not made.
//! Where one is not made the answer is [`None`], and the exact reference is to be asked.

mod ball;
mod double;
mod quadric;
mod solid;
mod spans;

pub use ball::Ball;
pub use solid::{Input, Solid};
pub use spans::Ends;
