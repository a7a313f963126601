//! Packets that say how sure they are.

use crate::lanes::{LaneMask, Lanes};
use crate::packet::{Packet, enough};
use gsdf_nostd::{Anywhere, Bounded, Certificate, Program, ProgramError, Solid, Span, certify};

impl<T: Lanes> Packet<T> {
    /// What each ray crosses first, and whether that is certain: the first attempt of [`Program::cast_certified`] for all
    /// rays at once. [`Program::settle`] completes it, lane by lane ([`certificate_of`]), with the same bits as for single
    /// rays. Lanes without a ray are not certain.
    ///
    /// # Errors
    /// Where `scratch` is shorter than the program has leaves.
    #[inline(always)]
    pub fn certify<L: Solid>(&self, program: &Program<'_, L>, scratch: &mut [Span<Bounded<T>>]) -> Result<Certificate<T>, ProgramError> {
        let spans = enough(program, scratch)?;
        program.spans_along(&self.line().bounded(), Anywhere, spans);
        let found = certify(program.nodes(), spans, self.start());
        Ok(Certificate {
            sure: found.sure & self.valid(),
            ..found
        })
    }
}

/// The certificate of one ray of a packet; `None` where there is no lane of that number.
#[must_use]
pub fn certificate_of<T: Lanes>(found: &Certificate<T>, lane: usize) -> Option<Certificate<f32>> {
    let is = |mask: T::Mask| mask.to_bits() >> lane & 1 == 1;
    Some(Certificate {
        t: Bounded {
            value: found.t.value.lane(lane)?,
            error: found.t.error.lane(lane)?,
        },
        leaf: found.leaf.lane(lane)?,
        at_enter: is(found.at_enter),
        inside: is(found.inside),
        sure: is(found.sure),
        sweeps: found.sweeps,
    })
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::certificate_of;
    use crate::packet::Packet;
    use glam::{Vec3, vec3};
    use gsdf_nostd::{Anywhere, Bounded, Program, Ray, Span, Sphere, certify, csg, leaf_set};

    leaf_set! { enum Ball { Sphere(Sphere) } }

    csg! {
        const PAIR: Ball = union(Sphere::new(Vec3::ZERO, 1.0), Sphere::new(vec3(1.2, 0.1, 3.0), 0.9))
    }

    /// Certain lanes have the bits of single rays, and the others are not certain there either.
    #[test]
    fn a_lane_is_a_ray() {
        let program: Program<'_, Ball> = PAIR.program();
        let (mut certain, mut uncertain) = (0, 0);
        for row in 0..200_u16 {
            let rays: [Ray; 8] = core::array::from_fn(|lane| {
                // Half of them past the rim of the first ball, which they reach eleven times as far from the axis.
                let x = if lane % 2 == 0 {
                    f32::from(row) * 0.02 - 2.0
                } else {
                    (1.0 + (f32::from(row) - 100.0) * 1e-6) / 11.0
                };
                Ray::new(vec3(x, 0.0, -1e3), vec3(x * 0.01, 0.0, 1.0)).unwrap()
            });
            let empty = Span::empty_like(Bounded::exact(crate::F32x8::splat(0.0)));
            let found = Packet::new(&rays).certify(&program, &mut [empty; 2]).unwrap();
            for (lane, ray) in rays.iter().enumerate() {
                let mut spans = [Span::empty_like(Bounded::exact(0.0_f32)); 2];
                program.spans_along(&ray.line(0.0).bounded(), Anywhere, &mut spans);
                let alone = certify(program.nodes(), &spans, ray.start_on_line(0.0));
                let own = certificate_of(&found, lane).unwrap();
                assert_eq!(own.sure, alone.sure, "{ray:?}");
                if alone.sure {
                    certain += 1;
                    assert_eq!((own.t, own.leaf, own.inside), (alone.t, alone.leaf, alone.inside), "{ray:?}");
                } else {
                    uncertain += 1;
                }
            }
        }
        assert!(certain > 500 && uncertain > 0, "{certain} certain, {uncertain} not");
    }
}
