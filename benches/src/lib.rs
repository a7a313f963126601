//! What a distance costs: the closed form against sphere tracing, against itself and against parry3d; in nanoseconds, and in operations.
//!
//! | command | what it measures |
//! |---|---|
//! | `cargo bench --bench race` | scenes, A and B by turns in one process: ratios with confidence intervals; `-- --csv FILE` to publish them |
//! | `cargo bench --bench attribution` | where the time of a picture goes, stage by stage, beside what the processor and its memory can do |
//! | `cargo bench --bench spheres` | a thousand to a million spheres: preparation, memory, pictures on one thread and on all |
//! | `cargo bench --bench batches` | rays that have nothing in common, in batches: the first hit of each, and any |
//! | `cargo bench --bench instructions` | instructions per pixel, counted by callgrind, against those on record |
//! | `cargo bench --bench levels` | levels of this build and of a native one by turns: the share of its speed |
//! | `cargo bench --bench sums` | shapes against the sum of their parts: ratios with confidence intervals, and operations |
//! | `cargo bench --bench counts` | operations, roots, sweeps and steps per ray: the same numbers on every machine |
//! | `cargo bench --bench scenes` | scenes: time per picture of each contender |
//! | `cargo bench --bench leaves` | leaves: time per evaluation, one at a time and in packets |
//! | `cargo bench --bench parry` | ray casts on the solids parry3d has too |
//!
//! Times on machines that others use too swing by a factor of three within minutes. Only the race, the levels and the sums are comparisons: there each ratio is one of two neighbours in time.

pub mod arena;
pub mod arguments;
pub mod attribution;
pub mod contender;
pub mod counts;
pub mod frame;
pub mod inputs;
pub mod instructions;
pub mod leaves;
pub mod levels;
pub mod machine;
pub mod outcome;
pub mod race;
pub mod report;
pub mod scenes;
pub mod stats;
pub mod sums;
