//! Textbook formulas: the same bits in every lane, and an accuracy that ends where it is said to.

use glam::Vec3;
use gsdf_nostd::{Plain, Ray, Solid, Span, Sphere};
use gsdf_simd::F32x8;
use gsdf_tests::accuracy::{Cell, Corpus};
use gsdf_tests::shape::KINDS;

/// A span as a packet computes it, lane by lane, is that of plain numbers, bit for bit, of every leaf.
#[test]
fn packets_of_plain_numbers_have_their_bits() {
    for cell in (0..KINDS.len()).map(|leaf| Cell {
        leaf,
        corpus: Corpus::Moderate,
    }) {
        for ray in 0..500 {
            let trial = cell.trial(ray * 7);
            let (leaf, ray) = (trial.solid.leaf().unwrap(), Ray::new(trial.origin, trial.direction).unwrap());
            let line = ray.line(Plain(0.0_f32));
            let alone = leaf.span_along(&line);
            let like = Plain(F32x8::new([0.0; 8]));
            let packet = leaf.span_along(&gsdf_nostd::Line {
                origin: gsdf_nostd::V3::lift(like, line.origin),
                toward: gsdf_nostd::Toward::new(gsdf_nostd::V3::lift(like, line.toward.v)),
            });
            for (lanes, number) in [(packet.enter, alone.enter), (packet.exit, alone.exit)] {
                assert!(
                    lanes.0.to_array().iter().all(|lane| lane.to_bits() == number.0.to_bits()),
                    "{trial:?}"
                );
            }
        }
    }
}

/// The share of rays at the rim of a ball that miss it, or hit beside it, at a distance.
fn wrong<T: gsdf_nostd::Lane>(distance: f32, like: T) -> f64 {
    let ball = Sphere::new(Vec3::X * distance, 1.0).unwrap();
    let wrong = (0..1000_u16).filter(|&step| {
        let height = 0.99 + 0.02 * f32::from(step) / 1000.0;
        let ray = Ray::new(Vec3::Y * height, Vec3::X).unwrap();
        let span: Span<T> = ball.span_along(&ray.line(like));
        span.enter.lt(span.exit) != (height < 1.0)
    });
    wrong.count() as f64 / 1000.0
}

#[test]
fn plain_formulas_lose_the_rim_where_it_is_said_and_robust_ones_do_not() {
    assert!(wrong(100.0, Plain(0.0_f32)) < 0.05);
    assert!(wrong(1e4, Plain(0.0_f32)) > 0.2);
    assert!(wrong(1e4, 0.0_f32) < 0.01);
    assert!(wrong(1e4, Plain(0.0_f64)) < 0.01);
}
