//! Pictures of a prepared scene, on all cores.

use crate::lanes::Lanes;
use crate::level::{Level, Work};
use crate::prefetch::Ahead;
use crate::scene::{Most, Scene, View};
use crate::target::{Target, Wants};
use crate::tile::{Certificates, Certifier, TILE_SIDE, Tile, Workspace, cast};
use crate::vectorized::Vectorized;
use core::iter::Sum;
use core::marker::PhantomData;
use core::ops::Range;
use gsdf_nostd::{Raster, Solid};
use std::sync::{Mutex, PoisonError};

/// Renders pictures of a scene, tile by tile: what a tile's rays cannot meet is never looked at.
///
/// Every pixel has the bits that a ray by itself finds with [`Program::along`](gsdf_nostd::Program::along), whatever was
/// left out, at every level and on any number of threads.
///
/// It keeps the memory it works in: pictures after the first allocate nothing, on no more threads than before, as long as no
/// more parts than before have rays that start inside of them.
pub struct Renderer<'s, 'a, L: Solid> {
    view: View<'s, 'a, L>,
    raster: Raster,
    level: Level,
    /// What the threads work in, as long as none does.
    idle: Mutex<Vec<RowRenderer<L>>>,
    /// Whether pixels are certified.
    certifies: bool,
}

/// What a picture took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// The pixels that show something.
    pub hits: u64,
    /// The spans of leaves that were computed, each along the rays of a packet.
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

impl Sum for Effort {
    fn sum<I: Iterator<Item = Self>>(efforts: I) -> Self {
        efforts.fold(Self::default(), Self::joined)
    }
}

impl<'s, 'a, L> Renderer<'s, 'a, L>
where
    L: Vectorized,
{
    /// A renderer of pictures of this scene, as this raster sees it, at the [best level](Level::best) of this machine.
    #[must_use]
    pub fn new(scene: &'s Scene<'a, L>, raster: Raster) -> Self {
        Self::at_level(scene, raster, Level::best())
    }

    /// The same at another level; the pixels are the same.
    #[must_use]
    pub fn at_level(scene: &'s Scene<'a, L>, raster: Raster, level: Level) -> Self {
        Self::of(scene, raster, level, false)
    }

    /// A renderer of pictures whose pixels are certified, at the [best level](Level::best) of this machine: beside what other
    /// renderers find, [`Certificates`].
    ///
    /// Of each pixel it finds what [`Program::cast_certified`](gsdf_nostd::Program::cast_certified) does, with one difference:
    /// what is left out cannot make a ray uncertain. Where single precision is certain, the leaf and the normal are those of
    /// other renderers and the distance is rounded from `f64`.
    ///
    /// What a packet certifies as a whole rests on what is [promised](gsdf_nostd#accuracy) of every surface
    /// ([`Solid::between`]); what a single ray certifies on the operations of its own formulas.
    ///
    /// Cost: three to five times that of other renderers where nearly all packets are certified as a whole, from solids that can
    /// be [grown](Solid::grown); a microsecond more for each ray that is not.
    #[must_use]
    pub fn certified(scene: &'s Scene<'a, L>, raster: Raster) -> Self {
        Self::certified_at_level(scene, raster, Level::best())
    }

    /// The same at another level; the pixels and their certificates are the same.
    #[must_use]
    pub fn certified_at_level(scene: &'s Scene<'a, L>, raster: Raster, level: Level) -> Self {
        Self::of(scene, raster, level, true)
    }

    fn of(scene: &'s Scene<'a, L>, raster: Raster, level: Level, certifies: bool) -> Self {
        let mut view = View::of_any_rays(scene);
        view.look(raster);
        Self {
            view,
            raster,
            level,
            certifies,
            idle: Mutex::new(Vec::new()),
        }
    }

    /// The level at which it renders.
    #[must_use]
    pub fn level(&self) -> Level {
        self.level
    }

    /// Looks through another raster from now on.
    pub fn look(&mut self, raster: Raster) {
        self.view.look(raster);
        self.raster = raster;
    }

    /// Casts a ray through the centre of every pixel, on the threads of the current `rayon` pool. The pixels do not
    /// depend on their number.
    pub fn render<T: Target>(&mut self, target: T) -> Effort {
        let rows = (self.raster.height() as usize).div_ceil(TILE_SIDE);
        let workers = rayon::current_num_threads().min(rows);
        let idle = self.idle.get_mut().unwrap_or_else(PoisonError::into_inner);
        while idle.len() < workers {
            let mut worker = L::row_renderer(self.level, self.certifies);
            worker.0.make_room(self.view.scene.most());
            idle.push(worker);
        }
        self.render_rows(target, 0..rows)
    }

    /// Renders rows of tiles, on as many threads as there are.
    fn render_rows<T: Target>(&self, mut target: T, rows: Range<usize>) -> Effort {
        if rows.len() <= 1 {
            return rows.map(|row| self.render_row(&mut target, row)).sum();
        }
        let half = rows.len() / 2;
        let middle = rows.start + half;
        let (above, below) = target.split_at((half * TILE_SIDE) as u32);
        let (above, below) = rayon::join(
            || self.render_rows(above, rows.start..middle),
            || self.render_rows(below, middle..rows.end),
        );
        above.joined(below)
    }

    fn render_row<T: Target>(&self, target: &mut T, row: usize) -> Effort {
        let idle = || self.idle.lock().unwrap_or_else(PoisonError::into_inner);
        // The last one that was given back is the one whose memory is still in a cache.
        let worker = idle().pop();
        let mut worker = worker.unwrap_or_else(|| L::row_renderer(self.level, self.certifies));
        let effort = worker.0.render(&self.view, &self.raster, row, target.wants(), target);
        idle().push(worker);
        effort
    }
}

/// What renders rows of tiles at a level.
#[doc(hidden)]
pub struct RowRenderer<L: Solid>(Box<dyn RenderRow<L>>);

impl<L: Solid + Send + Sync + 'static> RowRenderer<L> {
    /// One for a level, which certifies what it renders or does not.
    #[must_use]
    pub fn new(level: Level, certifies: bool) -> Self {
        level.run(MakeRowRenderer {
            certifies,
            of: PhantomData,
        })
    }
}

/// What renders a row of tiles, in lanes of some type.
trait RenderRow<L: Solid>: Send {
    /// Renders a row of tiles.
    fn render(&mut self, view: &View<'_, '_, L>, raster: &Raster, row: usize, wants: Wants, target: &mut dyn PutTiles) -> Effort;

    /// Makes room for what the parts of a scene need.
    fn make_room(&mut self, most: Most);
}

/// Makes a [`RowRenderer`] for the lanes of a level.
struct MakeRowRenderer<L> {
    certifies: bool,
    of: PhantomData<L>,
}

impl<L: Solid + Send + Sync + 'static> Work for MakeRowRenderer<L> {
    type Output = RowRenderer<L>;

    fn run<T: Lanes>(self, token: T::Token) -> RowRenderer<L> {
        RowRenderer(Box::new(RowOf {
            token,
            work: Workspace::<T, L>::new(token),
            tile: Box::new(Tile::NOTHING),
            certifier: self.certifies.then(Certifier::new),
        }))
    }
}

struct RowOf<T: Lanes, L> {
    token: T::Token,
    work: Workspace<T, L>,
    /// For targets that do not lay out their pixels as tiles.
    tile: Box<Tile>,
    /// If what was cast is to be certified: in one type with what is not, so that the code of a tile is compiled once.
    certifier: Option<Certifier<T, L>>,
}

impl<T: Lanes, L: Solid + Send + Sync> RenderRow<L> for RowOf<T, L> {
    fn make_room(&mut self, most: Most) {
        self.work.make_room(most);
    }

    fn render(&mut self, view: &View<'_, '_, L>, raster: &Raster, row: usize, wants: Wants, target: &mut dyn PutTiles) -> Effort {
        let token = self.token;
        T::vectorize(
            token,
            #[inline(always)]
            || render_row(self, view, raster, row, wants, target),
        )
    }
}

#[inline(always)]
fn render_row<T: Lanes, L: Solid>(
    worker: &mut RowOf<T, L>,
    view: &View<'_, '_, L>,
    raster: &Raster,
    row: usize,
    wants: Wants,
    target: &mut dyn PutTiles,
) -> Effort {
    let RowOf {
        token,
        work,
        tile: own,
        certifier,
    } = worker;
    let token = *token;
    let (width, height) = (raster.width(), raster.height());
    let y = (row * TILE_SIDE) as u32;
    let side = TILE_SIDE as u32;
    let mut effort = Effort::default();
    work.computed = 0;
    work.rays.look(token, view);
    let mut x = 0;
    while x < width {
        let next = target.place(x + side).map(Ahead::of);
        let (place, is_own) = match target.place(x) {
            Some(place) => (place, false),
            None => (&mut **own, true),
        };
        let mut hits = cast(token, view, [x, y], wants, work, place, next);
        if let Some(certifier) = certifier {
            hits = certifier.certify(token, view, [x, y], wants, work, place);
        }
        if width - x < side || height - y < side {
            hits = place.hits(width - x, height - y);
        }
        if is_own {
            target.put(x, own);
        }
        if let Some(certifier) = certifier {
            target.certify(x, &certifier.certificates);
        }
        effort.hits += u64::from(hits);
        x += side;
    }
    effort.spans = work.computed;
    effort
}

/// A row of tiles of a [`Target`].
trait PutTiles {
    /// The tile from this column on, if that is how the pixels are kept.
    fn place(&mut self, x: u32) -> Option<&mut Tile>;
    /// Takes the tile from this column on.
    fn put(&mut self, x: u32, tile: &Tile);
    /// Takes the certificates of the tile from this column on.
    fn certify(&mut self, x: u32, certificates: &Certificates);
}

impl<C: Target> PutTiles for C {
    fn place(&mut self, x: u32) -> Option<&mut Tile> {
        self.tile(x, 0)
    }

    fn put(&mut self, x: u32, tile: &Tile) {
        Target::put(self, x, 0, tile);
    }

    fn certify(&mut self, x: u32, certificates: &Certificates) {
        Target::certify(self, x, 0, certificates);
    }
}
