//! A planetary gear with a quarter of its housing cut away: every wheel a program in a frame of its own, posed as the teeth demand.
//!
//! A wheel is a disc, with pins around its pitch circle and, between them, holes of the same size. Two such wheels mesh exactly: where they touch, a pin of
//! the one lies in a hole of the other. To turn the gear one turns the poses; the programs stay as they are.

use super::{Look, Scene, joined, upright, valid};
use crate::light::Light;
use crate::palette;
use core::f32::consts::{PI, TAU};
use glam::{Mat3, Vec3, vec3};
use gsdf_nostd::{CappedCone, CappedCylinder, Cuboid, HalfSpace, Leaf, Node, Transform};
use libm::{cosf, sinf};

/// How many teeth the sun has, each of the planets, and the ring: the sun's and twice a planet's.
const TEETH: [u32; 3] = [12, 15, 42];
const PLANETS: u32 = 3;
const BOLTS: u32 = 12;
/// The pitch radius per tooth.
const MODULE: f32 = 0.1;
/// The play of the teeth: by how much pins are thinner than the holes are wide.
const PLAY: f32 = 0.012;
/// Between which heights the wheels lie.
const WHEELS: [f32; 2] = [0.5, 1.15];
/// Where the first planet stands: in the gap of the housing.
const FIRST: f32 = -1.0;
/// How far the sun is turned.
const DRIVE: f32 = 0.21;

/// The frames: of the sun, of the first planet, of the ring, and of what is cut away.
const SUN_FRAME: u16 = 1;
const PLANET_FRAME: u16 = 2;
const RING_FRAME: u16 = PLANET_FRAME + PLANETS as u16;
const CUT_FRAME: u16 = RING_FRAME + 1;

/// How many leaves the parts have, in the order in which they stand.
const PLANET_LEAVES: u32 = 2 * TEETH[1] + 2 + 1 + 1 + 5;
const PIN_LEAVES: u32 = 3;
const SUN_LEAVES: u32 = 2 * TEETH[0] + 2 + SHAFT_LEAVES;
const SHAFT_LEAVES: u32 = 4;
const RING_LEAVES: u32 = 2 * TEETH[2] + 3;

/// A planetary gear, cut open.
#[must_use]
pub fn planetary() -> Scene {
    let planets = (0..PLANETS).map(|number| in_frame(PLANET_FRAME + number as u16, planet()));
    let parts = planets.chain([in_frame(SUN_FRAME, sun()), housing(), base()]);
    Scene {
        name: "planetary",
        title: "a planetary gear, cut open",
        nodes: joined(Node::Union, parts),
        poses: poses(),
        camera: upright(vec3(5.9, 10.4, -13.6), vec3(0.1, 0.0, -0.45), 0.362),
        look: Look {
            paint,
            mirror: |leaf| match part_of(leaf) {
                Part::Planet | Part::Shaft => 0.42,
                Part::Sun => 0.5,
                Part::Bolt => 0.45,
                Part::Housing => 0.07,
                Part::Cut | Part::Table => 0.0,
            },
            haze: 80.0,
            light: Light::STUDIO,
        },
    }
}

/// What has a colour of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Planet,
    Shaft,
    Sun,
    Housing,
    Cut,
    Bolt,
    Table,
}

fn part_of(leaf: u32) -> Part {
    const SUN: u32 = PLANETS * (PLANET_LEAVES + PIN_LEAVES);
    const SHAFT: u32 = SUN + SUN_LEAVES - SHAFT_LEAVES;
    const HOUSING: u32 = SUN + SUN_LEAVES;
    const CUT: u32 = HOUSING + RING_LEAVES;
    const FLANGE: u32 = CUT + 1;
    const TABLE: u32 = FLANGE + 1;
    match leaf {
        ..SUN if leaf % (PLANET_LEAVES + PIN_LEAVES) < PLANET_LEAVES => Part::Planet,
        ..SUN => Part::Shaft,
        SUN..SHAFT => Part::Sun,
        SHAFT..HOUSING => Part::Shaft,
        HOUSING..CUT | FLANGE => Part::Housing,
        CUT => Part::Cut,
        TABLE => Part::Table,
        _ => Part::Bolt,
    }
}

fn paint(leaf: u32) -> Vec3 {
    match part_of(leaf) {
        Part::Planet => vec3(0.90, 0.56, 0.20),
        Part::Shaft | Part::Bolt => vec3(0.62, 0.62, 0.63),
        Part::Sun => vec3(0.80, 0.80, 0.80),
        Part::Housing => vec3(0.06, 0.16, 0.26),
        Part::Cut => palette::CORAL,
        Part::Table => vec3(0.60, 0.53, 0.45),
    }
}

/// Where the frames are.
fn poses() -> Vec<Transform> {
    let [sun, planet, ring] = TEETH.map(|teeth| teeth as f32);
    let mut poses = vec![pose(DRIVE, Vec3::ZERO)];
    for number in 0..PLANETS {
        poses.push(pose(planet_angle(number), (sun + planet) * MODULE * around(place(number))));
    }
    // A pin of the ring where the first planet has a hole.
    let phase = (place(0) - planet_angle(0)) * planet / TAU;
    poses.push(pose(place(0) - (phase - 0.5) * TAU / ring, Vec3::ZERO));
    // The quarter that faces the camera.
    poses.push(pose(-0.92 - 0.25 * PI, Vec3::ZERO));
    poses
}

/// The direction in which a planet stands.
fn place(number: u32) -> f32 {
    FIRST + TAU * number as f32 / PLANETS as f32
}

/// How far a planet is turned: so that towards the sun it has a hole where the sun has a pin.
fn planet_angle(number: u32) -> f32 {
    let [sun, planet, _] = TEETH.map(|teeth| teeth as f32);
    let phase = (place(number) - DRIVE) * sun / TAU;
    place(number) + PI - (0.5 - phase) * TAU / planet
}

/// The unit vector at an angle in the plane of the wheels, from the first axis towards the third; by `libm`, which gives the same bits on every target.
fn around(angle: f32) -> Vec3 {
    vec3(cosf(angle), 0.0, sinf(angle))
}

/// What turns the first axis into [`around`] and stands at a point.
fn pose(angle: f32, at: Vec3) -> Transform {
    let first = around(angle);
    valid(Transform::affine(Mat3::from_cols(first, Vec3::Y, first.cross(Vec3::Y)), at))
}

/// All leaves of a part put into a frame.
fn in_frame(frame: u16, part: Vec<Node>) -> Vec<Node> {
    part.into_iter()
        .map(|node| match node {
            Node::Leaf { solid, .. } => Node::Leaf { solid, frame },
            operator => operator,
        })
        .collect()
}

/// An upright cylinder over a point of the plane of the wheels.
fn rod(at: Vec3, radius: f32, [bottom, top]: [f32; 2]) -> Vec<Node> {
    leaf(valid(CappedCylinder::new(
        at + bottom * Vec3::Y,
        at + top * Vec3::Y,
        Vec3::Y,
        radius,
    )))
}

/// An upright cone without its tip around the origin.
fn taper(radii: [f32; 2], [bottom, top]: [f32; 2]) -> Vec<Node> {
    leaf(valid(CappedCone::new(bottom * Vec3::Y, top * Vec3::Y, Vec3::Y, radii[0], radii[1])))
}

fn leaf(solid: impl Into<Leaf>) -> Vec<Node> {
    vec![Node::leaf(solid.into())]
}

/// The rods around a pitch circle: `offset` 0 for the pins of a wheel, a half for the holes between them.
fn teeth(count: u32, offset: f32, play: f32, heights: [f32; 2]) -> impl Iterator<Item = Vec<Node>> {
    let pitch = count as f32 * MODULE;
    let radius = pitch * sinf(PI / (2 * count) as f32) - play;
    (0..count).map(move |number| rod(pitch * around((number as f32 + offset) * TAU / count as f32), radius, heights))
}

/// A wheel with teeth outside and a bevel on top.
fn wheel(count: u32) -> Vec<Node> {
    let [bottom, top] = WHEELS;
    let pitch = count as f32 * MODULE;
    let body = joined(
        Node::Union,
        [rod(Vec3::ZERO, pitch, WHEELS)].into_iter().chain(teeth(count, 0.0, PLAY, WHEELS)),
    );
    let cut = joined(
        Node::Difference,
        [body].into_iter().chain(teeth(count, 0.5, 0.0, [bottom - 0.1, top + 0.1])),
    );
    let bevel = taper([pitch + 0.1 + (top - bottom), pitch + 0.1], WHEELS);
    joined(Node::Intersection, [cut, bevel])
}

/// A planet: a wheel with a hollowed face, a hub and five holes, on its pin.
fn planet() -> Vec<Node> {
    let [bottom, top] = WHEELS;
    let face = joined(Node::Difference, [wheel(TEETH[1]), rod(Vec3::ZERO, 1.12, [top - 0.22, top + 0.1])]);
    let hub = joined(Node::Union, [face, rod(Vec3::ZERO, 0.46, [bottom, top + 0.02])]);
    let holes = (0..5).map(|number| rod(0.79 * around((number as f32 + 0.5) * TAU / 5.0), 0.22, [bottom - 0.1, top + 0.1]));
    let wheel = joined(Node::Difference, [hub].into_iter().chain(holes));
    let pin = [
        rod(Vec3::ZERO, 0.3, [bottom, top + 0.2]),
        taper([0.3, 0.22], [top + 0.2, top + 0.28]),
        rod(Vec3::ZERO, 0.7, [bottom - 0.2, bottom - 0.02]),
    ];
    joined(Node::Union, [wheel].into_iter().chain(pin))
}

/// The sun on its shaft, which has a bevel and a keyway.
fn sun() -> Vec<Node> {
    let [bottom, top] = WHEELS;
    let height = top + 1.5;
    let shaft = joined(
        Node::Union,
        [
            rod(Vec3::ZERO, 0.58, [bottom - 0.2, height - 0.1]),
            taper([0.58, 0.48], [height - 0.1, height]),
        ],
    );
    let key = leaf(valid(Cuboid::new(vec3(-0.14, top + 0.35, -0.9), vec3(0.14, height + 0.1, -0.36))));
    let bore = rod(Vec3::ZERO, 0.2, [height - 0.6, height + 0.1]);
    joined(Node::Union, [wheel(TEETH[0]), joined(Node::Difference, [shaft, key, bore])])
}

/// The housing with the ring's teeth, without a quarter.
fn housing() -> Vec<Node> {
    let [bottom, top] = WHEELS;
    let heights = [bottom - 0.1, top + 0.12];
    let pitch = TEETH[2] as f32 * MODULE;
    let wall = joined(
        Node::Difference,
        [
            joined(
                Node::Intersection,
                [rod(Vec3::ZERO, 5.0, [0.2, heights[1]]), taper([5.95, 4.92], [0.2, heights[1]])],
            ),
            rod(Vec3::ZERO, pitch, [0.3, heights[1] + 0.1]),
        ],
    );
    let pins = in_frame(
        RING_FRAME,
        joined(Node::Union, teeth(TEETH[2], 0.0, PLAY, [0.2, heights[1] - 0.08])),
    );
    let body = joined(Node::Union, [wall, pins]);
    let holes = teeth(TEETH[2], 0.5, 0.0, [0.3, heights[1] + 0.1]).map(|hole| in_frame(RING_FRAME, hole));
    let ring = joined(Node::Difference, [body].into_iter().chain(holes));
    let quarter = leaf(valid(Cuboid::new(vec3(0.0, 0.3, 0.0), vec3(9.0, 9.0, 9.0))));
    joined(Node::Difference, [ring, in_frame(CUT_FRAME, quarter)])
}

/// What the gear stands on: a flange, the table, and the bolts that hold it.
fn base() -> Vec<Node> {
    let flange = rod(Vec3::ZERO, 5.75, [0.0, 0.3]);
    let table = leaf(valid(HalfSpace::new(Vec3::ZERO, Vec3::Y)));
    let bolts = (0..BOLTS).map(|number| {
        let at = 5.38 * around((number as f32 + 0.5) * TAU / BOLTS as f32);
        joined(Node::Difference, [rod(at, 0.2, [0.3, 0.5]), rod(at, 0.1, [0.4, 0.6])])
    });
    joined(Node::Union, [flange, table].into_iter().chain(bolts))
}

#[cfg(test)]
mod tests {
    use super::{BOLTS, MODULE, PLANETS, Part, TEETH, around, part_of, place, planetary};
    use anyhow::Result;
    use glam::Vec3;

    #[test]
    fn the_leaves_are_counted_right() -> Result<()> {
        let leaves = planetary().program()?.leaves() as u32;
        let of = |part: Part| (0..leaves).filter(|&leaf| part_of(leaf) == part).count() as u32;
        assert_eq!(of(Part::Bolt), 2 * BOLTS);
        assert_eq!(of(Part::Shaft), 3 * PLANETS + 4);
        assert_eq!([of(Part::Cut), of(Part::Table)], [1, 1]);
        assert_eq!(part_of(leaves), Part::Bolt);
        Ok(())
    }

    #[test]
    fn the_wheels_can_stand_there() {
        let [sun, planet, ring] = TEETH;
        assert_eq!(ring, sun + 2 * planet);
        assert_eq!((sun + ring) % PLANETS, 0);
    }

    #[test]
    fn teeth_touch_nowhere() -> Result<()> {
        // Through the middle of the wheels' height, around the circles where they mesh, there is a gap between any two wheels.
        let scene = planetary();
        let program = scene.program()?;
        let [sun, planet, _] = TEETH.map(|teeth| teeth as f32 * MODULE);
        let part = |at: Vec3| -> Result<Option<Part>> {
            let ray = gsdf_nostd::Ray::new(at, Vec3::Y)?;
            let mut spans = vec![gsdf_nostd::Span::EMPTY; program.leaves()];
            let hit = program.along(ray, &mut spans)?.cast();
            Ok(hit.filter(|hit| !hit.entering).map(|hit| part_of(hit.leaf)))
        };
        for number in 0..PLANETS {
            for (radius, inner) in [(sun, Part::Sun), (sun + 2.0 * planet, Part::Planet)] {
                // Outward across the pitch point: first the inner wheel, then a gap, then the other.
                let mut gaps = 0;
                let mut before = Some(inner);
                for step in -40..=40 {
                    let at = (radius + 0.006 * step as f32) * around(place(number)) + 0.8 * Vec3::Y;
                    let here = part(at)?;
                    gaps += u32::from(here.is_none() && before.is_some());
                    before = here;
                }
                assert_eq!(gaps, 1, "planet {number} at {radius}");
            }
        }
        Ok(())
    }
}
