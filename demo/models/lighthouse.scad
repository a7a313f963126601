// A lighthouse on its rock, with stairs that wind around it up to the gallery.

height = 64;            // of the tower, rock to gallery
foot = 11;              // radius at the bottom
head = 7;               // radius at the top
bands = 8;
steps = 72;
turns = 1.75;           // of the stairs
tread = 4.2;            // how far a step sticks out

$fa = 5;
$fs = 0.3;

white = [0.95, 0.94, 0.91];
red = [0.80, 0.16, 0.14];
rock = [0.42, 0.40, 0.38];
sea = [0.20, 0.46, 0.58];
iron = [0.22, 0.24, 0.28];
wood = [0.62, 0.43, 0.26];
lamp = [1.00, 0.86, 0.40];
pane = [0.72, 0.86, 0.92];

cut = 1;                // how far a hole passes through a face

function radius(z) = foot + (head - foot) * z / height;

module around(count) {
    for (number = [0 : count - 1]) rotate(360 / count * number) children();
}

module tower() {
    band = height / bands;
    difference() {
        for (number = [0 : bands - 1]) color(number % 2 == 0 ? white : red)
            translate([0, 0, band * number])
                cylinder(h = band, r1 = radius(band * number), r2 = radius(band * (number + 1)));
        color(iron) windows();
    }
}

// Niches with round heads, climbing with the stairs but on the other side of the tower.
module windows() {
    for (number = [1 : 4]) {
        z = height * (number - 0.2) / 4.4;
        rotate(angle(z) + 180) translate([radius(z) - 1.5, 0, z]) {
            translate([0, -1, 0]) cube([4, 2, 2.6]);
            translate([0, 0, 2.6]) rotate([0, 90, 0]) cylinder(h = 4, r = 1);
        }
    }
}

function angle(z) = -60 + 360 * turns * z / height;

module stairs() {
    rise = height / steps;
    for (step = [0 : steps - 1]) {
        z = rise * (step + 1);
        out = radius(z) + tread;
        rotate(angle(z)) {
            // Every step begins within the tower, as a real one does; deep enough to carry the next.
            color(wood) translate([head - 2, -1.2, z - 0.7]) cube([out - head + 2, 2.4, 0.7]);
            color(iron) translate([out - 0.4, 0, z]) cylinder(h = 3, r = 0.16);
            color(iron) translate([out - 0.4, 0, z + 3]) sphere(r = 0.36);
        }
    }
}

module railing(out, count) {
    around(count) translate([out, 0, 0]) cylinder(h = 3.2, r = 0.16);
    for (z = [1.6, 3.2]) translate([0, 0, z]) difference() {
        cylinder(h = 0.3, r = out + 0.2);
        translate([0, 0, -cut]) cylinder(h = 0.3 + 2 * cut, r = out - 0.2);
    }
}

module gallery() {
    color(white) translate([0, 0, -3]) cylinder(h = 3, r1 = head, r2 = 10.5);
    color(iron) cylinder(h = 0.8, r = 11.4);
    color(iron) translate([0, 0, 0.8]) railing(11, 32);
}

module lantern() {
    color(white) cylinder(h = 3, r = 5.6);
    color(lamp) translate([0, 0, 6.5]) scale([1, 1, 1.3]) sphere(r = 1.9);
    color(iron) translate([0, 0, 3]) cylinder(h = 1.6, r = 0.8);
    color(iron) around(12) translate([5, 0, 3]) cylinder(h = 7.2, r = 0.22);
    // Half the panes are open to the lamp.
    color(pane) around(6) translate([4.7, -1.3, 3]) cube([0.3, 2.6, 7]);
    color(iron) translate([0, 0, 6.4]) difference() {
        cylinder(h = 0.3, r = 5.2);
        translate([0, 0, -cut]) cylinder(h = 0.3 + 2 * cut, r = 4.6);
    }
    color(red) translate([0, 0, 10]) {
        cylinder(h = 0.8, r = 6.4);
        difference() {
            translate([0, 0, 0.8]) scale([1, 1, 0.75]) sphere(r = 5.8);
            translate([-7, -7, -14]) cube(14);
        }
    }
    color(iron) translate([0, 0, 14.8]) cylinder(h = 4, r1 = 0.5, r2 = 0.1);
    color(iron) translate([0, 0, 15.6]) sphere(r = 0.9);
}

// Boulders are ellipsoids, half under water.
boulders = [
    // x, y, z, turn, and the three radii
    [0, 0, -4, 0, 21, 19, 6.5], [13, 8, -5, 30, 10, 7, 6], [-14, 7, -5, -20, 11, 8, 7], [-8, -13, -5, 50, 10, 7, 5.5],
    [9, -14, -6, -40, 9, 7, 6], [21, -3, -6, 10, 6, 5, 4], [-23, -4, -6, 0, 5, 4, 3.6], [3, 19, -6, 15, 7, 5, 4.4]
];

module island() {
    color(rock) for (boulder = boulders)
        translate([boulder[0], boulder[1], boulder[2]]) rotate(boulder[3])
            scale([boulder[4], boulder[5], boulder[6]]) sphere(r = 1, $fa = 5, $fs = 0.05);
    color(rock) translate([0, 0, -4]) cylinder(h = 4, r1 = 16, r2 = 13.5);
    color(sea) translate([0, 0, -9]) cylinder(h = 3, r = 36);
}

module door() {
    rotate(-90) translate([foot - 1.2, 0, 0]) {
        translate([0, -1.8, 0]) cube([2, 3.6, 5]);
        translate([0, 0, 5]) rotate([0, 90, 0]) cylinder(h = 2, r = 1.8);
    }
}

island();
tower();
color(wood) door();
stairs();
translate([0, 0, height]) gallery();
translate([0, 0, height + 0.8]) lantern();
