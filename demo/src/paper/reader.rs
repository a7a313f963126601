//! One number per primitive, and what `min`, `max` and minus make of them.

use super::reading::Reading;
use glam::Vec3;
use gsdf_nostd::{Anywhere, Node, Program, Ray, Span, march, sweep};

/// A program to be read in any of the ways.
#[derive(Clone, Debug)]
pub struct Reader<'a> {
    program: Program<'a>,
    /// For each leaf whether it is taken away.
    taken: Vec<bool>,
}

/// A ray and the spans of a reader's leaves along it.
#[derive(Clone, Copy, Debug)]
pub struct View<'s> {
    ray: Ray,
    spans: &'s [Span<f32>],
}

impl<'a> Reader<'a> {
    /// For this program.
    #[must_use]
    pub fn new(program: Program<'a>) -> Self {
        Self {
            program,
            taken: taken(program.nodes()),
        }
    }

    /// The program.
    #[must_use]
    pub const fn program(&self) -> Program<'a> {
        self.program
    }

    /// Memory for [`along`](Self::along).
    #[must_use]
    pub fn scratch(&self) -> Vec<Span<f32>> {
        vec![Span::EMPTY; self.program.leaves()]
    }

    /// The roots of all leaves along a ray, which starts at 0: what all readings choose from. `scratch` holds as many
    /// spans as there are leaves.
    #[inline]
    pub fn along<'s>(&self, ray: Ray, scratch: &'s mut [Span<f32>]) -> View<'s> {
        self.program.spans_along(&ray.line(0.0), Anywhere, scratch);
        View { ray, spans: scratch }
    }

    /// What the composition comes to. The exact reading and the signed next crossing are negative inside; the others
    /// are whatever the numbers of the leaves make of it.
    #[inline]
    #[must_use]
    pub fn number(&self, reading: Reading, view: View<'_>) -> f32 {
        let on_line = match reading {
            Reading::Exact => {
                let found = march(self.program.nodes(), view.spans, 0.0);
                if found.inside { -found.t } else { found.t }
            }
            Reading::Next => sweep(self.program.nodes(), view.spans, 0.0),
            _ => self.composed(reading, view.spans),
        };
        view.ray.parameter_of(on_line)
    }

    /// How far ahead the reading sees a surface, if it sees one.
    ///
    /// Of the readings that are negative inside the size counts. For the others what is not positive lies behind.
    #[inline]
    #[must_use]
    pub fn seen(&self, reading: Reading, view: View<'_>) -> Option<f32> {
        let number = self.number(reading, view);
        let ahead = match reading {
            Reading::Exact | Reading::Next => number.abs(),
            _ => number,
        };
        (ahead > 0.0 && ahead < f32::INFINITY).then_some(ahead)
    }

    /// The unit normal of the first leaf that has a root at this distance, whether or not the program has a surface
    /// there.
    #[must_use]
    pub fn normal(&self, view: View<'_>, distance: f32) -> Option<Vec3> {
        let t = view.ray.parameter_on_line(distance);
        let leaves = self.program.nodes().iter().filter(|node| matches!(node, Node::Leaf { .. }));
        let (leaf, span) = leaves.zip(view.spans).find(|(_, span)| span.enter == t || span.exit == t)?;
        // A program of this leaf alone has a surface there.
        let alone = Program::new(core::slice::from_ref(leaf)).ok()?;
        let met = alone.surface_at(&view.ray.line(t), Anywhere, core::slice::from_ref(span), t);
        Some(met.surface.normal.into())
    }

    /// The numbers of the leaves, joined as the paper joins them: the minimum for a union, the maximum for an
    /// intersection, minus for a complement.
    #[inline]
    fn composed(&self, reading: Reading, spans: &[Span<f32>]) -> f32 {
        // As many operands as a program may hold at once; indices wrap, so that none is out of bounds.
        let mut stack = [f32::INFINITY; DEPTH];
        let mut top = DEPTH - 1;
        let mut leaves = spans.iter().zip(&self.taken);
        for node in self.program.nodes() {
            let last = stack[top % DEPTH];
            let below = top.wrapping_sub(1) % DEPTH;
            match node {
                Node::Leaf { solid, .. } => {
                    let Some((span, taken)) = leaves.next() else { break };
                    top = top.wrapping_add(1) % DEPTH;
                    stack[top] = reading.of_leaf(solid, *span, *taken);
                }
                Node::Union => {
                    stack[below] = stack[below].min(last);
                    top = below;
                }
                Node::Intersection => {
                    stack[below] = stack[below].max(last);
                    top = below;
                }
                Node::Difference => {
                    stack[below] = stack[below].max(-last);
                    top = below;
                }
                Node::Complement => stack[top % DEPTH] = -last,
            }
        }
        stack[top % DEPTH]
    }
}

/// The operands a program may hold at once; see [`ProgramError::TooDeep`](gsdf_nostd::ProgramError::TooDeep).
const DEPTH: usize = 32;

/// For each leaf, in order, whether an odd number of complements and right-hand sides of differences is around it.
fn taken(nodes: &[Node]) -> Vec<bool> {
    // From the end, where an operator stands before its operands, the right-hand one first.
    let mut waiting = vec![false];
    let mut taken: Vec<_> = nodes
        .iter()
        .rev()
        .filter_map(|node| {
            let around = waiting.pop()?;
            match node {
                Node::Leaf { .. } => return Some(around),
                Node::Union | Node::Intersection => waiting.extend([around, around]),
                Node::Difference => waiting.extend([around, !around]),
                Node::Complement => waiting.push(!around),
            }
            None
        })
        .collect();
    taken.reverse();
    taken
}

#[cfg(test)]
mod tests {
    use super::{Reader, taken};
    use crate::paper::cameras::{Side, cameras};
    use crate::paper::reading::Reading;
    use crate::paper::shapes::shapes;
    use anyhow::Result;
    use glam::{Vec3, vec3};
    use gsdf_nostd::{Csg, Cuboid, Cylinder, HalfSpace, Nappe, Ray, Sphere, csg};

    const INF: f32 = f32::INFINITY;

    csg! { const FLOOR = HalfSpace::new(Vec3::ZERO, Vec3::Z) }
    csg! { const BALL = Sphere::new(Vec3::ZERO, 1.0) }
    csg! { const FUNNEL = Nappe::new(Vec3::ZERO, Vec3::Z, 1.0, 1.0) }
    csg! { const PIPE = Cylinder::new(Vec3::ZERO, Vec3::Z, 1.0) }
    csg! { const AROUND_PIPE = complement(PIPE) }
    csg! { const PAIR = union(BALL, Sphere::new(Vec3::X, 1.0)) }
    csg! { const LENS = intersection(Sphere::new(Vec3::NEG_X, 1.5), Sphere::new(Vec3::X, 1.5)) }
    csg! { const BITTEN = difference(Sphere::new(Vec3::ZERO, 2.0), Sphere::new(vec3(-2.0, 0.0, 0.0), 1.5)) }
    csg! {
        const CAPSULE = union(
            intersection(Sphere::new(Vec3::Z, 1.0), complement(HalfSpace::new(Vec3::Z, Vec3::Z))),
            intersection(HalfSpace::new(Vec3::Z, Vec3::Z), PIPE, complement(HalfSpace::new(Vec3::NEG_Z, Vec3::Z))),
            intersection(Sphere::new(Vec3::NEG_Z, 1.0), HalfSpace::new(Vec3::NEG_Z, Vec3::Z))
        )
    }
    csg! { const SLAB = intersection(HalfSpace::new(Vec3::Z, Vec3::Z), HalfSpace::new(Vec3::NEG_Z, Vec3::NEG_Z)) }

    /// The numbers in the order of [`Reading::ALL`].
    fn numbers<const N: usize>(csg: &Csg<N>, origin: Vec3, direction: Vec3) -> Result<[f32; 6]> {
        let reader = Reader::new(csg.program());
        let mut scratch = reader.scratch();
        let view = reader.along(Ray::new(origin, direction)?, &mut scratch);
        Ok(Reading::ALL.map(|reading| reader.number(reading, view)))
    }

    #[test]
    fn a_plane_by_hand() -> Result<()> {
        // Two above it, down and up; two below it, up and down; and along it.
        let over = vec3(0.0, 0.0, 2.0);
        assert_eq!(numbers(&FLOOR, over, Vec3::NEG_Z)?, [2.0, -2.0, 2.0, 2.0, 2.0, 2.0]);
        assert_eq!(numbers(&FLOOR, over, Vec3::Z)?, [INF, 2.0, -2.0, INF, -INF, INF]);
        assert_eq!(numbers(&FLOOR, -over, Vec3::Z)?, [-2.0, -2.0, 2.0, 2.0, -INF, -2.0]);
        assert_eq!(numbers(&FLOOR, -over, Vec3::NEG_Z)?, [-INF, 2.0, -2.0, INF, -2.0, -INF]);
        assert_eq!(numbers(&FLOOR, over, Vec3::X)?, [INF; 6]);
        assert_eq!(numbers(&FLOOR, -over, Vec3::X)?, [-INF, -INF, -INF, INF, -INF, -INF]);
        Ok(())
    }

    #[test]
    fn a_sphere_by_hand() -> Result<()> {
        // Before it, in it but not in the middle, behind it, beside it.
        let along = |x: f32| numbers(&BALL, vec3(x, 0.0, 0.0), Vec3::X);
        assert_eq!(along(-3.0)?, [2.0; 6]);
        assert_eq!(along(0.5)?, [-0.5, -1.5, -1.5, 0.5, -1.5, -0.5]);
        assert_eq!(along(3.0)?, [INF, -4.0, -4.0, INF, -4.0, INF]);
        assert_eq!(numbers(&BALL, vec3(3.0, 0.0, 0.0), Vec3::Y)?, [INF; 6]);
        Ok(())
    }

    #[test]
    fn a_nappe_has_its_own_roots_and_none_of_the_other() -> Result<()> {
        assert_eq!(numbers(&FUNNEL, vec3(-2.0, 0.0, 1.0), Vec3::X)?, [1.0; 6]);
        assert_eq!(numbers(&FUNNEL, vec3(-2.0, 0.0, -1.0), Vec3::X)?, [INF; 6]);
        assert_eq!(numbers(&FUNNEL, vec3(0.0, 0.0, 2.0), Vec3::X)?, [-2.0, -2.0, -2.0, 2.0, -2.0, -2.0]);
        Ok(())
    }

    #[test]
    fn a_line_inside_for_ever_is_never_a_root() -> Result<()> {
        assert_eq!(numbers(&PIPE, Vec3::ZERO, Vec3::Z)?, [-INF, -INF, -INF, INF, -INF, -INF]);
        assert_eq!(numbers(&AROUND_PIPE, Vec3::ZERO, Vec3::Z)?, [INF, INF, INF, -INF, INF, INF]);
        // Outside for ever, and across: out of the pipe, into what is around it.
        assert_eq!(numbers(&AROUND_PIPE, vec3(3.0, 0.0, 0.0), Vec3::Z)?, [-INF; 6]);
        assert_eq!(numbers(&AROUND_PIPE, Vec3::ZERO, Vec3::X)?, [1.0, 1.0, 1.0, -1.0, 1.0, 1.0]);
        Ok(())
    }

    #[test]
    fn two_overlapping_spheres_from_within_one() -> Result<()> {
        // The exits are at 1.5 and 2.5, the entries at -0.5 and 0.5.
        let found = numbers(&PAIR, vec3(-0.5, 0.0, 0.0), Vec3::X)?;
        assert_eq!(found, [-2.5, -0.5, -0.5, 0.5, -0.5, -1.5]);
        Ok(())
    }

    #[test]
    fn two_spheres_apart_on_a_ray_through_both_and_through_their_intersection_never() -> Result<()> {
        let [exact, rest @ ..] = numbers(&LENS, vec3(-5.0, 1.4, 0.0), Vec3::X)?;
        assert_eq!(exact, INF);
        // The entry of the second, 6 - sqrt(1.5^2 - 1.4^2).
        let entry = 6.0 - 0.29_f32.sqrt();
        assert!(rest.iter().all(|number| (number - entry).abs() < 1e-5), "{rest:?}");
        Ok(())
    }

    #[test]
    fn a_bitten_sphere_from_the_side_of_the_bite() -> Result<()> {
        // The bite reaches from 1.5 to 4.5, the sphere from 3 to 7.
        let found = numbers(&BITTEN, vec3(-5.0, 0.0, 0.0), Vec3::X)?;
        assert_eq!(found, [4.5, 3.0, 3.0, 3.0, 3.0, 3.0]);
        // From within the bite, 1 before the end of it.
        let found = numbers(&BITTEN, vec3(-1.5, 0.0, 0.0), Vec3::X)?;
        assert_eq!(found, [1.0, 2.0, 2.0, 3.5, 1.0, 1.0]);
        Ok(())
    }

    #[test]
    fn the_capsule_as_printed() -> Result<()> {
        let direction = vec3(2.0, 0.0, -1.0) / 5.0_f32.sqrt();
        let [exact, printed, near, positive, entry, next] = numbers(&CAPSULE, vec3(-4.0, 0.0, 0.0), direction)?;
        // The lower sphere at 1.6 times the square root of 5; the cylinder, below its lower plane, at 1.5 times that.
        let close = |number: f32, times: f32| (number - times * 5.0_f32.sqrt()).abs() < 1e-5;
        assert!(close(exact, 1.6) && close(positive, 1.6), "{exact} {positive}");
        assert!([printed, near, entry, next].into_iter().all(|number| close(number, 1.5)));
        Ok(())
    }

    #[test]
    fn a_slab_tells_the_orientations_of_planes_apart() -> Result<()> {
        // From above, down: in at 1, out at 3. From within, up: out at 1, having come in at -1.
        assert_eq!(numbers(&SLAB, vec3(0.0, 0.0, 2.0), Vec3::NEG_Z)?, [1.0, -1.0, 3.0, 3.0, 1.0, 1.0]);
        assert_eq!(numbers(&SLAB, Vec3::ZERO, Vec3::Z)?, [-1.0, 1.0, 1.0, INF, -1.0, -1.0]);
        Ok(())
    }

    #[test]
    fn numbers_are_distances_where_directions_are_long() -> Result<()> {
        assert_eq!(numbers(&BALL, vec3(-3.0, 0.0, 0.0), vec3(1024.0, 0.0, 0.0))?, [2.0 / 1024.0; 6]);
        Ok(())
    }

    #[test]
    fn what_lies_behind_is_not_seen() -> Result<()> {
        let reader = Reader::new(BALL.program());
        let mut scratch = reader.scratch();
        let mut seen = |x: f32| -> Result<[Option<f32>; 6]> {
            let view = reader.along(Ray::new(vec3(x, 0.0, 0.0), Vec3::X)?, &mut scratch);
            Ok(Reading::ALL.map(|reading| reader.seen(reading, view)))
        };
        assert_eq!(seen(-3.0)?, [Some(2.0); 6]);
        assert_eq!(seen(0.5)?, [Some(0.5), None, None, Some(0.5), None, Some(0.5)]);
        assert_eq!(seen(3.0)?, [None; 6]);
        Ok(())
    }

    #[test]
    fn leaves_are_taken_away_by_complements_and_differences() {
        csg! {
            const TANGLE = difference(
                complement(BALL),
                union(PIPE, complement(difference(FLOOR, FUNNEL)))
            )
        }
        assert_eq!(taken(TANGLE.nodes()), [true, true, false, true]);
    }

    #[test]
    fn only_the_normal_of_a_root_is_known() -> Result<()> {
        let reader = Reader::new(PAIR.program());
        let mut scratch = reader.scratch();
        let view = reader.along(Ray::new(vec3(-3.0, 0.0, 0.0), vec3(2.0, 0.0, 0.0))?, &mut scratch);
        // The second sphere's entry at 3 is no surface of the union, but a root.
        assert_eq!(reader.normal(view, 1.5), Some(Vec3::NEG_X));
        assert_eq!(reader.normal(view, 2.0), Some(Vec3::X));
        assert_eq!(reader.normal(view, 1.25), None);
        Ok(())
    }

    /// Every ray of some cameras on both sides of a program's shape.
    fn each_ray(mut check: impl FnMut(&str, Side, &[f32; 6]) -> Result<()>) -> Result<()> {
        for shape in shapes() {
            let reader = Reader::new(shape.program()?);
            let mut scratch = reader.scratch();
            for side in [Side::Outside, Side::Inside] {
                for camera in cameras(&shape, side, 48, 77)? {
                    let raster = camera.raster(12, 12);
                    for pixel in 0..144 {
                        let ray = raster.ray(pixel % 12, pixel / 12)?;
                        let view = reader.along(ray, &mut scratch);
                        let numbers = Reading::ALL.map(|reading| reader.number(reading, view));
                        assert_eq!(
                            numbers[0],
                            shape.program()?.along(ray, &mut reader.scratch())?.gsdf(),
                            "{}",
                            shape.name
                        );
                        check(shape.name, side, &numbers)?;
                    }
                }
            }
        }
        Ok(())
    }

    #[test]
    fn exact_is_the_march_and_one_sweep_never_oversteps() -> Result<()> {
        each_ray(|name, side, [exact, .., next]| {
            assert_eq!(exact.is_sign_negative(), side == Side::Inside, "{name}");
            assert_eq!(exact.is_sign_negative(), next.is_sign_negative(), "{name}: {exact} {next}");
            assert!(next.abs() <= exact.abs(), "{name}: {next} after {exact}");
            let convex = ["half-space", "sphere"].contains(&name);
            // From inside also an intersection of convex leaves, and from outside on rays that hit it.
            let intersection = ["box, 6 planes", "finite cylinder", "finite cone", "sphere and sphere"].contains(&name);
            if convex || (intersection && (side == Side::Inside || exact.is_finite())) {
                assert_eq!(next, exact, "{name}");
            }
            Ok(())
        })
    }

    #[test]
    fn one_leaf_is_right_under_a_positive_root_alone_and_none_under_the_printed_sign() -> Result<()> {
        each_ray(|name, side, [exact, printed, near, positive, entry, _]| {
            let ahead = |number: f32| if number > 0.0 && number < INF { number } else { INF };
            match (name, side) {
                ("half-space", _) => {
                    assert_eq!((ahead(*near), ahead(*positive)), (exact.abs(), exact.abs()));
                    assert_ne!(ahead(*printed), exact.abs());
                }
                ("sphere", Side::Outside) => assert_eq!([printed, near, entry].map(|number| ahead(*number)), [*exact; 3]),
                ("sphere", Side::Inside) => {
                    assert!([printed, near, entry].into_iter().all(|number| *number <= 0.0));
                    assert_eq!(ahead(*positive), exact.abs());
                }
                _ => {}
            }
            Ok(())
        })
    }

    #[test]
    fn other_leaves_have_roots_too() -> Result<()> {
        csg! { const CUBE = Cuboid::new(Vec3::NEG_ONE, Vec3::ONE) }
        assert_eq!(numbers(&CUBE, vec3(-3.0, 0.0, 0.0), Vec3::X)?, [2.0; 6]);
        Ok(())
    }
}
