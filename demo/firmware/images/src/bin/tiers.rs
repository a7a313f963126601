//! Prints what a ray costs in each tier in instructions, and how far off its answers are, as the board itself finds.
#![no_std]
#![no_main]

use gsdf_firmware::board::{self, println};
use gsdf_firmware::{FPU, Instructions};
use gsdf_parts::Fpu;
use gsdf_workload::costs::{CostError, Item};
use gsdf_workload::tiers::{self, Accuracy};

fn tell(item: &Item, accuracy: &Accuracy) {
    println!("wrong {item} {}", accuracy.wrong);
    // In thousandths: records hold whole numbers.
    println!("ulps {item} {}", (accuracy.ulps * 1000.0 + 0.5) as u64);
    if let Some(rays) = accuracy.doubtful {
        println!("doubtful {item} {rays}");
    }
}

fn measure() -> Result<(), CostError> {
    let mut meter = Instructions::default();
    tiers::costs_in_single::<f32>("", &mut meter)?;
    if Fpu::HAS_ROOT {
        tiers::costs_in_single::<Fpu>(FPU, &mut meter)?;
    }
    tiers::costs_in_double(&mut meter)?;
    tiers::accuracies(tell)
}

#[board::entry]
fn main() -> ! {
    let outcome = measure();
    if let Err(error) = &outcome {
        println!("{error}");
    }
    board::exit(outcome.is_ok())
}
