//! The two composites the paper names, a snowcone and a hollowed-out sphere, made as it makes them: by the orientation of surfaces alone.
//!
//! Neither uses `difference`. A surface bounds what is on one side of it, `complement` turns it over, and an intersection keeps what is on the right side of
//! all. A sphere turned over is the space around it: intersected with a larger one it leaves a shell.

use super::{Look, Scene, upright};
use crate::palette;
use glam::{Vec3, vec3};
use gsdf_nostd::{CappedCylinder, HalfSpace, Nappe, Sphere, csg};

csg! {
    /// A nappe is infinite: a half-space turned over, the space above the rim, ends it. A second nappe turned over makes it a cup.
    const CUP = intersection(
        Nappe::new(vec3(0.0, 0.1, 0.0), Vec3::Y, 1.0, 2.4),
        complement(Nappe::new(vec3(0.0, 0.22, 0.0), Vec3::Y, 1.0, 2.4)),
        complement(HalfSpace::new(vec3(0.0, 2.2, 0.0), Vec3::NEG_Y))
    )
}

csg! {
    /// A ball of ice in a cup, and someone has had a bite: the ball is kept where a smaller one, turned over, has its inside.
    pub const SNOWCONE = union(
        CUP,
        intersection(Sphere::new(vec3(0.0, 2.45, 0.0), 0.86), complement(Sphere::new(vec3(-0.56, 3.08, -0.5), 0.56)))
    )
}

csg! {
    /// A ball without its inside, cut open by a half-space turned over.
    pub const HOLLOW_SPHERE = intersection(
        Sphere::new(vec3(0.0, 1.0, 0.0), 1.0),
        complement(Sphere::new(vec3(0.0, 1.0, 0.0), 0.86)),
        complement(HalfSpace::new(vec3(0.12, 1.15, -0.16), vec3(-0.48, -0.6, 0.64)))
    )
}

csg! {
    const SNOWCONE_ON_ITS_STAND = union(
        SNOWCONE,
        CappedCylinder::new(Vec3::ZERO, vec3(0.0, 0.7, 0.0), Vec3::Y, 0.75),
        HalfSpace::new(Vec3::ZERO, Vec3::Y)
    )
}

csg! {
    const HOLLOW_SPHERE_ON_THE_GROUND = union(
        HOLLOW_SPHERE,
        Sphere::new(vec3(0.0, 1.0, 0.0), 0.36),
        HalfSpace::new(Vec3::ZERO, Vec3::Y)
    )
}

/// A snowcone in its stand.
#[must_use]
pub fn snowcone() -> Scene {
    Scene {
        name: "snowcone",
        title: "the paper's snowcone",
        nodes: SNOWCONE_ON_ITS_STAND.nodes().to_vec(),
        poses: Vec::new(),
        camera: upright(vec3(1.6, 3.3, -7.0), vec3(0.0, 1.62, 0.0), 0.31),
        look: Look {
            paint: |leaf| match leaf {
                0..=2 => palette::SAND,
                3 => palette::ICE,
                4 => palette::CORAL,
                5 => palette::SLATE,
                _ => palette::GROUND,
            },
            haze: 28.0,
            ..Look::OUTDOORS
        },
    }
}

/// A hollowed-out sphere, cut open, around a small core.
#[must_use]
pub fn hollow() -> Scene {
    Scene {
        name: "hollow",
        title: "the paper's hollowed-out sphere",
        nodes: HOLLOW_SPHERE_ON_THE_GROUND.nodes().to_vec(),
        poses: Vec::new(),
        camera: upright(vec3(1.9, 2.6, -4.2), vec3(0.0, 0.88, 0.0), 0.3),
        look: Look {
            paint: |leaf| match leaf {
                0 => palette::SLATE,
                1 => palette::SAND,
                2 => palette::CORAL,
                3 => palette::ICE,
                _ => palette::GROUND,
            },
            haze: 20.0,
            ..Look::OUTDOORS
        },
    }
}

#[cfg(test)]
mod tests {
    use super::{HOLLOW_SPHERE, SNOWCONE, hollow, snowcone};
    use glam::{Vec3, vec3};
    use gsdf_nostd::Node;

    #[test]
    fn orientation_alone_takes_the_insides_away() {
        for scene in [snowcone(), hollow()] {
            assert!(!scene.nodes.contains(&Node::Difference), "{}", scene.name);
        }
    }

    #[test]
    fn the_hollow_is_hollow_and_the_cup_ends() {
        // From the middle of the ball down: first through the hollow, then into the shell.
        assert!((HOLLOW_SPHERE.gsdf(vec3(0.0, 1.0, 0.0), Vec3::NEG_Y) - 0.86).abs() < 1e-6);
        // Far over the rim the nappe would be wide; the cup is not there.
        assert_eq!(SNOWCONE.gsdf(vec3(9.0, 5.0, 0.0), Vec3::NEG_X), f32::INFINITY);
        assert!(SNOWCONE.sdf(vec3(0.0, 0.15, 0.0)) < 0.0);
    }
}
