//! The solids of OpenSCAD as leaves: each module's arguments, and what of its placement goes into the numbers of a leaf.

use super::affine::{Placement, Vector};
use super::arguments::Arguments;
use super::frames::Frames;
use super::literals::Literals;
use super::polyhedron::convex;
use super::polytope::Polytope;
use super::refusal::Fault;
use core::f64::consts::TAU;
use glam::Vec3;
use gsdf_nostd::{CappedCone, CappedCylinder, Cone, Cuboid, HalfSpace, Invalid, Leaf, Sphere};

/// Where round solids become what OpenSCAD makes of them: solids with flat sides.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Facets {
    /// Cylinders and cones that were told to have up to 12 sides: those are meant to be prisms and pyramids
    #[default]
    Auto,
    /// Everything round
    Always,
    /// Nothing
    Never,
}

/// Up to how many sides a cylinder is meant to have them.
///
/// OpenSCAD has no other prisms, and one writes `$fn = 6` for a nut; but `$fn = 60` is the wish for something round. With
/// twelve sides the middle of a side is 3.4 % nearer to the axis than an edge, which is still seen; screws, knobs and
/// pencils have no more.
const MOST_SIDES: f64 = 12.0;

/// The most sides that something round may get.
const MOST_FACETS: f64 = 1000.0;

/// By how much two stretches may differ, relatively, and be one.
const SAME: f64 = 1e-9;

/// A solid of the library in a frame of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The solid.
    pub solid: Leaf,
    /// The number of its frame.
    pub frame: u16,
}

/// Makes leaves.
#[derive(Debug, Default)]
pub struct Solids {
    facets: Facets,
    literals: Literals,
    frames: Frames,
}

/// What is wrong, and what would do.
type Unplaced = [String; 2];

/// Solids whose common part a module is; none where it has no volume.
type Pieces = Result<Vec<Piece>, Unplaced>;

impl Solids {
    /// Makes leaves of round solids, or of solids with flat sides.
    #[must_use]
    pub fn new(facets: Facets) -> Self {
        Self {
            facets,
            ..Self::default()
        }
    }

    /// The frames that the leaves stand in.
    #[must_use]
    pub fn into_frames(self) -> Frames {
        self.frames
    }

    /// `cube`.
    ///
    /// # Errors
    /// Where its arguments are none of a cube's, or the library has no such box.
    pub fn cube(&mut self, arguments: &Arguments<'_, '_>, placed: &Placement) -> Result<Vec<Piece>, Fault> {
        let size = arguments.size("size")?;
        let low = if arguments.truth("center")? { size.map(|side| -0.5 * side) } else { [0.0; 3] };
        if size.iter().any(|side| *side <= 0.0) {
            return Ok(Vec::new());
        }
        let high = if arguments.truth("center")? { size.map(|side| 0.5 * side) } else { size };
        let ends = [placed.within.point(low), placed.within.point(high)];
        self.cuboid(ends, placed).map_err(|told| refused(arguments, told))
    }

    fn cuboid(&mut self, [a, b]: [Vector; 2], placed: &Placement) -> Pieces {
        let min = self.literals.vector(core::array::from_fn(|axis| a[axis].min(b[axis])));
        let max = self.literals.vector(core::array::from_fn(|axis| a[axis].max(b[axis])));
        self.piece(Cuboid::new(min, max), placed)
    }

    /// `sphere`.
    ///
    /// # Errors
    /// Where its arguments are none of a sphere's, or the library has no such sphere.
    pub fn sphere(&mut self, arguments: &Arguments<'_, '_>, placed: &Placement) -> Result<Vec<Piece>, Fault> {
        let radius = arguments.number("r", 1.0)?;
        let facets = self.facets(arguments, radius)?.filter(|_| self.facets == Facets::Always);
        if radius <= 0.0 {
            return Ok(Vec::new());
        }
        let made = match facets {
            Some(facets) => {
                let count = facets.div_ceil(2);
                let ring = |number: u32| {
                    let (sine, cosine) = (0.5 * TAU * (f64::from(number) + 0.5) / f64::from(count)).sin_cos();
                    [-radius * cosine, radius * sine]
                };
                self.polytope(&Polytope::turned(facets, &(0..count).map(ring).collect::<Vec<_>>()), placed)
            }
            None => self.ball(radius, placed),
        };
        made.map_err(|told| refused(arguments, told))
    }

    fn ball(&mut self, radius: f64, placed: &Placement) -> Pieces {
        let [x, y, z] = placed.stretches();
        if !is_same(x, y) || !is_same(x, z) {
            let placed = placed.stretched([1.0, y / x, z / x]);
            return self.ball_in_frame(radius, &placed);
        }
        match placed.similarity() {
            // A sphere turned is a sphere.
            Some(factor) => {
                let center = placed.frame.point(placed.within.translation);
                let (center, radius) = (self.literals.vector(center), self.literals.of(radius * x * factor));
                self.piece(Sphere::new(center, radius), &Placement::WORLD)
            }
            None => self.ball_in_frame(radius, placed),
        }
    }

    fn ball_in_frame(&mut self, radius: f64, placed: &Placement) -> Pieces {
        let center = self.literals.vector(placed.within.translation);
        let radius = self.literals.of(radius * placed.stretches()[0]);
        self.piece(Sphere::new(center, radius), placed)
    }

    /// `cylinder`: also a cone, a frustum, a prism or a pyramid.
    ///
    /// # Errors
    /// Where its arguments are none of a cylinder's, or the library has no such solid.
    pub fn cylinder(&mut self, arguments: &Arguments<'_, '_>, placed: &Placement) -> Result<Vec<Piece>, Fault> {
        let (height, lower, upper) = (arguments.number("h", 1.0)?, arguments.number("r1", 1.0)?, arguments.number("r2", 1.0)?);
        let bottom = if arguments.truth("center")? { -0.5 * height } else { 0.0 };
        let facets = self.facets(arguments, lower.max(upper))?;
        if height <= 0.0 || lower < 0.0 || upper < 0.0 || lower.max(upper) <= 0.0 {
            return Ok(Vec::new());
        }
        let ends = [[bottom, lower], [bottom + height, upper]];
        let made = match facets {
            Some(facets) => self.polytope(&Polytope::turned(facets, &ends), placed),
            None => self.round(ends, placed),
        };
        made.map_err(|told| refused(arguments, told))
    }

    /// The round solid between two discs about the z axis, each a height and a radius.
    fn round(&mut self, [lower, upper]: [[f64; 2]; 2], placed: &Placement) -> Pieces {
        let [x, y, _] = placed.stretches();
        let placed = if is_same(x, y) { *placed } else { placed.stretched([1.0, y / x, 1.0]) };
        let end = |[height, radius]: [f64; 2]| (placed.within.point([0.0, 0.0, height]), radius * placed.stretches()[0]);
        let mut ends = [end(lower), end(upper)];
        let along = placed.within.axes().map_or(2, |axes| axes[2]);
        // Turned over it is the same solid, and of two that share a cap both run the same way.
        if placed.within.linear[along][2] < 0.0 {
            ends.swap(0, 1);
        }
        let axis = Vec3::AXES[along];
        let [bottom, top] = ends.map(|(place, _)| self.literals.vector(place));
        let [lower, upper] = ends.map(|(_, radius)| self.literals.of(radius));
        if lower == upper {
            self.piece(CappedCylinder::new(bottom, top, axis, lower), &placed)
        } else if upper == 0.0 {
            self.piece(Cone::new(top, bottom, -axis, lower), &placed)
        } else if lower == 0.0 {
            self.piece(Cone::new(bottom, top, axis, upper), &placed)
        } else {
            self.piece(CappedCone::new(bottom, top, axis, lower, upper), &placed)
        }
    }

    /// `polyhedron`, which must be convex.
    ///
    /// # Errors
    /// Where its arguments are none of a polyhedron's, or it is not convex.
    pub fn polyhedron(&mut self, arguments: &Arguments<'_, '_>, placed: &Placement) -> Result<Vec<Piece>, Fault> {
        let points = arguments.points("points")?;
        let faces = arguments.faces("faces", points.len())?;
        let solid = convex(&points, &faces).map_err(|told| refused(arguments, told))?;
        let made = solid.map_or(Ok(Vec::new()), |solid| self.polytope(&solid, placed));
        made.map_err(|told| refused(arguments, told))
    }

    /// A solid with flat faces: a box of those that are across axes, cut by half-spaces.
    ///
    /// Sides that the box lacks are put beyond the solid, where no ray meets them: half-spaces alone have no bounds, by
    /// which rays that miss them could be told.
    fn polytope(&mut self, solid: &Polytope, placed: &Placement) -> Pieces {
        let solid = solid.mapped(&placed.within);
        let [low, high] = solid.bounds();
        /// How far beyond, as a part of the solid's size and of its distance from the origin.
        const BEYOND: [f64; 2] = [1e-2, 1e-5];
        let beyond = |axis: usize| BEYOND[0] * (high[axis] - low[axis]) + BEYOND[1] * low[axis].abs().max(high[axis].abs());
        let mut ends: [Vector; 2] = [
            core::array::from_fn(|axis| low[axis] - beyond(axis)),
            core::array::from_fn(|axis| high[axis] + beyond(axis)),
        ];
        let mut oblique = Vec::new();
        for plane in &solid.planes {
            match plane.axis() {
                Some((axis, upward)) => ends[usize::from(upward)][axis] = if upward { plane.height } else { -plane.height },
                None => oblique.push(plane),
            }
        }
        let mut pieces = self.cuboid(ends, placed)?;
        for plane in oblique {
            // The foot of the perpendicular from the origin: planes that coincide have the same one.
            let foot = self.literals.vector(plane.normal.map(|part| part * plane.height));
            let normal = self.literals.vector(plane.normal);
            pieces.extend(self.piece(HalfSpace::new(foot, normal), placed)?);
        }
        Ok(pieces)
    }

    /// The solid in the frame of its placement.
    fn piece<S: Into<Leaf>>(&mut self, solid: Result<S, Invalid>, placed: &Placement) -> Pieces {
        let solid = solid.map_err(|error| ["a solid out of range".to_owned(), error.to_string()])?.into();
        let frame = self.frames.number(&placed.frame)?;
        Ok(vec![Piece { solid, frame }])
    }

    /// Of how many sides something round is made; `None` where it is round.
    fn facets(&self, arguments: &Arguments<'_, '_>, radius: f64) -> Result<Option<u32>, Fault> {
        let wanted = arguments.number("$fn", 0.0)?;
        let (angle, size) = (arguments.number("$fa", 12.0)?, arguments.number("$fs", 2.0)?);
        let is_small = wanted > 0.0 && wanted <= MOST_SIDES;
        let facets = match self.facets {
            Facets::Never => return Ok(None),
            Facets::Auto if !is_small => return Ok(None),
            // As OpenSCAD counts them.
            _ if wanted > 0.0 => wanted.floor().max(3.0),
            _ => (360.0 / angle).min(TAU * radius / size).max(5.0).ceil(),
        };
        if facets <= MOST_FACETS {
            Ok(Some(facets as u32))
        } else {
            let told = [format!("{facets} facets"), format!("with --facets always there may be {MOST_FACETS}")];
            Err(refused(arguments, told))
        }
    }
}

fn is_same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs())
}

/// The fault of a statement, in the words of who found it.
fn refused(arguments: &Arguments<'_, '_>, [found, wanted]: Unplaced) -> Fault {
    let statement = arguments.statement();
    Fault::new(statement.at, format!("`{}`, {found}", statement.name), wanted)
}
