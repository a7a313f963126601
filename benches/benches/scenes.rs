//! What a picture of a scene costs each contender, brute force, on one thread. Divide by the pixels for the cost of one: criterion does, as "elements per second".

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use gsdf_benches::arena::Arena;
use gsdf_benches::contender::Contender;
use gsdf_benches::frame::Frame;
use gsdf_demo::scenes;
use std::hint::black_box;
use std::time::Duration;

/// The relaxation of the marcher that is faster on most of these scenes; the race tries both on each.
const RELAXATION: f32 = 1.2;

fn pictures(criterion: &mut Criterion) {
    let pool = (rayon::ThreadPoolBuilder::new().num_threads(1).build()).expect("a thread");
    for scene in [scenes::s1(), scenes::s2(), scenes::s3(), scenes::s4(), scenes::s5()] {
        let leaves = scene.program().expect("a program").leaves();
        // Brute force over thousands of leaves takes its time.
        let size = match leaves {
            0..=8 => 256,
            9..=256 => 128,
            _ => 16,
        };
        let arena = Arena::new(&scene, size).expect("a program").relaxed(RELAXATION);
        let mut frame = Frame::new(arena.pixels());
        let mut group = criterion.benchmark_group(format!("{}, {size} x {size}", scene.name));
        group
            .throughput(Throughput::Elements(arena.pixels() as u64))
            .sample_size(10)
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1));
        for contender in Contender::ALL {
            group.bench_function(BenchmarkId::from_parameter(contender.name()), |bencher| {
                pool.install(|| {
                    bencher.iter(|| {
                        contender.render(&arena, &mut frame);
                        black_box(&mut frame);
                    });
                });
            });
        }
        group.finish();
    }
}

criterion_group!(scenes_of_reference, pictures);
criterion_main!(scenes_of_reference);
