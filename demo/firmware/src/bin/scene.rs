//! One ray cast at a constant scene on a Cortex-M. Its size less that of `baseline` is what this costs in flash.

#![no_std]
#![no_main]

use core::hint::black_box;

use glam::Vec3;

/// Distance from `origin` to the scene along `direction`.
fn distance(origin: Vec3, direction: Vec3) -> f32 {
    origin.dot(direction)
}

#[cortex_m_rt::entry]
fn main() -> ! {
    // Neither the ray nor the result may be known to the compiler, or it would compute the distance itself.
    let (origin, direction) = black_box((Vec3::new(0.0, 0.0, -3.0), Vec3::Z));
    black_box(distance(origin, direction));
    gsdf_firmware::stop()
}
