//! Pictures of a prepared scene, on all cores.

use crate::lanes::{F32x8, Lanes};
use crate::scene::{Scene, View};
use crate::target::Target;
use crate::tile::{TILE_SIDE, Workspace, cast};
use core::ops::Range;
use gsdf_nostd::{Raster, Solid};

/// Renders pictures of a scene, tile by tile: what a tile's rays cannot meet is never looked at.
///
/// Every pixel has the bits that a ray by itself finds with [`Program::along`](gsdf_nostd::Program::along), whatever was
/// left out.
///
/// It keeps the memory it works in: pictures after the first allocate nothing, as long as they are no larger.
pub struct Renderer<'s, 'a, L: Solid> {
    view: View<'s, 'a, L>,
    /// One for each row of tiles.
    work: Vec<Workspace<F32x8, L>>,
}

/// What a picture took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// The pixels that show something.
    pub hits: u64,
    /// The spans of leaves that were computed, each for a packet of rays.
    pub spans: u64,
}

impl Effort {
    /// This and another one, of other pixels.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            hits: self.hits + other.hits,
            spans: self.spans + other.spans,
        }
    }
}

impl<'s, 'a, L> Renderer<'s, 'a, L>
where
    L: Solid<Seen<f32>: Send + Sync> + Send + Sync,
{
    /// A renderer of pictures of this scene, as this raster sees it.
    #[must_use]
    pub fn new(scene: &'s Scene<'a, L>, raster: Raster) -> Self {
        let mut renderer = Self {
            view: View::new(scene, raster),
            work: Vec::new(),
        };
        renderer.make_room();
        renderer
    }

    /// Looks through another raster from now on.
    pub fn look(&mut self, raster: Raster) {
        self.view.look(raster);
        self.make_room();
    }

    fn make_room(&mut self) {
        let rows = self.rows().len();
        while self.work.len() < rows {
            self.work.push(Workspace::new(()));
        }
    }

    /// The rows of tiles.
    fn rows(&self) -> Range<usize> {
        0..(self.view.raster.height() as usize).div_ceil(TILE_SIDE)
    }

    /// Casts a ray through the centre of every pixel, on the threads of the current `rayon` pool. The pixels do not
    /// depend on their number.
    pub fn render<T: Target>(&mut self, target: T) -> Effort {
        let rows = self.rows();
        render_rows(&self.view, target, rows, &mut self.work)
    }
}

/// Renders rows of tiles: one after the other on as many threads as there are.
fn render_rows<T: Target, L>(view: &View<'_, '_, L>, target: T, rows: Range<usize>, work: &mut [Workspace<F32x8, L>]) -> Effort
where
    L: Solid<Seen<f32>: Send + Sync> + Send + Sync,
{
    if let ([only], 1) = (&mut *work, rows.len()) {
        return render_row((), view, target, rows.start, only);
    }
    if rows.is_empty() {
        return Effort::default();
    }
    let half = rows.len() / 2;
    let middle = rows.start + half;
    let (above, below) = target.split_at((half * TILE_SIDE) as u32);
    let (work_above, work_below) = work.split_at_mut(half);
    let (above, below) = rayon::join(
        || render_rows(view, above, rows.start..middle, work_above),
        || render_rows(view, below, middle..rows.end, work_below),
    );
    above.joined(below)
}

/// Renders one row of tiles.
#[inline(always)]
fn render_row<T: Lanes, C: Target, L: Solid>(
    token: T::Token,
    view: &View<'_, '_, L>,
    mut target: C,
    row: usize,
    work: &mut Workspace<T, L>,
) -> Effort {
    let (width, height) = (view.raster.width(), view.raster.height());
    let normals = target.wants_normals();
    let y = (row * TILE_SIDE) as u32;
    let mut effort = Effort::default();
    work.computed = 0;
    let mut x = 0;
    while x < width {
        cast(token, view, x, y, normals, work);
        effort.hits += u64::from(work.tile.hits(width - x, height - y));
        target.put(x, 0, &work.tile);
        x += TILE_SIDE as u32;
    }
    effort.spans = work.computed;
    effort
}
