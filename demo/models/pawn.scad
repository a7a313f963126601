// A chess pawn, turned from ellipsoids, cones and a ball. The felt it stands on is green.

$fa = 4;
$fs = 0.3;

box = [0.93, 0.80, 0.58];
felt = [0.16, 0.38, 0.26];

// A bead that goes around: a flat ellipsoid, whose rim is what shows.
module bead(radius, height) {
    scale([1, 1, height / radius]) sphere(r = radius);
}

// The waist is a curve that no quadric about this axis has: short cones along a parabola, narrow end up.
module waist(low, high, height, steps = 10) {
    function at(step) = high + (low - high) * pow(1 - step / steps, 2);
    for (step = [0 : steps - 1]) translate([0, 0, height * step / steps])
        cylinder(h = height / steps, r1 = at(step), r2 = at(step + 1));
}

module base() {
    cylinder(h = 2.5, r1 = 13, r2 = 14);
    translate([0, 0, 2.5]) cylinder(h = 2, r = 14);
    translate([0, 0, 4.5]) bead(13.6, 3.2);
    translate([0, 0, 8.4]) bead(11, 1.6);
}

module pawn() {
    color(felt) translate([0, 0, -0.8]) cylinder(h = 0.8, r = 12.6);
    color(box) {
        base();
        translate([0, 0, 8.5]) waist(9.6, 4.2, 18);
        translate([0, 0, 26.5]) bead(7.6, 1.5);
        translate([0, 0, 28]) cylinder(h = 2, r1 = 5.6, r2 = 4.4);
        translate([0, 0, 35]) sphere(r = 7.2);
    }
}

pawn();
