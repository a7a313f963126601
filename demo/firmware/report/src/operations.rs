//! How many divisions and square roots the measured queries take: what an estimate of cycles needs beside instructions.
//!
//! Counted here and not on a board: the same text in the same arithmetic does the same operations everywhere.

use anyhow::Result;
use gsdf_counted::{Counted, Operations, counting};
use gsdf_workload::costs::{self, Item, Meter};

use crate::ledger::{Key, Rows};

/// The rows of all queries of `costs`, per query, under the name of `board`.
pub(crate) fn rows(board: &str) -> Result<Rows> {
    let mut tally = Tally {
        board,
        queries: 0,
        operations: Operations::default(),
        rows: Rows::new(),
    };
    costs::of_everything::<Counted>("", &mut tally)?;
    Ok(tally.rows)
}

struct Tally<'a> {
    board: &'a str,
    queries: u64,
    operations: Operations,
    rows: Rows,
}

impl Meter for Tally<'_> {
    fn query<R>(&mut self, query: impl FnOnce() -> R) -> R {
        let (result, operations) = counting(query);
        self.queries += 1;
        self.operations += operations;
        result
    }

    fn finish(&mut self, item: &Item) {
        for (unit, count) in [("divisions", self.operations.divisions), ("roots", self.operations.square_roots)] {
            let key = Key {
                board: self.board.to_owned(),
                item: item.to_string(),
                unit: unit.to_owned(),
            };
            self.rows.insert(key, crate::records::per_query(count, self.queries));
        }
        (self.queries, self.operations) = (0, Operations::default());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sphere_takes_a_root_and_a_plane_none() -> Result<()> {
        let rows = rows("m")?;
        let of = |item: &str, unit: &str| {
            let (board, item, unit) = ("m".to_owned(), item.to_owned(), unit.to_owned());
            rows[&Key { board, item, unit }]
        };
        assert_eq!(of("leaf/sphere/sdf", "roots"), 1.0);
        assert_eq!(of("leaf/half-space/gsdf", "roots"), 0.0);
        // A ray that misses the sphere takes no root.
        assert!((0.2..1.0).contains(&of("leaf/sphere/gsdf", "roots")));
        assert!(of("scene/s1/traced", "roots") > of("scene/s1/closed", "roots"));
        Ok(())
    }
}
