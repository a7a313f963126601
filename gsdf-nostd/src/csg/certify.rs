//! Crossings that are certain: the march over spans whose ends know how wrong they may be.

use super::node::Node;
use super::sweep::sweep_values;
use crate::bounded::{Bounded, SLACK, WithError};
use crate::real::{Lane, Mask, Real};
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

/// The surroundings of a root: how far it may be off, and whose it is.
struct Window<T: Real> {
    reach: T,
    leaf: T,
    at_enter: T::Mask,
}

/// By how much the ends at `t` may be off, and the last of them.
#[inline(always)]
fn window_at<T: Real, const ALWAYS: bool>(spans: &[Span<WithError<T, ALWAYS>>], t: T) -> Window<T> {
    let (zero, one) = (t.splat_like(0.0), t.splat_like(1.0));
    let mut window = Window {
        reach: zero,
        leaf: zero.splat_like(f32::INFINITY),
        at_enter: t.lt(t),
    };
    let mut number = zero;
    for span in spans {
        let (enters, exits) = (span.enter.value.eq(t), span.exit.value.eq(t));
        let error = T::select(enters, span.enter.error, zero) + T::select(exits, span.exit.error, zero);
        window.reach = window.reach + error;
        window.leaf = T::select(enters | exits, number, window.leaf);
        window.at_enter = enters | (window.at_enter & !exits);
        number = number + one;
    }
    window
}

/// How many ends may be within `reach` of `t`.
#[inline(always)]
fn ends_near<T: Real, const ALWAYS: bool>(spans: &[Span<WithError<T, ALWAYS>>], t: T, reach: T) -> T {
    let (zero, one, slack) = (t.splat_like(0.0), t.splat_like(1.0), t.splat_like(SLACK));
    let mut count = zero;
    for span in spans {
        for end in [span.enter, span.exit] {
            // NaN, where nothing is known of an end, is near to everything.
            let apart = (end.error * slack + reach).lt((end.value - t).abs());
            count = T::select(apart, count, count + one);
        }
    }
    count
}

/// Whether no end may be at `t` but one that is exactly there.
#[inline(always)]
fn is_clear<T: Real, const ALWAYS: bool>(spans: &[Span<WithError<T, ALWAYS>>], t: T) -> T::Mask {
    let (zero, slack) = (t.splat_like(0.0), t.splat_like(SLACK));
    let mut clear = t.eq(t);
    for span in spans {
        for end in [span.enter, span.exit] {
            clear = clear & ((end.error * slack).lt((end.value - t).abs()) | end.error.eq(zero));
        }
    }
    clear
}

/// Marches from `start >= 0` to the first crossing of the program's boundary, from window to window: each step ends just
/// beyond the reach of a root, where no other root may be.
///
/// Why that is certain. Where no root may be, each leaf's membership is that of the values, and so is the program's. From
/// there to its least root's reach the program does not change: the magnitude of a sweep grows with the magnitudes it is made
/// of, whatever their signs, and no other root's reach meets that of the one it lands on. A window that holds a single root
/// is passed for certain, since membership is known on both sides of it, and what is between can change only there. Where it
/// holds several their order is not certain, and nothing is. A span that may be empty counts as inhabited, with ends that
/// reach to each other, so that a window that holds one holds both.
#[inline(always)]
pub fn certify<T: Real, L, const ALWAYS: bool>(nodes: &[Node<L>], spans: &[Span<WithError<T, ALWAYS>>], start: T) -> Certificate<T> {
    let (zero, one) = (start.splat_like(0.0), start.splat_like(1.0));
    let infinity = start.splat_like(f32::INFINITY);
    let first = sweep_values(nodes, spans, start);
    let inside = first.lt(zero);
    let mut certificate = Certificate {
        t: Bounded::exact(first.abs()),
        leaf: infinity,
        at_enter: inside,
        inside,
        sure: is_clear(spans, start),
        sweeps: 1,
    };
    let mut running = certificate.sure & certificate.t.value.lt(infinity);
    while running.any() {
        let t = certificate.t.value;
        let window = window_at(spans, t);
        // Rounding must not take its ends inward.
        let ulps = t * t.splat_like(4.0 * T::ROUNDOFF);
        let exact = window.reach.eq(zero);
        let reach = T::select(exact, zero, window.reach * t.splat_like(SLACK) + ulps);
        let count = ends_near(spans, t, T::select(exact, zero, reach + ulps));
        let beyond = t + reach;
        let next = sweep_values(nodes, spans, beyond);
        certificate.sweeps += 1;
        let known = beyond.lt(infinity) & count.eq(one);
        certificate.sure = certificate.sure & (known | !running);
        running = running & known;
        let turned = running & next.lt(zero).differs_from(inside);
        certificate.leaf = T::select(turned, window.leaf, certificate.leaf);
        certificate.at_enter = (turned & window.at_enter) | (!turned & certificate.at_enter);
        certificate.t.error = T::select(turned, window.reach, certificate.t.error);
        running = running & !turned;
        certificate.t.value = T::select(running, next.abs(), certificate.t.value);
        running = running & certificate.t.value.lt(infinity);
    }
    certificate
}

/// Between which two parameters the boundary is crossed for certain, where it is not certain whose surface that is: where a
/// certificate that is none got stuck at a root, several may be near to each other, and yet membership is another one beyond all
/// of them.
pub(super) fn crossing_around<T: Lane, L>(
    nodes: &[Node<L>],
    spans: &[Span<Bounded<T>>],
    start: T,
    stuck: &Certificate<T>,
) -> Option<(T, T)> {
    let (t, slack) = (stuck.t.value, T::from(SLACK));
    let is_stuck = !stuck.sure && t < T::from(f32::INFINITY);
    if !is_stuck || !is_clear(spans, start) {
        return None;
    }
    let ulps = |end: T| end.abs() * T::from(4.0 * T::ROUNDOFF);
    let (mut low, mut high) = (t - ulps(t), t + ulps(t));
    // What reaches into what is between grows it; there are no more steps than ends.
    let mut grown = true;
    while grown {
        grown = false;
        for end in spans.iter().flat_map(|span| [span.enter, span.exit]) {
            if end.error == T::from(0.0) && end.value.abs() == T::from(f32::INFINITY) {
                continue;
            }
            let reach = end.error * slack + ulps(end.value);
            let (from, to) = (end.value - reach, end.value + reach);
            let known = from <= to;
            if !known {
                return None;
            }
            if to < low || high < from {
                continue;
            }
            if from < low || high < to {
                (low, high) = (low.min(from), high.max(to));
                grown = true;
            }
        }
    }
    let beyond = high + ulps(high);
    let after = sweep_values(nodes, spans, beyond) < T::from(0.0);
    (start < low && beyond < T::from(f32::INFINITY) && after != stuck.inside).then_some((low, beyond))
}

#[cfg(test)]
mod tests {
    use super::{Certificate, certify, crossing_around};
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
    fn several_roots_that_change_membership_are_a_crossing_whosever_it_is() {
        let around = |operator: Node<()>, spans: &[Span<Bounded<f32>>]| {
            let nodes = [LEAF, LEAF, operator];
            crossing_around(&nodes, spans, 0.0, &certify(&nodes, spans, 0.0))
        };
        // Both are entered.
        let (low, high) = around(Node::Union, &[span(1.0, 3.0), span(1.15, 4.0)]).unwrap();
        assert!((0.89..=0.9).contains(&low) && (1.25..1.26).contains(&high), "{low} {high}");
        assert!(around(Node::Intersection, &[span(1.0, 3.0), span(1.15, 4.0)]).is_some());
        // One is entered where the other may be left before.
        assert!(around(Node::Difference, &[span(1.0, 3.0), span(0.5, 1.1)]).is_some());
        assert!(around(Node::Intersection, &[span(1.0, 3.0), span(0.5, 1.1)]).is_none());
        // A single root is certain, and needs no such thing.
        assert!(around(Node::Union, &[span(1.0, 3.0), span(5.0, 6.0)]).is_none());
        // A third one comes near to the second.
        let nodes = [LEAF, LEAF, Node::Union, LEAF, Node::Union];
        let spans = [span(1.0, 3.0), span(1.15, 4.0), span(1.3, 5.0)];
        let found = crossing_around(&nodes, &spans, 0.0, &certify(&nodes, &spans, 0.0)).unwrap();
        assert!(found.1 > 1.4, "{found:?}");
        assert!(crossing_around(&nodes, &spans, 0.95, &certify(&nodes, &spans, 0.95)).is_none());
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
