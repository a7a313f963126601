//! What rays cross, as lines of text.

use super::lines::Piece;
use glam::Vec3;
use gsdf_nostd::{Anywhere, Hit, Leaf, Program, Ray, Span, march};
use gsdf_simd::{Caster, Level, Pixel, RayHits, Rays, Scene};
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
    caster: Caster<'m, 'm, Leaf>,
    form: Form,
}

/// A crossing.
#[derive(Clone, Copy, Debug, Serialize)]
struct Crossing {
    distance: f32,
    normal: [f32; 3],
    leaf: u32,
    entering: bool,
}

impl From<Hit> for Crossing {
    fn from(hit: Hit) -> Self {
        Self {
            distance: hit.t,
            normal: hit.normal.to_array(),
            leaf: hit.leaf,
            entering: hit.entering,
        }
    }
}

/// The answer to a ray that crosses nothing.
#[derive(Serialize)]
struct Miss {
    miss: bool,
}

/// The answer to a ray with all that it crosses.
#[derive(Serialize)]
struct All<'c> {
    ray: u64,
    crossings: &'c [Crossing],
}

impl<'m> Answers<'m> {
    /// For the rays of a program.
    #[must_use]
    pub fn new(program: Program<'m>, scene: &'m Scene<'m, Leaf>, level: Level, form: Form) -> Self {
        Self {
            program,
            caster: Caster::at_level(scene, level),
            form,
        }
    }

    /// The lines that answer some rays.
    #[must_use]
    pub fn of(&self, piece: &Piece) -> Vec<u8> {
        let mut text = Text::default();
        if self.form.all {
            let mut spans = vec![Span::EMPTY; self.program.leaves()];
            for (ray, number) in piece.rays.iter().zip(piece.first..) {
                let crossings = self.crossings(ray, &mut spans);
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
                    text.crossing(crossing);
                }
            }
        } else {
            for crossing in self.first(&piece.rays) {
                match (self.form.json, crossing) {
                    (false, crossing) => text.crossing(crossing),
                    (true, Some(crossing)) => text.json(&crossing),
                    (true, None) => text.json(&Miss { miss: true }),
                }
            }
        }
        text.bytes
    }

    /// The first crossing of each ray.
    fn first(&self, rays: &[Ray]) -> Vec<Option<Crossing>> {
        let axis = |of: fn(&Ray) -> Vec3, axis: usize| rays.iter().map(|ray| of(ray)[axis]).collect::<Vec<_>>();
        let origin: [_; 3] = core::array::from_fn(|number| axis(Ray::origin, number));
        let direction: [_; 3] = core::array::from_fn(|number| axis(Ray::direction, number));
        let (mut distance, mut leaf) = (vec![0.0; rays.len()], vec![0; rays.len()]);
        let [mut x, mut y, mut z] = core::array::from_fn(|_| vec![0.0; rays.len()]);
        let batch = Rays {
            origin: origin.each_ref().map(Vec::as_slice),
            direction: direction.each_ref().map(Vec::as_slice),
            range: None,
        };
        let hits = RayHits {
            distance: &mut distance,
            normal: Some([&mut x, &mut y, &mut z]),
            leaf: Some(&mut leaf),
        };
        // All slices are equally long.
        let _ = self.caster.cast(&batch, hits);
        let crossing = |(number, ray): (usize, &Ray)| {
            (leaf[number] != Pixel::NO_LEAF).then(|| {
                let normal = Vec3::new(x[number], y[number], z[number]);
                Crossing {
                    distance: distance[number],
                    normal: normal.to_array(),
                    leaf: leaf[number],
                    entering: self.is_entering(ray, normal),
                }
            })
        };
        rays.iter().enumerate().map(crossing).collect()
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

    /// All crossings of a ray, in order.
    fn crossings(&self, ray: &Ray, spans: &mut [Span<f32>]) -> Vec<Crossing> {
        let line = ray.line(0.0);
        self.program.spans_along(&line, Anywhere, spans);
        let mut crossings = Vec::new();
        let mut t = ray.start_on_line(0.0);
        loop {
            t = march(self.program.nodes(), spans, t).t;
            let parameter = ray.parameter_of(t);
            if !parameter.is_finite() {
                return crossings;
            }
            let met = self.program.surface_at(&line, Anywhere, spans, t);
            crossings.push(Hit::new(ray, parameter, &met).into());
        }
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

    fn crossing(&mut self, crossing: Option<Crossing>) {
        let Some(Crossing {
            distance,
            normal: [x, y, z],
            leaf,
            entering,
        }) = crossing
        else {
            self.bytes.extend_from_slice(b"miss\n");
            return;
        };
        for number in [distance, x, y, z] {
            self.number(number);
            self.bytes.push(b' ');
        }
        self.integer(u64::from(leaf));
        let side: &[u8] = if entering { b" entering\n" } else { b" leaving\n" };
        self.bytes.extend_from_slice(side);
    }

    /// The shortest text that reads back to this number.
    fn number(&mut self, number: f32) {
        let mut buffer = zmij::Buffer::new();
        let text = buffer.format(number);
        self.bytes.extend_from_slice(text.strip_suffix(".0").unwrap_or(text).as_bytes());
    }

    fn integer(&mut self, number: u64) {
        self.bytes.extend_from_slice(number.to_string().as_bytes());
    }
}
