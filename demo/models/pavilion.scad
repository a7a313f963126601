// A pavilion of nine bays. A groin vault is a block less the barrels that cross in it, and a pointed barrel is what two
// cylinders share: five barrels hollow out all nine vaults. Over the middle bay stand a drum and a dome.

bays = 3;
bay = 20;
opening = 16;           // of an arch; the rest is pier
spring = 20;            // height at which arches begin
point = 4;              // how far the two centres of an arch lie apart from its middle
top = 34;               // upper face of the vaults

$fa = 4;
$fs = 0.3;

stone = [0.90, 0.85, 0.74];
vault = [0.80, 0.72, 0.60];
marble = [0.94, 0.93, 0.91];
dark = [0.42, 0.24, 0.22];
light = [0.93, 0.88, 0.80];
copper = [0.36, 0.62, 0.54];
gold = [0.96, 0.74, 0.26];

side = bays * bay + (bay - opening);    // of the block: piers stand outside the outermost arches too
arch = opening / 2 + point;             // radius of the arch's two circles
cut = 1;                                // how far a hole passes through a face

module pointed_barrel(length) {
    rotate([90, 0, 0]) translate([0, 0, -length / 2]) intersection_for (centre = [-point, point])
        translate([centre, 0, 0]) cylinder(h = length, r = arch);
}

// Children stand in every bay's middle along one axis.
module along(count) {
    for (number = [0 : count - 1]) translate([(number - (count - 1) / 2) * bay, 0, 0]) children();
}

module vaults() {
    difference() {
        color(stone) union() {
            translate([-side / 2, -side / 2, spring]) cube([side, side, top - spring]);
            translate([-side / 2 - 1, -side / 2 - 1, top - 2]) cube([side + 2, side + 2, 2]);
        }
        color(vault) translate([0, 0, spring]) {
            along(bays) pointed_barrel(side + 2 * cut);
            rotate(90) along(bays) pointed_barrel(side + 2 * cut);
        }
        // The middle one opens into the dome.
        color(vault) translate([0, 0, spring]) cylinder(h = top - spring + cut, r = 7.5);
        // Round windows in the spandrels.
        color(vault) for (turn = [0, 90]) rotate(turn) for (middle = [-bay / 2, bay / 2])
            translate([middle, side / 2 + cut, top - 5.5]) rotate([90, 0, 0]) cylinder(h = side + 2 * cut, r = 1.6);
    }
}

module column() {
    translate([-2, -2, 0]) cube([4, 4, 1]);
    translate([0, 0, 1.5]) scale([1, 1, 0.4]) sphere(r = 2);
    translate([0, 0, 1.6]) cylinder(h = spring - 5, r1 = 1.5, r2 = 1.25);
    translate([0, 0, spring - 3.8]) scale([1, 1, 0.3]) sphere(r = 1.6);
    translate([0, 0, spring - 3.6]) cylinder(h = 2.6, r1 = 1.2, r2 = 2.1);
    translate([-2, -2, spring - 1]) cube([4, 4, 1]);
}

module balustrade() {
    for (turn = [0 : 3]) rotate(90 * turn) translate([0, side / 2 - 1, top]) {
        for (number = [-15 : 15]) translate([number * 2, 0, 0]) cylinder(h = 2.4, r1 = 0.5, r2 = 0.35);
        translate([-side / 2, -0.6, 2.4]) cube([side, 1.2, 0.7]);
        translate([side / 2 - 1, 0, 0]) {
            translate([-1, -1, 0]) cube([2, 2, 3.6]);
            translate([0, 0, 4.6]) sphere(r = 1.2);
        }
    }
}

module dome() {
    color(stone) translate([0, 0, top]) difference() {
        union() {
            cylinder(h = 9, r = 10);
            cylinder(h = 1.2, r1 = 11.4, r2 = 10.6);
            translate([0, 0, 7.8]) cylinder(h = 1.2, r1 = 10, r2 = 11);
        }
        translate([0, 0, -cut]) cylinder(h = 10 + cut, r = 8.4);
        // Six cuts through the whole drum make twelve windows with round heads.
        for (number = [0 : 5]) rotate(30 * number + 15) {
            translate([-11, -1.1, 2]) cube([22, 2.2, 3]);
            translate([-11, 0, 5]) rotate([0, 90, 0]) cylinder(h = 22, r = 1.1);
        }
    }
    translate([0, 0, top + 9]) {
        difference() {
            color(copper) union() {
                sphere(r = 10);
                // Ribs: discs on edge, a little larger than the dome.
                for (number = [0 : 7]) rotate(22.5 * number) rotate([90, 0, 0]) translate([0, 0, -0.3])
                    cylinder(h = 0.6, r = 10.3);
            }
            color(vault) sphere(r = 8.8);
            color(vault) translate([-11, -11, -22]) cube(22);
            color(vault) cylinder(h = 12, r = 1.8);
        }
        color(stone) translate([0, 0, 9.4]) for (number = [0 : 5])
            rotate(60 * number) translate([2, 0, 0]) cylinder(h = 3.4, r = 0.35);
        color(stone) translate([0, 0, 9.2]) difference() {
            cylinder(h = 1, r = 2.9);
            translate([0, 0, -cut]) cylinder(h = 1 + 2 * cut, r = 1.5);
        }
        color(copper) translate([0, 0, 12.8]) cylinder(h = 3, r1 = 2.8, r2 = 0.3);
        color(gold) translate([0, 0, 16.2]) sphere(r = 0.9);
    }
}

// Tiles fill the space between the steps and meet edge to edge.
module ground() {
    for (step = [1 : 3]) color(marble) translate([-side / 2 - 2 * step, -side / 2 - 2 * step, -step])
        cube([side + 4 * step, side + 4 * step, 1]);
    tiles = side / 4;
    for (x = [0 : tiles - 1], y = [0 : tiles - 1]) if ((x + y) % 2 == 0)
        color(dark) translate([4 * x - side / 2, 4 * y - side / 2, 0]) cube([4, 4, 0.1]);
        else color(light) translate([4 * x - side / 2, 4 * y - side / 2, 0]) cube([4, 4, 0.1]);
}

module fountain() {
    color(marble) difference() {
        cylinder(h = 2.6, r1 = 5, r2 = 5.4);
        translate([0, 0, 1]) cylinder(h = 2, r = 4.6);
    }
    color(copper) translate([0, 0, 1]) cylinder(h = 1, r = 4.6);
    color(marble) cylinder(h = 6, r1 = 1.2, r2 = 0.6);
    color(gold) translate([0, 0, 7.4]) sphere(r = 1.8);
}

vaults();
color(stone) for (x = [0 : bays], y = [0 : bays])
    translate([(x - bays / 2) * bay, (y - bays / 2) * bay, 0]) column();
color(stone) balustrade();
dome();
ground();
fountain();
