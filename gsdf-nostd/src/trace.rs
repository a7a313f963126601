//! Sphere tracing over the standard distance: what the closed form is measured against.

use crate::csg::{Csg, Program};
use crate::leaf::Solid;
use crate::ray::{Line, Ray};
use crate::real::{Lane, Mask, Real};
use crate::vec3::V3;

/// Anything with a standard signed distance in every arithmetic.
pub trait Field {
    /// A signed distance, negative inside, at most the distance to the surface in magnitude.
    fn distance_at<T: Real>(&self, p: V3<T>) -> T;
}

impl<L: Solid> Field for Program<'_, L> {
    #[inline(always)]
    fn distance_at<T: Real>(&self, p: V3<T>) -> T {
        self.distance(p)
    }
}

impl<const N: usize, L: Solid> Field for Csg<N, L> {
    #[inline(always)]
    fn distance_at<T: Real>(&self, p: V3<T>) -> T {
        self.program().distance(p)
    }
}

/// The marcher: repeats `t <- t + |φ(p + t v)| / |v|` until the distance is small.
///
/// With over-relaxation it steps further than the distance allows, and takes the step back when the two spheres it
/// spans do not overlap. Source: J. Hart, Sphere Tracing (1996); B. Keinert, H. Schäfer, J. Korndörfer, U. Ganse, M.
/// Stamminger, Enhanced Sphere Tracing (2014).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereTracer {
    /// A hit is where the distance is at most this times the distance travelled (or times one unit, nearer than
    /// that).
    pub epsilon: f32,
    /// The march ends undecided after so many evaluations.
    pub max_steps: u32,
    /// By what each step is stretched, from 1 (plain) to less than 2.
    pub relaxation: f32,
}

impl Default for SphereTracer {
    /// `epsilon` 1e-4, 128 steps, relaxation 1.2.
    fn default() -> Self {
        Self {
            epsilon: 1e-4,
            max_steps: 128,
            relaxation: 1.2,
        }
    }
}

/// What a march came to.
#[derive(Clone, Copy, Debug)]
pub struct Traced<T: Real> {
    /// The parameter it reached.
    pub t: T,
    /// Where it ended within epsilon of the surface. Elsewhere it left the range, or ran out of steps if `undecided`.
    pub hit: T::Mask,
    /// Where it ran out of steps.
    pub undecided: T::Mask,
    /// How many evaluations of the distance it took, in the slowest lane.
    pub steps: u32,
}

impl SphereTracer {
    /// Marches along a ray through its range. From inside it marches to the exit.
    pub fn cast<F: Field>(&self, field: &F, ray: &Ray) -> Traced<f32> {
        self.cast_in(field, ray, 0.0_f32)
    }

    /// [`cast`](Self::cast) in the arithmetic of `like`.
    pub fn cast_in<F: Field, T: Lane>(&self, field: &F, ray: &Ray, like: T) -> Traced<T> {
        let start = ray.start_on_line(like);
        let end = ray.parameter_on_line(like.splat_like(ray.range().end));
        let traced = self.trace(field, &ray.line(like), start, end);
        Traced {
            t: ray.parameter_of(traced.t),
            ..traced
        }
    }

    /// Marches along a line from `start` to `end`, in any arithmetic; lanes with `start >= end` are not marched.
    #[inline(always)]
    pub fn trace<F: Field, T: Real>(&self, field: &F, line: &Line<T>, start: T, end: T) -> Traced<T> {
        let zero = start.splat_like(0.0);
        let one = start.splat_like(1.0);
        let infinity = start.splat_like(f32::INFINITY);
        let epsilon = start.splat_like(self.epsilon);
        let relaxation = start.splat_like(self.relaxation);
        let speed = line.toward.vv.sqrt();
        let per_speed = one / speed;
        let mut running = start.lt(end);
        let mut hit = zero.lt(zero);
        let mut t = start;
        // The sphere before: its radius, and how far its step went beyond it.
        let mut radius = zero;
        let mut step = zero;
        let mut steps = 0;
        while steps < self.max_steps && running.any() {
            let distance = field.distance_at(line.origin + line.toward.v.scaled(t)).abs();
            steps += 1;
            // Two spheres that do not touch leave a gap in which a surface may hide: back to the end of the first.
            let overstepped = (radius + distance).lt(step);
            // Far beyond everything the way travelled is infinite, and everything near in comparison.
            let travelled = (t * speed).max(one);
            let close = distance.le(epsilon * travelled) & travelled.lt(infinity);
            let arrived = running & close & !overstepped;
            hit = hit | arrived;
            running = running & !arrived;
            let forward = T::select(overstepped, radius - step, distance * relaxation);
            let next = t + forward * per_speed;
            t = T::select(running, next, t);
            step = T::select(overstepped, zero, forward);
            radius = T::select(overstepped, zero, distance);
            running = running & t.lt(end);
        }
        Traced {
            t,
            hit,
            undecided: running,
            steps,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::SphereTracer;
    use crate::{Cuboid, HalfSpace, Ray, Sphere, csg};
    use glam::{Vec3, vec3};

    csg! { const SCENE = difference(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(Vec3::ZERO, 1.2)) }

    #[test]
    fn a_ray_into_the_void_hits_nothing_however_far_it_is_marched() {
        // Of all distances that to a plane grows the farthest: it squares nothing.
        csg! { const GROUND = HalfSpace::new(vec3(0.44, 0.43, 1.8), Vec3::Z) }
        for relaxation in [1.0, 1.2, 1.9] {
            let tracer = SphereTracer {
                relaxation,
                max_steps: 10_000,
                ..SphereTracer::default()
            };
            for direction in [Vec3::NEG_Z, vec3(0.3, -0.7, -1.4), vec3(-0.9, -0.33, -1.47), vec3(1.0, 0.0, -1e-3)] {
                let ray = Ray::new(vec3(0.3, 0.2, -5.0), direction).unwrap();
                for traced in [tracer.cast(&GROUND, &ray), tracer.cast(&SCENE, &ray)] {
                    assert!(!traced.hit, "at {}", traced.t);
                }
            }
        }
    }

    #[test]
    fn agrees_with_the_closed_form_within_epsilon() {
        for relaxation in [1.0, 1.2, 1.6, 1.9] {
            let tracer = SphereTracer {
                relaxation,
                ..SphereTracer::default()
            };
            for step in 0..200_u8 {
                let aim = vec3(f32::from(step % 20) - 9.5, f32::from(step / 20) * 2.0 - 9.5, 0.0) * 0.13;
                let eye = vec3(0.3, 0.2, 5.0);
                let ray = Ray::new(eye, aim - eye).unwrap().within(0.0..20.0).unwrap();
                let exact = SCENE.cast(&ray);
                let traced = tracer.cast(&SCENE, &ray);
                match exact {
                    Some(hit) if traced.hit => {
                        assert!(SCENE.sdf(ray.at(traced.t)).abs() <= 2e-3, "{}", SCENE.sdf(ray.at(traced.t)));
                        assert!(traced.t <= hit.t * 1.000_001, "{} beyond {}", traced.t, hit.t);
                    }
                    Some(_) => assert!(traced.undecided, "a miss where the closed form hits"),
                    // A marcher takes a near miss for a hit; that is what it is measured for.
                    None => assert!(!traced.hit || SCENE.sdf(ray.at(traced.t)) <= 2e-3),
                }
            }
        }
    }
}
