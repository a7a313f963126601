//! Solids along a line.

use super::ball::Ball;
use super::solid::{Frame, Input, Solid, Surface};
use core::cmp::Ordering;
use glam::Vec3;

/// A polynomial along the line: `square s² + linear s + constant`.
#[derive(Clone, Copy, Debug)]
struct Along {
    square: Option<Ball>,
    linear: Ball,
    constant: Ball,
}

impl Along {
    /// The polynomial of a surface along a line, from its values at three places of the line; of a plane, from that at one
    /// and its slope, which is exact where the line runs along the plane.
    fn new(surface: &Surface, line: &Sightline) -> Option<Self> {
        let along = line.along.map(Ball::from);
        if surface.is_flat {
            let linear = surface.doubled.slope(along);
            return Some(Self {
                square: None,
                linear,
                constant: linear_value(surface, line),
            });
        }
        let place = |s: f64| [0, 1, 2].map(|axis| line.start[axis] + Ball::from(s * line.along[axis]));
        let [before, constant, after] = [-1.0, 0.0, 1.0].map(|s| surface.doubled.value(place(s)));
        let square = (after + before).scaled(0.5) - constant;
        Some(Self {
            square: square.sign()?.is_ne().then_some(square),
            linear: (after - before).scaled(0.5),
            constant,
        })
    }

    fn value(&self, s: Ball) -> Ball {
        let slope = self.square.map_or(self.linear, |square| square * s + self.linear);
        slope * s + self.constant
    }

    /// Whether the line comes from inside, and its roots.
    fn roots(&self) -> Option<(bool, Vec<Ball>)> {
        let Some(square) = self.square else {
            return Some(match self.linear.sign()? {
                Ordering::Equal => (self.constant.sign()?.is_lt(), Vec::new()),
                sign => (sign.is_gt(), vec![(-self.constant).quotient(self.linear)]),
            });
        };
        let from_inside = square.sign()?.is_lt();
        let discriminant = self.linear * self.linear - (square * self.constant).scaled(4.0);
        match discriminant.sign()? {
            Ordering::Less => Some((from_inside, Vec::new())),
            // The line touches: what becomes of that is not for arithmetic that rounds.
            Ordering::Equal => None,
            Ordering::Greater => {
                let root = discriminant.sqrt();
                // The sum of two numbers of one sign; the other root follows from the product of the two.
                let sum = if self.linear.to_f64() < 0.0 {
                    root - self.linear
                } else {
                    -(root + self.linear)
                };
                sum.sign().filter(|sign| sign.is_ne())?;
                let roots = vec![sum.quotient(square.scaled(2.0)), self.constant.scaled(2.0).quotient(sum)];
                Some((from_inside, roots))
            }
        }
    }
}

/// A line in the units of a solid: `t = nearest + step s`, and the point there is `start + s along`.
#[derive(Clone, Copy, Debug)]
struct Sightline {
    nearest: f64,
    step: f64,
    start: [Ball; 3],
    along: [f64; 3],
}

/// The value of a polynomial of degree one at the start of a line.
fn linear_value(surface: &Surface, line: &Sightline) -> Ball {
    surface.doubled.slope(line.start) + surface.doubled.constant()
}

/// What a gradient makes of coordinates that may be off either way.
fn weighed(gradient: [f64; 3], by: [f64; 3]) -> f64 {
    gradient[0].abs() * by[0] + gradient[1].abs() * by[1] + gradient[2].abs() * by[2]
}

/// The two ends of a span; [`None`] where it has no end. For a facet both are the crossing.
pub type Ends = [Option<Ball>; 2];

impl Solid {
    /// The span of the line through `origin` along `direction` that is inside, if there is one, if double-double
    /// arithmetic can tell.
    ///
    /// Of convex solids alone: where there is more than one span, nothing is told.
    #[must_use]
    pub fn along(&self, origin: Vec3, direction: Vec3) -> Option<Option<Ends>> {
        let line = self.sightline(origin, direction);
        let restricted: Vec<Along> = self
            .surfaces
            .iter()
            .map(|surface| Along::new(surface, &line))
            .collect::<Option<_>>()?;
        if let Some(plane) = self.plane {
            return self.through_plane(plane, line, &restricted);
        }
        let (mut inside, mut roots) = (0_u64, Vec::with_capacity(2 * restricted.len()));
        for (number, along) in restricted.iter().enumerate() {
            let (from_inside, found) = along.roots()?;
            inside |= u64::from(from_inside) << number;
            roots.extend(found.into_iter().map(|root| (root, number)));
        }
        roots.sort_by(|a, b| a.0.to_f64().total_cmp(&b.0.to_f64()));
        for pair in roots.windows(2) {
            (pair[1].0 - pair[0].0).sign().filter(|sign| sign.is_gt())?;
        }
        let mut was_inside = self.tree.holds(inside);
        let (mut span, mut count): (Option<Ends>, _) = (was_inside.then_some([None; 2]), i32::from(was_inside));
        for &(root, number) in &roots {
            inside ^= 1 << number;
            let is_inside = self.tree.holds(inside);
            if is_inside && !was_inside {
                span = Some([Some(line.parameter(root)), None]);
                count += 1;
            } else if let Some(span) = span.as_mut().filter(|_| was_inside && !is_inside) {
                span[1] = Some(line.parameter(root));
            }
            was_inside = is_inside;
        }
        (count <= 1).then_some(span)
    }

    /// Where the line goes through a facet.
    fn through_plane(&self, plane: usize, line: Sightline, restricted: &[Along]) -> Option<Option<Ends>> {
        let (_, roots) = restricted[plane].roots()?;
        let Some(&root) = roots.first() else {
            return Some(None);
        };
        let mut inside = 0;
        for (number, along) in restricted.iter().enumerate().filter(|&(number, _)| number != plane) {
            let sign = along.value(root).sign().filter(|sign| sign.is_ne())?;
            inside |= u64::from(sign.is_lt()) << number;
        }
        Some(self.tree.holds(inside).then(|| [Some(line.parameter(root)); 2]))
    }

    /// The condition of a crossing at `t`: the sum of `|dt/dx x|` over the numbers `x` of the ray, of the frame and of
    /// `inputs`, and no less than `|t|`. Infinite where numbers that are off by rounding errors can make the crossing any
    /// other or none: where the ray grazes a surface.
    ///
    /// `off` is by how much a crossing was found to be off, with its sign. Where several surfaces are crossed as near as
    /// that, or within rounding of where it was found, the condition is the worst of theirs: which of them bounds the solid
    /// is then a matter of rounding.
    #[must_use]
    pub fn condition(&self, ray: (Vec3, Vec3), t: Ball, off: f64, roundoff: f64, inputs: &[Input]) -> f64 {
        let line = self.sightline(ray.0, ray.1);
        let (s, off) = (-t.distance_to(line.nearest) / line.step, off / line.step);
        let here = self.condition_at(ray, &line, s, off.abs(), roundoff, inputs);
        let there = if off == 0.0 {
            0.0
        } else {
            self.condition_at(ray, &line, s + off, 0.0, roundoff, inputs)
        };
        here.max(there).max(t.to_f64().abs())
    }

    /// The worst condition of the surfaces that are crossed within `reach` of a place, or within rounding there.
    fn condition_at(
        &self,
        (origin, direction): (Vec3, Vec3),
        line: &Sightline,
        s: f64,
        reach: f64,
        roundoff: f64,
        inputs: &[Input],
    ) -> f64 {
        /// What `f64` may lose of a polynomial's value, relative to its terms.
        const NOISE: f64 = 1e-15;
        /// How many rounding errors a surface may be off.
        const ROUNDINGS: f64 = 32.0;
        let t = line.nearest + line.step * s;
        let at = [0, 1, 2].map(|axis| line.start[axis].to_f64() + s * line.along[axis]);
        let travelled = [0, 1, 2].map(|axis| line.start[axis].to_f64().abs() + (s * line.along[axis]).abs());
        let beyond = [0, 1, 2].map(|axis| at[axis] + line.along[axis]);
        let slope_of = |gradient: [f64; 3]| gradient[0] * line.along[0] + gradient[1] * line.along[1] + gradient[2] * line.along[2];
        let by_ray = self.by_ray((origin, direction), t);
        let mut worst = 0.0_f64;
        for (number, surface) in self.surfaces.iter().enumerate() {
            let gradient = surface.nearly.gradient(at);
            let (value, slope) = (surface.nearly.value(at), slope_of(gradient));
            let bend = 0.5 * (slope_of(surface.nearly.gradient(beyond)) - slope);
            let moved = weighed(gradient, by_ray);
            let rounding = ROUNDINGS * roundoff * moved + NOISE * (surface.nearly.weight(at) + weighed(gradient, travelled));
            if value.abs() > (slope.abs() + bend.abs() * reach) * reach + rounding {
                continue;
            }
            let moved = moved + self.by_solid(number, (origin, direction), t, at, inputs);
            // A slope that rounding changes by much, at the crossing or on the way to where it may as well be.
            let tilted = ROUNDINGS * roundoff * weighed(gradient, line.along.map(f64::abs));
            let bent = bend.abs() * ROUNDINGS * roundoff * moved / slope.abs();
            let condition = if (tilted + bent) * 2.0 < slope.abs() {
                moved * line.step / slope.abs()
            } else {
                f64::INFINITY
            };
            worst = worst.max(condition);
        }
        worst
    }

    /// How many rounding errors the nearest of the surfaces is from the place of a ray at `t`: by so many must the numbers be
    /// off that meet there, for the place to be on it.
    #[must_use]
    pub fn nearness(&self, ray: (Vec3, Vec3), t: f64, roundoff: f64, inputs: &[Input]) -> f64 {
        let line = self.sightline(ray.0, ray.1);
        let s = (Ball::from(t) - Ball::from(line.nearest)).scaled(1.0 / line.step);
        let place = [0, 1, 2].map(|axis| line.start[axis] + s * Ball::from(line.along[axis]));
        let at = place.map(Ball::to_f64);
        let by_ray = self.by_ray(ray, t);
        let roundings = |(number, surface): (usize, &Surface)| {
            let moved = weighed(surface.nearly.gradient(at), by_ray) + self.by_solid(number, ray, t, at, inputs);
            let value = surface.doubled.value(place).to_f64().abs();
            // Far away rounding errors are no less than the solid: that moves the place by `k u moved + (k u)² bend`.
            2.0 * value / (roundoff * (moved + (moved * moved + 4.0 * surface.nearly.bend(by_ray) * value).sqrt()))
        };
        self.surfaces.iter().enumerate().map(roundings).fold(f64::INFINITY, f64::min)
    }

    /// How far each coordinate of a place moves, in the units of the solid, when the numbers of the ray do.
    fn by_ray(&self, (origin, direction): (Vec3, Vec3), t: f64) -> [f64; 3] {
        [0, 1, 2].map(|axis| {
            let (from_origin, along) = (f64::from(origin[axis]), t * f64::from(direction[axis]));
            (from_origin.abs() + along.abs()) / self.units.scale
        })
    }

    /// How much the value of a surface changes at a place when the numbers of the solid and of its frame do.
    fn by_solid(&self, number: usize, (origin, direction): (Vec3, Vec3), t: f64, at: [f64; 3], inputs: &[Input]) -> f64 {
        let worth = |frame: &Frame| {
            let gradient = self.surfaces[number].nearly.gradient(at);
            frame.worth(gradient, origin, direction, t) / self.units.scale
        };
        let frame = self.frame.as_ref().map_or(0.0, worth);
        frame + inputs.iter().map(|input| input.0[number].value(at).abs()).sum::<f64>()
    }

    fn sightline(&self, origin: Vec3, direction: Vec3) -> Sightline {
        let (center, scale) = (self.units.center, self.units.scale);
        let (o, v) = (origin.to_array().map(f64::from), direction.to_array().map(f64::from));
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let to_center = [0, 1, 2].map(|axis| center[axis] - o[axis]);
        // Short, so that its product with the direction is exact.
        let nearest = f64::from((dot(to_center, v) / dot(v, v)) as f32);
        let nearest = if nearest.is_finite() { nearest } else { 0.0 };
        let step = (scale / dot(v, v).sqrt()).log2().round().exp2();
        let start = [0, 1, 2].map(|axis| {
            let from_center = Ball::from(o[axis]) - Ball::from(center[axis]);
            (Ball::product(nearest, v[axis]) + from_center).scaled(1.0 / scale)
        });
        Sightline {
            nearest,
            step,
            start,
            along: v.map(|component| component * step / scale),
        }
    }
}

impl Sightline {
    fn parameter(&self, s: Ball) -> Ball {
        Ball::from(self.nearest) + s.scaled(self.step)
    }
}
