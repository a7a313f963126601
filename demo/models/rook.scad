// A chess rook: a tower in courses of stone, with a crown of six merlons.

$fa = 4;
$fs = 0.3;

rosewood = [0.45, 0.20, 0.14];
felt = [0.16, 0.38, 0.26];

merlons = 6;
cut = 1;                // how far a hole passes through a face

module bead(radius, height) {
    scale([1, 1, height / radius]) sphere(r = radius);
}

module base() {
    cylinder(h = 2.5, r1 = 15, r2 = 16);
    translate([0, 0, 2.5]) cylinder(h = 2.5, r = 16);
    translate([0, 0, 5]) bead(15.6, 3.6);
    translate([0, 0, 9.6]) bead(13, 1.8);
}

// Slightly conical, with joints between the courses of stone: a thin ring cut out of the cone at every course.
module shaft(low, high, height, courses = 5) {
    difference() {
        cylinder(h = height, r1 = low, r2 = high);
        for (course = [1 : courses - 1]) {
            z = height * course / courses;
            radius = low + (high - low) * course / courses;
            translate([0, 0, z - 0.3]) difference() {
                cylinder(h = 0.6, r = low + cut);
                translate([0, 0, -cut]) cylinder(h = 0.6 + 2 * cut, r = radius - 0.5);
            }
        }
    }
}

module crown() {
    difference() {
        union() {
            cylinder(h = 4, r1 = 8.4, r2 = 12);
            translate([0, 0, 4]) cylinder(h = 10, r = 12);
        }
        translate([0, 0, 5]) cylinder(h = 10, r = 8.8);
        // Two opposite gaps are one cut through both.
        for (gap = [0 : merlons / 2 - 1]) rotate(180 / merlons * 2 * gap)
            translate([-12 - cut, -1.8, 9.5]) cube([24 + 2 * cut, 3.6, 6]);
    }
}

module rook() {
    color(felt) translate([0, 0, -0.8]) cylinder(h = 0.8, r = 14.6);
    color(rosewood) {
        base();
        translate([0, 0, 10]) shaft(11, 8.2, 24);
        translate([0, 0, 34]) bead(10.6, 1.5);
        translate([0, 0, 35]) crown();
    }
}

rook();
