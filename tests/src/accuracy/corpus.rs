//! Where rays and solids of the table come from.

use super::solids::solid;
use super::trial::{Placed, Trial};
use crate::corpus::jittered;
use crate::poses::{random_affine, random_stretch};
use crate::shape::{KINDS, SOLIDS, Shape, across, log_uniform, unit};
use glam::{DMat3, DVec3, Vec3};
use gsdf_nostd::{Ray, Transform, Unit};
use rand::{Rng, RngExt};

macro_rules! corpora {
    ($($(#[doc = $doc:literal])+ $corpus:ident = $name:literal,)+) => {
        /// What rays and solids have in common.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Corpus {
            $($(#[doc = $doc])+ $corpus,)+
        }

        impl Corpus {
            /// All of them.
            pub const ALL: &[Self] = &[$(Self::$corpus,)+];

            /// The name it has in tables and on the command line.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$corpus => $name,)+
                }
            }
        }
    };
}

corpora! {
    /// From 1.5 to 110 sizes away.
    Moderate = "moderate",
    /// From within.
    Inside = "inside",
    /// From 1e3 to 1e7 sizes away.
    Far = "far",
    /// Solids of 2e-5 to 1e-3, from 1e-3 to 100 away.
    Tiny = "tiny",
    /// Beside the surface by 1e-14 to 1e-4 sizes, inside or outside, as far as `f32` allows.
    Grazing = "grazing",
    /// From a point of the surface, or one unit in the last place beside it.
    OnSurface = "on-surface",
    /// From 1e-3 to 1 above solids of 100 to 1e6.
    AboveHuge = "above-huge",
    /// 1e-8 to 1e-2 off the axis, a generatrix or a face.
    NearlyParallel = "nearly-parallel",
    /// Along the axis, a generatrix or a face, exactly.
    Parallel = "parallel",
    /// 1e-8 to 1e-2 sizes beside the apex, or through it.
    Apex = "apex",
    /// At an edge, a rim, a corner or a seam.
    Edge = "edge",
    /// Cones of half-angles from 1e-4 to a right angle less 1e-4.
    Angles = "angles",
    /// Directions 1e-3 to 1e3 long.
    Lengths = "lengths",
    /// Some components of the direction and of the origin are below the normal numbers.
    Denormals = "denormals",
    /// Coordinates and sizes near 2^30, sizes near 2^-20, directions near 2^40 and 2^-40.
    Limits = "limits",
    /// Components of the origin within 32 units in the last place of a point of the solid, those of the direction of
    /// one another.
    Close = "close",
    /// In frames that are turned, sheared, and scaled by up to 2^10 either way.
    Posed = "posed",
    /// In frames that are scaled by up to 2^20 either way, or sheared, or stretch some lengths 2^20 times as much as others.
    Stretched = "stretched",
    /// Scenes at 1e-30, at 1e30, and with coordinates to a quarter of the largest number, in a unit of their own, along
    /// directions as far out of range.
    Units = "units",
}

/// The kind of a name in [`KINDS`].
const fn kind(number: usize) -> &'static str {
    KINDS[number]
}

impl Corpus {
    /// The corpus of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|corpus| corpus.name() == name)
    }

    /// Why there are no such rays at this kind of leaf, if there are none.
    #[must_use]
    pub fn missing(self, leaf: usize) -> Option<&'static str> {
        const SMOOTH: [&str; 3] = [kind(0), kind(1), kind(2)];
        const TIPPED: [&str; 5] = [kind(3), kind(6), kind(11), kind(12), kind(15)];
        const CONICAL: [&str; 5] = [kind(3), kind(6), kind(7), kind(14), kind(15)];
        let name = KINDS[leaf];
        match self {
            Self::Inside if leaf >= SOLIDS => Some("has no inside"),
            Self::Inside if name == "half-space" => Some("holds the origin of every second ray of the other corpora"),
            Self::NearlyParallel | Self::Parallel if name == "sphere" => Some("has no straight line to be parallel to"),
            Self::Apex if !TIPPED.contains(&name) => Some("has no apex"),
            Self::Edge if SMOOTH.contains(&name) || name == "nappe" => Some("has no edge"),
            Self::Angles if !CONICAL.contains(&name) => Some("has no angle to vary"),
            _ => None,
        }
    }
}

/// A solid and places to aim at, for some dozens of rays.
#[derive(Clone, Debug)]
pub struct Target {
    corpus: Corpus,
    shape: Shape,
    /// The frame it stands in.
    pub pose: Option<Transform>,
    /// By what power of two the world is larger than the numbers it is drawn in, if it has a unit.
    scale: Option<i32>,
    size: f64,
    surface: Vec<(DVec3, DVec3)>,
    edges: Vec<DVec3>,
}

/// How many attempts are made at a solid or a ray that the library takes. What is drawn is nearly always in range.
const ATTEMPTS: usize = 10_000;

impl Target {
    /// A random solid of the kind with this number.
    ///
    /// # Panics
    /// Where ten thousand solids in succession are refused: then the corpus is wrong.
    pub fn random<R: Rng>(rng: &mut R, leaf: usize, corpus: Corpus) -> Self {
        for _ in 0..ATTEMPTS {
            let (size, shape) = solid(rng, leaf, corpus);
            if shape.leaf().is_ok() {
                let surface = (0..8).map(|_| shape.surface(rng)).collect();
                let edges = (0..4).map(|_| shape.edge_point(rng)).collect();
                let pose = match corpus {
                    Corpus::Posed => Some(random_affine(rng, 1000.0)),
                    Corpus::Stretched => Some(random_stretch(rng)),
                    _ => None,
                };
                // Moderate scenes reach to 2^11.
                let scale = (corpus == Corpus::Units).then(|| [-100, 100, 115][rng.random_range(0..3)]);
                return Self {
                    corpus,
                    shape,
                    pose,
                    scale,
                    size,
                    surface,
                    edges,
                };
            }
        }
        panic!("no {} of the corpus {} is valid", KINDS[leaf], corpus.name())
    }

    /// A random ray at it.
    ///
    /// # Panics
    /// Where ten thousand rays in succession are refused: then the corpus is wrong.
    pub fn ray<R: Rng>(&self, rng: &mut R) -> Trial {
        for _ in 0..ATTEMPTS {
            let (origin, direction) = self.line(rng);
            if Ray::new(origin, direction).is_ok() {
                let (origin, direction) = match self.scale {
                    Some(scale) => {
                        // As far out of range as the scene, or not at all.
                        let speed = rng.random_range(0..=scale.abs()) * scale.signum();
                        (origin * power(scale), direction * power(speed))
                    }
                    None => (origin, direction),
                };
                return Trial {
                    solid: self.solid(),
                    origin,
                    direction,
                };
            }
        }
        panic!("no ray of the corpus {} at {:?} is valid", self.corpus.name(), self.shape)
    }

    /// The solid, where it stands.
    #[must_use]
    pub fn solid(&self) -> Placed {
        let world = |scale: i32| self.shape.measured(|number| number * power(scale));
        Placed {
            shape: self.scale.map_or(self.shape, world),
            pose: self.pose,
            unit: self.scale.and_then(|scale| Unit::of(power(scale)).ok()),
        }
    }

    fn surface<R: Rng>(&self, rng: &mut R) -> (DVec3, DVec3) {
        self.surface[rng.random_range(0..self.surface.len())]
    }

    /// A point within: solids are convex, so between any of their points.
    fn interior<R: Rng>(&self, rng: &mut R) -> DVec3 {
        let mut within = self.surface(rng).0;
        for _ in 0..3 {
            within = within.lerp(self.surface(rng).0, rng.random_range(0.1..0.9));
        }
        within
    }

    fn line<R: Rng>(&self, rng: &mut R) -> (Vec3, Vec3) {
        let size = self.size;
        let length = log_uniform(rng, 0.5, 2.0);
        let distance = match self.corpus {
            Corpus::Far => size * log_uniform(rng, 1e3, 1e7),
            Corpus::Tiny => log_uniform(rng, 1e-3, 1e2),
            Corpus::Limits => size * log_uniform(rng, 0.5, 4.0),
            _ => size * log_uniform(rng, 1.5, 110.0),
        };
        let along = |point: DVec3, direction: DVec3| ((point - direction.normalize() * distance).as_vec3(), direction.as_vec3());
        match self.corpus {
            Corpus::Inside => (self.interior(rng).as_vec3(), (unit(rng) * length).as_vec3()),
            Corpus::Grazing => {
                let (point, normal) = self.surface(rng);
                let beside = size * log_uniform(rng, 1e-14, 1e-4) * if rng.random() { 1.0 } else { -1.0 };
                along(point + normal * beside, across(rng, normal) * length)
            }
            Corpus::OnSurface => {
                let point = self.surface(rng).0.as_vec3();
                let steps = rng.random_range(0..2);
                (jittered(rng, point, steps), (unit(rng) * length).as_vec3())
            }
            Corpus::AboveHuge => {
                let (point, normal) = self.surface(rng);
                let direction = if rng.random() {
                    unit(rng)
                } else {
                    across(rng, normal) - normal * log_uniform(rng, 1e-5, 1.0)
                };
                let above = normal * log_uniform(rng, 1e-3, 1.0);
                ((point + above).as_vec3(), (direction * length).as_vec3())
            }
            Corpus::NearlyParallel | Corpus::Parallel => self.parallel(rng, distance),
            Corpus::Apex | Corpus::Edge => {
                let tip = if self.corpus == Corpus::Apex {
                    self.apex(rng)
                } else {
                    self.edge(rng)
                };
                if rng.random_range(0..4) == 0 {
                    // In steps of so few digits that the ray goes through the very point, if that is one of `f32`.
                    let step = Vec3::from_array(core::array::from_fn(|_| rng.random_range(-64_i16..=64).into()));
                    let step = step * ((distance / 64.0).log2().round().exp2() as f32);
                    return (tip.as_vec3() - step, step);
                }
                let beside = unit(rng) * size * log_uniform(rng, 1e-8, 1e-2);
                let origin = (tip + unit(rng) * distance).as_vec3();
                (origin, ((tip + beside - origin.as_dvec3()).normalize() * length).as_vec3())
            }
            Corpus::Denormals => {
                let mut direction = unit(rng).as_vec3() * length as f32;
                let largest = direction.abs().max_position();
                for axis in (0..3).filter(|&axis| axis != largest) {
                    if rng.random() {
                        direction[axis] = f32::from_bits(rng.random_range(1..1 << 23)).copysign(direction[axis]);
                    }
                }
                let (mut origin, direction) = along(self.interior(rng), direction.as_dvec3());
                let axis = rng.random_range(0..6);
                if axis < 3 {
                    origin[axis] = f32::from_bits(rng.random_range(1..1 << 23));
                }
                (origin, direction)
            }
            Corpus::Close => {
                let point = if rng.random() { self.surface(rng).0 } else { self.edge(rng) };
                let mut origin = jittered(rng, point.as_vec3(), 32);
                let away = unit(rng) * distance;
                // Some coordinates stay close to those of the point, one at least does not.
                origin[rng.random_range(0..3)] += away.length() as f32;
                let component = length as f32;
                let direction = jittered(rng, Vec3::splat(component), 32);
                let signs = Vec3::from_array(core::array::from_fn(|_| if rng.random() { 1.0 } else { -1.0 }));
                if rng.random() {
                    (origin, direction * signs)
                } else {
                    along(point, (direction * signs).as_dvec3())
                }
            }
            Corpus::Posed | Corpus::Stretched => {
                let (origin, direction) = self.at(rng, distance, length);
                self.to_world(origin.as_dvec3(), direction.as_dvec3())
            }
            Corpus::Lengths => {
                let length = log_uniform(rng, 1e-3, 1e3);
                self.at(rng, distance, length)
            }
            Corpus::Limits => {
                let powers = [-39.9_f64, 0.0, 39.0];
                let length = powers[rng.random_range(0..3)].exp2();
                self.at(rng, distance, length)
            }
            Corpus::Moderate | Corpus::Far | Corpus::Tiny | Corpus::Angles | Corpus::Units => self.at(rng, distance, length),
        }
    }

    /// A ray from so far away: four in five at a point within, the others at one near the surface.
    fn at<R: Rng>(&self, rng: &mut R, distance: f64, length: f64) -> (Vec3, Vec3) {
        let target = if rng.random_range(0..5) == 0 {
            self.surface(rng).0 + unit(rng) * self.size * 0.2
        } else {
            self.interior(rng)
        };
        let origin = (target + unit(rng) * distance).as_vec3();
        (origin, ((target - origin.as_dvec3()).normalize() * length).as_vec3())
    }

    /// Along the axis, an exact generatrix, or a face; within, on or beside the solid.
    fn parallel<R: Rng>(&self, rng: &mut R, distance: f64) -> (Vec3, Vec3) {
        let (point, normal) = self.surface(rng);
        let axis = self.shape.axis().as_dvec3();
        let mut direction = match rng.random_range(0..3) {
            0 => axis,
            1 => {
                let generatrix = axis - normal * normal.dot(axis);
                if generatrix.length() > 1e-3 { generatrix.normalize() } else { axis }
            }
            _ => across(rng, normal),
        };
        if self.corpus == Corpus::NearlyParallel {
            direction += across(rng, direction) * log_uniform(rng, 1e-8, 1e-2);
        }
        let point = match rng.random_range(0..4) {
            0 => point,
            1 => point + normal * self.size * log_uniform(rng, 1e-7, 1.0),
            _ => self.interior(rng),
        };
        let direction = direction.as_vec3();
        ((point - direction.as_dvec3().normalize() * distance).as_vec3(), direction)
    }

    fn edge<R: Rng>(&self, rng: &mut R) -> DVec3 {
        self.edges[rng.random_range(0..self.edges.len())]
    }

    fn apex<R: Rng>(&self, rng: &mut R) -> DVec3 {
        match self.shape {
            Shape::Nappe { apex, .. } | Shape::Cone { apex, .. } | Shape::SolidAngle { apex, .. } => apex.as_dvec3(),
            Shape::Pyramid { base, height, .. } => base.as_dvec3() + DVec3::Y * f64::from(height),
            Shape::Octahedron { center, radius } => center.as_dvec3() + DVec3::AXES[rng.random_range(0..3)] * f64::from(radius),
            _ => self.edge(rng),
        }
    }

    /// A ray of the solid's frame, in the world.
    fn to_world(&self, origin: DVec3, direction: DVec3) -> (Vec3, Vec3) {
        let Some(pose) = &self.pose else {
            return (origin.as_vec3(), direction.as_vec3());
        };
        let matrix = matrix(pose);
        // Of the length that the direction had: a scale changes a place, and no speed.
        let turned = matrix * direction;
        (
            (matrix * origin + pose.origin().as_dvec3()).as_vec3(),
            (turned * (direction.length() / turned.length())).as_vec3(),
        )
    }
}

fn power(exponent: i32) -> f32 {
    2.0_f32.powi(exponent)
}

/// The matrix of a pose, from the frame to the world.
pub(super) fn matrix(pose: &Transform) -> DMat3 {
    let [x, y, z] = pose.to_local().map(Vec3::as_dvec3);
    DMat3::from_cols(x, y, z).transpose().inverse()
}
