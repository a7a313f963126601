//! The nearest point of a solid of revolution, by its profile: segments and arcs in the half-plane of the distance
//! from the axis (x) and the distance along it (y).

use super::holds::to_segment;
use glam::DVec2;

/// A piece of a profile.
#[derive(Clone, Copy, Debug)]
pub enum Piece {
    /// A straight piece.
    Segment(DVec2, DVec2),
    /// An arc about a centre, with its radius, from an angle to a larger one, measured from the x axis.
    Arc(DVec2, f64, f64, f64),
}

impl Piece {
    /// How far a point is.
    #[must_use]
    pub fn distance(&self, p: DVec2) -> f64 {
        match *self {
            Self::Segment(from, to) => to_segment(p, from, to),
            Self::Arc(center, radius, from, to) => {
                let w = p - center;
                let angle = w.to_angle();
                if (from..=to).contains(&angle) {
                    (w.length() - radius).abs()
                } else {
                    let end = |angle: f64| (w - DVec2::from_angle(angle) * radius).length();
                    end(from).min(end(to))
                }
            }
        }
    }
}

/// The profile of a sector of a ball, of any half angle up to the whole ball.
#[must_use]
pub fn sector(reach: f64, half_angle: f64) -> [Piece; 2] {
    let rim = core::f64::consts::FRAC_PI_2 - half_angle;
    [
        Piece::Segment(DVec2::ZERO, DVec2::from_angle(rim) * reach),
        Piece::Arc(DVec2::ZERO, reach, rim, core::f64::consts::FRAC_PI_2),
    ]
}

/// The profile of the hull of two balls, `apart` from the first, at zero, to the second.
#[must_use]
pub fn hull(apart: f64, first: f64, second: f64) -> [Piece; 3] {
    let lean = ((first - second) / apart).asin();
    let (side, end) = (DVec2::from_angle(lean), DVec2::Y * apart);
    let quarter = core::f64::consts::FRAC_PI_2;
    [
        Piece::Arc(DVec2::ZERO, first, -quarter, lean),
        Piece::Segment(side * first, end + side * second),
        Piece::Arc(end, second, lean, quarter),
    ]
}

/// How far a point is from the nearest of the pieces.
#[must_use]
pub fn to_pieces(p: DVec2, pieces: &[Piece]) -> f64 {
    pieces.iter().map(|piece| piece.distance(p)).fold(f64::INFINITY, f64::min)
}
