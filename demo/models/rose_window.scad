// A rose window: tracery cut from one slab in two planes, and a pane in every opening that touches the stone all around.

petals = 12;
slab = 7;
pane = 1;
rebate = 1.8;           // how deep the wider, front opening goes
lip = 0.7;              // how much wider it is
wall = 120;             // side of the square wall
rose = 48;              // radius of the tracery

$fa = 4;
$fs = 0.3;

stone = [0.86, 0.80, 0.68];
shade = [0.74, 0.67, 0.55];
cobalt = [0.12, 0.26, 0.66];
crimson = [0.74, 0.10, 0.18];
amber = [0.96, 0.70, 0.18];
emerald = [0.10, 0.52, 0.36];
violet = [0.44, 0.20, 0.58];

cut = 1;                // how far a hole passes through a face

module around(count, offset = 0) {
    for (number = [0 : count - 1]) rotate(360 / count * (number + offset)) children();
}

// All openings are written once, for stone and glass: each takes its height and how much wider than drawn it is.

// A drop: a point at a distance, and the circle that its two tangents lead to.
module drop(height, wider, tip, centre, radius) {
    r = radius + wider;
    reach = centre - tip + 2 * wider;
    slant = asin(r / reach);
    tangent = sqrt(reach * reach - r * r);
    start = centre - reach;
    x = start + tangent * cos(slant);
    y = tangent * sin(slant);
    translate([centre, 0, 0]) cylinder(h = height, r = r);
    polyhedron(
        points = [[start, 0, 0], [x, -y, 0], [x, y, 0], [start, 0, height], [x, -y, height], [x, y, height]],
        faces = [[0, 1, 2], [5, 4, 3], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]
    );
}

// As many lobes as its name says, around one point.
module foils(height, wider, count, out, radius) {
    around(count) translate([out, 0, 0]) cylinder(h = height, r = radius + wider);
    cylinder(h = height, r = out);
}

module eye(height, wider) foils(height, wider, 6, 5.2, 2.9);
module petal(height, wider) drop(height, wider, 11.5, 28, 6.2);
module trefoil(height, wider) translate([38.5, 0, 0]) rotate(180) foils(height, wider, 3, 2.3, 2.5);
module quatrefoil(height, wider) translate([42, 0, 0]) foils(height, wider, 4, 1.9, 1.5);
module corner(height, wider) translate([rose + 23, 0, 0]) rotate(45) foils(height, wider, 4, 3.4, 3);

module openings(height, wider) {
    eye(height, wider);
    around(petals) petal(height, wider);
    around(petals, 0.5) trefoil(height, wider);
    around(petals) quatrefoil(height, wider);
    around(4, 0.5) corner(height, wider);
}

module tracery() {
    difference() {
        union() {
            color(stone) cylinder(h = slab, r = rose + 1);
            color(stone) difference() {
                translate([-wall / 2, -wall / 2, 0]) cube([wall, wall, slab + 4]);
                // The wall splays towards the window in two steps.
                translate([0, 0, slab]) cylinder(h = 4 + cut, r1 = rose, r2 = rose + 4 + cut);
                translate([0, 0, -cut]) cylinder(h = slab + 2 * cut, r = rose);
            }
        }
        color(shade) translate([0, 0, -cut]) openings(slab + 4 + 2 * cut, 0);
        color(stone) translate([0, 0, slab - rebate]) {
            eye(rebate + cut, lip);
            around(petals) petal(rebate + cut, lip);
            around(petals, 0.5) trefoil(rebate + cut, lip);
            around(petals) quatrefoil(rebate + cut, lip);
        }
    }
    // A raised ring between eye and petals, and a roll around the whole.
    color(stone) translate([0, 0, slab]) difference() {
        cylinder(h = 1, r1 = 11, r2 = 10.4);
        translate([0, 0, -cut]) cylinder(h = 1 + 2 * cut, r = 9.6);
    }
    color(shade) translate([0, 0, slab + 4]) difference() {
        cylinder(h = 1.6, r1 = rose + 8, r2 = rose + 7);
        translate([0, 0, -cut]) cylinder(h = 1.6 + 2 * cut, r = rose + 5);
    }
    // Cornice and sill.
    for (side = [-1, 1]) color(shade) translate([-wall / 2 - 2, side * (wall / 2 + 2) - 2, -1]) cube([wall + 4, 4, slab + 8]);
}

module glass() {
    color(amber) eye(pane, 0);
    around(petals / 2) color(cobalt) petal(pane, 0);
    around(petals / 2, 0.5) color(crimson) petal(pane, 0);
    around(petals, 0.5) color(emerald) trefoil(pane, 0);
    around(petals) color(amber) quatrefoil(pane, 0);
    around(4, 0.5) color(violet) corner(pane, 0);
}

rotate([90, 0, 0]) {
    tracery();
    translate([0, 0, slab / 2]) glass();
}
