//! Tiers: how much arithmetic a packet spends on its accuracy.

use crate::lanes::Lanes;
use crate::packet::{Hits, Packet, enough};
use gsdf_nostd::{Anywhere, Encounter, Line, Mask, Plain, Program, ProgramError, Real, Solid, Span, Surface, Toward, V3, march};

/// An arithmetic for packets: which numbers the rays of a packet become, and how they come back.
///
/// The formulas are the same text in every tier; rays and solids are `f32` numbers in all of them, and are taken as exact. For
/// single rays a tier is the type of the spans: [`Program::along`] with `Span<Plain<f32>>`, `Span<f32>` or `Span<f64>`, and
/// [`Program::cast_certified`].
pub trait Tier: Copy + Send + Sync + 'static {
    /// What the lanes of a packet become.
    type Number<T: Lanes>: Real;

    /// Lanes in this arithmetic, exactly.
    fn widened<T: Lanes>(lanes: T) -> Self::Number<T>;

    /// The nearest `f32` numbers.
    fn narrowed<T: Lanes>(token: T::Token, numbers: Self::Number<T>) -> T;
}

/// Textbook formulas in `f32`: see [`Plain`] for how far they hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fast;

/// Robust formulas in `f32`: what everything else in this crate computes in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Robust;

/// Robust formulas in `f64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Double;

impl Tier for Fast {
    type Number<T: Lanes> = Plain<T>;

    #[inline(always)]
    fn widened<T: Lanes>(lanes: T) -> Plain<T> {
        Plain(lanes)
    }
    #[inline(always)]
    fn narrowed<T: Lanes>(_: T::Token, numbers: Plain<T>) -> T {
        numbers.0
    }
}

impl Tier for Robust {
    type Number<T: Lanes> = T;

    #[inline(always)]
    fn widened<T: Lanes>(lanes: T) -> T {
        lanes
    }
    #[inline(always)]
    fn narrowed<T: Lanes>(_: T::Token, numbers: T) -> T {
        numbers
    }
}

impl Tier for Double {
    type Number<T: Lanes> = T::Doubles;

    #[inline(always)]
    fn widened<T: Lanes>(lanes: T) -> T::Doubles {
        lanes.to_doubles()
    }
    #[inline(always)]
    fn narrowed<T: Lanes>(token: T::Token, numbers: T::Doubles) -> T {
        T::from_doubles(token, numbers)
    }
}

impl<T: Lanes> Packet<T> {
    /// [`cast`](Self::cast) in another tier. In [`Robust`] it is the same.
    ///
    /// # Errors
    /// Where `scratch` is shorter than the program has leaves.
    #[inline(always)]
    pub fn cast_as<A: Tier, L: Solid>(
        &self,
        token: T::Token,
        program: &Program<'_, L>,
        scratch: &mut [Span<A::Number<T>>],
    ) -> Result<Hits<T>, ProgramError> {
        let spans = enough(program, scratch)?;
        let line = self.widened::<A>();
        let scale = A::widened(self.scale());
        let nothing = scale.splat_like(f32::INFINITY);
        program.spans_along(&line, Anywhere, spans);
        let found = march(program.nodes(), spans, A::widened(self.start()));
        let along = found.t.times_power(scale);
        let is_hit = along.lt(A::widened(self.end())) & along.lt(nothing);
        let t = Real::select(is_hit, found.t, nothing);
        let met = if is_hit.any() {
            program.surface_at(&line, Anywhere, spans, t)
        } else {
            Encounter {
                leaf: nothing,
                entering: is_hit,
                surface: Surface {
                    normal: -line.toward.v,
                    face: nothing.splat_like(0.0),
                },
            }
        };
        let lanes = |number| A::narrowed::<T>(token, number);
        let (zero, one) = (nothing.splat_like(0.0), nothing.splat_like(1.0));
        let truths = |mask| T::splat(token, 0.5).lt(lanes(Real::select(mask, one, zero)));
        let V3 { x, y, z } = met.surface.normal;
        let t = lanes(Real::select(is_hit, along, nothing));
        Ok(Hits {
            t,
            // What is beyond all `f32` is nothing.
            hit: t.lt(T::splat(token, f32::INFINITY)),
            met: Encounter {
                leaf: lanes(met.leaf),
                entering: truths(met.entering),
                surface: Surface {
                    normal: V3::new(lanes(x), lanes(y), lanes(z)),
                    face: lanes(met.surface.face),
                },
            },
            sweeps: found.sweeps,
        })
    }

    /// The lines of the rays, in another arithmetic.
    #[inline(always)]
    fn widened<A: Tier>(&self) -> Line<A::Number<T>> {
        let wide = |v: V3<T>| V3::new(A::widened(v.x), A::widened(v.y), A::widened(v.z));
        let Line { origin, toward } = self.line();
        Line {
            origin: wide(*origin),
            toward: Toward::new(wide(toward.v)),
        }
    }
}
