//! Solids composed in a frame of their own and posed in the world, each beside its twin in exact arithmetic.

use crate::reference::{AffineMap, Crossing as ExactCrossing, Exact, ExactVec3, Expr};
use crate::sandwich::ROUNDOFF;
use crate::shape::{Shape, log_uniform, unit};
use glam::{DVec3, Mat3, Quat, Vec3};
use gsdf_nostd::{Crossing, Node, Program, Ray, Span, Start, Transform};
use rand::{Rng, RngExt};

/// The room for leaves in a query of a [`Posed`] solid.
pub const MOST_LEAVES: usize = 24;

/// The tags of operators in exact expressions begin here; below are the numbers of leaves.
const OPERATORS: u32 = 1 << 16;

/// A solid composed of leaves.
#[derive(Clone, Debug)]
pub enum Tree {
    /// A solid.
    Leaf(Shape),
    /// What is in either.
    Union(Box<Self>, Box<Self>),
    /// What is in both.
    Intersection(Box<Self>, Box<Self>),
    /// What is in the first and not in the second.
    Difference(Box<Self>, Box<Self>),
}

impl From<Shape> for Tree {
    fn from(shape: Shape) -> Self {
        Self::Leaf(shape)
    }
}

impl Tree {
    /// What is in either.
    #[must_use]
    pub fn or(self, other: impl Into<Self>) -> Self {
        Self::Union(Box::new(self), Box::new(other.into()))
    }

    /// What is in both.
    #[must_use]
    pub fn and(self, other: impl Into<Self>) -> Self {
        Self::Intersection(Box::new(self), Box::new(other.into()))
    }

    /// What is in this and not in the other.
    #[must_use]
    pub fn minus(self, other: impl Into<Self>) -> Self {
        Self::Difference(Box::new(self), Box::new(other.into()))
    }

    fn operands(&self) -> Option<[&Self; 2]> {
        match self {
            Self::Leaf(_) => None,
            Self::Union(a, b) | Self::Intersection(a, b) | Self::Difference(a, b) => Some([a, b]),
        }
    }

    /// The leaves, in the order of their numbers.
    #[must_use]
    pub fn shapes(&self) -> Vec<Shape> {
        match self {
            Self::Leaf(shape) => vec![*shape],
            _ => self.operands().into_iter().flatten().flat_map(Self::shapes).collect(),
        }
    }

    /// The library's program, all leaves in `frame`.
    ///
    /// # Panics
    /// Where the library refuses a shape, which generators do not make.
    #[must_use]
    pub fn nodes(&self, frame: u16) -> Vec<Node> {
        let mut nodes: Vec<Node> = self
            .operands()
            .into_iter()
            .flatten()
            .flat_map(|operand| operand.nodes(frame))
            .collect();
        nodes.push(match self {
            Self::Leaf(shape) => Node::Leaf {
                solid: shape.leaf().expect("generators make valid shapes"),
                frame,
            },
            Self::Union(..) => Node::Union,
            Self::Intersection(..) => Node::Intersection,
            Self::Difference(..) => Node::Difference,
        });
        nodes
    }

    /// The same solid in exact arithmetic, every leaf and every operator under a tag, for [`maker`](Self::maker).
    #[must_use]
    pub fn exact(&self) -> Expr {
        self.exact_from(&mut 0, &mut OPERATORS.clone())
    }

    fn exact_from(&self, leaf: &mut u32, operator: &mut u32) -> Expr {
        if let Self::Leaf(shape) = self {
            *leaf += 1;
            return shape.exact(0.0).tagged(*leaf - 1);
        }
        let own = *operator;
        *operator += 1;
        let mut operands = self
            .operands()
            .into_iter()
            .flatten()
            .map(|operand| operand.exact_from(leaf, operator));
        let (first, second) = operands.next().zip(operands.next()).expect("an operator has two operands");
        let joined = match self {
            Self::Union(..) => first.or(second),
            Self::Intersection(..) => first.and(second),
            _ => first.minus(second),
        };
        joined.tagged(own)
    }

    /// Which leaf makes a crossing at which the membership of all that is tagged `changed` changes: the one with the
    /// lowest number of those whose own change is passed on by every operator above them.
    #[must_use]
    pub fn maker(&self, changed: &[u32]) -> Option<u32> {
        self.maker_from(changed, &mut 0, &mut OPERATORS.clone())
    }

    fn maker_from(&self, changed: &[u32], leaf: &mut u32, operator: &mut u32) -> Option<u32> {
        let Some(operands) = self.operands() else {
            *leaf += 1;
            return Some(*leaf - 1).filter(|number| changed.contains(number));
        };
        let own = *operator;
        *operator += 1;
        let makers = operands.map(|operand| operand.maker_from(changed, leaf, operator));
        makers.into_iter().flatten().min().filter(|_| changed.contains(&own))
    }
}

/// A random motion: an eighth of them quarter turns, which rotate without rounding; the translation in tenths.
///
/// # Panics
/// Never: every motion is a transform.
pub fn random_motion(rng: &mut impl Rng) -> Transform {
    let mut tenths = || rng.random_range(-100..=100) as f32 * 0.1;
    let translation = Vec3::new(tenths(), tenths(), tenths());
    let rotation = if rng.random_range(0..8) == 0 {
        let turns = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];
        let first = rng.random_range(0..6);
        let second = turns[(first + 1 + rng.random_range(0..2)) % 3] * turns[first].element_sum();
        Mat3::from_cols(turns[first], second, turns[first].cross(second))
    } else {
        Mat3::from_quat(Quat::from_axis_angle(unit(rng).as_vec3().normalize(), rng.random_range(-3.2..3.2)))
    };
    Transform::affine(rotation, translation).expect("a motion has an inverse")
}

/// A random affine map: turned, stretched along three directions by up to `most` either way, turned again, moved.
///
/// # Panics
/// Never, as long as `most` is within the range of transforms.
pub fn random_affine(rng: &mut impl Rng, most: f64) -> Transform {
    let mut turn = || Mat3::from_quat(Quat::from_axis_angle(unit(rng).as_vec3().normalize(), rng.random_range(-3.2..3.2)));
    let (first, second) = (turn(), turn());
    let mut factor = || log_uniform(rng, 1.0 / most, most) as f32;
    let stretch = Mat3::from_diagonal(Vec3::new(factor(), factor(), factor()));
    let translation = (unit(rng) * rng.random_range(0.0..10.0)).as_vec3();
    Transform::affine(second * stretch * first, translation).expect("the factors are within the range of transforms")
}

/// A random affine map out of all the library takes: uniform scales of 2^-20 to 2^20, shears of up to a thousand, and
/// unequal scales; turned, and moved by no more than ten times what a length of one becomes.
///
/// # Panics
/// Never: the factors are within the range of transforms.
pub fn random_stretch(rng: &mut impl Rng) -> Transform {
    // Just within the limits, which rounding must not pass.
    const MOST: f64 = 1e6;
    let mut turn = || Mat3::from_quat(Quat::from_axis_angle(unit(rng).as_vec3().normalize(), rng.random_range(-3.2..3.2)));
    let (first, second) = (turn(), turn());
    let (matrix, size) = match rng.random_range(0..3) {
        0 => {
            let factor = if rng.random() {
                log_uniform(rng, 1.0 / MOST, MOST)
            } else {
                [MOST, 1.0 / MOST][rng.random_range(0..2)]
            };
            (first * factor as f32, factor)
        }
        1 => {
            // A shear by k stretches by about k at the most, and by its inverse at the least.
            let (shear, factor) = (log_uniform(rng, 1.0, 900.0), log_uniform(rng, 1e-3, 1e3));
            let sheared = Mat3::from_cols(Vec3::X, Vec3::new(shear as f32, 1.0, 0.0), Vec3::Z);
            (second * sheared * first * factor as f32, factor)
        }
        _ => {
            let least = log_uniform(rng, 1.0 / MOST, 1.0);
            let mut factor = || log_uniform(rng, least, least * MOST * 0.9) as f32;
            (second * Mat3::from_diagonal(Vec3::new(factor(), factor(), factor())) * first, least)
        }
    };
    let translation = (unit(rng) * rng.random_range(0.0..10.0) * size).as_vec3();
    Transform::affine(matrix, translation).expect("the factors are within the range of transforms")
}

/// A place where a posed solid's boundary is crossed, according to the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expected {
    /// The parameter, to the nearest `f64`.
    pub t: f64,
    /// The number of the leaf that makes the crossing.
    pub leaf: u32,
    /// Whether the ray enters there.
    pub entering: bool,
}

/// A solid in a frame, the frame's pose, and the same solid in exact arithmetic as the world sees it.
#[derive(Clone, Debug)]
pub struct Posed {
    tree: Tree,
    shapes: Vec<Shape>,
    nodes: Vec<Node>,
    pose: Transform,
    exact: Expr,
}

impl Posed {
    /// The solid in the pose.
    #[must_use]
    pub fn new(tree: Tree, pose: Transform) -> Self {
        let exact = in_world(tree.exact(), &pose);
        Self {
            shapes: tree.shapes(),
            nodes: tree.nodes(1),
            tree,
            pose,
            exact,
        }
    }

    /// The pose.
    #[must_use]
    pub fn pose(&self) -> &Transform {
        &self.pose
    }

    /// The leaves, in the order of their numbers.
    #[must_use]
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// The solid in exact arithmetic, in the world.
    #[must_use]
    pub fn exact(&self) -> &Expr {
        &self.exact
    }

    /// The library's program, posed.
    ///
    /// # Panics
    /// Never: a tree makes a program.
    #[must_use]
    pub fn program(&self) -> Program<'_> {
        let poses = core::slice::from_ref(&self.pose);
        let program = Program::new(&self.nodes).and_then(|program| program.posed(poses));
        program.expect("a tree makes a program, and its one frame has a pose")
    }

    /// What the library answers: whether the start is inside, and all crossings.
    ///
    /// # Panics
    /// Where there are more than [`MOST_LEAVES`] leaves.
    #[must_use]
    pub fn computed(&self, start: impl Start) -> (bool, Vec<Crossing<f32>>) {
        let mut scratch = [Span::EMPTY; MOST_LEAVES];
        let sight = self.program().along(start, &mut scratch).expect("there is room for every leaf");
        (sight.march::<f32>().inside, sight.crossings().collect())
    }

    /// What the reference answers to the same question.
    ///
    /// # Panics
    /// Where a crossing is made by no leaf: then [`Tree::maker`] is wrong.
    #[must_use]
    pub fn expected(&self, origin: &ExactVec3, direction: Vec3) -> (bool, Vec<Expected>) {
        let line = self.exact.along(origin.clone(), direction);
        let named = |crossing: &ExactCrossing| Expected {
            t: crossing.t.to_f64(),
            leaf: self.tree.maker(&crossing.leaves).expect("some leaf makes every crossing"),
            entering: crossing.entering,
        };
        let ahead = |crossing: &ExactCrossing| crossing.t.finite().is_some_and(|t| t.sign().is_gt());
        let crossings = line.crossings().iter().filter(|crossing| ahead(crossing)).map(named).collect();
        (line.inside_at(0.0), crossings)
    }

    /// The size of the numbers that meet where a ray crosses leaf number `leaf` at `t`: what rounding errors are
    /// relative to, a length in the world.
    ///
    /// The origin is taken into the frame first, which adds the pose's translation; an affine map shrinks the solid's
    /// own numbers at most by its stretch.
    #[must_use]
    pub fn scale_at(&self, ray: &Ray, leaf: u32, t: f64) -> f64 {
        let outside = ray.origin().as_dvec3().length() + self.pose.origin().as_dvec3().length();
        let extent = self.shapes.get(leaf as usize).map_or(0.0, Shape::extent);
        outside + t.abs() * ray.direction().as_dvec3().length() + extent * self.largest_factor()
    }

    /// By what the pose stretches lengths at the most, from above.
    #[must_use]
    pub fn largest_factor(&self) -> f64 {
        let inverse = Mat3::from_cols_array_2d(&self.pose.to_local().map(|row| row.to_array()))
            .as_dmat3()
            .inverse();
        let columns = inverse.to_cols_array();
        columns
            .iter()
            .map(|entry| entry * entry)
            .sum::<f64>()
            .sqrt()
            .min(gsdf_nostd::MAX_STRETCH.into())
    }

    /// Whether a computed crossing is as deep as that of the reference, or within `roundings` rounding errors of the
    /// leaf's surface, where that is met at so flat an angle that the depth is not better known; and in the same
    /// sense.
    fn is_same_place(&self, ray: &Ray, found: &Crossing<f32>, expected: &Expected, roundings: f64) -> bool {
        let t = f64::from(found.t);
        let within = roundings * ROUNDOFF * self.scale_at(ray, expected.leaf, t);
        let deep = (t - expected.t).abs() * ray.direction().as_dvec3().length() <= within;
        found.entering == expected.entering && (deep || self.is_near_leaf(ray, expected.leaf, t, roundings))
    }

    /// Whether the point of the ray at `t` is within `roundings` rounding errors of the surface of leaf number
    /// `leaf`.
    #[must_use]
    pub fn is_near_leaf(&self, ray: &Ray, leaf: u32, t: f64, roundings: f64) -> bool {
        let point = &ExactVec3::from(ray.origin()) + &ExactVec3::from(ray.direction()).times(&Exact::from(t));
        let shape = self.shapes[leaf as usize];
        // In the frame, what is a length in the world is shorter by the stretch.
        let offset = roundings * ROUNDOFF * self.scale_at(ray, leaf, t) / f64::from(self.pose.stretch());
        let local = map_of(&self.pose).apply(&point);
        shape.exact(offset).contains(local.clone()) && !shape.exact(-offset).contains(local)
    }

    /// Whether the computed answer is that of the reference: inside or not at the start; and number, depth, sense and
    /// leaf of all crossings.
    #[must_use]
    pub fn agrees(&self, ray: &Ray, computed: &(bool, Vec<Crossing<f32>>), roundings: f64) -> bool {
        let expected = self.expected(&ray.origin().into(), ray.direction());
        self.matches(ray, computed, &expected, roundings, |found, expected| found.leaf == expected.leaf)
    }

    fn matches(
        &self,
        ray: &Ray,
        (starts_inside, found): &(bool, Vec<Crossing<f32>>),
        (inside, expected): &(bool, Vec<Expected>),
        roundings: f64,
        is_same_leaf: impl Fn(&Crossing<f32>, &Expected) -> bool,
    ) -> bool {
        let is_same = |(found, expected): (&Crossing<f32>, &Expected)| {
            is_same_leaf(found, expected) && self.is_same_place(ray, found, expected, roundings)
        };
        starts_inside == inside && found.len() == expected.len() && found.iter().zip(expected).all(is_same)
    }

    /// Whether the computed answer is the right one for some ray that is parallel to this one and at most `roundings`
    /// rounding errors beside it.
    ///
    /// The surfaces are moved by nothing, so those that coincide go on doing so: this excuses what happens at an edge
    /// or a silhouette, and no skin on a shared face. Where several leaves meet at the edge, any that is near may be
    /// named.
    #[must_use]
    pub fn agrees_with_neighbour(&self, ray: &Ray, computed: &(bool, Vec<Crossing<f32>>), roundings: f64) -> bool {
        let farthest = computed.1.last().map_or(0.0, |crossing| f64::from(crossing.t));
        let scale = (0..self.shapes.len() as u32)
            .map(|leaf| self.scale_at(ray, leaf, farthest))
            .fold(0.0, f64::max);
        // The 26 neighbours of the middle of a cube of 27.
        let step = |number: i32| DVec3::new(f64::from(number % 3 - 1), f64::from(number / 3 % 3 - 1), f64::from(number / 9 - 1));
        let around: Vec<DVec3> = (0..27).filter(|&number| number != 13).map(step).collect();
        let is_near = |found: &Crossing<f32>, expected: &Expected| {
            found.leaf == expected.leaf || self.is_near_leaf(ray, found.leaf, f64::from(found.t), roundings)
        };
        [0.25, 1.0, 0.5, 0.125].iter().any(|share| {
            let size = share * roundings * ROUNDOFF * scale;
            around.iter().any(|step| {
                let displaced = &ExactVec3::from(ray.origin()) + &ExactVec3::from((step.normalize() * size).to_array());
                let expected = self.expected(&displaced, ray.direction());
                self.matches(ray, computed, &expected, roundings, is_near)
            })
        })
    }
}

/// The map of a pose from the world to its frame, as the library stores it, exactly.
#[must_use]
pub fn map_of(pose: &Transform) -> AffineMap {
    AffineMap::new(pose.to_local(), pose.origin())
}

/// A solid of a pose's frame as the world sees it.
#[must_use]
pub fn in_world(solid: Expr, pose: &Transform) -> Expr {
    solid.mapped(pose.to_local().map(|row| row.to_array()), pose.origin())
}
