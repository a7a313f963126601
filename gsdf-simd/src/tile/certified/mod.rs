//! What the rays of a tile meet, certified, of those leaves alone that their packet may meet: packet by packet, and of what is
//! then not certain ray by ray.

mod gather;
mod together;

use super::beam_of;
use super::pixels::{Pixel, TILE_PIXELS, Tile};
use super::rays::{MOST_PACKETS, packets, start_of};
use super::state::Workspace;
use crate::lanes::Lanes;
use crate::scene::{Picture, View};
use crate::target::Wants;
use gather::Gathered;
use gsdf_nostd::{Bounded, Certified, CertifiedScratch, Node, Ordinary, Program, Ray, Settled, Solid, Span};
use together::{Known, certify_together};

/// How certain the pixels of a tile are, in the order of [`Tile`]'s planes: see [`Certified`].
#[derive(Clone, Debug, PartialEq)]
pub struct Certificates {
    /// By how much each distance may be off: in all but rare cases half a unit in its last place; infinite where nothing is
    /// certain, 0 where a ray hits nothing.
    pub bound: [f32; TILE_PIXELS],
    /// How it became certain.
    pub settled: [Settled; TILE_PIXELS],
}

impl Certificates {
    /// Those of a tile that shows nothing.
    pub const NOTHING: Self = Self {
        bound: [0.0; TILE_PIXELS],
        settled: [Settled::Single; TILE_PIXELS],
    };
}

/// Memory for the certificates of tiles, kept from one to the next.
#[derive(Debug)]
pub(crate) struct Certifier<T: Lanes, L> {
    gathered: Gathered<L>,
    part: Part<L>,
    together: Vec<Span<Ordinary<T>>>,
    spans: Spans,
    pub(crate) certificates: Box<Certificates>,
}

/// What one packet may meet.
#[derive(Debug)]
struct Part<L> {
    /// The program, and the numbers of its leaves among those gathered.
    bare: Vec<Node<()>>,
    leaves: Vec<u32>,
    /// The same with its solids, once a ray is looked at by itself.
    nodes: Vec<Node<L>>,
}

/// A packet of a tile.
#[derive(Clone, Copy)]
struct OfTile<'v, 's, 'a, L: Solid> {
    view: &'v View<'s, 'a, L>,
    picture: &'v Picture,
    corner: [u32; 2],
    packet: usize,
    /// Where its pixels start in the planes of the tile.
    first: usize,
    /// Nothing of what was gathered is beyond.
    far: f32,
}

impl<T: Lanes, L: Solid> Certifier<T, L> {
    pub(crate) fn new() -> Self {
        Self {
            gathered: Gathered::new(),
            part: Part {
                bare: Vec::new(),
                leaves: Vec::new(),
                nodes: Vec::new(),
            },
            together: Vec::new(),
            spans: Spans::default(),
            certificates: Box::new(Certificates::NOTHING),
        }
    }

    /// Certifies the rays of a tile that was cast, as `work` has it, and writes to the tile what is known better. Tells how many
    /// pixels show something.
    ///
    /// What was cast says how far each packet's rays need to look: a leaf that is met for certain beyond what is certified has
    /// no part in it. A function of its own, out of the way of pictures that are not certified.
    #[inline(never)]
    pub(crate) fn certify(
        &mut self,
        token: T::Token,
        view: &View<'_, '_, L>,
        corner: [u32; 2],
        wants: Wants,
        work: &mut Workspace<T, L>,
        tile: &mut Tile,
    ) -> u32 {
        let Some(picture) = &view.picture else { return 0 };
        let beam = beam_of::<T>(&picture.raster, corner);
        let mut fars = [f32::INFINITY; MOST_PACKETS];
        T::vectorize(
            token,
            #[inline(always)]
            || {
                let far = beyond(work.met.farthest(&work.rays));
                self.gathered.gather(token, view.scene, &beam, (far, picture.reach), work);
                for (packet, far) in fars.iter_mut().enumerate().take(packets::<T>()) {
                    *far = beyond(work.met.farthest_of(&work.rays, packet));
                }
            },
        );
        for (packet, far) in fars.into_iter().enumerate().take(packets::<T>()) {
            self.gathered.packet(packet, far, &mut self.part.bare, &mut self.part.leaves);
            let of = OfTile {
                view,
                picture,
                corner,
                packet,
                first: start_of::<T>(packet),
                far,
            };
            let missing = self.together(token, of, work, tile);
            if missing != 0 {
                self.one_by_one(of, missing, wants, tile);
            }
        }
        tile.distance.iter().map(|distance| u32::from(*distance < f32::INFINITY)).sum()
    }

    /// Certifies the rays of a packet all at once, and tells of which that has failed.
    fn together(&mut self, token: T::Token, of: OfTile<'_, '_, '_, L>, work: &mut Workspace<T, L>, tile: &mut Tile) -> u32 {
        let every = u32::MAX >> (u32::BITS as usize - T::LANES);
        if !of.picture.valid || self.gathered.is_inside(of.packet) {
            return every;
        }
        let known = if !self.part.leaves.is_empty() {
            work.rays.aim(token, of.view, 1 << of.packet);
            let program = (self.part.bare.as_slice(), self.part.leaves.as_slice());
            let rays = work.rays.packet(of.packet);
            certify_together(token, of.view.scene, &self.gathered, program, rays, of.far, &mut self.together)
        } else if of.far == f32::INFINITY {
            // Of nothing there is no program, and it is not met.
            Known {
                lanes: every,
                ..Known::NOTHING
            }
        } else {
            Known::NOTHING
        };
        // Where a pixel shows the leaf that is certain its normal and its face are right as well.
        let pixels = of.first..of.first + T::LANES;
        let mut shown = 0;
        for (lane, (known, seen)) in known.leaf.iter().zip(&tile.leaf[pixels.clone()]).enumerate() {
            shown |= u32::from(known == seen) << lane;
        }
        let missing = every & !(known.lanes & shown);
        if missing != every {
            // The others will be written once more.
            tile.distance[pixels.clone()].copy_from_slice(&known.t[..T::LANES]);
            self.certificates.bound[pixels.clone()].copy_from_slice(&known.bound[..T::LANES]);
            self.certificates.settled[pixels].fill(Settled::Single);
        }
        missing
    }

    /// Certifies some rays of a packet one by one.
    ///
    /// Apart from the tile's other work, which is compiled for its lanes: this is done in none.
    #[inline(never)]
    fn one_by_one(&mut self, of: OfTile<'_, '_, '_, L>, which: u32, wants: Wants, tile: &mut Tile) {
        let scene = of.view.scene;
        let is_whole = self.gathered.is_inside(of.packet);
        self.gathered
            .solids(scene, &self.part.bare, &self.part.leaves, &mut self.part.nodes);
        let whole = *scene.program();
        let is_in_order = self.gathered.are_in_order(scene, &self.part.leaves);
        let part = Program::new(&self.part.nodes).and_then(|part| part.posed(whole.poses()));
        for lane in (0..T::LANES).filter(|lane| which >> lane & 1 == 1) {
            let pixel = of.first + lane;
            let [right, down] = Tile::place_of(pixel);
            let Ok(ray) = of.picture.raster.ray(of.corner[0] + right as u32, of.corner[1] + down as u32) else {
                continue;
            };
            let of_part = match part {
                _ if is_whole => None,
                Ok(part) => self.spans.certify(&part, &ray),
                // Of nothing there is no program, and it is not met.
                Err(_) => Some(MISSED),
            };
            let known = of_part.and_then(|mut found| {
                if let Some(hit) = &mut found.hit {
                    let leaf = self.gathered.leaf(*self.part.leaves.get(hit.leaf as usize)?)?;
                    hit.leaf = scene.number(leaf.place);
                    // Beyond what was gathered nothing is known; what is found by rule is what the whole program finds.
                    let by_rule = found.settled == Settled::Tie;
                    if hit.t + if by_rule { 0.0 } else { found.bound } >= of.far {
                        return None;
                    }
                } else if of.far < f32::INFINITY {
                    return None;
                }
                // Where roots coincide the order of the leaves decides.
                (found.settled != Settled::Tie || is_in_order).then_some(found)
            });
            let found = known.or_else(|| self.spans.certify(&whole, &ray)).unwrap_or(MISSED);
            put(&found, wants, tile, &mut self.certificates, pixel);
        }
    }
}

/// What a ray finds for certain that meets nothing.
const MISSED: Certified = Certified {
    hit: None,
    bound: 0.0,
    settled: Settled::Single,
};

/// A little farther than a parameter, so that what is at it is well before.
fn beyond(far: f32) -> f32 {
    far * 1.01
}

/// Memory for spans in all arithmetics.
#[derive(Debug, Default)]
struct Spans {
    single: Vec<Span<Bounded<f32>>>,
    double: Vec<Span<Bounded<f64>>>,
    tie: Vec<Span<f64>>,
}

impl Spans {
    /// What a ray meets first, certified.
    fn certify<L: Solid>(&mut self, program: &Program<'_, L>, ray: &Ray) -> Option<Certified> {
        let leaves = program.leaves();
        if self.single.len() < leaves {
            self.single.resize(leaves, Span::empty_like(Bounded::exact(0.0)));
            self.double.resize(leaves, Span::empty_like(Bounded::exact(0.0)));
            self.tie.resize(leaves, Span::empty_like(0.0));
        }
        let scratch = CertifiedScratch {
            single: &mut self.single,
            double: &mut self.double,
            tie: &mut self.tie,
        };
        program.cast_certified(ray, scratch).ok()
    }
}

/// Writes what was found to a pixel.
fn put(found: &Certified, wants: Wants, tile: &mut Tile, certificates: &mut Certificates, pixel: usize) {
    certificates.bound[pixel] = found.bound;
    certificates.settled[pixel] = found.settled;
    let (distance, normal, leaf, face) = match found.hit {
        Some(hit) => (hit.t, hit.normal.to_array(), hit.leaf, u32::from(hit.face)),
        None => (f32::INFINITY, [0.0; 3], Pixel::NO_LEAF, 0),
    };
    tile.distance[pixel] = distance;
    tile.leaf[pixel] = leaf;
    if wants.normals | wants.faces {
        for (plane, component) in tile.normal.iter_mut().zip(normal) {
            plane[pixel] = component;
        }
    }
    if wants.faces {
        tile.face[pixel] = face;
    }
}
