//! What is read from texts: which leaves, where, and which texts are refused.

use glam::{Vec3, vec3};
use gsdf_demo::model::Model;
use gsdf_demo::model::evaluate::Reading;
use gsdf_demo::model::program::stack_depth;
use gsdf_demo::model::solids::Facets;
use gsdf_nostd::{Leaf, Node};
use std::time::{Duration, Instant};

fn model(text: &str) -> Model {
    read(text, Facets::Auto)
}

fn read(text: &str, facets: Facets) -> Model {
    let reading = Reading {
        facets,
        ..Reading::default()
    };
    Model::read(text, reading).unwrap_or_else(|refusal| panic!("{refusal} in {text}"))
}

fn leaves(model: &Model) -> Vec<(Leaf, u16)> {
    let leaf = |node: &Node| match node {
        Node::Leaf { solid, frame } => Some((*solid, *frame)),
        _ => None,
    };
    model.nodes().iter().filter_map(leaf).collect()
}

fn holds(model: &Model, point: Vec3) -> bool {
    model.program().is_ok_and(|program| program.sdf(point) < 0.0)
}

const MOVED: &str = "multmatrix([[1, 0, 0, 0.1], [0, 1, 0, 0.2], [0, 0, 1, 0.7], [0, 0, 0, 1]])";
/// As who computes it without care writes it.
const QUARTER: &str = "multmatrix([[1, 0, 0, 0], [0, 6.12323e-17, -1, 0], [0, 1, 6.12323e-17, 0], [0, 0, 0, 1]])";
const TURNED: &str = "multmatrix([[0.6, -0.8, 0, 0], [0.8, 0.6, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])";

#[test]
fn faces_that_coincide_share_a_literal() {
    // 0.1 + 0.2 is not 0.3 in double precision; nor is 0.7 + 0.1 the 0.8 of a reader.
    let text = format!("{MOVED} {{ cube([0.2, 1, 0.1]); }} multmatrix([[1, 0, 0, 0.3], [0, 1, 0, 0], [0, 0, 1, 0.8]]) cube(1);");
    let found = leaves(&model(&text));
    let [(Leaf::Cuboid(a), 0), (Leaf::Cuboid(b), 0)] = found[..] else {
        panic!("{found:?}")
    };
    assert_eq!((a.max().x, a.max().z), (b.min().x, b.min().z));
    // In a frame that is turned too, wherever it was moved to.
    let text = format!("{MOVED} {TURNED} cube([0.3, 1, 1]); {MOVED} {TURNED} multmatrix([[1,0,0,0.3],[0,1,0,0],[0,0,1,0]]) cube(1);");
    let found = leaves(&model(&text));
    let [(Leaf::Cuboid(a), 1), (Leaf::Cuboid(b), 1)] = found[..] else {
        panic!("{found:?}")
    };
    assert_eq!((a.max().x, a.min().y, a.min().z), (b.min().x, b.min().y, b.min().z));
}

#[test]
fn what_is_turned_by_quarters_stands_in_the_world() {
    let text = format!("{QUARTER} {{ cube([1, 2, 3]); cylinder(h = 2, r1 = 1, r2 = 1); cylinder(h = 2, r1 = 1, r2 = 0); }}");
    let found = leaves(&model(&text));
    let [(Leaf::Cuboid(cube), 0), (Leaf::CappedCylinder(cylinder), 0), (Leaf::Cone(cone), 0)] = found[..] else {
        panic!("{found:?}")
    };
    assert_eq!((cube.min(), cube.max()), (vec3(0.0, -3.0, 0.0), vec3(1.0, 0.0, 2.0)));
    assert_eq!((cylinder.bottom(), cylinder.top()), (vec3(0.0, -2.0, 0.0), Vec3::ZERO));
    assert_eq!((cone.base(), cone.apex()), (Vec3::ZERO, vec3(0.0, -2.0, 0.0)));
}

#[test]
fn stretched_circles_take_a_frame_and_keep_their_caps() {
    let text = "multmatrix([[2, 0, 0, 5], [0, 3, 0, 0], [0, 0, 4, 1], [0, 0, 0, 1]]) { cylinder(h = 0.3, r1 = 1, r2 = 1); sphere(1); }";
    let model = model(text);
    let found = leaves(&model);
    let [(Leaf::CappedCylinder(cylinder), 1), (Leaf::Sphere(ball), 2)] = found[..] else {
        panic!("{found:?}")
    };
    assert_eq!((cylinder.bottom().z, cylinder.top().z, cylinder.side().radius()), (1.0, 2.2, 2.0));
    assert_eq!((ball.radius(), ball.center().x), (2.0, 5.0));
    assert!(holds(&model, vec3(5.0, 2.9, 1.1)) && !holds(&model, vec3(7.1, 0.0, 1.1)) && holds(&model, vec3(5.0, 0.0, 4.9)));
}

#[test]
fn few_sides_are_meant_and_many_are_not() {
    let cylinder = |sides: u32| format!("cylinder($fn = {sides}, $fa = 12, $fs = 2, h = 1, r1 = 10, r2 = 10, center = false);");
    let kinds = |text: &str, facets| leaves(&read(text, facets)).len();
    for (sides, auto, always) in [(6, 5, 5), (5, 5, 5), (13, 1, 13), (60, 1, 61), (0, 1, 29)] {
        assert_eq!(kinds(&cylinder(sides), Facets::Auto), auto, "{sides}");
        assert_eq!(kinds(&cylinder(sides), Facets::Always), always, "{sides}");
        assert_eq!(kinds(&cylinder(sides), Facets::Never), 1, "{sides}");
    }
    // The corner of a hexagon is over the x axis.
    let hexagon = model(&cylinder(6));
    assert!(holds(&hexagon, vec3(9.9, 0.0, 0.5)) && !holds(&hexagon, vec3(0.0, 8.7, 0.5)) && holds(&hexagon, vec3(0.0, 8.6, 0.5)));
    // OpenSCAD's spheres have no poles.
    let ball = read("sphere($fn = 8, r = 10);", Facets::Always);
    assert!(holds(&ball, vec3(0.0, 0.0, 9.2)) && !holds(&ball, vec3(0.0, 0.0, 9.3)));
}

#[test]
fn modifiers_say_what_counts() {
    let x = |at: f32| vec3(at, 0.5, 0.5);
    let there = "multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0]])";
    let cases = [
        (format!("cube(1); {there} %cube(1);"), [true, false]),
        (format!("cube(1); {there} #cube(1);"), [true, true]),
        (format!("cube(1); *{there} cube(1);"), [true, false]),
        // A root is the model as it is by itself.
        (format!("{there} union() {{ cube([9, 0.1, 0.1]); !cube(1); }}"), [true, false]),
        // What is left out first leaves the next one to be cut from.
        ("difference() { %cube(9); cube(1); }".to_owned(), [true, false]),
        // What is empty is empty.
        ("difference() { group(); cube(1); }".to_owned(), [false, false]),
        ("intersection() { cube(0); cube(1); }".to_owned(), [false, false]),
        ("intersection() { *cube(0); cube(1); }".to_owned(), [true, false]),
        (
            "union() { cube([1, -1, 1]); cylinder(h = 1, r1 = 0, r2 = 0); render(convexity = 2) cube(1); }".to_owned(),
            [true, false],
        ),
        (
            format!("{there} multmatrix([[1,0,0,0],[0,0,0,0],[0,0,1,0]]) cube(1);"),
            [false, false],
        ),
    ];
    for (text, expected) in cases {
        let model = model(&text);
        assert_eq!([x(0.5), x(5.5)].map(|point| holds(&model, point)), expected, "{text}");
    }
}

#[test]
fn colours_are_those_of_the_outermost() {
    let text = "color([1, 0, 0, 0.5]) { cube(1);\n color([0, 1, 0]) sphere(9); }\ncolor([-1, -1, -1, 1]) cube(3);";
    let model = model(text);
    let told: Vec<_> = model.leaves().iter().map(|leaf| (leaf.colour, leaf.line)).collect();
    assert_eq!(told, [(Some(Vec3::X), 1), (Some(Vec3::X), 2), (None, 3)]);
}

#[test]
fn what_is_not_supported_is_named_or_left_out() {
    let text = "cube(1);\ndifference() {\n  hull() { cube(9); }\n  cube(5);\n}\nintersection() { sphere(9); text(\"x\"); }";
    let refusal = Model::read(text, Reading::default())
        .expect_err("hulls are not supported")
        .to_string();
    assert!(
        refusal.starts_with("line 3, column 3: found `hull`, which is not supported"),
        "{refusal}"
    );
    let reading = Reading {
        skip_unsupported: true,
        ..Reading::default()
    };
    let model = Model::read(text, reading).expect("the rest is a model");
    assert_eq!(model.skipped().iter().map(|skipped| skipped.line).collect::<Vec<_>>(), [3, 6]);
    assert!(!holds(&model, vec3(-3.0, 0.0, 0.0).with_x(9.5)) && holds(&model, vec3(8.0, 0.0, 0.0)));
}

#[test]
fn refusals_say_where_and_what_would_do() {
    for (text, told) in [
        (
            "cube(size = [1, 2]);",
            "line 1, column 6: found a vector of length 2: `size` is a number or three in brackets",
        ),
        (
            "\n cube(size = [nan, 1, 1]);",
            "line 2, column 7: found NaN: numbers must be finite",
        ),
        ("sphere(r = inf);", "line 1, column 8: found inf: numbers must be finite"),
        (
            "cylinder(h = 1, r = 3);",
            "line 1, column 17: found `r`: `cylinder` has `h`, `r1`, `r2`, `center`",
        ),
        ("cube(1, true, 3);", "line 1, column 15: found one more argument"),
        ("cube(center = 1);", "line 1, column 6: found 1: `center` is `true` or `false`"),
        ("blob();", "line 1, column 1: found `blob`, which is no module of a .csg file"),
        (
            "multmatrix([[1, 0], [0, 1]]) cube();",
            "line 1, column 12: found a vector of length 2: a matrix is",
        ),
        ("multmatrix() cube();", "line 1, column 1: found `multmatrix` without `m`"),
        ("color(\"red\") cube();", "line 1, column 7: found a text: a colour is"),
        ("cube(1e12);", "line 1, column 1: found `cube`, a solid out of range"),
        ("sphere(1e-8);", "line 1, column 1: found `sphere`, a solid out of range"),
        (
            "multmatrix([[1,1,0,0],[0,1e9,0,0],[0,0,1,0]]) sphere(1);",
            "found `sphere`, a matrix out of range",
        ),
        ("polyhedron(points = [[0,0,0]], faces = [[0,1,2]]);", "there are points from 0 to 0"),
        (
            "polyhedron(points = [[0,0,0],[1,0,0],[0,1,0]], faces = [[0,1,2]]);",
            "a polyhedron with a hole",
        ),
    ] {
        let refusal = Model::read(text, Reading::default()).expect_err("it is no model").to_string();
        assert!(refusal.contains(told), "{text}: {refusal}");
    }
}

/// Twice the text takes about twice the time, whichever way it grows.
#[test]
fn large_models_are_read_in_linear_time() {
    let wide = |count: usize| {
        let cubes: String = (0..count)
            .map(|number| {
                format!("multmatrix([[1,0,0,{number}],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {{\n cube(size = [0.5, 1, 1], center = true);\n}}\n")
            })
            .collect();
        format!("difference() {{ union() {{ {cubes} }} sphere(1); }}")
    };
    let deep = |levels: usize| {
        let open: String = (0..levels)
            .map(|level| {
                let operator = ["union", "difference", "intersection", "group"][level % 4];
                format!("{operator}() {{ multmatrix([[0,-1,0,0],[1,0,0,0],[0,0,1,0.001],[0,0,0,1]]) {{ cube(9, true);\n")
            })
            .collect();
        format!("{open} sphere(3);{}", "}}".repeat(levels))
    };
    let time = |text: &str, leaves: usize| {
        let begin = Instant::now();
        let model = model(text);
        let time = begin.elapsed();
        assert_eq!(model.leaves().len(), leaves);
        assert!(stack_depth(model.nodes()) <= 3);
        time
    };
    let texts = [(wide(12_500), 12_501), (wide(100_000), 100_001), (deep(10_000), 10_001)];
    let [few, many, deep] = texts.map(|(text, leaves)| time(&text, leaves));
    // Eight times as much in eight times the time, with room for a machine that is busy.
    assert!(many < 40 * few + Duration::from_millis(200), "{few:?}, {many:?}");
    assert!(deep < Duration::from_secs(5), "{deep:?}");
}

#[test]
fn hostile_texts_end_in_one_error() {
    let many = 1_000_000;
    let mut texts: Vec<String> = [
        "(",
        "[",
        "{",
        "union(){",
        "cube(1)",
        "color()",
        "9",
        "\u{1}\u{2}\u{fffd}",
        "/*",
        "\"\\",
    ]
    .map(|part| part.repeat(many / part.len()))
    .to_vec();
    texts.extend([
        format!("cube({});", "9".repeat(many)),
        format!("polyhedron(points = [{}], faces = [[0]]);", "[1e308, 1, 1],".repeat(10_000)),
        "multmatrix([[1e308,1,1,0],[1,1e308,1,0],[1,1,1e308,0]]) multmatrix([[1e308,1,1,0],[1,1e308,1,0],[1,1,1e308,0]]) cube(1);"
            .to_owned(),
        "cylinder($fn = 1e300, h = 1, r1 = 1, r2 = 1, center = 7);".to_owned(),
    ]);
    for text in texts {
        let refusal = Model::read(&text, Reading::default()).expect_err("it is no model").to_string();
        assert!(refusal.len() < 300 && !refusal.contains('\n'), "{refusal}");
    }
}
