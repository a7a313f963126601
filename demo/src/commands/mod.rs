//! What the command line does with a model of the user's.

pub mod bench;
pub mod cast;
pub mod export;
pub mod info;
pub mod render;
pub mod size;
pub mod tier;
pub mod trade;

use crate::model::Model;
use crate::model::evaluate::Reading;
use crate::model::solids::Facets;
use anyhow::Result;
use clap::Args;
use gsdf_simd::Level;
use size::Size;
use std::io::{self, Write};
use std::path::PathBuf;

/// Which model, and how it is read.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct ModelFile {
    /// The model: a `.csg` file, which `openscad -o model.csg model.scad` writes
    #[arg(value_name = "MODEL")]
    pub path: PathBuf,
    /// Where what is round gets the flat sides that OpenSCAD gives it
    #[arg(long, value_enum, default_value_t, value_name = "WHEN")]
    pub facets: Facets,
    /// Leave out what is not supported, with a warning, instead of refusing the model
    #[arg(long)]
    pub skip_unsupported: bool,
}

impl ModelFile {
    /// Reads the model, and tells on standard error what was left out of it.
    ///
    /// # Errors
    /// Where the file cannot be read, or is no model.
    pub fn load(&self) -> Result<Model> {
        let reading = Reading {
            facets: self.facets,
            skip_unsupported: self.skip_unsupported,
        };
        let model = Model::load(&self.path, reading)?;
        for left_out in model.skipped() {
            // Where nobody reads warnings, none are needed.
            let _ = writeln!(
                io::stderr(),
                "warning: {}: line {}: {} and left out",
                self.path.display(),
                left_out.line,
                left_out.found
            );
        }
        Ok(model)
    }
}

/// What is asked of all commands alike.
#[derive(Clone, Debug)]
pub struct Settings {
    /// The pixels of a picture.
    pub size: Option<Size>,
    /// Where the result goes.
    pub out: Option<PathBuf>,
    /// The number of threads; `None` for as many as there are cores.
    pub threads: Option<usize>,
    /// The level at which rays are cast.
    pub level: Level,
}
