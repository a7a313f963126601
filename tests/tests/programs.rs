//! Random programs of random solids, along rays aimed at them, against exact arithmetic.

use gsdf_nostd::{Node, Program, Ray, Span};
use gsdf_tests::corpus;
use gsdf_tests::reference::Expr;
use gsdf_tests::sandwich::{Trial, disagreements};
use gsdf_tests::shape::{KINDS, Shape};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;

/// How many rounding errors off its surface a crossing may be.
const ALLOWED: f64 = 8.0;

/// A program and the same solid in exact arithmetic.
struct Composed {
    shapes: Vec<Shape>,
    nodes: Vec<Node>,
    exact: Expr,
}

impl Composed {
    /// A random tree of this many leaves. One leaf in four repeats an earlier one, so that surfaces coincide.
    fn random(rng: &mut Pcg64, leaves: usize) -> Self {
        let mut composed = Self {
            shapes: Vec::new(),
            nodes: Vec::new(),
            exact: Expr::Or(Vec::new()),
        };
        composed.exact = composed.grow(rng, leaves);
        composed
    }

    fn grow(&mut self, rng: &mut Pcg64, leaves: usize) -> Expr {
        if leaves == 1 {
            let shape = if !self.shapes.is_empty() && rng.random_range(0..4) == 0 {
                self.shapes[rng.random_range(0..self.shapes.len())]
            } else {
                let kind = rng.random_range(0..KINDS.len());
                Shape::random(rng, kind, 1.0, 1.5)
            };
            self.shapes.push(shape);
            self.nodes.push(Node::leaf(shape.leaf().unwrap()));
            let exact = shape.exact(0.0);
            if rng.random_range(0..8) == 0 {
                self.nodes.push(Node::Complement);
                return exact.complement();
            }
            return exact;
        }
        let left = rng.random_range(1..leaves);
        let (first, second) = (self.grow(rng, left), self.grow(rng, leaves - left));
        let (node, exact) = match rng.random_range(0..4) {
            0 | 1 => (Node::Union, first.or(second)),
            2 => (Node::Intersection, first.and(second)),
            _ => (Node::Difference, first.minus(second)),
        };
        self.nodes.push(node);
        exact
    }
}

/// What one program and one ray came to.
struct Outcome {
    crossings: usize,
    inside: bool,
    unexplained: Option<String>,
}

fn cast(seed: u64) -> Outcome {
    let mut rng = Pcg64::seed_from_u64(seed);
    let leaves = rng.random_range(3..=12);
    let composed = Composed::random(&mut rng, leaves);
    let target = composed.shapes[rng.random_range(0..leaves)];
    let (_, Trial { origin, direction, .. }) = corpus::ray(&mut rng, &target, 1.0, 1e3);

    let program = Program::new(&composed.nodes).unwrap();
    let mut scratch = [Span::EMPTY; 12];
    let sight = program.along(Ray::new(origin, direction).unwrap(), &mut scratch).unwrap();
    let starts_inside = sight.march::<f32>().inside;
    let crossings: Vec<_> = sight.crossings::<f32>().collect();

    // The computed spans ahead of the origin.
    let mut ends: Vec<f64> = crossings.iter().map(|crossing| f64::from(crossing.t)).collect();
    if starts_inside {
        ends.insert(0, 0.0);
    }
    if ends.len() % 2 == 1 {
        ends.push(f64::INFINITY);
    }
    let computed: Vec<_> = ends.chunks_exact(2).map(|pair| (pair[0], pair[1])).collect();
    let exact: Vec<_> = (composed.exact.spans(origin, direction).iter())
        .map(|(enter, exit)| (enter.to_f64().max(0.0), exit.to_f64()))
        .filter(|(enter, exit)| enter < exit)
        .collect();

    let near_a_surface = |t: f64| {
        let on = |&shape: &Shape| Trial { shape, origin, direction }.is_near_surface(t, ALLOWED);
        composed.shapes.iter().any(on)
    };
    let unexplained = disagreements(&exact, &computed)
        .into_iter()
        .find(|&(t, _)| t >= 0.0 && !near_a_surface(t))
        .map(|(t, _)| {
            format!(
                "seed {seed}: at {t} of {origin} + t {direction}: exact {exact:?}, computed {computed:?}, {:?}",
                composed.nodes
            )
        });
    Outcome {
        crossings: crossings.len(),
        inside: starts_inside,
        unexplained,
    }
}

/// All crossings of a program, hence its first hit and the sign and size of both readings along the ray.
#[test]
fn crossings_are_those_of_exact_arithmetic() {
    const RAYS: u64 = 20_000;
    let outcomes: Vec<_> = (0..RAYS).into_par_iter().map(cast).collect();
    if let Some(report) = outcomes.iter().find_map(|outcome| outcome.unexplained.as_ref()) {
        panic!("{report}");
    }
    let share = |keeps: fn(&Outcome) -> bool| 100 * outcomes.iter().filter(|outcome| keeps(outcome)).count() as u64 / RAYS;
    let (hits, inside, several) = (
        share(|outcome| outcome.crossings > 0),
        share(|outcome| outcome.inside),
        share(|outcome| outcome.crossings > 1),
    );
    assert!(
        hits >= 30 && inside >= 10 && several >= 10,
        "the corpus lost its aim: {hits} % hit, {inside} % inside, {several} % cross more than once"
    );
}
