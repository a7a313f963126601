//! From statements to solids and how they are joined: transforms, colours, modifiers and what is empty.

use super::affine::Placement;
use super::arguments::Arguments;
use super::frames::Frames;
use super::refusal::Fault;
use super::solids::{Facets, Piece, Solids};
use super::syntax::Statement;
use crate::palette::from_srgb;
use glam::Vec3;

/// How operands are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    /// What is in any of them.
    Union,
    /// What is in all of them.
    Intersection,
    /// What is in the first and in none of the others.
    Difference,
}

/// A solid of a model: leaves, or others joined. Others are known by their numbers, which are less than its own.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A leaf.
    Leaf(Colored),
    /// Two or more others.
    Joined(Operator, Vec<usize>),
}

/// A leaf with what does not change where it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colored {
    /// The leaf.
    pub piece: Piece,
    /// Its colour, linear, if it has one.
    pub colour: Option<Vec3>,
    /// The byte of the text where its module stands.
    pub at: usize,
}

/// What a text describes.
#[derive(Debug)]
pub struct Evaluated {
    /// The solids, each after those that it is made of.
    pub shapes: Vec<Shape>,
    /// The number of the one that is the model; `None` where it is empty.
    pub root: Option<usize>,
    /// The frames of the leaves.
    pub frames: Frames,
    /// The statements that were left out because the library has no such solids.
    pub skipped: Vec<Fault>,
}

/// How a text is read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Reading {
    /// Where round solids get flat sides.
    pub facets: Facets,
    /// Whether what is not supported is left out.
    pub skip_unsupported: bool,
}

/// Modules of OpenSCAD that have no closed form here, or no volume.
const UNSUPPORTED: [&str; 14] = [
    "hull",
    "minkowski",
    "linear_extrude",
    "rotate_extrude",
    "text",
    "import",
    "projection",
    "offset",
    "surface",
    "resize",
    "square",
    "circle",
    "polygon",
    "roof",
];

const SUPPORTED: &str =
    "`cube`, `sphere`, `cylinder`, `polyhedron`, `union`, `difference`, `intersection`, `group`, `multmatrix`, `color` and `render` are";

/// A module whose children are being evaluated.
struct Scope {
    /// The index of the first statement beyond it.
    end: usize,
    operator: Operator,
    /// Where the children stand; `None` where they have no volume.
    placed: Option<Placement>,
    colour: Option<Vec3>,
    /// The solids of the children so far, with `None` for those that are empty.
    operands: Vec<Option<usize>>,
}

impl Scope {
    const fn world(end: usize) -> Self {
        Self {
            end,
            operator: Operator::Union,
            placed: Some(Placement::WORLD),
            colour: None,
            operands: Vec::new(),
        }
    }
}

/// The solids that statements describe.
///
/// # Errors
/// Where a module is not known or not supported, or its arguments are wrong.
pub fn evaluate(statements: &[Statement<'_>], reading: Reading) -> Result<Evaluated, Fault> {
    let mut evaluation = Evaluation {
        reading,
        solids: Solids::new(reading.facets),
        shapes: Vec::new(),
        skipped: Vec::new(),
    };
    // The first root, if there is one, is the model, as it is by itself.
    let is_root = |statement: &Statement<'_>| statement.modifiers.root && !statement.modifiers.left_out;
    let (mut index, end) = match statements.iter().position(is_root) {
        Some(root) => (root, statements.get(root).map_or(root, |statement| statement.end)),
        None => (0, statements.len()),
    };
    let mut open: Vec<Scope> = Vec::new();
    let mut scope = Scope::world(end);
    let root = loop {
        if index >= scope.end {
            let made = evaluation.joined(&scope);
            match open.pop() {
                Some(outer) => scope = outer,
                None => break made,
            }
            scope.operands.push(made);
            continue;
        }
        let Some(statement) = statements.get(index) else { break None };
        index += 1;
        if statement.modifiers.left_out {
            index = statement.end;
            continue;
        }
        match evaluation.enter(statement, &mut scope)? {
            Some(inner) => open.push(core::mem::replace(&mut scope, inner)),
            None => index = statement.end,
        }
    };
    Ok(Evaluated {
        shapes: evaluation.shapes,
        root,
        frames: evaluation.solids.into_frames(),
        skipped: evaluation.skipped,
    })
}

struct Evaluation {
    reading: Reading,
    solids: Solids,
    shapes: Vec<Shape>,
    skipped: Vec<Fault>,
}

impl Evaluation {
    /// Evaluates a statement in a scope, or begins with it: then what is returned is the scope of its children.
    fn enter(&mut self, statement: &Statement<'_>, scope: &mut Scope) -> Result<Option<Scope>, Fault> {
        let arguments = |names: &'static [&'static str]| Arguments::of(statement, names);
        let inner = Scope {
            end: statement.end,
            operator: Operator::Union,
            placed: scope.placed,
            colour: scope.colour,
            operands: Vec::new(),
        };
        let within = |inner: Scope, names| arguments(names).map(|_| Some(inner));
        match statement.name {
            "group" | "union" => within(inner, &[]),
            "render" => within(inner, &["convexity"]),
            "intersection" => within(
                Scope {
                    operator: Operator::Intersection,
                    ..inner
                },
                &[],
            ),
            "difference" => within(
                Scope {
                    operator: Operator::Difference,
                    ..inner
                },
                &[],
            ),
            "multmatrix" => {
                let matrix = arguments(&["m"])?.matrix("m")?;
                Ok(Some(Scope {
                    placed: scope.placed.and_then(|placed| placed.then(&matrix)),
                    ..inner
                }))
            }
            "color" => {
                let colour = arguments(&["c", "alpha"])?.colour("c")?;
                // Of nested colours the outermost counts. The channels are from 0 to 1, of sRGB.
                let linear = colour.map(|colour| from_srgb(colour.map(|channel| (255.0 * channel.min(1.0)).round() as u8)));
                Ok(Some(Scope {
                    colour: scope.colour.or(linear),
                    ..inner
                }))
            }
            "cube" => self.solid(&arguments(&["size", "center"])?, scope, Solids::cube),
            "sphere" => self.solid(&arguments(&["r"])?, scope, Solids::sphere),
            "cylinder" => self.solid(&arguments(&["h", "r1", "r2", "center"])?, scope, Solids::cylinder),
            "polyhedron" => self.solid(&arguments(&["points", "faces"])?, scope, Solids::polyhedron),
            name if UNSUPPORTED.contains(&name) => self.skip(statement, scope),
            name => Err(Fault::new(
                statement.at,
                format!("`{name}`, which is no module of a .csg file"),
                SUPPORTED,
            )),
        }
    }

    /// Leaves out what is not supported, if that is allowed.
    fn skip(&mut self, statement: &Statement<'_>, scope: &mut Scope) -> Result<Option<Scope>, Fault> {
        let found = format!("`{}`, which is not supported", statement.name);
        let fault = Fault::new(statement.at, found, format!("{SUPPORTED}; --skip-unsupported leaves out all else"));
        if !self.reading.skip_unsupported {
            return Err(fault);
        }
        self.skipped.push(fault);
        // What is cut must not become what is cut from.
        if scope.operator == Operator::Difference && scope.operands.is_empty() {
            scope.operands.push(None);
        }
        Ok(None)
    }

    /// Adds the solid of a module to the operands of a scope.
    fn solid(
        &mut self,
        arguments: &Arguments<'_, '_>,
        scope: &mut Scope,
        make: fn(&mut Solids, &Arguments<'_, '_>, &Placement) -> Result<Vec<Piece>, Fault>,
    ) -> Result<Option<Scope>, Fault> {
        // What has no volume has arguments all the same.
        let pieces = make(&mut self.solids, arguments, &scope.placed.unwrap_or(Placement::WORLD))?;
        let pieces = if scope.placed.is_some() { pieces } else { Vec::new() };
        let at = arguments.statement().at;
        let colour = scope.colour;
        let leaf = |piece| self.push(Shape::Leaf(Colored { piece, colour, at }));
        let leaves: Vec<usize> = pieces.into_iter().map(leaf).collect();
        scope.operands.push(match leaves[..] {
            [] => None,
            [one] => Some(one),
            _ => Some(self.push(Shape::Joined(Operator::Intersection, leaves))),
        });
        Ok(None)
    }

    /// The operands of a scope as one solid; `None` where that is empty.
    fn joined(&mut self, scope: &Scope) -> Option<usize> {
        let operands = &scope.operands;
        let is_empty = match scope.operator {
            Operator::Union => false,
            Operator::Intersection => operands.contains(&None),
            Operator::Difference => operands.first() == Some(&None),
        };
        let solids: Vec<usize> = operands.iter().flatten().copied().collect();
        match solids[..] {
            _ if is_empty => None,
            [] => None,
            [one] => Some(one),
            _ => Some(self.push(Shape::Joined(scope.operator, solids))),
        }
    }

    fn push(&mut self, shape: Shape) -> usize {
        self.shapes.push(shape);
        self.shapes.len() - 1
    }
}
