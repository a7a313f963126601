//! What boards compute ray by ray has the same hashes in packets, in default and native builds; and those hashes can
//! tell an arithmetic that fuses.

use glam::Vec3;
use gsdf_nostd::{Span, V3};
use gsdf_simd::{F32x8, Packet, Pixel, Records, Renderer, Scene as Prepared, scratch};
use gsdf_tests::conformance::contracted::Contracted;
use gsdf_tests::golden::{hash, staged_picture};
use gsdf_workload::bits::{LARGE, MEDIUM, SMALL};
use gsdf_workload::corpus::{self, BLOCK, Query, RAYS, SPANS, program, queries};
use gsdf_workload::digest::Digest;
use gsdf_workload::scenes::{S1, S2, S3, S4, S5, Scene};

const SCENES: [Scene; 5] = [S1, S2, S3, S4, S5];

fn golden(name: &str) -> u64 {
    let rows = SMALL.iter().chain(&MEDIUM).chain(&LARGE);
    rows.filter(|row| row.name == name).map(|row| row.golden).next().unwrap()
}

fn check(row: &str, found: u64) {
    let golden = golden(row);
    assert_eq!(found, golden, "{row}: {found:#018x}, not {golden:#018x}");
}

#[test]
fn scenes_in_packets() {
    for scene in SCENES {
        let mut pixels = vec![Pixel::NOTHING; (scene.side * scene.side) as usize];
        let prepared = Prepared::new(scene.program);
        Renderer::new(&prepared, scene.raster().unwrap()).render(Records::new(&mut pixels, scene.side, scene.side));
        check(scene.name, hash(&pixels));
    }
}

/// The packet of these queries, by their numbers: it decides for itself which of them are rays.
fn packet(queries: &[Query]) -> Packet {
    let of = |value: &dyn Fn(&Query) -> f32| F32x8::new(core::array::from_fn(|lane| value(&queries[lane])));
    let three = |vector: fn(&Query) -> Vec3| {
        V3::new(
            of(&|query| vector(query).x),
            of(&|query| vector(query).y),
            of(&|query| vector(query).z),
        )
    };
    Packet::from_lanes(
        three(|query| query.origin),
        three(|query| query.direction),
        of(&|query| query.start),
        of(&|query| query.end),
    )
}

#[test]
fn the_corpus_in_packets() {
    const { assert!(BLOCK == 8 && RAYS.is_multiple_of(BLOCK)) };
    let queries: Vec<Query> = queries().collect();
    let mut digest = Digest::new();
    for block in queries.chunks(BLOCK) {
        let packet = packet(block);
        let hits = packet.cast(&program(block[0].program), &mut scratch(SPANS)).unwrap();
        for (lane, query) in block.iter().enumerate() {
            let held = packet.valid().to_bits() >> lane & 1 == 1;
            match query.ray() {
                Ok(ray) if held => digest.cast(hits.lane(lane, &ray).as_ref()),
                Err(_) if !held => digest.refused(),
                _ => panic!("a lane and a ray disagree on whether {query:?} is one"),
            }
        }
    }
    check("corpus", digest.finish());
}

#[test]
fn a_fused_multiply_add_changes_every_scene() {
    for scene in SCENES {
        let raster = scene.raster().unwrap();
        check(scene.name, hash(&staged_picture(&scene.program, &raster, 0.0_f32).unwrap()));
        let fused = staged_picture(&scene.program, &raster, Contracted::from(0.0)).unwrap();
        assert_ne!(hash(&fused), golden(scene.name), "{}: fused, and yet the same", scene.name);
    }
}

#[test]
fn a_fused_multiply_add_changes_the_corpus() {
    let plain = corpus::readings(&mut [Span::EMPTY; SPANS]).unwrap();
    check("corpus-readings", plain);
    let nothing = Span::empty_like(Contracted::from(0.0));
    let fused = corpus::readings(&mut [nothing; SPANS]).unwrap();
    assert_ne!(fused, plain, "fused, and yet the same");
}
