//! The program as one calls it, with a model to call it for.

#![allow(dead_code, reason = "each test takes what it needs")]

use anyhow::{Context, Result, ensure};
use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::Path;
use std::process::{Child, ChildStdin, ChildStdout, Command, Output, Stdio};

pub(crate) const MODEL: &str = "color([1, 0, 0, 1]) {\n\tdifference() {\n\t\tcube(size = [4, 4, 4], center = true);\n\t\tcylinder($fn = 0, $fa = 12, $fs = 2, h = 9, r1 = 1, r2 = 1, center = true);\n\t}\n}\nmultmatrix([[0.6, -0.8, 0, 9], [0.8, 0.6, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n\tcylinder($fn = 6, $fa = 12, $fs = 2, h = 2, r1 = 2, r2 = 1, center = false);\n}\n";

/// A directory with the model in it, as `part.csg`.
pub(crate) fn directory() -> Result<tempfile::TempDir> {
    let directory = tempfile::tempdir()?;
    fs::write(directory.path().join("part.csg"), MODEL)?;
    Ok(directory)
}

pub(crate) fn gsdf(directory: &Path, arguments: &[&str]) -> Result<Output> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_gsdf"));
    Ok(command.current_dir(directory).args(arguments).stdin(Stdio::null()).output()?)
}

/// Calls it, and returns what it says; it must have nothing to complain about.
pub(crate) fn done(directory: &Path, arguments: &[&str]) -> Result<String> {
    let output = gsdf(directory, arguments)?;
    let complaints = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success() && output.stderr.is_empty(), "{arguments:?}: {complaints}");
    Ok(String::from_utf8(output.stdout)?)
}

/// Calls it for what it must refuse, in one line that names what is wrong, with nothing left behind.
pub(crate) fn refused(directory: &Path, arguments: &[&str], named: &str) -> Result<()> {
    let before = fs::read_dir(directory)?.count();
    let output = gsdf(directory, arguments)?;
    let told = String::from_utf8(output.stderr)?;
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {told}");
    assert!(
        told.starts_with("error: ") && told.contains(named) && told.lines().count() == 1,
        "{arguments:?}: {told}"
    );
    assert!(output.stdout.is_empty(), "{arguments:?}");
    assert_eq!(fs::read_dir(directory)?.count(), before, "{arguments:?}");
    Ok(())
}

/// Calls it with pipes, to be written to and read from.
pub(crate) fn piped(directory: &Path, arguments: &[&str]) -> Result<(Child, ChildStdin, ChildStdout)> {
    let mut child = Command::new(env!("CARGO_BIN_EXE_gsdf"))
        .current_dir(directory)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()?;
    let input = child.stdin.take().context("there is an input")?;
    let output = child.stdout.take().context("there is an output")?;
    Ok((child, input, output))
}

/// Writes a line as often as it takes until nobody reads it any more, and makes sure that this was no error.
pub(crate) fn ends_in_peace(child: Child, mut input: ChildStdin, line: &[u8]) -> Result<()> {
    let many = line.repeat(10_000);
    for _ in 0..1000 {
        if input.write_all(&many).is_err() {
            break;
        }
    }
    drop(input);
    let ended = child.wait_with_output()?;
    let complaints = String::from_utf8_lossy(&ended.stderr);
    ensure!(ended.status.success() && ended.stderr.is_empty(), "{complaints}");
    Ok(())
}

/// Rays from all around, toward a place near the middle.
pub(crate) fn rays(count: u32) -> Vec<[f32; 6]> {
    let ray = |number: u32| {
        let (a, b) = (number as f32 * 0.618_034 * std::f32::consts::TAU, (number % 97) as f32 / 48.0 - 1.0);
        let flat = (1.0 - b * b).max(0.0).sqrt();
        let origin = [20.0 * a.cos() * flat, 20.0 * a.sin() * flat, 20.0 * b];
        let target = [
            (number % 13) as f32 - 3.0,
            (number % 5) as f32 * 0.5 - 1.0,
            (number % 7) as f32 * 0.5 - 1.5,
        ];
        [
            origin[0],
            origin[1],
            origin[2],
            target[0] - origin[0],
            target[1] - origin[1],
            target[2] - origin[2],
        ]
    };
    (0..count).map(ray).collect()
}

/// Rays as text.
pub(crate) fn written(rays: &[[f32; 6]]) -> String {
    let mut text = String::from("# ox oy oz dx dy dz\n");
    for [a, b, c, d, e, f] in rays {
        // Writing to a text never fails.
        let _ = writeln!(text, "{a} {b} {c} {d} {e} {f}");
    }
    text
}
