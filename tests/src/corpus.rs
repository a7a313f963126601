//! Rays at a solid, of all the kinds that once broke something, in fixed shares.

use crate::sandwich::Trial;
use crate::shape::{Shape, across, log_uniform, unit};
use glam::{DVec3, Vec3};
use rand::{Rng, RngExt};

/// What a ray was made to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Class {
    /// From afar at a point inside.
    Aimed,
    /// From afar at an edge, a corner, a tip or a seam; every second start is moved by up to 32 units in the last place.
    Edge,
    /// From a point inside.
    Inside,
    /// Along the surface at a point of it, each coordinate of the start moved by up to 32 units in the last place.
    Tangent,
    /// Along an axis, a generatrix or a face, exactly or nearly.
    Parallel,
    /// From a point of the surface, as near as `f32` has one.
    OnSurface,
    /// Anywhere, anyhow.
    Random,
}

/// The classes with the share of each in a hundred.
pub const SHARES: [(Class, u32); 7] = [
    (Class::Aimed, 30),
    (Class::Edge, 10),
    (Class::Inside, 15),
    (Class::Tangent, 15),
    (Class::Parallel, 10),
    (Class::OnSurface, 10),
    (Class::Random, 10),
];

/// The next `f32`s up or down, `steps` times.
fn nudged(value: f32, steps: i32) -> f32 {
    let mut value = value;
    for _ in 0..steps.abs() {
        value = if steps < 0 { value.next_down() } else { value.next_up() };
    }
    value
}

/// The vector with each coordinate moved by up to `most` units in the last place.
pub fn jittered(rng: &mut impl Rng, vector: Vec3, most: i32) -> Vec3 {
    Vec3::from_array(vector.to_array().map(|value| nudged(value, rng.random_range(-most..=most))))
}

/// A ray of a random class at the shape. `size` is that of the shape, `reach` how many sizes away rays start at the
/// most.
pub fn ray(rng: &mut impl Rng, shape: &Shape, size: f64, reach: f64) -> (Class, Trial) {
    let mut pick = rng.random_range(0..100);
    let class = SHARES
        .iter()
        .find_map(|&(class, share)| {
            let found = pick < share;
            pick = pick.saturating_sub(share);
            found.then_some(class)
        })
        .unwrap_or(Class::Random);
    let distance = size * log_uniform(rng, 0.5, reach);
    // Directions are about as long as one likes them in practice, and not of unit length.
    let length = log_uniform(rng, 0.5, 2.0);
    let towards = |from: DVec3, to: DVec3| (to - from).normalize() * length;
    let (origin, direction) = match class {
        Class::Aimed => {
            let target = shape.interior(rng);
            let from = target + unit(rng) * distance;
            (from.as_vec3(), towards(from.as_vec3().as_dvec3(), target).as_vec3())
        }
        Class::Edge => {
            let target = shape.edge_point(rng);
            let from = (target + unit(rng) * distance).as_vec3();
            let steps = if rng.random_range(0..2) == 0 { 0 } else { 32 };
            let direction = towards(from.as_dvec3(), target).as_vec3();
            (jittered(rng, from, steps), direction)
        }
        Class::Inside => (shape.interior(rng).as_vec3(), (unit(rng) * length).as_vec3()),
        Class::Tangent => {
            let (point, normal) = shape.surface(rng);
            let along = across(rng, normal) * length;
            let origin = (point - along.normalize() * distance).as_vec3();
            (jittered(rng, origin, 32), along.as_vec3())
        }
        Class::Parallel => {
            let (point, normal) = shape.surface(rng);
            let axis = shape.axis();
            // Along the axis, or along the line in which the surface and a plane through the axis meet.
            let along = if rng.random_range(0..2) == 0 {
                axis
            } else {
                let generatrix = axis.as_dvec3() - normal * normal.dot(axis.as_dvec3());
                if generatrix.length() > 1e-3 {
                    generatrix.normalize().as_vec3()
                } else {
                    axis
                }
            };
            let off = size * log_uniform(rng, 1e-7, 1.0) * f64::from(rng.random_range(-1..=1));
            let origin = (point + normal * off - along.as_dvec3() * distance).as_vec3();
            let steps = if rng.random_range(0..2) == 0 { 0 } else { 32 };
            (origin, jittered(rng, along, steps))
        }
        Class::OnSurface => {
            let (point, _) = shape.surface(rng);
            (point.as_vec3(), (unit(rng) * length).as_vec3())
        }
        Class::Random => ((unit(rng) * distance).as_vec3(), (unit(rng) * length).as_vec3()),
    };
    let trial = Trial {
        shape: *shape,
        origin,
        direction,
    };
    (class, trial)
}
