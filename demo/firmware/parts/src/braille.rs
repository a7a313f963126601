//! A picture of one bit per pixel as text, eight pixels to a character.

use embedded_graphics_core::geometry::Point;

/// The Braille character of the pixels 2 across by 4 down in column `cell.x` and row `cell.y` of such characters; `lit`
/// tells which pixels are on.
///
/// Source: The Unicode Standard, Braille Patterns (U+2800 to U+28FF).
pub fn braille(cell: Point, lit: impl Fn(Point) -> bool) -> char {
    // The bits of the eight dots, row by row; the lowest row came later.
    const DOTS: [[u32; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];
    let mut bits = 0;
    for (y, row) in (0..).zip(DOTS) {
        for (x, dot) in (0..).zip(row) {
            if lit(Point::new(2 * cell.x + x, 4 * cell.y + y)) {
                bits |= dot;
            }
        }
    }
    char::from_u32(0x2800 + bits).unwrap_or(' ')
}

#[cfg(test)]
mod tests {
    use super::braille;
    use embedded_graphics_core::geometry::Point;

    #[test]
    fn dots_lie_as_unicode_numbers_them() {
        let only = |x, y| braille(Point::new(3, 5), move |pixel| pixel == Point::new(6 + x, 20 + y));
        let dots = [
            only(0, 0),
            only(0, 1),
            only(0, 2),
            only(1, 0),
            only(1, 1),
            only(1, 2),
            only(0, 3),
            only(1, 3),
        ];
        assert_eq!(dots, ['⠁', '⠂', '⠄', '⠈', '⠐', '⠠', '⡀', '⢀']);
        assert_eq!(braille(Point::zero(), |_| true), '⣿');
        assert_eq!(braille(Point::zero(), |_| false), '\u{2800}');
    }
}
