//! `gsdf bench`: every contender is measured and judged. How long they take is nobody's business here.

mod program;

use anyhow::{Context, Result};
use gsdf_simd::Level;
use gsdf_trade::Contender;
use program::{directory, done, piped, refused};
use serde_json::Value;
use std::fs;

#[test]
fn every_contender_is_measured_and_judged() -> Result<()> {
    let directory = directory()?;
    let arguments = ["bench", "part.csg", "--size", "24x16", "--rounds", "6", "--level", "portable"];
    let text = done(directory.path(), &arguments)?;
    let json = done(directory.path(), &[&arguments[..], &["--json"]].concat())?;
    let told: Value = serde_json::from_str(&json)?;
    assert_eq!((&told["model"], &told["leaves"]), (&"part.csg".into(), &9.into()));
    assert_eq!(
        (&told["width"], &told["height"], &told["rounds"]),
        (&24.into(), &16.into(), &6.into())
    );
    assert_eq!(
        (&told["level"], &told["version"]),
        (&"portable".into(), &env!("CARGO_PKG_VERSION").into())
    );
    let measured = told["measured"].as_array().context("a list")?;
    let names: Vec<String> = Contender::all(Level::PORTABLE).map(|contender| contender.to_string()).collect();
    let found: Vec<&str> = measured.iter().filter_map(|one| one["contender"].as_str()).collect();
    assert_eq!(found, names);
    for one in measured {
        let name = one["contender"].as_str().context("a name")?;
        let number = |field: &str| one[field].as_f64().with_context(|| format!("{name} has no {field}"));
        for [low, middle, high] in [["ns_low", "ns", "ns_high"], ["ratio_low", "ratio", "ratio_high"]] {
            let [low, middle, high] = [number(low)?, number(middle)?, number(high)?];
            assert!(0.0 < low && low <= middle && middle <= high, "{name}: {low} {middle} {high}");
        }
        let is_traced = name.starts_with("traced");
        assert_eq!(one["wrong_leaf"].is_null(), is_traced, "{name}");
        assert!(number("judged")? <= number("rays")? && number("rays")? <= 24.0 * 16.0);
        if name == "robust, tiles" {
            assert_eq!((number("ratio")?, number("rays")?), (1.0, 24.0 * 16.0));
        }
        if !is_traced {
            assert_eq!((number("wrong")?, &one["wrong_leaf"]), (0.0, &0.into()), "{name}");
            assert!(number("worst")? < 1e-5, "{name}");
        }
        assert_eq!(
            text.lines().filter(|line| line.starts_with(&format!("{name} "))).count(),
            1,
            "{text}"
        );
    }
    assert!(text.contains("9 leaves, 24 x 16 pixels") && text.contains("100 ms"), "{text}");
    Ok(())
}

/// However many leaves there are, and whatever they are to each other, a round is over soon: the picture gets smaller, and who
/// is slow casts few rays of it, and says so.
#[test]
fn large_models_are_measured_on_fewer_pixels() -> Result<()> {
    let directory = directory()?;
    let mut text = String::from("intersection() { union() {\n");
    for number in 0..40_000 {
        let (x, y) = (number % 200, number / 200);
        text += &format!("multmatrix([[1,0,0,{x}],[0,1,0,{y}],[0,0,1,0],[0,0,0,1]]) cube([0.5,0.5,0.5]);\n");
    }
    text += "} union() { cube(150); sphere(100); } }";
    fs::write(directory.path().join("field.csg"), text)?;
    let told = done(directory.path(), &["bench", "field.csg", "--rounds", "6", "--json"])?;
    let told: Value = serde_json::from_str(&told)?;
    assert_eq!((&told["leaves"], &told["asked_width"]), (&40_002.into(), &256.into()));
    let measured = told["measured"].as_array().context("a list")?;
    assert_eq!(measured.len(), Contender::all(Level::PORTABLE).count());
    let rays: Vec<u64> = measured.iter().filter_map(|one| one["rays"].as_u64()).collect();
    assert!(
        rays.iter().all(|rays| *rays >= 1) && rays.iter().any(|rays| *rays < 1000),
        "{rays:?}"
    );
    Ok(())
}

#[test]
fn wrong_use_is_refused() -> Result<()> {
    let directory = directory()?;
    fs::write(directory.path().join("empty.csg"), "group();")?;
    fs::write(directory.path().join("broken.csg"), "cube(1);\nblob();")?;
    for (arguments, named) in [
        (&["bench"][..], "MODEL"),
        (&["bench", "missing.csg"], "missing.csg"),
        (&["bench", "empty.csg"], "empty"),
        (&["bench", "broken.csg"], "broken.csg: line 2, column 1: found `blob`"),
        (&["bench", "part.csg", "--rounds", "5"], "6..=1000"),
        (&["bench", "part.csg", "--rounds", "many"], "--rounds"),
        (&["bench", "part.csg", "--size", "0"], "--size"),
        (&["bench", "part.csg", "--fov", "180"], "--fov"),
        (&["bench", "part.csg", "--level", "mmx"], "--level"),
        (&["bench", "part.csg", "--out", "a"], "--out"),
        (&["bench", "part.csg", "--threads", "1"], "--threads"),
        (&["bench", "part.csg", "--tier", "f64"], "--tier"),
    ] {
        refused(directory.path(), arguments, named)?;
    }
    Ok(())
}

#[test]
fn that_nobody_reads_it_is_no_error() -> Result<()> {
    let directory = directory()?;
    let (child, input, output) = piped(directory.path(), &["bench", "part.csg", "--size", "16", "--rounds", "6"])?;
    drop((input, output));
    let ended = child.wait_with_output()?;
    assert!(ended.status.success() && ended.stderr.is_empty());
    Ok(())
}
