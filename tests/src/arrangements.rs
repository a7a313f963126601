//! Solids that touch, stand on each other or are cut from each other and share a face, in numbers that are no binary
//! ones; and rays at what they share.

use crate::poses::Tree;
use crate::shape::{Shape, across, unit};
use glam::{DVec3, Vec3};
use rand::RngExt;
use rand_pcg::Pcg64;

/// Where a ray goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// From outside through the shared face, well within it.
    Through,
    /// Through the shared face, straight across.
    Along,
    /// At an edge or a rim.
    Edge,
    /// From anywhere to anywhere.
    Random,
    /// From the shared face itself, or as near as `f32` comes.
    Inside,
}

/// The solids of an arrangement, and the face that two of them share.
pub struct Arrangement {
    /// The solids.
    pub tree: Tree,
    /// The middle of a disc that lies within the shared face, in the frame.
    pub center: Vec3,
    /// The normal of the face.
    pub normal: Vec3,
    /// The radius of the disc.
    pub reach: f32,
    /// Whether the faces cancel, so that a ray through the disc crosses nothing there.
    pub open: bool,
}

/// The kinds of arrangements.
pub const ARRANGEMENTS: [&str; 8] = [
    "box on box",
    "cylinder on box",
    "cylinder on cylinder",
    "pocket",
    "drilled plate",
    "plugged plate",
    "solids flush with each other",
    "tower",
];

/// A whole number of tenths, which hardly ever is a binary number.
pub fn tenths(rng: &mut Pcg64, least: i32, most: i32) -> f32 {
    rng.random_range(least..=most) as f32 * 0.1
}

/// The point with these coordinates along `axis` and along the two axes after it.
fn at(axis: usize, along: f32, u: f32, v: f32) -> Vec3 {
    let mut point = Vec3::ZERO;
    point[axis] = along;
    point[(axis + 1) % 3] = u;
    point[(axis + 2) % 3] = v;
    point
}

impl Arrangement {
    /// A random arrangement of the given kind.
    pub fn random(rng: &mut Pcg64, kind: usize) -> Self {
        let axis = rng.random_range(0..3);
        let (low, u, v) = (tenths(rng, -30, 30), tenths(rng, -30, 30), tenths(rng, -30, 30));
        let (middle, high) = (low + tenths(rng, 2, 20), low + 2.1 + tenths(rng, 2, 20));
        let radius = tenths(rng, 2, 10);
        let wide = radius + tenths(rng, 1, 10);
        // A box over a square with a corner at u, v, and a cylinder around its middle; either way up.
        let block = |from: f32, to: f32, side: f32| {
            Tree::from(Shape::Cuboid {
                min: at(axis, from, u, v),
                max: at(axis, to, u + side, v + side),
            })
        };
        let (cu, cv) = (u + wide, v + wide);
        let upright = rng.random_range(0..2) == 0;
        let rod = |from: f32, to: f32, radius: f32| {
            let (low, high) = (at(axis, from, cu, cv), at(axis, to, cu, cv));
            let (bottom, top, sign) = if upright { (low, high, 1.0) } else { (high, low, -1.0) };
            Tree::from(Shape::CappedCylinder {
                bottom,
                top,
                axis: at(axis, sign, 0.0, 0.0),
                radius,
            })
        };
        let inner = radius.min(wide) * 0.99;
        let on_axis = |along: f32| (at(axis, along, cu, cv), at(axis, 1.0, 0.0, 0.0));
        let (tree, (center, normal), reach, open) = match kind {
            0 => {
                let offset = tenths(rng, 0, 1);
                let upper = Shape::Cuboid {
                    min: at(axis, middle, u + offset, v - offset),
                    max: at(axis, high, u + 2.0 * wide, v + 2.0 * radius),
                };
                let shared = (at(axis, middle, u + radius, v + radius), at(axis, 1.0, 0.0, 0.0));
                (block(low, middle, 2.0 * wide).or(upper), shared, radius - 0.1, true)
            }
            1 => (
                block(low, middle, 2.0 * wide).or(rod(middle, high, radius)),
                on_axis(middle),
                inner,
                true,
            ),
            2 => {
                let upper = if rng.random_range(0..3) == 0 { radius } else { wide };
                (rod(low, middle, radius).or(rod(middle, high, upper)), on_axis(middle), inner, true)
            }
            3 => {
                let pocket = Shape::Cuboid {
                    min: at(axis, middle, u + 0.1, v + 0.1),
                    max: at(axis, high, u + 2.0 * wide - 0.1, v + 2.0 * wide - 0.1),
                };
                (block(low, high, 2.0 * wide).minus(pocket), on_axis(high), wide - 0.15, true)
            }
            4 => {
                let mouth = if rng.random_range(0..2) == 0 { low } else { high };
                (
                    block(low, high, 2.0 * wide).minus(rod(low, high, radius)),
                    on_axis(mouth),
                    inner,
                    true,
                )
            }
            5 => {
                let plug = if rng.random_range(0..2) == 0 { radius } else { radius - 0.1 };
                let plate = block(low, high, 2.0 * wide).minus(rod(low, high, radius));
                (plate.or(rod(low, high, plug)), on_axis(high), plug * 0.99, false)
            }
            6 => {
                // Both have the same face at the same place, so that the crossing is the first one's.
                let (block, rod) = (block(low, high, 2.0 * wide), rod(low, high, radius));
                let tree = match rng.random_range(0..3) {
                    0 => block.or(rod),
                    1 => rod.or(block),
                    _ => block.and(rod),
                };
                (tree, on_axis(high), inner, false)
            }
            _ => return Self::tower(rng),
        };
        Self {
            tree,
            center,
            normal,
            reach,
            open,
        }
    }

    /// A cylinder, a frustum and a cone on one oblique axis: caps are one plane because position and axis are, not
    /// because an axis is a coordinate's.
    fn tower(rng: &mut Pcg64) -> Self {
        let axis = unit(rng).as_vec3().normalize();
        let foot = Vec3::new(tenths(rng, -30, 30), tenths(rng, -30, 30), tenths(rng, -30, 30));
        let first = foot + axis * tenths(rng, 2, 20);
        let second = first + axis * tenths(rng, 2, 20);
        let tip = second + axis * tenths(rng, 2, 20);
        let (radius, waist, brim) = (tenths(rng, 2, 10), tenths(rng, 2, 10), tenths(rng, 2, 10));
        let shaft = Tree::from(Shape::CappedCylinder {
            bottom: foot,
            top: first,
            axis,
            radius,
        });
        let neck = Shape::CappedCone {
            bottom: first,
            top: second,
            axis,
            bottom_radius: radius,
            top_radius: waist,
        };
        let spire = Shape::Cone {
            apex: tip,
            base: second,
            axis: -axis,
            radius: brim,
        };
        let (center, reach) = if rng.random_range(0..2) == 0 {
            (first, radius)
        } else {
            (second, waist.min(brim))
        };
        Self {
            tree: shaft.or(neck).or(spire),
            center,
            normal: axis,
            reach: reach * 0.99,
            open: true,
        }
    }

    /// A point of the shared face, as a share of its reach from the middle.
    fn face_point(&self, rng: &mut Pcg64, share: f64) -> DVec3 {
        self.center.as_dvec3() + across(rng, self.normal.as_dvec3()) * f64::from(self.reach) * share
    }

    /// A point of an edge or a rim of one of the solids.
    fn edge_point(&self, rng: &mut Pcg64) -> DVec3 {
        let shapes = self.tree.shapes();
        let shape = shapes[rng.random_range(0..shapes.len())];
        let disc =
            |rng: &mut Pcg64, center: Vec3, radius: f32| center.as_dvec3() + across(rng, shape.axis().as_dvec3()) * f64::from(radius);
        let second = rng.random_range(0..2) == 0;
        match shape {
            Shape::Cuboid { min, max } => {
                let mut share = || {
                    DVec3::new(
                        f64::from(rng.random_range(0..2)),
                        f64::from(rng.random_range(0..2)),
                        f64::from(rng.random_range(0..2)),
                    )
                };
                let (from, to) = (share(), share());
                let corner = |share: DVec3| min.as_dvec3() + (max - min).as_dvec3() * share;
                // Along one coordinate, or at a corner.
                let along = rng.random_range(0..3);
                let mut point = corner(from);
                point[along] = point[along].midpoint(corner(to)[along]);
                point
            }
            Shape::CappedCylinder { bottom, top, radius, .. } => disc(rng, if second { top } else { bottom }, radius),
            Shape::CappedCone {
                bottom,
                top,
                bottom_radius,
                top_radius,
                ..
            } => {
                if second {
                    disc(rng, top, top_radius)
                } else {
                    disc(rng, bottom, bottom_radius)
                }
            }
            Shape::Cone { apex, base, radius, .. } => {
                if second {
                    apex.as_dvec3()
                } else {
                    disc(rng, base, radius)
                }
            }
            _ => self.face_point(rng, 1.0),
        }
    }

    /// A ray in the frame: where it starts and where it goes.
    pub fn ray(&self, rng: &mut Pcg64, aim: Aim) -> (DVec3, DVec3) {
        let distance = rng.random_range(0.5..20.0);
        let share = rng.random_range(0.0..0.9);
        let toward = |target: DVec3, direction: DVec3| (target - direction * distance, direction);
        match aim {
            Aim::Through => toward(self.face_point(rng, share), unit(rng)),
            Aim::Along => toward(
                self.face_point(rng, share),
                self.normal.as_dvec3() * f64::from(2 * rng.random_range(0..2) - 1),
            ),
            Aim::Edge => toward(self.edge_point(rng), unit(rng)),
            Aim::Random => (self.face_point(rng, share) + unit(rng) * distance * 0.25, unit(rng)),
            Aim::Inside => (self.face_point(rng, share), unit(rng)),
        }
    }
}

/// How far a point is from the nearest edge, rim or tip of a solid.
#[must_use]
pub fn distance_to_edges(shape: &Shape, p: DVec3) -> f64 {
    let rim = |center: Vec3, axis: Vec3, radius: f32| {
        let from = p - center.as_dvec3();
        let along = from.dot(axis.as_dvec3().normalize());
        let across = (from.length_squared() - along * along).max(0.0).sqrt();
        along.hypot(across - f64::from(radius))
    };
    match *shape {
        Shape::Cuboid { min, max } => {
            // On an edge two coordinates are those of faces: the second largest distance from a face's plane, if all
            // three are within the box.
            let nearer = (p - min.as_dvec3()).abs().min((p - max.as_dvec3()).abs());
            let beyond = (min.as_dvec3() - p).max(p - max.as_dvec3()).max(DVec3::ZERO).length();
            let largest = nearer.max_element();
            beyond.max(nearer.element_sum() - largest)
        }
        Shape::CappedCylinder { bottom, top, axis, radius } => rim(bottom, axis, radius).min(rim(top, axis, radius)),
        Shape::CappedCone {
            bottom,
            top,
            axis,
            bottom_radius,
            top_radius,
        } => rim(bottom, axis, bottom_radius).min(rim(top, axis, top_radius)),
        Shape::Cone { apex, base, axis, radius } => rim(base, axis, radius).min((p - apex.as_dvec3()).length()),
        _ => f64::INFINITY,
    }
}
