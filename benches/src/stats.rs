//! Medians, and intervals that hold them whatever the distribution of the noise.

/// A median with an interval around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The median of the sample.
    pub median: f64,
    /// An interval that holds the median of the population, with the probability [`CONFIDENCE`] at least; from the least to the greatest value of a sample too small for that.
    pub interval: (f64, f64),
    /// The probability with which it does.
    pub coverage: f64,
}

/// The confidence of the intervals, where the sample is large enough: six values or more.
pub const CONFIDENCE: f64 = 0.95;

impl Estimate {
    /// That of which there is no sample.
    pub const UNKNOWN: Self = Self {
        median: f64::NAN,
        interval: (f64::NAN, f64::NAN),
        coverage: 0.0,
    };

    /// The estimate from a sample, `None` from an empty one or one with NaN.
    ///
    /// The interval lies between two order statistics. How many values of a sample are below the median is binomial with probability one half, whatever they are distributed
    /// like; so it assumes nothing of the noise but that one round's is independent of the next one's.
    #[must_use]
    pub fn new(sample: &[f64]) -> Option<Self> {
        if sample.is_empty() || sample.iter().any(|value| value.is_nan()) {
            return None;
        }
        let mut sorted = sample.to_vec();
        sorted.sort_by(f64::total_cmp);
        let count = sorted.len();
        let (rank, coverage) = innermost_rank(count);
        Some(Self {
            median: f64::midpoint(sorted[(count - 1) / 2], sorted[count / 2]),
            interval: (sorted[rank], sorted[count - 1 - rank]),
            coverage,
        })
    }
}

/// The largest rank, from 0, such that the value of that rank from below and the one of that rank from above still enclose the median with [`CONFIDENCE`], and the
/// probability with which they do. Rank 0 where none is.
fn innermost_rank(count: usize) -> (usize, f64) {
    // The probability that exactly `rank` of `count` values lie below the median; then of at most so many.
    let mut exactly = 0.5_f64.powi(i32::try_from(count).unwrap_or(i32::MAX));
    let mut at_most = exactly;
    let mut found = (0, 1.0 - 2.0 * at_most);
    for rank in 1..count / 2 {
        exactly *= (count - rank + 1) as f64 / rank as f64;
        at_most += exactly;
        let coverage = 1.0 - 2.0 * at_most;
        if coverage < CONFIDENCE {
            break;
        }
        found = (rank, coverage);
    }
    (found.0, f64::max(found.1, 0.0))
}

#[cfg(test)]
mod tests {
    use super::{CONFIDENCE, Estimate, innermost_rank};
    use rand::{RngExt, SeedableRng};
    use rand_pcg::Pcg64;

    #[test]
    fn medians_of_odd_and_even_samples() {
        let median = |sample: &[f64]| Estimate::new(sample).map(|estimate| estimate.median);
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), Some(2.5));
        assert_eq!(median(&[5.0]), Some(5.0));
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[1.0, f64::NAN]), None);
    }

    #[test]
    fn ranks_are_those_of_the_tables_of_the_sign_test() {
        // The critical values of the two-sided sign test at 5 %, less the first: ranks here start at 0.
        for (count, rank) in [(6, 0), (8, 0), (9, 1), (12, 2), (15, 3), (20, 5), (25, 7), (50, 17)] {
            assert_eq!(innermost_rank(count).0, rank, "of {count}");
        }
        assert!(innermost_rank(5).1 < CONFIDENCE && innermost_rank(6).1 > CONFIDENCE);
        assert_eq!(innermost_rank(1), (0, 0.0));
    }

    #[test]
    fn intervals_hold_the_median_as_often_as_they_say() {
        let mut random = Pcg64::seed_from_u64(11);
        let trials = 4000;
        let mut held = 0;
        let mut promised = 0.0;
        for _ in 0..trials {
            // Skewed, as timings are: the median of -ln(u) is ln 2.
            let sample: Vec<f64> = (0..15).map(|_| -random.random_range(f64::MIN_POSITIVE..1.0).ln()).collect();
            let estimate = Estimate::new(&sample).expect("a sample");
            promised = estimate.coverage;
            held += u32::from(estimate.interval.0 <= 2.0_f64.ln() && 2.0_f64.ln() <= estimate.interval.1);
        }
        let share = f64::from(held) / f64::from(trials);
        assert!((share - promised).abs() < 0.015, "{share} of {promised}");
    }
}
