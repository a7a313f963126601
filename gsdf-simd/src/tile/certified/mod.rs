//! What the rays of a tile meet, certified: ray by ray, of those leaves alone that their packet may meet.

mod gather;

use super::beam_of;
use super::pixels::{Pixel, TILE_PIXELS, Tile};
use super::rays::{packets, start_of};
use super::state::Workspace;
use crate::lanes::Lanes;
use crate::scene::{Picture, Scene, View};
use crate::target::Wants;
use gather::Gathered;
use gsdf_nostd::{Bounded, Certified, CertifiedScratch, Node, Program, Ray, Settled, Solid, Span};

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
pub(crate) struct Certifier<L> {
    gathered: Gathered,
    /// The program of what one packet may meet, and the places of its leaves in the scene.
    nodes: Vec<Node<L>>,
    places: Vec<u32>,
    spans: Spans,
    pub(crate) certificates: Box<Certificates>,
}

impl<L: Solid> Certifier<L> {
    pub(crate) fn new() -> Self {
        Self {
            gathered: Gathered::default(),
            nodes: Vec::new(),
            places: Vec::new(),
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
    pub(crate) fn certify<T: Lanes>(
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
        let far = beyond(work.met.farthest(&work.rays));
        T::vectorize(
            token,
            #[inline(always)]
            || self.gathered.gather(token, view.scene, &beam, far, work),
        );
        for packet in 0..packets::<T>() {
            let far = beyond(work.met.farthest_of(&work.rays, packet));
            let first = start_of::<T>(packet);
            self.certify_packet(view.scene, picture, corner, packet, far, first..first + T::LANES, wants, tile);
        }
        tile.distance.iter().map(|distance| u32::from(*distance < f32::INFINITY)).sum()
    }

    /// Certifies the rays of a packet, which have met something nearer than `far`.
    ///
    /// Apart from the tile's other work, which is compiled for its lanes: this is done in none.
    #[inline(never)]
    #[allow(clippy::too_many_arguments, reason = "what a packet is made of, passed through")]
    fn certify_packet(
        &mut self,
        scene: &Scene<'_, L>,
        picture: &Picture,
        [x, y]: [u32; 2],
        packet: usize,
        far: f32,
        pixels: core::ops::Range<usize>,
        wants: Wants,
        tile: &mut Tile,
    ) {
        self.gathered.packet(packet, far, scene, &mut self.nodes, &mut self.places);
        // What they leave that are inside of a part all the way is not among what was gathered.
        let is_whole = self.gathered.inside >> packet & 1 == 1;
        let whole = *scene.program();
        let part = Program::new(&self.nodes).and_then(|part| part.posed(whole.poses()));
        for pixel in pixels {
            let [right, down] = Tile::place_of(pixel);
            let Ok(ray) = picture.raster.ray(x + right as u32, y + down as u32) else {
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
                    hit.leaf = scene.number(*self.places.get(hit.leaf as usize)?);
                    // Beyond what was gathered nothing is known.
                    if hit.t + found.bound >= far {
                        return None;
                    }
                } else if far < f32::INFINITY {
                    return None;
                }
                (found.settled != Settled::Tie).then_some(found)
            });
            // Of roots that coincide the rule of the whole program decides.
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
