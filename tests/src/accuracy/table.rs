//! The table: what is allowed in every cell, and whether what was measured is.

use super::measure::{Cell, Measured};
use super::rows::ROWS;
use super::statistics::{Statistics, Worst};
use super::trial::Arithmetic;
use crate::shape::KINDS;

/// The most that is allowed in a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Allowed {
    /// The share of rays whose hit or miss is wrong.
    pub wrong: f64,
    /// The error that one crossing in a hundred exceeds, in units in the last place.
    pub p99: f64,
    /// The error of a well-conditioned crossing, in units in the last place.
    pub most: f64,
    /// The error of any crossing, in units roundoff of its condition.
    pub conditioned: f64,
}

/// What is allowed in a cell, if it has a row.
#[must_use]
pub fn allowed(cell: Cell, arithmetic: Arithmetic) -> Option<Allowed> {
    let key = (KINDS[cell.leaf], cell.corpus.name(), arithmetic.name());
    let row = ROWS.iter().find(|row| (row.0, row.1, row.2) == key)?;
    let [wrong, p99, most, conditioned] = row.3;
    Some(Allowed {
        wrong,
        p99,
        most,
        conditioned,
    })
}

/// The rows that no cell has: of an unknown name, or where there are no such rays.
#[must_use]
pub fn strays() -> Vec<String> {
    let known: Vec<_> = Cell::all()
        .flat_map(|cell| {
            cell.arithmetics()
                .map(move |arithmetic| (KINDS[cell.leaf], cell.corpus.name(), arithmetic.name()))
        })
        .collect();
    let is_stray = |row: &&super::rows::Row| !known.contains(&(row.0, row.1, row.2));
    ROWS.iter()
        .filter(is_stray)
        .map(|row| format!("{} {} {}", row.0, row.1, row.2))
        .collect()
}

impl Allowed {
    /// How many of so many rays may be wrong: the share, with room for four standard deviations of chance.
    #[must_use]
    pub fn wrong_of(&self, rays: u64) -> f64 {
        let expected = self.wrong * rays as f64;
        expected + 4.0 * expected.sqrt()
    }

    /// Every way in which what was measured is more than allowed, with the number of the ray.
    #[must_use]
    pub fn breaches(&self, found: &Statistics) -> Vec<(String, u64)> {
        let mut breaches = Vec::new();
        if found.wrong as f64 > self.wrong_of(found.rays) {
            let ray = found.first_wrong.unwrap_or_default();
            breaches.push((
                format!("{} of {} rays wrong, allowed {:e}", found.wrong, found.rays, self.wrong),
                ray,
            ));
        }
        if found.p99() > self.p99 {
            breaches.push((format!("p99 {:e} ulp, allowed {:e}", found.p99(), self.p99), found.most.ray));
        }
        let mut worst = |name: &str, found: Worst, allowed: f64| {
            if found.error.is_nan() || found.error > allowed {
                breaches.push((format!("{name} {:e}, allowed {allowed:e}", found.error), found.ray));
            }
        };
        worst("most ulp", found.most, self.most);
        worst("u * condition", found.conditioned, self.conditioned);
        breaches
    }
}

/// What of a cell breaks the table: a missing row, or a breach with the ray that makes it.
#[must_use]
pub fn verdict(cell: Cell, measured: &Measured) -> Vec<String> {
    let name = format!("--leaf '{}' --corpus {}", KINDS[cell.leaf], cell.corpus.name());
    let judged = cell.arithmetics().flat_map(|arithmetic| {
        let found = &measured.statistics[arithmetic as usize];
        let Some(allowed) = allowed(cell, arithmetic) else {
            return vec![format!("{name} has no row for {}", arithmetic.name())];
        };
        let breaches = allowed.breaches(found).into_iter();
        let say = |(what, ray): (String, u64)| {
            let (arithmetic, trial) = (arithmetic.name(), cell.trial(ray));
            format!("{arithmetic}: {what}; ray {ray}, seen again by {name} --replay {ray}: {trial:?}")
        };
        breaches.map(say).collect()
    });
    judged.collect()
}

/// For each arithmetic, up to where errors need no condition to be known for certain to be allowed.
#[must_use]
pub fn floors(cell: Cell) -> [f64; 3] {
    Arithmetic::ALL.map(|arithmetic| allowed(cell, arithmetic).map_or(0.0, |allowed| allowed.conditioned / 4.0))
}

#[cfg(test)]
mod tests {
    use super::{Allowed, Statistics, Worst};

    const ALLOWED: Allowed = Allowed {
        wrong: 1e-3,
        p99: 4.0,
        most: 10.0,
        conditioned: 2.5,
    };

    fn found() -> Statistics {
        let mut found = Statistics::default();
        (found.rays, found.wrong) = (100_000, 100);
        found.most = Worst { error: 10.0, ray: 1 };
        found.conditioned = Worst { error: 2.5, ray: 1 };
        for _ in 0..100 {
            found.count(3.0);
        }
        found
    }

    #[test]
    fn what_is_allowed_is_no_breach_and_anything_more_is() {
        assert!(ALLOWED.breaches(&found()).is_empty());
        let worse: [fn(&mut Statistics); 5] = [
            |found| found.wrong = 200,
            |found| (0..3).for_each(|_| found.count(5.0)),
            |found| found.most.error = 10.1,
            |found| found.conditioned.error = 2.6,
            |found| found.conditioned.error = f64::NAN,
        ];
        for worsen in worse {
            let mut found = found();
            worsen(&mut found);
            assert_eq!(ALLOWED.breaches(&found).len(), 1);
        }
    }
}
