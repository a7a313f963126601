//! The share of a native build's speed that this build reaches: each level by turns with the same level and with the portable one of a build with `-C target-cpu=native`, which this
//! command makes.

use anyhow::{Context, Result};
use clap::Parser;
use gsdf_benches::levels::{Arguments, Peer, Turn, beside, build_native, serve};
use gsdf_benches::machine::Machine;
use gsdf_benches::outcome::outcome;
use gsdf_simd::Level;
use std::io::{self, Write};
use std::process::ExitCode;

/// Scenes and the pixels along each side of their pictures.
const SCENES: [(&str, u32); 7] = [
    ("s1", 512),
    ("s2", 512),
    ("s3", 512),
    ("s4", 512),
    ("s5", 512),
    ("s6-22", 512),
    ("s7", 512),
];

fn run(arguments: &Arguments) -> Result<()> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .context("a thread to take turns on")?;
    let mut out = io::stdout().lock();
    if arguments.serve {
        return serve(&pool, io::stdin().lock(), out);
    }
    let rounds = if arguments.quick { 3 } else { arguments.rounds };
    let mut peer = Peer::start(&build_native()?)?;
    writeln!(
        out,
        "{}\nrules     {rounds} rounds, this build and a native one by turns; medians; share: this build's speed by the native one's\n\n\
         {:<5} {:>5} {:<9} {:>10} {:<17} {:>10} {:>6}  interval",
        Machine::here(),
        "scene",
        "size",
        "level",
        "ns/px",
        "native level",
        "ns/px",
        "share",
    )?;
    for (scene, size) in SCENES {
        let turn = |level| Turn {
            scene: scene.to_owned(),
            size: if arguments.quick { size / 4 } else { size },
            level,
            repeats: 1,
        };
        for level in Level::available() {
            for native in [level, Level::PORTABLE] {
                let (here, there) = (turn(level), turn(native));
                let found = beside(&here, &there, rounds, &pool, &mut peer)?;
                let (low, high) = found.share.interval;
                writeln!(
                    out,
                    "{scene:<5} {:>5} {:<9} {:>10.2} {:<17} {:>10.2} {:>6.2}  {low:.2}..{high:.2}",
                    here.size, level, found.here, native, found.there, found.share.median,
                )?;
                if level == Level::PORTABLE {
                    break;
                }
            }
        }
    }
    Ok(())
}

fn main() -> ExitCode {
    outcome(run(&Arguments::parse()))
}
