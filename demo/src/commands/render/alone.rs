//! Pictures of which every ray is cast by itself, in any tier.

use crate::commands::tier::{Alone, Tier};
use crate::frame::{Frame, Met};
use core::fmt;
use core::ops::AddAssign;
use gsdf_nostd::{Program, Raster, Settled};
use gsdf_trade::Primitive;
use rayon::prelude::*;
use serde::Serialize;

/// How many rays were settled by what.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Settlements {
    /// By single precision.
    pub single: u64,
    /// By double precision.
    pub double: u64,
    /// By a rule.
    pub tie: u64,
}

impl Settlements {
    /// Of one ray.
    #[must_use]
    pub fn of(settled: Settled) -> Self {
        let mut one = Self::default();
        match settled {
            Settled::Single => one.single = 1,
            Settled::Double => one.double = 1,
            Settled::Tie => one.tie = 1,
        }
        one
    }
}

impl AddAssign for Settlements {
    fn add_assign(&mut self, other: Self) {
        self.single += other.single;
        self.double += other.double;
        self.tie += other.tie;
    }
}

impl fmt::Display for Settlements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { single, double, tie } = self;
        write!(
            f,
            "{single} rays settled in single precision, {double} in double precision, {tie} ties"
        )
    }
}

/// Casts a ray through the middle of every pixel, and tells how many hit something. Every finished row is told.
pub fn cast(frame: &mut Frame, program: Program<'_, Primitive>, raster: Raster, tier: Tier, row_done: impl Fn(u64) + Sync) -> u64 {
    let of_row = |alone: &mut Alone<'_>, (row, y): (&mut [Option<Met>], u32)| {
        let mut hits = 0;
        for (pixel, x) in row.iter_mut().zip(0..) {
            let Ok(ray) = raster.ray(x, y) else { continue };
            let (crossing, _) = alone.first(&ray);
            *pixel = crossing.map(|crossing| crossing.hit.into());
            hits += u64::from(crossing.is_some());
        }
        row_done(1);
        hits
    };
    frame
        .rows_mut()
        .zip(0..raster.height())
        .map_init(|| Alone::new(program, tier), of_row)
        .sum()
}
