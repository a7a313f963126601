//! The five scenes on which other renderers were measured, coloured: their solids and cameras are those of `gsdf-workload`,
//! which every target is held against.

use super::{Look, Scene, valid};
use crate::palette;
use gsdf_workload::scenes::{self as bare, cell, kind, size_class};

pub use gsdf_workload::scenes::{BALL_ON_GROUND, PART};

/// A scene with its colours.
fn coloured(bare: &bare::Scene, title: &'static str, look: Look) -> Scene {
    Scene {
        name: bare.name,
        title,
        nodes: bare.program.nodes().to_vec(),
        poses: Vec::new(),
        camera: valid(bare.camera()),
        look,
    }
}

/// S1: a ball on the ground. Two leaves.
#[must_use]
pub fn s1() -> Scene {
    coloured(
        &bare::S1,
        "a ball on the ground",
        Look {
            paint: |leaf| if leaf == 0 { palette::CORAL } else { palette::GROUND },
            haze: 16.0,
            ..Look::OUTDOORS
        },
    )
}

/// S2: one part, in four operations from five leaves.
#[must_use]
pub fn s2() -> Scene {
    coloured(
        &bare::S2,
        "a drilled and rounded cube",
        Look {
            paint: |leaf| match leaf {
                0 => palette::SLATE,
                1 => palette::SAND,
                _ => palette::CORAL,
            },
            ..Look::OUTDOORS
        },
    )
}

/// S3: 4 x 4 x 4 spheres, boxes, capsules and cones by turns. 64 leaves.
#[must_use]
pub fn s3() -> Scene {
    coloured(
        &bare::S3,
        "a grid of four kinds of solids",
        Look {
            paint: |leaf| palette::FOUR[kind(cell::<4, 4>(leaf)) as usize],
            ..Look::OUTDOORS
        },
    )
}

/// S4: 16 x 16 x 16 spheres of ten sizes. 4096 leaves.
#[must_use]
pub fn s4() -> Scene {
    coloured(
        &bare::S4,
        "4096 spheres of ten sizes",
        Look {
            paint: |leaf| palette::ramp(size_class(cell::<16, 16>(leaf)) as f32 / 9.0),
            haze: 90.0,
            ..Look::OUTDOORS
        },
    )
}

/// S5: 16 x 16 [parts](PART) in a plane. 1280 leaves.
#[must_use]
pub fn s5() -> Scene {
    coloured(
        &bare::S5,
        "256 drilled and rounded cubes",
        Look {
            paint: |leaf| {
                let [i, _, k] = cell::<1, 16>(leaf / 5);
                match leaf % 5 {
                    // Across the field from one colour to the other.
                    0 | 1 => palette::ramp((i + k) as f32 / 30.0),
                    _ => palette::INK,
                }
            },
            haze: 240.0,
            ..Look::OUTDOORS
        },
    )
}
