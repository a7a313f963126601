//! What an image for a microcontroller holds, and what its queries cost: tables, and a guard against growth.

fn main() {}
