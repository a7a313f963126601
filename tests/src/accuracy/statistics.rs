//! What is kept of the errors of many rays.

use super::measure::RAYS_AT_ONE;

/// The parts an octave of errors is counted in.
const PARTS: i32 = 8;
/// Errors are counted from 2^-6 units in the last place to 2^122.
const LOWEST: i32 = -6;
const BUCKETS: usize = 1024;

/// Of fewer crossings than this nobody can tell what one in a hundred exceeds: half of them may be rays at one solid.
const LEAST_CROSSINGS: u64 = 2 * RAYS_AT_ONE;

/// The errors of one kind of leaf in one corpus and arithmetic.
#[derive(Clone, Debug)]
pub struct Statistics {
    /// The rays.
    pub rays: u64,
    /// Those whose hit or miss is wrong, or that have a crossing at infinity where there is one, or the reverse.
    pub wrong: u64,
    /// The ray that is wrong and has the least number.
    pub first_wrong: Option<u64>,
    /// The largest error of a well-conditioned crossing, in units in the last place.
    pub most: Worst,
    /// The largest error of any crossing, in units roundoff of its condition.
    pub conditioned: Worst,
    /// The crossings measured, by their errors in units in the last place.
    counts: Vec<u32>,
}

/// What is told of the errors: the figures of a row of the table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// The rays.
    pub rays: u64,
    /// Those that are wrong.
    pub wrong: u64,
    /// The first of them.
    pub first_wrong: Option<u64>,
    /// The share of them; of rays that were measured in parts, the largest of any part.
    pub wrong_share: f64,
    /// The error that one crossing in a hundred exceeds, in units in the last place; again the largest of any part
    /// that has enough of them.
    pub p99: f64,
    /// The largest error of a well-conditioned crossing, in units in the last place.
    pub most: Worst,
    /// The largest error of any crossing, in units roundoff of its condition.
    pub conditioned: Worst,
}

impl Summary {
    /// The figures of these rays and others.
    #[must_use]
    pub fn joined(mut self, other: &Self) -> Self {
        self.rays += other.rays;
        self.wrong += other.wrong;
        self.first_wrong = [self.first_wrong, other.first_wrong].into_iter().flatten().min();
        self.wrong_share = self.wrong_share.max(other.wrong_share);
        self.p99 = self.p99.max(other.p99);
        self.most.see(other.most);
        self.conditioned.see(other.conditioned);
        self
    }
}

/// A largest error and the number of the ray that had it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Worst {
    /// The error.
    pub error: f64,
    /// The ray.
    pub ray: u64,
}

impl Worst {
    /// Takes the error of a ray into account.
    pub fn see(&mut self, other: Self) {
        // Where errors are equal the first ray, so that the outcome does not depend on the order.
        if other.error > self.error || (other.error == self.error && other.ray < self.ray) {
            *self = other;
        }
    }
}

impl Default for Statistics {
    fn default() -> Self {
        Self {
            rays: 0,
            wrong: 0,
            first_wrong: None,
            most: Worst::default(),
            conditioned: Worst::default(),
            counts: vec![0; BUCKETS],
        }
    }
}

impl Statistics {
    /// Counts a crossing that is off by so many units in the last place.
    pub fn count(&mut self, ulps: f64) {
        let part = (ulps.log2() * f64::from(PARTS)).floor() - f64::from(LOWEST * PARTS);
        self.counts[part.clamp(0.0, (BUCKETS - 1) as f64) as usize] += 1;
    }

    /// Counts a ray whose hit or miss is wrong.
    pub fn count_wrong(&mut self, ray: u64) {
        self.wrong += 1;
        self.first_wrong = Some(self.first_wrong.map_or(ray, |first| first.min(ray)));
    }

    /// The error that one crossing in a hundred exceeds, rounded up to an eighth of an octave; 0 where crossings are so few
    /// that it would be that of a single solid.
    #[must_use]
    pub fn p99(&self) -> f64 {
        let crossings: u64 = self.counts.iter().map(|&count| u64::from(count)).sum();
        if crossings < LEAST_CROSSINGS {
            return 0.0;
        }
        let mut above = 0;
        for (part, &count) in self.counts.iter().enumerate().rev() {
            above += u64::from(count);
            if above * 100 > crossings {
                return if part == 0 {
                    0.0
                } else {
                    (f64::from(part as i32 + 1 + LOWEST * PARTS) / f64::from(PARTS)).exp2()
                };
            }
        }
        0.0
    }

    /// The figures.
    #[must_use]
    pub fn summary(&self) -> Summary {
        Summary {
            rays: self.rays,
            wrong: self.wrong,
            first_wrong: self.first_wrong,
            wrong_share: self.wrong as f64 / self.rays.max(1) as f64,
            p99: self.p99(),
            most: self.most,
            conditioned: self.conditioned,
        }
    }

    /// The statistics of these rays and others.
    #[must_use]
    pub fn joined(mut self, other: &Self) -> Self {
        self.rays += other.rays;
        self.wrong += other.wrong;
        self.first_wrong = [self.first_wrong, other.first_wrong].into_iter().flatten().min();
        self.most.see(other.most);
        self.conditioned.see(other.conditioned);
        for (count, more) in self.counts.iter_mut().zip(&other.counts) {
            *count += more;
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::{Statistics, Worst};

    #[test]
    fn one_in_a_hundred_is_above() {
        let mut statistics = Statistics::default();
        assert_eq!(statistics.p99(), 0.0);
        for _ in 0..980 {
            statistics.count(0.0);
        }
        for _ in 0..10 {
            statistics.count(3.0);
            statistics.count(1e9);
        }
        // Of a thousand crossings one in a hundred may be anything, but a thousand are not enough.
        assert_eq!(statistics.p99(), 0.0);
        for _ in 0..30 {
            statistics.count(0.0);
        }
        let p99 = statistics.p99();
        assert!((3.0..3.3).contains(&p99), "{p99}");
    }

    #[test]
    fn joining_does_not_depend_on_the_order() {
        let one = |error: f64, ray: u64| {
            let mut statistics = Statistics {
                rays: 1,
                ..Statistics::default()
            };
            statistics.count(error);
            statistics.count_wrong(ray);
            statistics.most.see(Worst { error, ray });
            statistics
        };
        let (a, b) = (one(1.0, 7), one(1.0, 3));
        let (left, right) = (a.clone().joined(&b), b.joined(&a));
        assert_eq!(
            (left.most, left.first_wrong, left.rays),
            (right.most, right.first_wrong, right.rays)
        );
        assert_eq!(left.most.ray, 3);
    }
}
