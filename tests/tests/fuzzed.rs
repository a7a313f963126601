//! The fuzz targets as ordinary tests: over the committed corpus, and over random bytes.

use gsdf_tests::fuzzed::{TARGETS, Tally, Target};
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::path::Path;

/// Strings of random bytes for each target.
const STRINGS: u64 = 100_000;

/// The longest of them.
const MOST: usize = 400;

/// Runs a target over strings that have names; where it fails, the shortest of those it fails on is printed, to be added
/// to the corpus.
fn run((name, target): Target, strings: impl ParallelIterator<Item = (String, Vec<u8>)>) -> Tally {
    let outcomes: Vec<Result<Tally, (String, Vec<u8>)>> = strings
        .map(|(what, bytes)| std::panic::catch_unwind(|| target(&bytes)).map_err(|_| (what, bytes)))
        .collect();
    let failures = outcomes.iter().filter_map(|outcome| outcome.as_ref().err());
    if let Some((what, bytes)) = failures.clone().min_by_key(|(_, bytes)| bytes.len()) {
        panic!("{name} fails on {} strings, the shortest {what}: {bytes:?}", failures.count());
    }
    let tally = outcomes.into_iter().flatten().reduce(Tally::joined).unwrap_or_default();
    println!("{name}: {tally:?}");
    tally
}

#[test]
fn the_committed_corpus_holds_no_surprise() {
    for target in TARGETS {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(target.0);
        let files: Vec<_> = std::fs::read_dir(&folder)
            .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
            .map(|entry| entry.unwrap().path())
            .collect();
        assert!(files.len() >= 8, "{} has {} seeds", folder.display(), files.len());
        let strings = files
            .into_par_iter()
            .map(|file| (file.display().to_string(), std::fs::read(file).unwrap()));
        let tally = run(target, strings);
        assert!(
            tally.refused > 0 && tally.met > 0 && tally.inside > 0,
            "the seeds of {} leave something out: {tally:?}",
            target.0
        );
    }
}

#[test]
fn random_bytes_are_refused_or_answered() {
    for target in TARGETS {
        let tally = run(
            target,
            (0..STRINGS).into_par_iter().map(|seed| {
                let mut rng = Pcg64::seed_from_u64(seed);
                let mut bytes = vec![0; rng.random_range(0..MOST)];
                rng.fill_bytes(&mut bytes);
                (format!("number {seed}"), bytes)
            }),
        );
        let enough = [tally.refused, tally.answered, tally.met, tally.inside]
            .iter()
            .all(|&count| count > STRINGS / 20);
        assert!(enough, "{} is hardly ever asked: {tally:?}", target.0);
    }
}
