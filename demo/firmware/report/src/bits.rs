//! Whether all boards computed the same bits.

use std::collections::{BTreeMap, BTreeSet};

use crate::records::Records;

/// What a board need not compute: the scenes of hundreds of leaves take more memory than the micro:bit has.
const TOO_LARGE: [(&str, &[&str]); 1] = [("cortex-m0", &["s4", "s5"])];

/// The table of hashes, and what is wrong with them, each a sentence.
///
/// Images whose names agree up to the first hyphen, such as `bits`, `bits-fpu` and `bits-debug`, compute the same rows.
pub(crate) fn check(boards: &BTreeSet<String>, printed: &BTreeMap<(String, String), Records>) -> (Vec<Vec<String>>, Vec<String>) {
    let mut images: BTreeSet<&str> = BTreeSet::new();
    let mut families: BTreeMap<&str, BTreeMap<&str, u64>> = BTreeMap::new();
    for ((_, image), records) in printed {
        for (name, hash) in &records.hashes {
            images.insert(image);
            families.entry(family(image)).or_default().entry(name).or_insert(hash.value);
        }
    }
    let (mut table, mut failures) = (Vec::new(), Vec::new());
    if images.is_empty() {
        failures.push("no board printed any bits".to_owned());
    }
    for (board, image) in boards.iter().flat_map(|board| images.iter().map(move |image| (board, *image))) {
        let records = printed.get(&(board.clone(), image.to_owned()));
        let (mut equal, mut note) = (0, Vec::new());
        for (name, value) in &families[family(image)] {
            let excused = TOO_LARGE.iter().any(|(small, rows)| small == board && rows.contains(name));
            match records.and_then(|records| records.hashes.get(*name)) {
                Some(hash) if !hash.ok => failures.push(format!("{board}, {image}: {name} has not the committed bits")),
                Some(hash) if hash.value != *value => {
                    failures.push(format!("{board}, {image}: {name} has other bits than elsewhere"));
                }
                Some(_) => equal += 1,
                None if excused => note.push(*name),
                None => failures.push(format!("{board}, {image}: {name} is missing, which others have")),
            }
        }
        let note = if note.is_empty() {
            String::new()
        } else {
            format!("no memory for {}", note.join(", "))
        };
        table.push(vec![board.clone(), image.to_owned(), equal.to_string(), note]);
    }
    (table, failures)
}

/// What the images have in common that compute the same rows.
fn family(image: &str) -> &str {
    image.split('-').next().unwrap_or(image)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::records;

    /// The failures of boards that printed such lines, both with optimisation and without.
    fn failures(boards: &[(&str, &str)]) -> Vec<String> {
        let mut printed = BTreeMap::new();
        for (board, text) in boards {
            for image in ["bits", "bits-debug"] {
                let records = records::parse(board, "x.txt", text).expect("these records are well-formed");
                printed.insert(((*board).to_owned(), image.to_owned()), records);
            }
            let other = records::parse(board, "x.txt", "bits other 0000000000000001 ok\n").expect("this record is well-formed");
            printed.insert(((*board).to_owned(), "device".to_owned()), other);
        }
        check(&boards.iter().map(|(board, _)| (*board).to_owned()).collect(), &printed).1
    }

    const S1: &str = "bits s1 00000000000000ff ok\n";
    const S4: &str = "bits s4 000000000000000f ok\n";

    #[test]
    fn equal_bits_pass() {
        assert!(failures(&[("cortex-m3", S1), ("cortex-m4f", S1)]).is_empty());
    }

    #[test]
    fn bad_bits_fail_and_so_do_other_bits_that_are_called_right() {
        assert_eq!(failures(&[("cortex-m3", "bits s1 00000000000000ff BAD\n")]).len(), 2);
        assert_eq!(
            failures(&[("cortex-m3", S1), ("cortex-m4f", "bits s1 00000000000000fe ok\n")]).len(),
            2
        );
    }

    #[test]
    fn a_missing_row_fails_unless_the_board_lacks_the_memory() {
        let both = format!("{S1}{S4}");
        assert_eq!(failures(&[("cortex-m3", &both), ("cortex-m4f", S1)]).len(), 2);
        assert!(failures(&[("cortex-m3", &both), ("cortex-m0", S1)]).is_empty());
        assert_eq!(failures(&[("cortex-m3", &both), ("cortex-m0", S4)]).len(), 2);
        assert_eq!(check(&BTreeSet::new(), &BTreeMap::new()).1, ["no board printed any bits"]);
    }
}
