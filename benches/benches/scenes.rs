//! What a picture of a scene costs each contender on one thread. Divide by the pixels for the cost of one: criterion does, as "elements per second".

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use gsdf_benches::arena::Arena;
use gsdf_benches::contender::Contender;
use gsdf_benches::frame::Frame;
use gsdf_benches::scenes::Scene;
use std::hint::black_box;
use std::time::Duration;

/// The relaxation of the marcher that is faster on most of these scenes; the race tries both on each.
const RELAXATION: f32 = 1.2;

fn pictures(criterion: &mut Criterion) {
    let pool = (rayon::ThreadPoolBuilder::new().num_threads(1).build()).expect("a thread");
    for name in ["s1", "s2", "s3", "s4", "s5"] {
        let scene = Scene::by_name(name).expect("a scene");
        // Brute force over thousands of leaves takes its time.
        let small = match scene.program().expect("a program").leaves() {
            0..=8 => 256,
            9..=256 => 128,
            _ => 16,
        };
        let full = Arena::new(&scene, 512).expect("a program").relaxed(RELAXATION);
        for contender in Contender::ALL {
            let size = if contender.is_brute() { small } else { 512 };
            let arena = full.sized(size);
            let mut group = criterion.benchmark_group(format!("{name}, {size} x {size}"));
            group
                .throughput(Throughput::Elements(arena.pixels() as u64))
                .sample_size(10)
                .warm_up_time(Duration::from_millis(300))
                .measurement_time(Duration::from_secs(1));
            let mut frame = Frame::new(&arena.raster);
            let mut paint = contender.ready(&arena);
            group.bench_function(BenchmarkId::from_parameter(contender.name()), |bencher| {
                pool.install(|| {
                    bencher.iter(|| {
                        paint(&mut frame);
                        black_box(&mut frame);
                    });
                });
            });
            group.finish();
        }
    }
}

criterion_group!(scenes_of_reference, pictures);
criterion_main!(scenes_of_reference);
