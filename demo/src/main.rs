//! `gsdf`: pictures of CSG solids and answers about models.

use clap::Parser;
use gsdf_demo::command_line::{CommandLine, in_one_line};
use gsdf_demo::job::Job;
use std::io::{self, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let job = match CommandLine::try_parse().and_then(Job::try_from) {
        Ok(job) => job,
        Err(error) => match in_one_line(&error) {
            Some(line) => return failed(&line, 2),
            None => error.exit(),
        },
    };
    match job.run() {
        Ok(()) => ExitCode::SUCCESS,
        // The whole chain of causes in one line.
        Err(error) => failed(&format!("error: {error:#}"), job.status_of_failure()),
    }
}

/// Says why nothing came of it. If nobody can read that, the status still tells.
fn failed(line: &str, status: u8) -> ExitCode {
    let _ = writeln!(io::stderr(), "{line}");
    ExitCode::from(status)
}
