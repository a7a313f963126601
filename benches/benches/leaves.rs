//! What one evaluation of a leaf costs: `sdf` and `gsdf`, one at a time and eight at once, over 8,192 inputs made beforehand.
//!
//! A loop over independent evaluations is one that LLVM may vectorise by itself; the row then measures packets by another name. So every scalar loop is labelled by whether the
//! compiler did that, and beside it stands a row in which it could not, with a call per evaluation.

use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main, measurement::WallTime};
use gsdf_benches::inputs::{COUNT, HIT_RATE, Inputs, SEED};
use gsdf_benches::leaves::{Visitor, gsdf_loop, gsdf_one_by_one, sdf_loop, sdf_one_by_one, visit_leaves};
use gsdf_benches::machine;
use gsdf_nostd::{Solid, V3};
use gsdf_simd::F32x8;
use std::hint::black_box;
use std::time::Duration;

struct Leaves<'c>(&'c mut Criterion);

impl Visitor for Leaves<'_> {
    fn leaf<S: Solid>(&mut self, name: &'static str, solid: S) {
        let inputs = Inputs::new(&solid, name, COUNT, SEED);
        println!(
            "{name}: {:.1} % of the rays hit, {:.1} % of the points lie inside",
            100.0 * inputs.hit_rate,
            100.0 * inputs.inside_rate
        );
        self.points(name, &solid, &inputs);
        self.rays(name, &solid, &inputs);
    }
}

impl Leaves<'_> {
    fn group(&mut self, name: &str, query: &str) -> BenchmarkGroup<'_, WallTime> {
        let mut group = self.0.benchmark_group(format!("{name}, {query}"));
        group
            .throughput(Throughput::Elements(COUNT as u64))
            .sample_size(10)
            .warm_up_time(Duration::from_millis(100))
            .measurement_time(Duration::from_millis(300));
        group
    }

    fn points<S: Solid>(&mut self, name: &str, solid: &S, inputs: &Inputs) {
        let packets = inputs.packets_of_points();
        let (mut scalar, mut packed) = (vec![0.0; COUNT], vec![F32x8::splat(0.0); COUNT / 8]);
        let mut group = self.group(name, "sdf");
        group.bench_function(BenchmarkId::from_parameter("packets"), |bencher| {
            bencher.iter(|| sdf_loop(black_box(solid), &packets, black_box(&mut packed)));
        });
        group.bench_function(BenchmarkId::from_parameter(label(name, "sdf")), |bencher| {
            bencher.iter(|| sdf_loop(black_box(solid), &inputs.points, black_box(&mut scalar)));
        });
        group.bench_function(BenchmarkId::from_parameter("scalar, one by one"), |bencher| {
            bencher.iter(|| sdf_one_by_one(black_box(solid), &inputs.points, black_box(&mut scalar)));
        });
        group.finish();
    }

    fn rays<S: Solid>(&mut self, name: &str, solid: &S, inputs: &Inputs) {
        let packets = inputs.packets_of_rays();
        let (mut scalar, mut packed) = (vec![0.0; COUNT], vec![F32x8::splat(0.0); COUNT / 8]);
        let mut group = self.group(name, "gsdf");
        group.bench_function(BenchmarkId::from_parameter("packets"), |bencher| {
            bencher.iter(|| gsdf_loop(black_box(solid), &packets, black_box(&mut packed)));
        });
        group.bench_function(BenchmarkId::from_parameter(label(name, "gsdf")), |bencher| {
            bencher.iter(|| gsdf_loop(black_box(solid), &inputs.rays, black_box(&mut scalar)));
        });
        group.bench_function(BenchmarkId::from_parameter("scalar, one by one"), |bencher| {
            bencher.iter(|| gsdf_one_by_one(black_box(solid), &inputs.rays, black_box(&mut scalar)));
        });
        // As users call it: the numbers checked, the direction scaled.
        let checked: Vec<_> = inputs
            .rays
            .iter()
            .map(|(p, v): &(V3<f32>, V3<f32>)| ((*p).into(), (*v).into()))
            .collect();
        group.bench_function(BenchmarkId::from_parameter("scalar, checked"), |bencher| {
            bencher.iter(|| {
                let solid = black_box(solid);
                for (distance, (origin, direction)) in scalar.iter_mut().zip(&checked) {
                    *distance = solid.gsdf(*origin, *direction);
                }
                black_box(&mut scalar);
            });
        });
        group.finish();
    }
}

/// The scalar loops that LLVM makes vectors of several inputs in, in a build of [`CHECKED`], by its machine code: no branch and no call in their text. The square root is what the others
/// stop at, and the early end for rays that miss.
const VECTORISED: [(&str, &str); 3] = [("half-space", "sdf"), ("half-space", "gsdf"), ("cuboid", "gsdf")];

/// The compiler, architecture and features whose machine code was looked at.
const CHECKED: (&str, &str, &str) = ("rustc 1.95.0 ", "x86_64-", "fxsr,sse,sse2");

/// What to call a scalar loop.
fn label(leaf: &str, query: &str) -> &'static str {
    let (compiler, architecture, features) = CHECKED;
    let checked = machine::COMPILER.starts_with(compiler)
        && machine::TARGET.starts_with(architecture)
        && machine::TARGET_FEATURES == features
        && machine::OPT_LEVEL == "3";
    match (checked, VECTORISED.contains(&(leaf, query))) {
        (true, true) => "scalar loop, which LLVM has vectorised",
        (true, false) => "scalar loop, which LLVM has left scalar",
        (false, _) => "scalar loop, vectorised or not: unchecked",
    }
}

fn all_leaves(criterion: &mut Criterion) {
    println!("{COUNT} inputs per leaf, seed {SEED:#x}, made to hit with probability {HIT_RATE}");
    println!("{}, flags {:?}", machine::COMPILER, machine::FLAGS);
    visit_leaves(&mut Leaves(criterion));
}

criterion_group!(leaves, all_leaves);
criterion_main!(leaves);
