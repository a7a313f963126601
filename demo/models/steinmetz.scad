// Crossed cylinders. Three bars that cross share a Steinmetz solid, with twelve curved faces; it sits as a pearl where three
// crossing tubes have been opened by their own bores.

radius = 10;
wall = 1.6;
reach = 21;             // half the length of a tube

$fa = 3;
$fs = 0.3;

copper = [0.85, 0.48, 0.32];
inside = [0.98, 0.82, 0.62];
pearl = [0.30, 0.62, 0.70];

cut = 1;                // how far a bore passes through a face

module bar(radius, reach) {
    translate([0, 0, -reach]) cylinder(h = 2 * reach, r = radius);
}

module three_axes() {
    children();
    rotate([90, 0, 0]) children();
    rotate([0, 90, 0]) children();
}

module rings() {
    for (side = [-1, 1]) translate([0, 0, side * (reach - 1.5)]) bar(radius + 1.2, 1.5);
}

module tubes() {
    difference() {
        color(copper) union() {
            three_axes() bar(radius, reach);
            three_axes() rings();
        }
        color(inside) three_axes() bar(radius - wall, reach + cut);
        // Windows between the tubes, along the four diagonals of the cube.
        color(inside) for (turn = [45, 135, 225, 315]) rotate(turn) rotate([0, acos(1 / sqrt(3)), 0]) bar(4.5, 3 * reach);
    }
}

module tricylinder(radius) {
    intersection() {
        bar(radius, radius);
        rotate([90, 0, 0]) bar(radius, radius);
        rotate([0, 90, 0]) bar(radius, radius);
    }
}

tubes();
color(pearl) tricylinder(radius - wall - 2.2);
