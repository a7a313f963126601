//! Tells the benchmarks how they were built, for the head of their reports.

use std::env;
use std::process::Command;

fn main() {
    let of_cargo = |name: &str| env::var(name).unwrap_or_default();
    let compiler = Command::new(of_cargo("RUSTC"))
        .arg("--version")
        .output()
        .map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned())
        .unwrap_or_default();
    let facts = [
        ("COMPILER", compiler),
        ("TARGET", of_cargo("TARGET")),
        ("OPT_LEVEL", of_cargo("OPT_LEVEL")),
        ("TARGET_FEATURES", of_cargo("CARGO_CFG_TARGET_FEATURE")),
        // Cargo joins the flags by unit separators.
        ("FLAGS", of_cargo("CARGO_ENCODED_RUSTFLAGS").replace('\x1f', " ")),
    ];
    for (name, fact) in facts {
        println!("cargo::rustc-env=GSDF_{name}={fact}");
    }
    println!("cargo::rerun-if-changed=build.rs");
}
