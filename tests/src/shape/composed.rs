//! The solids that are programs of several leaves, with random numbers, and beside each the same solid in exact
//! arithmetic, by definition, and with a surface to search.

use super::closest::to_triangles;
use super::holds::cylindrical;
use super::polyhedron::in_triangle;
use super::profile::{Piece, sector, to_pieces};
use super::{across, log_uniform, unit};
use crate::reference::{Exact, ExactVec3, Expr};
use glam::{DVec2, DVec3, Vec3};
use rand::{Rng, RngExt};

/// The parameters of a solid that is a program.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of the constructors' parameters")]
pub enum Composed {
    BoxFrame {
        min: Vec3,
        max: Vec3,
        thickness: f32,
    },
    DoubleCone {
        apex: Vec3,
        axis: Vec3,
        radius: f32,
        height: f32,
    },
    WideSolidAngle {
        apex: Vec3,
        axis: Vec3,
        reach: f32,
        radius: f32,
        height: f32,
    },
}

/// The kinds, in the order of [`Composed`]'s variants.
pub const COMPOSED: [&str; 3] = ["box frame", "double cone", "wide solid angle"];

/// Farther than any test looks.
const FAR: f64 = 1e9;

impl Composed {
    /// A random solid of the given kind, about `size` large, within four sizes of the origin.
    pub fn random<R: Rng>(rng: &mut R, kind: usize, size: f64) -> Self {
        let length = |rng: &mut R| (size * log_uniform(rng, 0.1, 2.0)) as f32;
        let point = (unit(rng) * size * rng.random_range(0.0..4.0)).as_vec3();
        let axis = if rng.random_range(0..3) == 0 {
            Vec3::Y
        } else {
            unit(rng).as_vec3()
        };
        match kind {
            0 => {
                let size = Vec3::new(length(rng), length(rng), length(rng));
                Self::BoxFrame {
                    min: point,
                    max: point + size,
                    thickness: size.min_element() * rng.random_range(0.02..0.45),
                }
            }
            1 => Self::DoubleCone {
                apex: point,
                axis,
                radius: length(rng),
                height: length(rng),
            },
            _ => Self::WideSolidAngle {
                apex: point,
                axis,
                reach: length(rng),
                radius: length(rng),
                // One in four is a hemisphere.
                height: if rng.random_range(0..4) == 0 { 0.0 } else { -length(rng) },
            },
        }
    }

    /// The extent of the solid's numbers.
    #[must_use]
    pub fn extent(&self) -> f64 {
        match *self {
            Self::BoxFrame { min, max, .. } => min.as_dvec3().length().max(max.as_dvec3().length()),
            Self::DoubleCone { apex, .. } => apex.as_dvec3().length(),
            Self::WideSolidAngle { apex, reach, .. } => apex.as_dvec3().length() + f64::from(reach),
        }
    }

    /// The solid in exact arithmetic, with its surface moved outward by `offset`: every face by itself.
    #[must_use]
    pub fn exact(&self, offset: f64) -> Expr {
        let moved = |point: Vec3, axis: Vec3, by: f64| &ExactVec3::from(point) + &ExactVec3::from(axis).times(&Exact::from(by));
        // A nappe whose side is moved outward: by more at the tip.
        let nappe = |apex: Vec3, axis: Vec3, radius: f32, height: f32, offset: f64| {
            let (rise, run) = (Exact::from(radius), Exact::from(height));
            let slant = (rise.square() + run.square()).sqrt(400);
            let shift = -(&Exact::from(offset) * &slant).quotient(&rise, 400);
            let tip = &ExactVec3::from(apex) + &ExactVec3::from(axis).times(&shift);
            Expr::nappe(tip, axis, rise, run)
        };
        match *self {
            Self::BoxFrame { min, max, thickness } => {
                let thickness = Exact::from(thickness) + Exact::from(2.0 * offset);
                if thickness.sign().is_le() {
                    return Expr::Or(Vec::new());
                }
                Expr::box_frame(&moved(min, Vec3::ONE, -offset), &moved(max, Vec3::ONE, offset), &thickness)
            }
            Self::DoubleCone {
                apex,
                axis,
                radius,
                height,
            } => nappe(apex, axis, radius, height, offset).or(nappe(apex, -axis, radius, height, offset)),
            Self::WideSolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let ball = Expr::sphere(apex, Exact::from(reach) + Exact::from(offset));
                if height == 0.0 {
                    ball.and(Expr::half_space(moved(apex, axis, -offset), -axis))
                } else {
                    ball.minus(nappe(apex, -axis, radius, -height, -offset))
                }
            }
        }
    }

    /// Whether a point is inside, by definition and up to the rounding of double precision.
    #[must_use]
    pub fn holds(&self, p: DVec3) -> bool {
        match *self {
            Self::BoxFrame { min, max, thickness } => {
                // How far within the faces, axis by axis: an edge of the box is near two of them.
                let depth = (p - min.as_dvec3()).min(max.as_dvec3() - p).to_array();
                let near = depth.iter().filter(|&&depth| depth < f64::from(thickness)).count();
                depth.iter().all(|&depth| depth > 0.0) && near >= 2
            }
            Self::DoubleCone {
                apex,
                axis,
                radius,
                height,
            } => {
                let (along, across) = cylindrical(p - apex.as_dvec3(), axis);
                across.atan2(along.abs()) < f64::from(radius).atan2(height.into())
            }
            Self::WideSolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let w = p - apex.as_dvec3();
                let (along, across) = cylindrical(w, axis);
                w.length() < f64::from(reach) && across.atan2(along) < f64::from(radius).atan2(height.into())
            }
        }
    }

    /// The two profiles of a solid of revolution, with where it is and its axis.
    fn profile(&self) -> Option<(Vec3, Vec3, Vec<Piece>)> {
        match *self {
            Self::BoxFrame { .. } => None,
            Self::DoubleCone {
                apex,
                axis,
                radius,
                height,
            } => {
                let rim = DVec2::new(radius.into(), height.into()).normalize() * FAR;
                let pieces = [rim, rim * DVec2::new(1.0, -1.0)].map(|rim| Piece::Segment(DVec2::ZERO, rim));
                Some((apex, axis, pieces.into()))
            }
            Self::WideSolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let pieces = sector(reach.into(), f64::from(radius).atan2(height.into()));
                Some((apex, axis, pieces.into()))
            }
        }
    }

    /// The faces of a box frame as triangles, with their outward normals.
    fn faces(&self) -> Vec<([DVec3; 3], DVec3)> {
        let Self::BoxFrame { min, max, thickness } = *self else {
            return Vec::new();
        };
        let (min, max, thickness) = (min.as_dvec3(), max.as_dvec3(), f64::from(thickness));
        let mut faces = Vec::new();
        let mut push = |axis: usize, at: f64, outward: f64, low: DVec2, high: DVec2| {
            let corner = |u: f64, v: f64| {
                let mut corner = DVec3::ZERO;
                (corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3]) = (at, u, v);
                corner
            };
            let mut normal = DVec3::ZERO;
            normal[axis] = outward;
            let corners = [
                corner(low.x, low.y),
                corner(high.x, low.y),
                corner(high.x, high.y),
                corner(low.x, high.y),
            ];
            faces.push(([corners[0], corners[1], corners[2]], normal));
            faces.push(([corners[0], corners[2], corners[3]], normal));
        };
        for axis in 0..3 {
            let section = |p: DVec3| DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3]);
            let (low, high) = (section(min), section(max));
            let (inner_low, inner_high) = (low + thickness, high - thickness);
            let ring = [
                (low, DVec2::new(high.x, inner_low.y)),
                (DVec2::new(low.x, inner_high.y), high),
                (DVec2::new(low.x, inner_low.y), DVec2::new(inner_low.x, inner_high.y)),
                (DVec2::new(inner_high.x, inner_low.y), DVec2::new(high.x, inner_high.y)),
            ];
            for (at, outward) in [(min[axis], -1.0), (max[axis], 1.0)] {
                for (from, to) in ring {
                    push(axis, at, outward, from, to);
                }
            }
            // The inner sides: those of the beams along the two other axes.
            for (at, outward) in [(min[axis] + thickness, 1.0), (max[axis] - thickness, -1.0)] {
                for (from, to) in [(low.x, inner_low.x), (inner_high.x, high.x)] {
                    push(axis, at, outward, DVec2::new(from, inner_low.y), DVec2::new(to, inner_high.y));
                }
                for (from, to) in [(low.y, inner_low.y), (inner_high.y, high.y)] {
                    push(axis, at, outward, DVec2::new(inner_low.x, from), DVec2::new(inner_high.x, to));
                }
            }
        }
        faces
    }

    /// How far a point is from the nearest of the surface.
    #[must_use]
    pub fn to_surface(&self, p: DVec3) -> f64 {
        if let Some((origin, axis, pieces)) = self.profile() {
            let (along, across) = cylindrical(p - origin.as_dvec3(), axis);
            return to_pieces(DVec2::new(across, along), &pieces);
        }
        let triangles: Vec<_> = self.faces().into_iter().map(|(triangle, _)| triangle).collect();
        to_triangles(p, &triangles)
    }

    /// A point of the surface and the outward normal there.
    pub fn surface<R: Rng>(&self, rng: &mut R) -> (DVec3, DVec3) {
        let share = |rng: &mut R| rng.random_range(0.0_f64..1.0);
        match *self {
            Self::BoxFrame { .. } => {
                let faces = self.faces();
                let (triangle, normal) = faces[rng.random_range(0..faces.len())];
                (in_triangle(rng, triangle), normal)
            }
            Self::DoubleCone {
                apex,
                axis,
                radius,
                height,
            } => {
                let axis = axis.as_dvec3().normalize() * if rng.random() { 1.0 } else { -1.0 };
                let around = across(rng, axis);
                let (radius, height) = (f64::from(radius), f64::from(height));
                let normal = (around * height - axis * radius).normalize();
                (apex.as_dvec3() + (axis * height + around * radius) * 3.0 * share(rng), normal)
            }
            Self::WideSolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let (axis, reach) = (axis.as_dvec3().normalize(), f64::from(reach));
                let around = across(rng, axis);
                let (sin, cos) = f64::from(radius).atan2(f64::from(height)).sin_cos();
                if rng.random() {
                    let rim = around * sin + axis * cos;
                    (apex.as_dvec3() + rim * reach * share(rng), around * cos - axis * sin)
                } else {
                    let up = rng.random_range(cos..=1.0);
                    let normal = around * (1.0 - up * up).max(0.0).sqrt() + axis * up;
                    (apex.as_dvec3() + normal * reach, normal)
                }
            }
        }
    }

    /// A point of an edge, a corner, a tip or a rim.
    pub fn edge_point<R: Rng>(&self, rng: &mut R) -> DVec3 {
        match *self {
            Self::BoxFrame { .. } => {
                let faces = self.faces();
                let number = rng.random_range(0..faces.len());
                let corners = faces[number].0;
                // Two triangles make a rectangle: away from its diagonal, the corner in the middle of the first and at
                // the end of the second.
                let (from, to) = if number % 2 == 0 { (1, 0) } else { (2, 1) };
                super::polyhedron::between(rng, corners[from], corners[to])
            }
            Self::DoubleCone { apex, .. } => apex.as_dvec3(),
            Self::WideSolidAngle { apex, .. } if rng.random_range(0..4) == 0 => apex.as_dvec3(),
            Self::WideSolidAngle {
                apex,
                axis,
                reach,
                radius,
                height,
            } => {
                let axis = axis.as_dvec3().normalize();
                let (sin, cos) = f64::from(radius).atan2(f64::from(height)).sin_cos();
                apex.as_dvec3() + (axis * cos + across(rng, axis) * sin) * f64::from(reach)
            }
        }
    }
}
