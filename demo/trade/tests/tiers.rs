//! What the trade says of the tiers is what they promise.

use gsdf_simd::Level;
use gsdf_trade::{Contender, Method, NAMES, Ready, Way, measure, reference};
use std::time::Duration;

#[test]
fn tiers_are_as_accurate_as_they_say() {
    let scene = reference("s2", 48).unwrap();
    let contenders: Vec<_> = Contender::all(Level::PORTABLE).collect();
    let measured = measure(&scene, &contenders, 1, None, || {}).unwrap();
    let of = |name: &str| measured.iter().find(|one| one.contender == name).unwrap();
    // Scalar and packets say the same, tier by tier.
    for tier in ["fast", "robust", "f64"] {
        let (scalar, packets) = (of(&format!("{tier}, scalar")), of(&format!("{tier}, portable")));
        assert_eq!(
            (scalar.p99, scalar.worst, scalar.wrong),
            (packets.p99, packets.worst, packets.wrong),
            "{tier}"
        );
        assert_eq!((scalar.wrong, scalar.wrong_leaf), (0, Some(0)), "{tier}");
    }
    assert!(of("certified, scalar").worst <= f64::from(f32::EPSILON) / 2.0);
    assert!(of("f64, scalar").worst <= of("robust, scalar").worst);
    assert!(of("robust, scalar").worst < 1e-6 && of("fast, scalar").worst < 1e-4);
    assert!(of("traced 1e-2 64, scalar").p99 > of("traced 1e-4 512, scalar").p99);
    assert!(measured.iter().any(|one| one.is_best));
}

/// In every tier a packet, and a tile, gives the bits of its rays by themselves, at every level.
#[test]
fn a_lane_is_a_ray() {
    for name in NAMES {
        let scene = reference(name, 64).unwrap();
        let all = scene.rays().len();
        for level in Level::available() {
            let closed = Contender::all(level).filter(|contender| !contender.is_traced());
            for together in closed.filter(|contender| contender.way != Way::Scalar) {
                let single = Contender {
                    way: Way::Scalar,
                    ..together
                };
                let bits = |contender: Contender| -> Vec<_> {
                    let mut ready = contender.ready(&scene).unwrap();
                    ready.cast(all).unwrap();
                    let seen = |ray| ready.seen(ray).map(|seen| (seen.t.to_bits(), seen.hit_leaf()));
                    (0..all).map(seen).collect()
                };
                assert!(bits(single) == bits(together), "{together} on {name}");
            }
        }
    }
}

/// Who is slow casts fewer rays, and is judged by these alone.
#[test]
fn a_limit_leaves_rays_out() {
    let scene = reference("s2", 64).unwrap();
    let contenders: Vec<_> = Contender::all(Level::PORTABLE).collect();
    let measured = measure(&scene, &contenders, 1, Some(Duration::ZERO), || {}).unwrap();
    for one in &measured {
        let rays = match one.contender.rsplit(' ').next() {
            Some("scalar") => 1,
            Some("tiles") => 64 * 64,
            _ => 16,
        };
        assert_eq!((one.rays, one.judged), (rays, rays.min(64)), "{}", one.contender);
    }
    let mut scene = reference("s2", 200).unwrap();
    scene.fit(Level::PORTABLE, Duration::ZERO).unwrap();
    assert_eq!((scene.raster().width(), scene.rays().len()), (25, 25 * 25));
    let ready = |rays| {
        let mut ready: Ready<'_, '_> = contenders[0].ready(&scene).unwrap();
        ready.cast(rays).unwrap();
        ready
    };
    assert!(ready(3).seen(2).is_some() && ready(3).seen(3).is_none());
}

/// Tiles are what the others are compared with, and have all that is measured of them.
#[test]
fn all_are_compared_with_tiles() {
    let scene = reference("s1", 32).unwrap();
    let contenders: Vec<_> = Contender::all(Level::PORTABLE).collect();
    assert!(contenders.iter().any(|one| matches!(one.method, Method::Certified)));
    let mut rounds = 0;
    let measured = measure(&scene, &contenders, 3, None, || rounds += 1).unwrap();
    assert_eq!((rounds, measured.len()), (3, contenders.len()));
    for (one, contender) in measured.iter().zip(&contenders) {
        assert_eq!((&one.scene, &one.contender), (&"s1".to_owned(), &contender.to_string()));
        assert!(one.ns_low <= one.ns && one.ns <= one.ns_high && one.ns_low > 0.0);
        assert!(one.ratio_low <= one.ratio && one.ratio <= one.ratio_high);
        if contender.is_base() {
            assert_eq!((one.ratio_low, one.ratio, one.ratio_high), (1.0, 1.0, 1.0));
        }
    }
}
