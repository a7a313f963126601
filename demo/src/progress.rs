//! How far the work is, on a terminal; nothing where standard error is none.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar over so many steps.
#[must_use]
pub fn progress_bar(steps: u64) -> ProgressBar {
    let bar = ProgressBar::new(steps);
    // A template that does not parse would only cost the looks.
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed}  {msg}") {
        bar.set_style(style);
    }
    bar
}
