//! The references themselves: what is exact, what is defined and what is on the surface describe one solid.

use glam::DVec3;
use gsdf_tests::shape::composed::{COMPOSED, Composed};
use gsdf_tests::shape::{KINDS, Shape, log_uniform, unit};
use rand::{Rng, SeedableRng};
use rand_pcg::Pcg64;

const SOLIDS: u64 = 60;
const POINTS: usize = 20;

/// What a test must know of a reference.
struct Reference<'a> {
    name: &'a str,
    size: f64,
    extent: f64,
    is_facet: bool,
    holds: &'a dyn Fn(DVec3) -> bool,
    contains: &'a dyn Fn(f64, DVec3) -> bool,
    to_surface: &'a dyn Fn(DVec3) -> f64,
    surface: &'a dyn Fn(&mut Pcg64) -> (DVec3, DVec3),
    edge_point: &'a dyn Fn(&mut Pcg64) -> DVec3,
}

impl Reference<'_> {
    /// Checks random points, and says at how many of the surface there is nothing a step behind it.
    fn check(&self, rng: &mut Pcg64) -> usize {
        let Self { name, size, extent, .. } = *self;
        let tiny = 1e-12 * (extent + 10.0 * size);
        let mut near_edges = 0;
        for _ in 0..POINTS {
            let (on, normal) = (self.surface)(rng);
            assert!((normal.length() - 1.0).abs() < 1e-6, "{name}: normal {normal}");
            let edge = (self.edge_point)(rng);
            // Axes are of unit length in single precision only.
            let slack = 1e-6 * (extent + 10.0 * size);
            for point in [on, edge] {
                let distance = (self.to_surface)(point);
                assert!(distance <= slack, "{name}: {point} is {distance} off the surface");
                assert!((self.contains)(2.0 * slack, point), "{name}: {point} is outside");
                assert!(!(self.contains)(-2.0 * slack, point), "{name}: {point} is inside");
            }
            // Across the surface by a little there is the one side, and the other.
            if !self.is_facet {
                let step = 1e-5 * size;
                let sides = [-step, step].map(|step| (self.contains)(0.0, on + normal * step));
                near_edges += usize::from(!sides[0]);
                assert!(!sides[1], "{name}: not outside beyond {on} along {normal}");
            }
            let near = on + unit(rng) * size * log_uniform(rng, 1e-3, 2.0);
            let distance = (self.to_surface)(near);
            if distance <= tiny {
                continue;
            }
            assert_eq!((self.holds)(near), (self.contains)(0.0, near), "{name}: {near}");
            // Nothing changes nearer than the nearest point of the surface, which is no farther than any other one.
            assert!(
                distance <= (near - on).length() + slack,
                "{name}: {near} is not {distance} off the surface"
            );
            for _ in 0..4 {
                let beside = near + unit(rng) * (distance * 0.999 - slack).max(0.0);
                assert_eq!(
                    (self.holds)(near),
                    (self.holds)(beside),
                    "{name}: {near}, {distance} off, but {beside}"
                );
            }
        }
        // Less than a step from an edge there may be nothing behind a face.
        near_edges
    }
}

fn size(rng: &mut impl Rng) -> f64 {
    log_uniform(rng, 1e-1, 1e2)
}

#[test]
fn references_of_leaves_describe_one_solid() {
    for (kind, name) in KINDS.iter().enumerate() {
        let mut near_edges = 0;
        for seed in 0..SOLIDS {
            let mut rng = Pcg64::seed_from_u64(seed);
            let size = size(&mut rng);
            let shape = Shape::random(&mut rng, kind, size, 4.0);
            let described = format!("{name}, {shape:?}");
            let reference = Reference {
                name: &described,
                size,
                extent: shape.extent(),
                is_facet: shape.is_facet(),
                holds: &|p| shape.holds(p),
                contains: &|offset, p| shape.exact(offset).contains(p.to_array()),
                to_surface: &|p| shape.to_surface(p),
                surface: &|rng| shape.surface(rng),
                edge_point: &|rng| shape.edge_point(rng),
            };
            near_edges += reference.check(&mut rng);
        }
        assert!(
            near_edges * 20 < SOLIDS as usize * POINTS,
            "{name}: {near_edges} faces are turned inside out"
        );
    }
}

#[test]
fn references_of_programs_describe_one_solid() {
    for (kind, name) in COMPOSED.iter().enumerate() {
        let mut near_edges = 0;
        for seed in 0..SOLIDS {
            let mut rng = Pcg64::seed_from_u64(seed);
            let size = size(&mut rng);
            let solid = Composed::random(&mut rng, kind, size);
            let described = format!("{name}, {solid:?}");
            let reference = Reference {
                name: &described,
                size,
                extent: solid.extent(),
                is_facet: false,
                holds: &|p| solid.holds(p),
                contains: &|offset, p| solid.exact(offset).contains(p.to_array()),
                to_surface: &|p| solid.to_surface(p),
                surface: &|rng| solid.surface(rng),
                edge_point: &|rng| solid.edge_point(rng),
            };
            near_edges += reference.check(&mut rng);
        }
        assert!(
            near_edges * 20 < SOLIDS as usize * POINTS,
            "{name}: {near_edges} faces are turned inside out"
        );
    }
}
