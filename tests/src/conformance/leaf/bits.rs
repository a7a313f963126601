//! The same bits from a leaf in every stage and every lane.

use super::for_rays;
use crate::conformance::lanes::Lanes;
use crate::conformance::specimen::{Specimen, line, wild};
use crate::conformance::values::Plain;
use core::fmt::Debug;
use gsdf_nostd::{Lane, Line, Solid, Span, Surface, Toward, V3};
use gsdf_simd::F32x8;
use rand_pcg::Pcg64;

fn bits_of_span<T: Plain>(span: Span<T>) -> [u64; 2] {
    [span.enter.bits(), span.exit.bits()]
}

fn bits_of_surface<T: Plain>(surface: Surface<T>) -> [u64; 4] {
    let Surface { normal, face } = surface;
    [normal.x.bits(), normal.y.bits(), normal.z.bits(), face.bits()]
}

fn lane_of_span(span: Span<F32x8>, lane: usize) -> Span<f32> {
    Span {
        enter: span.enter.lane(lane),
        exit: span.exit.lane(lane),
    }
}

fn lane_of_surface(surface: Surface<F32x8>, lane: usize) -> Surface<f32> {
    let Surface { normal, face } = surface;
    Surface {
        normal: V3::new(normal.x.lane(lane), normal.y.lane(lane), normal.z.lane(lane)),
        face: face.lane(lane),
    }
}

/// Eight lines as one.
fn packed(lines: &[Line<f32>; 8]) -> Line<F32x8> {
    let of = |value: &dyn Fn(&Line<f32>) -> f32| F32x8::from_lanes(|lane| value(&lines[lane]));
    Line {
        origin: V3::new(of(&|line| line.origin.x), of(&|line| line.origin.y), of(&|line| line.origin.z)),
        toward: Toward::new(V3::new(
            of(&|line| line.toward.v.x),
            of(&|line| line.toward.v.y),
            of(&|line| line.toward.v.z),
        )),
    }
}

/// Seen first and asked then, asked at once, or seen once for all lanes: the same bits, of spans and of surfaces.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn the_stages_are_one_formula<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    fn check<S: Solid + Debug, T: Plain + Lane>(solid: &S, line: &Line<T>) {
        let seen = solid.seen_from(line.origin);
        let lifted = S::lift(&seen, line.origin.x);
        let [whole, staged, lifted] = [
            solid.span_along(line),
            solid.span(&seen, &line.toward),
            solid.span(&lifted, &line.toward),
        ];
        assert_eq!(
            bits_of_span(whole),
            bits_of_span(staged),
            "{solid:?} {line:?}: {whole:?} at once, {staged:?} in stages"
        );
        assert_eq!(
            bits_of_span(whole),
            bits_of_span(lifted),
            "{solid:?} {line:?}: {whole:?}, but {lifted:?} lifted"
        );
    }
    for_rays(generator, |rng, specimen, aim| {
        let solid = &specimen.solid;
        check(solid, &line(0.0_f32, aim));
        check(solid, &line(0.0_f64, aim));
        let lines: [Line<f32>; 8] = core::array::from_fn(|_| line(0.0, (aim.0, specimen.aim(rng).1)));
        let (seen, toward) = (solid.seen_from(lines[0].origin), packed(&lines).toward);
        let lifted = S::lift(&seen, toward.vv);
        let span = solid.span(&lifted, &toward);
        let surfaces = [span.enter, span.exit].map(|t| solid.surface(&lifted, &toward, t));
        for (lane, line) in lines.iter().enumerate() {
            let expected = solid.span_along(line);
            assert_eq!(bits_of_span(lane_of_span(span, lane)), bits_of_span(expected), "{solid:?} {line:?}");
            for (t, surface) in [expected.enter, expected.exit].into_iter().zip(surfaces) {
                if t.is_finite() {
                    let (found, expected) = (lane_of_surface(surface, lane), solid.surface(&seen, &line.toward, t));
                    assert_eq!(
                        bits_of_surface(found),
                        bits_of_surface(expected),
                        "{solid:?} {line:?} at {t}: {found:?}, not {expected:?}"
                    );
                }
            }
        }
    });
}

/// Eight different rays in one packet, or one by one: the same bits, of distances, spans and surfaces; wild rays among
/// them.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn lanes_are_the_scalar_bits<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    for_rays(generator, |rng, specimen, aim| {
        let solid = &specimen.solid;
        let lines: [Line<f32>; 8] = core::array::from_fn(|lane| {
            let aim = match lane {
                0 => aim,
                1 => wild(rng),
                _ => specimen.aim(rng),
            };
            line(0.0, aim)
        });
        let packet = packed(&lines);
        let (span, distance) = (solid.span_along(&packet), solid.distance(packet.origin));
        let seen = solid.seen_from(packet.origin);
        let surfaces = [span.enter, span.exit].map(|t| solid.surface(&seen, &packet.toward, t));
        for (lane, line) in lines.iter().enumerate() {
            let expected = solid.span_along(line);
            assert_eq!(bits_of_span(lane_of_span(span, lane)), bits_of_span(expected), "{solid:?} {line:?}");
            assert_eq!(
                distance.lane(lane).bits(),
                solid.distance(line.origin).bits(),
                "{solid:?}: distance of {:?}",
                line.origin
            );
            for (t, surface) in [expected.enter, expected.exit].into_iter().zip(surfaces) {
                if t.is_finite() {
                    let expected = solid.surface(&solid.seen_from(line.origin), &line.toward, t);
                    let found = lane_of_surface(surface, lane);
                    assert_eq!(
                        bits_of_surface(found),
                        bits_of_surface(expected),
                        "{solid:?} {line:?} at {t}: {found:?}, not {expected:?}"
                    );
                }
            }
        }
    });
}
