// A tapered roller bearing, its outer ring cut away over a third. Every cone of such a bearing has the same apex: that is
// what lets the rollers roll without slipping, and what makes its surfaces three families of true cones.

rollers = 17;
apex = 120;             // height of the common apex over the bearing's foot
inner_slope = 19;       // degrees from the axis to the inner raceway
roller_slope = 3;       // half the angle of a roller
width = 26;
bore = 22;
outside = 54;

$fa = 3;
$fs = 0.3;

steel = [0.66, 0.69, 0.74];
chrome = [0.86, 0.88, 0.92];
bronze = [0.80, 0.52, 0.25];
section = [0.74, 0.20, 0.16];

cut = 1;                // how far a hole passes through a face

axis_slope = inner_slope + roller_slope;
outer_slope = inner_slope + 2 * roller_slope;

// The radius, at a height, of a cone that hangs from the apex.
function radius(slope, height) = (apex - height) * tan(slope);

// A cone from the apex down, cut at two heights.
module hanging(slope, low, high) {
    translate([0, 0, low]) cylinder(h = high - low, r1 = radius(slope, low), r2 = radius(slope, high));
}

// Along the line from the apex that lies axis_slope off the axis; distances are counted from the apex.
module roller(near, far) {
    translate([0, 0, apex]) rotate([0, 180 - axis_slope, 0]) translate([0, 0, near])
        cylinder(h = far - near, r1 = near * tan(roller_slope), r2 = far * tan(roller_slope));
}

near = (apex - width + 4) / cos(axis_slope);
far = (apex - 5) / cos(axis_slope);

module each_roller() {
    for (number = [0 : rollers - 1]) rotate(360 / rollers * number) children();
}

module inner_ring() {
    difference() {
        union() {
            hanging(inner_slope, 0, width);
            // Ribs that keep the rollers in.
            cylinder(h = 3, r = radius(inner_slope, 3) + 4);
            translate([0, 0, width - 2]) cylinder(h = 2, r = radius(inner_slope, width - 2) + 2);
        }
        translate([0, 0, -cut]) cylinder(h = width + 2 * cut, r = bore);
        translate([0, 0, width - 2]) cylinder(h = 2 + cut, r1 = bore, r2 = bore + 2 + cut);
    }
}

module outer_ring() {
    difference() {
        translate([0, 0, 3]) cylinder(h = width - 3, r = outside);
        hanging(outer_slope, 3 - cut, width + cut);
    }
}

// A thin cone between the rings, with a window for each roller.
module cage() {
    difference() {
        hanging(axis_slope + 1, 3.5, width - 1);
        hanging(axis_slope - 1, 3.5 - cut, width - 1 + cut);
        each_roller() roller(near, far);
    }
}

color(steel) inner_ring();
color(bronze) cage();
color(chrome) each_roller() roller(near, far);
difference() {
    color(steel) outer_ring();
    // Two quarters, turned against one another: together a third.
    color(section) union() {
        rotate(-150) translate([0, 0, -cut]) cube([2 * outside, 2 * outside, 2 * width]);
        rotate(-120) translate([0, 0, -cut]) cube([2 * outside, 2 * outside, 2 * width]);
    }
}
