// A hexagon-head bolt on its head, with a nut on the thread and a washer at its foot. Millimetres, sizes of an M12.

diameter = 12;
pitch = 1.75;
turns = 16;
shank = 12;             // without thread
across_flats = 18;
head = 7.5;
nut = 10.8;
nut_at = 33;            // height of the nut's lower face

// For meshes alone: where the curve itself is meant, $fn stays 0.
$fa = 6;
$fs = 0.4;

steel = [0.62, 0.65, 0.70];
brass = [0.85, 0.66, 0.30];

depth = pitch * 0.6134; // of an ISO thread, from the crest to the root
minor = diameter / 2 - depth;
thread = turns * pitch;
cut = 1;                // how far a hole passes through both faces

// The hexagon is a prism because it asks for six corners; everything else is round.
module hexagon(height) {
    rotate(30) cylinder(h = height, r = across_flats / 2 / cos(30), $fn = 6);
}

// What a lathe leaves of the corners: a cone of 30 degrees that ends at 95 % of the flats.
module turned(height) {
    end = 0.475 * across_flats;
    cylinder(h = height, r1 = end + height / tan(30), r2 = end);
}

// Rings instead of a helix, which has no closed form; at this scale the eye does not tell them apart.
module ring_thread() {
    flank = pitch * 3 / 8;
    crest = pitch / 8;
    cylinder(h = thread, r = minor);
    for (turn = [0 : turns - 1]) translate([0, 0, turn * pitch]) {
        cylinder(h = flank, r1 = minor, r2 = diameter / 2);
        translate([0, 0, flank]) cylinder(h = crest, r = diameter / 2);
        translate([0, 0, flank + crest]) cylinder(h = flank, r1 = diameter / 2, r2 = minor);
    }
}

module bolt() {
    intersection() {
        hexagon(head);
        translate([0, 0, head]) mirror([0, 0, 1]) turned(head);
    }
    translate([0, 0, head]) {
        cylinder(h = 0.6, r = 0.475 * across_flats);
        cylinder(h = 1.6, r1 = diameter / 2 + 1, r2 = diameter / 2); // stands for the fillet
        cylinder(h = shank, r = diameter / 2);
        // The end is chamfered so that a nut finds its way.
        translate([0, 0, shank]) intersection() {
            ring_thread();
            cylinder(h = thread, r1 = minor - 0.8 + thread, r2 = minor - 0.8);
        }
    }
}

module nut() {
    difference() {
        intersection() {
            hexagon(nut);
            turned(nut);
            translate([0, 0, nut]) mirror([0, 0, 1]) turned(nut);
        }
        translate([0, 0, -cut]) cylinder(h = nut + 2 * cut, r = diameter / 2);
        // Countersinks that lead the thread in, from both faces.
        translate([0, 0, -cut]) cylinder(h = 1 + cut, r1 = diameter / 2 + 1 + cut, r2 = diameter / 2);
        translate([0, 0, nut - 1]) cylinder(h = 1 + cut, r1 = diameter / 2, r2 = diameter / 2 + 1 + cut);
    }
}

module washer() {
    difference() {
        cylinder(h = 2.5, r = 12);
        translate([0, 0, -cut]) cylinder(h = 2.5 + 2 * cut, r = 6.5);
    }
}

color(steel) bolt();
color(brass) translate([0, 0, nut_at]) rotate(11) nut();
color(steel) translate([15, -17, 0]) washer();
