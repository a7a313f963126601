//! The records that boards print: one per line, fields separated by one space; any other line is chatter.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result, bail, ensure};

use crate::ledger::{Key, Rows};

/// The kinds of records, each the first word of its lines.
const KINDS: [&str; 6] = ["bits", "cost", "stack", "wrong", "ulps", "doubtful"];

/// The hash of one row of the reference scenes, as one image of one board computed it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Hash {
    pub(crate) value: u64,
    /// Whether the board found it to be the committed one.
    pub(crate) ok: bool,
}

/// What one image printed.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Records {
    /// By the name of the row.
    pub(crate) hashes: BTreeMap<String, Hash>,
    /// Figures for the board that was asked about.
    pub(crate) rows: Rows,
}

/// The records in `text`, which `board` printed and which came from the file `name`.
pub(crate) fn parse(board: &str, name: &str, text: &str) -> Result<Records> {
    let mut records = Records::default();
    for (line, number) in text.lines().zip(1..) {
        let fields: Vec<&str> = line.split(' ').collect();
        if KINDS.contains(&fields[0]) {
            add(&mut records, board, &fields).with_context(|| format!("{name}:{number}: in '{line}'"))?;
        }
    }
    Ok(records)
}

fn add(records: &mut Records, board: &str, fields: &[&str]) -> Result<()> {
    let mut row = |item: &str, unit: &str, figure: f64| -> Result<()> {
        let key = Key {
            board: board.to_owned(),
            item: item.to_owned(),
            unit: unit.to_owned(),
        };
        ensure!(records.rows.insert(key, figure).is_none(), "{item} has its {unit} given twice");
        Ok(())
    };
    match *fields {
        ["bits", name, hash, verdict] => {
            ensure!(hash.len() == 16, "the hash has {} digits instead of 16", hash.len());
            let value = u64::from_str_radix(hash, 16).context("the hash is not a hexadecimal number")?;
            let ok = match verdict {
                "ok" => true,
                "BAD" => false,
                _ => bail!("the verdict is '{verdict}', neither ok nor BAD"),
            };
            let twice = records.hashes.insert(named(name)?.to_owned(), Hash { value, ok });
            ensure!(twice.is_none(), "{name} has its bits given twice");
        }
        ["cost", item, queries, instructions] => {
            let (instructions, queries) = (count(instructions)?, count(queries)?);
            ensure!(queries > 0, "there were no queries");
            row(named(item)?, "instructions", per_query(instructions, queries))?;
        }
        ["wrong" | "doubtful", item, rays] => row(named(item)?, fields[0], count(rays)? as f64)?,
        ["ulps", item, thousandths] => row(named(item)?, "ulps", per_query(count(thousandths)?, 1000))?,
        ["stack", item, bytes] => row(&format!("stack/{}", named(item)?), "bytes", count(bytes)? as f64)?,
        _ => bail!("a record of this kind does not have {} fields", fields.len()),
    }
    Ok(())
}

/// A name must not break the table it is written to.
fn named(name: &str) -> Result<&str> {
    let plain = |letter: char| letter.is_ascii_alphanumeric() || "-_/.".contains(letter);
    ensure!(!name.is_empty() && name.chars().all(plain), "'{name}' is no name");
    Ok(name)
}

fn count(digits: &str) -> Result<u64> {
    digits.parse().with_context(|| format!("'{digits}' is no whole number"))
}

/// A mean, with one decimal.
pub(crate) fn per_query(total: u64, queries: u64) -> f64 {
    (total as f64 / queries as f64 * 10.0).round() / 10.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(text: &str, item: &str, unit: &str) -> f64 {
        let records = parse("m", "m.txt", text).expect("these records are well-formed");
        records.rows[&Key {
            board: "m".into(),
            item: item.into(),
            unit: unit.into(),
        }]
    }

    #[test]
    fn each_kind_is_read() {
        let text = "hello\nbits s1 00000000000000ff ok\nbits s2 0000000000000001 BAD\ncost leaf/sphere/gsdf 3 100\n\
                    stack spheres 312\nwrong tier/s1/fast 2\nulps tier/s1/fast 1250\ndoubtful tier/s1/certified 0\n";
        let records = parse("m", "m.txt", text).expect("these records are well-formed");
        assert_eq!(records.hashes["s1"], Hash { value: 255, ok: true });
        assert_eq!(records.hashes["s2"], Hash { value: 1, ok: false });
        assert_eq!(figure(text, "leaf/sphere/gsdf", "instructions"), 33.3);
        assert_eq!(figure(text, "stack/spheres", "bytes"), 312.0);
        assert_eq!(figure(text, "tier/s1/fast", "wrong"), 2.0);
        assert_eq!(figure(text, "tier/s1/fast", "ulps"), 1.3);
        assert_eq!(figure(text, "tier/s1/certified", "doubtful"), 0.0);
        assert_eq!(records.rows.len(), 5);
    }

    #[test]
    fn what_is_malformed_is_an_error_with_its_line() {
        for line in [
            "bits s1 00ff ok",
            "bits s1 000000000000zzzz ok",
            "bits s1 00000000000000ff fine",
            "bits s1 00000000000000ff",
            "cost leaf/a 0 1",
            "cost leaf/a 1",
            "cost leaf/a 1 -1",
            "cost leaf/a 1 1.5",
            "cost  leaf/a 1 1",
            "cost leaf/a,b 1 1",
            "stack a",
            "stack a many",
            "stack a 12 ",
            "wrong a",
            "doubtful a 1.5",
            "ulps a 0.5",
        ] {
            let error = parse("m", "m.txt", &format!("chatter\n{line}\n")).expect_err(line);
            assert!(format!("{error:#}").starts_with("m.txt:2: "), "{error:#}");
        }
    }

    #[test]
    fn a_figure_given_twice_is_an_error() {
        for line in ["stack a 1\n", "cost a 1 1\n", "bits s1 00000000000000ff ok\n"] {
            assert!(parse("m", "m.txt", &line.repeat(2)).is_err(), "{line}");
        }
    }
}
