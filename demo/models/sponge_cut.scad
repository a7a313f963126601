// The Menger sponge cut in half across its diagonal: the section is a hexagon full of six-pointed stars.

use <sponge.scad>

side = 27;              // that of the sponge

// One corner stands up, and the plane through the middle lies flat.
module standing() {
    rotate([0, -acos(1 / sqrt(3)), 0]) rotate(-45) children();
}

crimson = [0.62, 0.14, 0.16];

middle = side * sqrt(3) / 2;

intersection() {
    standing() sponge();
    // It has the colour of the section.
    color(crimson) translate([-side, -side, middle - 2 * side]) cube(2 * side);
}
