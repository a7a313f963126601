//! The paper's own reading, kept and measured.
//!
//! H. Yamada's generalized signed distance functions give one number per primitive and ray, and compose them by minimum,
//! maximum and minus. Printed with its errors (listed in the `errata` page of `gsdf_nostd`) that is nothing to compare
//! with; repaired primitive by primitive it still can be read in several ways, and each of them is wrong on some rays. This
//! module evaluates them all on the roots that the library's own leaves have, so that no formula is written twice, and
//! compares them with the exact answer, which is [`march`](gsdf_nostd::march).
//!
//! - [`reading`], [`reader`]: the ways to read it, and what they make of any program of the default leaves.
//! - [`shapes`]: what the paper composes, of its four primitives.
//! - [`cameras`], [`measure`]: how often each is wrong, from where, and what it takes.
//! - [`picture`], [`command`]: the sheet and the table of `gsdf paper`.
//!
//! # Why the figures are what they are
//! Shares of wrong pixels are shares of a distribution of rays, and another one gives other figures. What they are made of
//! does not depend on it:
//!
//! - *The printed sign* puts planes in front behind, and those behind in front: wherever a plane decides, the pixel is
//!   wrong, also on rays that hit nothing.
//! - *A near root that lies behind* is smaller than all ahead and wins every minimum; and from inside a bounded solid all
//!   near roots lie behind, so nothing is ever left. Only planes, whose one root may be an exit, escape.
//! - *A positive root* may be an entry or an exit: a plane that one leaves counts like one that one enters, and the maximum
//!   prefers the far ones. From inside one convex intersection it takes the last exit instead of the first.
//! - *Entries* are right for every hit on an intersection of convex solids from outside; but the greatest entry may come
//!   after the least exit, and then it is a phantom. From inside there is no entry ahead. (Complements are pushed to the
//!   leaves, where the outside of a bounded leaf has two parts.)
//! - *One sweep* of signed next crossings never oversteps and has the right sign. It is wrong where it stops at a root
//!   that is none of the composed solid's: phantoms beside intersections; within unions the wall inside the other member.
//!
//! So phantoms grow with the sky in the pictures, and roots behind with the share of near eyes. A share of the rays that
//! *hit* would be another figure again.

pub mod cameras;
pub mod command;
pub mod measure;
pub mod picture;
pub mod reader;
pub mod reading;
pub mod shapes;
