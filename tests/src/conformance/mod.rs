//! What every arithmetic and every leaf owes, as one suite each, generic over the type:
//! [`arithmetic_conformance!`](crate::arithmetic_conformance), [`leaf_conformance!`](crate::leaf_conformance) and
//! [`facet_conformance!`](crate::facet_conformance) make a
//! module of tests from it, one test per duty, so that a failure names type and duty.
//!
//! The suites ask through the public interface alone: a lane type or a leaf of one's own is held to the same duties as
//! the library's by one line.

pub mod arithmetic;
pub mod contracted;
pub mod lanes;
pub mod leaf;
pub mod octahedron;
pub mod packet;
pub mod specimen;
pub mod values;

/// The duties of an arithmetic as a module of tests. They hold trivially where the machine lacks its instructions.
///
/// ```
/// gsdf_tests::arithmetic_conformance!(double: f64);
/// ```
#[macro_export]
macro_rules! arithmetic_conformance {
    ($name:ident: $number:ty) => {
        mod $name {
            #[allow(unused_imports, reason = "where a type is primitive")]
            use super::*;

            $crate::conformance_tests! { arithmetic $number =>
                sums_differences_products_and_quotients_round_once
                square_roots_round_once
                signs_are_bits
                the_next_number_is_the_least_greater_one
                comparisons_are_false_with_nan
                minima_and_maxima_return_the_second_operand_on_ties_and_nan
                selection_goes_lane_by_lane
                constants_fill_every_lane
                masks_are_truth_values_lane_by_lane
            }
        }
    };
}

/// The duties of a leaf as a module of tests, over the solids a [`Specimen`](specimen::Specimen) generator makes of it.
///
/// ```
/// use gsdf_tests::conformance::octahedron::Octahedron;
///
/// gsdf_tests::leaf_conformance!(octahedron: Octahedron::specimen);
/// ```
#[macro_export]
macro_rules! leaf_conformance {
    ($name:ident: $generator:expr) => {
        mod $name {
            #[allow(unused_imports, reason = "where the generator is named in full")]
            use super::*;

            $crate::conformance_tests! { leaf $generator =>
                the_generator_aims
                spans_are_half_open_and_never_nan
                the_solid_is_convex
                both_distances_agree_on_what_is_inside
                distances_never_exceed_the_way_to_the_surface
                distances_change_no_faster_than_the_point
                normals_are_unit_and_outward
                faces_belong_to_places_and_not_to_rays
                bounds_hold_the_solid
                the_stages_are_one_formula
                lanes_are_the_scalar_bits
                grounded_origins_have_the_root_zero
            }
        }
    };
}

/// The duties of a leaf that is a piece of surface and has no inside: all but those that are about the inside.
#[macro_export]
macro_rules! facet_conformance {
    ($name:ident: $generator:expr) => {
        mod $name {
            #[allow(unused_imports, reason = "where the generator is named in full")]
            use super::*;

            $crate::conformance_tests! { leaf $generator =>
                spans_are_half_open_and_never_nan
                the_solid_is_convex
                both_distances_agree_on_what_is_inside
                distances_never_exceed_the_way_to_the_surface
                distances_change_no_faster_than_the_point
                normals_are_unit_and_outward
                faces_belong_to_places_and_not_to_rays
                bounds_hold_the_solid
                the_stages_are_one_formula
                lanes_are_the_scalar_bits
            }
        }
    };
}

/// One test per duty of a suite.
#[doc(hidden)]
#[macro_export]
macro_rules! conformance_tests {
    (arithmetic $number:ty => $($duty:ident)+) => {
        $(#[test] fn $duty() {
            if <$number as $crate::conformance::lanes::Lanes>::is_here() {
                $crate::conformance::arithmetic::$duty::<$number>();
            }
        })+
    };
    (leaf $generator:expr => $($duty:ident)+) => {
        $(#[test] fn $duty() { $crate::conformance::leaf::$duty($generator); })+
    };
}
