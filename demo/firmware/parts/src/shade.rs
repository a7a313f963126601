//! Shading for displays of one bit: light by the surface's normal, and a dither that makes shades of it.

use embedded_graphics_core::geometry::Point;
use embedded_graphics_core::pixelcolor::BinaryColor;
use glam::Vec3;

/// How bright a surface of this unit `normal` is under light from direction `light`, a unit vector towards it: from 0,
/// in its own shadow, to 255. Lambert's cosine law.
#[must_use]
pub fn brightness(normal: Vec3, light: Vec3) -> u8 {
    // `as` saturates.
    (normal.dot(light) * 255.0) as u8
}

/// On or off at `pixel`, such that an area of this brightness looks that bright: ordered dither in 17 shades, 0 all off
/// and 255 all on.
///
/// Thresholds: B. E. Bayer, An Optimum Method for Two-Level Rendition of Continuous-Tone Pictures (1973).
#[must_use]
pub fn dithered(pixel: Point, brightness: u8) -> BinaryColor {
    const ORDER: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];
    let order = ORDER[(pixel.y & 3) as usize][(pixel.x & 3) as usize];
    BinaryColor::from(brightness >= order * 16 + 8)
}

#[cfg(test)]
mod tests {
    use super::{brightness, dithered};
    use embedded_graphics_core::geometry::Point;
    use glam::{Vec3, vec3};

    #[test]
    fn light_falls_by_the_cosine() {
        assert_eq!(brightness(Vec3::Y, Vec3::Y), 255);
        assert_eq!(brightness(Vec3::Y, vec3(0.0, 0.6, 0.8)), 153);
        assert_eq!(brightness(Vec3::Y, Vec3::X), 0);
        assert_eq!(brightness(Vec3::Y, Vec3::NEG_Y), 0);
        assert_eq!(brightness(Vec3::NAN, Vec3::Y), 0);
    }

    #[test]
    fn each_shade_lights_its_share_of_a_tile_anywhere() {
        for corner in [Point::zero(), Point::new(-5, 3), Point::new(i32::MAX - 4, i32::MIN)] {
            for shade in 0..=255_u8 {
                let tile = (0..16).map(|index| corner + Point::new(index % 4, index / 4));
                let on = tile.filter(|&pixel| dithered(pixel, shade).is_on()).count();
                assert_eq!(on, (usize::from(shade) + 8) / 16, "shade {shade} at {corner:?}");
            }
        }
    }
}
