//! Convex solids with flat faces: prisms, frusta and what turns in facets, as their planes.

use super::affine::{Affine, Vector, cross, dot, length, minus};

/// A plane with the solid below it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// The unit normal, away from the solid.
    pub normal: Vector,
    /// The height of the plane over the origin, along the normal.
    pub height: f64,
}

impl Plane {
    /// The plane through a point across a vector of any length but zero.
    #[must_use]
    pub fn through(point: Vector, across: Vector) -> Self {
        let size = length(across);
        let normal = across.map(|part| part / size);
        Self {
            normal,
            height: dot(normal, point),
        }
    }

    /// The axis the plane is across, if it is across one, and whether it faces along it or against it.
    #[must_use]
    pub fn axis(&self) -> Option<(usize, bool)> {
        /// The other components of a normal that is meant to be one of an axis.
        const ASIDE: f64 = 1e-9;
        let axis = (0..3).max_by(|a, b| self.normal[*a].abs().total_cmp(&self.normal[*b].abs()))?;
        let is_aside = (0..3).any(|other| other != axis && self.normal[other].abs() > ASIDE);
        (!is_aside).then_some((axis, self.normal[axis] > 0.0))
    }
}

/// A convex solid with flat faces.
#[derive(Clone, Debug, PartialEq)]
pub struct Polytope {
    /// Its faces.
    pub planes: Vec<Plane>,
    /// Its corners.
    pub corners: Vec<Vector>,
}

/// The cosine and the sine of an angle in degrees, exact at quarter turns.
fn around(degrees: f64) -> [f64; 2] {
    let quarters = (degrees / 90.0).round();
    let (sine, cosine) = (degrees - 90.0 * quarters).to_radians().sin_cos();
    match quarters.rem_euclid(4.0) as u8 {
        0 => [cosine, sine],
        1 => [0.0 - sine, cosine],
        2 => [0.0 - cosine, 0.0 - sine],
        _ => [sine, 0.0 - cosine],
    }
}

impl Polytope {
    /// What OpenSCAD makes of a solid that turns about the z axis: so many corners on each ring, the first one over the x
    /// axis; the rings, from the bottom to the top, as height and radius, must bulge outward.
    #[must_use]
    pub fn turned(corners: u32, rings: &[[f64; 2]]) -> Self {
        let step = 360.0 / f64::from(corners);
        // How far the middle of a side is from the axis.
        let inner = around(0.5 * step)[0];
        let mut turned = Self {
            planes: Vec::new(),
            corners: Vec::new(),
        };
        for [height, radius] in rings {
            let ring = (0..corners).map(|number| around(step * f64::from(number)).map(|part| part * radius));
            turned.corners.extend(ring.map(|[x, y]| [x, y, *height]));
        }
        for band in rings.windows(2) {
            let &[[bottom, lower], [top, upper]] = band else { continue };
            for number in 0..corners {
                let [x, y] = around(step * (f64::from(number) + 0.5));
                let across = [x * (top - bottom), y * (top - bottom), (lower - upper) * inner];
                turned.planes.push(Plane::through([x * lower * inner, y * lower * inner, bottom], across));
            }
        }
        if let (Some([bottom, lower]), Some([top, upper])) = (rings.first(), rings.last()) {
            let caps = [(*bottom, *lower, -1.0), (*top, *upper, 1.0)].into_iter().filter(|cap| cap.1 > 0.0);
            turned.planes.extend(caps.map(|(height, _, side)| Plane::through([0.0, 0.0, height], [0.0, 0.0, side])));
        }
        turned
    }

    /// The solid where a map takes it, which must leave it a volume.
    #[must_use]
    pub fn mapped(&self, map: &Affine) -> Self {
        // Normals that a mirror turns inward are turned back.
        let (cofactors, side) = (map.cofactors(), map.determinant().signum());
        let plane = |plane: &Plane| {
            let on = plane.normal.map(|part| part * plane.height);
            Plane::through(map.point(on), cofactors.vector(plane.normal).map(|part| part * side))
        };
        Self {
            planes: self.planes.iter().map(plane).collect(),
            corners: self.corners.iter().map(|corner| map.point(*corner)).collect(),
        }
    }

    /// The least coordinates of its corners, and the greatest.
    #[must_use]
    pub fn bounds(&self) -> [Vector; 2] {
        let bound = |axis: usize, choose: fn(f64, f64) -> f64| self.corners.iter().map(|corner| corner[axis]).reduce(choose).unwrap_or(0.0);
        [
            core::array::from_fn(|axis| bound(axis, f64::min)),
            core::array::from_fn(|axis| bound(axis, f64::max)),
        ]
    }
}

/// The vector across a face whose corners run counter-clockwise, of the length of twice its area.
#[must_use]
pub fn across(corners: &[Vector]) -> Vector {
    let Some(first) = corners.first() else { return [0.0; 3] };
    let mut sum = [0.0; 3];
    for pair in corners.windows(2) {
        let part = cross(minus(pair[0], *first), minus(pair[1], *first));
        sum = core::array::from_fn(|axis| sum[axis] + part[axis]);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::{Plane, Polytope, around};
    use crate::model::affine::{Affine, dot};

    #[test]
    fn quarter_turns_are_exact() {
        assert_eq!([0.0, 90.0, 180.0, 270.0, 360.0].map(around), [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0], [1.0, 0.0]]);
        let [x, y] = around(210.0);
        assert!((x + 0.75_f64.sqrt()).abs() < 1e-15 && (y + 0.5).abs() < 1e-15);
    }

    /// Every face has its corners on it and no corner above it, whatever map the solid went through.
    #[test]
    fn faces_hold_their_corners() {
        let skew = Affine {
            linear: [[1.0, 0.3, 0.0], [-0.2, -2.0, 0.5], [0.0, 0.1, 3.0]],
            translation: [5.0, -1.0, 0.25],
        };
        for (corners, rings, faces) in [
            (6, &[[0.0, 2.0], [3.0, 2.0]][..], 8),
            (3, &[[-1.0, 2.0], [3.0, 0.0]], 4),
            (4, &[[-1.0, 0.0], [3.0, 1.5]], 5),
            (5, &[[-1.0, 1.0], [0.0, 1.5], [1.0, 1.0]], 12),
        ] {
            for solid in [Polytope::turned(corners, rings), Polytope::turned(corners, rings).mapped(&skew)] {
                assert_eq!(solid.planes.len(), faces);
                for Plane { normal, height } in &solid.planes {
                    let over: Vec<_> = solid.corners.iter().map(|corner| dot(*normal, *corner) - height).collect();
                    assert!(over.iter().all(|over| *over < 1e-12), "{over:?}");
                    assert!(over.iter().filter(|over| over.abs() < 1e-12).count() >= 3, "{over:?}");
                }
            }
        }
    }
}
