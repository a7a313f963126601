//! `gsdf info`: what a model is made of, and what it costs.

use super::ModelFile;
use crate::model::Model;
use crate::model::bounds::Reach;
use crate::model::program::stack_depth;
use crate::output::say;
use anyhow::Result;
use clap::Args;
use gsdf_nostd::{Leaf, Node, Transform};
use serde::Serialize;
use std::collections::BTreeMap;

/// What `gsdf info` is told.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct Info {
    /// Which model.
    #[command(flatten)]
    pub model: ModelFile,
    /// Tell it in JSON
    #[arg(long)]
    pub json: bool,
}

/// What is known of a model.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Facts {
    /// The leaves.
    pub leaves: usize,
    /// How many there are of each kind.
    pub kinds: BTreeMap<&'static str, usize>,
    /// The leaves and operators.
    pub nodes: usize,
    /// The frames that are not the world.
    pub frames: usize,
    /// The least coordinates and the greatest; nothing where it is empty or endless.
    pub bounds: Option<[[f32; 3]; 2]>,
    /// Whether it is empty.
    pub empty: bool,
    /// How many operands wait at most while the program runs, of the 32 that may.
    pub stack_depth: usize,
    /// The most sweeps that any ray takes to its first crossing.
    pub max_sweeps: usize,
    /// What the program takes as `const`.
    pub flash_bytes: usize,
    /// The statements that were left out.
    pub left_out: usize,
}

impl Facts {
    /// What is known of a model.
    #[must_use]
    pub fn of(model: &Model) -> Self {
        let mut kinds = BTreeMap::new();
        for node in model.nodes() {
            if let Node::Leaf { solid, .. } = node {
                *kinds.entry(kind(solid)).or_insert(0) += 1;
            }
        }
        let program = model.program();
        Self {
            leaves: model.leaves().len(),
            kinds,
            nodes: model.nodes().len(),
            frames: model.matrices().len(),
            bounds: match model.reach() {
                Reach::Within(bounds) => Some([bounds.min.to_array(), bounds.max.to_array()]),
                Reach::Empty | Reach::Endless => None,
            },
            empty: model.reach() == Reach::Empty,
            stack_depth: stack_depth(model.nodes()),
            max_sweeps: program.map_or(0, |program| program.max_sweeps()),
            flash_bytes: size_of_val(model.nodes()) + model.matrices().len() * size_of::<Transform>(),
            left_out: model.skipped().len(),
        }
    }
}

/// What a leaf is called.
const fn kind(leaf: &Leaf) -> &'static str {
    match leaf {
        Leaf::Cuboid(_) => "cuboid",
        Leaf::Sphere(_) => "sphere",
        Leaf::CappedCylinder(_) => "capped cylinder",
        Leaf::CappedCone(_) => "capped cone",
        Leaf::Cone(_) => "cone",
        Leaf::HalfSpace(_) => "half-space",
        // No module of OpenSCAD becomes another one.
        _ => "other",
    }
}

impl Info {
    /// Tells it on standard output.
    ///
    /// # Errors
    /// Where the model cannot be read.
    pub fn run(&self) -> Result<()> {
        let facts = Facts::of(&self.model.load()?);
        if self.json {
            say(&serde_json::to_string_pretty(&facts)?)
        } else {
            say(&told(&facts))
        }
    }
}

fn told(facts: &Facts) -> String {
    let kinds: Vec<_> = facts.kinds.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    let bounds = match facts.bounds {
        Some([min, max]) => format!("{min:?} to {max:?}"),
        None if facts.empty => "none: it is empty".to_owned(),
        None => "none: it has no end".to_owned(),
    };
    let leaves = if kinds.is_empty() {
        String::new()
    } else {
        format!(": {}", kinds.join(", "))
    };
    let mut told = format!(
        "leaves       {}{leaves}\n\
         nodes        {}\n\
         frames       {}\n\
         bounds       {bounds}\n\
         stack depth  {} of 32 operands\n\
         sweeps       {} at most for a ray\n\
         flash        {} bytes",
        facts.leaves, facts.nodes, facts.frames, facts.stack_depth, facts.max_sweeps, facts.flash_bytes,
    );
    if facts.left_out > 0 {
        told += &format!("\nleft out     {} statements", facts.left_out);
    }
    told
}
