// A puzzle ball in a dodecahedron: a cage with a ball on every corner, and in it two pierced shells and a core, each turned
// against the one around it.

size = 10;              // half the edge of the cube whose eight corners the dodecahedron shares
strut = 0.86;           // the hollow, as a part of the whole
knob = 1.5;

$fa = 4;
$fs = 0.25;

walnut = [0.42, 0.26, 0.17];
brass = [0.90, 0.72, 0.34];
jade = [0.36, 0.62, 0.48];
ivory = [0.95, 0.92, 0.82];
coral = [0.86, 0.34, 0.26];

// The golden ratio is rounded to three digits so that all corners have few: a .csg file keeps six, and the pentagons stay
// flat. For any h the twenty points below make twelve flat faces; for 0.618 they are regular to a ten-thousandth.
h = 0.618;
far = 1 + h;
low = 1 - h * h;

corners = [
    for (x = [-1, 1], y = [-1, 1], z = [-1, 1]) size * [x, y, z],
    for (a = [-1, 1], b = [-1, 1]) size * [0, a * far, b * low],
    for (a = [-1, 1], b = [-1, 1]) size * [b * low, 0, a * far],
    for (a = [-1, 1], b = [-1, 1]) size * [a * far, b * low, 0]
];

// The middles of the faces lie along these.
normals = [
    for (a = [-1, 1], b = [-1, 1]) [0, a * h, b],
    for (a = [-1, 1], b = [-1, 1]) [b, 0, a * h],
    for (a = [-1, 1], b = [-1, 1]) [a * h, b, 0]
];

// A face is made of the five corners farthest along its normal.
function on_face(normal) =
    let (along = [for (corner = corners) corner * normal], most = max(along))
    [for (index = [0 : len(corners) - 1]) if (along[index] > 0.99 * most) index];

// In order around the normal, clockwise from outside as OpenSCAD wants it: sorted by angle.
function across(normal) = let (any = abs(normal[0]) < 0.5 ? [1, 0, 0] : [0, 1, 0], side = cross(normal, any)) side / norm(side);
function angle(normal, point) = let (u = across(normal), v = cross(normal, u)) atan2(point * v, point * u);
function sorted(normal, face) =
    len(face) < 2 ? face :
    let (
        pivot = angle(normal, corners[face[0]]),
        before = [for (index = face) if (angle(normal, corners[index]) > pivot) index],
        after = [for (index = face) if (angle(normal, corners[index]) < pivot) index]
    ) concat(sorted(normal, before), [face[0]], sorted(normal, after));

module dodecahedron() {
    polyhedron(points = corners, faces = [for (normal = normals) sorted(normal, on_face(normal))]);
}

// From the middle out along every face's normal.
module each_face() {
    for (normal = normals)
        rotate([0, acos(normal[2] / norm(normal)), atan2(normal[1], normal[0])]) children();
}

module cage() {
    difference() {
        color(walnut) dodecahedron();
        color(brass) scale(strut) dodecahedron();
        color(brass) each_face() cylinder(h = 2 * size, r = 0.74 * size);
    }
    color(brass) for (corner = corners) translate(corner) sphere(r = knob);
}

// A shell with a conical hole along each normal, wider outside.
module shell(outer, inner, hole) {
    difference() {
        sphere(r = outer);
        sphere(r = inner);
        each_face() cylinder(h = 1.2 * outer, r1 = 0, r2 = 1.2 * hole);
    }
}

cage();
color(jade) rotate([20, 35, 10]) shell(11.2, 9.9, 4.7);
color(ivory) rotate([-50, 15, 40]) shell(8.6, 7.4, 3.5);
color(coral) sphere(r = 4.6);
