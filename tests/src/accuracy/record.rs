//! The record: what was measured so far, in a file that later runs go on with.

use super::corpus::Corpus;
use super::measure::{Cell, Floor, Measured};
use super::statistics::{Summary, Worst};
use super::trial::Arithmetic;
use crate::shape::KINDS;
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;

/// The names of the columns.
const COLUMNS: [&str; 12] = [
    "leaf",
    "corpus",
    "arithmetic",
    "rays",
    "wrong",
    "first_wrong",
    "wrong_share",
    "p99_ulp",
    "most_ulp",
    "most_ray",
    "u_condition",
    "u_condition_ray",
];

/// A row of the table: the cell, and the arithmetic.
type Key = (Cell, Arithmetic);

/// What was measured so far, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Record(BTreeMap<Key, Summary>);

impl Record {
    /// The record in a file; an empty one where there is no such file.
    ///
    /// # Errors
    /// Where the file cannot be read, or holds something else.
    pub fn read(path: &Path) -> Result<Self, Box<dyn Error>> {
        if !path.exists() {
            return Ok(Self::default());
        }
        let mut rows = csv::Reader::from_path(path)?;
        if rows.headers()? != COLUMNS[..] {
            return Err(format!("{}: its columns are not those of a record: {}", path.display(), COLUMNS.join(",")).into());
        }
        let mut record = BTreeMap::new();
        for row in rows.records() {
            let row = row?;
            let (key, summary) = parsed(&row).ok_or_else(|| format!("{}: no row of a record: {row:?}", path.display()))?;
            record.insert(key, summary);
        }
        Ok(Self(record))
    }

    /// Writes the record to a file, which at no time is half of one.
    ///
    /// # Errors
    /// Where that cannot be done.
    pub fn write(&self, path: &Path) -> Result<(), Box<dyn Error>> {
        let whole = path.with_extension("new");
        let mut rows = csv::Writer::from_path(&whole)?;
        rows.write_record(COLUMNS)?;
        for ((cell, arithmetic), found) in &self.0 {
            rows.write_record([
                KINDS[cell.leaf].to_owned(),
                cell.corpus.name().to_owned(),
                arithmetic.name().to_owned(),
                found.rays.to_string(),
                found.wrong.to_string(),
                found.first_wrong.map_or_else(String::new, |ray| ray.to_string()),
                format!("{:.4e}", found.wrong_share),
                format!("{:.4e}", found.p99),
                format!("{:.4e}", found.most.error),
                found.most.ray.to_string(),
                format!("{:.4e}", found.conditioned.error),
                found.conditioned.ray.to_string(),
            ])?;
        }
        rows.flush()?;
        drop(rows);
        Ok(std::fs::rename(whole, path)?)
    }

    /// The record of rays of one cell.
    #[must_use]
    pub fn of(cell: Cell, measured: &Measured) -> Self {
        let mut record = Self::default();
        record.add(cell, measured);
        record
    }

    /// What is recorded of a row.
    #[must_use]
    pub fn get(&self, cell: Cell, arithmetic: Arithmetic) -> Option<&Summary> {
        self.0.get(&(cell, arithmetic))
    }

    /// The rays of a cell that are in the record: the first so many.
    #[must_use]
    pub fn rays(&self, cell: Cell) -> u64 {
        let rays = cell
            .arithmetics()
            .map(|arithmetic| self.get(cell, arithmetic).map_or(0, |found| found.rays));
        rays.min().unwrap_or_default()
    }

    /// For each arithmetic the largest errors recorded.
    #[must_use]
    pub fn floors(&self, cell: Cell) -> [Floor; 3] {
        let largest = |found: &Summary| Floor {
            most: found.most.error,
            conditioned: found.conditioned.error,
        };
        Arithmetic::ALL.map(|arithmetic| self.get(cell, arithmetic).map(largest).unwrap_or_default())
    }

    /// Takes further rays of a cell into the record.
    pub fn add(&mut self, cell: Cell, measured: &Measured) {
        for arithmetic in cell.arithmetics() {
            let more = measured.statistics[arithmetic as usize].summary();
            self.0
                .entry((cell, arithmetic))
                .and_modify(|found| *found = found.joined(&more))
                .or_insert(more);
        }
    }
}

fn parsed(row: &csv::StringRecord) -> Option<(Key, Summary)> {
    let cell = Cell {
        leaf: KINDS.iter().position(|kind| *kind == &row[0])?,
        corpus: Corpus::named(&row[1])?,
    };
    let arithmetic = Arithmetic::ALL.into_iter().find(|arithmetic| arithmetic.name() == &row[2])?;
    let worst = |error: usize| {
        Some(Worst {
            error: row[error].parse().ok()?,
            ray: row[error + 1].parse().ok()?,
        })
    };
    let summary = Summary {
        rays: row[3].parse().ok()?,
        wrong: row[4].parse().ok()?,
        first_wrong: if row[5].is_empty() { None } else { Some(row[5].parse().ok()?) },
        wrong_share: row[6].parse().ok()?,
        p99: row[7].parse().ok()?,
        most: worst(8)?,
        conditioned: worst(10)?,
    };
    Some(((cell, arithmetic), summary))
}

#[cfg(test)]
mod tests {
    use super::{Cell, Record};

    /// In slices or at once, with a file between or without: the record is the same.
    #[test]
    fn a_run_can_be_continued() {
        let path = std::env::temp_dir().join(format!("gsdf-record-{}.csv", std::process::id()));
        let cells = || Cell::all().step_by(29).take(4);
        let mut whole = Record::default();
        for cell in cells() {
            whole.add(cell, &cell.measure(0..640, whole.floors(cell)));
        }
        for end in [256, 300, 640] {
            let mut record = Record::read(&path).unwrap();
            for cell in cells() {
                record.add(cell, &cell.measure(record.rays(cell)..end, record.floors(cell)));
            }
            record.write(&path).unwrap();
        }
        let sliced = Record::read(&path).unwrap();
        std::fs::remove_file(&path).unwrap();
        for (key, found) in &whole.0 {
            let other = &sliced.0[key];
            assert_eq!(
                (other.rays, other.wrong, other.first_wrong),
                (640, found.wrong, found.first_wrong),
                "{key:?}"
            );
            let close = |a: f64, b: f64| (a - b).abs() <= a * 1e-4;
            assert!(close(found.most.error, other.most.error) && close(found.conditioned.error, other.conditioned.error));
            // The largest of any slice: not less than that of the whole, unless each has too few crossings.
            assert!(
                (other.p99 == 0.0 || other.p99 >= found.p99 * 0.999) && other.wrong_share >= found.wrong_share * 0.999,
                "{key:?}"
            );
        }
        assert!(Record::read(&std::env::current_exe().unwrap()).is_err());
    }
}
