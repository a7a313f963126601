//! Every other property, in one program: what is generic is compiled for all of them once, and not once per file.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod accuracy;
mod algebra;
mod bad_input;
mod bad_programs;
mod bounded;
mod certified;
mod closest;
mod composed;
mod cone_cases;
mod departures;
mod distances;
mod facets;
mod fuzzed;
mod grown;
mod laws_of_frames;
mod laws_of_rays;
mod laws_of_sets;
mod leaks;
mod leaves;
mod marcher;
mod membership;
mod plain;
mod programs;
mod references;
mod regressions;
mod scenes;
mod shared_faces;
mod units;
