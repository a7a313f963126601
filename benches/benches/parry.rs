//! Ray casts on the solids that parry3d has too, beside parry3d's own.
//!
//! Both sides return distance and normal, of 8,192 rays made beforehand, half of which hit. Its balls, boxes and half-spaces are closed forms; its cylinders, cones and capsules are
//! found by iteration (GJK) to an epsilon.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{Vec3, vec3};
use gsdf_benches::inputs::{COUNT, Inputs, SEED};
use gsdf_nostd::{CappedCylinder, Capsule, Cone, Csg, Cuboid, Draft, HalfSpace, Invalid, Leaf, Ray, Solid, Sphere};
use parry3d::math::Vector;
use parry3d::query::{Ray as ParryRay, RayCast};
use parry3d::shape;
use std::fmt::Debug;
use std::hint::black_box;
use std::time::Duration;

/// A program of one leaf.
fn alone<S: Into<Leaf>>(solid: S) -> Csg<1> {
    Draft::new().leaf(solid.into()).finish().expect("a program of one leaf")
}

fn compare<S: Solid + Into<Leaf>>(criterion: &mut Criterion, name: &'static str, ours: Result<S, Invalid>, theirs: &impl RayCast) {
    let ours = ours.expect("a solid of this source");
    let inputs = Inputs::new(&ours, name, COUNT, SEED);
    let rays: Vec<Ray> = (inputs.rays.iter())
        .map(|(origin, direction)| Ray::new((*origin).into(), (*direction).into()).expect("a ray"))
        .collect();
    let vector = |v: Vec3| Vector::new(v.x, v.y, v.z);
    let their_rays: Vec<ParryRay> = (rays.iter())
        .map(|ray| ParryRay::new(vector(ray.origin()), vector(ray.direction())))
        .collect();
    let program = alone(ours);
    let their_cast = |ray: &ParryRay| theirs.cast_local_ray_and_get_normal(ray, f32::MAX, true);

    let pairs = || {
        rays.iter()
            .zip(&their_rays)
            .map(|(ray, their_ray)| (program.cast(ray), their_cast(their_ray)))
    };
    let differing = pairs().filter(|(ours, theirs)| ours.is_some() != theirs.is_some()).count();
    let farthest = pairs()
        .filter_map(|(ours, theirs)| {
            let (ours, theirs) = (ours?.t, theirs?.time_of_impact);
            Some((ours - theirs).abs() / ours)
        })
        .fold(0.0, f32::max);
    println!(
        "{name}: {:.1} % of the rays hit; {differing} of {COUNT} hit on one side alone, else distances differ by {farthest:.1e} at most",
        100.0 * inputs.hit_rate
    );

    let mut group = criterion.benchmark_group(name);
    group
        .throughput(Throughput::Elements(COUNT as u64))
        .sample_size(10)
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(500));
    group.bench_function(BenchmarkId::from_parameter("gsdf"), |bencher| {
        bencher.iter(|| each(&rays, |ray| black_box(&program).cast(ray)));
    });
    group.bench_function(BenchmarkId::from_parameter("parry3d"), |bencher| {
        bencher.iter(|| each(&their_rays, their_cast));
    });
    group.finish();
}

/// Does something with each ray; nobody may leave any of it out.
fn each<R, T: Debug>(rays: &[R], cast: impl Fn(&R) -> T) {
    for ray in rays {
        black_box(cast(ray));
    }
}

fn solids(criterion: &mut Criterion) {
    let (low, high) = (vec3(0.0, -0.75, 0.0), vec3(0.0, 0.75, 0.0));
    let half = vec3(0.75, 0.5, 1.0);
    compare(
        criterion,
        "half-space",
        HalfSpace::new(Vec3::ZERO, Vec3::Y),
        &shape::HalfSpace::new(Vector::new(0.0, 1.0, 0.0)),
    );
    compare(criterion, "sphere", Sphere::new(Vec3::ZERO, 1.0), &shape::Ball::new(1.0));
    compare(
        criterion,
        "cuboid",
        Cuboid::new(-half, half),
        &shape::Cuboid::new(Vector::new(half.x, half.y, half.z)),
    );
    compare(
        criterion,
        "capped cylinder",
        CappedCylinder::new(low, high, Vec3::Y, 0.75),
        &shape::Cylinder::new(0.75, 0.75),
    );
    compare(
        criterion,
        "cone",
        Cone::new(high, low, Vec3::NEG_Y, 0.75),
        &shape::Cone::new(0.75, 0.75),
    );
    compare(
        criterion,
        "capsule",
        Capsule::new(low, high, 0.5),
        &shape::Capsule::new_y(0.75, 0.5),
    );
}

criterion_group!(parry, solids);
criterion_main!(parry);
