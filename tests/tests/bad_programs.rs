//! Lists of nodes that are no programs: every one is refused with a reason that is right, and what is accepted can be asked anything.

use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCone, Capsule, Cone, Csg, Cuboid, Cylinder, Draft, HalfSpace, Leaf, Nappe, Node, Program, ProgramError, Ray, Span};
use gsdf_nostd::{Sphere, Transform, csg, valid};
use gsdf_tests::trees::Tree;
use rand::{Rng, RngExt, SeedableRng};
use rand_pcg::Pcg64;

const BALL: Leaf = Leaf::Sphere(valid!(Sphere::new(Vec3::ZERO, 1.0)));

/// What a list of nodes deserves, from counts over each of its prefixes; the library keeps one running count.
fn verdict(nodes: &[Node]) -> Result<usize, ProgramError> {
    let leaves = |nodes: &[Node]| nodes.iter().filter(|node| matches!(node, Node::Leaf { .. })).count();
    let joints = |nodes: &[Node]| nodes.iter().filter(|node| is_binary(node)).count();
    if nodes.is_empty() {
        return Err(ProgramError::Empty);
    }
    for (index, node) in nodes.iter().enumerate() {
        let waiting = leaves(&nodes[..index]) - joints(&nodes[..index]);
        let wanted = match node {
            Node::Leaf { .. } => 0,
            Node::Complement => 1,
            _ => 2,
        };
        if waiting < wanted {
            return Err(ProgramError::MissingOperand(index));
        }
        if wanted == 0 && waiting == 32 {
            return Err(ProgramError::TooDeep(index));
        }
    }
    match leaves(nodes) - joints(nodes) {
        1 => Ok(leaves(nodes)),
        left => Err(ProgramError::Unjoined(left)),
    }
}

fn is_binary(node: &Node) -> bool {
    matches!(node, Node::Union | Node::Intersection | Node::Difference)
}

/// One of a handful of solids, of every kind.
fn solid(choice: u8) -> Leaf {
    let (low, high, side) = (vec3(-1.0, -0.5, 0.0), vec3(0.5, 1.0, 2.0), vec3(0.6, 0.0, 0.8));
    match choice % 9 {
        0 => valid!(HalfSpace::new(Vec3::ONE, Vec3::X)).into(),
        1 => valid!(Sphere::new(vec3(0.5, 0.0, 0.0), 1.5)).into(),
        2 => Cylinder::new(low, side, 0.5).expect("a unit axis").into(),
        3 => valid!(Nappe::new(Vec3::ZERO, Vec3::Y, 1.0, 2.0)).into(),
        4 => Cuboid::new(low, high).expect("ordered corners").into(),
        5 => Capsule::new(low, high, 0.25).expect("two ends").into(),
        6 => valid!(Cone::new(Vec3::Z, Vec3::ZERO, Vec3::NEG_Z, 1.0)).into(),
        7 => valid!(CappedCone::new(Vec3::ZERO, Vec3::X, Vec3::X, 1.0, 0.5)).into(),
        _ => BALL,
    }
}

/// Nodes from raw bytes, as a careless reader of files would make them: `leaves` in 16 are solids, the others operators.
fn decoded(bytes: &[[u8; 4]], leaves: u8) -> Vec<Node> {
    let node = |&[kind, choice, low, high]: &[u8; 4]| match kind % 16 {
        kind if kind < leaves => Node::Leaf {
            solid: solid(choice),
            frame: u16::from_le_bytes([low, high]),
        },
        _ => [Node::Union, Node::Intersection, Node::Difference, Node::Complement][usize::from(choice % 4)],
    };
    bytes.iter().map(node).collect()
}

fn random_nodes(rng: &mut impl Rng) -> Vec<Node> {
    // Most lists of any length fail at once: short ones are the likelier to be right.
    let most = [4, 12, 40, 200][rng.random_range(0..4)];
    let bytes: Vec<[u8; 4]> = (0..rng.random_range(0..=most)).map(|_| rng.random()).collect();
    decoded(&bytes, rng.random_range(5..=12))
}

/// The list with what it takes to be a program, where possible: operators without operands left out, operands left over joined.
fn repaired(nodes: &[Node]) -> Vec<Node> {
    let mut program = Vec::new();
    let mut waiting = 0;
    for node in nodes {
        match node {
            Node::Leaf { .. } if waiting < 32 => waiting += 1,
            Node::Complement if waiting > 0 => {}
            node if is_binary(node) && waiting > 1 => waiting -= 1,
            _ => continue,
        }
        program.push(*node);
    }
    program.extend((1..waiting).map(|_| Node::Union));
    program
}

/// Asks a program everything along a few rays; returns the number of hits.
fn interrogate(program: &Program<'_>, rng: &mut impl Rng) -> u32 {
    let mut hits = 0;
    let mut scratch = vec![Span::EMPTY; program.leaves()];
    for _ in 0..4 {
        let mut random = |most: f32| {
            vec3(
                rng.random_range(-most..most),
                rng.random_range(-most..most),
                rng.random_range(-most..most),
            )
        };
        let (origin, direction) = (random(4.0), random(1.0));
        assert!(!program.sdf(origin).is_nan());
        let ray = Ray::new(origin, direction).expect("small numbers make a ray");
        let sight = program.along(ray, &mut scratch).expect("one span per leaf is enough");
        let found = sight.march();
        assert!(found.sweeps as usize <= program.max_sweeps(), "{found:?}");
        assert!(!sight.gsdf().is_nan());
        if let Some(hit) = sight.cast() {
            hits += 1;
            assert!((hit.leaf as usize) < program.leaves());
            assert_eq!(hit.t, found.t);
        }
        let crossings = sight.crossings().count();
        assert!(crossings <= 2 * program.leaves(), "{crossings} crossings");
    }
    hits
}

#[test]
fn any_list_of_nodes_is_refused_for_its_first_mistake_or_works() {
    let (mut refused, mut hits) = ([0; 4], 0);
    for seed in 0..10_000 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let raw = random_nodes(&mut rng);
        let nodes = if seed % 2 == 0 { raw } else { repaired(&raw) };
        let made = Program::new(&nodes);
        let expected = verdict(&nodes);
        assert_eq!(
            made.as_ref().map(Program::leaves).map_err(|&error| error),
            expected,
            "seed {seed}: {nodes:?}"
        );
        match made {
            Ok(program) => hits += interrogate(&program, &mut rng),
            Err(ProgramError::Empty) => refused[0] += 1,
            Err(ProgramError::MissingOperand(_)) => refused[1] += 1,
            Err(ProgramError::Unjoined(_)) => refused[2] += 1,
            Err(ProgramError::TooDeep(_)) => refused[3] += 1,
            Err(error) => panic!("seed {seed}: {error}"),
        }
    }
    // Else these lists would not be a test of what they are to test.
    assert!(refused.iter().all(|&count| count > 20) && hits > 2_000, "{refused:?}, {hits}");
}

#[test]
fn arrays_are_judged_like_slices() {
    fn compare<const N: usize>(nodes: &[Node]) {
        if let Some(array) = nodes.first_chunk::<N>() {
            let made = Csg::new(*array);
            assert_eq!(made.map(|csg| csg.leaves()), verdict(array));
            let drafted = array.iter().fold(Draft::<N>::new(), |draft, node| draft.operator(*node)).finish();
            assert_eq!(drafted, made);
            if let Ok(csg) = made {
                assert!(csg.program().max_sweeps() <= Csg::<N>::MAX_SWEEPS);
            }
        }
    }
    for seed in 0..4_000 {
        let nodes = random_nodes(&mut Pcg64::seed_from_u64(seed));
        compare::<0>(&nodes);
        compare::<1>(&nodes);
        compare::<2>(&nodes);
        compare::<3>(&nodes);
        compare::<5>(&nodes);
        compare::<40>(&nodes);
    }
}

#[test]
fn posed_programs_answer_in_any_pose_and_not_without() {
    let rotation = glam::Mat3::from_axis_angle(vec3(0.6, 0.0, 0.8), 1.0);
    let poses = [
        Transform::IDENTITY,
        Transform::affine(rotation, vec3(1.0, 0.0, -1.0)).expect("a rotation"),
        Transform::affine(rotation * 2.0, Vec3::ZERO).expect("a rotation and a scaling"),
    ];
    let mut hits = 0;
    for seed in 0..2_000 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let mut nodes = repaired(&random_nodes(&mut rng));
        let mut last = 0;
        for node in &mut nodes {
            if let Node::Leaf { frame, .. } = node {
                *frame %= 6;
                last = last.max(*frame);
            }
        }
        let Ok(program) = Program::new(&nodes) else { continue };
        match program.posed(&poses) {
            Ok(posed) => {
                assert!(last <= 3);
                hits += interrogate(&posed, &mut rng);
            }
            Err(error) => {
                assert!(last > 3);
                assert_eq!(error, ProgramError::MissingPose(last, 3));
            }
        }
    }
    assert!(hits > 200, "{hits}");
}

/// So many balls, then as many operators as they need: all operands wait at once.
fn right_leaning(leaves: usize) -> Vec<Node> {
    let chain = (0..leaves - 1)
        .rev()
        .fold(Tree::Leaf(leaves - 1), |right, number| Tree::Leaf(number).or(right));
    chain.postfix(&vec![BALL; leaves])
}

#[test]
fn the_33rd_waiting_operand_is_refused_by_its_index() {
    assert!(Program::new(&right_leaning(32)).is_ok());
    for leaves in [33, 34, 100] {
        assert_eq!(
            Program::new(&right_leaning(leaves)).err(),
            Some(ProgramError::TooDeep(32)),
            "{leaves}"
        );
    }
    // The index counts nodes and not leaves.
    let mut nodes = right_leaning(33);
    nodes.insert(1, Node::Complement);
    nodes.insert(1, Node::Complement);
    assert_eq!(Program::new(&nodes).err(), Some(ProgramError::TooDeep(34)));
    // Leaning the other way any number will do.
    let left_leaning = (1..1_000).fold(Tree::Leaf(0), |left, number| left.or(Tree::Leaf(number)));
    assert!(Program::new(&left_leaning.postfix(&[BALL; 1_000])).is_ok());
}

#[test]
fn every_error_says_what_is_wrong_and_where() {
    let errors = [
        (ProgramError::Empty, "needs at least one leaf", ""),
        (ProgramError::MissingOperand(7), "follow their operands", "node 7"),
        (ProgramError::Unjoined(3), "join them", "3 left"),
        (ProgramError::TooDeep(41), "heavier operand", "node 41"),
        (ProgramError::TooManyLeaves, "split it", ""),
        (ProgramError::WrongSize(4, 5), "differs from the length", "4 nodes, room for 5"),
        (ProgramError::MissingPose(6, 2), "no pose", "frame 6 of 2"),
        (ProgramError::PosedTwice(9), "pose it once", "node 9"),
        (ProgramError::ScratchTooShort(1, 8), "shorter than", "1 spans, 8 leaves"),
    ];
    for (error, remedy, place) in errors {
        let text = error.to_string();
        assert!(text.contains(remedy) && text.contains(place), "{text}");
        assert!(text.starts_with(error.message()), "{text}");
    }
}

csg! { const PAIR = union(posed(3, Sphere::new(Vec3::ZERO, 1.0)), Sphere::new(Vec3::Y, 1.0)) }

#[test]
fn frames_without_a_pose_are_refused() {
    let poses = [Transform::IDENTITY; 4];
    for count in 0..3 {
        let refused = PAIR.program().posed(&poses[..count]);
        assert_eq!(refused.err(), Some(ProgramError::MissingPose(3, count)));
    }
    assert!(PAIR.program().posed(&poses[..3]).is_ok() && PAIR.program().posed(&poses).is_ok());
}

#[test]
fn every_leaf_stands_where_the_pose_of_its_own_frame_puts_it() {
    let moved = |steps: u16| vec3(f32::from(steps) * 4.0, f32::from(steps), 0.0);
    let poses = [1, 2, 3].map(|frame| Transform::translation(moved(frame)).expect("a translation"));
    for seed in 0..200 {
        let mut rng = Pcg64::seed_from_u64(seed);
        let frames: Vec<u16> = (0..8).map(|_| rng.random_range(0..4)).collect();
        let tree = Tree::random(&mut rng, frames.len());
        let mut posed = tree.postfix(&[BALL; 8]);
        let leaves = posed.iter_mut().filter_map(|node| match node {
            Node::Leaf { frame, .. } => Some(frame),
            _ => None,
        });
        leaves.zip(&frames).for_each(|(frame, own)| *frame = *own);
        // Whole numbers move without rounding: the same solids, placed by their own parameters, are the same bits.
        let placed: Vec<Leaf> = frames
            .iter()
            .map(|&own| Sphere::new(moved(own), 1.0).expect("a ball").into())
            .collect();
        let placed = tree.postfix(&placed);
        let posed = Program::new(&posed).and_then(|program| program.posed(&poses)).expect("a program");
        let placed = Program::new(&placed).expect("a program");
        let (mut scratch, mut other_scratch) = ([Span::EMPTY; 8], [Span::EMPTY; 8]);
        for row in 0..8_u8 {
            let place = vec3(-8.0, f32::from(row) * 0.5, 0.25);
            let ray = Ray::new(place, Vec3::X).expect("a ray");
            let seen: Vec<_> = posed.along(ray, &mut scratch).expect("room").crossings().collect();
            let expected: Vec<_> = placed.along(ray, &mut other_scratch).expect("room").crossings().collect();
            assert_eq!(seen, expected, "seed {seed}: {frames:?} and {tree:?}");
            assert_eq!(posed.sdf(place), placed.sdf(place), "seed {seed}: {frames:?} and {tree:?}");
        }
    }
}

#[test]
fn scratch_memory_must_hold_every_leaf() {
    let ray = Ray::new(vec3(0.0, 0.0, 5.0), Vec3::NEG_Z).expect("a ray");
    let mut scratch = [Span::EMPTY; 3];
    for length in 0..2 {
        let refused = PAIR.program().along(ray, &mut scratch[..length]);
        assert_eq!(refused.err(), Some(ProgramError::ScratchTooShort(length, 2)));
    }
    // More than is needed does no harm, whatever was in it before.
    scratch.fill(Span::between(f32::NEG_INFINITY, f32::INFINITY));
    assert_eq!(PAIR.program().along(ray, &mut scratch).map(|sight| sight.gsdf()), Ok(4.0));
}

#[test]
fn drafts_of_the_wrong_size_are_refused() {
    let pair = |draft: Draft<2>| draft.leaf(BALL).leaf(BALL).operator(Node::Union).finish();
    assert_eq!(pair(Draft::new()), Err(ProgramError::WrongSize(3, 2)));
    assert_eq!(Draft::<2>::new().leaf(BALL).finish(), Err(ProgramError::WrongSize(1, 2)));
    assert_eq!(Draft::<0, Leaf>::new().finish(), Err(ProgramError::Empty));
    assert_eq!(Draft::<2>::new().leaf(BALL).leaf(BALL).finish(), Err(ProgramError::Unjoined(2)));
    // Posing what did not fit must not write beyond the array.
    assert_eq!(
        Draft::<1>::new().leaf(BALL).leaf(BALL).posed(1).finish(),
        Err(ProgramError::WrongSize(2, 1))
    );
}

#[test]
fn a_draft_poses_its_last_operand_and_nothing_else() {
    let frames = |nodes: &[Node]| -> Vec<u16> {
        nodes
            .iter()
            .filter_map(|node| match node {
                Node::Leaf { frame, .. } => Some(*frame),
                _ => None,
            })
            .collect()
    };
    let draft = Draft::<6>::new()
        .leaf(BALL)
        .leaf(BALL)
        .leaf(BALL)
        .operator(Node::Complement)
        .operator(Node::Union);
    let posed = draft.posed(5).operator(Node::Difference).finish().expect("a program");
    assert_eq!(frames(posed.nodes()), [0, 5, 5]);
    // The whole, when it is the last operand.
    let whole = draft.operator(Node::Difference).posed(9).finish().expect("a program");
    assert_eq!(frames(whole.nodes()), [9, 9, 9]);
    // A leaf that has a frame keeps it, and the draft is refused at the last node of the operand posed in vain.
    let twice = draft.posed(5).operator(Node::Difference).posed(9).finish();
    assert_eq!(twice, Err(ProgramError::PosedTwice(5)));
    assert_eq!(
        Draft::<1>::new().leaf(BALL).posed(1).posed(1).finish(),
        Err(ProgramError::PosedTwice(0))
    );
}

/// Once posing nothing, or posing in the world, was silently no pose at all.
#[test]
fn poses_of_nothing_are_refused() {
    let ball: Leaf = Sphere::new(Vec3::ZERO, 1.0).expect("a ball").into();
    let nothing = Draft::<1>::new().posed(1).leaf(ball).finish();
    assert_eq!(nothing, Err(ProgramError::MissingOperand(0)));
    let world = Draft::<1>::new().leaf(ball).posed(0).finish();
    assert_eq!(world, Err(ProgramError::PosedInWorld(0)));
}
