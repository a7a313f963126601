//! The empty image: start-up code and panic handler alone. Its size is subtracted from that of `scene`.

#![no_std]
#![no_main]

#[cortex_m_rt::entry]
fn main() -> ! {
    gsdf_firmware::stop()
}
