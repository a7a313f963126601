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

#[cfg(test)]
mod tests {
    use super::{Certificate, certify};
    use crate::bounded::Bounded;
    use crate::csg::Node;
    use crate::real::Real;
    use crate::span::Span;

    /// A span whose ends may be off by a tenth.
    fn span(enter: f32, exit: f32) -> Span<Bounded<f32>> {
        let end = |value| Bounded { value, error: 0.1 };
        Span::between(end(enter), end(exit))
    }

    const LEAF: Node<()> = Node::Leaf { solid: (), frame: 0 };

    fn union_of_two(first: Span<Bounded<f32>>, second: Span<Bounded<f32>>) -> Certificate<f32> {
        certify(&[LEAF, LEAF, Node::Union], &[first, second], 0.0)
    }

    #[test]
    fn a_root_by_itself_is_certain() {
        let found = union_of_two(span(5.0, 6.0), span(1.0, 3.0));
        assert!(found.sure && !found.inside && found.at_enter);
        assert_eq!((found.t.value, found.t.error, found.leaf), (1.0, 0.1, 1.0));
        // From within, past an entry that lies in the other solid.
        let found = certify(&[LEAF, LEAF, Node::Union], &[span(-1.0, 3.0), span(2.0, 5.0)], 0.5);
        assert!(found.sure && found.inside && !found.at_enter);
        assert_eq!((found.t.value, found.leaf), (5.0, 1.0));
        let nothing = union_of_two(span(-3.0, -1.0), span(-6.0, -5.0));
        assert!(nothing.sure && nothing.t.value == f32::INFINITY && nothing.leaf == f32::INFINITY);
    }

    #[test]
    fn roots_within_reach_of_each_other_are_not() {
        assert!(!union_of_two(span(1.0, 3.0), span(1.15, 4.0)).sure);
        assert!(union_of_two(span(1.0, 3.0), span(1.25, 4.0)).sure);
        // Not even where nothing comes of their order.
        assert!(!union_of_two(span(1.0, 2.0), span(2.1, 4.0)).inside);
        let cut = |second| certify(&[LEAF, LEAF, Node::Difference], &[span(1.0, 4.0), second], 0.0);
        assert!(!cut(span(0.5, 1.1)).sure);
        assert!(cut(span(0.5, 1.5)).sure && cut(span(0.5, 1.5)).t.value == 1.5);
    }

    #[test]
    fn a_start_within_reach_of_a_root_is_not() {
        assert!(!certify(&[LEAF], &[span(1.0, 3.0)], 1.05).sure);
        assert!(certify(&[LEAF], &[span(1.0, 3.0)], 1.2).sure);
    }

    #[test]
    fn what_may_not_be_there_matters_where_it_would_be_met() {
        // So thin that it may be empty.
        let doubtful = span(2.0, 2.1);
        assert!(!doubtful.enter.lt(doubtful.exit).sure);
        assert!(union_of_two(span(1.0, 3.0), doubtful).sure);
        assert!(!union_of_two(span(4.0, 5.0), doubtful).sure);
    }
}
