//! Solids that are not convex: each a program of leaves, with a distance of its own.

mod box_frame;
mod double_cone;
mod wide_solid_angle;

pub use box_frame::BoxFrame;
pub use double_cone::DoubleCone;
pub use wide_solid_angle::WideSolidAngle;

/// Both readings of a shape that has a standard distance in any arithmetic, `distance`, and a `program` of so many nodes.
macro_rules! readings {
    ($shape:ident of $nodes:literal nodes) => {
        impl $shape {
            /// How many nodes its program has: what it takes in a [`Draft`](crate::Draft).
            pub const NODES: usize = $nodes;

            /// The standard signed distance function `φ(p)`: exact, negative inside; NaN unless `p` is finite and within
            /// ±2^30.
            #[must_use]
            pub fn sdf(&self, p: glam::Vec3) -> f32 {
                if $crate::ray::is_in_range(p) {
                    self.distance($crate::vec3::V3::from(p))
                } else {
                    f32::NAN
                }
            }

            /// The generalized signed distance function `φ_G(v, p)`: that of its [`program`](Self::program), as
            /// [`Csg::gsdf`] has it.
            #[must_use]
            pub fn gsdf(&self, p: glam::Vec3, v: glam::Vec3) -> f32 {
                self.program().gsdf(p, v)
            }
        }

        impl $crate::trace::Field for $shape {
            #[inline(always)]
            fn distance_at<T: $crate::real::Real>(&self, p: $crate::vec3::V3<T>) -> T {
                self.distance(p)
            }
        }
    };
}
use readings;
