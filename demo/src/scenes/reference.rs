//! The five scenes on which other renderers were measured: a ball on the ground, one part, and three grids of growing weight.

use super::{Look, Scene, joined, upright, valid};
use crate::palette;
use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCylinder, Capsule, Cone, Csg, Cuboid, Draft, HalfSpace, Leaf, Node, Sphere, csg};

csg! {
    /// S1: a ball that rests on the ground.
    pub const BALL_ON_GROUND = union(Sphere::new(vec3(0.0, 1.0, 0.0), 1.0), HalfSpace::new(Vec3::ZERO, Vec3::Y))
}

csg! {
    /// S2: the textbook's part, a rounded cube drilled through along each axis.
    pub const PART = difference(
        intersection(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(Vec3::ZERO, 1.35)),
        CappedCylinder::new(vec3(-1.5, 0.0, 0.0), vec3(1.5, 0.0, 0.0), Vec3::X, 0.6),
        CappedCylinder::new(vec3(0.0, -1.5, 0.0), vec3(0.0, 1.5, 0.0), Vec3::Y, 0.6),
        CappedCylinder::new(vec3(0.0, 0.0, -1.5), vec3(0.0, 0.0, 1.5), Vec3::Z, 0.6)
    )
}

/// The [`PART`] around another centre, which is known at run time.
///
/// # Panics
/// Where the centre is not finite or out of the range of coordinates.
#[must_use]
pub fn part(center: Vec3) -> Csg<9> {
    let drill = |axis: Vec3| valid(CappedCylinder::new(center - 1.5 * axis, center + 1.5 * axis, axis, 0.6)).into();
    valid(
        Draft::new()
            .leaf(Leaf::from(valid(Cuboid::new(center - Vec3::ONE, center + Vec3::ONE))))
            .leaf(valid(Sphere::new(center, 1.35)).into())
            .operator(Node::Intersection)
            .leaf(drill(Vec3::X))
            .operator(Node::Difference)
            .leaf(drill(Vec3::Y))
            .operator(Node::Difference)
            .leaf(drill(Vec3::Z))
            .operator(Node::Difference)
            .finish(),
    )
}

/// S1: a ball on the ground. Two leaves.
#[must_use]
pub fn s1() -> Scene {
    Scene {
        name: "s1",
        title: "a ball on the ground",
        nodes: BALL_ON_GROUND.nodes().to_vec(),
        poses: Vec::new(),
        camera: upright(vec3(0.0, 1.6, -4.0), vec3(0.0, 1.0, 0.0), 0.36),
        look: Look {
            paint: |leaf| if leaf == 0 { palette::CORAL } else { palette::GROUND },
            haze: 16.0,
            ..Look::OUTDOORS
        },
    }
}

/// S2: one part, in three operations from five leaves.
#[must_use]
pub fn s2() -> Scene {
    Scene {
        name: "s2",
        title: "a drilled and rounded cube",
        nodes: PART.nodes().to_vec(),
        poses: Vec::new(),
        camera: upright(vec3(2.5, 2.2, -3.5), Vec3::ZERO, 0.36),
        look: Look {
            paint: |leaf| match leaf {
                0 => palette::SLATE,
                1 => palette::SAND,
                _ => palette::CORAL,
            },
            haze: f32::INFINITY,
            ..Look::OUTDOORS
        },
    }
}

/// S3: 4 x 4 x 4 spheres, boxes, capsules and cones by turns. 64 leaves.
#[must_use]
pub fn s3() -> Scene {
    Scene {
        name: "s3",
        title: "a grid of four kinds of solids",
        nodes: joined(
            Node::Union,
            cells::<4, 4, 4>().map(|[i, j, k]| {
                let center = 2.0 * vec3(i as f32, j as f32, k as f32) - Vec3::splat(3.0);
                vec![Node::leaf(solid_of_kind((i + j + k) % 4, center))]
            }),
        ),
        poses: Vec::new(),
        camera: upright(vec3(7.0, 6.0, -11.0), Vec3::ZERO, 0.45),
        look: Look {
            paint: |leaf| {
                let [i, j, k] = cell::<4, 4>(leaf);
                palette::FOUR[(i + j + k) as usize % 4]
            },
            haze: f32::INFINITY,
            ..Look::OUTDOORS
        },
    }
}

/// S4: 16 x 16 x 16 spheres of ten sizes. 4096 leaves.
#[must_use]
pub fn s4() -> Scene {
    Scene {
        name: "s4",
        title: "4096 spheres of ten sizes",
        nodes: joined(
            Node::Union,
            cells::<16, 16, 16>().map(|[i, j, k]| {
                let center = vec3(i as f32, j as f32, k as f32) - Vec3::splat(7.5);
                let radius = 0.2 + 0.1 * size_class([i, j, k]) as f32 / 10.0;
                vec![Node::leaf(valid(Sphere::new(center, radius)).into())]
            }),
        ),
        poses: Vec::new(),
        camera: upright(vec3(16.0, 13.0, -26.0), Vec3::ZERO, 0.38),
        look: Look {
            paint: |leaf| palette::ramp(size_class(cell::<16, 16>(leaf)) as f32 / 9.0),
            haze: 90.0,
            ..Look::OUTDOORS
        },
    }
}

/// S5: 16 x 16 [parts](PART) in a plane. 1280 leaves.
#[must_use]
pub fn s5() -> Scene {
    Scene {
        name: "s5",
        title: "256 drilled and rounded cubes",
        nodes: joined(
            Node::Union,
            cells::<16, 1, 16>().map(|[i, _, k]| {
                let center = 3.2 * (vec3(i as f32, 0.0, k as f32) - vec3(7.5, 0.0, 7.5));
                part(center).nodes().to_vec()
            }),
        ),
        poses: Vec::new(),
        camera: upright(vec3(20.0, 30.0, -45.0), Vec3::ZERO, 0.5),
        look: Look {
            paint: |leaf| {
                let [i, _, k] = cell::<1, 16>(leaf / 5);
                match leaf % 5 {
                    // Across the field from one colour to the other.
                    0 | 1 => palette::ramp((i + k) as f32 / 30.0),
                    _ => palette::INK,
                }
            },
            haze: 240.0,
            ..Look::OUTDOORS
        },
    }
}

/// The cells of a grid, the last coordinate fastest.
fn cells<const I: u32, const J: u32, const K: u32>() -> impl Iterator<Item = [u32; 3]> {
    (0..I * J * K).map(cell::<J, K>)
}

/// The coordinates of the cell of a number, in a grid whose last two extents are `J` and `K`.
const fn cell<const J: u32, const K: u32>(number: u32) -> [u32; 3] {
    [number / (J * K), number / K % J, number % K]
}

/// Which of ten sizes a sphere of [`s4`] has.
const fn size_class([i, j, k]: [u32; 3]) -> u32 {
    (7 * i + 13 * j + 29 * k) % 10
}

/// One of the four kinds of solids of [`s3`].
fn solid_of_kind(kind: u32, center: Vec3) -> Leaf {
    match kind {
        0 => valid(Sphere::new(center, 0.7)).into(),
        1 => {
            let half = vec3(0.6, 0.5, 0.55);
            valid(Cuboid::new(center - half, center + half)).into()
        }
        2 => valid(Capsule::new(center - 0.4 * Vec3::Y, center + 0.4 * Vec3::Y, 0.4)).into(),
        _ => valid(Cone::new(center + 0.6 * Vec3::Y, center - 0.6 * Vec3::Y, Vec3::NEG_Y, 0.7)).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::{PART, part, s4};
    use glam::Vec3;

    #[test]
    fn the_part_at_run_time_is_the_part_of_the_source() {
        assert_eq!(part(Vec3::ZERO), PART);
    }

    #[test]
    fn every_other_node_of_a_long_union_is_a_leaf() {
        assert_eq!(s4().nodes.len(), 2 * 4096 - 1);
    }
}
