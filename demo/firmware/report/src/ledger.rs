//! The recorded figures, and what has become of them: the guard against growth.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context as _, Result, ensure};

/// By how much a figure may change before it counts: 5 %.
const TOLERANCE: f64 = 0.05;

const HEADER: [&str; 4] = ["board", "item", "unit", "figure"];

/// What a figure is of.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Key {
    pub(crate) board: String,
    pub(crate) item: String,
    pub(crate) unit: String,
}

/// Figures, with one decimal each.
pub(crate) type Rows = BTreeMap<Key, f64>;

/// The committed file of figures.
#[derive(Debug, PartialEq)]
pub(crate) struct Ledger {
    /// The compiler and the emulator they were taken with.
    pub(crate) origin: String,
    pub(crate) rows: Rows,
}

impl Ledger {
    /// Reads `text`, which came from the file `name`.
    pub(crate) fn parse(name: &str, text: &str) -> Result<Self> {
        let first = text.lines().next().unwrap_or_default();
        let origin = first
            .strip_prefix("# ")
            .with_context(|| format!("{name}:1: no comment that names the compiler"))?;
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let header = reader.headers().with_context(|| format!("{name}:2"))?;
        ensure!(header == HEADER.as_slice(), "{name}:2: the columns are not {}", HEADER.join(","));
        let mut rows = Rows::new();
        for record in reader.records() {
            let record = record.with_context(|| name.to_owned())?;
            let line = record.position().map_or(0, csv::Position::line);
            let figure: f64 = record[3]
                .parse()
                .with_context(|| format!("{name}:{line}: '{}' is no figure", &record[3]))?;
            ensure!(figure.is_finite() && figure >= 0.0, "{name}:{line}: a figure cannot be {figure}");
            let key = Key {
                board: record[0].to_owned(),
                item: record[1].to_owned(),
                unit: record[2].to_owned(),
            };
            ensure!(rows.insert(key, figure).is_none(), "{name}:{line}: this figure is given twice");
        }
        Ok(Self {
            origin: origin.to_owned(),
            rows,
        })
    }

    /// What [`Self::parse`] reads.
    pub(crate) fn write(&self) -> Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(HEADER)?;
        for (key, figure) in &self.rows {
            writer.write_record([&key.board, &key.item, &key.unit, &figure.to_string()])?;
        }
        Ok(format!("# {}\n{}", self.origin, String::from_utf8(writer.into_inner()?)?))
    }
}

/// What became of the recorded figures, each a sentence.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Changes {
    /// What must not be.
    pub(crate) failures: Vec<String>,
    /// What is worth recording.
    pub(crate) gains: Vec<String>,
}

/// Compares `measured` with `recorded`; of `recorded` only the figures of `boards`, which were measured.
///
/// The bytes by source file are recorded to be read and may change: their sum is held.
pub(crate) fn compare(recorded: &Rows, measured: &Rows, boards: &BTreeSet<String>) -> Changes {
    let mut changes = Changes::default();
    let held = |key: &&Key| boards.contains(&key.board) && !key.item.starts_with("source/");
    let keys: BTreeSet<&Key> = recorded.keys().chain(measured.keys()).filter(held).collect();
    for key in keys {
        let Key { board, item, unit } = key;
        match (recorded.get(key), measured.get(key)) {
            (Some(before), Some(now)) => {
                let percent = if *before == 0.0 {
                    String::new()
                } else {
                    format!(" ({:+.1} %)", (now / before - 1.0) * 100.0)
                };
                let change = format!("{board}, {item}: {before} {unit} recorded, {now} measured{percent}");
                if *now > before * (1.0 + TOLERANCE) {
                    changes
                        .failures
                        .push(format!("{change}: if that is meant, run demo/firmware/run --record"));
                } else if *now < before * (1.0 - TOLERANCE) {
                    changes.gains.push(change);
                }
            }
            (Some(before), None) => changes
                .failures
                .push(format!("{board}, {item}: {before} {unit} recorded, none measured")),
            (None, Some(now)) => changes.failures.push(format!(
                "{board}, {item}: {now} {unit} measured, none recorded: run demo/firmware/run --record"
            )),
            (None, None) => {}
        }
    }
    changes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(rows: &[(&str, f64)]) -> Rows {
        let key = |item: &str| Key {
            board: "m".into(),
            item: item.into(),
            unit: "bytes".into(),
        };
        rows.iter().map(|(item, figure)| (key(item), *figure)).collect()
    }

    fn changes(recorded: &[(&str, f64)], measured: &[(&str, f64)]) -> (usize, usize) {
        let changes = compare(&rows(recorded), &rows(measured), &BTreeSet::from(["m".to_owned()]));
        (changes.failures.len(), changes.gains.len())
    }

    #[test]
    fn growth_beyond_five_percent_fails() {
        assert_eq!(changes(&[("a", 100.0)], &[("a", 105.0)]), (0, 0));
        assert_eq!(changes(&[("a", 100.0)], &[("a", 105.1)]), (1, 0));
        assert_eq!(changes(&[("a", 0.0)], &[("a", 0.1)]), (1, 0));
        assert_eq!(changes(&[("a", 0.0)], &[("a", 0.0)]), (0, 0));
    }

    #[test]
    fn shrinking_is_only_reported() {
        assert_eq!(changes(&[("a", 100.0)], &[("a", 95.0)]), (0, 0));
        assert_eq!(changes(&[("a", 100.0)], &[("a", 94.9)]), (0, 1));
    }

    #[test]
    fn what_is_missing_on_either_side_fails() {
        assert_eq!(changes(&[("a", 1.0)], &[]), (1, 0));
        assert_eq!(changes(&[], &[("a", 1.0)]), (1, 0));
    }

    #[test]
    fn boards_not_measured_and_bytes_by_source_are_not_held() {
        let changes = compare(&rows(&[("a", 1.0)]), &Rows::new(), &BTreeSet::new());
        assert_eq!(changes, Changes::default());
        assert_eq!(
            self::changes(&[("source/spheres/glam", 1.0)], &[("source/spheres/glam", 9.0)]),
            (0, 0)
        );
    }

    #[test]
    fn a_failure_names_all_there_is_to_know() {
        let changes = compare(&rows(&[("a", 100.0)]), &rows(&[("a", 110.0)]), &BTreeSet::from(["m".to_owned()]));
        let expected = "m, a: 100 bytes recorded, 110 measured (+10.0 %): if that is meant, run demo/firmware/run --record";
        assert_eq!(changes.failures, [expected]);
    }

    #[test]
    fn what_is_written_is_read_back() {
        let ledger = Ledger {
            origin: "rustc 1, QEMU 2".into(),
            rows: rows(&[("a", 0.1), ("b", 12345.6)]),
        };
        let text = ledger.write().expect("plain figures can be written");
        assert_eq!(Ledger::parse("costs.csv", &text).expect("it is what was written"), ledger);
        assert_eq!(
            text,
            "# rustc 1, QEMU 2\nboard,item,unit,figure\nm,a,bytes,0.1\nm,b,bytes,12345.6\n"
        );
    }

    #[test]
    fn what_is_malformed_is_an_error_with_its_line() {
        let header = "# rustc\nboard,item,unit,figure\nm,a,bytes,1\n";
        for (text, place) in [
            (String::new(), "f:1"),
            ("board,item,unit,figure\n".into(), "f:1"),
            ("# rustc\nboard,item,figure\n".into(), "f:2"),
            (format!("{header}m,b,bytes,x\n"), "f:4"),
            (format!("{header}m,b,bytes,-1\n"), "f:4"),
            (format!("{header}m,b,bytes,NaN\n"), "f:4"),
            (format!("{header}m,a,bytes,2\n"), "f:4"),
            (format!("{header}m,b,bytes\n"), "line: 4"),
        ] {
            let error = format!("{:#}", Ledger::parse("f", &text).expect_err(&text));
            assert!(error.contains(place), "{error}");
        }
    }
}
