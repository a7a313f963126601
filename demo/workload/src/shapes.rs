//! The solids that are programs of several leaves, under their names.
//!
//! A new one is one more line in the list below, and from then on in every hash, bench and picture.

use glam::{Vec3, vec3};
use gsdf_nostd::{Bounds, BoxFrame, DoubleCone, Program, WideSolidAngle, valid};

macro_rules! shapes {
    ($($constant:ident: $shape:ident, $name:literal, $made:expr;)+) => {
        $(
            #[doc = concat!("A ", $name, ": [`", stringify!($shape), "`].")]
            pub const $constant: $shape = valid!($made);
        )+

        /// The names, in the order of the list.
        pub const NAMES: [&str; [$($name),+].len()] = [$($name),+];

        /// The programs, in the order of [`NAMES`].
        pub static PROGRAMS: [Program<'static>; NAMES.len()] = [$(const { &$constant.program() }.program()),+];

        /// Boxes around them, where they are bounded, in the order of [`NAMES`].
        #[must_use]
        pub fn bounds() -> [Option<Bounds>; NAMES.len()] {
            [$($constant.bounds()),+]
        }
    };
}

// As the solids of one leaf: about one unit in size, faces, edges and tips at multiples of a quarter where they can be.
shapes! {
    DOUBLE_CONE: DoubleCone, "double cone", DoubleCone::new(Vec3::ZERO, Vec3::Y, 0.5, 1.0);
    BOX_FRAME: BoxFrame, "box frame", BoxFrame::new(Vec3::splat(-0.75), Vec3::splat(0.75), 0.25);
    WIDE_SOLID_ANGLE: WideSolidAngle, "wide solid angle", WideSolidAngle::new(Vec3::ZERO, vec3(0.48, -0.6, 0.64), 1.0, 1.0, -0.75);
}
