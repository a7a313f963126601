// A pipe tee with three welding-neck flanges, cut open by a quarter so that its bores show. Millimetres.

bore = 20;
pipe = 25;              // outer radius of the pipe
neck = 29;
flange = 50;
thick = 12;
bolts = 8;
circle = 40;            // radius of the bolt circle
arm = 78;               // from the middle to a flange's face

$fa = 4;
$fs = 0.5;

cast_iron = [0.36, 0.46, 0.42];
machined = [0.88, 0.87, 0.84];
brass = [0.87, 0.68, 0.30];

cut = 1;                // how far a hole passes through a face

// What sticks out along z.
module branch() {
    cylinder(h = arm, r = pipe);
    translate([0, 0, arm - thick - 14]) cylinder(h = 14, r1 = pipe, r2 = neck);
    translate([0, 0, arm - thick]) cylinder(h = thick - 2, r = flange);
    translate([0, 0, arm - 2]) cylinder(h = 2, r = circle - 9);     // the raised face, which seals
}

// What is taken away along z.
module passage() {
    cylinder(h = arm + cut, r = bore);
    translate([0, 0, arm - 4]) cylinder(h = 4 + cut, r1 = bore, r2 = bore + 4 + cut);
    for (bolt = [0 : bolts - 1]) rotate(360 / bolts * (bolt + 0.5))
        translate([circle, 0, arm - thick - cut]) cylinder(h = thick + 2 * cut, r = 4);
}

module three_ways() {
    children();
    rotate([0, 90, 0]) children();
    rotate([0, -90, 0]) children();
}

difference() {
    color(cast_iron) union() {
        three_ways() branch();
        sphere(r = pipe + 5);
    }
    color(machined) three_ways() passage();
    color(machined) sphere(r = bore + 2);
    // The quarter towards the viewer, so that bores and ball meet in sight.
    color(brass) translate([0, -2 * flange, 0]) cube([2 * arm, 2 * flange, 2 * arm]);
}
