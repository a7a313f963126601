//! Bugs that the laws and the fuzz targets have found, each under a name.

use glam::{Vec3, vec3};
use gsdf_nostd::{
    CappedCone, CappedCylinder, Cuboid, Cylinder, Leaf, Line, Nappe, Node, Program, Ray, Rhombus, Solid, Span, Sphere, Toward, V3,
};
use gsdf_simd::{EMPTY, Packet};

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

/// Once a normal was minus the direction, as long as that is, where nothing was left of the vector that it is made of: at the
/// middle of a rounded edge, or of a ball, that rounding had lost.
#[test]
fn a_normal_of_no_direction_is_of_unit_length() {
    let stone = Rhombus::new(
        vec3(0.999_999_8, 0.007_812_5, 524_288.0),
        524_288.56,
        524_288.5,
        0.001_953_125,
        0.001_953_124_8,
    );
    let nodes = [Node::leaf(stone.unwrap())];
    let ray = Ray::new(vec3(-138_781.25, 504_242.22, 524_288.0), vec3(-1.124_997_7, 0.0, -3.4e-44)).unwrap();
    let mut scratch = [Span::EMPTY; 1];
    let program = Program::new(&nodes).unwrap();
    if let Some(hit) = program.along(ray, &mut scratch).unwrap().cast() {
        assert!((hit.normal.length() - 1.0).abs() < 1e-6, "{hit:?}");
    }

    // From these leaves' middles, axes and tips, and from 1e-22 beside them, whose square loses its digits.
    let leaves: [Leaf; 4] = [
        Sphere::new(Vec3::ZERO, 1.0).unwrap().into(),
        Cylinder::new(Vec3::ZERO, Vec3::Y, 1.0).unwrap().into(),
        CappedCylinder::new(Vec3::ZERO, Vec3::Y, Vec3::Y, 1.0).unwrap().into(),
        Nappe::new(Vec3::ZERO, Vec3::Y, 1.0, 1.0).unwrap().into(),
    ];
    for leaf in leaves {
        for origin in [
            Vec3::ZERO,
            vec3(1e-22, 0.0, 2e-22),
            vec3(3e-23, -1e-20, 0.0),
            vec3(0.0, -1e-30, 0.0),
        ] {
            for direction in [vec3(1.0, 0.5, -1.75), vec3(1.25, -1.5, 1.0)] {
                let line = Line {
                    origin: V3::<f32>::from(origin),
                    toward: Toward::new(V3::from(direction)),
                };
                let normal = Vec3::from(leaf.surface_along(&line, 0.0).normal);
                assert!((normal.length() - 1.0).abs() < 1e-6, "{normal} at {origin} of {leaf:?}");
            }
        }
    }
}

/// Once a crossing just ahead of the origin, at a parameter below all normal numbers, was a hit at 0, and so was the next
/// one, for ever: a range from 0 on is no other one.
#[test]
fn whoever_asks_on_from_every_hit_comes_to_an_end() {
    let slab: Leaf = Cuboid::new(vec3(-1.0, -1.0, 0.0), Vec3::ONE).unwrap().into();
    let nodes = [Node::leaf(slab)];
    let program = Program::new(&nodes).unwrap();
    let mut scratch = [Span::EMPTY; 1];
    for exponent in -40..=40 {
        let direction = Vec3::Z * 2.0_f32.powi(exponent);
        for height in [1e-45_f32, 1e-40, 1.2e-38, 2e-38, 1e-37, 1e-30, 1e-26, 1e-20] {
            let mut ray = Ray::new(vec3(0.0, 0.0, -height), direction).unwrap();
            let mut single = Vec::new();
            while let Some(hit) = program.along(ray, &mut scratch).unwrap().cast() {
                assert!(hit.t > ray.range().start, "{hit:?} along {ray:?}");
                // Eight at once see the same, and so does the distance.
                let packet = Packet::new(&[ray]).cast(&program, &mut [EMPTY; 1]).unwrap();
                assert_eq!(packet.lane(0, &ray).map(|hit| hit.t), Some(hit.t));
                single.push(hit.t);
                ray = ray.within(hit.t..f32::INFINITY).unwrap();
            }
            let expected = height / direction.z;
            // In the parameter of the ray's line it is `height`.
            let is_past = expected.min(height) <= f32::MIN_POSITIVE;
            assert_eq!(
                single.len(),
                if is_past { 1 } else { 2 },
                "{single:?} from {height} along {direction}"
            );
            assert_eq!(slab.gsdf(ray.origin(), direction).abs(), single[0]);
            assert_eq!(slab.gsdf(ray.origin(), direction) < 0.0, is_past);
        }
    }
}
