//! What is exported compiles by itself, and crosses rays with the same bits.

use anyhow::{Result, ensure};
use gsdf_demo::commands::export::rust;
use gsdf_demo::model::Model;
use gsdf_demo::model::evaluate::Reading;
use gsdf_nostd::{Program, Ray, Span};
use std::fs;
use std::path::Path;
use std::process::Command;

/// Every kind of leaf, in the world and in frames, and numbers that are not round.
const MODEL: &str = "difference() { cube(size = [4.1, 4, 4], center = true); sphere(r = 0.7); }
    multmatrix([[0.696364, -0.173648, 0.696364, 1], [0.122788, 0.984808, 0.122788, 2.3], [-0.707107, 0, 0.707107, 3], [0, 0, 0, 1]]) {
        cylinder($fn = 5, h = 1.7, r1 = 1.1, r2 = 0.3); cylinder(h = 0.33, r1 = 0.2, r2 = 2.2); cylinder(h = 7, r1 = 0.1, r2 = 0.1);
    }
    difference() { cylinder(h = 0.1, r1 = 5, r2 = 0, center = true); union() { cube(1); intersection() { cube(2); sphere(1.9); } } }";

/// The bits of what many rays meet.
fn bits(program: &Program<'_>) -> Vec<[u32; 2]> {
    let mut spans = vec![Span::<f32>::EMPTY; program.leaves()];
    let ray = |number: u32| {
        let (x, y, z) = (
            (number % 31) as f32 * 0.3 - 4.5,
            (number / 31 % 31) as f32 * 0.3 - 4.5,
            (number / 961) as f32 - 5.0,
        );
        Ray::new([x, y, 20.0].into(), [z * 0.05, 0.02, -1.0].into()).ok()
    };
    (0..9610)
        .filter_map(ray)
        .map(|ray| {
            let hit = program.along(ray, &mut spans).ok().and_then(|sight| sight.cast());
            hit.map_or([u32::MAX; 2], |hit| [hit.t.to_bits(), hit.leaf])
        })
        .collect()
}

/// The same as a program of its own.
const MAIN: &str = r#"
use gsdf_nostd::{Ray, Span};

fn main() {
    let mut spans = vec![Span::<f32>::EMPTY; part::MODEL.leaves()];
    for number in 0..9610_u32 {
        let (x, y, z) = ((number % 31) as f32 * 0.3 - 4.5, (number / 31 % 31) as f32 * 0.3 - 4.5, (number / 961) as f32 - 5.0);
        let Ok(ray) = Ray::new([x, y, 20.0].into(), [z * 0.05, 0.02, -1.0].into()) else { continue };
        let hit = part::MODEL.along(ray, &mut spans).ok().and_then(|sight| sight.cast());
        let [t, leaf] = hit.map_or([u32::MAX; 2], |hit| [hit.t.to_bits(), hit.leaf]);
        println!("{t} {leaf}");
    }
}
"#;

#[test]
fn an_exported_model_is_a_crate_with_the_same_bits() -> Result<()> {
    let model = Model::read(MODEL, Reading::default())?;
    let directory = tempfile::tempdir()?;
    let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let (library, source) = (workspace.join("gsdf-nostd"), directory.path().join("src"));
    fs::create_dir(&source)?;
    fs::write(
        directory.path().join("Cargo.toml"),
        format!(
            "[package]\nname = \"part\"\nedition = \"2024\"\n\n[dependencies]\ngsdf-nostd = {{ path = {:?} }}\n\n[workspace]\n",
            library.canonicalize()?
        ),
    )?;
    // The versions that the workspace was tested with, which are on this machine.
    fs::copy(workspace.join("Cargo.lock"), directory.path().join("Cargo.lock"))?;
    fs::write(source.join("lib.rs"), rust(&model, "part.csg"))?;
    fs::write(source.join("main.rs"), MAIN)?;
    let output = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--offline"])
        .env("CARGO_TARGET_DIR", directory.path().join("target"))
        .env("RUSTFLAGS", "-D warnings")
        .current_dir(directory.path())
        .output()?;
    ensure!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let found: Vec<[u32; 2]> = String::from_utf8(output.stdout)?
        .lines()
        .filter_map(|line| {
            let (t, leaf) = line.split_once(' ')?;
            Some([t.parse().ok()?, leaf.parse().ok()?])
        })
        .collect();
    let expected = bits(&model.program()?);
    assert!(expected.iter().filter(|[_, leaf]| *leaf != u32::MAX).count() > 1000);
    assert_eq!(found, expected);
    Ok(())
}
