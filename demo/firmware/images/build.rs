//! Gives the linker the memory of the board that the target stands for, and the start-up code's linker script.

use std::path::Path;
use std::{env, fs};

/// The board of each target. `../run` knows what QEMU calls them.
const BOARDS: [(&str, &str); 5] = [
    ("thumbv7em-none-eabihf", "cortex-m4f"),
    ("thumbv7m-none-eabi", "cortex-m3"),
    ("thumbv6m-none-eabi", "cortex-m0"),
    ("riscv32imac-unknown-none-elf", "riscv32imac"),
    ("riscv32imafc-unknown-none-elf", "riscv32imafc"),
];

fn main() {
    let variable = |name| env::var(name).unwrap_or_else(|_| panic!("cargo sets {name}"));
    let (target, out) = (variable("TARGET"), variable("OUT_DIR"));
    let Some((_, board)) = BOARDS.iter().find(|(of, _)| *of == target) else {
        panic!("no board has the target {target}; there are {BOARDS:?}");
    };
    let own = format!("boards/{board}-{}.x", variable("PROFILE"));
    let common = format!("boards/{board}.x");
    let script = if Path::new(&own).exists() { own } else { common };
    // The start-up crates' own link.x includes a file of this name.
    fs::copy(&script, Path::new(&out).join("memory.x")).unwrap_or_else(|error| panic!("{script}: {error}"));
    println!("cargo:rustc-link-search={out}");
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
    println!("cargo:rustc-check-cfg=cfg(roomy)");
    // Has the memory for scenes of hundreds of leaves.
    if *board != "cortex-m0" {
        println!("cargo:rustc-cfg=roomy");
    }
    println!("cargo:rerun-if-changed=boards");
    println!("cargo:rerun-if-changed=build.rs");
}
