//! The table: what is allowed in every cell, and whether what was measured is.

use super::corpus::Corpus;
use super::measure::{Cell, Floor, PART, RAYS_AT_ONE, WELL_CONDITIONED, is_curved};
use super::record::Record;
use super::statistics::{Summary, Worst};
use super::trial::Arithmetic;
use crate::shape::KINDS;
use std::error::Error;
use std::io::Write;
use std::sync::LazyLock;

/// The rows of the table, which `accuracy --bounds` makes of the record.
static BOUNDS: &str = include_str!("../../accuracy-bounds.csv");

/// The names of its columns.
const COLUMNS: [&str; 7] = ["leaf", "corpus", "arithmetic", "wrong_share", "p99_ulp", "most_ulp", "u_condition"];

/// How many rays of a cell must have been measured for a bound to follow from them.
pub const LEAST_RAYS: u64 = 1_000_000;

/// By how much a bound that nothing derives is larger than what was measured.
const ROOM: f64 = 4.0;

/// By how much the largest errors of textbook formulas may exceed what was measured. They are the larger the nearer a ray
/// grazes: the largest of three million rays is well beyond that of one million.
const ROOM_OF_PLAIN: f64 = 16.0;

/// What textbook formulas may lose anywhere, in units roundoff: half of the digits. Their discriminant is off by some `k` units
/// roundoff `u` of `B² + A |C|`, so that a root near zero of it is off by `√(k u)` of the size of `B`, which is `√(k / u)` units: 2^12
/// times 8, as none is off by more than `k = 64`.
const HALF_OF_THE_DIGITS: f64 = 32_768.0;

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

/// A row of the table.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    leaf: String,
    corpus: String,
    arithmetic: String,
    allowed: Allowed,
}

fn rows() -> &'static [Row] {
    static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| parsed(BOUNDS).expect("the committed bounds are a table"));
    &ROWS
}

fn parsed(text: &str) -> Result<Vec<Row>, Box<dyn Error>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    if reader.headers()? != COLUMNS[..] {
        return Err("the columns are not those of bounds".into());
    }
    let row = |row: Result<csv::StringRecord, csv::Error>| {
        let row = row?;
        let number = |column: usize| row[column].parse::<f64>();
        Ok(Row {
            leaf: row[0].to_owned(),
            corpus: row[1].to_owned(),
            arithmetic: row[2].to_owned(),
            allowed: Allowed {
                wrong: number(3)?,
                p99: number(4)?,
                most: number(5)?,
                conditioned: number(6)?,
            },
        })
    };
    reader.records().map(row).collect()
}

/// What is allowed in a cell, if it has a row.
#[must_use]
pub fn allowed(cell: Cell, arithmetic: Arithmetic) -> Option<Allowed> {
    let key = names(cell, arithmetic);
    let row = rows()
        .iter()
        .find(|row| (row.leaf.as_str(), row.corpus.as_str(), row.arithmetic.as_str()) == key)?;
    Some(row.allowed)
}

fn names(cell: Cell, arithmetic: Arithmetic) -> (&'static str, &'static str, &'static str) {
    (KINDS[cell.leaf], cell.corpus.name(), arithmetic.name())
}

/// The rows that no cell has: of an unknown name, or where there are no such rays.
#[must_use]
pub fn strays() -> Vec<String> {
    let known: Vec<_> = Cell::all()
        .flat_map(|cell| cell.arithmetics().map(move |arithmetic| names(cell, arithmetic)))
        .collect();
    let is_stray = |row: &&Row| !known.contains(&(&row.leaf, &row.corpus, &row.arithmetic));
    rows()
        .iter()
        .filter(is_stray)
        .map(|row| format!("{} {} {}", row.leaf, row.corpus, row.arithmetic))
        .collect()
}

/// A figure of the page `numerics` of the library's documentation, in units roundoff of the condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Figure {
    /// All roundings are counted there: no crossing exceeds it.
    Counted(f64),
    /// The first order of what is counted: it holds where not even half of it was seen.
    Expected(f64),
}

impl Figure {
    /// The figure of a kind of leaf.
    #[must_use]
    pub fn of(leaf: usize) -> Self {
        match KINDS[leaf] {
            "half-space" | "cuboid" => Self::Counted(3.0),
            "sphere" => Self::Counted(6.0),
            "cylinder" | "capped cylinder" | "capsule" | "rhombus" => Self::Expected(4.5),
            _ if is_curved(leaf) => Self::Expected(20.0),
            _ => Self::Expected(4.0),
        }
    }

    /// The bound that it is for a row in which this was the largest, if it is one.
    fn bound(self, largest: f64) -> Option<f64> {
        let (figure, seen) = match self {
            Self::Counted(figure) => (figure, largest),
            Self::Expected(figure) => (figure, 2.0 * largest),
        };
        (seen <= figure).then_some(figure)
    }
}

impl Allowed {
    /// The bounds that follow from what was measured: of robust arithmetics the [`Figure`] of the leaf, where that is a
    /// bound, and else four times as much, rounded up to two digits; for the largest error in units in the last place what
    /// that makes of the worst condition; of textbook formulas half of the digits, or sixteen times what was measured. Nothing is held to less than one ray of a [`PART`], or all
    /// parallel ones at one solid, or to less than four units in the last place.
    #[must_use]
    pub fn following_from(found: &Summary, cell: Cell, arithmetic: Arithmetic) -> Self {
        let largest = found.conditioned.error;
        let (conditioned, most) = match arithmetic {
            Arithmetic::Plain => (
                rounded_up((ROOM_OF_PLAIN * largest).max(HALF_OF_THE_DIGITS)),
                rounded_up((ROOM_OF_PLAIN * found.most.error).max(HALF_OF_THE_DIGITS)),
            ),
            Arithmetic::Robust | Arithmetic::Double => {
                let figure = Figure::of(cell.leaf).bound(largest);
                let conditioned = figure.unwrap_or_else(|| rounded_up(ROOM * largest));
                // A unit roundoff of a number is at most a unit in its last place.
                (conditioned, rounded_up(WELL_CONDITIONED * conditioned))
            }
        };
        // Rays that are exactly parallel to a face of one solid, or but for denormal numbers, share its luck: if one may be wrong,
        // all may.
        let together = if matches!(cell.corpus, Corpus::Parallel | Corpus::Denormals) && found.wrong > 0 {
            RAYS_AT_ONE
        } else {
            1
        };
        Self {
            wrong: rounded_up((ROOM * found.wrong_share).max(together as f64 / PART as f64)).min(1.0),
            p99: rounded_up(ROOM * found.p99.max(1.0)),
            most,
            conditioned,
        }
    }

    /// Every way in which what was measured is more than allowed, with the number of the ray.
    #[must_use]
    pub fn breaches(&self, found: &Summary) -> Vec<(String, u64)> {
        let mut breaches = Vec::new();
        if found.wrong_share > self.wrong {
            let ray = found.first_wrong.unwrap_or_default();
            breaches.push((format!("{:e} of the rays wrong, allowed {:e}", found.wrong_share, self.wrong), ray));
        }
        if found.p99 > self.p99 {
            breaches.push((format!("p99 {:e} ulp, allowed {:e}", found.p99, self.p99), found.most.ray));
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

/// The least number of two digits that is not below this positive one.
fn rounded_up(number: f64) -> f64 {
    let unit = 10.0_f64.powf(number.log10().floor() - 1.0);
    // What is a number of two digits but for rounding counts as one.
    let rounded = (number / unit * (1.0 - 1e-12)).ceil() * unit;
    format!("{rounded:.1e}").parse().unwrap_or(rounded)
}

/// Writes the bounds that follow from a record.
///
/// # Errors
/// Where a cell is missing in the record or has too few rays, or the bounds cannot be written.
pub fn write_bounds(record: &Record, out: impl Write) -> Result<(), Box<dyn Error>> {
    let mut rows = csv::Writer::from_writer(out);
    rows.write_record(COLUMNS)?;
    for cell in Cell::all() {
        for arithmetic in cell.arithmetics() {
            let (leaf, corpus, name) = names(cell, arithmetic);
            let found = record
                .get(cell, arithmetic)
                .filter(|found| found.rays >= LEAST_RAYS)
                .ok_or_else(|| format!("{leaf} {corpus} {name}: fewer than {LEAST_RAYS} rays in the record"))?;
            let bounds = Allowed::following_from(found, cell, arithmetic);
            rows.write_record([
                leaf,
                corpus,
                name,
                &format!("{:e}", bounds.wrong),
                &format!("{:e}", bounds.p99),
                &format!("{:e}", bounds.most),
                &bounds.conditioned.to_string(),
            ])?;
        }
    }
    Ok(rows.flush()?)
}

/// What of a cell breaks the table: a missing row, or a breach with the ray that makes it.
#[must_use]
pub fn verdict(cell: Cell, record: &Record) -> Vec<String> {
    let name = format!("--leaf '{}' --corpus {}", KINDS[cell.leaf], cell.corpus.name());
    let judged = cell.arithmetics().flat_map(|arithmetic| {
        let Some(allowed) = allowed(cell, arithmetic) else {
            return vec![format!("{name} has no row for {}", arithmetic.name())];
        };
        let Some(found) = record.get(cell, arithmetic) else {
            return vec![format!("{name} was not measured for {}", arithmetic.name())];
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

/// For each arithmetic, up to where errors are allowed whatever they are exactly.
#[must_use]
pub fn floors(cell: Cell) -> [Floor; 3] {
    let certain = |allowed: Allowed| Floor {
        most: allowed.most / ROOM,
        conditioned: allowed.conditioned / ROOM,
    };
    Arithmetic::ALL.map(|arithmetic| allowed(cell, arithmetic).map(certain).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::{Allowed, Arithmetic, Cell, Corpus, Figure, Summary, Worst, rounded_up};

    const FOUND: Summary = Summary {
        rays: 100_000,
        wrong: 100,
        first_wrong: Some(3),
        wrong_share: 1e-3,
        p99: 3.9,
        most: Worst { error: 10.0, ray: 1 },
        conditioned: Worst { error: 2.5, ray: 1 },
    };

    #[test]
    fn what_is_allowed_is_no_breach_and_anything_more_is() {
        let allowed = Allowed {
            wrong: 1e-3,
            p99: 4.0,
            most: 10.0,
            conditioned: 2.5,
        };
        assert!(allowed.breaches(&FOUND).is_empty());
        let worse: [fn(&mut Summary); 5] = [
            |found| found.wrong_share = 1.1e-3,
            |found| found.p99 = 4.1,
            |found| found.most.error = 10.1,
            |found| found.conditioned.error = 2.6,
            |found| found.conditioned.error = f64::NAN,
        ];
        for worsen in worse {
            let mut found = FOUND;
            worsen(&mut found);
            assert_eq!(allowed.breaches(&found).len(), 1);
        }
    }

    #[test]
    fn bounds_are_derived_or_four_times_what_was_measured() {
        let sphere = Cell {
            leaf: 1,
            corpus: Corpus::Moderate,
        };
        let bounds = |found: &Summary, arithmetic| Allowed::following_from(found, sphere, arithmetic);
        let expected = Allowed {
            wrong: 4e-3,
            p99: 16.0,
            most: 390.0,
            conditioned: 6.0,
        };
        assert_eq!(bounds(&FOUND, Arithmetic::Robust), expected);
        let plain = bounds(&FOUND, Arithmetic::Plain);
        assert_eq!((plain.most, plain.conditioned), (33_000.0, 33_000.0));
        let mut worse = FOUND;
        worse.conditioned.error = 6.1;
        assert_eq!(bounds(&worse, Arithmetic::Double).conditioned, 25.0);
        let none = bounds(
            &Summary {
                rays: 1_000_000,
                ..Summary::default()
            },
            Arithmetic::Robust,
        );
        assert_eq!((none.wrong, none.p99, none.most, none.conditioned), (3.1e-5, 4.0, 390.0, 6.0));
    }

    #[test]
    fn parallel_rays_at_one_solid_are_wrong_together() {
        let parallel = Cell {
            leaf: 17,
            corpus: Corpus::Parallel,
        };
        let few = Summary {
            wrong: 1,
            wrong_share: 3e-5,
            ..FOUND
        };
        let allowed = |found: &Summary| Allowed::following_from(found, parallel, Arithmetic::Double).wrong;
        assert_eq!(allowed(&few), 0.016);
        assert_eq!(
            allowed(&Summary {
                wrong: 0,
                wrong_share: 0.0,
                ..FOUND
            }),
            3.1e-5
        );
    }

    #[test]
    fn a_figure_that_is_expected_needs_room() {
        assert_eq!(Figure::Counted(3.5).bound(3.5), Some(3.5));
        assert_eq!(Figure::Expected(4.5).bound(2.25), Some(4.5));
        assert_eq!(Figure::Expected(4.5).bound(2.26), None);
    }

    #[test]
    fn bounds_have_two_digits() {
        for (number, rounded) in [
            (1.0, 1.0),
            (10.0, 10.0),
            (10.1, 11.0),
            (0.001_234, 0.0013),
            (9.91e7, 1e8),
            (4.4e-5, 4.4e-5),
        ] {
            assert_eq!(rounded_up(number), rounded);
        }
    }
}
