//! Half-spaces as the rays of a tile see them: what has no box may still be out of sight, or all around.

use super::reduce::Known;
use super::walk::OF_DISTANCE;
use glam::Vec3;
use gsdf_nostd::{Solid, Transform};

/// The plane that bounds a half-space in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Border {
    /// Away from the half-space, of unit length.
    normal: Vec3,
    /// The plane is so far along the normal from here.
    origin: Vec3,
    offset: f32,
    /// How large the numbers are that its height over the plane is computed from, beside those of a point.
    extent: f32,
    /// By how much more than its height a frame stretches what a point is off by; at least 1.
    rough: f32,
}

/// The sum of the magnitudes of a vector's components.
#[inline(always)]
fn size(v: Vec3) -> f32 {
    v.abs().element_sum()
}

impl Border {
    /// That of a solid in its frame, if it is a half-space.
    pub(crate) fn of_solid<L: Solid>(solid: &L, pose: Option<&Transform>) -> Option<Self> {
        let plane = solid.as_half_space()?;
        let (point, normal) = (plane.point(), plane.normal());
        let Some(pose) = pose else {
            return Some(Self {
                normal,
                origin: point,
                offset: 0.0,
                extent: size(point),
                rough: 1.0,
            });
        };
        let rows = pose.to_local();
        let outward = rows[0] * normal.x + rows[1] * normal.y + rows[2] * normal.z;
        let per_length = outward.length().recip();
        let stretched = rows.into_iter().map(size).fold(0.0, f32::max);
        Some(Self {
            normal: outward * per_length,
            origin: pose.origin(),
            offset: normal.dot(point) * per_length,
            extent: size(pose.origin()) + size(point) * per_length,
            rough: (stretched * per_length).max(1.0),
        })
    }

    /// What rays see of the half-space that start around `middle` and go along about `toward`, where both differ among them
    /// by up to `apart` and `spread` times the components of these two sides.
    #[inline(always)]
    pub(crate) fn seen(&self, middle: Vec3, apart: f32, toward: Vec3, spread: f32, sides: [Vec3; 2]) -> Known {
        let across = self.normal.dot(sides[0]).abs() + self.normal.dot(sides[1]).abs();
        let reach = size(sides[0]) + size(sides[1]);
        let margin = OF_DISTANCE * self.rough;
        let height = self.normal.dot(middle - self.origin) - self.offset;
        let high = apart * across + margin * (size(middle) + apart * reach + self.extent);
        let speed = self.normal.dot(toward);
        let fast = spread * across + margin * (size(toward) + spread * reach);
        if high < height && fast < speed {
            Known::Outside
        } else if height < -high && speed < -fast {
            Known::Inside
        } else {
            Known::Open
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Border, Known};
    use glam::{Mat3, Vec3, vec3};
    use gsdf_nostd::{HalfSpace, Sphere, Transform};

    const SIDES: [Vec3; 2] = [Vec3::X, Vec3::Y];

    #[test]
    fn who_goes_away_from_a_half_space_never_sees_it() {
        let floor = HalfSpace::new(vec3(3.0, 1.0, 0.0), Vec3::Y).unwrap();
        let border = Border::of_solid(&floor, None).unwrap();
        let from = |height: f32, climb: f32| border.seen(vec3(0.0, height, 0.0), 0.0, vec3(0.0, climb, 1.0), 0.25, SIDES);
        assert_eq!(from(2.0, 0.26), Known::Outside);
        assert_eq!(from(2.0, 0.24), Known::Open);
        assert_eq!(from(1.0, 0.26), Known::Open);
        assert_eq!(from(0.9, -0.26), Known::Inside);
        assert_eq!(from(0.9, -0.24), Known::Open);
        // Parallel rays from a square.
        let beside = |height: f32, climb: f32| border.seen(vec3(0.0, height, 0.0), 0.25, vec3(0.0, climb, 1.0), 0.0, SIDES);
        assert_eq!(beside(1.3, 0.01), Known::Outside);
        assert_eq!(beside(1.2, 0.01), Known::Open);
        assert_eq!(beside(0.7, -0.01), Known::Inside);
        assert_eq!(Border::of_solid(&Sphere::new(Vec3::ZERO, 1.0).unwrap(), None), None);
    }

    #[test]
    fn frames_take_the_plane_along() {
        let floor = HalfSpace::new(vec3(3.0, 1.0, 0.0), Vec3::Y).unwrap();
        // y becomes x, twice as long, and 5 further.
        let turn = Mat3::from_cols(vec3(0.0, 2.0, 0.0), vec3(2.0, 0.0, 0.0), vec3(0.0, 0.0, -2.0));
        let pose = Transform::affine(turn, vec3(5.0, 0.0, 0.0)).unwrap();
        let border = Border::of_solid(&floor, Some(&pose)).unwrap();
        let from = |x: f32| border.seen(vec3(x, 0.0, 0.0), 0.0, vec3(1.0, 0.0, 0.0), 0.0, SIDES);
        assert_eq!((from(7.01), from(6.99)), (Known::Outside, Known::Open));
        let back = |x: f32| border.seen(vec3(x, 0.0, 0.0), 0.0, vec3(-1.0, 0.0, 0.0), 0.0, SIDES);
        assert_eq!((back(7.01), back(6.99)), (Known::Open, Known::Inside));
    }
}
