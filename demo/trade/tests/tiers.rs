//! What the trade says of the tiers is what they promise.

use gsdf_simd::Level;
use gsdf_trade::{Contender, NAMES, Scene, Seen, measure};

#[test]
fn tiers_are_as_accurate_as_they_say() {
    let scene = Scene::by_name("s2", 48).unwrap();
    let contenders: Vec<_> = Contender::all(Level::PORTABLE).collect();
    let measured = measure(&scene, &contenders, 1, || {}).unwrap();
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

/// In every tier a packet gives the bits of its rays by themselves, at every level.
#[test]
fn a_lane_is_a_ray() {
    for scene in NAMES {
        let scene = Scene::by_name(scene, 64).unwrap();
        for level in Level::available() {
            let contenders: Vec<_> = Contender::all(level).filter(|contender| !contender.is_traced()).collect();
            let (mut alone, mut in_packets) = (Vec::new(), Vec::new());
            for packets in contenders.iter().filter(|contender| contender.level.is_some()) {
                let single = Contender { level: None, ..*packets };
                single.cast(&scene, &mut alone).unwrap();
                packets.cast(&scene, &mut in_packets).unwrap();
                let bits = |seen: &[Seen]| -> Vec<_> { seen.iter().map(|seen| (seen.t.to_bits(), seen.hit_leaf())).collect() };
                assert!(bits(&alone) == bits(&in_packets), "{packets} on {}", scene.name);
            }
        }
    }
}
