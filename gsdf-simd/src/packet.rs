//! Eight rays at once.

use crate::lanes::{F32x8, Mask8};
use glam::Vec3;
use gsdf_nostd::{
    Anywhere, Encounter, Field, Footing, Hit, Line, MAX_LENGTH, MAX_SPEED, Mask, Program, ProgramError, Raster, Ray, Real, Solid, Span,
    SphereTracer, Surface, Toward, Traced, V3, march,
};

/// Up to eight rays, each with its own origin, direction and range; a mask says which lanes hold one.
///
/// Lanes without a ray cost nothing more and hit nothing.
#[derive(Clone, Copy, Debug)]
pub struct Packet {
    /// The lines, with directions scaled, exactly, to a largest component in [1, 2).
    line: Line<F32x8>,
    /// By what the directions were scaled.
    scale: F32x8,
    /// Where the ranges start, in the parameter of `line`. Lanes without a ray start at the end of all things.
    start: F32x8,
    /// Where they end, in the parameter of the rays, as single rays compare it.
    end: F32x8,
    valid: Mask8,
}

/// What eight rays hit first.
#[derive(Clone, Copy, Debug)]
pub struct Hits {
    /// The parameters of the rays, infinite where they hit nothing.
    pub t: F32x8,
    /// Which rays hit something.
    pub hit: Mask8,
    /// The leaves and surfaces hit, and on which side; meaningless elsewhere.
    pub met: Encounter<F32x8>,
    /// How many sweeps it took, in the slowest lane.
    pub sweeps: u32,
}

impl Hits {
    /// The hit of one lane, where `ray` is the ray that was put into it.
    #[must_use]
    pub fn lane(&self, lane: usize, ray: &Ray) -> Option<Hit> {
        let of = |lanes: F32x8| lanes.to_array().get(lane).copied();
        let is = |mask: Mask8| mask.to_bits() >> lane & 1 == 1;
        let t = of(self.t).filter(|t| t.is_finite())?;
        let Surface { normal, face } = self.met.surface;
        let met = Encounter {
            leaf: of(self.met.leaf)?,
            entering: is(self.met.entering),
            surface: Surface {
                normal: V3::new(of(normal.x)?, of(normal.y)?, of(normal.z)?),
                face: of(face)?,
            },
        };
        Some(Hit::new(ray, t, &met))
    }
}

impl Packet {
    /// The first eight of these rays; lanes beyond them hold none.
    #[must_use]
    pub fn new(rays: &[Ray]) -> Self {
        let of = |value: fn(&Ray) -> f32, otherwise: f32| F32x8::new(core::array::from_fn(|lane| rays.get(lane).map_or(otherwise, value)));
        let origin = V3::new(
            of(|ray| ray.origin().x, 0.0),
            of(|ray| ray.origin().y, 0.0),
            of(|ray| ray.origin().z, 0.0),
        );
        let direction = V3::new(
            of(|ray| ray.direction().x, 0.0),
            of(|ray| ray.direction().y, 0.0),
            of(|ray| ray.direction().z, 0.0),
        );
        let (start, end) = (of(|ray| ray.range().start, 0.0), of(|ray| ray.range().end, 0.0));
        Self::from_lanes(origin, direction, start, end)
    }

    /// The rays through these places of a picture, over the range from 0 to infinity. Lanes in which they are none
    /// (see [`Raster::ray_through`]) hold no ray.
    #[inline(always)]
    #[must_use]
    pub fn through(raster: &Raster, x: F32x8, y: F32x8) -> Self {
        let (origin, direction) = raster.line(x, y);
        Self::from_lanes(origin, direction, F32x8::splat(0.0), F32x8::INFINITY)
    }

    /// Eight rays by their coordinates, with the ranges of their parameters. Lanes that [`Ray::new`] or
    /// [`Ray::within`] would refuse hold no ray: see [`valid`](Self::valid).
    #[inline(always)]
    #[must_use]
    pub fn from_lanes(origin: V3<F32x8>, direction: V3<F32x8>, start: F32x8, end: F32x8) -> Self {
        let within = |v: V3<F32x8>, limit: f32| {
            let limit = F32x8::splat(limit);
            v.x.abs().le(limit) & v.y.abs().le(limit) & v.z.abs().le(limit)
        };
        let largest = direction.x.abs().max(direction.y.abs()).max(direction.z.abs());
        let forward = F32x8::splat(0.0).le(start) & start.lt(end);
        let fast = F32x8::splat(1.0 / MAX_SPEED).le(largest);
        let valid = within(origin, MAX_LENGTH) & within(direction, MAX_SPEED) & fast & forward;
        // A harmless ray in the lanes without one: their numbers meet those of the others in no operation but
        // comparisons of masks.
        let [nowhere, along] = [Vec3::ZERO, Vec3::X].map(|v| V3::splat(start, v));
        let origin = V3::select(valid, origin, nowhere);
        let direction = V3::select(valid, direction, along);
        let scale = F32x8::splat(1.0) / F32x8::select(valid, largest, F32x8::splat(1.0)).power_of_two_below();
        Self {
            line: Line {
                origin,
                toward: Toward::new(direction.scaled(scale)),
            },
            scale,
            start: F32x8::select(valid, start.max(F32x8::splat(f32::MIN_POSITIVE)) / scale, F32x8::INFINITY),
            end: F32x8::select(valid, end, F32x8::NEG_INFINITY),
            valid,
        }
    }

    /// Which lanes hold a ray.
    #[must_use]
    pub fn valid(&self) -> Mask8 {
        self.valid
    }

    /// The first crossing of each ray within its range.
    ///
    /// # Errors
    /// Where `scratch` is shorter than the program has leaves.
    pub fn cast<L: Solid>(&self, program: &Program<'_, L>, scratch: &mut [Span<F32x8>]) -> Result<Hits, ProgramError> {
        Ok(self.cast_in(program, Anywhere, enough(program, scratch)?))
    }

    /// The generalized signed distance function of each ray from its origin: positive outside, negative inside,
    /// infinite where there is no crossing ahead; NaN in lanes without a ray.
    ///
    /// # Errors
    /// Where `scratch` is shorter than the program has leaves.
    pub fn gsdf<L: Solid>(&self, program: &Program<'_, L>, scratch: &mut [Span<F32x8>]) -> Result<F32x8, ProgramError> {
        let spans = enough(program, scratch)?;
        program.spans_along(&self.line, Anywhere, spans);
        let found = march(program.nodes(), spans, self.start);
        let t = found.t * self.scale;
        let signed = F32x8::select(found.inside, -t, t);
        Ok(F32x8::select(self.valid, signed, F32x8::splat(f32::NAN)))
    }

    /// Sphere tracing of each ray through its range, over the standard distance.
    #[must_use]
    pub fn trace<F: Field>(&self, tracer: &SphereTracer, field: &F) -> Traced<F32x8> {
        let traced = tracer.trace(field, &self.line, self.start, self.end / self.scale);
        Traced {
            t: traced.t * self.scale,
            ..traced
        }
    }

    /// [`cast`](Self::cast) with what is known of the origins, in scratch memory of the right length.
    #[inline(always)]
    pub(crate) fn cast_in<L: Solid, F: Footing<L, F32x8>>(&self, program: &Program<'_, L>, footing: F, spans: &mut [Span<F32x8>]) -> Hits {
        let nothing = F32x8::INFINITY;
        program.spans_along(&self.line, footing, spans);
        let found = march(program.nodes(), spans, self.start);
        let along = found.t * self.scale;
        let hit = along.lt(self.end) & along.lt(nothing);
        let t = F32x8::select(hit, found.t, nothing);
        let met = if hit.any() {
            program.surface_at(&self.line, footing, spans, t)
        } else {
            Encounter {
                leaf: nothing,
                entering: hit,
                surface: Surface {
                    normal: -self.line.toward.v,
                    face: F32x8::splat(0.0),
                },
            }
        };
        Hits {
            t: F32x8::select(hit, along, nothing),
            hit,
            met,
            sweeps: found.sweeps,
        }
    }
}

fn enough<'s, L>(program: &Program<'_, L>, scratch: &'s mut [Span<F32x8>]) -> Result<&'s mut [Span<F32x8>], ProgramError> {
    let length = scratch.len();
    scratch
        .get_mut(..program.leaves())
        .ok_or(ProgramError::ScratchTooShort(length, program.leaves()))
}

/// Scratch memory for the packets of a program with this many leaves.
#[cfg(feature = "std")]
#[must_use]
pub fn scratch(leaves: usize) -> std::vec::Vec<Span<F32x8>> {
    std::vec![EMPTY; leaves]
}

/// Eight spans without points: what scratch memory is filled with.
pub const EMPTY: Span<F32x8> = Span {
    enter: F32x8::INFINITY,
    exit: F32x8::NEG_INFINITY,
};
