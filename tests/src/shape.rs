//! Solids with random numbers: the library's leaf and, beside it, the same solid in exact arithmetic.

use crate::reference::{Exact, ExactVec3, Expr};
use core::f64::consts::TAU;
use glam::{DVec3, Vec3};
use gsdf_nostd::{CappedCone, CappedCylinder, Capsule, Cone, Cuboid, Cylinder, HalfSpace, Invalid, Leaf, Nappe, Sphere};
use rand::{Rng, RngExt};

/// The parameters of a leaf.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the names are those of the constructors' parameters")]
pub enum Shape {
    HalfSpace {
        point: Vec3,
        normal: Vec3,
    },
    Sphere {
        center: Vec3,
        radius: f32,
    },
    Cylinder {
        point: Vec3,
        axis: Vec3,
        radius: f32,
    },
    Nappe {
        apex: Vec3,
        axis: Vec3,
        radius: f32,
        height: f32,
    },
    Cuboid {
        min: Vec3,
        max: Vec3,
    },
    CappedCylinder {
        bottom: Vec3,
        top: Vec3,
        axis: Vec3,
        radius: f32,
    },
    Cone {
        apex: Vec3,
        base: Vec3,
        axis: Vec3,
        radius: f32,
    },
    CappedCone {
        bottom: Vec3,
        top: Vec3,
        axis: Vec3,
        bottom_radius: f32,
        top_radius: f32,
    },
    Capsule {
        a: Vec3,
        b: Vec3,
        radius: f32,
    },
}

/// The kinds of leaves, in the order of [`Shape`]'s variants.
pub const KINDS: [&str; 9] = [
    "half-space",
    "sphere",
    "cylinder",
    "nappe",
    "cuboid",
    "capped cylinder",
    "cone",
    "capped cone",
    "capsule",
];

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
            _ => Self::Capsule {
                a: point,
                b: point + (unit(rng) * f64::from(length(rng))).as_vec3(),
                radius,
            },
        }
    }

    /// The library's leaf.
    ///
    /// # Errors
    /// Where the library refuses the parameters.
    pub fn leaf(&self) -> Result<Leaf, Invalid> {
        Ok(match *self {
            Self::HalfSpace { point, normal } => HalfSpace::new(point, normal)?.into(),
            Self::Sphere { center, radius } => Sphere::new(center, radius)?.into(),
            Self::Cylinder { point, axis, radius } => Cylinder::new(point, axis, radius)?.into(),
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => Nappe::new(apex, axis, radius, height)?.into(),
            Self::Cuboid { min, max } => Cuboid::new(min, max)?.into(),
            Self::CappedCylinder { bottom, top, axis, radius } => CappedCylinder::new(bottom, top, axis, radius)?.into(),
            Self::Cone { apex, base, axis, radius } => Cone::new(apex, base, axis, radius)?.into(),
            Self::CappedCone {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
            } => CappedCone::new(bottom, top, axis, bottom_radius, top_radius)?.into(),
            Self::Capsule { a, b, radius } => Capsule::new(a, b, radius)?.into(),
        })
    }

    /// The same solid in exact arithmetic, with its surface moved outward by `offset` (inward where negative).
    ///
    /// Edges and tips stay sharp: every face moves by itself.
    #[must_use]
    pub fn exact(&self, offset: f64) -> Expr {
        let grown = |radius: f32| Exact::from(radius) + Exact::from(offset);
        let moved = |point: Vec3, axis: Vec3, by: &Exact| &ExactVec3::from(point) + &ExactVec3::from(axis).times(by);
        let (out, back) = (Exact::from(offset), Exact::from(-offset));
        // How far a cone's tip moves along its axis when its side moves by the offset: offset √(s² + k²) / s.
        let tip_shift = |rise: &Exact, run: &Exact| {
            let slant = (rise.square() + run.square()).sqrt(200);
            -(&Exact::from(offset) * &slant).quotient(rise, 200)
        };
        let height = |from: Vec3, to: Vec3, axis: Vec3| (&ExactVec3::from(to) - &ExactVec3::from(from)).dot(&axis.into());
        let nothing = || Expr::Or(Vec::new());
        let sizes = self.sizes();
        if sizes.iter().any(|&size| f64::from(size) + offset <= 0.0) {
            return nothing();
        }
        match *self {
            Self::HalfSpace { point, normal } => Expr::half_space(moved(point, normal, &out), normal),
            Self::Sphere { center, radius } => Expr::sphere(center, grown(radius)),
            Self::Cylinder { point, axis, radius } => Expr::cylinder(point, axis, grown(radius)),
            Self::Nappe {
                apex,
                axis,
                radius,
                height,
            } => {
                let (rise, run) = (Exact::from(radius), Exact::from(height));
                Expr::nappe(moved(apex, axis, &tip_shift(&rise, &run)), axis, rise, run)
            }
            Self::Cuboid { min, max } => Expr::cuboid(moved(min, Vec3::ONE, &back), moved(max, Vec3::ONE, &out)),
            Self::CappedCylinder { bottom, top, axis, radius } => {
                Expr::capped_cylinder(moved(bottom, axis, &back), moved(top, axis, &out), axis, grown(radius))
            }
            Self::Cone { apex, base, axis, radius } => {
                let (rise, run) = (Exact::from(radius), height(apex, base, axis));
                let tip = moved(apex, axis, &tip_shift(&rise, &run));
                Expr::cone(tip, moved(base, axis, &out), axis, rise, run)
            }
            Self::CappedCone {
                bottom,
                top,
                axis,
                bottom_radius,
                top_radius,
            } => {
                let rise = Exact::from(top_radius) - Exact::from(bottom_radius);
                let run = height(bottom, top, axis);
                let slant = (rise.square() + run.square()).sqrt(200);
                // The side moves by the offset, and the bottom, where its radius is measured, too.
                let widened = Exact::from(bottom_radius) + (&Exact::from(offset) * &(&slant - &rise)).quotient(&run, 200);
                if widened.sign().is_lt() {
                    return nothing();
                }
                Expr::capped_cone(moved(bottom, axis, &back), moved(top, axis, &out), axis, widened, rise, run)
            }
            Self::Capsule { a, b, radius } => Expr::capsule(a, b, grown(radius)),
        }
    }

    /// The radii.
    fn sizes(&self) -> Vec<f32> {
        match *self {
            Self::HalfSpace { .. } | Self::Nappe { .. } | Self::Cuboid { .. } => Vec::new(),
            Self::Sphere { radius, .. }
            | Self::Cylinder { radius, .. }
            | Self::CappedCylinder { radius, .. }
            | Self::Cone { radius, .. }
            | Self::Capsule { radius, .. } => vec![radius],
            Self::CappedCone {
                bottom_radius, top_radius, ..
            } => vec![bottom_radius, top_radius],
        }
    }

    /// The points the solid is defined by.
    fn points(&self) -> Vec<Vec3> {
        match *self {
            Self::HalfSpace { point, .. } | Self::Cylinder { point, .. } => vec![point],
            Self::Sphere { center, .. } => vec![center],
            Self::Nappe { apex, .. } => vec![apex],
            Self::Cuboid { min, max } => vec![min, max],
            Self::CappedCylinder { bottom, top, .. } | Self::CappedCone { bottom, top, .. } => vec![bottom, top],
            Self::Cone { apex, base, .. } => vec![apex, base],
            Self::Capsule { a, b, .. } => vec![a, b],
        }
    }

    /// The extent of the solid's numbers: its farthest point of definition and its largest size.
    #[must_use]
    pub fn extent(&self) -> f64 {
        let farthest = self.points().iter().map(|point| point.as_dvec3().length()).fold(0.0, f64::max);
        farthest + self.sizes().iter().map(|&size| f64::from(size)).fold(0.0, f64::max)
    }

    /// The axis, or the normal of a face.
    #[must_use]
    pub fn axis(&self) -> Vec3 {
        match *self {
            Self::HalfSpace { normal, .. } => normal,
            Self::Sphere { .. } | Self::Cuboid { .. } => Vec3::Z,
            Self::Cylinder { axis, .. }
            | Self::Nappe { axis, .. }
            | Self::CappedCylinder { axis, .. }
            | Self::Cone { axis, .. }
            | Self::CappedCone { axis, .. } => axis,
            Self::Capsule { a, b, .. } => (b - a).normalize(),
        }
    }

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
}
