//! What a leaf says of its surface: normals, faces, bounds, and rays that leave it.

use super::{Exactly, TOLERANCE, dvec3, for_rays, v3};
use crate::conformance::specimen::{Specimen, line};
use crate::shape::{across, unit};
use core::fmt::Debug;
use glam::{DVec3, Vec3};
use gsdf_nostd::{Ground, Solid};
use rand::RngExt;
use rand_pcg::Pcg64;

/// The rounding error the library's own departures allow for, relative to the coordinates.
const SLACK: f32 = 32.0 / 16_777_216.0;

/// Where a ray crosses the surface the normal is of unit length, against the ray at the entry and along it at the exit,
/// and leads straight away from the solid.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn normals_are_unit_and_outward<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    for_rays(generator, |_, specimen, aim| {
        let ray = Exactly::new(specimen, aim);
        let seen = specimen.solid.seen_from(ray.line.origin);
        for (t, entering) in ray.ends() {
            let normal = dvec3(specimen.solid.surface(&seen, &ray.line.toward, t).normal);
            let what = || format!("{:?} {aim:?}: normal {normal} at {t}", specimen.solid);
            assert!((normal.length() - 1.0).abs() <= 1e-6, "{}", what());
            let along = normal.dot(dvec3(ray.line.toward.v)) / ray.speed;
            assert!(if entering { along <= TOLERANCE } else { along >= -TOLERANCE }, "{}", what());
            let step = 1e-2 * specimen.size;
            let off = specimen.solid.distance(ray.at(t) + v3(normal * step));
            let tolerance = ray.tolerance(t) + 1e-5 * step;
            assert!((off - step).abs() <= tolerance, "{}: {off} off after {step}", what());
        }
        // And of unit length in single precision too.
        let line = line(0.0_f32, aim);
        let (span, seen) = (specimen.solid.span_along(&line), specimen.solid.seen_from(line.origin));
        for t in [span.enter, span.exit] {
            if t.is_finite() {
                let normal = Vec3::from(specimen.solid.surface(&seen, &line.toward, t).normal);
                assert!(
                    (normal.length() - 1.0).abs() <= 2e-6,
                    "{:?} {aim:?}: normal {normal}",
                    specimen.solid
                );
            }
        }
    });
}

/// A place of the surface has its face and its normal from wherever it is looked at, edges excepted.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn faces_belong_to_places_and_not_to_rays<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    let (mut same, mut other) = (0, 0);
    for_rays(generator, |rng, specimen, aim| {
        let ray = Exactly::new(specimen, aim);
        let surface = |ray: &Exactly, t: f64| {
            specimen
                .solid
                .surface(&specimen.solid.seen_from(ray.line.origin), &ray.line.toward, t)
        };
        for (t, _) in ray.ends() {
            let (place, first) = (dvec3(ray.at(t)), surface(&ray, t));
            assert!(
                first.face >= 0.0 && first.face < 255.0 && first.face.fract() == 0.0,
                "face {}",
                first.face
            );
            let normal = dvec3(first.normal);
            let from = place + (normal + across(rng, normal) * rng.random_range(0.0..2.0)) * specimen.size;
            let origin = from.as_vec3();
            let again = Exactly::new(specimen, (origin, (place - origin.as_dvec3()).as_vec3()));
            let back = again.span.enter;
            if back.is_finite() && (dvec3(again.at(back)) - place).length() <= 3.0 * again.tolerance(back) {
                let second = surface(&again, back);
                let agrees = second.face == first.face && dvec3(second.normal).distance(normal) < 1e-2;
                same += usize::from(agrees);
                other += usize::from(!agrees);
            }
        }
    });
    assert!(same > 2000 && other * 100 <= same, "{same} places seen alike, {other} not");
}

/// Every crossing and every point inside is within the bounds; a solid without bounds is the only one that may be
/// endless.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn bounds_hold_the_solid<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    for_rays(generator, |rng, specimen, aim| {
        let Some(bounds) = specimen.solid.bounds() else { return };
        let slack = DVec3::splat(TOLERANCE * specimen.extent());
        let (min, max) = (bounds.min.as_dvec3() - slack, bounds.max.as_dvec3() + slack);
        let holds = |p: DVec3| min.cmple(p).all() && p.cmple(max).all();
        let ray = Exactly::new(specimen, aim);
        if ray.is_inhabited() {
            assert_eq!(
                ray.ends().count(),
                2,
                "{:?} {aim:?}: bounded, and yet {:?}",
                specimen.solid,
                ray.span
            );
        }
        for (t, _) in ray.ends() {
            let place = dvec3(ray.at(t));
            // A crossing seen from afar is no better known than its distance allows.
            let beyond = (min - place).max(place - max).max_element();
            assert!(
                beyond <= ray.tolerance(t),
                "{:?} {aim:?}: {place} is outside of {bounds:?}",
                specimen.solid
            );
        }
        let point = specimen.point(rng);
        assert!(
            specimen.solid.distance(v3(point)) >= 0.0 || holds(point),
            "{:?}: {point} is outside of {bounds:?}",
            specimen.solid
        );
        // Bounds that hold everything hold nothing back.
        let diagonal = (bounds.max - bounds.min).as_dvec3().length();
        assert!(diagonal <= 20.0 * specimen.extent(), "{:?}: {bounds:?}", specimen.solid);
    });
}

/// Rays that leave a place of the surface start at the root 0: out of the solid they end there, into it they begin
/// there.
///
/// # Panics
/// Where the leaf fails this duty.
pub fn grounded_origins_have_the_root_zero<S: Solid + Debug>(generator: impl Fn(&mut Pcg64) -> Specimen<S>) {
    // On the surface, and off it on the caller's word.
    let (mut rooted, mut at_edges) = ([0, 0], [0, 0]);
    for_rays(generator, |rng, specimen, aim| {
        let solid = &specimen.solid;
        let first = line(0.0_f32, aim);
        let span = solid.span_along(&first);
        let Some(t) = [span.enter, span.exit].into_iter().find(|t| t.is_finite() && *t > 0.0) else {
            return;
        };
        let surface = solid.surface(&solid.seen_from(first.origin), &first.toward, t);
        let place = Vec3::from(first.origin + first.toward.v.scaled(t));
        let normal = Vec3::from(surface.normal);
        // As far off the surface as rounding may put it, or farther, on the word of who names the face.
        let slack = SLACK * (aim.0.abs().max_element() + place.abs().max_element());
        let off = place + normal * (1e-3 * specimen.size) as f32;
        for (place, tolerance) in [(place, slack), (place, slack), (off, 0.0), (off, 0.0)] {
            let ground = Ground {
                tolerance,
                face: surface.face,
            };
            let direction = unit(rng).as_vec3();
            let rise = direction.dot(normal);
            if rise.abs() < 0.1 {
                continue;
            }
            let leaving = line(0.0_f32, (place, direction));
            let span = solid.span(&solid.grounded(solid.seen_from(leaving.origin), &ground), &leaving.toward);
            let named = usize::from(tolerance == 0.0);
            let root = if rise > 0.0 { span.exit } else { span.enter };
            if span.enter < span.exit && root == 0.0 {
                rooted[named] += 1;
            } else {
                // At an edge another face may end the span at once; off the surface it may be met before.
                let is_edge = span.enter >= span.exit || named == 1;
                assert!(
                    is_edge,
                    "{solid:?}: from face {} at {place} along {direction}: {span:?}",
                    surface.face
                );
                at_edges[named] += 1;
            }
        }
    });
    for (rooted, at_edges) in rooted.into_iter().zip(at_edges) {
        assert!(rooted > 2000 && at_edges * 5 < rooted, "{rooted} rooted, {at_edges} at edges");
    }
}
