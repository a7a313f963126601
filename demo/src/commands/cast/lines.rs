//! Rays as lines of text, read in blocks of whole lines.

use glam::Vec3;
use gsdf_nostd::Ray;
use std::io::{ErrorKind, Read, Result};

/// How many bytes are read at a time at most.
const BLOCK: usize = 1 << 20;

/// How many bytes of lines a thread reads at a time, about.
const PIECE: usize = 1 << 14;

/// How long a line may be.
const LONGEST: usize = 4096;

/// Text that is being read: whole lines, and the start of one that is not yet all there.
#[derive(Debug, Default)]
pub struct Block {
    bytes: Vec<u8>,
    /// Up to where lines are whole.
    whole: usize,
    at_end: bool,
}

impl Block {
    /// Reads until there is a whole line, or the input ends; false where there is nothing left.
    ///
    /// # Errors
    /// Where the input cannot be read.
    pub fn fill(&mut self, input: &mut impl Read) -> Result<bool> {
        while self.whole == 0 && !self.at_end && self.bytes.len() <= LONGEST {
            let start = self.bytes.len();
            self.bytes.resize(start + BLOCK, 0);
            let count = match input.read(&mut self.bytes[start..]) {
                Err(error) if error.kind() == ErrorKind::Interrupted => {
                    self.bytes.truncate(start);
                    continue;
                }
                read => read?,
            };
            self.bytes.truncate(start + count);
            self.at_end = count == 0;
            let newline = self.bytes[start..].iter().rposition(|byte| *byte == b'\n');
            self.whole = newline.map_or(0, |newline| start + newline + 1);
        }
        if self.at_end {
            self.whole = self.bytes.len();
        }
        Ok(!self.bytes.is_empty())
    }

    /// The whole lines.
    ///
    /// # Errors
    /// Where there is none, because the first one is too long.
    pub fn lines(&self) -> core::result::Result<&[u8], String> {
        match self.bytes.get(..self.whole) {
            Some(lines) if !lines.is_empty() => Ok(lines),
            _ => Err(format!("longer than {LONGEST} bytes: a ray is {RAY}")),
        }
    }

    /// Forgets the whole lines.
    pub fn drop_lines(&mut self) {
        self.bytes.drain(..self.whole);
        self.whole = 0;
    }
}

/// What a line should be.
const RAY: &str = "six numbers, ox oy oz dx dy dz";

/// Lines apart into pieces of whole lines.
#[must_use]
pub fn pieces(mut lines: &[u8]) -> Vec<&[u8]> {
    let mut pieces = Vec::new();
    while lines.len() > PIECE {
        let newline = lines.iter().skip(PIECE).position(|byte| *byte == b'\n');
        let (piece, rest) = lines.split_at(newline.map_or(lines.len(), |newline| PIECE + newline + 1));
        pieces.push(piece);
        lines = rest;
    }
    pieces.push(lines);
    pieces
}

/// The rays of some lines.
#[derive(Clone, Debug, Default)]
pub struct Piece {
    /// The number of the first ray among all.
    pub first: u64,
    /// The rays.
    pub rays: Vec<Ray>,
    /// The lines before the one that is no ray, or all.
    pub lines: u64,
    /// What is wrong with the line that is no ray, if there is one.
    pub fault: Option<String>,
}

impl Piece {
    /// Reads lines up to one that is no ray.
    #[must_use]
    pub fn read(lines: &[u8]) -> Self {
        let mut piece = Self::default();
        let lines = lines.strip_suffix(b"\n").unwrap_or(lines);
        for line in lines.split(|byte| *byte == b'\n') {
            match ray(line) {
                Ok(read) => piece.rays.extend(read),
                Err(fault) => {
                    piece.fault = Some(fault);
                    break;
                }
            }
            piece.lines += 1;
        }
        piece
    }
}

/// The ray of a line; `None` where it is empty or a comment.
fn ray(line: &[u8]) -> core::result::Result<Option<Ray>, String> {
    let mut rest = line.trim_ascii_start();
    if rest.is_empty() || rest[0] == b'#' {
        return Ok(None);
    }
    let mut numbers = [0.0; 6];
    for number in &mut numbers {
        match fast_float2::parse_partial::<f32, _>(rest) {
            Ok((read, length)) if rest.get(length).is_none_or(u8::is_ascii_whitespace) => {
                *number = read;
                rest = rest[length..].trim_ascii_start();
            }
            _ => return Err(wrong(rest)),
        }
    }
    if !rest.is_empty() {
        return Err(wrong(rest));
    }
    let [ox, oy, oz, dx, dy, dz] = numbers;
    Ray::new(Vec3::new(ox, oy, oz), Vec3::new(dx, dy, dz))
        .map(Some)
        .map_err(|error| error.to_string())
}

/// What is said of a line whose rest should not be there, or be something else.
fn wrong(rest: &[u8]) -> String {
    /// More than that is no help.
    const SHOWN: usize = 24;
    let word = rest.split(u8::is_ascii_whitespace).next().unwrap_or_default();
    let found = match word {
        [] => "the end of the line".to_owned(),
        word => format!("`{}`", String::from_utf8_lossy(&word[..word.len().min(SHOWN)]).escape_debug()),
    };
    format!("found {found}: a ray is {RAY}")
}

#[cfg(test)]
mod tests {
    use super::{Block, Piece, pieces};
    use glam::vec3;
    use std::io::{self, Read};

    /// Gives few bytes at a time.
    struct Dripping<'t>(&'t [u8], usize);

    impl Read for Dripping<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            let count = self.1.min(buffer.len());
            self.0.read(&mut buffer[..count])
        }
    }

    fn read(text: &[u8], at_a_time: usize) -> Result<Vec<f32>, String> {
        let (mut block, mut input, mut found) = (Block::default(), Dripping(text, at_a_time), Vec::new());
        while block.fill(&mut input).expect("it can be read") {
            for piece in pieces(block.lines()?) {
                let piece = Piece::read(piece);
                found.extend(piece.rays.iter().map(|ray| ray.origin().x));
                if let Some(fault) = piece.fault {
                    return Err(format!("{}: {fault}", piece.lines));
                }
            }
            block.drop_lines();
        }
        Ok(found)
    }

    #[test]
    fn lines_are_read_whole_however_they_arrive() {
        let text: String = (0..3000).map(|number| format!("{number} 0 0 1 0 0\n")).collect();
        let expected: Vec<_> = (0..3000).map(|number| number as f32).collect();
        for at_a_time in [7, 1000, usize::MAX] {
            assert_eq!(read(text.as_bytes(), at_a_time), Ok(expected.clone()));
            assert_eq!(read(text.trim_end().as_bytes(), at_a_time), Ok(expected.clone()));
        }
        assert_eq!(read(b"", 1), Ok(vec![]));
    }

    #[test]
    fn a_line_is_a_ray_or_nothing_or_refused() {
        let piece = Piece::read(b"# rays\n\n  1e1 -2 .5\t0 0 -1 \r\n");
        assert_eq!((piece.lines, piece.fault), (3, None));
        assert_eq!(
            (piece.rays[0].origin(), piece.rays[0].direction()),
            (vec3(10.0, -2.0, 0.5), vec3(0.0, 0.0, -1.0))
        );
        for (line, told) in [
            (&b"1 2 3 4 5"[..], "found the end of the line"),
            (b"1 2 3 4 5 6 7", "found `7`"),
            (b"1 2 3x 4 5 6", "found `3x`"),
            (b"1,2,3,4,5,6", "found `1,2,3,4,5,6`"),
            (b"1 2 3 0 0 0", "must not be zero"),
            (b"nan 2 3 0 0 1", "must be finite"),
            (b"\xff\xfe\0", "found `"),
        ] {
            let fault = Piece::read(line).fault.expect("it is no ray");
            assert!(fault.contains(told), "{fault}");
        }
        assert_eq!(
            read(b"1 0 0 1 0 0\nx\n", 3).expect_err("x is no ray"),
            "0: found `x`: a ray is six numbers, ox oy oz dx dy dz"
        );
    }

    #[test]
    fn a_line_without_end_is_refused_early() {
        let endless = vec![b'1'; 50 << 20];
        assert!(
            read(&endless, usize::MAX)
                .expect_err("no line is that long")
                .contains("longer than 4096")
        );
    }
}
