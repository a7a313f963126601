//! A device as one would build it: a scene in flash, drawn on a small display, and seen by a time-of-flight sensor, at
//! two angles of a turntable; printed, and held against its committed hash.
#![no_std]
#![no_main]

use core::fmt::{self, Display, Formatter, Write};
use embedded_graphics::framebuffer::Framebuffer;
use embedded_graphics::geometry::Point;
use embedded_graphics::image::GetPixel;
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::pixelcolor::raw::{LittleEndian, RawU1};
use gsdf_firmware::board::{self, println};
use gsdf_parts::device::{DeviceError, GOLDEN, HEIGHT, MEMORY, STOPS, WIDTH, draw, read, record, turned};
use gsdf_parts::{Fpu, RangeFinder, braille, millimetres};
use gsdf_workload::digest::Digest;

/// The display's memory: 1 KB, one bit per pixel.
type Screen = Framebuffer<BinaryColor, RawU1, LittleEndian, { WIDTH as usize }, { HEIGHT as usize }, MEMORY>;

#[board::entry]
fn main() -> ! {
    let mut digest = Digest::new();
    for stop in STOPS {
        if let Err(error) = turn_to(stop, &mut digest) {
            println!("device: {error}");
            board::exit(false);
        }
    }
    let hash = digest.finish();
    let verdict = if hash == GOLDEN { "ok" } else { "BAD" };
    println!("bits device {hash:016x} {verdict}");
    board::exit(hash == GOLDEN)
}

/// Turns the turntable, draws it, measures it, and prints both.
fn turn_to(stop: (f32, f32), digest: &mut Digest) -> Result<(), DeviceError<core::convert::Infallible>> {
    let pose = turned(stop).map_err(DeviceError::Invalid)?;
    let mut screen = Screen::new();
    draw(pose, Fpu(0.0), &mut screen)?;
    let distances = read(pose, Fpu(0.0))?;
    for row in 0..HEIGHT / 4 {
        println!("{}", Line(&screen, row as i32));
    }
    println!("distances in mm:");
    for row in distances.chunks(RangeFinder::SIDE) {
        println!("{}", Zones(row));
    }
    record(digest, screen.data(), &distances);
    Ok(())
}

/// Four rows of the display as one line of text.
struct Line<'a>(&'a Screen, i32);

impl Display for Line<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self(screen, row) = self;
        (0..WIDTH as i32 / 2).try_for_each(|column| {
            f.write_char(braille(Point::new(column, *row), |pixel| {
                screen.pixel(pixel) == Some(BinaryColor::On)
            }))
        })
    }
}

/// A row of the sensor's zones.
struct Zones<'a>(&'a [f32]);

impl Display for Zones<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|&metres| match millimetres(metres) {
            u16::MAX => f.write_str("    -"),
            millimetres => write!(f, " {millimetres:4}"),
        })
    }
}
