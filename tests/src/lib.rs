//! What holds gsdf to its promises: an exact reference, generators of solids and rays, and the properties built on them.

pub mod corpus;
pub mod reference;
pub mod sandwich;
pub mod shape;
