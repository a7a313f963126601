//! Transforms from raw matrices: refused, or a map whose inverse and stretch are what they should be, and under which
//! solids are as sane as at rest.

use super::Tally;
use super::raw::Raw;
use super::solids::shape;
use crate::poses::Posed;
use crate::sandwich::ROUNDOFF;
use glam::{DMat3, DVec3, Mat3, Vec3};
use gsdf_nostd::{Node, Program, Ray, Span, Transform, V3};

/// How many rounding errors of the numbers that meet a distance may be off: those of the surface, of the distance and
/// of the map.
const ALLOWED: f64 = 32.0;

/// How many of them a crossing may be off its surface, in a pose.
const PROMISED: f64 = 16.0;

/// The inverse undoes the matrix, no vector is stretched by less than the stretch, and a posed solid's standard distance
/// is no more than the way to its surface in any direction.
#[must_use]
pub fn transforms(bytes: &[u8]) -> Tally {
    let (mut raw, mut tally) = (Raw::new(bytes), Tally::default());
    let (matrix, translation) = raw.affine();
    let numbers = matrix.to_cols_array().into_iter().chain(translation.to_array());
    let finite = numbers.clone().all(f32::is_finite);
    let made = Transform::affine(matrix, translation);
    assert!(finite || made.is_err(), "{made:?} of {matrix} and {translation}");
    let moved = Transform::translation(translation);
    assert_eq!(moved.is_ok(), translation.abs().cmple(Vec3::splat(gsdf_nostd::MAX_LENGTH)).all());
    tally.accept_named(moved);
    let Some(pose) = tally.accept_named(made) else {
        // What one would use must not be refused.
        let usable = is_usable(matrix.as_dmat3()) && translation.abs().cmple(Vec3::splat(gsdf_nostd::MAX_LENGTH)).all();
        assert!(!usable, "refused: {matrix} and {translation}");
        return tally;
    };
    check_map(matrix, translation, &pose, &mut raw);
    let shape = shape(&mut raw);
    let Some(solid) = tally.accept_named(shape.leaf()) else {
        return tally;
    };
    let nodes = [Node::Leaf { solid, frame: 1 }];
    let poses = [pose];
    let program = Program::new(&nodes)
        .and_then(|program| program.posed(&poses))
        .unwrap_or_else(|error| panic!("{error}"));
    for number in 0..6 {
        if raw.is_empty() && number > 0 {
            break;
        }
        // Half of all places are given in the frame, where the solid is.
        let place = if raw.below(2) == 0 {
            raw.vector()
        } else {
            matrix * raw.vector() + translation
        };
        let Some(ray) = tally.accept(Ray::new(place, raw.vector())) else {
            continue;
        };
        let signed = f64::from(program.sdf(place));
        let mut scratch = [Span::EMPTY; 1];
        let sight = program.along(ray, &mut scratch).unwrap_or_else(|error| panic!("{error}"));
        let along = f64::from(sight.gsdf::<f32>());
        let travelled = along.abs() * ray.direction().as_dvec3().length();
        let scale = place.as_dvec3().length() + translation.as_dvec3().length() + shape.extent() * f64::from(pose.stretch());
        let what = || format!("{signed} at {place}, {along} along {ray:?} of {shape:?} in {pose:?}");
        assert!(!signed.is_nan() && !along.is_nan(), "{}", what());
        // Of a solid thinner than rounding the faces' own rounding errors move the edges far: there exact arithmetic is asked
        // whether what was found is within rounding of its surface.
        let is_near = |t: f64| Posed::new(shape.into(), pose).is_near_leaf(&ray, 0, t, PROMISED);
        let is_no_farther = signed.abs() <= travelled + ALLOWED * ROUNDOFF * (scale + travelled.min(1e30));
        assert!(is_no_farther || is_near(along.abs()), "{}", what());
        let is_same_side = signed.abs() <= ALLOWED * ROUNDOFF * scale || (signed < 0.0) == (along < 0.0);
        assert!(is_same_side || is_near(0.0), "{}", what());
        let hit = sight.cast();
        if let Some(hit) = hit {
            assert!(hit.t > 0.0 && (hit.normal.length() - 1.0).abs() < 1e-5, "{hit:?}: {}", what());
        }
        tally.answered += 1;
        tally.met += u64::from(hit.is_some());
        tally.inside += u64::from(along < 0.0);
    }
    tally
}

/// Whether a matrix is well within the range of transforms: by its entries and its determinant, and not as the library
/// finds out.
fn is_usable(matrix: DMat3) -> bool {
    let norm = matrix.to_cols_array().iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    let inverse = matrix.inverse().to_cols_array();
    let inverse_norm = inverse.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    norm < 1e6 && inverse_norm < 1e6 && norm * inverse_norm < 1e6
}

fn check_map(matrix: Mat3, translation: Vec3, pose: &Transform, raw: &mut Raw<'_>) {
    let matrix = matrix.as_dmat3();
    let rows = pose.to_local().map(Vec3::as_dvec3);
    let norm = matrix.to_cols_array().iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    let inverse_norm = rows.iter().map(|row| row.length_squared()).sum::<f64>().sqrt();
    let stretch = f64::from(pose.stretch());
    assert!(stretch > 0.0 && stretch.is_finite() && inverse_norm.is_finite(), "{pose:?}");
    assert_eq!(pose.origin(), translation);
    for _ in 0..4 {
        let local = raw.unit().as_dvec3();
        if !local.is_finite() || local.length() < 1e-30 || local.length() > 1e30 {
            continue;
        }
        let world = matrix * local;
        // The stored inverse is rounded, and it is the map from then on.
        let back = DVec3::from_array(rows.map(|row| row.dot(world)));
        let error = (back - local).length();
        assert!(
            error <= 2.0 * ROUNDOFF * norm * inverse_norm * local.length(),
            "{local} comes back as {back}: {pose:?}"
        );
        let stretched = world.length() / back.length();
        assert!(
            stretch <= stretched * (1.0 + 4.0 * ROUNDOFF),
            "{local} is stretched by {stretched} only: {pose:?}"
        );
        let double: V3<f64> = pose.vector_to_local(V3::new(world.x, world.y, world.z));
        assert!(
            (DVec3::new(double.x, double.y, double.z) - back).length() <= 1e-14 * back.length().max(norm * inverse_norm * local.length())
        );
    }
    // A rigid or uniform map's stretch is its factor, and no other's is much less than it could be.
    let least = 1.0 / inverse_norm;
    assert!(stretch >= 0.99 * least, "{stretch}, but at least {least}: {pose:?}");
}
