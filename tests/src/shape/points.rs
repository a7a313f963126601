//! Points of solids: on the surface, at its edges, within.

use super::polyhedron::between;
use super::{Shape, across, unit};
use glam::{DVec3, Vec3};
use rand::{Rng, RngExt};

impl Shape {
    /// A point of the surface and the outward normal there; faces are about equally likely.
    pub fn surface<R: Rng>(&self, rng: &mut R) -> (DVec3, DVec3) {
        let reach = |rng: &mut R| rng.random_range(-3.0_f64..3.0);
        let share = |rng: &mut R| rng.random_range(0.0_f64..1.0);
        // A point between two discs: on one of them (first = normal of the first), or on the side between.
        let turned = |rng: &mut R, from: Vec3, to: Vec3, first: f64, last: f64| {
            let (from, to) = (from.as_dvec3(), to.as_dvec3());
            let axis = (to - from).normalize();
            let around = across(rng, axis);
            let height = (to - from).length();
            match rng.random_range(0..4) {
                0 if first > 0.0 => (from + around * first * share(rng).sqrt(), -axis),
                1 if last > 0.0 => (to + around * last * share(rng).sqrt(), axis),
                _ => {
                    let up = share(rng);
                    let normal = (around * height - axis * (last - first)).normalize();
                    (from + axis * height * up + around * (first + (last - first) * up), normal)
                }
            }
        };
        if let Some(polyhedron) = self.polyhedron() {
            return polyhedron.surface(rng);
        }
        if let Some(facet) = self.facet() {
            return facet.surface(rng);
        }
        match *self {
            Self::HalfSpace { point, normal } => {
                let normal = normal.as_dvec3();
                let size = point.as_dvec3().length() + 1e-3;
                (point.as_dvec3() + across(rng, normal) * size * reach(rng), normal)
            }
            Self::Sphere { center, radius } => {
                let normal = unit(rng);
                (center.as_dvec3() + normal * f64::from(radius), normal)
            }
            Self::Cylinder { point, axis, radius } => {
                let around = across(rng, axis.as_dvec3());
                let foot = point.as_dvec3() + axis.as_dvec3() * f64::from(radius) * reach(rng);
                (foot + around * f64::from(radius), around)
            }
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => {
                let base = apex.as_dvec3() + axis.as_dvec3() * f64::from(height);
                let around = across(rng, axis.as_dvec3());
                let rim = base + around * f64::from(radius);
                let normal = (around * f64::from(height) - axis.as_dvec3() * f64::from(radius)).normalize();
                (apex.as_dvec3().lerp(rim, 3.0 * share(rng)), normal)
            }
            Self::Cuboid { min, max } => {
                let mut at = DVec3::new(share(rng), share(rng), share(rng));
                let mut normal = DVec3::ZERO;
                let (face, side) = (rng.random_range(0..3), rng.random_range(0..2));
                at[face] = f64::from(side);
                normal[face] = f64::from(2 * side - 1);
                (min.as_dvec3() + at * (max.as_dvec3() - min.as_dvec3()), normal)
            }
            Self::CappedCylinder { bottom, top, radius, .. } => turned(rng, bottom, top, radius.into(), radius.into()),
            Self::Cone { apex, base, radius, .. } => turned(rng, apex, base, 0.0, radius.into()),
            Self::CappedCone {
                bottom,
                top,
                bottom_radius,
                top_radius,
                ..
            } => turned(rng, bottom, top, bottom_radius.into(), top_radius.into()),
            Self::Capsule { a, b, radius } => {
                let (a, b) = (a.as_dvec3(), b.as_dvec3());
                let axis = (b - a).normalize();
                let normal = if rng.random_range(0..2) == 0 {
                    unit(rng)
                } else {
                    across(rng, axis)
                };
                let along = normal.dot(axis);
                let foot = if along.abs() < 1e-9 {
                    a.lerp(b, share(rng))
                } else if along < 0.0 {
                    a
                } else {
                    b
                };
                (foot + normal * f64::from(radius), normal)
            }
            Self::RoundedCone { a, b, a_radius, b_radius } => {
                let (a, b, [a_radius, b_radius]) = (a.as_dvec3(), b.as_dvec3(), [a_radius, b_radius].map(f64::from));
                let axis = b - a;
                // Along the axis, the normals of the side have the sine by which the radii differ.
                let sine = (a_radius - b_radius) / axis.length();
                let axis = axis.normalize();
                let side = across(rng, axis) * (1.0 - sine * sine).sqrt() + axis * sine;
                let normal = if rng.random_range(0..2) == 0 { unit(rng) } else { side };
                let along = normal.dot(axis) - sine;
                let up = if along.abs() < 1e-9 {
                    share(rng)
                } else {
                    f64::from(u8::from(along > 0.0))
                };
                (a.lerp(b, up) + normal * (a_radius + (b_radius - a_radius) * up), normal)
            }
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let (apex, axis, reach) = (apex.as_dvec3(), axis.as_dvec3(), f64::from(reach));
                let (sin, cos) = f64::from(radius).atan2(f64::from(height)).sin_cos();
                let around = across(rng, axis);
                if rng.random_range(0..2) == 0 {
                    let rim = around * sin + axis * cos;
                    (apex + rim * reach * share(rng), around * cos - axis * sin)
                } else {
                    let up = rng.random_range(cos..=1.0);
                    let normal = around * (1.0 - up * up).max(0.0).sqrt() + axis * up;
                    (apex + normal * reach, normal)
                }
            }
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } => {
                let [x, z, rounding] = [half_x, half_z, rounding].map(f64::from);
                let height = f64::from(top) - f64::from(bottom.y);
                let corners = [DVec3::X * x, DVec3::Z * z, DVec3::NEG_X * x, DVec3::NEG_Z * z];
                let corner = rng.random_range(0..4);
                let (from, to) = (corners[corner], corners[(corner + 1) % 4]);
                let outward = |from: DVec3, to: DVec3| DVec3::Y.cross(to - from).normalize();
                let before = outward(corners[(corner + 3) % 4], from);
                let (foot, normal) = if rng.random_range(0..2) == 0 {
                    (from.lerp(to, share(rng)), outward(from, to))
                } else {
                    (from, before.lerp(outward(from, to), share(rng)).normalize())
                };
                let rim = foot + normal * rounding;
                let bottom = bottom.as_dvec3();
                match rng.random_range(0..4) {
                    0 => (bottom + rim * share(rng).sqrt(), DVec3::NEG_Y),
                    1 => (bottom + rim * share(rng).sqrt() + DVec3::Y * height, DVec3::Y),
                    _ => (bottom + rim + DVec3::Y * height * share(rng), normal),
                }
            }
            Self::HexagonalPrism { .. }
            | Self::TriangularPrism { .. }
            | Self::Octahedron { .. }
            | Self::Pyramid { .. }
            | Self::Triangle { .. }
            | Self::Quad { .. } => unreachable!("taken for a polyhedron or a facet above"),
        }
    }

    /// A point inside, not near the surface as a rule.
    pub fn interior(&self, rng: &mut impl Rng) -> DVec3 {
        // From a surface point inward to the far side, by exact membership, and back to somewhere between.
        let (surface, normal) = self.surface(rng);
        let solid = self.exact(0.0);
        let (from, inward) = (surface.to_array(), (-normal).to_array());
        let spans = solid.along(from, inward).spans();
        let depth = spans.iter().map(|(_, exit)| exit.to_f64()).fold(0.0, f64::max);
        let most = 2.0 * self.extent() + 1e-3;
        surface - normal * depth.min(most) * rng.random_range(0.05..0.95)
    }

    /// A point of an edge, a rim, a corner, a tip or a seam, where there is one; else of the surface.
    pub fn edge_point<R: Rng>(&self, rng: &mut R) -> DVec3 {
        if let Some(polyhedron) = self.polyhedron() {
            return polyhedron.edge_point(rng);
        }
        if let Some(facet) = self.facet() {
            return facet.edge_point(rng);
        }
        let second = rng.random_range(0..2) == 0;
        let around = |rng: &mut R, center: DVec3, radius: f64| center + across(rng, self.axis().as_dvec3()) * radius;
        match *self {
            Self::HalfSpace { .. } | Self::Sphere { .. } | Self::Cylinder { .. } => self.surface(rng).0,
            Self::Nappe { apex, .. } => apex.as_dvec3(),
            Self::Cuboid { min, max } => {
                let corner =
                    |rng: &mut R| DVec3::from_array(core::array::from_fn(|axis| f64::from([min, max][rng.random_range(0..2)][axis])));
                let (from, mut to) = (corner(rng), corner(rng));
                let along = rng.random_range(0..3);
                let other = to[along];
                to = from;
                to[along] = other;
                between(rng, from, to)
            }
            Self::CappedCylinder { bottom, top, radius, .. } => around(rng, if second { bottom } else { top }.as_dvec3(), radius.into()),
            Self::CappedCone {
                bottom,
                top,
                bottom_radius,
                top_radius,
                ..
            } => {
                let (center, radius) = if second { (bottom, bottom_radius) } else { (top, top_radius) };
                around(rng, center.as_dvec3(), radius.into())
            }
            Self::Cone { apex, .. } if rng.random_range(0..4) == 0 => apex.as_dvec3(),
            Self::Cone { base, radius, .. } => around(rng, base.as_dvec3(), radius.into()),
            Self::Capsule { a, b, radius } => around(rng, if second { a } else { b }.as_dvec3(), radius.into()),
            Self::RoundedCone { a, b, a_radius, b_radius } => {
                let axis = (b - a).as_dvec3();
                let sine = (f64::from(a_radius) - f64::from(b_radius)) / axis.length();
                let (center, radius) = if second { (a, a_radius) } else { (b, b_radius) };
                let radius = f64::from(radius);
                let seam = center.as_dvec3() + axis.normalize() * sine * radius;
                around(rng, seam, radius * (1.0 - sine * sine).sqrt())
            }
            Self::SolidAngle { apex, .. } if rng.random_range(0..4) == 0 => apex.as_dvec3(),
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let (sin, cos) = f64::from(radius).atan2(f64::from(height)).sin_cos();
                let reach = f64::from(reach);
                around(rng, apex.as_dvec3() + axis.as_dvec3() * reach * cos, reach * sin)
            }
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } => {
                let [x, z, rounding] = [half_x, half_z, rounding].map(f64::from);
                let corners = [DVec3::X * x, DVec3::Z * z, DVec3::NEG_X * x, DVec3::NEG_Z * z];
                let corner = rng.random_range(0..4);
                let (from, to) = (corners[corner], corners[(corner + 1) % 4]);
                // Where the flat side ends and the rounding begins, from the bottom to the top.
                let seam = bottom.with_y(0.0).as_dvec3() + from + DVec3::Y.cross(to - from).normalize() * rounding;
                let [low, high] = [bottom.y, top].map(|y| seam + DVec3::Y * f64::from(y));
                if second { between(rng, low, high) } else { between(rng, high, low) }
            }
            Self::HexagonalPrism { .. }
            | Self::TriangularPrism { .. }
            | Self::Octahedron { .. }
            | Self::Pyramid { .. }
            | Self::Triangle { .. }
            | Self::Quad { .. } => unreachable!("taken for a polyhedron or a facet above"),
        }
    }
}
