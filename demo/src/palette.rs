//! The colours: few, muted, and linear until the last step.

use glam::{Vec3, vec3};

/// Warm red, for what matters in a picture.
pub const CORAL: Vec3 = vec3(0.68, 0.15, 0.10);
/// Muted blue.
pub const SLATE: Vec3 = vec3(0.09, 0.20, 0.36);
/// Pale yellow.
pub const SAND: Vec3 = vec3(0.74, 0.52, 0.24);
/// Grey-green.
pub const SAGE: Vec3 = vec3(0.25, 0.42, 0.30);
/// Bluish white.
pub const ICE: Vec3 = vec3(0.76, 0.82, 0.86);
/// Near black, for what is cut.
pub const INK: Vec3 = vec3(0.05, 0.06, 0.09);
/// What the others stand on.
pub const GROUND: Vec3 = vec3(0.50, 0.49, 0.46);

/// Four colours that keep apart.
pub const FOUR: [Vec3; 4] = [CORAL, SLATE, SAND, SAGE];

/// A colour from [`SLATE`] at 0 over [`SAGE`] and [`SAND`] to [`CORAL`] at 1.
#[must_use]
pub fn ramp(place: f32) -> Vec3 {
    // Blue straight to yellow would be grey half way.
    const STOPS: [Vec3; 4] = [SLATE, SAGE, SAND, CORAL];
    let place = 3.0 * place.clamp(0.0, 1.0);
    let from = (place as usize).min(2);
    STOPS[from].lerp(STOPS[from + 1], place - from as f32)
}

/// A linear colour as the three bytes of a picture, by the sRGB transfer function of IEC 61966-2-1. What is out of range is clipped.
#[must_use]
pub fn to_srgb(linear: Vec3) -> [u8; 3] {
    linear.to_array().map(|channel| {
        let channel = channel.clamp(0.0, 1.0);
        let encoded = if channel <= 0.003_130_8 {
            12.92 * channel
        } else {
            1.055 * channel.powf(1.0 / 2.4) - 0.055
        };
        // Between 0 and 255 by construction.
        (255.0 * encoded).round() as u8
    })
}

/// The linear colour of three bytes: [`to_srgb`] undone.
#[must_use]
pub fn from_srgb(bytes: [u8; 3]) -> Vec3 {
    Vec3::from(bytes.map(|byte| {
        let encoded = f32::from(byte) / 255.0;
        if encoded <= 0.040_45 {
            encoded / 12.92
        } else {
            ((encoded + 0.055) / 1.055).powf(2.4)
        }
    }))
}

#[cfg(test)]
mod tests {
    use super::{CORAL, SAGE, SAND, SLATE, from_srgb, ramp, to_srgb};
    use glam::{Vec3, vec3};

    #[test]
    fn srgb_has_its_known_values() {
        assert_eq!(to_srgb(Vec3::ZERO), [0; 3]);
        assert_eq!(to_srgb(Vec3::ONE), [255; 3]);
        // Half the light is not half the number, and the curve starts straight.
        assert_eq!(to_srgb(vec3(0.5, 0.215_861, 0.001)), [188, 128, 3]);
        assert_eq!(to_srgb(vec3(-1.0, 7.0, f32::INFINITY)), [0, 255, 255]);
    }

    #[test]
    fn srgb_gives_every_byte_back() {
        for byte in 0..=u8::MAX {
            assert_eq!(to_srgb(from_srgb([byte; 3])), [byte; 3]);
        }
    }

    #[test]
    fn the_ramp_passes_through_its_colours() {
        assert_eq!([ramp(0.0), ramp(0.5), ramp(1.0)], [SLATE, SAGE.lerp(SAND, 0.5), CORAL]);
        assert_eq!([ramp(-1.0), ramp(2.0)], [SLATE, CORAL]);
    }
}
