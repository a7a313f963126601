//! Packets of rays held to scalar queries, on every level the machine has and whatever the lanes hold: rays that hit,
//! miss, start inside, have a range, or none at all.
#![allow(
    clippy::unwrap_used,
    clippy::missing_panics_doc,
    reason = "a check that fails panics, and does nothing else"
)]

use crate::corpus;
use crate::poses::{random_affine, random_motion};
use crate::shape::{KINDS, Shape, log_uniform};
use crate::trees::{Tree, random_ray, random_solid};
use core::fmt::Debug;
use core::ops::Range;
use glam::{Mat3, Vec3, vec3};
use gsdf_nostd::{Hit, Node, Program, Ray, Solid, Span, Transform, V3};
use gsdf_simd::{LaneMask, Lanes, Level, MOST_LANES, Packet, Work};
use rand::RngExt;
use rand_pcg::Pcg64;

/// What is asked in one lane: the numbers of a ray, which may be none.
#[derive(Clone, Debug)]
pub struct Asked {
    /// Where it starts.
    pub origin: Vec3,
    /// Where it goes.
    pub direction: Vec3,
    /// The range of its parameter.
    pub range: Range<f32>,
}

impl Asked {
    /// A ray over its whole range.
    #[must_use]
    pub fn new(origin: Vec3, direction: Vec3) -> Self {
        Self {
            origin,
            direction,
            range: 0.0..f32::INFINITY,
        }
    }

    /// The scalar query's ray, if these numbers make one.
    #[must_use]
    pub fn ray(&self) -> Option<Ray> {
        Ray::new(self.origin, self.direction)
            .and_then(|ray| ray.within(self.range.clone()))
            .ok()
    }

    /// The same with one number made such as no ray has.
    #[must_use]
    pub fn spoilt(self, rng: &mut Pcg64) -> Self {
        let (mut origin, mut direction) = (self.origin, self.direction);
        let axis = rng.random_range(0..3);
        let range = match rng.random_range(0..12) {
            0 => f32::NAN..1.0,
            1 => 0.0..f32::NAN,
            2 => -1.0..1.0,
            3 => 1.0..1.0,
            4 => f32::INFINITY..f32::INFINITY,
            fault => {
                match fault {
                    5 => origin[axis] = f32::NAN,
                    6 => origin[axis] = f32::NEG_INFINITY,
                    7 => origin[axis] = 1.1e9,
                    8 => direction[axis] = f32::NAN,
                    9 => direction = Vec3::ZERO,
                    10 => direction = vec3(1e-13, -1e-40, 0.0),
                    _ => direction[axis] = -1.2e12,
                }
                self.range
            }
        };
        Self { origin, direction, range }
    }

    /// The ray as it is, in another unit, with a range (also one that starts or ends at its very hit), or spoilt.
    #[must_use]
    pub fn varied<L: Solid>(mut self, rng: &mut Pcg64, program: &Program<'_, L>) -> Self {
        if rng.random_range(0..3) == 0 {
            self.direction *= log_uniform(rng, 1e-8, 1e8) as f32;
        }
        let unit = 1.0 / self.direction.length();
        let hit = self.ray().and_then(|ray| scalar_hit(program, ray)).map_or(unit, |hit| hit.t);
        match rng.random_range(0..12) {
            0..6 => self,
            6 => Self {
                range: hit..f32::INFINITY,
                ..self
            },
            7 => Self {
                range: 0.0..hit.max(f32::MIN_POSITIVE),
                ..self
            },
            8 => {
                let start = hit * rng.random_range(0.0..1.5);
                let range = start..start + unit * rng.random_range(0.1_f32..9.0);
                Self { range, ..self }
            }
            _ => self.spoilt(rng),
        }
    }
}

/// How often what was found in the lanes.
#[derive(Clone, Copy, Debug, Default)]
pub struct Count {
    /// All lanes.
    pub lanes: usize,
    /// Rays that hit something.
    pub hits: usize,
    /// Rays that do not.
    pub misses: usize,
    /// Lanes without a ray.
    pub invalid: usize,
    /// Rays that start inside.
    pub inside: usize,
    /// Packets with a lane of each kind.
    pub mixed: usize,
}

impl Count {
    /// Both counts as one.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            lanes: self.lanes + other.lanes,
            hits: self.hits + other.hits,
            misses: self.misses + other.misses,
            invalid: self.invalid + other.invalid,
            inside: self.inside + other.inside,
            mixed: self.mixed + other.mixed,
        }
    }

    /// A corpus that had lost one kind of lane would prove nothing about it.
    pub fn assert_quotas(self) {
        println!("{self:?}");
        let kinds = [self.hits, self.misses, self.invalid, self.inside];
        assert!(kinds.iter().all(|kind| kind * 20 > self.lanes), "too few of a kind: {self:?}");
        assert!(self.mixed * 8 * 10 > self.lanes, "too few mixed packets: {self:?}");
    }
}

/// What the scalar query finds.
#[must_use]
pub fn scalar_hit<L: Solid>(program: &Program<'_, L>, ray: Ray) -> Option<Hit> {
    let mut spans = vec![Span::EMPTY; program.leaves()];
    program.along(ray, &mut spans).unwrap().cast()
}

/// Every number of a hit, zeros of both signs told apart.
#[must_use]
pub fn bits(hit: &Hit) -> [u32; 10] {
    let ([px, py, pz], [nx, ny, nz]) = (hit.point.to_array(), hit.normal.to_array());
    let [t, px, py, pz, nx, ny, nz] = [hit.t, px, py, pz, nx, ny, nz].map(f32::to_bits);
    [t, px, py, pz, nx, ny, nz, hit.leaf, hit.face.into(), hit.entering.into()]
}

/// As many rays as there are lanes, by their numbers: these over and over.
#[must_use]
pub fn packet<T: Lanes>(token: T::Token, asked: &[Asked; 8]) -> Packet<T> {
    let of = |value: &dyn Fn(&Asked) -> f32| {
        let lanes: [f32; MOST_LANES] = core::array::from_fn(|lane| value(&asked[lane % 8]));
        T::load(token, &lanes)
    };
    Packet::from_lanes(
        V3::new(of(&|a| a.origin.x), of(&|a| a.origin.y), of(&|a| a.origin.z)),
        V3::new(of(&|a| a.direction.x), of(&|a| a.direction.y), of(&|a| a.direction.z)),
        of(&|a| a.range.start),
        of(&|a| a.range.end),
    )
}

/// What one lane of a packet finds.
#[derive(Clone, Copy, Debug)]
struct Found {
    valid: bool,
    hit: bool,
    t: f32,
    /// Where the lane has a ray.
    whole: Option<Hit>,
    distance: f32,
}

/// A program asked for validity, cast and directional distance.
struct Queries<'a, L> {
    program: &'a Program<'a, L>,
    asked: &'a [Asked; 8],
}

impl<L: Solid> Work for Queries<'_, L> {
    type Output = Vec<Found>;

    fn run<T: Lanes>(self, token: T::Token) -> Vec<Found> {
        let Self { program, asked } = self;
        let packet = packet::<T>(token, asked);
        let mut spans = vec![Span::empty_like(T::splat(token, 0.0)); program.leaves()];
        let (hits, distances) = T::vectorize(
            token,
            #[inline(always)]
            || (packet.cast(program, &mut spans).unwrap(), packet.gsdf(program, &mut spans).unwrap()),
        );
        let found = |lane: usize| Found {
            valid: packet.valid().to_bits() >> lane & 1 == 1,
            hit: hits.hit.to_bits() >> lane & 1 == 1,
            t: hits.t.lane(lane).unwrap(),
            whole: asked[lane % 8].ray().and_then(|ray| hits.lane(lane, &ray)),
            distance: distances.lane(lane).unwrap(),
        };
        (0..T::LANES).map(found).collect()
    }
}

/// Validity, cast and directional distance of eight rays: on every level those of the scalar queries, and nothing in
/// lanes without a ray.
pub fn check<L: Solid + Debug>(program: &Program<'_, L>, asked: &[Asked; 8]) -> Count {
    let found: Vec<_> = Level::available()
        .map(|level| (level, level.run(Queries { program, asked })))
        .collect();
    let mut count = Count {
        lanes: 8,
        ..Count::default()
    };
    for (number, asked) in asked.iter().enumerate() {
        let ray = asked.ray();
        let expected = ray.and_then(|ray| scalar_hit(program, ray));
        let signed = ray.map(|ray| {
            let mut spans = vec![Span::EMPTY; program.leaves()];
            program.along(ray, &mut spans).unwrap().gsdf::<f32>()
        });
        for (level, lanes) in &found {
            for (lane, found) in lanes.iter().enumerate().filter(|(lane, _)| lane % 8 == number) {
                let what = || format!("{level}, lane {lane}: {asked:?} in {:?}", program.nodes());
                assert_eq!(found.valid, ray.is_some(), "{}", what());
                assert_eq!(found.hit, expected.is_some(), "{}", what());
                assert_eq!(found.t, expected.map_or(f32::INFINITY, |hit| hit.t), "{}", what());
                assert_eq!(
                    found.whole.as_ref().map(bits),
                    expected.as_ref().map(bits),
                    "{}: {found:?}, not {expected:?}",
                    what()
                );
                assert_eq!(found.whole, expected, "{}", what());
                assert_eq!(
                    (found.distance.is_nan(), found.distance.to_bits()),
                    signed.map_or((true, found.distance.to_bits()), |signed| (false, signed.to_bits())),
                    "{}: {}, not {signed:?}",
                    what(),
                    found.distance
                );
            }
        }
        count.hits += usize::from(expected.is_some());
        count.misses += usize::from(ray.is_some() && expected.is_none());
        count.invalid += usize::from(ray.is_none());
        count.inside += usize::from(signed.is_some_and(|signed| signed < 0.0));
    }
    count.mixed = usize::from([count.hits, count.misses, count.invalid, count.inside].iter().all(|&kind| kind > 0));
    count
}

/// A random program in the world and in two posed frames.
#[derive(Clone, Debug)]
pub struct Composed {
    shapes: Vec<(Option<Shape>, u16)>,
    nodes: Vec<Node>,
    poses: [Transform; 2],
}

impl Composed {
    /// A random one: in half of them of solids on a grid, whose faces coincide.
    pub fn random(rng: &mut Pcg64) -> Self {
        let leaves = Tree::random_size(rng);
        let on_grid = rng.random_range(0..2) == 0;
        let shapes: Vec<_> = (0..leaves)
            .map(|_| {
                let kind = rng.random_range(0..KINDS.len());
                let shape = (!on_grid).then(|| Shape::random(rng, kind, 1.0, 1.5));
                (shape, if rng.random() { 0 } else { rng.random_range(1..=2) })
            })
            .collect();
        let solids: Vec<_> = shapes
            .iter()
            .map(|(shape, _)| shape.map_or_else(|| random_solid(rng), |shape| shape.leaf().unwrap()))
            .collect();
        let mut nodes = Tree::random(rng, leaves).postfix(&solids);
        let mut frames = shapes.iter().map(|(_, frame)| *frame);
        for node in &mut nodes {
            if let Node::Leaf { frame, .. } = node {
                *frame = frames.next().unwrap();
            }
        }
        let poses = [random_motion(rng), random_affine(rng, 4.0)];
        Self { shapes, nodes, poses }
    }

    /// The program, posed.
    #[must_use]
    pub fn program(&self) -> Program<'_> {
        Program::new(&self.nodes).unwrap().posed(&self.poses).unwrap()
    }

    /// A ray at one of the solids, in whatever frame it is.
    #[must_use]
    pub fn aimed(&self, rng: &mut Pcg64) -> Asked {
        let (shape, frame) = self.shapes[rng.random_range(0..self.shapes.len())];
        let (origin, direction) = match shape {
            Some(shape) => {
                let (_, trial) = corpus::ray(rng, &shape, 1.0, 1e2);
                (trial.origin, trial.direction)
            }
            None => random_ray(rng),
        };
        match usize::from(frame).checked_sub(1).map(|index| self.poses[index]) {
            None => Asked::new(origin, direction),
            Some(pose) => {
                let [x, y, z] = pose.to_local();
                let to_world = Mat3::from_cols(x, y, z).transpose().inverse();
                Asked::new(to_world * origin + pose.origin(), to_world * direction)
            }
        }
    }
}
