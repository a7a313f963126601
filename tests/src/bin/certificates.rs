//! The long run of the promise that no certificate is wrong: as many rays as one has time for.
//!
//! `cargo run --release --package gsdf-tests --bin certificates -- --rays 3276800` casts a thousand million rays, as many of
//! every corpus at every leaf, and fails if what is certified of one is not so. Ten million take about 40 seconds on two free
//! threads, so these take more than an hour. Without options it casts the ten million that the tests cast. A ray that is
//! reported is shown by `accuracy --replay`.

use clap::{Parser, value_parser};
use gsdf_tests::accuracy::{Cell, Certainty, PART};
use gsdf_tests::shape::KINDS;
use std::process::ExitCode;
use std::time::Instant;

/// Certifies rays of every corpus at every leaf, and looks for a certificate that is wrong.
#[derive(Parser)]
struct Arguments {
    /// How many rays of each corpus at each leaf.
    #[arg(long, value_name = "N", default_value_t = PART, value_parser = value_parser!(u64).range(1..))]
    rays: u64,
    /// The number of the first of them: those before it are done.
    #[arg(long, value_name = "NUMBER", default_value_t = 0)]
    first: u64,
}

fn main() -> ExitCode {
    let Arguments { rays, first } = Arguments::parse();
    let since = Instant::now();
    let (mut all, mut wrong) = (Certainty::default(), 0);
    for cell in Cell::all() {
        let (name, corpus) = (KINDS[cell.leaf], cell.corpus.name());
        let found = cell.certainty(first..first.saturating_add(rays));
        println!("{name:16} {corpus:16} {:.4} {found:?}", found.share());
        if let Some(ray) = found.wrong {
            println!("  wrong: accuracy --leaf '{name}' --corpus {corpus} --replay {ray}");
            wrong += 1;
        }
        all = all.joined(found);
    }
    println!("{all:?} ({:.0} s)", since.elapsed().as_secs_f64());
    if wrong == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
