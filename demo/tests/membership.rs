//! Random trees, printed as OpenSCAD prints them and read back, hold the same points as the trees themselves, evaluated
//! point by point in double precision by code that shares nothing with the reader.

use glam::Vec3;
use gsdf_demo::model::Model;
use gsdf_demo::model::evaluate::Reading;
use proptest::prelude::*;

type Point = [f64; 3];
type Matrix = [[f64; 4]; 3];

/// What is printed.
#[derive(Clone, Debug)]
enum Tree {
    Cube { size: Point, center: bool },
    Sphere { radius: f64 },
    Cylinder { height: f64, lower: f64, upper: f64, center: bool, sides: u32 },
    /// The box as a polyhedron.
    Polyhedron { size: Point },
    Moved(Matrix, Vec<Tree>),
    Joined(&'static str, Vec<Tree>),
    /// What counts for nothing, with the modifier that says so.
    LeftOut(char, Box<Tree>),
}

/// By how little a point may be on one side of a surface and count for it.
const MARGIN: f64 = 1e-3;

impl Tree {
    fn print(&self, text: &mut String) {
        match self {
            Self::Cube { size, center } => *text += &format!("cube(size = {size:?}, center = {center});\n"),
            Self::Sphere { radius } => *text += &format!("sphere($fn = 0, $fa = 12, $fs = 2, r = {radius:?});\n"),
            Self::Cylinder {
                height,
                lower,
                upper,
                center,
                sides,
            } => {
                *text += &format!(
                    "cylinder($fn = {sides}, $fa = 12, $fs = 2, h = {height:?}, r1 = {lower:?}, r2 = {upper:?}, center = {center});\n"
                );
            }
            Self::Polyhedron { size: [x, y, z] } => {
                *text += &format!(
                    "polyhedron(points = [[0, 0, 0], [{x}, 0, 0], [{x}, {y}, 0], [0, {y}, 0], [0, 0, {z}], [{x}, 0, {z}], [{x}, {y}, \
                     {z}], [0, {y}, {z}]], faces = [[0, 1, 2], [2, 3, 0], [4, 5, 1, 0], [7, 6, 5, 4], [5, 6, 2, 1], [6, 7, 3, 2], [7, 4, \
                     0, 3]], convexity = 1);\n"
                );
            }
            Self::Moved([x, y, z], trees) => {
                *text += &format!("multmatrix([{x:?}, {y:?}, {z:?}, [0, 0, 0, 1]]) {{\n");
                trees.iter().for_each(|tree| tree.print(text));
                *text += "}\n";
            }
            Self::Joined(name, trees) => {
                *text += &format!("{name}() {{\n");
                trees.iter().for_each(|tree| tree.print(text));
                *text += "}\n";
            }
            Self::LeftOut(modifier, tree) => {
                text.push(*modifier);
                tree.print(text);
            }
        }
    }

    /// Whether a point is inside; `None` where that is too near to tell.
    fn holds(&self, point: Point) -> Option<bool> {
        let [x, y, z] = point;
        match self {
            Self::Cube { size, center } => {
                let low = if *center { size.map(|side| -side / 2.0) } else { [0.0; 3] };
                side((0..3).map(|axis| (point[axis] - low[axis]).min(low[axis] + size[axis] - point[axis])))
            }
            Self::Polyhedron { size } => side((0..3).map(|axis| point[axis].min(size[axis] - point[axis]))),
            Self::Sphere { radius } => side([radius - (x * x + y * y + z * z).sqrt()]),
            Self::Cylinder {
                height,
                lower,
                upper,
                center,
                sides,
            } => {
                let up = if *center { z + height / 2.0 } else { z };
                let radius = lower + (upper - lower) * up / height;
                let distance = (x * x + y * y).sqrt();
                let inward = if *sides == 0 {
                    radius - distance
                } else {
                    // The nearest side's middle is at an odd multiple of half a sector.
                    let half = std::f64::consts::PI / f64::from(*sides);
                    let aside = y.atan2(x).rem_euclid(2.0 * half) - half;
                    radius * half.cos() - distance * aside.cos()
                };
                side([up, height - up, inward])
            }
            Self::Moved(matrix, trees) => {
                let point = undone(*matrix, point);
                any(trees.iter().filter_map(|tree| tree.counts()).map(|tree| tree.holds(point)))
            }
            Self::Joined(name, trees) => {
                let mut held = trees.iter().filter_map(|tree| tree.counts()).map(|tree| tree.holds(point));
                match *name {
                    "intersection" => {
                        let held: Vec<_> = held.collect();
                        // Nothing at all has no common part.
                        if held.is_empty() { Some(false) } else { not(any(held.into_iter().map(not))) }
                    }
                    "difference" => {
                        let first = held.next().unwrap_or(Some(false));
                        not(any([not(first), any(held)].into_iter()))
                    }
                    _ => any(held),
                }
            }
            Self::LeftOut(..) => Some(false),
        }
    }

    /// The tree, unless it is left out.
    fn counts(&self) -> Option<&Self> {
        (!matches!(self, Self::LeftOut(..))).then_some(self)
    }
}

/// Whether all of these, which are positive inside, are.
fn side(inward: impl IntoIterator<Item = f64>) -> Option<bool> {
    let least = inward.into_iter().fold(f64::INFINITY, f64::min);
    (least.abs() > MARGIN).then_some(least > 0.0)
}

fn not(held: Option<bool>) -> Option<bool> {
    held.map(|held| !held)
}

fn any(held: impl Iterator<Item = Option<bool>>) -> Option<bool> {
    let held: Vec<_> = held.collect();
    if held.contains(&Some(true)) {
        Some(true)
    } else if held.contains(&None) {
        None
    } else {
        Some(false)
    }
}

/// The point that a matrix takes to this one, by elimination.
fn undone(matrix: Matrix, point: Point) -> Point {
    let mut rows: Vec<[f64; 4]> = (0..3)
        .map(|row| [matrix[row][0], matrix[row][1], matrix[row][2], point[row] - matrix[row][3]])
        .collect();
    for column in 0..3 {
        let pivot = (column..3).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs())).expect("there is a row");
        rows.swap(column, pivot);
        for row in 0..3 {
            if row != column {
                let factor = rows[row][column] / rows[column][column];
                let from = rows[column];
                rows[row].iter_mut().zip(from).for_each(|(a, b)| *a -= factor * b);
            }
        }
    }
    std::array::from_fn(|row| rows[row][3] / rows[row][row])
}

/// A number of a drawing: most are round, so that faces coincide.
fn length() -> impl Strategy<Value = f64> {
    prop_oneof![3 => (1..9_u32).prop_map(|number| f64::from(number) * 0.5), 1 => 0.2..4.0]
}

fn solid() -> impl Strategy<Value = Tree> {
    let size = || [length(), length(), length()];
    prop_oneof![
        3 => (size(), any_bool()).prop_map(|(size, center)| Tree::Cube { size, center }),
        1 => size().prop_map(|size| Tree::Polyhedron { size }),
        2 => length().prop_map(|radius| Tree::Sphere { radius }),
        3 => (length(), length(), prop_oneof![Just(None), Just(Some(0.0)), length().prop_map(Some)], any_bool(), any_bool(), prop_oneof![2 => Just(0), 1 => 3..9_u32])
            .prop_map(|(height, radius, other, turned, center, sides)| {
                let (lower, upper) = (radius, other.unwrap_or(radius));
                let (lower, upper) = if turned { (upper, lower) } else { (lower, upper) };
                Tree::Cylinder { height, lower, upper, center, sides }
            }),
    ]
}

fn any_bool() -> impl Strategy<Value = bool> {
    any::<bool>()
}

fn matrix() -> impl Strategy<Value = Matrix> {
    let shift = || (-8..9_i32).prop_map(|number| f64::from(number) * 0.5);
    let part = prop_oneof![
        // A move.
        3 => Just([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        // A quarter turn, some of them mirrors.
        2 => (0..3_usize, any_bool()).prop_map(|(axis, mirror)| {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut rows = [[0.0; 3]; 3];
            rows[axis][axis] = 1.0;
            rows[a][b] = -1.0;
            rows[b][a] = if mirror { -1.0 } else { 1.0 };
            rows
        }),
        // A turn about an axis.
        2 => (0..3_usize, -180.0..180.0_f64).prop_map(|(axis, degrees)| {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            let (sine, cosine) = degrees.to_radians().sin_cos();
            let mut rows = [[0.0; 3]; 3];
            rows[axis][axis] = 1.0;
            rows[a] = std::array::from_fn(|column| if column == a { cosine } else if column == b { -sine } else { 0.0 });
            rows[b] = std::array::from_fn(|column| if column == a { sine } else if column == b { cosine } else { 0.0 });
            rows
        }),
        // Unequal stretches, and a shear.
        1 => [0.5..2.0_f64, 0.5..2.0, 0.5..2.0].prop_map(|[x, y, z]| [[x, 0.0, 0.0], [0.0, -y, 0.0], [0.0, 0.0, z]]),
        1 => (-0.7..0.7_f64).prop_map(|by| [[1.0, by, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
    ];
    (part, [shift(), shift(), shift()]).prop_map(|(rows, shifts)| {
        std::array::from_fn(|row| [rows[row][0], rows[row][1], rows[row][2], shifts[row]])
    })
}

fn tree() -> impl Strategy<Value = Tree> {
    solid().prop_recursive(5, 24, 4, |inner| {
        let trees = || prop::collection::vec(inner.clone(), 1..4);
        let name = prop_oneof![3 => Just("union"), 2 => Just("difference"), 1 => Just("intersection"), 1 => Just("group")];
        prop_oneof![
            4 => (matrix(), trees()).prop_map(|(matrix, trees)| Tree::Moved(matrix, trees)),
            4 => (name, trees()).prop_map(|(name, trees)| Tree::Joined(name, trees)),
            1 => (prop_oneof![Just('%'), Just('*')], inner.clone()).prop_map(|(modifier, tree)| Tree::LeftOut(modifier, Box::new(tree))),
        ]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn what_is_printed_and_read_holds_the_same_points(
        tree in tree(),
        points in prop::collection::vec([-7.0..7.0_f64, -7.0..7.0, -7.0..7.0], 40),
    ) {
        let mut text = String::new();
        tree.print(&mut text);
        let model = Model::read(&text, Reading::default()).map_err(|refusal| TestCaseError::fail(refusal.to_string()))?;
        for point in points {
            let expected = tree.counts().map_or(Some(false), |tree| tree.holds(point));
            let place = Vec3::from(point.map(|coordinate| coordinate as f32));
            let found = model.program().is_ok_and(|program| program.sdf(place) < 0.0);
            if let Some(expected) = expected {
                prop_assert_eq!(found, expected, "{:?} in\n{}", point, text);
            }
        }
    }
}
