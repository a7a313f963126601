//! Whether the points and faces of a polyhedron make a convex solid, and which.

use super::affine::{Vector, dot, length, minus};
use super::polytope::{Plane, Polytope, across};
use std::collections::{BTreeMap, BTreeSet};

/// The most faces, and half the most points: every one of the former is compared with all of the latter.
const MOST_FACES: usize = 10_000;

/// By which part of its extent a corner may be off a plane it is meant to lie in: OpenSCAD writes six digits.
const WRITTEN: f64 = 1e-5;

/// A face that is not flat by nothing but its digits is the same as its neighbour in this part of the extent.
const COPLANAR: f64 = 2e-6;

/// The convex solid of these faces, whose corners run clockwise as seen from outside; `None` where there are none.
///
/// # Errors
/// Where they make none: what is wrong, and what would do.
pub fn convex(points: &[Vector], faces: &[Vec<usize>]) -> Result<Option<Polytope>, [String; 2]> {
    if faces.is_empty() {
        return Ok(None);
    }
    let used: BTreeSet<usize> = faces.iter().flatten().copied().collect();
    if faces.len() > MOST_FACES || used.len() > 2 * MOST_FACES {
        return Err([
            format!("a polyhedron of {} faces and {} points", faces.len(), used.len()),
            format!("it may have {MOST_FACES} faces and twice as many points"),
        ]);
    }
    closed(faces)?;
    let corners: Vec<Vector> = used.iter().filter_map(|number| points.get(*number)).copied().collect();
    let mut solid = Polytope {
        planes: Vec::new(),
        corners,
    };
    let [low, high] = solid.bounds();
    let extent = length(minus(high, low));

    let mut outlines: Vec<(usize, Vec<Vector>, Vector)> = Vec::new();
    for (number, face) in faces.iter().enumerate() {
        // Clockwise from outside is counter-clockwise from inside.
        let outline: Vec<Vector> = face.iter().rev().filter_map(|number| points.get(*number)).copied().collect();
        let across = across(&outline);
        // A face without an area bounds nothing.
        if length(across) > COPLANAR * COPLANAR * extent * extent {
            outlines.push((number, outline, across));
        }
    }
    let volume: f64 = outlines.iter().map(|(_, outline, across)| dot(*across, minus(outline[0], low))).sum();
    if volume.abs() <= COPLANAR * extent * extent * extent {
        return Ok(None);
    }
    if volume < 0.0 {
        return Err([
            "a polyhedron turned inside out".to_owned(),
            "the points of a face run clockwise as seen from outside: reverse them".to_owned(),
        ]);
    }
    // The largest face of a plane knows best how that lies.
    outlines.sort_by(|(_, _, a), (_, _, b)| length(*b).total_cmp(&length(*a)));
    for (number, outline, across) in outlines {
        let plane = through_all(&outline, across);
        let off = |plane: &Plane, point: &Vector| dot(plane.normal, *point) - plane.height;
        if outline.iter().any(|corner| off(&plane, corner).abs() > WRITTEN * extent) {
            return Err([
                format!("a polyhedron whose face {number} is not flat"),
                "the points of a face must lie in a plane: split it into triangles".to_owned(),
            ]);
        }
        if solid.corners.iter().any(|corner| off(&plane, corner) > WRITTEN * extent) {
            return Err([
                format!("a polyhedron that is not convex at face {number}"),
                "all points must lie on one side of each face: make it of convex ones".to_owned(),
            ]);
        }
        let is_known = solid.planes.iter().any(|known| {
            dot(known.normal, plane.normal) > 0.0 && outline.iter().all(|corner| off(known, corner).abs() <= COPLANAR * extent)
        });
        if !is_known {
            solid.planes.push(plane);
        }
    }
    Ok(Some(solid))
}

/// The plane across a vector, half way between the points that lie in it but for their digits.
fn through_all(outline: &[Vector], across: Vector) -> Plane {
    let first = Plane::through(outline[0], across);
    let heights = outline.iter().map(|point| dot(first.normal, minus(*point, outline[0])));
    let (low, high) = heights.fold((0.0, 0.0), |(low, high): (f64, f64), height| (low.min(height), high.max(height)));
    Plane {
        height: first.height + 0.5 * (low + high),
        ..first
    }
}

/// Refuses faces that are not the whole surface of something: of each edge there must be one face on either side.
fn closed(faces: &[Vec<usize>]) -> Result<(), [String; 2]> {
    let mut edges = BTreeMap::new();
    let around = |face: &Vec<usize>| {
        let next = face.iter().skip(1).chain(face.first()).copied().collect::<Vec<_>>();
        face.iter().copied().zip(next).collect::<Vec<_>>()
    };
    for (number, face) in faces.iter().enumerate() {
        for edge in around(face) {
            if let Some(other) = edges.insert(edge, number) {
                return Err([
                    format!("a polyhedron whose faces {other} and {number} run the same way from point {} to {}", edge.0, edge.1),
                    "of two faces at an edge one runs forward and the other back: reverse one of them".to_owned(),
                ]);
            }
        }
    }
    match edges.iter().find(|((from, to), _)| !edges.contains_key(&(*to, *from))) {
        None => Ok(()),
        Some(((from, to), number)) => Err([
            format!("a polyhedron with a hole beside face {number}, from point {from} to {to}"),
            "its faces must be its whole surface".to_owned(),
        ]),
    }
}

#[cfg(test)]
mod tests {
    use super::convex;
    use crate::model::affine::Vector;

    const CORNERS: [Vector; 8] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 0.0, 3.0],
        [1.0, 0.0, 3.0],
        [1.0, 2.0, 3.0],
        [0.0, 2.0, 3.0],
    ];

    /// The faces of the example in OpenSCAD's manual, clockwise from outside.
    fn faces() -> Vec<Vec<usize>> {
        [[0, 1, 2, 3], [4, 5, 1, 0], [7, 6, 5, 4], [5, 6, 2, 1], [6, 7, 3, 2], [7, 4, 0, 3]].map(Vec::from).to_vec()
    }

    fn refusal(points: &[Vector], faces: &[Vec<usize>]) -> String {
        convex(points, faces).expect_err("it is no convex solid").join("; ")
    }

    #[test]
    fn a_box_has_six_faces_in_squares_and_in_triangles() {
        let triangles: Vec<_> = faces().iter().flat_map(|face| [vec![face[0], face[1], face[2]], vec![face[0], face[2], face[3]]]).collect();
        for faces in [faces(), triangles] {
            let solid = convex(&CORNERS, &faces).expect("it is convex").expect("it has a volume");
            assert_eq!(solid.planes.len(), 6);
            let mut sides: Vec<_> = solid.planes.iter().map(|plane| (plane.axis(), plane.height)).collect();
            sides.sort_by(|a, b| a.1.total_cmp(&b.1));
            assert!(sides.iter().all(|(axis, _)| axis.is_some()));
            assert_eq!(sides.iter().map(|(_, height)| *height).collect::<Vec<_>>(), [0.0, 0.0, 0.0, 1.0, 2.0, 3.0]);
        }
    }

    #[test]
    fn what_is_no_convex_solid_is_told_apart() {
        let mut dented = CORNERS;
        dented[6] = [0.2, 0.3, 3.0];
        let told = refusal(&dented, &faces());
        assert!(told.contains("not flat") || told.contains("not convex"), "{told}");
        let reversed: Vec<_> = faces().into_iter().map(|face| face.into_iter().rev().collect()).collect();
        assert!(refusal(&CORNERS, &reversed).contains("inside out"));
        let mut mixed = faces();
        mixed[2].reverse();
        assert!(refusal(&CORNERS, &mixed).contains("same way"));
        assert!(refusal(&CORNERS, &faces()[..5]).contains("hole"));
        assert_eq!(convex(&[], &[]), Ok(None));
        let flat = CORNERS.map(|[x, y, _]| [x, y, 0.0]);
        assert_eq!(convex(&flat, &faces()), Ok(None));
    }
}
