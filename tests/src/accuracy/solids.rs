//! The solids of the table, as each corpus wants them.

use super::corpus::Corpus;
use crate::shape::{Shape, log_uniform, unit};
use glam::{DVec3, Vec3};
use rand::{Rng, RngExt};

/// A solid that the library may refuse, and about how large it is.
pub(super) fn solid<R: Rng>(rng: &mut R, leaf: usize, corpus: Corpus) -> (f64, Shape) {
    let (size, spread): (f64, f64) = match corpus {
        Corpus::Tiny => (log_uniform(rng, 2e-5, 1e-3), 4.0),
        Corpus::AboveHuge => (log_uniform(rng, 1e2, 1e6), 1.0),
        Corpus::Denormals => (log_uniform(rng, 0.1, 10.0), 0.3),
        Corpus::Limits => match rng.random_range(0..3) {
            // Near the largest coordinates, small and large, and near the least sizes.
            0 => (log_uniform(rng, 1e4, 1e6), 0.0),
            1 => (log_uniform(rng, 1e7, 1.5e8), 4.0),
            _ => (log_uniform(rng, 2e-6, 1e-5), 4.0),
        },
        _ => (log_uniform(rng, 0.1, 10.0), 4.0),
    };
    let shape = if leaf == 17 {
        flat_quad(rng, size)
    } else {
        Shape::random(rng, leaf, size, spread.max(1e-6))
    };
    if corpus == Corpus::Limits && spread == 0.0 {
        return (size, moved(shape, unit(rng) * 0.9e9));
    }
    if corpus == Corpus::Angles {
        return (size, with_angle(rng, shape));
    }
    (size, shape)
}

/// A quad whose corners are in a plane exactly: the reference has but one plane for it.
fn flat_quad<R: Rng>(rng: &mut R, size: f64) -> Shape {
    let unit_of_corners = (size / 64.0).log2().round().exp2() as f32;
    let mut steps = |most: i16| Vec3::from_array(core::array::from_fn(|_| rng.random_range(-most..=most).into()));
    let (point, first, second) = (steps(200), steps(63), steps(63));
    let mut share = || rng.random_range(1_i8..=4).into();
    let (third, fourth): (f32, f32) = (share(), share());
    let corners = [
        point,
        point + first * 2.0,
        point + first * 2.0 + second * third,
        point + second * fourth,
    ];
    Shape::Quad {
        corners: corners.map(|corner| corner * unit_of_corners),
    }
}

/// The shape moved, if it has but one point.
fn moved(shape: Shape, by: DVec3) -> Shape {
    let mut moved = shape;
    let by = by.as_vec3();
    match &mut moved {
        Shape::HalfSpace { point, .. } | Shape::Cylinder { point, .. } => *point += by,
        Shape::Sphere { center, .. } | Shape::Octahedron { center, .. } => *center += by,
        Shape::Nappe { apex, .. } | Shape::SolidAngle { apex, .. } => *apex += by,
        Shape::Cuboid { min: a, max: b } | Shape::Capsule { a, b, .. } | Shape::RoundedCone { a, b, .. } => {
            *a += by;
            *b += by;
        }
        Shape::CappedCylinder { bottom: a, top: b, .. }
        | Shape::CappedCone { bottom: a, top: b, .. }
        | Shape::Cone { apex: a, base: b, .. } => {
            *a += by;
            *b += by;
        }
        Shape::HexagonalPrism { bottom, top, .. } | Shape::TriangularPrism { bottom, top, .. } | Shape::Rhombus { bottom, top, .. } => {
            *bottom += by;
            *top += by.y;
        }
        Shape::Pyramid { base, .. } => *base += by,
        Shape::Triangle { corners } => corners.iter_mut().for_each(|corner| *corner += by),
        Shape::Quad { corners } => {
            // To multiples of the last place, so that the corners stay in a plane.
            let by = (by / 64.0).round() * 64.0;
            corners.iter_mut().for_each(|corner| *corner += by);
        }
    }
    moved
}

/// A cone with a half-angle near none or near a right one.
fn with_angle<R: Rng>(rng: &mut R, shape: Shape) -> Shape {
    let small = log_uniform(rng, 1e-4, core::f64::consts::FRAC_PI_4);
    let angle = if rng.random() {
        small
    } else {
        core::f64::consts::FRAC_PI_2 - small
    };
    let mut shape = shape;
    match &mut shape {
        Shape::Nappe { radius, height, .. } | Shape::SolidAngle { radius, height, .. } => {
            *radius = (f64::from(*height) * angle.tan()) as f32;
        }
        Shape::Cone { apex, base, radius, .. } => *radius = ((*apex - *base).as_dvec3().length() * angle.tan()) as f32,
        Shape::CappedCone {
            bottom,
            top,
            bottom_radius,
            top_radius,
            ..
        } => *top_radius = *bottom_radius + ((*top - *bottom).as_dvec3().length() * angle.tan()) as f32,
        Shape::RoundedCone { a, b, a_radius, b_radius } => {
            *b_radius = *a_radius + ((*b - *a).as_dvec3().length() * angle.sin()) as f32;
        }
        _ => {}
    }
    shape
}
