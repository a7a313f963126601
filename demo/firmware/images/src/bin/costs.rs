//! Prints what the queries of `gsdf_workload::costs` cost in instructions, and how much stack a cast takes.
#![no_std]
#![no_main]

use gsdf_firmware::balls::{EVERYTHING, SPHERES};
use gsdf_firmware::board::{self, println};
use gsdf_firmware::{FPU, Instructions, ask, ask_distance};
use gsdf_parts::Fpu;
use gsdf_workload::costs;

/// The stack of the queries of the images that are named.
fn measure_stack() {
    println!("stack spheres {}", board::stack_used_by(|| ask(&SPHERES)));
    println!("stack everything {}", board::stack_used_by(|| ask(&EVERYTHING)));
    println!("stack distance {}", board::stack_used_by(|| ask_distance::<4, 7, _>(&SPHERES)));
}

#[board::entry]
fn main() -> ! {
    measure_stack();
    let mut meter = Instructions::default();
    let mut outcome = costs::of_everything::<f32>("", &mut meter);
    if Fpu::HAS_ROOT {
        outcome = outcome.and_then(|()| costs::of_everything::<Fpu>(FPU, &mut meter));
    }
    if let Err(error) = &outcome {
        println!("{error}");
    }
    board::exit(outcome.is_ok())
}
