//! The distance to the nearest point of a surface, found on the surface: among triangles, among the pieces of a
//! profile.

use super::Shape;
use super::holds::{cylindrical, in_polygon, rhombus};
use super::polyhedron::Polyhedron;
use super::profile::{Piece, hull, sector, to_pieces};
use glam::{DVec2, DVec3, Vec3};

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

/// Farther than any test looks.
const FAR: f64 = 1e9;

/// The lines through points of a profile, one after the other.
fn through(points: &[DVec2]) -> Vec<Piece> {
    points.windows(2).map(|ends| Piece::Segment(ends[0], ends[1])).collect()
}

impl Shape {
    /// A solid of revolution: where its profile is drawn from, along which axis, and the profile; `None` for another.
    fn profile(&self) -> Option<(DVec3, DVec3, Vec<Piece>)> {
        let at = |across: f32, along: f64| DVec2::new(across.into(), along);
        let height = |low: Vec3, high: Vec3, axis: Vec3| cylindrical(high.as_dvec3() - low.as_dvec3(), axis).0;
        let beyond = |radius: f32, height: f32| DVec2::new(radius.into(), height.into()).normalize() * FAR;
        let quarter = core::f64::consts::FRAC_PI_2;
        let (origin, axis, pieces) = match *self {
            Self::HalfSpace { point, normal } => (point, normal, through(&[DVec2::ZERO, DVec2::X * FAR])),
            Self::Sphere { center, radius } => {
                let half = Piece::Arc(DVec2::ZERO, radius.into(), -quarter, quarter);
                (center, Vec3::Z, vec![half])
            }
            // Two pieces, that numbers near the point stay small.
            Self::Cylinder { point, axis, radius } => {
                let ends = [at(radius, -FAR), at(radius, 0.0), at(radius, FAR)];
                (
                    point,
                    axis,
                    vec![Piece::Segment(ends[1], ends[0]), Piece::Segment(ends[1], ends[2])],
                )
            }
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => (apex, axis, through(&[DVec2::ZERO, beyond(radius, height)])),
            Self::CappedCylinder { bottom, top, axis, radius } => {
                let height = height(bottom, top, axis);
                let around = [DVec2::ZERO, at(radius, 0.0), at(radius, height), at(0.0, height)];
                (bottom, axis, through(&around))
            }
            Self::Cone { apex, base, axis, radius } => {
                let height = height(apex, base, axis);
                (apex, axis, through(&[DVec2::ZERO, at(radius, height), at(0.0, height)]))
            }
            Self::CappedCone {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
            } => {
                let height = height(bottom, top, axis);
                let around = [DVec2::ZERO, at(bottom_radius, 0.0), at(top_radius, height), at(0.0, height)];
                (bottom, axis, through(&around))
            }
            Self::Capsule { a, b, radius } => return Some(between_balls(a, b, radius, radius)),
            Self::RoundedCone { a, b, a_radius, b_radius } => return Some(between_balls(a, b, a_radius, b_radius)),
            Self::SolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let pieces = sector(reach.into(), f64::from(radius).atan2(height.into()));
                (apex, axis, pieces.into())
            }
            _ => return None,
        };
        Some((origin.as_dvec3(), axis.as_dvec3(), pieces))
    }

    /// How far a point is from the nearest of the surface.
    ///
    /// # Panics
    /// For a kind that has neither faces nor a profile, of which there is none but the rhombus, which is searched here.
    #[must_use]
    pub fn to_surface(&self, p: DVec3) -> f64 {
        if let Some((origin, axis, pieces)) = self.profile() {
            let (along, across) = cylindrical(p - origin, axis);
            return to_pieces(DVec2::new(across, along), &pieces);
        }
        if let Some(facet) = self.facet() {
            return to_triangles(p, &facet.triangles());
        }
        match *self {
            Self::Cuboid { min, max } => to_triangles(p, &Polyhedron::cuboid(min, max).triangles()),
            Self::Rhombus {
                bottom,
                top,
                half_x,
                half_z,
                rounding,
            } if rounding > 0.0 => {
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
                walls.min(caps)
            }
            _ => to_triangles(p, &self.polyhedron().expect("a solid with flat faces").triangles()),
        }
    }
}

/// The hull of two balls as a solid of revolution, from the first centre towards the second.
fn between_balls(a: Vec3, b: Vec3, a_radius: f32, b_radius: f32) -> (DVec3, DVec3, Vec<Piece>) {
    let axis = b.as_dvec3() - a.as_dvec3();
    let pieces = hull(axis.length(), a_radius.into(), b_radius.into());
    (a.as_dvec3(), axis, pieces.into())
}
