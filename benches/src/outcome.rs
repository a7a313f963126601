//! How a benchmark ends.

use anyhow::Result;
use std::io::{self, Write};
use std::process::ExitCode;

/// Success where it is `true`, or nothing; an error with the whole chain of its causes, in one line on standard error.
pub fn outcome<O: Outcome>(result: Result<O>) -> ExitCode {
    match result {
        Ok(passed) if passed.is_success() => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            // If nobody can read it, the status still tells.
            let _ = writeln!(io::stderr(), "error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// What a benchmark comes to.
pub trait Outcome {
    /// Whether that is a success.
    fn is_success(&self) -> bool;
}

impl Outcome for () {
    fn is_success(&self) -> bool {
        true
    }
}

impl Outcome for bool {
    fn is_success(&self) -> bool {
        *self
    }
}
