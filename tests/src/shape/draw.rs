//! Solids with random numbers.

use super::Shape;
use core::f64::consts::TAU;
use glam::{DVec3, Vec3};
use rand::{Rng, RngExt};

/// A number from `low` to `high`, its logarithm evenly distributed.
pub fn log_uniform(rng: &mut impl Rng, low: f64, high: f64) -> f64 {
    rng.random_range(low.ln()..high.ln()).exp()
}

/// A unit vector, evenly distributed.
pub fn unit(rng: &mut impl Rng) -> DVec3 {
    let z: f64 = rng.random_range(-1.0..1.0);
    let angle = rng.random_range(0.0..TAU);
    let across = (1.0 - z * z).sqrt();
    DVec3::new(across * angle.cos(), across * angle.sin(), z)
}

/// A unit vector across `axis`.
pub fn across(rng: &mut impl Rng, axis: DVec3) -> DVec3 {
    let (u, v) = axis.normalize().any_orthonormal_pair();
    let angle = rng.random_range(0.0..TAU);
    u * angle.cos() + v * angle.sin()
}

/// An axis as a leaf takes it: one in three along a coordinate, the others anyhow.
fn axis(rng: &mut impl Rng) -> Vec3 {
    if rng.random_range(0..3) == 0 {
        let axes = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];
        axes[rng.random_range(0..6)]
    } else {
        unit(rng).as_vec3()
    }
}

impl Shape {
    /// A random solid of the given kind, about `size` large, within `spread` sizes of the origin.
    pub fn random<R: Rng>(rng: &mut R, kind: usize, size: f64, spread: f64) -> Self {
        let place = |rng: &mut R| (unit(rng) * size * rng.random_range(0.0..spread)).as_vec3();
        let length = |rng: &mut R| (size * log_uniform(rng, 0.1, 2.0)) as f32;
        let (point, axis, radius) = (place(rng), axis(rng), length(rng));
        let other = point + axis * length(rng);
        // One prism in four is thin.
        let top = |rng: &mut R| point.y + length(rng) * if rng.random_range(0..4) == 0 { 0.05 } else { 1.0 };
        let plane = |rng: &mut R| {
            let first = unit(rng) * f64::from(length(rng));
            (first, self::across(rng, first) * f64::from(length(rng)))
        };
        match kind {
            0 => Self::HalfSpace { point, normal: axis },
            1 => Self::Sphere { center: point, radius },
            2 => Self::Cylinder { point, axis, radius },
            3 => Self::Nappe {
                apex: point,
                axis,
                radius,
                height: length(rng),
            },
            4 => Self::Cuboid {
                min: point,
                max: point + Vec3::new(length(rng), length(rng), length(rng)),
            },
            5 => Self::CappedCylinder {
                bottom: point,
                top: other,
                axis,
                radius,
            },
            6 => Self::Cone {
                apex: point,
                base: other,
                axis,
                radius,
            },
            7 => Self::CappedCone {
                bottom: point,
                top: other,
                axis,
                bottom_radius: radius,
                top_radius: if rng.random_range(0..4) == 0 { radius } else { length(rng) },
            },
            8 => Self::Capsule {
                a: point,
                b: point + (unit(rng) * f64::from(length(rng))).as_vec3(),
                radius,
            },
            9 => Self::HexagonalPrism {
                bottom: point,
                top: top(rng),
                apothem: radius,
            },
            10 => Self::TriangularPrism {
                bottom: point,
                top: top(rng),
                inradius: radius,
            },
            11 => Self::Octahedron { center: point, radius },
            12 => Self::Pyramid {
                base: point,
                half_width: radius,
                height: length(rng),
            },
            13 => Self::Rhombus {
                bottom: point,
                top: top(rng),
                half_x: radius,
                half_z: length(rng),
                rounding: if rng.random() {
                    0.0
                } else {
                    length(rng) * log_uniform(rng, 0.02, 1.0) as f32
                },
            },
            14 => {
                let apart = length(rng);
                // The second radius is the first one, a few last places beside it, or anything that leaves a hull.
                let b_radius = match rng.random_range(0..4) {
                    0 => radius,
                    1 => radius * (1.0 + f32::EPSILON * f32::from(rng.random_range(-9_i8..=9))),
                    _ => radius + apart * rng.random_range(-0.95..0.95),
                };
                Self::RoundedCone {
                    a: point,
                    b: point + (unit(rng) * f64::from(apart)).as_vec3(),
                    a_radius: radius,
                    b_radius: if f64::from(b_radius) < 0.02 * size { radius } else { b_radius },
                }
            }
            15 => Self::SolidAngle {
                apex: point,
                axis,
                reach: length(rng),
                radius,
                height: length(rng),
            },
            16 => {
                let (first, second) = plane(rng);
                // One in three is a needle.
                let narrow = if rng.random_range(0..3) == 0 {
                    log_uniform(rng, 1e-3, 1.0)
                } else {
                    1.0
                };
                let second = first * rng.random_range(-0.2..1.2) + second * narrow;
                Self::Triangle {
                    corners: [point, point + first.as_vec3(), point + second.as_vec3()],
                }
            }
            _ => {
                let (first, second) = plane(rng);
                // Multiples of a step so coarse that every corner is a sum without rounding: four exactly in a plane.
                let step = 2.0_f64.powi(size.log2().floor() as i32 - 20);
                let whole = |vector: DVec3| (vector / step).round();
                let (point, first, quarter) = (whole(point.as_dvec3()), whole(first), whole(second / 4.0));
                let mut quarters = || quarter * f64::from(rng.random_range(2..=4));
                let corners = [point, point + first, point + first + quarters(), point + quarters()];
                Self::Quad {
                    corners: corners.map(|corner| (corner * step).as_vec3()),
                }
            }
        }
    }
}
