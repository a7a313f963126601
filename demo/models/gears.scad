// A brass wheel and a steel pinion in mesh. A flank of an involute tooth is nearly an arc, so a tooth is what two
// cylinders share: closed forms all the way.

module_size = 3;        // pitch diameter over number of teeth
wheel_teeth = 30;
pinion_teeth = 14;
width = 12;

$fa = 3;
$fs = 0.3;

brass = [0.87, 0.68, 0.30];
steel = [0.58, 0.62, 0.68];
dark = [0.30, 0.32, 0.36];

addendum = module_size;
dedendum = 1.25 * module_size;
cut = 1;                // how far a hole passes through both faces

function pitch_radius(teeth) = module_size * teeth / 2;

// One tooth along x. The arcs pass the pitch circle where tooth and gap are equal, leaning in by the pressure angle.
module tooth(teeth) {
    pitch = pitch_radius(teeth);
    half_tooth = 90 / teeth;
    flank = 0.36 * pitch;               // radius of the arc that stands for the involute
    for_angle = 20;
    intersection_for (side = [-1, 1])
        translate(
            pitch * [cos(half_tooth), side * sin(half_tooth), 0]
            - flank * [sin(for_angle - half_tooth), side * cos(for_angle - half_tooth), 0]
        ) cylinder(h = width, r = flank);
}

module toothed(teeth) {
    pitch = pitch_radius(teeth);
    intersection() {
        cylinder(h = width, r = pitch + addendum);
        union() {
            cylinder(h = width, r = pitch - dedendum);
            for (number = [0 : teeth - 1]) rotate(360 / teeth * number) intersection() {
                tooth(teeth);
                // Only its outer end: two arcs meet again on the other side of the axis.
                translate([pitch - 2 * dedendum, -width, 0]) cube([4 * module_size, 2 * width, width]);
            }
        }
    }
}

module bored(radius, key) {
    translate([0, 0, -cut]) cylinder(h = width + 6 + 2 * cut, r = radius);
    translate([0, -key / 2, -cut]) cube([radius + key / 2, key, width + 6 + 2 * cut]);
}

module wheel() {
    pitch = pitch_radius(wheel_teeth);
    rim = pitch - dedendum - 6;
    hub = 13;
    difference() {
        union() {
            difference() {
                toothed(wheel_teeth);
                // The web is thinner than rim and hub, from both faces.
                for (z = [-cut, width - 3.5])
                    translate([0, 0, z]) difference() {
                        cylinder(h = 3.5 + cut, r = rim);
                        translate([0, 0, -cut]) cylinder(h = 4 + 3 * cut, r = hub);
                    }
            }
            cylinder(h = width + 3, r = hub);
        }
        // Six round windows leave six waisted spokes.
        for (number = [0 : 5]) rotate(60 * number + 30)
            translate([(rim + hub) / 2, 0, -cut]) cylinder(h = width + 2 * cut, r = 8.4);
        bored(7, 4);
    }
}

module pinion() {
    difference() {
        union() {
            toothed(pinion_teeth);
            cylinder(h = width + 6, r = 11);
        }
        bored(5, 3);
    }
}

distance = pitch_radius(wheel_teeth) + pitch_radius(pinion_teeth);

color(brass) wheel();
// A tooth of the wheel points along x: a gap of the pinion has to look back at it.
color(steel) translate([distance, 0, 0]) rotate(180 + 180 / pinion_teeth) pinion();
color(dark) translate([0, 0, -6]) cylinder(h = width + 14, r = 6.4);
color(dark) translate([distance, 0, -6]) cylinder(h = width + 16, r = 4.5);
