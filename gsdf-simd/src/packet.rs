//! Several rays at once: eight, or as many as another lane type has.

use crate::lanes::{F32x8, LaneMask, Lanes, MOST_LANES};
use glam::Vec3;
use gsdf_nostd::{
    Anywhere, Encounter, Field, Footing, Hit, Line, MAX_LENGTH, MAX_SPEED, Mask, Program, ProgramError, Raster, Ray, Solid, Span,
    SphereTracer, Surface, Toward, Traced, V3, march,
};

/// Up to eight rays, each with its own origin, direction and range; a mask says which lanes hold one. Other lane types
/// make packets of as many rays as they have lanes.
///
/// Lanes without a ray cost nothing more and hit nothing.
#[derive(Clone, Copy, Debug)]
pub struct Packet<T: Lanes = F32x8> {
    /// The lines, with directions scaled, exactly, to a largest component in [1, 2).
    line: Line<T>,
    /// By what the directions were scaled.
    scale: T,
    /// Where the ranges start, in the parameter of `line`. Lanes without a ray start at the end of all things.
    start: T,
    /// Where they end, in the parameter of the rays, as single rays compare it.
    end: T,
    valid: T::Mask,
}

/// What the rays of a packet hit first.
#[derive(Clone, Copy, Debug)]
pub struct Hits<T: Lanes = F32x8> {
    /// The parameters of the rays, infinite where they hit nothing.
    pub t: T,
    /// Which rays hit something.
    pub hit: T::Mask,
    /// The leaves and surfaces hit, and on which side; meaningless elsewhere.
    pub met: Encounter<T>,
    /// How many sweeps it took, in the slowest lane.
    pub sweeps: u32,
}

impl<T: Lanes> Hits<T> {
    /// The hit of one lane, where `ray` is the ray that was put into it.
    #[must_use]
    pub fn lane(&self, lane: usize, ray: &Ray) -> Option<Hit> {
        let t = self.t.lane(lane).filter(|t| t.is_finite())?;
        let Surface { normal, face } = self.met.surface;
        let met = Encounter {
            leaf: self.met.leaf.lane(lane)?,
            entering: self.met.entering.to_bits() >> lane & 1 == 1,
            surface: Surface {
                normal: V3::new(normal.x.lane(lane)?, normal.y.lane(lane)?, normal.z.lane(lane)?),
                face: face.lane(lane)?,
            },
        };
        Some(Hit::new(ray, t, &met))
    }
}

impl Packet {
    /// The first eight of these rays; lanes beyond them hold none.
    #[must_use]
    pub fn new(rays: &[Ray]) -> Self {
        Self::of((), rays)
    }
}

impl<T: Lanes> Packet<T> {
    /// The first of these rays, one for each lane; lanes beyond them hold none.
    #[inline(always)]
    #[must_use]
    pub fn of(token: T::Token, rays: &[Ray]) -> Self {
        let lanes = |value: fn(&Ray) -> f32| {
            let mut lanes = [0.0; MOST_LANES];
            for (lane, ray) in lanes.iter_mut().zip(rays) {
                *lane = value(ray);
            }
            T::load(token, &lanes)
        };
        let origin = V3::new(
            lanes(|ray| ray.origin().x),
            lanes(|ray| ray.origin().y),
            lanes(|ray| ray.origin().z),
        );
        let direction = V3::new(
            lanes(|ray| ray.direction().x),
            lanes(|ray| ray.direction().y),
            lanes(|ray| ray.direction().z),
        );
        let (start, end) = (lanes(|ray| ray.range().start), lanes(|ray| ray.range().end));
        Self::from_lanes(origin, direction, start, end)
    }

    /// The rays through these places of a picture, over the range from 0 to infinity. Lanes in which they are none
    /// (see [`Raster::ray_through`]) hold no ray.
    #[inline(always)]
    #[must_use]
    pub fn through(raster: &Raster, x: T, y: T) -> Self {
        let (origin, direction) = raster.line(x, y);
        Self::from_lanes(origin, direction, x.splat_like(0.0), x.splat_like(f32::INFINITY))
    }

    /// Rays by their coordinates, with the ranges of their parameters. Lanes that [`Ray::new`] or [`Ray::within`]
    /// would refuse hold no ray: see [`valid`](Self::valid).
    #[inline(always)]
    #[must_use]
    pub fn from_lanes(origin: V3<T>, direction: V3<T>, start: T, end: T) -> Self {
        let (zero, infinity) = (start.splat_like(0.0), start.splat_like(f32::INFINITY));
        let largest = largest(direction);
        let forward = zero.le(start) & start.lt(end);
        let fast = start.splat_like(1.0 / MAX_SPEED).le(largest);
        let valid = within(origin, MAX_LENGTH) & within(direction, MAX_SPEED) & fast & forward;
        // A harmless ray in the lanes without one: their numbers meet those of the others in no operation but
        // comparisons of masks.
        let origin = V3::select(valid, origin, V3::splat(start, Vec3::ZERO));
        let direction = V3::select(valid, direction, V3::splat(start, Vec3::X));
        let (direction, scale, length) = scaled(direction);
        Self {
            line: Line {
                origin,
                toward: Toward::new(direction),
            },
            scale,
            start: T::select(valid, (start / scale).max(earliest_on_line(length)), infinity),
            end: T::select(valid, end, -infinity),
            valid,
        }
    }

    /// The lines, by what their directions are scaled, and where they start.
    #[cfg(feature = "std")]
    #[inline(always)]
    pub(crate) fn into_parts(self) -> (Line<T>, T, T) {
        (self.line, self.scale, self.start)
    }

    /// The first ray, in every lane.
    #[cfg(feature = "std")]
    #[inline(always)]
    pub(crate) fn alone(&self) -> Self {
        let first = |lanes: T| lanes.splat_like(lanes.lane(0).unwrap_or(0.0));
        let all = |v: V3<T>| V3::new(first(v.x), first(v.y), first(v.z));
        let toward = &self.line.toward;
        Self {
            line: Line {
                origin: all(self.line.origin),
                toward: Toward {
                    v: all(toward.v),
                    vv: first(toward.vv),
                    per_vv: first(toward.per_vv),
                    per_component: all(toward.per_component),
                },
            },
            scale: first(self.scale),
            start: first(self.start),
            end: first(self.end),
            valid: self.valid.splat_like(self.valid.to_bits() & 1 == 1),
        }
    }

    /// The lines.
    #[inline(always)]
    pub(crate) fn line(&self) -> &Line<T> {
        &self.line
    }

    /// By what their directions are scaled.
    #[inline(always)]
    pub(crate) fn scale(&self) -> T {
        self.scale
    }

    /// Where the ranges start, in the parameter of the lines.
    #[inline(always)]
    pub(crate) fn start(&self) -> T {
        self.start
    }

    /// Where the ranges end, in the parameter of the rays.
    #[inline(always)]
    pub(crate) fn end(&self) -> T {
        self.end
    }

    /// Which lanes hold a ray.
    #[inline(always)]
    #[must_use]
    pub fn valid(&self) -> T::Mask {
        self.valid
    }

    /// The first crossing of each ray within its range.
    ///
    /// # Errors
    /// Where `scratch` is shorter than the program has leaves.
    #[inline(always)]
    pub fn cast<L: Solid>(&self, program: &Program<'_, L>, scratch: &mut [Span<T>]) -> Result<Hits<T>, ProgramError> {
        self.cast_in(program, Anywhere, scratch)
    }

    /// The generalized signed distance function of each ray from its origin: positive outside, negative inside,
    /// infinite where there is no crossing ahead; NaN in lanes without a ray.
    ///
    /// # Errors
    /// Where `scratch` is shorter than the program has leaves.
    #[inline(always)]
    pub fn gsdf<L: Solid>(&self, program: &Program<'_, L>, scratch: &mut [Span<T>]) -> Result<T, ProgramError> {
        let spans = enough(program, scratch)?;
        program.spans_along(&self.line, Anywhere, spans);
        let found = march(program.nodes(), spans, self.start);
        let t = found.t * self.scale;
        let signed = T::select(found.inside, -t, t);
        Ok(T::select(self.valid, signed, t.splat_like(f32::NAN)))
    }

    /// Sphere tracing of each ray through its range, over the standard distance.
    #[inline(always)]
    #[must_use]
    pub fn trace<F: Field>(&self, tracer: &SphereTracer, field: &F) -> Traced<T> {
        let traced = tracer.trace(field, &self.line, self.start, self.end / self.scale);
        Traced {
            t: traced.t * self.scale,
            ..traced
        }
    }

    /// [`cast`](Self::cast) with what is known of the origins: [`SeenFrom`](gsdf_nostd::SeenFrom) one point, where all rays
    /// of many packets start there.
    ///
    /// # Errors
    /// As `cast`.
    #[inline(always)]
    pub fn cast_in<L: Solid, F: Footing<L, T>>(
        &self,
        program: &Program<'_, L>,
        footing: F,
        scratch: &mut [Span<T>],
    ) -> Result<Hits<T>, ProgramError> {
        let spans = enough(program, scratch)?;
        let nothing = self.scale.splat_like(f32::INFINITY);
        program.spans_along(&self.line, footing, spans);
        let found = march(program.nodes(), spans, self.start);
        let along = found.t * self.scale;
        let hit = along.lt(self.end) & along.lt(nothing);
        let t = T::select(hit, found.t, nothing);
        let met = if hit.any() {
            program.surface_at(&self.line, footing, spans, t)
        } else {
            Encounter {
                leaf: nothing,
                entering: hit,
                surface: Surface {
                    normal: -self.line.toward.v,
                    face: nothing.splat_like(0.0),
                },
            }
        };
        Ok(Hits {
            t: T::select(hit, along, nothing),
            hit,
            met,
            sweeps: found.sweeps,
        })
    }
}

/// The largest magnitude of a component.
#[inline(always)]
fn largest<T: Lanes>(v: V3<T>) -> T {
    v.x.abs().max(v.y.abs()).max(v.z.abs())
}

/// A direction scaled, exactly, to a largest component in [1, 2); by what, and the inverse of that.
#[inline(always)]
pub(crate) fn scaled<T: Lanes>(direction: V3<T>) -> (V3<T>, T, T) {
    let length = largest(direction).power_of_two_below();
    let scale = length.per_power_of_two_below();
    (direction.scaled(scale), scale, length)
}

/// The least parameter on the line of a direction of this length at which a crossing counts, as
/// [`Ray::start_on_line`] has it.
#[inline(always)]
pub(crate) fn earliest_on_line<T: Lanes>(length: T) -> T {
    length.splat_like(f32::MIN_POSITIVE) * length.max(length.splat_like(1.0))
}

/// Whether every coordinate is within ±`limit`.
#[inline(always)]
fn within<T: Lanes>(v: V3<T>, limit: f32) -> T::Mask {
    let limit = v.x.splat_like(limit);
    v.x.abs().le(limit) & v.y.abs().le(limit) & v.z.abs().le(limit)
}

#[inline(always)]
pub(crate) fn enough<'s, L, T>(program: &Program<'_, L>, scratch: &'s mut [Span<T>]) -> Result<&'s mut [Span<T>], ProgramError> {
    let length = scratch.len();
    scratch
        .get_mut(..program.leaves())
        .ok_or(ProgramError::ScratchTooShort(length, program.leaves()))
}

/// Scratch memory for the packets of eight of a program with this many leaves.
#[cfg(feature = "std")]
#[must_use]
pub fn scratch(leaves: usize) -> std::vec::Vec<Span<F32x8>> {
    std::vec![EMPTY; leaves]
}

/// Eight spans without points: what scratch memory is filled with. For other lane types see [`Span::empty_like`].
pub const EMPTY: Span<F32x8> = Span {
    enter: F32x8::INFINITY,
    exit: F32x8::NEG_INFINITY,
};
