//! Tells the crate whether the target's FPU takes square roots of `f32` by an instruction that stable Rust can name.

use std::env;

fn main() {
    let variable = |name| env::var(name).unwrap_or_default();
    // "eabihf" passes floating-point numbers in the registers of the FPU, so there is one; all of them know `f32`.
    let arm = variable("CARGO_CFG_TARGET_ARCH") == "arm" && variable("CARGO_CFG_TARGET_ABI") == "eabihf";
    // Stable compilers do not show the feature "f" to `cfg`; the target's name shows it: riscv32imafc, riscv64gc.
    let target = variable("TARGET");
    let extensions = target
        .split('-')
        .next()
        .and_then(|name| name.strip_prefix("riscv32").or(name.strip_prefix("riscv64")));
    let riscv = extensions.is_some_and(|letters| letters.contains(['f', 'g']));
    println!("cargo:rustc-check-cfg=cfg(root_instruction)");
    if arm || riscv {
        println!("cargo:rustc-cfg=root_instruction");
    }
    println!("cargo:rerun-if-changed=build.rs");
}
