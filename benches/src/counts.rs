//! What a ray costs in operations: the same numbers on every machine.

use crate::arena::{Arena, tracer};
use crate::inputs::{COUNT, Inputs, SEED};
use crate::leaves::{Visitor, visit_leaves};
use crate::scenes::Scene;
use anyhow::Result;
use gsdf_counted::{Counted, Operations, counting};
use gsdf_nostd::{Anywhere, March, Ray, Solid, Span, Toward, V3, march};

/// Operations, added up over many queries.
#[derive(Clone, Copy, Debug, Default)]
pub struct Tally {
    /// How many queries.
    pub queries: u64,
    /// What they took together.
    pub operations: Operations,
}

impl Tally {
    /// Does a query and adds what it took.
    pub fn query<R>(&mut self, work: impl FnOnce() -> R) -> R {
        let (result, operations) = counting(work);
        self.queries += 1;
        self.operations += operations;
        result
    }
}

/// A leaf's operations, stage by stage.
#[derive(Clone, Debug)]
pub struct LeafCounts {
    /// The name of the leaf.
    pub name: &'static str,
    /// The share of the rays that hit.
    pub hit_rate: f64,
    /// The standard distance at a point.
    pub sdf: Tally,
    /// What depends on a ray's origin alone.
    pub seen_from: Tally,
    /// The rest of its span along a ray.
    pub span: Tally,
    /// The surface where a ray enters or leaves; only for the rays that hit.
    pub surface: Tally,
}

/// The operations that depend on a ray's direction alone, as written: a compiler drops the reciprocals that no leaf of a program looks at.
#[must_use]
pub fn of_direction() -> Tally {
    let mut tally = Tally::default();
    let one = Counted(1.0);
    tally.query(|| Toward::new(V3::new(one, one, one)));
    tally
}

/// The operations of a leaf of each kind, over the inputs of the benchmark of leaves.
#[must_use]
pub fn of_leaves() -> Vec<LeafCounts> {
    let mut leaves = Leaves(Vec::new());
    visit_leaves(&mut leaves);
    leaves.0
}

struct Leaves(Vec<LeafCounts>);

impl Visitor for Leaves {
    fn leaf<S: Solid>(&mut self, name: &'static str, solid: S) {
        let inputs = Inputs::new(&solid, name, COUNT, SEED);
        let [mut sdf, mut seen_from, mut span, mut surface] = [Tally::default(); 4];
        for point in inputs.points.iter().map(counted) {
            sdf.query(|| solid.distance(point));
        }
        for (origin, direction) in &inputs.rays {
            let toward = Toward::new(counted(direction));
            let seen = seen_from.query(|| solid.seen_from(counted(origin)));
            let found = span.query(|| solid.span(&seen, &toward));
            let end = if found.enter.0.is_finite() { found.enter } else { found.exit };
            if end.0.is_finite() {
                surface.query(|| solid.surface(&seen, &toward, end));
            }
        }
        self.0.push(LeafCounts {
            name,
            hit_rate: inputs.hit_rate,
            sdf,
            seen_from,
            span,
            surface,
        });
    }
}

fn counted(v: &V3<f32>) -> V3<Counted> {
    V3::new(Counted(v.x), Counted(v.y), Counted(v.z))
}

/// What the primary rays of a scene take.
#[derive(Clone, Debug)]
pub struct SceneCounts {
    /// The name of the scene.
    pub name: &'static str,
    /// How many leaves it has.
    pub leaves: usize,
    /// The pixels along each side of the picture.
    pub size: u32,
    /// The rays that hit something.
    pub hits: u64,
    /// The finite ends of all leaves' spans: their roots, ahead of the rays and behind.
    pub roots: u64,
    /// Sweeps over the program.
    pub sweeps: Repetitions,
    /// The closed form: ray by ray, with the normal where it hits.
    pub closed: Tally,
    /// The marcher, by relaxation: its steps and operations.
    pub traced: Vec<(f32, Repetitions, Tally)>,
}

/// How often something was repeated, over many rays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Repetitions {
    /// By all rays together.
    pub total: u64,
    /// By the ray that took the most.
    pub most: u32,
}

impl Repetitions {
    fn add(&mut self, repetitions: u32) {
        self.total += u64::from(repetitions);
        self.most = self.most.max(repetitions);
    }
}

/// The counts of a scene's picture of `size` by `size` pixels.
///
/// # Errors
/// Where the scene is not a program, or a ray is none.
pub fn of_scene(scene: &Scene, size: u32) -> Result<SceneCounts> {
    let arena = Arena::new(scene, size)?;
    let mut counts = SceneCounts {
        name: scene.name,
        leaves: arena.program.leaves(),
        size,
        hits: 0,
        roots: 0,
        sweeps: Repetitions::default(),
        closed: Tally::default(),
        traced: [1.0, 1.2]
            .map(|relaxation| (relaxation, Repetitions::default(), Tally::default()))
            .into(),
    };
    let mut spans = vec![Span::empty_like(Counted(0.0)); arena.program.leaves()];
    for (x, y) in (0..size).flat_map(|y| (0..size).map(move |x| (x, y))) {
        let ray = arena.raster.ray(x, y)?;
        let found = counts.closed.query(|| cast(&arena, &ray, &mut spans));
        counts.sweeps.add(found.sweeps);
        counts.hits += u64::from(found.t.0.is_finite());
        counts.roots += (spans.iter())
            .map(|span| u64::from(span.enter.0.is_finite()) + u64::from(span.exit.0.is_finite()))
            .sum::<u64>();
        let ray = ray.within(0.0..arena.end)?;
        for (relaxation, steps, tally) in &mut counts.traced {
            let traced = tally.query(|| tracer(*relaxation).cast_in(&arena.program, &ray, Counted(0.0)));
            steps.add(traced.steps);
        }
    }
    Ok(counts)
}

/// A first hit with its surface, in the three stages of [`Program`](gsdf_nostd::Program).
fn cast(arena: &Arena<'_>, ray: &Ray, spans: &mut [Span<Counted>]) -> March<Counted> {
    let zero = Counted(0.0);
    let line = ray.line(zero);
    arena.program.spans_along(&line, Anywhere, spans);
    let found = march(arena.program.nodes(), spans, zero);
    if found.t.0.is_finite() {
        arena.program.surface_at(&line, Anywhere, spans, found.t);
    }
    found
}

#[cfg(test)]
mod tests {
    use super::{of_direction, of_leaves, of_scene};
    use crate::inputs::Inputs;
    use crate::leaves::{Visitor, ray_kernel, visit_leaves};
    use crate::scenes::Scene;
    use anyhow::Result;
    use glam::{Vec3, vec3};
    use gsdf_counted::{Counted, counting};
    use gsdf_nostd::{Solid, Sphere, V3};

    #[test]
    fn a_direction_is_four_divisions() {
        let tally = of_direction();
        assert_eq!((tally.operations.divisions, tally.operations.square_roots), (4, 0));
    }

    #[test]
    fn leaves_take_what_their_documentation_says() {
        let leaves = of_leaves();
        let of = |name: &str| leaves.iter().find(|leaf| leaf.name == name).cloned().expect("a leaf");
        let sphere = of("sphere");
        assert_eq!(sphere.sdf.operations.square_roots, sphere.sdf.queries);
        // One square root and one division where the ray's line meets it, none elsewhere.
        assert_eq!(sphere.span.operations.square_roots, sphere.surface.queries);
        let cuboid = of("cuboid");
        assert_eq!((cuboid.span.operations.square_roots, cuboid.span.operations.divisions), (0, 0));
    }

    #[test]
    fn a_scene_is_counted_as_it_is_cast() -> Result<()> {
        let scene = Scene::by_name("s2")?;
        let counts = of_scene(&scene, 24)?;
        let (closed, again) = (counts.closed.operations, of_scene(&scene, 24)?.closed.operations);
        assert_eq!(closed, again);
        assert_eq!(counts.closed.queries, 24 * 24);
        assert!(counts.hits > 0 && counts.roots > 0);
        assert!(counts.sweeps.most as usize <= scene.program()?.max_sweeps());
        for (_, steps, tally) in &counts.traced {
            assert!(steps.most <= 128 && steps.total >= tally.queries);
            assert!(tally.operations.square_roots >= steps.total);
        }
        Ok(())
    }

    #[test]
    fn a_sphere_takes_one_square_root_where_it_is_hit_and_none_where_it_is_missed() -> Result<(), gsdf_nostd::Invalid> {
        let sphere = Sphere::new(Vec3::ZERO, 1.0)?;
        let origin = V3::splat(Counted(0.0), vec3(0.0, 0.0, 4.0));
        let towards = |v: Vec3| counting(|| ray_kernel(&sphere, origin, V3::splat(Counted(0.0), v)));
        let (t, hit) = towards(Vec3::NEG_Z);
        assert_eq!((t, hit.square_roots), (Counted(3.0), 1));
        let (t, miss) = towards(Vec3::Z + Vec3::X * 9.0);
        assert_eq!((t, miss.square_roots), (Counted(f32::INFINITY), 0));
        Ok(())
    }

    struct SameBits;

    impl Visitor for SameBits {
        fn leaf<S: Solid>(&mut self, name: &'static str, solid: S) {
            let inputs = Inputs::new(&solid, name, 512, 7);
            let counted = |v: V3<f32>| V3::new(Counted(v.x), Counted(v.y), Counted(v.z));
            for (origin, direction) in inputs.rays {
                let plain = ray_kernel(&solid, origin, direction);
                assert_eq!(
                    ray_kernel(&solid, counted(origin), counted(direction)).0.to_bits(),
                    plain.to_bits(),
                    "{name}"
                );
            }
            for point in inputs.points {
                let plain = solid.distance(point);
                assert_eq!(solid.distance(counted(point)).0.to_bits(), plain.to_bits(), "{name}");
            }
        }
    }

    #[test]
    fn counting_changes_no_bit() {
        visit_leaves(&mut SameBits);
    }
}
