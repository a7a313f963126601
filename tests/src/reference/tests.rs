//! Cases that can be checked by hand, and a comparison with membership sampled along the line.

use glam::{Vec3, vec3};
use proptest::prelude::*;

use super::{Exact, ExactVec3, Expr, Line, Root};

const X: Vec3 = Vec3::X;
const Y: Vec3 = Vec3::Y;
const Z: Vec3 = Vec3::Z;
const INFINITY: f64 = f64::INFINITY;

fn spans(solid: &Expr, origin: Vec3, direction: Vec3) -> Vec<(f64, f64)> {
    solid
        .spans(origin, direction)
        .iter()
        .map(|(enter, exit)| (enter.to_f64(), exit.to_f64()))
        .collect()
}

#[test]
fn a_ball_is_hit_twice_or_touched_or_missed() {
    let ball = Expr::sphere(vec3(0.0, 0.0, 5.0), 1.0_f32);
    assert_eq!(spans(&ball, Vec3::ZERO, Z), [(4.0, 6.0)]);
    assert_eq!(spans(&ball, Vec3::ZERO, -2.0 * Z), [(-3.0, -2.0)]);
    assert_eq!(spans(&ball, X, Z), []);
    assert_eq!(spans(&ball, X.with_x(1.0_f32.next_down()), Z).len(), 1);
    assert_eq!(spans(&ball, X.with_x(1.0_f32.next_up()), Z), []);
    // The touching line leaves the complement at no span of its own either.
    assert_eq!(spans(&ball.complement(), X, Z), [(-INFINITY, INFINITY)]);
}

#[test]
fn boxes_that_share_a_face_are_one_span() {
    let left = Expr::cuboid(vec3(0.0, 0.0, 0.0), vec3(0.1, 1.0, 1.0));
    let right = Expr::cuboid(vec3(0.1, 0.0, 0.0), vec3(0.3, 1.0, 1.0));
    let middle = vec3(0.0, 0.5, 0.5);
    let both = left.clone().tagged(1).or(right.clone().tagged(2));
    assert_eq!(spans(&both, middle, X), [(0.0, f64::from(0.3_f32))]);
    assert_eq!(spans(&left.clone().and(right), middle, X), []);

    let crossings = both.crossings(middle, X);
    assert_eq!(
        crossings.iter().map(|crossing| crossing.leaves.as_slice()).collect::<Vec<_>>(),
        [[1], [2]]
    );

    // A line within a face of the box is outside it.
    assert_eq!(spans(&left, vec3(-1.0, 0.0, 0.5), X), []);
    assert_eq!(spans(&left, vec3(-1.0, 0.5, 1.0), X), []);
    assert_eq!(spans(&left, vec3(-1.0, 0.5, 1.0_f32.next_down()), X).len(), 1);
}

#[test]
fn a_line_within_a_plane_is_outside() {
    let ground = Expr::half_space(vec3(3.0, 0.0, 7.0), Y);
    assert_eq!(spans(&ground, Vec3::ZERO, X), []);
    assert_eq!(spans(&ground, -Y, X), [(-INFINITY, INFINITY)]);
    assert_eq!(spans(&ground, Y, Y), [(-INFINITY, -1.0)]);
    assert_eq!(spans(&ground, Y, -Y), [(1.0, INFINITY)]);
    assert_eq!(spans(&ground.complement(), Vec3::ZERO, X), [(-INFINITY, INFINITY)]);
}

#[test]
fn a_capsule_has_no_seams() {
    let capsule = Expr::capsule(vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, 4.0), 0.5_f32).tagged(9);
    assert_eq!(spans(&capsule, Vec3::ZERO, Z), [(0.5, 4.5)]);
    assert_eq!(spans(&capsule, vec3(-3.0, 0.0, 2.0), X), [(2.5, 3.5)]);
    // Through the circle where the cap meets the cylinder, and along a line that touches the whole side.
    assert_eq!(spans(&capsule, vec3(-3.0, 0.0, 1.0), X), [(2.5, 3.5)]);
    assert_eq!(spans(&capsule, vec3(0.5, 0.0, 0.0), Z), []);
    assert_eq!(capsule.crossings(Vec3::ZERO, Z).len(), 2);

    let point = Expr::capsule(Vec3::ONE, Vec3::ONE, 2.0_f32);
    assert_eq!(spans(&point, Vec3::ONE, Y), [(-2.0, 2.0)]);
}

#[test]
fn a_nappe_is_half_of_a_double_cone() {
    let nappe = Expr::nappe(Vec3::ZERO, Z, 3.0_f32, 4.0_f32);
    assert_eq!(spans(&nappe, Vec3::ZERO, Z), [(0.0, INFINITY)]);
    assert_eq!(spans(&nappe, vec3(0.0, 0.0, 4.0), X), [(-3.0, 3.0)]);
    assert_eq!(spans(&nappe, vec3(0.0, 0.0, -4.0), X), []);
    // Steeper than the side: the line crosses both nappes, and only one of them counts.
    assert_eq!(spans(&nappe, vec3(3.0, 0.0, 0.0), Z), [(4.0, INFINITY)]);
    // Along the side itself.
    assert_eq!(spans(&nappe, Vec3::ZERO, vec3(3.0, 0.0, 4.0)), []);
    // Through the apex, across.
    assert_eq!(spans(&nappe, Vec3::ZERO, X), []);
}

#[test]
fn cones_end_at_their_caps() {
    let cone = Expr::cone(Vec3::ZERO, vec3(9.0, 9.0, 8.0), Z, 3.0_f32, 4.0_f32);
    assert_eq!(spans(&cone, -Z, Z), [(1.0, 9.0)]);
    assert_eq!(spans(&cone, vec3(0.0, 0.0, 4.0), X), [(-3.0, 3.0)]);

    // Radius 5 at z = 1, narrowing to 2 at z = 5; the apex is at z = 23/3.
    let frustum = |top| Expr::capped_cone(Z, Z * top, Z, 5.0_f32, -3.0_f32, 4.0_f32);
    assert_eq!(spans(&frustum(5.0), vec3(-10.0, 0.0, 3.0), X), [(6.5, 13.5)]);
    assert_eq!(spans(&frustum(5.0), Vec3::ZERO, Z), [(1.0, 5.0)]);
    assert_eq!(spans(&frustum(9.0), Vec3::ZERO, Z), [(1.0, 23.0 / 3.0)]);
    assert_eq!(spans(&frustum(50.0), vec3(0.0, 0.0, 9.0), X), []);

    // A side that does not widen is that of a cylinder, which holds none of the lines within it.
    let axis = vec3(1.0, 1.0, 0.0);
    let straight = Expr::capped_cone(Vec3::ZERO, axis, axis, 3.0_f32, 0.0_f32, 0.7_f32);
    assert_eq!(spans(&straight, vec3(0.0, 0.0, 3.0), axis), []);
    assert_eq!(spans(&straight, vec3(0.0, 0.0, 2.5), axis), [(0.0, 1.0)]);

    let cylinder = Expr::capped_cylinder(Z, Z * 5.0, Z * 0.5, 2.0_f32);
    assert_eq!(spans(&cylinder, Vec3::ZERO, Z), [(1.0, 5.0)]);
    assert_eq!(spans(&cylinder, Z * 2.0, Y), [(-2.0, 2.0)]);
    assert_eq!(spans(&cylinder, vec3(2.0, 0.0, 0.0), Z), []);
}

#[test]
fn crossings_say_what_changes() {
    let ball = Expr::sphere(Vec3::ZERO, 2.0_f32).tagged(1);
    let drill = Expr::cylinder(Vec3::ZERO, Z, 1.0_f32).tagged(2);
    let drilled = ball.minus(drill).tagged(3);
    let line = drilled.along(-3.0 * X, X);
    let found: Vec<_> = line
        .crossings()
        .into_iter()
        .map(|at| (at.t.to_f64(), at.entering, at.leaves))
        .collect();
    let expected = [
        (1.0, true, vec![1, 3]),
        (2.0, false, vec![2, 3]),
        (4.0, true, vec![2, 3]),
        (5.0, false, vec![1, 3]),
    ];
    assert_eq!(found, expected);

    let first = |t| line.first_crossing_after(t).map(|crossing| crossing.t.to_f64());
    assert_eq!(first(-INFINITY), Some(1.0));
    assert_eq!(first(1.0_f64.next_down()), Some(1.0));
    assert_eq!(first(1.0), Some(2.0));
    assert_eq!(first(5.0), None);
    assert_eq!(first(INFINITY), None);

    let inside = [-INFINITY, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, INFINITY].map(|t| line.inside_at(t));
    assert_eq!(inside, [false, false, true, false, false, true, false, false]);
}

#[test]
fn a_map_moves_the_point_before_it_is_asked() {
    // local = 2 (x - origin), with x and y exchanged.
    let linear = [[0.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]];
    let solid = Expr::cuboid(Vec3::ZERO, vec3(2.0, 4.0, 6.0)).mapped(linear, vec3(10.0, 20.0, 30.0));
    assert_eq!(spans(&solid, vec3(0.0, 20.5, 31.0), X), [(10.0, 12.0)]);
    assert_eq!(spans(&solid, vec3(10.5, 0.0, 31.0), Y), [(20.0, 21.0)]);
    assert!(solid.contains(vec3(11.9, 20.9, 32.9)) && !solid.contains(vec3(11.9, 21.0, 32.9)));
}

#[test]
fn nothing_and_everything() {
    assert_eq!(spans(&Expr::Or(vec![]), Vec3::ZERO, X), []);
    assert_eq!(spans(&Expr::And(vec![]), Vec3::ZERO, X), [(-INFINITY, INFINITY)]);
    // A direction of no length stays where it is.
    let ball = Expr::sphere(Vec3::ZERO, 1.0_f32);
    assert_eq!(spans(&ball, Vec3::ZERO, Vec3::ZERO), [(-INFINITY, INFINITY)]);
    assert_eq!(spans(&ball, X, Vec3::ZERO), []);
}

/// Halves of small integers, so that faces coincide and lines touch or pass through edges all the time.
fn coarse() -> impl Strategy<Value = f32> {
    (-4..=4_i32).prop_map(|number| number as f32 * 0.5)
}

fn coarse_vector() -> impl Strategy<Value = Vec3> {
    [coarse(), coarse(), coarse()].prop_map(Vec3::from_array)
}

fn direction() -> impl Strategy<Value = Vec3> {
    coarse_vector().prop_filter("a direction has a length", |vector| *vector != Vec3::ZERO)
}

fn size() -> impl Strategy<Value = f32> {
    (1..=4_i32).prop_map(|number| number as f32 * 0.5)
}

fn primitive() -> impl Strategy<Value = Expr> {
    prop_oneof![
        (coarse_vector(), direction()).prop_map(|(point, normal)| Expr::half_space(point, normal)),
        (coarse_vector(), size()).prop_map(|(center, radius)| Expr::sphere(center, radius)),
        (coarse_vector(), direction(), size()).prop_map(|(point, axis, radius)| Expr::cylinder(point, axis, radius)),
        (coarse_vector(), direction(), size(), size()).prop_map(|(apex, axis, sin, cos)| Expr::nappe(apex, axis, sin, cos)),
        (coarse_vector(), coarse_vector()).prop_map(|(a, b)| Expr::cuboid(a.min(b), a.max(b))),
        (coarse_vector(), coarse_vector(), direction(), size())
            .prop_map(|(bottom, top, axis, radius)| Expr::capped_cylinder(bottom, top, axis, radius)),
        (coarse_vector(), coarse_vector(), direction(), size(), size())
            .prop_map(|(apex, base, axis, rise, run)| Expr::cone(apex, base, axis, rise, run)),
        (coarse_vector(), coarse_vector(), direction(), size(), coarse(), size())
            .prop_map(|(bottom, top, axis, radius, rise, run)| Expr::capped_cone(bottom, top, axis, radius, rise, run)),
        (coarse_vector(), coarse_vector(), size()).prop_map(|(a, b, radius)| Expr::capsule(a, b, radius)),
    ]
}

fn solid() -> impl Strategy<Value = Expr> {
    primitive().prop_recursive(3, 12, 3, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 1..4).prop_map(Expr::And),
            prop::collection::vec(inner.clone(), 1..4).prop_map(Expr::Or),
            (inner.clone(), inner.clone()).prop_map(|(a, b)| a.minus(b)),
            (inner.clone(), 0..4_u32).prop_map(|(inner, tag)| inner.tagged(tag)),
            ([coarse_vector(), coarse_vector(), coarse_vector()], coarse_vector(), inner)
                .prop_map(|(rows, origin, inner)| inner.mapped(rows.map(|row| row.to_array()), origin)),
        ]
    })
}

/// Whether one of these spans contains `t`, its ends excluded.
fn spans_contain(spans: &[(Root, Root)], t: f64) -> bool {
    let t = Root::from(t);
    spans
        .iter()
        .any(|(enter, exit)| enter.compare(&t).is_lt() && exit.compare(&t).is_gt())
}

/// Asks the point itself at many places, without polynomial and without root.
fn check_against_samples(solid: &Expr, line: &Line, origin: Vec3, direction: Vec3) -> Result<(), TestCaseError> {
    let spans = line.spans();
    let (start, step) = (ExactVec3::from(origin), ExactVec3::from(direction));
    for index in -200..=200_i32 {
        let t = f64::from(index) * 0.0625;
        // On a surface neither answer is wrong, so look on both sides of all the places that are easy to hit.
        for t in [t, t + f64::powi(2.0, -40), t - f64::powi(2.0, -40)] {
            let exact = Exact::from(t);
            if line.is_cut(&exact) {
                continue;
            }
            let inside = solid.contains(&start + &step.times(&exact));
            prop_assert_eq!(inside, spans_contain(&spans, t), "at t = {}", t);
            prop_assert_eq!(inside, line.inside_at(t), "just after t = {}", t);
        }
    }
    Ok(())
}

proptest! {
    #[test]
    fn spans_agree_with_sampled_membership(solid in solid(), origin in coarse_vector(), direction in direction()) {
        let line = solid.along(origin, direction);
        check_against_samples(&solid, &line, origin, direction)?;
    }

    #[test]
    fn lines_at_odd_angles_agree_too(
        solid in solid(), origin in [-3.0..3.0_f64, -3.0..3.0_f64, -3.0..3.0_f64], to in coarse_vector(),
    ) {
        let origin = Vec3::from_array(origin.map(|coordinate| coordinate as f32));
        let direction = to - origin;
        let line = solid.along(origin, direction);
        check_against_samples(&solid, &line, origin, direction)?;
    }

    #[test]
    fn spans_and_crossings_tell_the_same(solid in solid(), origin in coarse_vector(), direction in direction()) {
        let line = solid.clone().tagged(77).along(origin, direction);
        let crossings = line.crossings();
        let ends: Vec<Root> = line.spans().into_iter().flat_map(|(enter, exit)| [enter, exit]).collect();
        let finite: Vec<&Root> = ends.iter().filter(|end| end.finite().is_some()).collect();
        prop_assert!(ends.is_sorted_by(|a, b| a.compare(b).is_lt()));
        prop_assert_eq!(finite.len(), crossings.len());
        for (end, crossing) in finite.iter().zip(&crossings) {
            prop_assert!(end.compare(&crossing.t).is_eq());
            prop_assert!(crossing.leaves.contains(&77));
        }
        prop_assert!(crossings.is_sorted_by(|a, b| a.entering != b.entering));
    }

    /// A membership function must not depend on how long a direction is.
    #[test]
    fn the_length_of_an_axis_changes_nothing(
        (bottom, top, axis) in (coarse_vector(), coarse_vector(), direction()),
        (radius, rise, run) in (size(), coarse(), size()),
        (origin, direction) in (coarse_vector(), direction()),
        factor in prop::sample::select(vec![3.0_f32, 0.625, 7.0]),
    ) {
        let spans = |axis: Vec3| {
            let cone = Expr::capped_cone(bottom, top, axis, radius, rise, run);
            let cylinder = Expr::capped_cylinder(top, bottom, -axis, radius);
            cone.or(cylinder).spans(origin, direction)
        };
        let (short, long) = (spans(axis), spans(axis * factor));
        prop_assert_eq!(short.len(), long.len());
        for (a, b) in short.iter().zip(&long) {
            prop_assert!(a.0.compare(&b.0).is_eq() && a.1.compare(&b.1).is_eq());
        }
    }
}
