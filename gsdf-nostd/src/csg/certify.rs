//! Crossings that are certain: the march over spans whose ends know how wrong they may be.

use super::node::Node;
use super::sweep::sweep;
use crate::bounded::Bounded;
use crate::real::{Mask, Real};
use crate::span::Span;

/// The first crossing of a program's boundary beyond some parameter, as far as an arithmetic can tell.
#[derive(Clone, Copy, Debug)]
pub struct Certificate<T: Real> {
    /// Where it is; infinite where there is none.
    pub t: Bounded<T>,
    /// The number of the leaf whose surface is crossed; infinite where there is none.
    pub leaf: T,
    /// Whether it is the entry of that leaf's span, or the exit.
    pub at_enter: T::Mask,
    /// Whether the ray is inside at the start.
    pub inside: T::Mask,
    /// Whether all that is certain: which root comes first, whether it changes membership, and that nothing else does so
    /// before or as near as the bounds reach. Where it is not, the rest means nothing.
    pub sure: T::Mask,
    /// How many sweeps it took, in the slowest lane.
    pub sweeps: u32,
}

/// What is known of the roots within a window.
struct Within<T: Real> {
    count: T,
    leaf: T,
    at_enter: T::Mask,
}

/// The roots of all leaves that may lie from `low` to `high`.
#[inline(always)]
fn roots_within<T: Real>(spans: &[Span<Bounded<T>>], low: T, high: T) -> Within<T> {
    let (zero, one) = (low.splat_like(0.0), low.splat_like(1.0));
    let mut within = Within {
        count: zero,
        leaf: zero.splat_like(f32::INFINITY),
        at_enter: low.lt(low),
    };
    let mut number = zero;
    for span in spans {
        for (end, is_enter) in [(span.enter, true), (span.exit, false)] {
            let (least, most) = end.ends();
            // NaN, where nothing is known of an end, is everywhere.
            let here = !(high.lt(least) | most.lt(low));
            within.count = T::select(here, within.count + one, within.count);
            within.leaf = T::select(here, number, within.leaf);
            within.at_enter = (here & here.splat_like(is_enter)) | (!here & within.at_enter);
        }
        number = number + one;
    }
    within
}

/// Marches from `start >= 0` to the first crossing of the program's boundary, from window to window: each step ends just
/// beyond the reach of a root, where comparisons with it are certain again.
///
/// A window that holds a single root is passed for certain: on both sides of it membership is known, and what is between can
/// change only there. Where it holds several their order is not certain, and nothing is.
#[inline(always)]
pub fn certify<T: Real, L>(nodes: &[Node<L>], spans: &[Span<Bounded<T>>], start: T) -> Certificate<T> {
    let zero = Bounded::exact(start.splat_like(0.0));
    let infinity = start.splat_like(f32::INFINITY);
    let first = sweep(nodes, spans, Bounded::exact(start));
    let inside = first.lt(zero);
    let mut certificate = Certificate {
        t: first.abs(),
        leaf: infinity,
        at_enter: inside.yes,
        inside: inside.yes,
        sure: inside.sure,
        sweeps: 1,
    };
    let ahead = |t: Bounded<T>| !(t.value.eq(infinity) & t.error.eq(zero.value));
    let mut running = certificate.sure & ahead(certificate.t);
    while running.any() {
        let (low, high) = certificate.t.ends();
        let within = roots_within(spans, low, high);
        let next = sweep(nodes, spans, Bounded::exact(high.next_up()));
        certificate.sweeps += 1;
        let outside = next.lt(zero);
        let known = high.lt(infinity) & within.count.eq(start.splat_like(1.0)) & outside.sure;
        certificate.sure = certificate.sure & (known | !running);
        running = running & known;
        let turned = running & outside.yes.differs_from(inside.yes);
        certificate.leaf = T::select(turned, within.leaf, certificate.leaf);
        certificate.at_enter = (turned & within.at_enter) | (!turned & certificate.at_enter);
        running = running & !turned;
        certificate.t = Bounded {
            value: T::select(running, next.value.abs(), certificate.t.value),
            error: T::select(running, next.error, certificate.t.error),
        };
        running = running & ahead(certificate.t);
    }
    certificate
}
