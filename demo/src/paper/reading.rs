//! The readings: which number stands for a primitive.

use gsdf_nostd::{Leaf, Span};

/// A way to understand the paper's composition: which of its roots a primitive answers with.
///
/// The paper writes one number per primitive and joins these numbers by minimum, maximum and minus. It leaves open which
/// root is meant, and what is said where there is none. In every reading here the primitives are repaired, so that they
/// have the right roots, and a primitive that is missed says +inf; what is judged is the composition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// What the library does: the signed next crossing, again and again from root to root.
    Exact,
    /// As printed: the near root, and for a plane `(p - s) . n / (v . n)`, which is its root with the wrong sign.
    Printed,
    /// The near root, whether ahead or behind; for a plane its only one.
    Near,
    /// The smallest positive root: the paper's "we accept only positive values", for all primitives.
    Positive,
    /// Where the ray enters the inside, -inf if it was there from the beginning; a primitive that is taken away enters
    /// with the part of its outside that begins last.
    Entry,
    /// The next crossing ahead, negative inside: the library's numbers, evaluated once.
    Next,
}

impl Reading {
    /// All of them, the exact one first.
    pub const ALL: [Self; 6] = [Self::Exact, Self::Printed, Self::Near, Self::Positive, Self::Entry, Self::Next];

    /// Its name in tables and pictures.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Exact => "exact",
            Self::Printed => "L printed",
            Self::Near => "N near",
            Self::Positive => "P positive",
            Self::Entry => "H entry",
            Self::Next => "S one sweep",
        }
    }

    /// Which number it is, in a few words.
    #[must_use]
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Exact => "signed next crossings, swept until the sign turns: what the library does",
            Self::Printed => "near root; for a plane the quotient as printed, which has the wrong sign",
            Self::Near => "near root, ahead or behind; for a plane its root",
            Self::Positive => "smallest positive root",
            Self::Entry => "where the ray enters the inside, -inf if it always was there",
            Self::Next => "signed next crossing, a single evaluation",
        }
    }

    /// The number of one primitive, and of one that is taken away (under an odd number of complements and right-hand
    /// sides of differences) what the composition's minus will turn into its number.
    pub(super) fn of_leaf(self, solid: &Leaf, span: Span<f32>, taken: bool) -> f32 {
        match self {
            // For a plane this is (p - s) . n / (v . n), the paper's formula, to rounding.
            Self::Printed if matches!(solid, Leaf::HalfSpace(_)) && span.enter.is_finite() != span.exit.is_finite() => -near(span),
            Self::Printed | Self::Near => near(span),
            Self::Positive => [span.enter, span.exit]
                .into_iter()
                .find(|root| *root > 0.0)
                .unwrap_or(f32::INFINITY),
            Self::Entry if taken => -entry_of_outside(span),
            Self::Entry => span.enter,
            Self::Exact | Self::Next => span.signed_crossing(0.0),
        }
    }
}

/// The lesser root; without one +inf where the ray misses and -inf where it is inside for ever.
fn near(span: Span<f32>) -> f32 {
    if span.enter.is_finite() || !span.exit.is_finite() {
        span.enter
    } else {
        span.exit
    }
}

/// Where a ray that starts at 0 enters the part of the outside it is in, or comes to when it leaves the inside.
fn entry_of_outside(span: Span<f32>) -> f32 {
    let all = span.enter == f32::NEG_INFINITY && span.exit == f32::INFINITY;
    if all {
        f32::INFINITY
    } else if span.enter <= 0.0 && span.exit < f32::INFINITY {
        span.exit
    } else {
        f32::NEG_INFINITY
    }
}
