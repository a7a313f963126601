//! `gsdf cast`: rays in, crossings out, line by line and block by block, as many as one likes.

pub mod answer;
pub mod lines;

use super::tier::Tier;
use super::{ModelFile, Settings};
use crate::output::{WholeFile, directory_of, prepare, say_bytes};
use answer::{Answers, Form};
use anyhow::{Context, Result, bail};
use clap::Args;
use gsdf_simd::Scene;
use gsdf_trade::Solids;
use lines::{Block, Piece};
use rayon::ThreadPoolBuilder;
use rayon::prelude::*;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

/// What `gsdf cast` is told.
#[derive(Args, Clone, Debug, PartialEq, Eq)]
pub struct Cast {
    /// Which model.
    #[command(flatten)]
    pub model: ModelFile,
    /// The rays, one per line: the origin and the direction, `ox oy oz dx dy dz`; lines that are empty or start with # are
    /// passed over [default: standard input]
    #[arg(long, value_name = "FILE")]
    pub rays: Option<PathBuf>,
    /// Tell every crossing, one per line, each after the number of its ray, from 0, instead of the first one of each ray
    #[arg(long)]
    pub all: bool,
    /// In what arithmetic rays are cast. `f64` tells distances in double precision; `certified` adds to each answer by how
    /// much the distance may be off, and whether `single` or `double` precision proved what the ray meets or, at a `tie`, a
    /// rule decided
    #[arg(long, value_enum, default_value_t, value_name = "TIER")]
    pub tier: Tier,
    /// Answer each ray with a line of JSON
    #[arg(long)]
    pub json: bool,
}

/// Where answers go.
enum Sink {
    Output,
    File(WholeFile),
}

impl Sink {
    /// Writes, and tells whether somebody still reads.
    fn write(&mut self, bytes: &[u8]) -> Result<bool> {
        match self {
            Self::Output => say_bytes(bytes),
            Self::File(file) => file.write_all(bytes).context("cannot write").map(|()| true),
        }
    }
}

impl Cast {
    /// Answers all rays, in order: with distance, normal, leaf and `entering` or `leaving`, or with `miss`.
    ///
    /// Distances are in units of the direction's length.
    ///
    /// # Errors
    /// Where more is asked than the tier can tell, the model or the rays cannot be read, or the answers cannot be written. Rays before a line that is none are
    /// answered.
    pub fn run(&self, settings: &Settings) -> Result<()> {
        if self.all && self.tier == Tier::Certified {
            bail!("--all --tier certified: only first crossings are certified; take one of the two, or --tier f64");
        }
        let model = self.model.load()?;
        let program = model.solid()?;
        let mut input: Box<dyn Read> = match &self.rays {
            Some(path) => Box::new(File::open(path).with_context(|| format!("cannot read {}", path.display()))?),
            None => Box::new(io::stdin()),
        };
        let source = self.rays.as_deref().unwrap_or(Path::new("standard input")).display();
        let mut sink = match &settings.out {
            Some(path) => {
                prepare(directory_of(path))?;
                Sink::File(WholeFile::create(path)?)
            }
            None => Sink::Output,
        };
        let pool = ThreadPoolBuilder::new()
            .num_threads(settings.threads.unwrap_or_default())
            .build()
            .context("cannot start the threads")?;
        let solids = Solids::of(&program)?;
        let scene = Scene::new(program);
        let form = Form {
            all: self.all,
            json: self.json,
        };
        let answers = Answers::new(solids.program()?, &scene, settings.level, self.tier, form);
        let (mut block, mut line, mut ray) = (Block::default(), 1, 0);
        while block.fill(&mut input).with_context(|| format!("cannot read {source}"))? {
            let lines = match block.lines() {
                Ok(lines) => lines,
                Err(fault) => bail!("{source}: line {line}: {fault}"),
            };
            let mut pieces: Vec<Piece> = pool.install(|| lines::pieces(lines).into_par_iter().map(Piece::read).collect());
            let broken = pieces.iter().position(|piece| piece.fault.is_some());
            // What stands behind a line that is no ray is not looked at.
            pieces.truncate(broken.map_or(pieces.len(), |broken| broken + 1));
            for piece in &mut pieces {
                piece.first = ray;
                ray += piece.rays.len() as u64;
            }
            let texts: Vec<Vec<u8>> = pool.install(|| pieces.par_iter().map(|piece| answers.of(piece)).collect());
            for (text, piece) in texts.iter().zip(&pieces) {
                if !text.is_empty() && !sink.write(text)? {
                    return Ok(());
                }
                line += piece.lines;
                if let Some(fault) = &piece.fault {
                    bail!("{source}: line {line}: {fault}");
                }
            }
            block.drop_lines();
        }
        match sink {
            Sink::Output => Ok(()),
            Sink::File(file) => file.finish(),
        }
    }
}
