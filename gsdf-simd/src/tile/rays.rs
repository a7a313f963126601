//! The rays of a tile, in packets of four by two or four by four.

use super::pixels::{BLOCK_SIDE, TILE_PIXELS, TILE_SIDE, Tile};
use crate::lanes::Lanes;
use crate::packet::{Packet, earliest_on_line, scaled};
use crate::scene::{Picture, View};
use gsdf_nostd::{Line, LocalLine, OnSurface, Raster, Solid, Toward, Transform, V3};

/// The most packets that a tile is made of: those of eight rays.
pub(crate) const MOST_PACKETS: usize = 32;

/// How many packets stand side by side in a tile.
const COLUMNS: usize = TILE_SIDE / BLOCK_SIDE;

/// How many packets of these lanes a tile is made of.
pub(crate) const fn packets<T: Lanes>() -> usize {
    TILE_SIDE * TILE_SIDE / T::LANES
}

/// The bits of all packets of a tile.
pub(crate) const fn every_packet<T: Lanes>() -> u32 {
    u32::MAX >> (u32::BITS as usize - packets::<T>())
}

/// How many rows of pixels a packet has.
pub(crate) const fn height<T: Lanes>() -> usize {
    T::LANES / BLOCK_SIDE
}

/// Where in the planes of a tile the pixels of packets of eight start, and where those of packets of sixteen do.
const STARTS: [[u8; MOST_PACKETS]; 2] = [starts(2), starts(4)];

/// Where in the planes of a tile the pixels of packets with so many rows start.
const fn starts(height: usize) -> [u8; MOST_PACKETS] {
    let mut starts = [0; MOST_PACKETS];
    let mut packet = 0;
    while packet < TILE_SIDE / height * COLUMNS {
        starts[packet] = Tile::index(packet % COLUMNS * BLOCK_SIDE, packet / COLUMNS * height) as u8;
        packet += 1;
    }
    starts
}

/// Where in the planes of a tile a packet's pixels start.
#[inline(always)]
pub(crate) fn start_of<T: Lanes>(packet: usize) -> usize {
    let starts = &STARTS[usize::from(height::<T>() == BLOCK_SIDE)];
    // What this leaves as it is tells the compiler that all pixels are within the planes.
    usize::from(starts[packet % MOST_PACKETS]) & (TILE_PIXELS - T::LANES)
}

/// The rays of a tile, aimed where they are needed.
#[derive(Debug)]
pub(crate) struct Rays<T: Lanes> {
    /// The lines of the packets, in the world.
    lines: [Line<T>; MOST_PACKETS],
    /// By what their directions are scaled.
    scales: [T; MOST_PACKETS],
    /// Where the rays start.
    starts: [T; MOST_PACKETS],
    /// What they leave, if they start on surfaces; then there is one packet.
    leaving: Option<OnSurface<T>>,
    /// The packets that there are, and those that are aimed.
    present: u32,
    aimed: u32,
    /// The left upper pixel of the tile.
    corner: [u32; 2],
    /// Origins and directions through the middles of the columns of packets, and how far the rows are above them, once one
    /// is aimed.
    columns: [(V3<T>, V3<T>); COLUMNS],
    upward: [V3<T>; MOST_PACKETS / COLUMNS],
    /// The lines in another frame, as far as `posed` says.
    local: [Line<T>; MOST_PACKETS],
    /// By what a parameter on a local line is to be multiplied to be one in the world.
    local_scales: [T; MOST_PACKETS],
    frame: u16,
    posed: u32,
}

/// Where in a packet its pixels are.
const COLUMN_CENTERS: [f32; 16] = [0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5, 0.5, 1.5, 2.5, 3.5];
const ROW_CENTERS: [f32; 16] = [0.5, 0.5, 0.5, 0.5, 1.5, 1.5, 1.5, 1.5, 2.5, 2.5, 2.5, 2.5, 3.5, 3.5, 3.5, 3.5];

impl<T: Lanes> Rays<T> {
    #[inline(always)]
    pub(crate) fn new(token: T::Token) -> Self {
        let one = T::splat(token, 1.0);
        let ones = V3::new(one, one, one);
        let line = Line {
            origin: ones,
            toward: Toward::without_components(ones),
        };
        Self {
            lines: [line; MOST_PACKETS],
            scales: [one; MOST_PACKETS],
            starts: [one; MOST_PACKETS],
            leaving: None,
            present: 0,
            aimed: 0,
            corner: [0, 0],
            columns: [(ones, ones); COLUMNS],
            upward: [ones; MOST_PACKETS / COLUMNS],
            local: [line; MOST_PACKETS],
            local_scales: [one; MOST_PACKETS],
            frame: 0,
            posed: 0,
        }
    }

    /// Looks at the scene from where a view does.
    #[inline(always)]
    pub(crate) fn look<L: Solid>(&mut self, token: T::Token, view: &View<'_, '_, L>) {
        if let Some(eye) = view.eye() {
            let origin = V3::splat(T::splat(token, 0.0), eye);
            for line in &mut self.lines {
                line.origin = origin;
            }
        }
    }

    /// Goes on to the tile with this left upper pixel. None of its rays is aimed yet.
    #[inline(always)]
    pub(crate) fn begin(&mut self, corner: [u32; 2]) {
        (self.corner, self.present, self.aimed, self.posed) = (corner, every_packet::<T>(), 0, 0);
    }

    /// Goes on to one packet of any rays, which may leave surfaces.
    #[inline(always)]
    pub(crate) fn begin_with(&mut self, line: &Line<T>, scale: T, start: T, leaving: Option<OnSurface<T>>) {
        (self.present, self.aimed, self.posed) = (1, 1, 0);
        self.leaving = leaving;
        (self.lines[0], self.scales[0], self.starts[0]) = (*line, scale, start);
    }

    /// The bits of the packets that there are.
    #[inline(always)]
    pub(crate) fn present(&self) -> u32 {
        self.present
    }

    /// Aims the rays of some packets.
    #[inline(always)]
    pub(crate) fn aim<L: Solid>(&mut self, token: T::Token, view: &View<'_, '_, L>, which: u32) {
        let mut missing = which & !self.aimed;
        if missing == 0 {
            return;
        }
        let Some(Picture { raster, valid, .. }) = &view.picture else {
            return;
        };
        if self.aimed == 0 {
            self.aim_columns_and_rows(token, raster);
        }
        self.aimed |= missing;
        if !valid {
            self.aim_checked(token, raster, missing);
            return;
        }
        let components = view.scene.divides_by_components();
        let looked = view.eye().is_some();
        while missing != 0 {
            let packet = missing.trailing_zeros() as usize % MOST_PACKETS;
            missing &= missing - 1;
            let (origin, direction) = raster.line_from(self.columns[packet % COLUMNS], self.upward[packet / COLUMNS]);
            let (direction, scale, length) = scaled(direction);
            let line = &mut self.lines[packet];
            if !looked {
                line.origin = origin;
            }
            if components {
                line.toward = Toward::new(direction);
            } else {
                // What nobody looks at is left as it is.
                let Toward { v, vv, per_vv, .. } = Toward::without_components(direction);
                (line.toward.v, line.toward.vv, line.toward.per_vv) = (v, vv, per_vv);
            }
            (self.scales[packet], self.starts[packet]) = (scale, earliest_on_line(length));
        }
    }

    #[inline(always)]
    fn aim_columns_and_rows(&mut self, token: T::Token, raster: &Raster) {
        let [x, y] = self.corner;
        let centers = T::load(token, &COLUMN_CENTERS);
        for (number, column) in self.columns.iter_mut().enumerate() {
            *column = raster.column(centers + T::splat(token, x as f32 + (number * BLOCK_SIDE) as f32));
        }
        let centers = T::load(token, &ROW_CENTERS);
        for (number, upward) in self.upward.iter_mut().enumerate().take(packets::<T>() / COLUMNS) {
            *upward = raster.upward(centers + T::splat(token, y as f32 + (number * height::<T>()) as f32));
        }
    }

    /// Aims rays of which some may be none: those look for nothing.
    #[inline(always)]
    fn aim_checked(&mut self, token: T::Token, raster: &Raster, which: u32) {
        let (zero, infinity) = (T::splat(token, 0.0), T::splat(token, f32::INFINITY));
        let mut bits = which;
        while bits != 0 {
            let packet = bits.trailing_zeros() as usize % MOST_PACKETS;
            bits &= bits - 1;
            let (origin, direction) = raster.line_from(self.columns[packet % COLUMNS], self.upward[packet / COLUMNS]);
            (self.lines[packet], self.scales[packet], self.starts[packet]) =
                Packet::from_lanes(origin, direction, zero, infinity).into_parts();
        }
    }

    /// Takes the lines of some packets to a frame.
    #[inline(always)]
    pub(crate) fn pose(&mut self, frame: u16, pose: &Transform, which: u32) {
        if self.frame != frame {
            self.frame = frame;
            self.posed = 0;
        }
        let mut missing = which & !self.posed;
        while missing != 0 {
            let packet = missing.trailing_zeros() as usize % MOST_PACKETS;
            missing &= missing - 1;
            let LocalLine { line, scale } = pose.line_to_local(&self.lines[packet]);
            (self.local[packet], self.local_scales[packet]) = (line, scale);
        }
        self.posed |= which;
    }

    /// The lines of all packets in the world.
    #[inline(always)]
    pub(crate) fn lines(&self) -> &[Line<T>; MOST_PACKETS] {
        &self.lines
    }

    /// The lines of the packets that were [posed](Self::pose) last, and by what a parameter on each is to be multiplied to be
    /// one in the world.
    #[inline(always)]
    pub(crate) fn local(&self) -> (&[Line<T>; MOST_PACKETS], &[T; MOST_PACKETS]) {
        (&self.local, &self.local_scales)
    }

    /// What the rays leave, if they start on surfaces; then there is one packet.
    #[inline(always)]
    pub(crate) fn leaving(&self) -> Option<OnSurface<T>> {
        self.leaving
    }

    /// Where the rays of each packet start.
    #[inline(always)]
    pub(crate) fn starts(&self) -> &[T; MOST_PACKETS] {
        &self.starts
    }

    /// The line of a packet in the world, by what it is scaled, and where it starts.
    #[inline(always)]
    pub(crate) fn packet(&self, packet: usize) -> (&Line<T>, T, T) {
        let packet = packet % MOST_PACKETS;
        (&self.lines[packet], self.scales[packet], self.starts[packet])
    }
}

#[cfg(test)]
mod tests {
    use super::{packets, start_of};
    use crate::lanes::F32x8;
    use crate::tile::pixels::{TILE_PIXELS, Tile};

    #[test]
    fn packets_fill_the_planes() {
        let mut starts: Vec<_> = (0..packets::<F32x8>()).map(start_of::<F32x8>).collect();
        // The packet in column 2 and row 3 of the tile starts at its pixel (8, 6).
        assert_eq!(starts[3 * 4 + 2], Tile::index(8, 6));
        starts.sort_unstable();
        assert!(starts.iter().enumerate().all(|(place, start)| *start == 8 * place));
        assert_eq!(starts.len() * 8, TILE_PIXELS);
    }
}
