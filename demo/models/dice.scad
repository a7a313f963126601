// A pair of dice, rounded as real ones are: no hull and no minkowski, but the solids those would have made.

side = 16;
round_edge = 2.4;
pip = 1.7;
ace = 2.3;              // the single pip is larger
sink = 0.55;            // how far a pip's centre lies above the face, in radii

$fa = 6;
$fs = 0.3;

ivory = [0.96, 0.93, 0.84];
cherry = [0.72, 0.10, 0.14];
ink = [0.13, 0.12, 0.16];
gold = [0.98, 0.80, 0.36];

half = side / 2;
inner = half - round_edge;
step = side * 0.27;     // from the middle of a face to its outer pips

// Every point within round_edge of a smaller cube: three blocks, twelve edges, eight corners.
module rounded_cube() {
    for (size = [[half, inner, inner], [inner, half, inner], [inner, inner, half]])
        translate(-size) cube(2 * size);
    for (turn = [[0, 0, 0], [90, 0, 0], [0, 90, 0]], x = [-inner, inner], y = [-inner, inner])
        rotate(turn) translate([x, y, -inner]) cylinder(h = 2 * inner, r = round_edge);
    for (x = [-inner, inner], y = [-inner, inner], z = [-inner, inner])
        translate([x, y, z]) sphere(r = round_edge);
}

// Where the pips of each number lie, in steps.
places = [
    [[0, 0]],
    [[-1, -1], [1, 1]],
    [[-1, -1], [0, 0], [1, 1]],
    [[-1, -1], [-1, 1], [1, -1], [1, 1]],
    [[-1, -1], [-1, 1], [0, 0], [1, -1], [1, 1]],
    [[-1, -1], [-1, 0], [-1, 1], [1, -1], [1, 0], [1, 1]]
];

module pips(number) {
    radius = number == 1 ? ace : pip;
    for (place = places[number - 1])
        translate([step * place[0], step * place[1], half + sink * radius]) sphere(r = radius);
}

// Opposite faces add up to seven, and one, two, three run anticlockwise.
module all_pips() {
    pips(1);
    rotate([90, 0, 0]) pips(2);
    rotate([0, 90, 0]) pips(3);
    rotate([0, -90, 0]) pips(4);
    rotate([-90, 0, 0]) pips(5);
    rotate([180, 0, 0]) pips(6);
}

module die(body, spots) {
    difference() {
        color(body) rounded_cube();
        color(spots) all_pips();
    }
}

translate([0, 0, half]) rotate(24) die(ivory, ink);
// The other was rolled: three on top.
translate([21, -9, half]) rotate(-38) rotate([0, -90, 0]) die(cherry, gold);
