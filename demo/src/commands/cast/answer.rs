//! What rays cross, as lines of text.

use super::lines::Piece;
use crate::batch::Batch;
use crate::commands::tier;
use crate::commands::tier::{Alone, Certainty, Distance, Tier};
use crate::frame::Met;
use glam::Vec3;
use gsdf_nostd::{Leaf, Program, Ray, Span};
use gsdf_simd::{Caster, Level, Scene};
use gsdf_trade::Primitive;
use serde::Serialize;

/// How rays are answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Form {
    /// With all crossings.
    pub all: bool,
    /// In JSON.
    pub json: bool,
}

/// Answers the rays of a model.
pub struct Answers<'m> {
    program: Program<'m>,
    /// The same, for rays that are cast one by one.
    solids: Program<'m, Primitive>,
    /// Casts rays in the tier that is prepared for it.
    caster: Caster<'m, 'm, Leaf>,
    tier: Tier,
    form: Form,
}

/// A crossing.
#[derive(Clone, Copy, Debug, Serialize)]
struct Crossing {
    distance: Distance,
    normal: [f32; 3],
    leaf: u32,
    entering: bool,
}

impl From<tier::Crossing> for Crossing {
    fn from(crossing: tier::Crossing) -> Self {
        let hit = crossing.hit;
        Self {
            distance: crossing.distance,
            normal: hit.normal.to_array(),
            leaf: hit.leaf,
            entering: hit.entering,
        }
    }
}

/// The first crossing of a ray, if there is one, and how certain that is, if that was asked for.
#[derive(Clone, Copy, Serialize)]
struct First {
    #[serde(flatten)]
    crossing: Found,
    #[serde(flatten)]
    certainty: Option<Certainty>,
}

#[derive(Clone, Copy, Serialize)]
#[serde(untagged)]
enum Found {
    Hit(Crossing),
    Miss { miss: bool },
}

/// The answer to a ray with all that it crosses.
#[derive(Serialize)]
struct All<'c> {
    ray: u64,
    crossings: &'c [Crossing],
}

impl<'m> Answers<'m> {
    /// For the rays of a scene, in a tier; `solids` are its program.
    #[must_use]
    pub fn new(solids: Program<'m, Primitive>, scene: &'m Scene<'m, Leaf>, level: Level, tier: Tier, form: Form) -> Self {
        Self {
            program: *scene.program(),
            solids,
            caster: Caster::at_level(scene, level),
            tier,
            form,
        }
    }

    /// The lines that answer some rays.
    #[must_use]
    pub fn of(&self, piece: &Piece) -> Vec<u8> {
        let mut text = Text::default();
        if self.form.all {
            let mut alone = Alone::new(self.solids, self.tier);
            for (ray, number) in piece.rays.iter().zip(piece.first..) {
                let crossings: Vec<Crossing> = alone.all(ray).into_iter().map(Crossing::from).collect();
                if self.form.json {
                    text.json(&All {
                        ray: number,
                        crossings: &crossings,
                    });
                    continue;
                }
                for crossing in crossings.iter().copied().map(Some).chain(crossings.is_empty().then_some(None)) {
                    text.integer(number);
                    text.bytes.push(b' ');
                    text.answer(crossing, None);
                }
            }
            return text.bytes;
        }
        let firsts = match self.tier {
            Tier::Robust => self.together(&piece.rays),
            _ => self.one_by_one(&piece.rays),
        };
        for (crossing, certainty) in firsts {
            if self.form.json {
                let crossing = crossing.map_or(Found::Miss { miss: true }, Found::Hit);
                text.json(&First { crossing, certainty });
            } else {
                text.answer(crossing, certainty);
            }
        }
        text.bytes
    }

    /// The first crossing of each ray, and how certain it is.
    fn one_by_one(&self, rays: &[Ray]) -> Vec<(Option<Crossing>, Option<Certainty>)> {
        let mut alone = Alone::new(self.solids, self.tier);
        let first = |ray| {
            let (crossing, certainty) = alone.first(ray);
            (crossing.map(Crossing::from), certainty)
        };
        rays.iter().map(first).collect()
    }

    /// The first crossing of each ray, in the robust tier, of which nothing is certified.
    fn together(&self, rays: &[Ray]) -> Vec<(Option<Crossing>, Option<Certainty>)> {
        let mut batch = Batch::default();
        for ray in rays {
            batch.push(ray.origin(), ray.direction());
        }
        let crossing = |(ray, met): (&Ray, Option<Met>)| {
            let crossing = met.map(|met| Crossing {
                distance: Distance::Single(met.t),
                normal: met.normal.to_array(),
                leaf: met.leaf,
                entering: self.is_entering(ray, met.normal),
            });
            (crossing, None)
        };
        rays.iter().zip(batch.cast(&self.caster)).map(crossing).collect()
    }

    /// Whether a ray enters the model where it first crosses the surface, which has this normal.
    fn is_entering(&self, ray: &Ray, normal: Vec3) -> bool {
        /// Where the ray is this near to lying in the surface, rounding can turn the sign.
        const FLAT: f32 = 1e-5;
        let direction = ray.direction();
        let against = -normal.dot(direction) / direction.abs().max_element();
        if against.abs() > FLAT {
            return against > 0.0;
        }
        let mut spans = vec![Span::<f32>::EMPTY; self.program.leaves()];
        let hit = self.program.along(*ray, &mut spans).ok().and_then(|sight| sight.cast());
        hit.is_none_or(|hit| hit.entering)
    }
}

/// Lines being written.
#[derive(Default)]
struct Text {
    bytes: Vec<u8>,
}

impl Text {
    fn json(&mut self, answer: &impl Serialize) {
        // Numbers and lists of them can always be written.
        let _ = serde_json::to_writer(&mut self.bytes, answer);
        self.bytes.push(b'\n');
    }

    fn answer(&mut self, crossing: Option<Crossing>, certainty: Option<Certainty>) {
        match crossing {
            Some(crossing) => self.crossing(&crossing),
            None => self.bytes.extend_from_slice(b"miss"),
        }
        if let Some(certainty) = certainty {
            self.bytes.push(b' ');
            self.number(certainty.bound);
            self.bytes.push(b' ');
            self.bytes.extend_from_slice(certainty.name().as_bytes());
        }
        self.bytes.push(b'\n');
    }

    fn crossing(&mut self, crossing: &Crossing) {
        match crossing.distance {
            Distance::Single(distance) => self.number(distance),
            Distance::Double(distance) => self.number(distance),
        }
        self.bytes.push(b' ');
        for number in crossing.normal {
            self.number(number);
            self.bytes.push(b' ');
        }
        self.integer(u64::from(crossing.leaf));
        let side: &[u8] = if crossing.entering { b" entering" } else { b" leaving" };
        self.bytes.extend_from_slice(side);
    }

    /// The shortest text that reads back to this number.
    fn number(&mut self, number: impl zmij::Float) {
        let mut buffer = zmij::Buffer::new();
        let text = buffer.format(number);
        self.bytes.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
    }

    fn integer(&mut self, number: u64) {
        self.bytes.extend_from_slice(number.to_string().as_bytes());
    }
}
