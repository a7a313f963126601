//! The solids: one file each, and in it everything about that solid.

mod capped_cone;
mod capped_cylinder;
mod capsule;
mod cone;
mod conical_side;
mod cuboid;
mod cylinder;
mod half_space;
mod nappe;
mod plane;
mod set;
mod solid;
mod sphere;

pub use capped_cone::CappedCone;
pub use capped_cylinder::CappedCylinder;
pub use capsule::Capsule;
pub use cone::Cone;
pub use cuboid::Cuboid;
pub use cylinder::Cylinder;
pub use half_space::HalfSpace;
pub use nappe::Nappe;
pub use set::Leaf;
pub use solid::{Bounds, Ground, Solid, Surface};
pub use sphere::Sphere;
