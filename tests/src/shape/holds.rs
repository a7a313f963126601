//! What it means to be inside, in double precision and from the definition of each solid: by angles, by corners of
//! sections, by balls that fill a hull. Nothing of it is in the library or in the exact reference.

use super::Shape;
use glam::{DVec2, DVec3, Vec3};

/// Whether a point of the plane is within a convex polygon: on the same side of all its edges.
pub(super) fn in_polygon(p: DVec2, corners: &[DVec2]) -> bool {
    let turns = |number: usize| {
        let (from, to) = (corners[number], corners[(number + 1) % corners.len()]);
        (to - from).perp_dot(p - from) > 0.0
    };
    (1..corners.len()).all(|number| turns(number) == turns(0))
}

/// The corners of a regular polygon, so far from the middle, the first at an angle.
fn regular(corners: u32, reach: f64, first: f64) -> Vec<DVec2> {
    let step = core::f64::consts::TAU / f64::from(corners);
    (0..corners)
        .map(|corner| DVec2::from_angle(first + step * f64::from(corner)) * reach)
        .collect()
}

/// The distance along an axis, and from it.
pub(super) fn cylindrical(p: DVec3, axis: impl Into<DVec3>) -> (f64, f64) {
    let axis = axis.into().normalize();
    (p.dot(axis), p.cross(axis).length())
}

/// The corners of a rhombus.
pub(super) fn rhombus(half_x: f32, half_z: f32) -> [DVec2; 4] {
    let (x, z) = (DVec2::X * f64::from(half_x), DVec2::Y * f64::from(half_z));
    [x, z, -x, -z]
}

/// How far a point of the plane is from a segment.
pub(super) fn to_segment(p: DVec2, from: DVec2, to: DVec2) -> f64 {
    let along = to - from;
    let share = ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    (p - from - along * share).length()
}

/// The least of a function with one minimum between 0 and 1, by thirds.
pub(super) fn least(value: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..120 {
        let (first, second) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if value(first) < value(second) {
            high = second;
        } else {
            low = first;
        }
    }
    value(low).min(value(0.0)).min(value(1.0))
}

impl Shape {
    /// Whether a point is inside, up to the rounding of double precision; never for a facet.
    #[must_use]
    pub fn holds(&self, p: DVec3) -> bool {
        let from = |point: Vec3| p - point.as_dvec3();
        let section = |bottom: Vec3| {
            let w = from(bottom);
            DVec2::new(w.x, w.z)
        };
        let level = |bottom: Vec3, top: f32| f64::from(bottom.y) < p.y && p.y < f64::from(top);
        let within = |low: Vec3, high: Vec3, axis: Vec3| cylindrical(from(low), axis).0 > 0.0 && cylindrical(from(high), axis).0 < 0.0;
        let angle = |apex: Vec3, axis: Vec3| {
            let (along, across) = cylindrical(from(apex), axis);
            across.atan2(along)
        };
        match *self {
            Self::HalfSpace { point, normal } => cylindrical(from(point), normal).0 < 0.0,
            Self::Sphere { center, radius } => from(center).length() < radius.into(),
            Self::Cylinder { point, axis, radius } => cylindrical(from(point), axis).1 < radius.into(),
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => angle(apex, axis) < f64::from(radius).atan2(height.into()),
            Self::Cuboid { min, max } => min.as_dvec3().cmplt(p).all() && p.cmplt(max.as_dvec3()).all(),
            Self::CappedCylinder { bottom, top, axis, radius } => {
                within(bottom, top, axis) && cylindrical(from(bottom), axis).1 < radius.into()
            }
            Self::Cone { apex, base, axis, radius } => {
                let height = cylindrical((base - apex).as_dvec3(), axis).0;
                within(apex, base, axis) && angle(apex, axis) < f64::from(radius).atan2(height)
            }
            Self::CappedCone {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
            } => {
                let (along, across) = cylindrical(from(bottom), axis);
                let share = along / cylindrical(top.as_dvec3() - bottom.as_dvec3(), axis).0;
                within(bottom, top, axis) && across < f64::from(bottom_radius) * (1.0 - share) + f64::from(top_radius) * share
            }
            Self::Capsule { a, b, radius } => {
                let axis = b.as_dvec3() - a.as_dvec3();
                least(|share| (from(a) - axis * share).length()) < radius.into()
            }
            Self::HexagonalPrism { bottom, top, apothem } => {
                let far = f64::from(apothem) / 30.0_f64.to_radians().cos();
                level(bottom, top) && in_polygon(section(bottom), &regular(6, far, 30.0_f64.to_radians()))
            }
            Self::TriangularPrism { bottom, top, inradius } => {
                level(bottom, top) && in_polygon(section(bottom), &regular(3, 2.0 * f64::from(inradius), 90.0_f64.to_radians()))
            }
            Self::Octahedron { center, radius } => from(center).abs().element_sum() < radius.into(),
            Self::Pyramid { base, half_width, height } => {
                let w = from(base);
                // The square section shrinks evenly towards the apex.
                let share = 1.0 - w.y / f64::from(height);
                w.y > 0.0 && w.x.abs().max(w.z.abs()) < f64::from(half_width) * share
            }
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } => {
                let (p, corners) = (section(bottom), rhombus(half_x, half_z));
                let near = |number: usize| to_segment(p, corners[number], corners[(number + 1) % 4]) < rounding.into();
                level(bottom, top) && (in_polygon(p, &corners) || (0..4).any(near))
            }
            Self::RoundedCone { a, b, a_radius, b_radius } => {
                let axis = b.as_dvec3() - a.as_dvec3();
                let [a_radius, b_radius] = [a_radius, b_radius].map(f64::from);
                least(|share| (from(a) - axis * share).length() - (a_radius + (b_radius - a_radius) * share)) < 0.0
            }
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => from(apex).length() < reach.into() && angle(apex, axis) < f64::from(radius).atan2(height.into()),
            Self::Triangle { .. } | Self::Quad { .. } => false,
        }
    }
}
