// A machined angle bracket: a bearing seat in its wall, two ribs, and as many holes as will fit. Millimetres.

width = 96;
base = 72;              // depth of the foot
wall = 84;              // height of the wall
thick = 10;
corner = 12;            // radius of the free corners

bore = 17;              // radius of the bearing seat
boss = 26;
bolts = 8;              // around the seat

$fa = 5;
$fs = 0.5;

alloy = [0.45, 0.58, 0.72];
bright = [0.86, 0.88, 0.90]; // where a tool has been

cut = 1;                // how far a hole passes through both faces

// A plate in the xy plane, square at y = 0 and with round corners at the far end.
module plate(length) {
    translate([-width / 2, 0, 0]) cube([width, length - corner, thick]);
    translate([corner - width / 2, 0, 0]) cube([width - 2 * corner, length, thick]);
    for (side = [-1, 1])
        translate([side * (width / 2 - corner), length - corner, 0]) cylinder(h = thick, r = corner);
}

module hole(radius, depth = thick) {
    translate([0, 0, -cut]) cylinder(h = depth + 2 * cut, r = radius);
}

module counterbored(radius, head) {
    hole(radius);
    translate([0, 0, thick / 2]) cylinder(h = thick, r = head);
}

// Two round ends and what is between them.
module slot(length, radius) {
    for (end = [-1, 1]) translate([end * length / 2, 0, 0]) hole(radius);
    translate([-length / 2, -radius, -cut]) cube([length, 2 * radius, thick + 2 * cut]);
}

// A right triangle, the corner at the origin; thin in x. Convex, so that it is one solid and not a cut.
module rib(run, rise, thickness) {
    polyhedron(
        points = [
            [0, 0, 0], [0, run, 0], [0, 0, rise],
            [thickness, 0, 0], [thickness, run, 0], [thickness, 0, rise]
        ],
        faces = [[0, 1, 2], [5, 4, 3], [0, 3, 4, 1], [1, 4, 5, 2], [2, 5, 3, 0]]
    );
}

// The wall stands in the xz plane: what lies in xy is turned up about x, and its outer face comes to y = 0.
module upright() {
    translate([0, thick, 0]) rotate([90, 0, 0]) children();
}

module body() {
    plate(base);
    upright() {
        plate(wall);
        translate([0, wall / 2 + 8, -6]) cylinder(h = thick + 6, r = boss);
    }
    for (side = [-1, 1])
        translate([side * (width / 2 - 4) - 4, thick, thick]) rib(base - thick - 16, 44, 8);
}

module foot_holes() {
    for (side = [-1, 1]) {
        translate([side * (width / 2 - 20), base - 14, 0]) counterbored(3.5, 6.5);
        translate([side * 16, thick + 16, 0]) counterbored(3.5, 6.5);
    }
    translate([0, base - 14, 0]) slot(22, 4);
    // A field of small holes, every other row moved by half a step.
    for (row = [0 : 2], column = [-3 : 3])
        if (row % 2 == 0 || column < 3)
            translate([column * 7 + (row % 2) * 3.5, thick + 27 + row * 6, 0]) hole(1.8);
}

module wall_holes() {
    translate([0, wall / 2 + 8, -12]) {
        hole(bore - 4, thick + 24);
        translate([0, 0, 12 + thick - 8]) cylinder(h = 8 + cut, r = bore);      // the seat
        for (bolt = [0 : bolts - 1])
            rotate(360 / bolts * (bolt + 0.5)) translate([(bore + boss) / 2, 0, 0]) hole(2, thick + 24);
    }
    for (side = [-1, 1])
        translate([side * (width / 2 - corner), wall - corner, 0]) hole(4);
}

difference() {
    color(alloy) body();
    color(bright) foot_holes();
    color(bright) upright() wall_holes();
    // One cross bore through both ribs, for a pin.
    color(bright) translate([-width / 2 - cut, thick + 14, thick + 13]) rotate([0, 90, 0])
        cylinder(h = width + 2 * cut, r = 6);
}
