//! The five scenes on which other renderers were measured: a ball on the ground, one part, and three grids of growing
//! weight. Made at compile time, to lie in flash.

use glam::{Vec3, vec3};
use gsdf_nostd::{Camera, CappedCylinder, Capsule, Cone, Csg, Cuboid, HalfSpace, Invalid, Leaf, Node, Program, Raster, Sphere, csg, valid};

/// A solid and from where it is seen, upright.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
    /// The name by which it is asked for.
    pub name: &'static str,
    /// The solid.
    pub program: Program<'static>,
    /// Where the camera stands.
    pub eye: Vec3,
    /// What it looks at.
    pub target: Vec3,
    /// The tangent of half its vertical field of view.
    pub tangent: f32,
    /// The pixels along each side of the picture that is small enough for every target to compute in seconds.
    pub side: u32,
}

impl Scene {
    /// The camera: a pinhole.
    ///
    /// # Errors
    /// As [`Camera::pinhole`]; never for the scenes of this module.
    pub fn camera(&self) -> Result<Camera, Invalid> {
        Camera::pinhole(self.eye, self.target, Vec3::Y, self.tangent)
    }

    /// The picture of [`side`](Self::side) by `side` pixels.
    ///
    /// # Errors
    /// As [`camera`](Self::camera).
    pub fn raster(&self) -> Result<Raster, Invalid> {
        Ok(self.camera()?.raster(self.side, self.side))
    }
}

csg! {
    /// S1: a ball that rests on the ground.
    pub const BALL_ON_GROUND = union(Sphere::new(vec3(0.0, 1.0, 0.0), 1.0), HalfSpace::new(Vec3::ZERO, Vec3::Y))
}

/// S2: the textbook's part, a rounded cube drilled through along each axis.
pub const PART: Csg<9> = valid!(Csg::new(valid!(part(Vec3::ZERO))));

/// The nodes of the [`PART`] around another centre: `((((cube ∩ sphere) - drill) - drill) - drill)`.
///
/// # Errors
/// Where the centre is not finite or out of the range of coordinates.
pub const fn part(center: Vec3) -> Result<[Node; 9], Invalid> {
    let cube = match Cuboid::new(minus(center, Vec3::ONE), plus(center, Vec3::ONE)) {
        Ok(cube) => Node::leaf(Leaf::Cuboid(cube)),
        Err(error) => return Err(error),
    };
    let sphere = match Sphere::new(center, 1.35) {
        Ok(sphere) => Node::leaf(Leaf::Sphere(sphere)),
        Err(error) => return Err(error),
    };
    match (drill(center, Vec3::X), drill(center, Vec3::Y), drill(center, Vec3::Z)) {
        (Ok(x), Ok(y), Ok(z)) => Ok([
            cube,
            sphere,
            Node::Intersection,
            x,
            Node::Difference,
            y,
            Node::Difference,
            z,
            Node::Difference,
        ]),
        (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => Err(error),
    }
}

/// The drill of a [`part`] along one axis.
const fn drill(center: Vec3, axis: Vec3) -> Result<Node, Invalid> {
    let (from, to) = (minus(center, times(1.5, axis)), plus(center, times(1.5, axis)));
    match CappedCylinder::new(from, to, axis, 0.6) {
        Ok(drill) => Ok(Node::leaf(Leaf::CappedCylinder(drill))),
        Err(error) => Err(error),
    }
}

/// S3: 4 x 4 x 4 spheres, boxes, capsules and cones by turns. 64 leaves.
pub static GRID_OF_SOLIDS: Csg<{ 2 * 64 - 1 }> = valid!(Csg::new(valid!(grid_of_solids())));

/// S4: 16 x 16 x 16 spheres of ten sizes. 4096 leaves.
pub static GRID_OF_SPHERES: Csg<{ 2 * 4096 - 1 }> = valid!(Csg::new(valid!(grid_of_spheres())));

/// S5: 16 x 16 [parts](PART) in a plane. 1280 leaves.
pub static GRID_OF_PARTS: Csg<{ 10 * 256 - 1 }> = valid!(Csg::new(valid!(grid_of_parts())));

/// A ball on the ground.
pub const S1: Scene = Scene {
    name: "s1",
    program: const { &BALL_ON_GROUND }.program(),
    eye: vec3(0.0, 1.6, -4.0),
    target: vec3(0.0, 1.0, 0.0),
    tangent: 0.36,
    side: 96,
};

/// One part, in four operations on five leaves.
pub const S2: Scene = Scene {
    name: "s2",
    program: const { &PART }.program(),
    eye: vec3(2.5, 2.2, -3.5),
    target: Vec3::ZERO,
    tangent: 0.36,
    side: 96,
};

/// A grid of four kinds of solids.
pub const S3: Scene = Scene {
    name: "s3",
    program: GRID_OF_SOLIDS.program(),
    eye: vec3(7.0, 6.0, -11.0),
    target: Vec3::ZERO,
    tangent: 0.45,
    side: 32,
};

/// A grid of spheres.
pub const S4: Scene = Scene {
    name: "s4",
    program: GRID_OF_SPHERES.program(),
    eye: vec3(16.0, 13.0, -26.0),
    target: Vec3::ZERO,
    tangent: 0.38,
    side: 12,
};

/// A field of parts.
pub const S5: Scene = Scene {
    name: "s5",
    program: GRID_OF_PARTS.program(),
    eye: vec3(20.0, 30.0, -45.0),
    target: Vec3::ZERO,
    tangent: 0.5,
    side: 16,
};

/// The coordinates of the cell of a number, in a grid whose last two extents are `J` and `K`: the last one fastest.
#[must_use]
pub const fn cell<const J: u32, const K: u32>(number: u32) -> [u32; 3] {
    [number / (J * K), number / K % J, number % K]
}

/// Which of four kinds the solid in a cell of [`S3`] is.
#[must_use]
pub const fn kind([i, j, k]: [u32; 3]) -> u32 {
    (i + j + k) % 4
}

/// Which of ten sizes the sphere in a cell of [`S4`] has.
#[must_use]
pub const fn size_class([i, j, k]: [u32; 3]) -> u32 {
    (7 * i + 13 * j + 29 * k) % 10
}

// The nodes of a long union are a chain that leans to the left, operand, operand, union, operand, union and so on, so
// that however long it is only one operand waits beside the one at hand. The arrays start out as unions all over.

const fn grid_of_solids() -> Result<[Node; 127], Invalid> {
    let mut nodes = [Node::Union; 127];
    let mut number = 0;
    while number < 64 {
        let [i, j, k] = cell::<4, 4>(number);
        let center = minus(times(2.0, vec3(i as f32, j as f32, k as f32)), Vec3::splat(3.0));
        match solid_of_kind(kind([i, j, k]), center) {
            Ok(solid) => nodes[(2 * number as usize).saturating_sub(1)] = Node::leaf(solid),
            Err(error) => return Err(error),
        }
        number += 1;
    }
    Ok(nodes)
}

const fn grid_of_spheres() -> Result<[Node; 8191], Invalid> {
    let mut nodes = [Node::Union; 8191];
    let mut number = 0;
    while number < 4096 {
        let [i, j, k] = cell::<16, 16>(number);
        let center = minus(vec3(i as f32, j as f32, k as f32), Vec3::splat(7.5));
        let radius = 0.2 + 0.1 * size_class([i, j, k]) as f32 / 10.0;
        match Sphere::new(center, radius) {
            Ok(sphere) => nodes[(2 * number as usize).saturating_sub(1)] = Node::leaf(Leaf::Sphere(sphere)),
            Err(error) => return Err(error),
        }
        number += 1;
    }
    Ok(nodes)
}

const fn grid_of_parts() -> Result<[Node; 2559], Invalid> {
    let mut nodes = [Node::Union; 2559];
    let mut number = 0;
    while number < 256 {
        let [i, _, k] = cell::<1, 16>(number);
        let center = times(3.2, minus(vec3(i as f32, 0.0, k as f32), vec3(7.5, 0.0, 7.5)));
        let part = match part(center) {
            Ok(part) => part,
            Err(error) => return Err(error),
        };
        let start = (10 * number as usize).saturating_sub(1);
        let mut place = 0;
        while place < part.len() {
            nodes[start + place] = part[place];
            place += 1;
        }
        number += 1;
    }
    Ok(nodes)
}

/// One of the four kinds of solids of [`S3`].
const fn solid_of_kind(kind: u32, center: Vec3) -> Result<Leaf, Invalid> {
    let solid = match kind {
        0 => match Sphere::new(center, 0.7) {
            Ok(sphere) => Leaf::Sphere(sphere),
            Err(error) => return Err(error),
        },
        1 => {
            let half = vec3(0.6, 0.5, 0.55);
            match Cuboid::new(minus(center, half), plus(center, half)) {
                Ok(cuboid) => Leaf::Cuboid(cuboid),
                Err(error) => return Err(error),
            }
        }
        2 => match Capsule::new(minus(center, times(0.4, Vec3::Y)), plus(center, times(0.4, Vec3::Y)), 0.4) {
            Ok(capsule) => Leaf::Capsule(capsule),
            Err(error) => return Err(error),
        },
        _ => {
            let (apex, base) = (plus(center, times(0.6, Vec3::Y)), minus(center, times(0.6, Vec3::Y)));
            match Cone::new(apex, base, Vec3::NEG_Y, 0.7) {
                Ok(cone) => Leaf::Cone(cone),
                Err(error) => return Err(error),
            }
        }
    };
    Ok(solid)
}

// The operators of glam are no `const fn`.

const fn plus(a: Vec3, b: Vec3) -> Vec3 {
    vec3(a.x + b.x, a.y + b.y, a.z + b.z)
}

const fn minus(a: Vec3, b: Vec3) -> Vec3 {
    vec3(a.x - b.x, a.y - b.y, a.z - b.z)
}

const fn times(factor: f32, v: Vec3) -> Vec3 {
    vec3(factor * v.x, factor * v.y, factor * v.z)
}
