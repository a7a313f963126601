//! `gsdf export`: a model as source text, for programs that have no file system.

use super::{ModelFile, Settings};
use crate::model::Model;
use crate::output::{say_bytes, write_whole};
use anyhow::Result;
use clap::Args;
use core::fmt::Write;
use glam::Vec3;
use gsdf_nostd::{Leaf, Node};

/// What `gsdf export` is told.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct Export {
    /// Which model.
    #[command(flatten)]
    pub model: ModelFile,
    /// As Rust: `const` arrays and the program of them
    #[arg(long, required = true)]
    pub rust: bool,
}

impl Export {
    /// Writes it to a file, or to standard output.
    ///
    /// # Errors
    /// Where the model cannot be read or is empty, or the file cannot be written.
    pub fn run(&self, settings: &Settings) -> Result<()> {
        let model = self.model.load()?;
        model.solid()?;
        let name = self.model.path.file_name().unwrap_or_default().to_string_lossy();
        let text = rust(&model, &name);
        match &settings.out {
            Some(path) => write_whole(text.as_bytes(), path),
            None => say_bytes(text.as_bytes()).map(|_| ()),
        }
    }
}

/// The source text of a model. Numbers are written so that they read back to the same bits.
#[must_use]
pub fn rust(model: &Model, name: &str) -> String {
    let (nodes, matrices) = (model.nodes(), model.matrices());
    let mut text = format!(
        "//! The model `{name}`, written by `gsdf export --rust`.\n\
         //!\n\
         //! By itself this file is a crate without a standard library that depends on `gsdf-nostd` alone. Where it is a module,\n\
         //! the two attributes below can go.\n\
         #![allow(unused_attributes)]\n\
         #![no_std]\n\n\
         use gsdf_nostd::glam::{};\n\
         use gsdf_nostd::{{{}}};\n\n\
         /// The solids and operators, in postfix order.\n\
         pub static NODES: [Node; {}] = [\n",
        if matrices.is_empty() { "vec3" } else { "{Mat3, vec3}" },
        imports(nodes).join(", "),
        nodes.len()
    );
    let mut origins = model.leaves().iter();
    for node in nodes {
        // Writing to a text never fails.
        let _ = match node {
            Node::Leaf { solid, frame } => {
                let line = origins.next().map_or(0, |origin| origin.line);
                writeln!(
                    text,
                    "    // Line {line}.\n    Node::Leaf {{ solid: {}, frame: {frame} }},",
                    leaf(solid)
                )
            }
            Node::Union => writeln!(text, "    Node::Union,"),
            Node::Intersection => writeln!(text, "    Node::Intersection,"),
            Node::Difference => writeln!(text, "    Node::Difference,"),
            Node::Complement => writeln!(text, "    Node::Complement,"),
        };
    }
    text += "];\n\n/// Where the frames are that solids stand in, the first being frame 1.\n";
    let _ = writeln!(text, "pub static POSES: [Transform; {}] = [", matrices.len());
    for matrix in matrices {
        let [x, y, z] = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(vector);
        let _ = writeln!(
            text,
            "    valid!(Transform::affine(Mat3::from_cols({x}, {y}, {z}), vec3(0.0, 0.0, 0.0))),"
        );
    }
    text += "];\n\n\
        /// The model.\n\
        pub const MODEL: Program<'static> = match Program::new(&NODES) {\n    \
            Ok(program) => match program.posed(&POSES) {\n        \
                Ok(program) => program,\n        \
                Err(error) => panic!(\"{}\", error.message()),\n    \
            },\n    \
            Err(error) => panic!(\"{}\", error.message()),\n\
        };\n";
    text
}

/// What the source text names.
fn imports(nodes: &[Node]) -> Vec<&'static str> {
    let kind = |node: &Node| match node {
        Node::Leaf { solid, .. } => Some(kind(solid)),
        _ => None,
    };
    let mut names: Vec<_> = nodes
        .iter()
        .filter_map(kind)
        .chain(["Leaf", "Node", "Program", "Transform", "valid"])
        .collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// The type of a leaf.
const fn kind(leaf: &Leaf) -> &'static str {
    match leaf {
        Leaf::Cuboid(_) => "Cuboid",
        Leaf::Sphere(_) => "Sphere",
        Leaf::CappedCylinder(_) => "CappedCylinder",
        Leaf::Cone(_) => "Cone",
        Leaf::CappedCone(_) => "CappedCone",
        Leaf::HalfSpace(_) => "HalfSpace",
        // No module of OpenSCAD becomes another one.
        _ => "Leaf",
    }
}

/// A leaf as an expression.
fn leaf(leaf: &Leaf) -> String {
    match leaf {
        Leaf::Cuboid(solid) => made("Cuboid", &[vector(solid.min()), vector(solid.max())]),
        Leaf::Sphere(solid) => made("Sphere", &[vector(solid.center()), number(solid.radius())]),
        Leaf::CappedCylinder(solid) => {
            let side = solid.side();
            made(
                "CappedCylinder",
                &[
                    vector(solid.bottom()),
                    vector(solid.top()),
                    vector(side.axis()),
                    number(side.radius()),
                ],
            )
        }
        Leaf::Cone(solid) => made(
            "Cone",
            &[
                vector(solid.apex()),
                vector(solid.base()),
                vector(solid.axis()),
                number(solid.radius()),
            ],
        ),
        Leaf::CappedCone(solid) => made(
            "CappedCone",
            &[
                vector(solid.bottom()),
                vector(solid.top()),
                vector(solid.axis()),
                number(solid.bottom_radius()),
                number(solid.top_radius()),
            ],
        ),
        Leaf::HalfSpace(solid) => made("HalfSpace", &[vector(solid.point()), vector(solid.normal())]),
        // No module of OpenSCAD becomes another leaf.
        other => format!("compile_error!(\"{other:?} cannot be written\")"),
    }
}

fn made(kind: &str, parameters: &[String]) -> String {
    format!("Leaf::{kind}(valid!({kind}::new({})))", parameters.join(", "))
}

fn vector(vector: Vec3) -> String {
    let [x, y, z] = vector.to_array().map(number);
    format!("vec3({x}, {y}, {z})")
}

/// The shortest literal that is this number.
fn number(number: f32) -> String {
    format!("{number:?}")
}
