// The Menger sponge of level 3: one cube less the square holes of every level, 219 of them, instead of the 8000 cubes
// that are left. The holes end in the very faces of the cube, and small ones in the faces of large ones.

level = 3;
side = 27;              // 3 ^ level, so that every face lies at a whole number

sand = [0.88, 0.70, 0.42];

// The squares missing from a side, as [x, y, size]: the middle one of nine fields, and in each of the eight others the same
// again. A list, so that the .csg has no nesting but what it needs.
function squares(x, y, size, depth) = depth == 0 ? [] : let (third = size / 3) [
    [x + third, y + third, third],
    for (i = [0 : 2], j = [0 : 2]) if (i != 1 || j != 1)
        each squares(x + i * third, y + j * third, third, depth - 1)
];

module holes() {
    for (square = squares(0, 0, side, level))
        translate([square[0], square[1], 0]) cube([square[2], square[2], side]);
}

module sponge() {
    color(sand) difference() {
        cube(side);
        holes();
        // The cube's own diagonal is the axis that turns z into x and x into y.
        multmatrix([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0]]) holes();
        multmatrix([[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0]]) holes();
    }
}

sponge();
