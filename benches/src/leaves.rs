//! The kernels whose cost is measured on a leaf of each kind.

use gsdf_nostd::{Line, Real, Solid, Toward, V3};

pub use gsdf_workload::solids::{Visitor, visit as visit_leaves};

/// The generalized signed distance of a leaf in any arithmetic: all of the work, what depends on the origin or the direction alone included.
///
/// `direction` must be one whose largest component is from 1 to 2 in magnitude, as [`Ray`](gsdf_nostd::Ray) scales it: here this was done beforehand.
#[inline(always)]
pub fn ray_kernel<T: Real, S: Solid>(solid: &S, origin: V3<T>, direction: V3<T>) -> T {
    let toward = Toward::new(direction);
    let zero = toward.vv.splat_like(0.0);
    solid.span_along(&Line { origin, toward }).signed_crossing(zero)
}

/// The generalized signed distances along many rays, in a loop that the compiler sees whole.
#[inline(never)]
pub fn gsdf_loop<T: Real, S: Solid>(solid: &S, rays: &[(V3<T>, V3<T>)], distances: &mut [T]) {
    for (distance, (origin, direction)) in distances.iter_mut().zip(rays) {
        *distance = ray_kernel(solid, *origin, *direction);
    }
}

/// The standard signed distances of many points, in a loop that the compiler sees whole.
#[inline(never)]
pub fn sdf_loop<T: Real, S: Solid>(solid: &S, points: &[V3<T>], distances: &mut [T]) {
    for (distance, point) in distances.iter_mut().zip(points) {
        *distance = solid.distance(*point);
    }
}

/// As [`gsdf_loop`], with a call per ray: no vector of several rays can be made of that.
pub fn gsdf_one_by_one<S: Solid>(solid: &S, rays: &[(V3<f32>, V3<f32>)], distances: &mut [f32]) {
    #[inline(never)]
    fn one<S: Solid>(solid: &S, (origin, direction): &(V3<f32>, V3<f32>)) -> f32 {
        ray_kernel(solid, *origin, *direction)
    }
    for (distance, ray) in distances.iter_mut().zip(rays) {
        *distance = one(solid, ray);
    }
}

/// As [`sdf_loop`], with a call per point: no vector of several points can be made of that.
pub fn sdf_one_by_one<S: Solid>(solid: &S, points: &[V3<f32>], distances: &mut [f32]) {
    #[inline(never)]
    fn one<S: Solid>(solid: &S, point: &V3<f32>) -> f32 {
        solid.distance(*point)
    }
    for (distance, point) in distances.iter_mut().zip(points) {
        *distance = one(solid, point);
    }
}

#[cfg(test)]
mod tests {
    use super::{Visitor, gsdf_loop, gsdf_one_by_one, sdf_loop, sdf_one_by_one, visit_leaves};
    use crate::inputs::Inputs;
    use gsdf_nostd::Solid;
    use gsdf_simd::F32x8;

    struct AllWays;

    impl Visitor for AllWays {
        fn leaf<S: Solid>(&mut self, name: &'static str, solid: S) {
            let inputs = Inputs::new(&solid, name, 256, 3);
            let bits = |distances: &[f32]| distances.iter().map(|d| d.to_bits()).collect::<Vec<_>>();
            let packed = |distances: &[F32x8]| distances.iter().flat_map(|d| d.to_array()).collect::<Vec<_>>();
            let (mut by_loop, mut by_call, mut by_packet) = ([0.0; 256], [0.0; 256], [F32x8::splat(0.0); 32]);

            gsdf_loop(&solid, &inputs.rays, &mut by_loop);
            gsdf_one_by_one(&solid, &inputs.rays, &mut by_call);
            gsdf_loop(&solid, &inputs.packets_of_rays(), &mut by_packet);
            assert_eq!(bits(&by_loop), bits(&by_call), "{name}");
            assert_eq!(bits(&by_loop), bits(&packed(&by_packet)), "{name}");

            sdf_loop(&solid, &inputs.points, &mut by_loop);
            sdf_one_by_one(&solid, &inputs.points, &mut by_call);
            sdf_loop(&solid, &inputs.packets_of_points(), &mut by_packet);
            assert_eq!(bits(&by_loop), bits(&by_call), "{name}");
            assert_eq!(bits(&by_loop), bits(&packed(&by_packet)), "{name}");
        }
    }

    #[test]
    fn loops_calls_and_packets_compute_the_same_bits() {
        visit_leaves(&mut AllWays);
    }
}
