//! The distance to the nearest point of a surface, found on the surface: among triangles, among the pieces of a
//! profile.

use super::Shape;
use super::holds::{cylindrical, in_polygon, rhombus};
use super::profile::{Piece, hull, sector, to_pieces};
use glam::{DVec2, DVec3};

/// How far a point is from a triangle: from its plane where the foot is within, else from its edges.
fn to_triangle(p: DVec3, corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let sides = [(a, b), (b, c), (c, a)];
    if sides.iter().all(|&(from, to)| (to - from).cross(p - from).dot(normal) >= 0.0) {
        return ((p - a).dot(normal) / normal.length()).abs();
    }
    let to_side = |&(from, to): &(DVec3, DVec3)| {
        let along = to - from;
        let share = ((p - from).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        (p - from - along * share).length()
    };
    sides.iter().map(to_side).fold(f64::INFINITY, f64::min)
}

/// How far a point is from the nearest of some triangles.
#[must_use]
pub fn to_triangles(p: DVec3, triangles: &[[DVec3; 3]]) -> f64 {
    triangles
        .iter()
        .map(|&triangle| to_triangle(p, triangle))
        .fold(f64::INFINITY, f64::min)
}

impl Shape {
    /// How far a point is from the nearest of the surface; `None` for a solid whose surface is not searched here.
    #[must_use]
    pub fn to_surface(&self, p: DVec3) -> Option<f64> {
        if let Some(polyhedron) = self.polyhedron() {
            return Some(to_triangles(p, &polyhedron.triangles()));
        }
        if let Some(facet) = self.facet() {
            return Some(to_triangles(p, &facet.triangles()));
        }
        match *self {
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } => {
                let (w, corners) = (p - bottom.as_dvec3(), rhombus(half_x, half_z));
                let (height, w, rounding) = (f64::from(top) - f64::from(bottom.y), DVec2::new(w.x, w.z), f64::from(rounding));
                let side = |number: usize| Piece::Segment(corners[number], corners[(number + 1) % 4]);
                let sharp = to_pieces(w, &[side(0), side(1), side(2), side(3)]);
                let outline = if in_polygon(w, &corners) { -sharp } else { sharp } - rounding;
                let low = p.y - f64::from(bottom.y);
                let beyond = (-low).max(low - height);
                // To the walls between the heights, or to the caps within the outline, or to the rim.
                let walls = outline.abs().hypot(beyond.max(0.0));
                let caps = low.abs().min((low - height).abs()).hypot(outline.max(0.0));
                Some(walls.min(caps))
            }
            Self::RoundedCone { a, b, a_radius, b_radius } => {
                let axis = b.as_dvec3() - a.as_dvec3();
                let w = p - a.as_dvec3();
                let along = w.dot(axis.normalize());
                let across = w.cross(axis.normalize()).length();
                let pieces = hull(axis.length(), a_radius.into(), b_radius.into());
                Some(to_pieces(DVec2::new(across, along), &pieces))
            }
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let (along, across) = cylindrical(p - apex.as_dvec3(), axis);
                let pieces = sector(reach.into(), f64::from(radius).atan2(height.into()));
                Some(to_pieces(DVec2::new(across, along), &pieces))
            }
            _ => None,
        }
    }
}
