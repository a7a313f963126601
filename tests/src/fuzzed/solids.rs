//! Solids of every kind from raw bytes.

use super::raw::Raw;
use crate::shape::composed::Composed;
use crate::shape::{KINDS, Shape};
use glam::Vec3;

/// The second end of an axis: on it as a rule, or anywhere.
fn end(raw: &mut Raw<'_>, from: Vec3, axis: Vec3) -> Vec3 {
    if raw.below(8) == 0 {
        raw.vector()
    } else {
        from + axis * raw.size()
    }
}

/// A height above another: by a size as a rule, or any.
fn top(raw: &mut Raw<'_>, bottom: Vec3) -> f32 {
    if raw.below(8) == 0 { raw.number() } else { bottom.y + raw.size() }
}

/// Parameters of a leaf of any kind, which the library may refuse.
pub(super) fn shape(raw: &mut Raw<'_>) -> Shape {
    let kind = raw.below(KINDS.len() as u8);
    let point = raw.vector();
    match kind {
        0 => Shape::HalfSpace { point, normal: raw.unit() },
        1 => Shape::Sphere {
            center: point,
            radius: raw.size(),
        },
        2 => Shape::Cylinder {
            point,
            axis: raw.unit(),
            radius: raw.size(),
        },
        3 => Shape::Nappe {
            apex: point,
            axis: raw.unit(),
            radius: raw.size(),
            height: raw.size(),
        },
        4 => {
            let max = if raw.below(8) == 0 {
                raw.vector()
            } else {
                point + Vec3::new(raw.size(), raw.size(), raw.size())
            };
            Shape::Cuboid { min: point, max }
        }
        5 => {
            let axis = raw.unit();
            Shape::CappedCylinder {
                bottom: point,
                top: end(raw, point, axis),
                axis,
                radius: raw.size(),
            }
        }
        6 => {
            let axis = raw.unit();
            Shape::Cone {
                apex: point,
                base: end(raw, point, axis),
                axis,
                radius: raw.size(),
            }
        }
        7 => {
            let axis = raw.unit();
            Shape::CappedCone {
                bottom: point,
                top: end(raw, point, axis),
                axis,
                bottom_radius: raw.size(),
                top_radius: raw.size(),
            }
        }
        8 => Shape::Capsule {
            a: point,
            b: raw.vector(),
            radius: raw.size(),
        },
        9 => Shape::HexagonalPrism {
            bottom: point,
            top: top(raw, point),
            apothem: raw.size(),
        },
        10 => Shape::TriangularPrism {
            bottom: point,
            top: top(raw, point),
            inradius: raw.size(),
        },
        11 => Shape::Octahedron {
            center: point,
            radius: raw.size(),
        },
        12 => Shape::Pyramid {
            base: point,
            half_width: raw.size(),
            height: raw.size(),
        },
        13 => Shape::Rhombus {
            bottom: point,
            top: top(raw, point),
            half_x: raw.size(),
            half_z: raw.size(),
            rounding: raw.size(),
        },
        14 => Shape::RoundedCone {
            a: point,
            b: raw.vector(),
            a_radius: raw.size(),
            b_radius: raw.size(),
        },
        15 => Shape::SolidAngle {
            apex: point,
            axis: raw.unit(),
            reach: raw.size(),
            radius: raw.size(),
            height: raw.size(),
        },
        16 => Shape::Triangle {
            corners: [point, raw.vector(), raw.vector()],
        },
        _ => {
            let (b, d) = (raw.vector(), raw.vector());
            let c = if raw.below(4) == 0 { raw.vector() } else { b + (d - point) };
            Shape::Quad { corners: [point, b, c, d] }
        }
    }
}

/// Parameters of a solid that is a program, which the library may refuse.
pub(super) fn composed(raw: &mut Raw<'_>) -> Composed {
    let kind = raw.below(3);
    let point = raw.vector();
    match kind {
        0 => Composed::BoxFrame {
            min: point,
            max: point + Vec3::new(raw.size(), raw.size(), raw.size()),
            thickness: raw.size(),
        },
        1 => Composed::DoubleCone {
            apex: point,
            axis: raw.unit(),
            radius: raw.size(),
            height: raw.size(),
        },
        _ => Composed::WideSolidAngle {
            apex: point,
            axis: raw.unit(),
            reach: raw.size(),
            radius: raw.size(),
            height: -raw.size(),
        },
    }
}
