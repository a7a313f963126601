//! Which points a leaf holds: along rays, at points, and what lies between.

use super::{Exactly, RAYS, SPECIMENS, TOLERANCE, for_rays, v3};
use crate::conformance::specimen::{Specimen, line, wild};
use crate::conformance::values::Plain;
use crate::shape::unit;
use core::fmt::Debug;
use gsdf_nostd::{Solid, Span};
use rand::RngExt;
use rand_pcg::Pcg64;

/// A suite whose rays had stopped meeting the solid would prove nothing.
///
/// # Panics
/// Where the generator's surface points are not on the surface, or too few rays hit or start inside.
pub fn the_generator_aims<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    let (mut hits, mut inside) = (0, 0);
    for_rays(generator, |_, specimen, aim| {
        let found = Exactly::new(specimen, aim);
        hits += usize::from(found.is_inhabited());
        inside += usize::from(found.span.enter < 0.0 && 0.0 < found.span.exit);
        for (point, _) in &specimen.surface {
            let distance = specimen.solid.distance(v3(*point));
            assert!(
                distance.abs() <= 10.0 * TOLERANCE * specimen.extent(),
                "{specimen:?}: {point} is {distance} off"
            );
        }
    });
    let rays = SPECIMENS as usize * RAYS;
    assert!(
        hits * 100 > rays * 40 && inside * 100 > rays * 8,
        "{hits} hits and {inside} starts inside of {rays}"
    );
}

/// A span is empty, then always in the same numbers, or its entry is before its exit; also along rays of the wildest
/// numbers.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn spans_are_half_open_and_never_nan<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    fn check<T: Plain>(span: Span<T>, what: &dyn Debug) {
        let empty = Span::empty_like(span.enter);
        let is_empty = span.enter.bits() == empty.enter.bits() && span.exit.bits() == empty.exit.bits();
        assert!(is_empty || span.enter < span.exit, "{what:?}: {span:?}");
    }
    for_rays(generator, |rng, specimen, aim| {
        for aim in [aim, wild(rng), (aim.0, wild(rng).1), (wild(rng).0, aim.1)] {
            let what = (&specimen.solid, aim);
            check(specimen.solid.span_along(&line(0.0_f32, aim)), &what);
            check(specimen.solid.span_along(&line(0.0_f64, aim)), &what);
        }
    });
}

/// A ray is in the solid everywhere between entry and exit and nowhere else, as the distance sees it; and so is what
/// lies between two points inside.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn the_solid_is_convex<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    for_rays(generator, |rng, specimen, aim| {
        let ray = Exactly::new(specimen, aim);
        let distance = |t: f64| specimen.solid.distance(ray.at(t));
        // An end at infinity is cut off far behind all that is finite.
        let far = 10.0 * (ray.scale + specimen.size) / ray.speed;
        let (enter, exit) = (ray.span.enter.max(-far), ray.span.exit.min(far));
        for _ in 0..8 {
            if enter < exit {
                let t = enter + rng.random_range(0.0..1.0) * (exit - enter);
                assert!(
                    distance(t) <= ray.tolerance(t),
                    "{:?} {aim:?}: {} at {t} within {:?}",
                    specimen.solid,
                    distance(t),
                    ray.span
                );
            }
            let t = rng.random_range(-far..far);
            if !(ray.span.enter..ray.span.exit).contains(&t) {
                assert!(
                    distance(t) >= -ray.tolerance(t),
                    "{:?} {aim:?}: {} at {t} beyond {:?}",
                    specimen.solid,
                    distance(t),
                    ray.span
                );
            }
        }
        let (a, b) = (specimen.point(rng), specimen.point(rng));
        let [at_a, at_b, between] = [a, b, a.lerp(b, rng.random_range(0.0..1.0))].map(|point| specimen.solid.distance(v3(point)));
        let tolerance = TOLERANCE * (specimen.extent() + 10.0 * specimen.size);
        assert!(
            at_a > 0.0 || at_b > 0.0 || between <= tolerance,
            "{:?}: {a} and {b} are inside, what is between them {between} off",
            specimen.solid
        );
    });
}

/// From points inside by the standard distance rays in any direction start inside, and from points outside outside.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn both_distances_agree_on_what_is_inside<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    for_rays(generator, |rng, specimen, _| {
        let point = specimen.point(rng).as_vec3();
        let ray = Exactly::new(specimen, (point, unit(rng).as_vec3()));
        let distance = specimen.solid.distance(ray.at(0.0));
        let inside = ray.span.enter < 0.0 && 0.0 < ray.span.exit;
        assert!(
            distance.abs() <= ray.tolerance(0.0) || inside == (distance < 0.0),
            "{:?}: {point} is {distance} off, and the span from there {:?}",
            specimen.solid,
            ray.span
        );
        // The queries for one point and direction say the same in single precision.
        let direction = unit(rng).as_vec3();
        let (standard, along) = (specimen.solid.sdf(point), specimen.solid.gsdf(point, direction));
        let near = 10.0 * ray.tolerance(0.0);
        assert!(
            f64::from(standard).abs() <= near || (standard < 0.0) == (along < 0.0),
            "{:?}: at {point} sdf {standard}, gsdf {along} along {direction}",
            specimen.solid
        );
    });
}

/// The nearest point of the surface is no farther than the one in any direction.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn distances_never_exceed_the_way_to_the_surface<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    for_rays(generator, |_, specimen, aim| {
        let ray = Exactly::new(specimen, aim);
        let distance = specimen.solid.distance(ray.at(0.0)).abs();
        for (t, _) in ray.ends() {
            let way = t.abs() * ray.speed;
            assert!(
                distance <= way + ray.tolerance(t),
                "{:?} {aim:?}: distance {distance}, way {way}",
                specimen.solid
            );
        }
    });
}

/// A standard distance changes by at most the step.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn distances_change_no_faster_than_the_point<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    for_rays(generator, |rng, specimen, _| {
        let a = specimen.point(rng);
        let b = if rng.random() {
            specimen.point(rng)
        } else {
            a + unit(rng) * specimen.size * 0.01
        };
        let (at_a, at_b) = (specimen.solid.distance(v3(a)), specimen.solid.distance(v3(b)));
        let tolerance = TOLERANCE * (specimen.extent() + 10.0 * specimen.size);
        assert!(
            (at_a - at_b).abs() <= (a - b).length() + tolerance,
            "{:?}: {at_a} at {a}, {at_b} at {b}",
            specimen.solid
        );
    });
}
