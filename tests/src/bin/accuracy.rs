//! How accurate every leaf is, beside what is allowed.

use clap::Parser;
use gsdf_tests::accuracy::command::{Arguments, Outcome};
use std::process::ExitCode;

/// 1 where more was measured than is allowed, 2 where the command cannot be done as it was given.
fn main() -> ExitCode {
    match Arguments::parse().run() {
        Ok(Outcome::Kept) => ExitCode::SUCCESS,
        Ok(Outcome::Breached) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("accuracy: {error}");
            ExitCode::from(2)
        }
    }
}
