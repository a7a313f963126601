//! The meter of the images that count: instructions.

use gsdf_workload::costs::{Item, Meter};

use crate::board::{self, println};

/// What an arithmetic with the square root of the FPU is called in records, where it has one.
pub const FPU: &str = "fpu";

/// The instructions of some queries; printed as a record, and begun anew, with each item.
#[derive(Default)]
pub struct Instructions {
    queries: u32,
    instructions: u64,
}

impl Meter for Instructions {
    fn query<R>(&mut self, query: impl FnOnce() -> R) -> R {
        let (result, instructions) = board::instructions_of(query);
        self.queries += 1;
        self.instructions += instructions;
        result
    }

    fn finish(&mut self, item: &Item) {
        println!("cost {item} {} {}", self.queries, self.instructions);
        *self = Self::default();
    }
}
