//! Programs from raw bytes, held to a merge of their leaves' spans by brute force.

use super::Tally;
use super::raw::Raw;
use super::solids::shape;
use crate::trees::{Number, Tree};
use gsdf_nostd::{Departure, Leaf, Line, Node, Program, Ray, Solid, Span, Transform, V3};

/// The most nodes that are read.
const NODES: usize = 48;

/// The most rays that are cast at one program.
const RAYS: usize = 6;

/// Nodes from raw bytes.
///
/// One in four lists is left as it is read, whatever that is. In the others operators without operands are left out
/// and operands left over are joined.
fn nodes(raw: &mut Raw<'_>, tally: &mut Tally) -> Vec<Node> {
    let mend = raw.below(4) != 0;
    let mut nodes: Vec<Node> = Vec::new();
    let mut operands = 0;
    while nodes.len() < NODES && !raw.is_empty() {
        let node = match raw.below(16) {
            0..6 => leaf(raw, tally),
            6 | 7 => {
                // A solid once more: its surfaces coincide.
                let earlier = usize::from(raw.byte()) % nodes.len().max(1);
                let again = nodes.get(earlier).copied();
                again.filter(|node| matches!(node, Node::Leaf { .. }))
            }
            8..11 => Some(Node::Union),
            11 => Some(Node::Intersection),
            12 => Some(Node::Difference),
            13 => Some(Node::Complement),
            _ => break,
        };
        let Some(node) = node else { continue };
        let (takes, gives) = arity(&node);
        if mend && operands < takes {
            continue;
        }
        operands = operands.saturating_sub(takes) + gives;
        nodes.push(node);
    }
    if mend {
        nodes.extend((1..operands).map(|_| [Node::Union, Node::Intersection, Node::Difference][usize::from(raw.below(3))]));
    }
    nodes
}

/// How many operands a node takes, and how many it gives.
fn arity(node: &Node) -> (usize, usize) {
    match node {
        Node::Leaf { .. } => (0, 1),
        Node::Complement => (1, 1),
        Node::Union | Node::Intersection | Node::Difference => (2, 1),
    }
}

fn leaf(raw: &mut Raw<'_>, tally: &mut Tally) -> Option<Node> {
    let solid = tally.accept_named(shape(raw).leaf())?;
    // The fourth has no pose.
    let frame = if raw.below(2) == 0 { 0 } else { u16::from(raw.below(16) / 5) };
    Some(Node::Leaf { solid, frame })
}

/// The expression that ends before node number `end`, and where it begins.
///
/// Read from its end a list of nodes is a program in prefix order: a grammar, and not a count as the library keeps.
fn expression(nodes: &[Node], end: usize) -> Option<(Tree, usize)> {
    let before = end.checked_sub(1)?;
    let joined = |join: fn(Tree, Tree) -> Tree| {
        let (second, middle) = expression(nodes, before)?;
        let (first, begin) = expression(nodes, middle)?;
        Some((join(first, second), begin))
    };
    match nodes[before] {
        Node::Leaf { .. } => {
            let number = nodes[..before].iter().filter(|node| matches!(node, Node::Leaf { .. })).count();
            Some((Tree::Leaf(number), before))
        }
        Node::Complement => expression(nodes, before).map(|(tree, begin)| (tree.inverted(), begin)),
        Node::Union => joined(Tree::or),
        Node::Intersection => joined(Tree::and),
        Node::Difference => joined(Tree::without),
    }
}

/// The solids with the poses of their frames.
fn leaves<'a>(nodes: &'a [Node], poses: &'a [Transform]) -> impl Iterator<Item = (&'a Leaf, Option<&'a Transform>)> {
    nodes.iter().filter_map(|node| match node {
        Node::Leaf { solid, frame: 0 } => Some((solid, None)),
        Node::Leaf { solid, frame } => Some((solid, poses.get(usize::from(*frame) - 1))),
        _ => None,
    })
}

/// A program is what can be read as one expression with at most 32 operands at a time, and whose frames have poses; its
/// answers are those of the definition.
#[must_use]
pub fn programs(bytes: &[u8]) -> Tally {
    let (mut raw, mut tally) = (Raw::new(bytes), Tally::default());
    let poses: Vec<Transform> = (0..raw.below(4))
        .filter_map(|_| {
            let (matrix, translation) = raw.affine();
            tally.accept_named(Transform::affine(matrix, translation))
        })
        .collect();
    let nodes = nodes(&mut raw, &mut tally);
    let tree = expression(&nodes, nodes.len())
        .filter(|(tree, begin)| *begin == 0 && tree.depth() <= 32)
        .map(|(tree, _)| tree);
    let framed = nodes
        .iter()
        .all(|node| !matches!(node, Node::Leaf { frame, .. } if usize::from(*frame) > poses.len()));
    let made = Program::new(&nodes);
    assert_eq!(made.is_ok(), tree.is_some(), "{made:?} of {nodes:?}");
    let posed = made.and_then(|program| program.posed(&poses));
    assert_eq!(
        posed.is_ok(),
        tree.is_some() && framed,
        "{posed:?} of {nodes:?} with {} poses",
        poses.len()
    );
    let (Some(program), Some(tree)) = (tally.accept(posed), tree) else {
        return tally;
    };
    for number in 0..RAYS {
        if raw.is_empty() && number > 0 {
            break;
        }
        let (origin, direction, range) = (raw.vector(), raw.vector(), raw.range());
        check_point(&program, &tree, &poses, origin);
        if let Some(ray) = tally.accept(Ray::new(origin, direction).and_then(|ray| ray.within(range))) {
            check_ray::<f32>(&program, &tree, &poses, ray, &mut tally);
            check_ray::<f64>(&program, &tree, &poses, ray, &mut tally);
            check_departure(&program, ray, raw.vector(), &mut tally);
        }
    }
    tally
}

/// The standard distance: one of the leaves', and of the sign that set membership has.
fn check_point(program: &Program<'_>, tree: &Tree, poses: &[Transform], p: glam::Vec3) {
    let found = program.sdf(p);
    let in_range = p.abs().cmple(glam::Vec3::splat(gsdf_nostd::MAX_LENGTH)).all();
    assert_eq!(found.is_nan(), !in_range, "{found} at {p} of {:?}", program.nodes());
    assert_eq!(program.contains(p), found < 0.0);
    if !in_range {
        return;
    }
    let distances: Vec<f32> = leaves(program.nodes(), poses)
        .map(|(solid, pose)| match pose {
            Some(pose) => solid.distance(pose.point_to_local(V3::<f32>::from(p))) * pose.stretch(),
            None => solid.distance(V3::<f32>::from(p)),
        })
        .collect();
    assert!(
        distances.iter().any(|distance| distance.abs().to_bits() == found.abs().to_bits()),
        "{found} at {p} is none of {distances:?}: {:?}",
        program.nodes()
    );
    // On a surface the complement's distance is zero too.
    if distances.iter().all(|&distance| distance != 0.0) {
        let (nothing, everything) = (Span::EMPTY, Span::between(f32::NEG_INFINITY, f32::INFINITY));
        let inside: Vec<_> = distances
            .iter()
            .map(|&distance| if distance < 0.0 { everything } else { nothing })
            .collect();
        assert_eq!(
            found < 0.0,
            tree.contains(&inside, 0.0),
            "{found} at {p} from {distances:?}: {:?}",
            program.nodes()
        );
    }
}

/// Everything a ray can be asked, against the leaves' spans and set membership between their ends.
fn check_ray<T: Number>(program: &Program<'_>, tree: &Tree, poses: &[Transform], ray: Ray, tally: &mut Tally) {
    let line: Line<T> = ray.line(T::from(0.0));
    let spans: Vec<Span<T>> = leaves(program.nodes(), poses)
        .map(|(solid, pose)| match pose {
            Some(pose) => {
                let local = pose.line_to_local(&line);
                local.span_in_world(solid.span_along(&local.line))
            }
            None => solid.span_along(&line),
        })
        .collect();
    let (infinity, nodes) = (T::from(f32::INFINITY), program.nodes());
    for span in &spans {
        let empty = span.enter == infinity && span.exit == -infinity;
        assert!(empty || span.enter < span.exit, "{span:?} along {ray:?}: {nodes:?}");
    }
    // What is nearer than the least normal number is past, of the ray's parameter as of the line's.
    let least = T::from(f32::MIN_POSITIVE);
    let start = ray.parameter_on_line(T::from(ray.range().start.max(f32::MIN_POSITIVE))).max(least);
    let end = T::from(ray.range().end);
    let ahead: Vec<_> = tree.crossings(&spans).into_iter().filter(|crossing| crossing.t > start).collect();
    let within: Vec<_> = ahead.iter().take_while(|crossing| ray.parameter_of(crossing.t) < end).collect();

    let mut scratch = vec![Span::empty_like(start); program.leaves()];
    let found: Vec<_> = match program.along(ray, &mut scratch) {
        Ok(sight) => sight.crossings().collect(),
        Err(error) => panic!("{error}"),
    };
    assert_eq!(found.len(), within.len(), "{found:?}, not {within:?} along {ray:?}: {nodes:?}");
    for (found, truth) in found.iter().zip(&within) {
        let place = ray.parameter_of(truth.t);
        assert!(
            found.t.bits() == place.bits() && found.leaf as usize == truth.culprits[0] && found.entering == truth.entering,
            "{found:?}, not {truth:?} along {ray:?}: {nodes:?}"
        );
    }

    let sight = program.along(ray, &mut scratch).unwrap_or_else(|error| panic!("{error}"));
    let march = sight.march();
    let inside = tree.contains(&spans, start);
    let first = ahead.first().map_or(infinity, |crossing| ray.parameter_of(crossing.t));
    let signed = if inside { -first } else { first };
    assert!(
        march.inside == inside && march.t.bits() == first.bits() && march.sweeps as usize <= program.max_sweeps(),
        "{march:?} along {ray:?}, inside: {inside}, first {first:?}: {nodes:?}"
    );
    assert_eq!(sight.gsdf().bits(), signed.bits(), "along {ray:?}: {nodes:?}");

    let hit = sight.cast();
    let expected = within.first().filter(|crossing| ray.parameter_of(crossing.t).to_f32().is_finite());
    assert_eq!(
        hit.map(|hit| (hit.t.to_bits(), hit.leaf as usize, hit.entering)),
        expected.map(|crossing| (
            ray.parameter_of(crossing.t).to_f32().to_bits(),
            crossing.culprits[0],
            crossing.entering
        )),
        "along {ray:?}: {nodes:?}"
    );
    if let Some(hit) = hit {
        // A range from there on is another one.
        assert!(hit.t >= f32::MIN_POSITIVE, "{hit:?} along {ray:?}: {nodes:?}");
        assert!((hit.normal.length() - 1.0).abs() < 1e-5, "{hit:?} along {ray:?}: {nodes:?}");
        assert!(!hit.point.is_nan(), "{hit:?} along {ray:?}: {nodes:?}");
    }
    tally.answered += 1;
    tally.met += u64::from(hit.is_some());
    tally.inside += u64::from(inside);
}

/// Away from the hit, if there is one: refused, or ahead, and never a number that is none.
fn check_departure(program: &Program<'_>, ray: Ray, direction: glam::Vec3, tally: &mut Tally) {
    let mut scratch = vec![Span::EMPTY; program.leaves()];
    let cast = |sight: Result<gsdf_nostd::Sight<'_, Leaf, &mut [Span<f32>]>, _>| sight.ok().and_then(|sight| sight.cast());
    let Some(hit) = cast(program.along(ray, &mut scratch)) else {
        return;
    };
    let Some(departure) = tally.accept(Departure::new(&hit, direction)) else {
        return;
    };
    let sight = program.along(departure, &mut scratch).unwrap_or_else(|error| panic!("{error}"));
    let (signed, next) = (sight.gsdf::<f32>(), sight.cast());
    let nodes = program.nodes();
    assert!(!signed.is_nan(), "from {hit:?} along {direction}: {nodes:?}");
    if let Some(next) = next {
        assert!(
            next.t == signed.abs() && next.entering == (signed > 0.0) && next.t > 0.0,
            "{next:?}, but {signed} from {hit:?} along {direction}: {nodes:?}"
        );
        assert!(
            (next.normal.length() - 1.0).abs() < 1e-5,
            "{next:?} from {hit:?} along {direction}: {nodes:?}"
        );
    }
    let crossings = sight.crossings::<f32>().count();
    assert!(crossings <= 2 * program.leaves(), "{crossings} crossings of {nodes:?}");
}
