//! Packets that say how sure they are.

use crate::lanes::{LaneMask, Lanes};
use crate::packet::{Packet, enough};
use gsdf_nostd::{Anywhere, Bounded, Certificate, Line, Program, ProgramError, Solid, Span, Toward, V3, certify};

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
        let exact = |v: V3<T>| V3::new(Bounded::exact(v.x), Bounded::exact(v.y), Bounded::exact(v.z));
        let Line { origin, toward } = self.line();
        let line = Line {
            origin: exact(*origin),
            toward: Toward::new(exact(toward.v)),
        };
        program.spans_along(&line, Anywhere, spans);
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
