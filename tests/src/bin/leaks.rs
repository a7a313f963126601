//! The long run of the law that no edge leaks: as many rays as one has time for.
//!
//! `cargo run --release --package gsdf-tests --bin leaks -- --rays 100000000` casts 10^8 rays at edges that solids share,
//! and fails if one slips through. Half a million rays take about a second on two free cores, so these take some four
//! minutes. Without options it casts 10^6. What it found, and how long it took, is printed
//! for each kind of arrangement; a seed that is reported makes the same rays again.

use clap::Parser;
use gsdf_tests::leaks::{KINDS, RAYS, Tally, cast};
use rayon::prelude::*;
use std::process::ExitCode;
use std::time::Instant;

/// Casts rays at edges that solids share, and looks for one that slips through.
#[derive(Parser)]
struct Arguments {
    /// How many rays to cast, over all kinds of arrangements.
    #[arg(long, default_value_t = 1_000_000)]
    rays: u64,
    /// The seed of the first arrangement; each arrangement takes one.
    #[arg(long, default_value_t = 0)]
    seed: u64,
}

fn main() -> ExitCode {
    let Arguments { rays, seed } = Arguments::parse();
    let arrangements = rays.div_ceil(RAYS * KINDS.len() as u64);
    let mut leaks = 0;
    for (kind, name) in KINDS.iter().enumerate() {
        let since = Instant::now();
        let tally = (seed..seed.saturating_add(arrangements))
            .into_par_iter()
            .map(|seed| cast(kind, seed))
            .reduce(Tally::default, Tally::joined);
        println!(
            "{name}: {} rays, {} met, {} in a shared plane, {} slivers, {} leaks ({:.0} s)",
            tally.rays,
            tally.met,
            tally.in_plane,
            tally.slivers,
            tally.leaks,
            since.elapsed().as_secs_f64()
        );
        if let Some(first) = tally.first {
            println!("  {first}");
        }
        leaks += tally.leaks;
    }
    if leaks == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
