//! Why a text is no model: where, what was found, and what would do.

use core::fmt;

/// Something that is wrong at a byte of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The byte it starts at.
    pub at: usize,
    /// What was found there; what stands in the text if nothing is said.
    pub found: Option<String>,
    /// What would do.
    pub wanted: String,
}

impl Fault {
    /// A fault at a byte, that speaks for itself.
    pub fn new(at: usize, found: impl Into<String>, wanted: impl Into<String>) -> Self {
        Self {
            at,
            found: Some(found.into()),
            wanted: wanted.into(),
        }
    }

    /// The fault with its place in the text counted as people do.
    #[must_use]
    pub fn in_text(self, text: &str) -> Refusal {
        let before = text.get(..self.at).unwrap_or(text);
        let start_of_line = before.rfind('\n').map_or(0, |newline| newline + 1);
        let rest = text.get(self.at..).unwrap_or_default();
        Refusal {
            line: 1 + before.bytes().filter(|byte| *byte == b'\n').count(),
            column: 1 + before.get(start_of_line..).unwrap_or_default().chars().count(),
            found: self.found.unwrap_or_else(|| first_word(rest)),
            wanted: self.wanted,
        }
    }
}

/// The word, or else the character, that a text starts with, so that it can be shown in a line.
fn first_word(text: &str) -> String {
    /// More than that is no help.
    const LONGEST: usize = 24;
    let word: String = text
        .chars()
        .take_while(|letter| letter.is_alphanumeric() || "_$.".contains(*letter))
        .take(LONGEST)
        .collect();
    match text.chars().next() {
        None => "the end of the file".to_owned(),
        Some(letter) if word.is_empty() => format!("`{}`", letter.escape_debug()),
        Some(_) => format!("`{word}`"),
    }
}

/// Why a text is no model, as it is told.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refusal {
    /// The line, from 1.
    pub line: usize,
    /// The column in characters, from 1.
    pub column: usize,
    /// What was found there.
    pub found: String,
    /// What would do.
    pub wanted: String,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, column, found, wanted } = self;
        write!(f, "line {line}, column {column}: found {found}: {wanted}")
    }
}

impl core::error::Error for Refusal {}

#[cfg(test)]
mod tests {
    use super::Fault;

    fn told(text: &str, at: usize) -> String {
        let fault = Fault {
            at,
            found: None,
            wanted: "more".to_owned(),
        };
        fault.in_text(text).to_string()
    }

    #[test]
    fn places_are_counted_in_lines_and_characters() {
        let text = "cube();\nä§ hull();";
        assert_eq!(told(text, 0), "line 1, column 1: found `cube`: more");
        assert_eq!(told(text, 8 + 5), "line 2, column 4: found `hull`: more");
        assert_eq!(told(text, 8 + 9), "line 2, column 8: found `(`: more");
        assert_eq!(told(text, text.len()), "line 2, column 11: found the end of the file: more");
    }

    #[test]
    fn what_cannot_be_printed_is_shown_all_the_same() {
        assert_eq!(told("\0", 0), "line 1, column 1: found `\\0`: more");
        assert!(told(&"x".repeat(1_000_000), 0).len() < 80);
    }
}
