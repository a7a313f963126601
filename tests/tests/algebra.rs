//! The algebra on a ray: sweep, march and attribution against what is true by definition, on spans whose ends coincide more often than not.

use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCylinder, Csg, Cuboid, Draft, HalfSpace, Leaf, Line, Node, Program, Ray, Solid, Span, Sphere, Toward, V3};
use gsdf_nostd::{attribute, csg, march, sweep, valid};
use gsdf_tests::trees::{Case, Number, Tree, finite_ends, random_ray, random_solid, random_span};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

/// Runs a property on so many random cases, each with a seed of its own, which a failure prints.
fn for_cases<T: Number>(count: u64, property: impl Fn(&Case<T>, &mut Pcg64)) {
    for seed in 0..count {
        let mut rng = Pcg64::seed_from_u64(seed);
        let case = Case::random(&mut rng);
        let failed = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| property(&case, &mut rng))).is_err();
        assert!(!failed, "seed {seed}: {:?} with {:?}", case.tree, case.spans);
    }
}

/// Sign, bound, and origin of the value of one sweep.
fn a_sweep_is_a_bound<T: Number>(case: &Case<T>, rng: &mut Pcg64) {
    let ends = finite_ends(&case.spans);
    for t in case.places(rng) {
        let inside = case.tree.contains(&case.spans, t);
        let value = sweep(&case.nodes, &case.spans, t);
        let bound = value.abs();
        assert_eq!(value < T::from(0.0), inside, "sign at {t:?}");
        assert!(bound > t, "{value:?} at {t:?} is not ahead");
        assert!(
            bound == T::from(f32::INFINITY) || ends.iter().any(|end| end.bits() == bound.bits()),
            "{value:?} at {t:?} is no end of a leaf"
        );
        // Membership can only change at ends: it is constant if it is so at those before the bound.
        for &end in ends.iter().filter(|&&end| t < end && end < bound) {
            assert_eq!(case.tree.contains(&case.spans, end), inside, "{value:?} at {t:?} oversteps {end:?}");
        }
    }
}

/// The march is the first crossing, and takes no more sweeps than there are roots ahead, and one.
fn a_march_is_the_first_crossing<T: Number>(case: &Case<T>, rng: &mut Pcg64) {
    let ends = finite_ends(&case.spans);
    let crossings = case.tree.crossings(&case.spans);
    let leaves = case.spans.len();
    for t in case.places(rng) {
        let expected = crossings.iter().find(|crossing| crossing.t > t);
        let found = march(&case.nodes, &case.spans, t);
        let first = expected.map_or(T::from(f32::INFINITY), |crossing| crossing.t);
        assert_eq!(found.t.bits(), first.bits(), "march from {t:?}: {found:?}, not {expected:?}");
        assert_eq!(found.inside, case.tree.contains(&case.spans, t), "side at {t:?}");
        assert!(expected.is_none_or(|crossing| crossing.entering != found.inside));
        let roots_ahead = ends.iter().filter(|&&end| end > t).count();
        assert!(
            found.sweeps as usize <= roots_ahead + 1,
            "{} sweeps for {roots_ahead} roots",
            found.sweeps
        );
        assert!(found.sweeps as usize <= 2 * leaves + 1);
    }
}

/// Every crossing is the lowest leaf's among those that make it; where nothing changes it is nobody's.
fn attribution_follows_its_definition<T: Number>(case: &Case<T>, rng: &mut Pcg64) {
    let crossings = case.tree.crossings(&case.spans);
    for crossing in &crossings {
        let found = attribute(&case.nodes, &case.spans, crossing.t);
        assert_eq!((found.before, found.after), (!crossing.entering, crossing.entering), "{crossing:?}");
        assert_eq!(found.leaf.to_index() as usize, crossing.culprits[0], "{crossing:?}");
    }
    for t in case.places(rng) {
        if crossings.iter().all(|crossing| crossing.t != t) {
            let found = attribute(&case.nodes, &case.spans, t);
            assert_eq!(found.before, found.after, "at {t:?}");
            assert_eq!(found.leaf, T::from(f32::INFINITY), "at {t:?}");
        }
    }
}

/// The two expressions give the same bits everywhere: one sweep, and who makes each crossing.
fn assert_same<T: Number>(case: &Case<T>, left: &Tree, right: &Tree, rng: &mut Pcg64) {
    let (nodes, spans) = (left.nodes(), case.restated(left));
    let (other_nodes, other_spans) = (right.nodes(), case.restated(right));
    for t in case.places(rng) {
        let (a, b) = (sweep(&nodes, &spans, t), sweep(&other_nodes, &other_spans, t));
        assert_eq!(a.bits(), b.bits(), "{left:?} and {right:?} at {t:?}");
        let (a, b) = (attribute(&nodes, &spans, t), attribute(&other_nodes, &other_spans, t));
        let sides = |found: gsdf_nostd::Attribution<T>| (found.before, found.after, found.leaf.bits());
        assert_eq!(sides(a), sides(b), "{left:?} and {right:?} at {t:?}");
    }
}

/// The laws of sets, with one half of the case's leaves against the other.
fn the_laws_of_sets_hold_to_the_bit<T: Number>(case: &Case<T>, rng: &mut Pcg64) {
    let split = case.spans.len() / 2;
    if split == 0 {
        return;
    }
    let a = Tree::random(rng, split);
    let b = Tree::random(rng, case.spans.len() - split).shifted(split);
    assert_same(case, &a.clone().without(b.clone()), &a.clone().and(b.clone().inverted()), rng);
    let either = a.clone().or(b.clone()).inverted();
    assert_same(case, &either, &a.clone().inverted().and(b.clone().inverted()), rng);
    let both = a.clone().and(b.clone()).inverted();
    assert_same(case, &both, &a.clone().inverted().or(b.clone().inverted()), rng);
    assert_same(case, &a.clone().inverted().inverted(), &a, rng);
    // A copy adds nothing: its leaves are the same spans again, with higher numbers.
    assert_same(case, &a.clone().or(a.clone()), &a, rng);
    assert_same(case, &a.clone().and(a.clone()), &a, rng);
    // The complement negates.
    let (nodes, inverted, spans) = (a.nodes(), a.clone().inverted().nodes(), case.restated(&a));
    for t in case.places(rng) {
        assert_eq!(sweep(&inverted, &spans, t).bits(), (-sweep(&nodes, &spans, t)).bits());
    }
}

/// Swapping operands changes no crossing, and the lowest number is still the lowest of the same leaves, as they are numbered now.
fn the_order_of_operands_does_not_show<T: Number>(case: &Case<T>, rng: &mut Pcg64) {
    let shuffled = case.tree.shuffled(rng);
    if shuffled.depth() > 32 {
        return;
    }
    let (nodes, spans, order) = (shuffled.nodes(), case.restated(&shuffled), shuffled.order());
    for t in case.places(rng) {
        assert_eq!(
            sweep(&nodes, &spans, t).bits(),
            sweep(&case.nodes, &case.spans, t).bits(),
            "at {t:?}"
        );
    }
    for crossing in case.tree.crossings(&case.spans) {
        let found = attribute(&nodes, &spans, crossing.t);
        let lowest = order.iter().position(|number| crossing.culprits.contains(number));
        assert_eq!(Some(found.leaf.to_index() as usize), lowest, "{crossing:?} in {shuffled:?}");
    }
}

/// However the operands of a row of unions (or intersections) are bracketed, the same leaf makes the crossing.
fn brackets_do_not_show<T: Number>(case: &Case<T>, rng: &mut Pcg64) {
    let count = case.spans.len().min(30);
    let operands: Vec<Tree> = (0..count)
        .map(|number| {
            let leaf = Tree::Leaf(number);
            if rng.random_range(0..3) == 0 { leaf.inverted() } else { leaf }
        })
        .collect();
    for join in [Tree::or, Tree::and] {
        let from_left = operands.iter().cloned().reduce(join);
        let from_right = operands.iter().cloned().rev().reduce(|right, left| join(left, right));
        if let (Some(left), Some(right)) = (from_left, from_right) {
            assert_same(case, &left, &right, rng);
        }
    }
}

/// Each property in both arithmetics; about a dozen queries and more per case.
macro_rules! in_both_arithmetics {
    ($($property:ident, $cases:expr;)+) => {
        mod in_f32 {
            $(#[test] fn $property() { super::for_cases::<f32>($cases, super::$property); })+
        }
        mod in_f64 {
            $(#[test] fn $property() { super::for_cases::<f64>($cases, super::$property); })+
        }
    };
}

in_both_arithmetics! {
    a_sweep_is_a_bound, 10_000;
    a_march_is_the_first_crossing, 10_000;
    attribution_follows_its_definition, 10_000;
    the_laws_of_sets_hold_to_the_bit, 2_000;
    the_order_of_operands_does_not_show, 4_000;
    brackets_do_not_show, 2_000;
}

#[test]
fn ties_are_what_these_cases_are_made_of() {
    let (mut crossings, mut tied) = (0_u32, 0_u32);
    for seed in 0..2_000 {
        let case: Case<f32> = Case::random(&mut Pcg64::seed_from_u64(seed));
        for crossing in case.tree.crossings(&case.spans) {
            crossings += 1;
            tied += u32::from(crossing.culprits.len() > 1);
        }
    }
    assert!(crossings > 3_000 && tied * 10 > crossings, "{tied} of {crossings}");
}

#[test]
fn the_whole_stack_of_32_operands_is_used() {
    let mut rng = Pcg64::seed_from_u64(1);
    for _ in 0..2_000 {
        // All leaves before all operators: the deepest that a program may be.
        let tree = (0..31).rev().fold(Tree::Leaf(31), |right, number| match rng.random_range(0..3) {
            0 => Tree::Leaf(number).or(right),
            1 => Tree::Leaf(number).and(right),
            _ => Tree::Leaf(number).inverted().or(right),
        });
        assert_eq!(tree.depth(), 32);
        let spans = (0..32).map(|_| random_span::<f32>(&mut rng, true)).collect();
        let case = Case::of(tree, spans);
        assert!(Program::new(&case.nodes).is_ok());
        a_march_is_the_first_crossing(&case, &mut rng);
        attribution_follows_its_definition(&case, &mut rng);
    }
}

/// The line that the ray with this direction is; equal to it only where the largest component is from 1 to 2.
fn line<T: Number>(origin: Vec3, direction: Vec3) -> Line<T>
where
    V3<T>: From<Vec3>,
{
    Line {
        origin: origin.into(),
        toward: Toward::new(direction.into()),
    }
}

/// The public reading of a program of real solids against the definition: in its whole range and between any two bounds, some of them crossings.
fn the_crossings_of_solids<T: Number>(cases: u64)
where
    V3<T>: From<Vec3>,
{
    for seed in 0..cases {
        let mut rng = Pcg64::seed_from_u64(seed);
        let leaves = rng.random_range(1..=12);
        let tree = Tree::random(&mut rng, leaves);
        let solids: Vec<Leaf> = (0..leaves).map(|_| random_solid(&mut rng)).collect();
        let nodes = tree.postfix(&solids);
        let program = Program::new(&nodes).expect("a tree is a program");
        let mut scratch = vec![Span::empty_like(T::from(0.0)); leaves];
        for _ in 0..8 {
            let (origin, direction) = random_ray(&mut rng);
            let spans: Vec<Span<T>> = solids.iter().map(|solid| solid.span_along(&line(origin, direction))).collect();
            let mut truth = tree.crossings(&spans);
            truth.retain(|crossing| crossing.t > T::from(0.0));
            // A direction a power of two as long divides every parameter exactly.
            let scale = [0.125_f32, 1.0, 1024.0][rng.random_range(0..3)];
            let ray = Ray::new(origin, direction * scale).expect("small numbers make a ray");
            let whole: Vec<_> = program.along(ray, &mut scratch).expect("room").crossings().collect();
            assert_eq!(whole.len(), truth.len(), "seed {seed}: {whole:?}, not {truth:?}");
            for (found, truth) in whole.iter().zip(&truth) {
                assert_eq!((found.t * T::from(scale)).bits(), truth.t.bits(), "seed {seed}");
                assert_eq!(
                    (found.leaf as usize, found.entering),
                    (truth.culprits[0], truth.entering),
                    "seed {seed}"
                );
            }
            assert!(
                whole.is_sorted_by(|a, b| a.t < b.t && a.entering != b.entering),
                "seed {seed}: {whole:?}"
            );

            // What happens at the start is past, what happens at the end is not reached.
            let mut bound = || match rng.random_range(0..3) {
                0 => rng.random_range(0.0..12.0) / scale,
                _ if whole.is_empty() => 1.0,
                _ => whole[rng.random_range(0..whole.len())].t.to_f32(),
            };
            let (one, other) = (bound(), bound());
            if let Ok(part) = ray.within(one.min(other)..one.max(other)) {
                let range = part.range();
                let within: Vec<_> = program.along(part, &mut scratch).expect("room").crossings().collect();
                let expected: Vec<_> = whole
                    .iter()
                    .filter(|crossing| crossing.t > T::from(range.start) && crossing.t < T::from(range.end))
                    .copied()
                    .collect();
                assert_eq!(within, expected, "seed {seed}: {range:?}");
                // A march knows where to start and not where to end.
                let found = program.along(part, &mut scratch).expect("room").march();
                let next = whole.iter().find(|crossing| crossing.t > T::from(range.start));
                assert_eq!(
                    found.t,
                    next.map_or(T::from(f32::INFINITY), |crossing| crossing.t),
                    "seed {seed}: {range:?}"
                );
                assert!(
                    next.is_none_or(|crossing| crossing.entering != found.inside),
                    "seed {seed}: {range:?}"
                );
            }
        }
    }
}

#[test]
fn crossings_of_solids_are_those_of_their_spans() {
    the_crossings_of_solids::<f32>(3_000);
    the_crossings_of_solids::<f64>(3_000);
}

#[test]
fn distance_and_hit_agree_with_the_crossings() {
    let mut hits = 0;
    for seed in 0..10_000 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let leaves = rng.random_range(1..=8);
        let solids: Vec<Leaf> = (0..leaves).map(|_| random_solid(&mut rng)).collect();
        let nodes = Tree::random(&mut rng, leaves).postfix(&solids);
        let program = Program::new(&nodes).expect("a tree is a program");
        let mut scratch = vec![Span::EMPTY; leaves];
        let (origin, direction) = random_ray(&mut rng);
        let ray = Ray::new(origin, direction).expect("small numbers make a ray");
        let sight = program.along(ray, &mut scratch).expect("room");
        let (distance, hit) = (sight.gsdf(), sight.cast());
        let first = sight.crossings().next();
        assert_eq!(distance.abs(), first.map_or(f32::INFINITY, |crossing| crossing.t), "seed {seed}");
        assert_eq!(
            hit.map(|hit| (hit.t.to_bits(), hit.leaf, hit.entering)),
            first.map(|c| (c.t.to_bits(), c.leaf, c.entering))
        );
        if let Some(hit) = hit {
            hits += 1;
            assert_eq!(hit.entering, distance > 0.0, "seed {seed}");
            assert_eq!(hit.point, ray.at(hit.t), "seed {seed}");
            // A ray that grazes may see its surface edge on, a unit in the last place behind.
            let against = hit.normal.dot(direction) * if hit.entering { -1.0 } else { 1.0 };
            assert!(against >= -1e-6, "seed {seed}: {hit:?} along {direction}");
            assert!((hit.normal.length() - 1.0).abs() < 1e-6, "seed {seed}: {hit:?}");
        }
    }
    assert!(hits > 2_000, "{hits}");
}

const BOX: Cuboid = valid!(Cuboid::new(Vec3::ZERO, Vec3::ONE));
const NEIGHBOUR: Cuboid = valid!(Cuboid::new(Vec3::X, vec3(2.0, 1.0, 1.0)));

/// From the middle of the left face along x.
fn along_x() -> Ray {
    Ray::new(vec3(-1.0, 0.5, 0.5), Vec3::X).expect("a ray")
}

#[test]
fn a_plug_flush_in_a_drilled_plate_is_seen_and_not_the_plate() {
    csg! { const PLATE = Cuboid::new(vec3(-4.0, 0.0, -4.0), vec3(4.0, 1.0, 4.0)) }
    csg! { const DRILLED = difference(PLATE, CappedCylinder::new(vec3(0.0, -1.0, 0.0), vec3(0.0, 2.0, 0.0), Vec3::Y, 1.0)) }
    csg! { const PLUGGED = union(DRILLED, CappedCylinder::new(Vec3::ZERO, Vec3::Y, Vec3::Y, 1.0)) }
    let down = |x| Ray::new(vec3(x, 5.0, 0.0), Vec3::NEG_Y).expect("a ray");
    let seen = |x| PLUGGED.crossings(down(x)).map(|c| (c.t, c.leaf, c.entering)).collect::<Vec<_>>();
    // The plate is cut away there, but its planes are still roots, of the same parameter and a lower number.
    assert_eq!(seen(0.5), [(4.0, 2, true), (5.0, 2, false)]);
    assert_eq!(seen(2.0), [(4.0, 0, true), (5.0, 0, false)]);
    assert_eq!(PLUGGED.cast(&down(0.5)).map(|hit| hit.normal), Some(Vec3::Y));
    // Nor is there anything between plug and plate.
    let across = Ray::new(vec3(-9.0, 0.5, 0.25), Vec3::X).expect("a ray");
    assert_eq!(
        PLUGGED.crossings(across).map(|c| (c.t, c.leaf)).collect::<Vec<_>>(),
        [(5.0, 0), (13.0, 0)]
    );
}

#[test]
fn two_boxes_that_share_a_face_are_one() {
    let joined: Csg<3> = Draft::new()
        .leaf(BOX.into())
        .leaf(NEIGHBOUR.into())
        .operator(Node::Union)
        .finish()
        .expect("a program");
    let seen: Vec<_> = joined.crossings(along_x()).map(|c| (c.t, c.leaf, c.entering)).collect();
    assert_eq!(seen, [(1.0, 0, true), (3.0, 1, false)]);
    // A ray in the shared face is in neither box, as it is in none of the other faces.
    assert_eq!(joined.crossings(Ray::new(vec3(1.0, 0.5, -1.0), Vec3::Z).expect("a ray")).count(), 0);
}

#[test]
fn a_box_cut_flush_has_no_skin() {
    csg! { const BLOCK = Cuboid::new(Vec3::ZERO, vec3(2.0, 1.0, 1.0)) }
    csg! { const CUT = difference(BLOCK, Cuboid::new(Vec3::X, vec3(2.0, 1.0, 1.0))) }
    let seen: Vec<_> = CUT.crossings(along_x()).map(|c| (c.t, c.leaf, c.entering)).collect();
    assert_eq!(seen, [(1.0, 0, true), (2.0, 1, false)]);
    assert_eq!(CUT.cast(&Ray::new(vec3(1.5, 0.5, 3.0), Vec3::NEG_Z).expect("a ray")), None);
    // The cut face is that of the leaf taken away, turned around.
    let from_right = CUT.cast(&Ray::new(vec3(4.0, 0.5, 0.5), Vec3::NEG_X).expect("a ray"));
    assert_eq!(from_right.map(|hit| (hit.t, hit.leaf, hit.normal)), Some((3.0, 1, Vec3::X)));
    csg! { const NOTHING = difference(BLOCK, BLOCK) }
    assert_eq!(NOTHING.gsdf(vec3(-1.0, 0.5, 0.5), Vec3::X), f32::INFINITY);
}

#[test]
fn a_draft_and_a_nested_expression_make_the_same_program() {
    csg! { const NESTED = union(difference(Sphere::new(Vec3::ZERO, 1.0), posed(2, complement(HalfSpace::new(Vec3::ZERO, Vec3::X)))), Sphere::new(Vec3::Y, 0.5)) }
    let drafted: Result<Csg<6>, _> = Draft::new()
        .leaf(valid!(Sphere::new(Vec3::ZERO, 1.0)).into())
        .leaf(valid!(HalfSpace::new(Vec3::ZERO, Vec3::X)).into())
        .operator(Node::Complement)
        .posed(2)
        .operator(Node::Difference)
        .leaf(valid!(Sphere::new(Vec3::Y, 0.5)).into())
        .operator(Node::Union)
        .finish();
    assert_eq!(drafted, Ok(NESTED));
    // As is one made from the expression's own nodes.
    assert_eq!(Draft::new().program(NESTED.nodes()).finish(), Ok(NESTED));
    assert_eq!(Csg::new(*NESTED.nodes().first_chunk::<6>().expect("six nodes")), Ok(NESTED));
}
