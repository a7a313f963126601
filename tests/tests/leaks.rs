//! Rays aimed at the edges and faces that solids share: none slips through. The long run of the same is
//! `cargo run --release --package gsdf-tests --bin leaks -- --rays 100000000`.

use gsdf_tests::leaks::{KINDS, RAYS, Tally, cast};
use rayon::prelude::*;

/// Arrangements of each kind.
const ARRANGEMENTS: u64 = 500;

#[test]
fn no_ray_slips_through_what_solids_share() {
    for (kind, name) in KINDS.iter().enumerate() {
        let tally = (0..ARRANGEMENTS)
            .into_par_iter()
            .map(|seed| cast(kind, seed))
            .reduce(Tally::default, Tally::joined);
        println!("{name}: {tally:?}");
        assert_eq!(tally.rays, ARRANGEMENTS * RAYS);
        assert_eq!(tally.leaks, 0, "{name}: {:?}", tally.first);
        assert!(tally.met * 3 > tally.rays, "{name}: the rays have lost their aim: {tally:?}");
        assert!(tally.in_plane * 20 < tally.rays, "{name}: too many rays in a plane: {tally:?}");
    }
}
