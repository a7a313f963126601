//! Bugs that the laws and the fuzz targets have found, each under a name.

use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCone, Solid};

/// Once the sign of the standard distance to a capped cone was that of the horizontal part of the way to its side: of a
/// cone flatter than about 1 : 1000 a number lost in the rounding of its radius, so that points deep inside were outside.
#[test]
fn a_flat_capped_cone_has_an_inside() {
    let axis = vec3(-0.747_197_7, 0.519_535_9, -0.414_461_23);
    let (bottom, top) = (vec3(-4.25, 5.0, 1.490_116_1e-8), vec3(-14.793_136, 12.330_774, -5.848_146));
    let found = CappedCone::new(bottom, top, axis, 1.0, 135_026.23).unwrap();
    let distance = found.sdf(vec3(-17.362_204, 7.3125, 5.0));
    assert!((distance + 5.1837).abs() < 0.1, "{distance}");

    for radius in [1e3_f32, 1e4, 1e5, 1e6, 1e7] {
        let disc = CappedCone::new(Vec3::ZERO, Vec3::Y * 16.0, Vec3::Y, 1.0, radius).unwrap();
        for (step, height) in (1..1000).flat_map(|step| [2.0, 8.0, 13.0].map(|height| (step, height))) {
            // At an eighth of the height the side is an eighth of the radius wide, and these are a hundredth of it away.
            let place = vec3(radius * 1e-5 * step as f32, height, 0.0);
            assert!(disc.sdf(place) < 0.0, "{} at {place} of {radius}", disc.sdf(place));
        }
    }
}
