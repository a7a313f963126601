//! What raw bytes may do to the library: each target makes solids, programs, transforms or rays of them, any numbers at
//! all among them, and holds the library to what it promises of whatever it does not refuse.
//!
//! `tests/fuzz` gives the targets to libFuzzer; `tests/tests/fuzzed.rs` runs them over the committed corpus and over
//! random bytes.
#![allow(clippy::missing_panics_doc, reason = "a check that fails panics, and does nothing else")]

mod programs;
mod raw;
mod rays;
mod shapes;
mod solids;
mod transforms;

pub use programs::programs;
pub use rays::rays;
pub use shapes::shapes;
pub use transforms::transforms;

use core::fmt::Display;
use gsdf_nostd::Invalid;

/// A target by its name: what is made of bytes, and the check.
pub type Target = (&'static str, fn(&[u8]) -> Tally);

/// All targets; each has a folder of its name in the corpus.
pub const TARGETS: [Target; 4] = [
    ("programs", programs),
    ("shapes", shapes),
    ("transforms", transforms),
    ("rays", rays),
];

/// How often what happened, to tell a corpus that asks from one that is refused all the time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Constructions that the library refused.
    pub refused: u64,
    /// Questions that it answered.
    pub answered: u64,
    /// Answers that were a surface.
    pub met: u64,
    /// Questions from inside of a solid.
    pub inside: u64,
}

impl Tally {
    /// Both as one.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            refused: self.refused + other.refused,
            answered: self.answered + other.answered,
            met: self.met + other.met,
            inside: self.inside + other.inside,
        }
    }

    /// The value, or the refusal counted and found to say something.
    fn accept<T, E: Display>(&mut self, result: Result<T, E>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                let said = error.to_string();
                assert!(said.len() > 10, "a refusal must say why, not '{said}'");
                self.refused += 1;
                None
            }
        }
    }

    /// The same for a parameter: it must be named, and what would be right be said.
    fn accept_named<T>(&mut self, result: Result<T, Invalid>) -> Option<T> {
        if let Err(error) = &result {
            assert!(!error.parameter().is_empty() && !error.message().is_empty(), "{error}");
            let said = error.to_string();
            assert!(said.starts_with(error.parameter()) && said.ends_with(error.message()), "{said}");
        }
        self.accept(result)
    }
}
