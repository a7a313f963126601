//! Models: the `.csg` files of OpenSCAD, read into programs.
//!
//! - [`syntax`]: the statements of a text. [`arguments`]: what they are called with. [`refusal`]: what is wrong, and where.
//! - [`mod@evaluate`]: statements to solids and how they are joined. [`program`]: those to a program in postfix order.
//! - [`solids`]: OpenSCAD's modules to the leaves of the library; [`polytope`] and [`polyhedron`]: those with flat faces.
//! - [`affine`]: maps in double precision. [`frames`] and [`literals`]: the same map, or number, is the same everywhere.
//! - [`bounds`]: how far a model reaches.

pub mod affine;
pub mod arguments;
pub mod bounds;
pub mod evaluate;
pub mod frames;
pub mod literals;
pub mod polyhedron;
pub mod polytope;
pub mod program;
pub mod refusal;
pub mod solids;
pub mod syntax;

use anyhow::{Context, Result, anyhow};
use evaluate::{Evaluated, Reading, evaluate};
use glam::{Mat3, Vec3};
use gsdf_nostd::{Node, Program, ProgramError, Transform};
use refusal::{Fault, Refusal};
use std::fs;
use std::path::Path;

/// A model: a program that owns what it is made of, and what is known of its leaves.
#[derive(Clone, Debug)]
pub struct Model {
    nodes: Vec<Node>,
    poses: Vec<Transform>,
    matrices: Vec<Mat3>,
    leaves: Vec<Origin>,
    skipped: Vec<Refusal>,
}

/// Where a leaf comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Origin {
    /// Its colour, linear, if the model gives it one.
    pub colour: Option<Vec3>,
    /// The line of the file where it stands.
    pub line: usize,
}

impl Model {
    /// The model of a file.
    ///
    /// # Errors
    /// Where the file cannot be read, or is no model.
    pub fn load(path: &Path, reading: Reading) -> Result<Self> {
        let bytes = fs::read(path).with_context(|| format!("cannot read {}", path.display()))?;
        let text = core::str::from_utf8(&bytes).map_err(|error| {
            let good = String::from_utf8_lossy(bytes.get(..error.valid_up_to()).unwrap_or_default());
            Fault::new(
                good.len(),
                "bytes that are no text",
                "a model is text in UTF-8, as OpenSCAD writes with `-o model.csg`",
            )
            .in_text(&good)
        });
        let model = text.and_then(|text| Self::read(text, reading));
        model.map_err(|refusal| anyhow!("{}: {refusal}", path.display()))
    }

    /// The model of a text.
    ///
    /// # Errors
    /// Where it is no model.
    pub fn read(text: &str, reading: Reading) -> Result<Self, Refusal> {
        let evaluated = syntax::statements(text).and_then(|statements| evaluate(&statements, reading));
        let Evaluated {
            shapes,
            root,
            frames,
            skipped,
        } = evaluated.map_err(|fault| fault.in_text(text))?;
        let (nodes, leaves) = root.map(|root| program::postfix(&shapes, root)).unwrap_or_default();
        let lines: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
        let origin = |leaf: &evaluate::Colored| Origin {
            colour: leaf.colour,
            line: 1 + lines.partition_point(|newline| *newline < leaf.at),
        };
        let model = Self {
            leaves: leaves.iter().map(origin).collect(),
            nodes,
            poses: frames.poses().to_vec(),
            matrices: frames.matrices().to_vec(),
            skipped: skipped.into_iter().map(|fault| fault.in_text(text)).collect(),
        };
        match model.program() {
            Ok(_) | Err(ProgramError::Empty) => Ok(model),
            Err(error) => Err(Fault::new(0, "a model that is no program", error.to_string()).in_text(text)),
        }
    }

    /// The program, with its frames posed.
    ///
    /// # Errors
    /// Where the model is empty.
    pub fn program(&self) -> Result<Program<'_>, ProgramError> {
        Program::new(&self.nodes)?.posed(&self.poses)
    }

    /// The program, or that there is nothing to do.
    ///
    /// # Errors
    /// Where the model is empty.
    pub fn solid(&self) -> Result<Program<'_>> {
        self.program()
            .map_err(|_| anyhow!("the model is empty: it holds no solid that has a volume"))
    }

    /// The nodes of the program.
    #[must_use]
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// The matrices of the frames, which turn about the origin: frame 1 first.
    #[must_use]
    pub fn matrices(&self) -> &[Mat3] {
        &self.matrices
    }

    /// Where the leaves come from, in the order of their numbers.
    #[must_use]
    pub fn leaves(&self) -> &[Origin] {
        &self.leaves
    }

    /// What was left out.
    #[must_use]
    pub fn skipped(&self) -> &[Refusal] {
        &self.skipped
    }
}
