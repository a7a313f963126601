//! The rays of a packet certified together, as far as that goes without looking closely.

use super::gather::{Gathered, Moved};
use crate::lanes::{LaneMask, Lanes, MOST_LANES};
use crate::scene::Scene;
use crate::tile::pixels::Pixel;
use gsdf_nostd::{IN_DOUBLES, Line, Node, Ordinary, Real, Solid, Span, Toward, Transform, V3, WithError, certify};

/// What the rays of a packet meet first, as far as that is certain.
pub(super) struct Known {
    /// The lanes of which it is.
    pub(super) lanes: u32,
    /// The distance, which is rounded correctly, and by how much it may be off; infinite where nothing is met.
    pub(super) t: [f32; MOST_LANES],
    pub(super) bound: [f32; MOST_LANES],
    /// The number of the leaf in the scene, or [`Pixel::NO_LEAF`].
    pub(super) leaf: [u32; MOST_LANES],
}

impl Known {
    /// Of nobody.
    pub(super) const NOTHING: Self = Self {
        lanes: 0,
        t: [f32::INFINITY; MOST_LANES],
        bound: [0.0; MOST_LANES],
        leaf: [Pixel::NO_LEAF; MOST_LANES],
    };
}

/// Certifies the rays of a packet on lines that are `scale` times as fast, and start at `start`: in `f32` what they meet, from
/// spans that are [between](Moved) two, and in `f64` where. Beyond `far` nothing is known of what they meet.
#[inline(never)]
pub(super) fn certify_together<T: Lanes, L: Solid>(
    token: T::Token,
    scene: &Scene<'_, L>,
    gathered: &Gathered<L>,
    (nodes, leaves): (&[Node<()>], &[u32]),
    (line, scale, start): (&Line<T>, T, T),
    far: f32,
    spans: &mut Vec<Span<Ordinary<T>>>,
) -> Known {
    T::vectorize(
        token,
        #[inline(always)]
        || {
            spans.clear();
            for &leaf in leaves {
                let Some(leaf) = gathered.leaf(leaf) else { return Known::NOTHING };
                spans.push(match &leaf.moved {
                    Moved::Between(moved) => {
                        let mut both = [Span::empty_like(start); 2];
                        let pose = scene.pose(leaf.place);
                        for (span, solid) in both.iter_mut().zip(moved) {
                            *span = solid.span_in_world(line, pose);
                        }
                        Span::within(both[0], both[1])
                    }
                    Moved::HalfSpace(plane) => plane.span_along(&line.bounded()),
                    Moved::Unknown => return Known::NOTHING,
                });
            }
            let found = certify(nodes, spans, start);
            let is_hit = found.t.value.lt(T::splat(token, f32::INFINITY));
            let mut known = Known::NOTHING;
            if far == f32::INFINITY {
                known.lanes = (found.sure & !is_hit).to_bits();
            }
            let mut numbers = [0; MOST_LANES];
            found.leaf.store_numbers(&mut numbers);
            let mut left = (found.sure & is_hit).to_bits();
            if left == 0 {
                return known;
            }
            let ends = Ends::new(token, line, scale, found.at_enter, found.t.error);
            let (mut t, mut bound) = (T::splat(token, f32::INFINITY), T::splat(token, 0.0));
            while left != 0 {
                let number = numbers[left.trailing_zeros() as usize % MOST_LANES];
                let these = left & found.leaf.eq(T::splat(token, number as f32)).to_bits();
                left &= !these & (left - 1);
                let Some(leaf) = leaves.get(number as usize) else { continue };
                let Some(leaf) = gathered.leaf(*leaf) else { continue };
                let Some((solid, _)) = scene.leaf(leaf.place) else { continue };
                let end = ends.of(spans_in_doubles::<T, L>(
                    token,
                    solid,
                    scene.pose(leaf.place),
                    &leaf.moved,
                    &ends.line,
                    ends.doubt,
                ));
                let (nearest, half_ulp, rounded) = ends.rounded(token, end);
                let these_lanes = found.leaf.eq(T::splat(token, number as f32));
                t = T::select(these_lanes, nearest, t);
                bound = T::select(these_lanes, half_ulp, bound);
                let in_scene = scene.number(leaf.place);
                for (lane, leaf) in known.leaf.iter_mut().enumerate() {
                    *leaf = if these >> lane & 1 == 1 { in_scene } else { *leaf };
                }
                known.lanes |= these & (rounded & nearest.lt(T::splat(token, far))).to_bits();
            }
            t.store(&mut known.t);
            bound.store(&mut known.bound);
            known
        },
    )
}

/// The ends of spans in `f64`.
struct Ends<T: Lanes> {
    /// Without the reciprocals of components.
    line: Line<T::Doubles>,
    scale: T::Doubles,
    at_enter: <T::Doubles as Real>::Mask,
    /// By how much they may be off, but those of planes.
    doubt: T::Doubles,
}

/// The spans of a leaf in `f64`, whose ends are off by `doubt` at the most. A function of its own, so that no quotient is taken
/// that the solid does not ask for.
#[inline(never)]
fn spans_in_doubles<T: Lanes, L: Solid>(
    token: T::Token,
    solid: &L,
    pose: Option<&Transform>,
    moved: &Moved<L>,
    line: &Line<T::Doubles>,
    doubt: T::Doubles,
) -> Span<Ordinary<T::Doubles>> {
    T::vectorize(
        token,
        #[inline(always)]
        || {
            if let Moved::HalfSpace(plane) = moved {
                return plane.span_along(&line.bounded());
            }
            let mut line = *line;
            if solid.divides_by_components() {
                line.toward = line.toward.with_components();
            }
            let Span { enter, exit } = solid.span_in_world(&line, pose);
            Span {
                enter: WithError {
                    value: enter,
                    error: doubt,
                },
                exit: WithError { value: exit, error: doubt },
            }
        },
    )
}

#[inline(always)]
fn wide<T: Lanes>(v: V3<T>) -> V3<T::Doubles> {
    V3::new(v.x.to_doubles(), v.y.to_doubles(), v.z.to_doubles())
}

impl<T: Lanes> Ends<T> {
    #[inline(always)]
    fn new(token: T::Token, line: &Line<T>, scale: T, at_enter: T::Mask, reach: T) -> Self {
        let (zero, half, one) = (T::splat(token, 0.0), T::splat(token, 0.5), T::splat(token, 1.0));
        Self {
            line: Line {
                origin: wide(line.origin),
                toward: Toward::without_components(wide(line.toward.v)),
            },
            scale: scale.to_doubles(),
            at_enter: half.to_doubles().lt(T::select(at_enter, one, zero).to_doubles()),
            doubt: (reach * T::splat(token, IN_DOUBLES)).to_doubles(),
        }
    }

    /// The ends of some spans, in the parameter of the rays.
    #[inline(always)]
    fn of(&self, span: Span<Ordinary<T::Doubles>>) -> Ordinary<T::Doubles> {
        let end: Ordinary<T::Doubles> = WithError {
            value: Real::select(self.at_enter, span.enter.value, span.exit.value),
            error: Real::select(self.at_enter, span.enter.error, span.exit.error),
        };
        end.times_power(WithError::exact(self.scale))
    }

    /// The nearest `f32` numbers, half a unit in the last place of each, and whether they are that for certain.
    #[inline(always)]
    fn rounded(&self, token: T::Token, end: Ordinary<T::Doubles>) -> (T, T, T::Mask) {
        let nearest = T::from_doubles(token, end.value);
        let half_ulp = (nearest.next_up() - nearest) * T::splat(token, 0.5);
        let off = (nearest.to_doubles() - end.value).abs() + end.doubt().value;
        let (zero, one) = (off.splat_like(0.0), off.splat_like(1.0));
        let is_rounded = T::from_doubles(token, Real::select(off.le(half_ulp.to_doubles()), one, zero));
        let finite = nearest.lt(T::splat(token, f32::MAX));
        (nearest, half_ulp, T::splat(token, 0.5).lt(is_rounded) & finite)
    }
}
