//! What repeated measurements tell.

use serde::Serialize;

/// A median, with the interval in which the one of all measurements there could be lies with 95 % confidence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Estimate {
    /// The median.
    pub median: f64,
    /// The least that it is.
    pub low: f64,
    /// The most.
    pub high: f64,
}

impl Estimate {
    /// From measurements, of which there is at least one; fewer than six are too few for 95 %, and the interval is all of
    /// them.
    #[must_use]
    pub fn of(mut measured: Vec<f64>) -> Self {
        measured.sort_by(f64::total_cmp);
        let outside = outside(measured.len());
        let at = |rank: usize| measured.get(rank).copied().unwrap_or(f64::NAN);
        Self {
            median: at(measured.len() / 2),
            low: at(outside),
            high: at(measured.len().saturating_sub(1 + outside)),
        }
    }
}

/// How many of so many sorted measurements lie below the interval, and as many above: order statistics. The number of those
/// below the median is distributed as heads are.
fn outside(count: usize) -> usize {
    let mut chance = 0.5_f64.powi(count as i32);
    let mut below = chance;
    let mut heads = 0;
    while 2 * heads < count {
        chance *= (count - heads) as f64 / (heads + 1) as f64;
        below += chance;
        if below > 0.025 {
            break;
        }
        heads += 1;
    }
    heads
}

#[cfg(test)]
mod tests {
    use super::{Estimate, outside};

    #[test]
    fn intervals_are_those_of_the_tables() {
        // W. J. Conover, Practical Nonparametric Statistics: the ranks of 95 %.
        for (count, rank) in [
            (1, 0),
            (5, 0),
            (6, 0),
            (8, 0),
            (9, 1),
            (11, 1),
            (12, 2),
            (15, 3),
            (20, 5),
            (25, 7),
            (1000, 468),
        ] {
            assert_eq!(outside(count), rank, "{count}");
        }
    }

    #[test]
    fn an_interval_holds_the_median() {
        let times: Vec<f64> = (0..25).rev().map(f64::from).collect();
        let estimate = Estimate::of(times);
        assert_eq!((estimate.low, estimate.median, estimate.high), (7.0, 12.0, 17.0));
        let one = Estimate::of(vec![3.0]);
        assert_eq!((one.low, one.median, one.high), (3.0, 3.0, 3.0));
    }
}
