//! Four balls in a row, each of which touches or overlaps the next: one scene with two leaf types.

use glam::Vec3;
use gsdf_nostd::{Csg, Leaf, Sphere, csg, leaf_set};

leaf_set! {
    /// The solids of the scene and no others.
    pub enum Ball { Sphere(Sphere) }
}

macro_rules! four_balls {
    ($name:ident: $leaf:ty) => {
        csg! {
            const $name: $leaf = union(
                Sphere::new(Vec3::new(-3.0, 0.0, 0.0), 1.0),
                Sphere::new(Vec3::new(-1.0, 0.0, 0.0), 1.0),
                Sphere::new(Vec3::new(1.0, 0.0, 0.0), 1.25),
                Sphere::new(Vec3::new(3.0, 0.0, 0.0), 1.0)
            )
        }
    };
}

four_balls!(OF_SPHERES: Ball);
four_balls!(OF_ANYTHING: Leaf);

/// The balls, in flash, where spheres alone are leaves.
pub static SPHERES: Csg<7, Ball> = OF_SPHERES;

/// The same balls where every solid of the library may be a leaf.
pub static EVERYTHING: Csg<7> = OF_ANYTHING;
