//! What the corpus is made of: rays of every class that hit, miss and are refused, at every leaf and every face.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use gsdf_nostd::{Hit, Ray, RayError, Span};
use gsdf_workload::corpus::{BLOCK, Class, PROGRAMS, Query, RAYS, SPANS, program, queries};
use gsdf_workload::solids;
use std::collections::BTreeSet;
use std::mem::discriminant;

/// What became of a query.
enum Outcome {
    Hit(Ray, Hit),
    Miss,
    Refused(RayError),
}

fn outcomes() -> impl Iterator<Item = (Query, Outcome)> {
    let mut scratch = [Span::EMPTY; SPANS];
    queries().map(move |query| {
        let outcome = match query.ray() {
            Ok(ray) => match program(query.program).along(ray, &mut scratch).unwrap().cast() {
                Some(hit) => Outcome::Hit(ray, hit),
                None => Outcome::Miss,
            },
            Err(error) => Outcome::Refused(error),
        };
        (query, outcome)
    })
}

/// The share in a hundred of hits, misses and refusals among the queries that are asked for.
fn shares(wanted: impl Fn(&Query) -> bool) -> [u32; 3] {
    let mut counts = [0; 3];
    for (query, outcome) in outcomes() {
        if wanted(&query) {
            counts[match outcome {
                Outcome::Hit(..) => 0,
                Outcome::Miss => 1,
                Outcome::Refused(_) => 2,
            }] += 1;
        }
    }
    counts.map(|count| 100 * count / counts.iter().sum::<u32>())
}

#[test]
fn there_are_a_hundred_thousand_in_blocks_of_a_packet() {
    assert_eq!(queries().count(), RAYS);
    for (number, query) in queries().enumerate() {
        assert_eq!(query.program, number / BLOCK % PROGRAMS);
    }
    assert_eq!(Class::SHARES.map(|(_, share)| share).iter().sum::<u32>(), 256);
}

#[test]
fn enough_of_them_hit_miss_and_are_refused() {
    let [hits, misses, refused] = shares(|_| true);
    assert!(hits >= 45 && misses >= 30 && refused >= 8, "{hits} {misses} {refused}");
    for (class, least) in [
        // Facets are thin, and aimed at in vain.
        (Class::Aimed, [75, 10, 0]),
        // Frames are open, and facets have no inside.
        (Class::Inside, [75, 10, 0]),
        (Class::Axis, [30, 50, 0]),
        (Class::Grid, [30, 50, 0]),
        (Class::Grazing, [30, 50, 0]),
        (Class::Ranged, [12, 50, 25]),
        (Class::Special, [15, 30, 40]),
        (Class::Raw, [1, 2, 90]),
    ] {
        let found = shares(|query| query.class == class);
        assert!(
            found.iter().zip(least).all(|(found, least)| *found >= least),
            "{class:?}: {found:?}"
        );
    }
    for number in 0..PROGRAMS {
        let [hits, ..] = shares(|query| query.program == number);
        // The least by far is the triangle.
        assert!(hits >= 18, "program {number}: {hits} % hit");
    }
}

/// Each face of each solid is entered and left; each leaf of the composed programs is hit.
#[test]
fn every_face_is_hit() {
    let mut seen = BTreeSet::new();
    for (query, outcome) in outcomes() {
        if let Outcome::Hit(_, hit) = outcome {
            seen.insert((query.program, hit.leaf, hit.face, hit.entering));
        }
    }
    for (number, name) in solids::NAMES.iter().enumerate() {
        let faces = seen.range((number, 0, 0, false)..(number + 1, 0, 0, false));
        let highest = faces.clone().map(|(_, _, face, _)| *face).max().unwrap();
        assert_eq!(faces.count(), 2 * (usize::from(highest) + 1), "{name}");
    }
    let faces_of = |name| {
        let number = solids::NAMES.iter().position(|known| *known == name).unwrap();
        seen.iter().filter(|(program, ..)| *program == number).count() / 2
    };
    let known = [
        ("sphere", 1),
        ("cuboid", 6),
        ("capped cylinder", 3),
        ("capped cone", 3),
        ("cone", 2),
        ("capsule", 3),
    ];
    for (name, faces) in known {
        assert_eq!(faces_of(name), faces, "{name}");
    }
    for number in solids::NAMES.len()..PROGRAMS {
        let leaves = seen.iter().filter(|hit| hit.0 == number).map(|hit| hit.1).collect::<BTreeSet<_>>();
        assert_eq!(leaves.len(), program(number).leaves(), "program {number}");
    }
}

/// All reasons to refuse a ray, subnormal and signed zero components, starts of the range that cut a hit off.
#[test]
fn the_odd_ones_are_among_them() {
    let (mut refusals, mut subnormal, mut fastest, mut farthest, mut negative_zero, mut cut_off) = (Vec::new(), 0, 0, 0, 0, 0);
    let mut scratch = [Span::EMPTY; SPANS];
    for (query, outcome) in outcomes() {
        let numbers = query.origin.to_array().into_iter().chain(query.direction.to_array());
        match outcome {
            Outcome::Refused(error) => {
                if !refusals.contains(&discriminant(&error)) {
                    refusals.push(discriminant(&error));
                }
            }
            Outcome::Hit(ray, _) => {
                subnormal += u32::from(numbers.clone().any(f32::is_subnormal));
                negative_zero += u32::from(numbers.clone().any(|number| number == 0.0 && number.is_sign_negative()));
                fastest += u32::from(ray.direction().abs().max_element() >= gsdf_nostd::MAX_SPEED);
                farthest += u32::from(ray.origin().abs().max_element() >= gsdf_nostd::MAX_LENGTH);
            }
            Outcome::Miss if query.class == Class::Ranged => {
                let unlimited = Ray::new(query.origin, query.direction).unwrap();
                let seen = program(query.program).along(unlimited, &mut scratch).unwrap().cast();
                cut_off += u32::from(seen.is_some());
            }
            Outcome::Miss => {}
        }
    }
    assert_eq!(refusals.len(), 7, "kinds of refusals");
    let found = [subnormal, negative_zero, fastest, farthest, cut_off];
    assert!(found.iter().all(|count| *count >= 10), "{found:?}");
}
