//! What it takes to be a leaf of a program.

use super::HalfSpace;
use crate::ray::{Line, Ray, is_in_range};
use crate::real::{Mask, Real};
use crate::span::Span;
use crate::toward::Toward;
use crate::transform::Transform;
use crate::vec3::V3;
use glam::Vec3;

/// A convex solid: what a program's leaves are.
///
/// A ray meets a convex solid in one span, so each solid has one closed form, in three stages: what depends on the
/// ray's origin alone ([`seen_from`](Solid::seen_from)), what depends on its direction alone ([`Toward`]), and the
/// rest ([`span`](Solid::span)). Rays of a pinhole camera share their origin, so the first stage runs once per image.
///
/// Each formula is generic over the arithmetic and written once: scalar, double and packet queries run the same text.
///
/// # Writing your own
/// Implement the required methods for a `Copy` type and put it in a [`leaf_set!`](crate::leaf_set!). The contract, on
/// which theorems and packets rely: spans are half-open and come from [`Span::between`] or its kin (no NaN; empty
/// where a ray only touches); every arithmetic operation is one of [`Real`]'s; `span` depends on nothing but its
/// arguments. Pictures of it are certified ten times as fast where it can be [`grown`](Solid::grown); that asks of it to keep
/// the [promise](crate#accuracy) of all solids.
pub trait Solid: Copy {
    /// What of the solid depends on the ray's origin alone.
    type Seen<T: Real>: Copy;

    /// The standard signed distance from `p` to the surface, negative inside: exact up to rounding, and never too
    /// large in magnitude.
    fn distance<T: Real>(&self, p: V3<T>) -> T;

    /// The solid as seen from `origin`.
    fn seen_from<T: Real>(&self, origin: V3<T>) -> Self::Seen<T>;

    /// What was computed once, in one lane's arithmetic, for all lanes of the arithmetic of `like`.
    fn lift<T: Real>(seen: &Self::Seen<T::Scalar>, like: T) -> Self::Seen<T>;

    /// The solid as seen from an origin that lies *on* those of its faces which `ground` names.
    ///
    /// There the ray starts at the root 0 exactly, and its direction alone decides whether it starts inside.
    fn grounded<T: Real>(&self, seen: Self::Seen<T>, ground: &Ground<T>) -> Self::Seen<T>;

    /// The parameters at which the ray is inside: enters at `enter`, leaves at `exit`, is in on the half-open span
    /// between.
    fn span<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>) -> Span<T>;

    /// The surface at `t`, which is an end of [`span`](Solid::span), bit for bit.
    fn surface<T: Real>(&self, seen: &Self::Seen<T>, toward: &Toward<T>, t: T) -> Surface<T>;

    /// A box around the solid, or `None` where it is unbounded.
    fn bounds(&self) -> Option<Bounds>;

    /// The solid with its surface moved outward by a length, or inward by a negative one: around all points within the length of
    /// it, or within all that are not that near to its surface. To a rounding of its parameters. `None` where nothing is left of
    /// it, what there is has no such parameters, or nobody has said.
    #[inline]
    fn grown(&self, _by: f32) -> Option<Self> {
        None
    }

    /// The solid a little larger, and a little smaller: along any ray that starts within `reach` of the origin of the world the
    /// exact span lies between those that are computed of these two in the same pose, in `f32`. That follows from what is
    /// [promised](crate#accuracy) of every surface, and is `None` where the solid has no bounds or cannot be
    /// [grown](Self::grown).
    ///
    /// Two spans without errors are less work than one that [knows](crate::Bounded) its own: see [`Span::within`].
    #[inline]
    fn between(&self, reach: f32, pose: Option<&Transform>) -> Option<[Self; 2]> {
        let bounds = self.bounds()?;
        let farthest = bounds.min.abs().max(bounds.max.abs()).length();
        let (reach, off) = match pose {
            Some(pose) => ((reach + pose.origin().length()) / pose.stretch(), pose.off(reach, farthest)),
            None => (reach, 0.0),
        };
        let by = (reach + 2.0 * farthest) * BETWEEN + 2.0 * off;
        Some([self.grown(by)?, self.grown(-by)?])
    }

    /// The solid, if it is a half-space: it has no bounds, but an evaluator can leave it out for rays that never meet it.
    #[inline]
    fn as_half_space(&self) -> Option<HalfSpace> {
        None
    }

    /// Whether its formulas look at [`Toward::per_component`]. Where no solid of a scene does, an evaluator may leave the
    /// three divisions out ([`Toward::without_components`]).
    #[inline]
    fn divides_by_components(&self) -> bool {
        true
    }

    /// [`seen_from`](Solid::seen_from) and [`span`](Solid::span) in one.
    #[inline(always)]
    fn span_along<T: Real>(&self, line: &Line<T>) -> Span<T> {
        if T::INLINED {
            self.span(&self.seen_from(line.origin), &line.toward)
        } else {
            span_apart(self, line)
        }
    }

    /// [`span_along`](Solid::span_along) for a solid that a transform has put into the world, and a line there.
    #[inline(always)]
    fn span_in_world<T: Real>(&self, line: &Line<T>, pose: Option<&Transform>) -> Span<T> {
        let local = match pose {
            Some(pose) => Some(pose.line_to_local(line)),
            None => None,
        };
        // One place where the formula stands, and no copy of a line in the world.
        let own = self.span_along(match &local {
            Some(local) => &local.line,
            None => line,
        });
        match &local {
            Some(local) => local.span_in_world(own),
            None => own,
        }
    }

    /// [`lift`](Solid::lift) and [`span`](Solid::span) in one: what a choice of solids does without a view that has room
    /// for the largest of them.
    #[inline(always)]
    fn span_lifted<T: Real>(&self, seen: &Self::Seen<T::Scalar>, toward: &Toward<T>) -> Span<T> {
        self.span(&Self::lift(seen, toward.vv), toward)
    }

    /// [`lift`](Solid::lift) and [`surface`](Solid::surface) in one.
    #[inline(always)]
    fn surface_lifted<T: Real>(&self, seen: &Self::Seen<T::Scalar>, toward: &Toward<T>, t: T) -> Surface<T> {
        self.surface(&Self::lift(seen, toward.vv), toward, t)
    }

    /// [`seen_from`](Solid::seen_from) and [`surface`](Solid::surface) in one.
    #[inline(always)]
    fn surface_along<T: Real>(&self, line: &Line<T>, t: T) -> Surface<T> {
        self.surface(&self.seen_from(line.origin), &line.toward, t)
    }

    /// The spans along many lines, given one by one to `each` with the number of the line: those of `lines` whose bits are
    /// set in `which`, in ascending order. Where all lines start at one origin, `seen` is the solid as seen from there.
    ///
    /// A choice of solids chooses once for all lines.
    #[inline(always)]
    fn spans<T: Real>(
        &self,
        seen: Option<&Self::Seen<T::Scalar>>,
        lines: &[Line<T>; u32::BITS as usize],
        which: u32,
        mut each: impl FnMut(usize, Span<T>),
    ) {
        let mut bits = which;
        while bits != 0 {
            let number = bits.trailing_zeros() as usize % lines.len();
            bits &= bits - 1;
            let line = &lines[number];
            let seen = self.seen_or(seen, line);
            each(number, self.span(&seen, &line.toward));
        }
    }

    /// The [`surface`](Solid::surface) at `t` on a line from whose origin the solid may have been seen already.
    #[inline(always)]
    fn surface_on<T: Real>(&self, seen: Option<&Self::Seen<T::Scalar>>, line: &Line<T>, t: T) -> Surface<T> {
        self.surface(&self.seen_or(seen, line), &line.toward, t)
    }

    /// What was seen, for all lanes; or the solid as seen from the origin of a line.
    #[doc(hidden)]
    #[inline(always)]
    fn seen_or<T: Real>(&self, seen: Option<&Self::Seen<T::Scalar>>, line: &Line<T>) -> Self::Seen<T> {
        match seen {
            Some(seen) => Self::lift(seen, line.toward.vv),
            None => self.seen_from(line.origin),
        }
    }

    /// The standard signed distance function `φ(p)`: how far from `p` to the nearest point of the surface, negative
    /// inside; NaN unless `p` is finite and within ±2^30.
    #[must_use]
    fn sdf(&self, p: Vec3) -> f32 {
        if is_in_range(p) { self.distance(V3::from(p)) } else { f32::NAN }
    }

    /// The generalized signed distance function `φ_G(v, p)`: how far from `p` along `v` to the next crossing of the
    /// surface, positive outside, negative inside, infinite where there is none; NaN unless the two make a [`Ray`].
    ///
    /// In units of the length of `v`: a distance where `v` is of unit length.
    #[must_use]
    fn gsdf(&self, p: Vec3, v: Vec3) -> f32 {
        match Ray::new(p, v) {
            Ok(ray) => ray.signed_crossing(self.span_along(&ray.line(0.0_f32))),
            Err(_) => f32::NAN,
        }
    }
}

/// By what [`Solid::between`] grows a solid, as a share of the distance at which the ray starts and of twice that of the
/// farthest point of the solid: 32 units roundoff.
///
/// Rounding moves a surface by 8 units of all that meets at a crossing, which is at most twice these two: the solid's points of
/// definition and its radius are both within its farthest point, and the ray travels no farther than from its start to there. That
/// is 16 units. As many more are what the larger and the smaller solid may seem to be smaller and larger themselves, and leave
/// the crossing in `f64` between them with all that [`IN_DOUBLES`](crate::IN_DOUBLES) needs.
const BETWEEN: f32 = 32.0 / 16_777_216.0;

/// [`Solid::span_along`] as a function of its own, of which one copy is enough.
#[inline]
fn span_apart<T: Real, L: Solid>(solid: &L, line: &Line<T>) -> Span<T> {
    solid.span(&solid.seen_from(line.origin), &line.toward)
}

/// [`Solid::span_along`] where it is not expected to be asked for, apart in every arithmetic.
#[inline(always)]
pub(crate) fn span_unseen<T: Real, L: Solid>(solid: &L, line: &Line<T>) -> Span<T> {
    if T::INLINED {
        span_apart(solid, line)
    } else {
        solid.span_along(line)
    }
}

/// [`Solid::surface_along`] where it is not expected to be asked for: as a function of its own where otherwise all of it
/// would be inlined.
#[inline(always)]
pub(crate) fn surface_unseen<T: Real, L: Solid>(solid: &L, line: &Line<T>, t: T) -> Surface<T> {
    if T::INLINED {
        surface_apart(solid, line, t)
    } else {
        solid.surface_along(line, t)
    }
}

/// [`Solid::surface_along`] as a function of its own.
#[inline]
fn surface_apart<T: Real, L: Solid>(solid: &L, line: &Line<T>, t: T) -> Surface<T> {
    solid.surface(&solid.seen_from(line.origin), &line.toward, t)
}

/// A point of a surface, as a ray that crosses it there sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surface<T> {
    /// The unit normal, outward from the solid.
    pub normal: V3<T>,
    /// The number of the face, from 0, as a number of the arithmetic.
    pub face: T,
}

impl<T: Real> Surface<T> {
    /// The surface of a face of this number.
    #[inline(always)]
    pub(crate) fn of_face(number: f32, normal: V3<T>) -> Self {
        Self {
            normal,
            face: normal.x.splat_like(number),
        }
    }

    /// `self` where the mask is true, `other` elsewhere.
    #[inline(always)]
    #[must_use]
    pub fn or_else(self, mask: T::Mask, other: Self) -> Self {
        Self {
            normal: V3::select(mask, self.normal, other.normal),
            face: T::select(mask, self.face, other.face),
        }
    }
}

/// What an origin is known to lie on: the face a ray leaves, and every face as near as rounding can tell.
#[derive(Clone, Copy, Debug)]
pub struct Ground<T> {
    /// How far from a surface the origin may seem to be, by rounding alone, when it is on it; a length in the solid's
    /// frame.
    pub tolerance: T,
    /// The number of the face the origin is known to lie on, or -1.
    pub face: T,
}

impl<T: Real> Ground<T> {
    /// `offset`, a measure of how far the origin is from face number `face`, or zero where the origin lies on that
    /// face. `scale` is by what `offset` exceeds a distance near the surface, `size` the extent of the solid, which
    /// adds to the rounding error.
    #[inline(always)]
    pub fn settle(&self, face: f32, offset: T, scale: T, size: T) -> T {
        let zero = offset.splat_like(0.0);
        let within = self.tolerance + size * offset.splat_like(Self::ROUNDING);
        let on = offset.abs().le(scale * within) | self.face.eq(self.face.splat_like(face));
        T::select(on, zero, offset)
    }

    /// The same ground for a part of the solid whose own faces are counted from `first` on.
    #[inline(always)]
    pub(crate) fn of_part(&self, first: f32) -> Self {
        Self {
            face: self.face - self.face.splat_like(first),
            ..*self
        }
    }

    /// How many times the extent a computed offset can be off by rounding: 32 units roundoff of `f32`.
    pub(crate) const ROUNDING: f32 = 32.0 / 16_777_216.0;
}

/// A box whose faces are parallel to the coordinate planes, and which holds a solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the least coordinates.
    pub min: Vec3,
    /// The corner with the greatest coordinates.
    pub max: Vec3,
}

impl Bounds {
    /// The bounds of the points within `reach` of a centre, coordinate by coordinate, rounded outward.
    #[must_use]
    pub fn around(center: Vec3, reach: Vec3) -> Self {
        let outward = |v: f32, towards: f32| if towards < 0.0 { v.next_down() } else { v.next_up() };
        let (low, high) = (center - reach, center + reach);
        Self {
            min: Vec3::new(outward(low.x, -1.0), outward(low.y, -1.0), outward(low.z, -1.0)),
            max: Vec3::new(outward(high.x, 1.0), outward(high.y, 1.0), outward(high.z, 1.0)),
        }
    }

    /// The least box around both.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        Self {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// The bounds of a disc with a unit normal.
    #[must_use]
    pub(crate) fn of_disc(center: Vec3, normal: Vec3, radius: f32) -> Self {
        // A disc reaches r sqrt(1 - n_i²) along axis i; n is of unit length to 2^-21, so a millionth more is enough.
        let reach = |n: f32| radius * 1.000_001 * libm::sqrtf(Real::max(1.000_001 - n * n, 0.0));
        Self::around(center, Vec3::new(reach(normal.x), reach(normal.y), reach(normal.z)))
    }
}

/// Whether a mask holds in no lane.
#[inline(always)]
pub(crate) fn nowhere<M: Mask>(mask: M) -> bool {
    !mask.any()
}
