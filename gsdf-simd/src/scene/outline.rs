//! A part that is marched, as a tree: to be reduced to what rays meet without a look at all the rest.

use super::reduce::Known;
use core::ops::Range;
use gsdf_nostd::Node;

/// A part as unions and intersections, by turns, of as many operands as there are.
///
/// Unions of unions are one union, and so are intersections and differences one intersection, some of whose operands are
/// complements. That changes no bit: of any number of operands the least, or the greatest, is the same in whatever order they
/// are compared, and so is the lowest number of those that change where their union or intersection does.
#[derive(Debug)]
pub(crate) struct Outline {
    joints: Vec<Joint>,
    operands: Vec<Operand>,
    whole: Operand,
}

/// A union or an intersection.
#[derive(Clone, Debug)]
struct Joint {
    kind: Kind,
    operands: Range<u32>,
    /// How many of the operands decide it where rays meet none of their leaves.
    deciding: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Union,
    Intersection,
}

/// What is joined.
#[derive(Clone, Copy, Debug)]
struct Operand {
    /// Where its leaves end among those of the part.
    end: u32,
    /// The number of its joint; [`LEAF`] where it is a leaf.
    joint: u32,
    /// Whether it is the complement of that.
    negative: bool,
    /// Whether rays are inside of it, complement or not, that meet none of its leaves.
    inside: bool,
}

const LEAF: u32 = u32::MAX;

/// A joint that is being reduced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Open {
    joint: u32,
    negative: bool,
    /// The leaves that are still to be looked at.
    next: u32,
    end: u32,
    /// Where its nodes and its leaves start.
    nodes: u32,
    leaves: u32,
    /// Whether there is an operand that rays may meet.
    is_met: bool,
}

/// A part without the leaves that the rays at hand cannot meet, in the making.
pub(crate) struct Remainder<'w, L> {
    /// Its nodes, in postfix order.
    pub(crate) nodes: &'w mut Vec<Node<L>>,
    /// The numbers of its leaves among those of the part.
    pub(crate) leaves: &'w mut Vec<u32>,
    pub(crate) open: &'w mut Vec<Open>,
}

impl Kind {
    /// What every operand of which this is known makes of the whole.
    const fn decisive(self) -> Known {
        match self {
            Self::Union => Known::Inside,
            Self::Intersection => Known::Outside,
        }
    }

    /// What is known of the whole if all that is known of operands decides nothing.
    const fn undecided(self) -> Known {
        match self {
            Self::Union => Known::Outside,
            Self::Intersection => Known::Inside,
        }
    }

    fn is_decided_by(self, operand: &Operand) -> bool {
        operand.inside == (self == Self::Union)
    }
}

impl Operand {
    fn leaf(number: u32) -> Self {
        Self {
            end: number + 1,
            joint: LEAF,
            negative: false,
            inside: false,
        }
    }

    fn complement(self) -> Self {
        Self {
            negative: !self.negative,
            inside: !self.inside,
            ..self
        }
    }
}

/// An outline in the making: the operands of each joint, apart.
#[derive(Default)]
struct Builder {
    joints: Vec<(Kind, Vec<Operand>)>,
}

impl Builder {
    /// Joins two operands that follow each other.
    fn join(&mut self, kind: Kind, first: Operand, second: Operand) -> Operand {
        let inside = match kind {
            Kind::Union => first.inside | second.inside,
            Kind::Intersection => first.inside & second.inside,
        };
        // Right operands nest no deeper than operands may wait: what is moved is moved a few times at most.
        let moved = match self.own(kind, second) {
            Some(own) => core::mem::take(own),
            None => vec![second],
        };
        let joint = if self.own(kind, first).is_some() {
            first.joint
        } else {
            self.joints.push((kind, vec![first]));
            self.joints.len() as u32 - 1
        };
        if let Some((_, operands)) = self.joints.get_mut(joint as usize) {
            operands.extend(moved);
        }
        Operand {
            end: second.end,
            joint,
            negative: false,
            inside,
        }
    }

    /// The operands of an operand that is joined in the same way.
    fn own(&mut self, kind: Kind, operand: Operand) -> Option<&mut Vec<Operand>> {
        let (own, operands) = self.joints.get_mut(operand.joint as usize)?;
        (*own == kind && !operand.negative).then_some(operands)
    }
}

impl Outline {
    /// The outline of the part that these nodes make; [`None`] where they make none.
    pub(crate) fn new<L>(nodes: &[Node<L>]) -> Option<Self> {
        let mut builder = Builder::default();
        let mut waiting: Vec<Operand> = Vec::new();
        let mut leaves = 0;
        for node in nodes {
            let made = match node {
                Node::Leaf { .. } => {
                    leaves += 1;
                    Operand::leaf(leaves - 1)
                }
                Node::Complement => waiting.pop()?.complement(),
                operator => {
                    let (second, first) = (waiting.pop()?, waiting.pop()?);
                    match operator {
                        Node::Union => builder.join(Kind::Union, first, second),
                        Node::Difference => builder.join(Kind::Intersection, first, second.complement()),
                        _ => builder.join(Kind::Intersection, first, second),
                    }
                }
            };
            waiting.push(made);
        }
        let whole = waiting.pop()?;
        let mut operands = Vec::new();
        let joints = builder.joints.into_iter().map(|(kind, own)| {
            let start = operands.len() as u32;
            operands.extend_from_slice(&own);
            Joint {
                kind,
                operands: start..operands.len() as u32,
                deciding: own.iter().filter(|operand| kind.is_decided_by(operand)).count() as u32,
            }
        });
        let joints = joints.collect();
        Some(Self { joints, operands, whole })
    }

    /// How many bytes it takes.
    pub(crate) fn bytes(&self) -> usize {
        self.joints.capacity() * size_of::<Joint>() + self.operands.capacity() * size_of::<Operand>()
    }

    /// Reduces the part to those of its leaves that are open. `known` are the leaves that rays may meet, or are inside of, by
    /// their numbers, in ascending order; they are outside of all others. `leaf` makes their nodes.
    pub(crate) fn reduce<L>(&self, known: &[(u32, Known)], made: &mut Remainder<'_, L>, leaf: impl Fn(u32) -> Option<Node<L>>) -> Known {
        made.nodes.clear();
        made.leaves.clear();
        made.open.clear();
        if known.is_empty() {
            return if self.whole.inside { Known::Inside } else { Known::Outside };
        }
        let mut done = self.begin(self.whole, 0..known.len(), known, made, &leaf);
        loop {
            if let Some((known, negative)) = done {
                let Some(open) = made.open.last_mut() else {
                    if known == Known::Open && negative {
                        made.nodes.push(Node::Complement);
                    }
                    return if negative { known.complement() } else { known };
                };
                let kind = self.joints.get(open.joint as usize).map_or(Kind::Union, |joint| joint.kind);
                let of_operand = if negative { known.complement() } else { known };
                if of_operand == kind.decisive() {
                    done = Some((of_operand, open.negative));
                    made.nodes.truncate(open.nodes as usize);
                    made.leaves.truncate(open.leaves as usize);
                    made.open.pop();
                    continue;
                }
                if of_operand == Known::Open {
                    let joined = core::mem::replace(&mut open.is_met, true);
                    match (kind, joined, negative) {
                        (Kind::Intersection, true, true) => made.nodes.push(Node::Difference),
                        (kind, joined, negative) => {
                            if negative {
                                made.nodes.push(Node::Complement);
                            }
                            if joined {
                                made.nodes.push(match kind {
                                    Kind::Union => Node::Union,
                                    Kind::Intersection => Node::Intersection,
                                });
                            }
                        }
                    }
                }
            }
            done = self.go_on(known, made, &leaf);
        }
    }

    /// Goes on to the next operand of the joint that was opened last, or closes it: what is known of it, and whether its
    /// complement is meant.
    fn go_on<L>(
        &self,
        known: &[(u32, Known)],
        made: &mut Remainder<'_, L>,
        leaf: &impl Fn(u32) -> Option<Node<L>>,
    ) -> Option<(Known, bool)> {
        let open = made.open.last_mut()?;
        let joint = self.joints.get(open.joint as usize)?;
        if open.next == open.end {
            let found = if open.is_met { Known::Open } else { joint.kind.undecided() };
            let negative = open.negative;
            made.open.pop();
            return Some((found, negative));
        }
        let range = open.next as usize..open.end as usize;
        let (operand, next) = self.operand_of(joint, &range, known)?;
        open.next = next as u32;
        self.begin(operand, range.start..next, known, made, leaf)
    }

    /// The operand of a joint that the first of some leaves belongs to, and the first leaf that does not.
    fn operand_of(&self, joint: &Joint, range: &Range<usize>, known: &[(u32, Known)]) -> Option<(Operand, usize)> {
        let own = self.operands.get(joint.operands.start as usize..joint.operands.end as usize)?;
        let rest = known.get(range.clone())?;
        let (first, _) = *rest.first()?;
        let operand = *own.get(own.partition_point(|operand| operand.end <= first))?;
        let count = if operand.joint == LEAF {
            1
        } else {
            rest.partition_point(|(leaf, _)| *leaf < operand.end)
        };
        Some((operand, range.start + count))
    }

    /// Begins with an operand that some leaves belong to: what is known of it, if that is known at once, and whether its
    /// complement is meant.
    fn begin<L>(
        &self,
        operand: Operand,
        range: Range<usize>,
        known: &[(u32, Known)],
        made: &mut Remainder<'_, L>,
        leaf: &impl Fn(u32) -> Option<Node<L>>,
    ) -> Option<(Known, bool)> {
        let Some(joint) = self.joints.get(operand.joint as usize) else {
            let (number, mut of_leaf) = *known.get(range.start)?;
            if of_leaf == Known::Open {
                match leaf(number) {
                    Some(node) => {
                        made.nodes.push(node);
                        made.leaves.push(number);
                    }
                    None => of_leaf = Known::Outside,
                }
            }
            return Some((of_leaf, operand.negative));
        };
        if joint.deciding > 0 {
            let mut met = 0;
            let mut range = range.clone();
            while let Some((operand, next)) = self.operand_of(joint, &range, known) {
                met += u32::from(joint.kind.is_decided_by(&operand));
                range.start = next;
            }
            if met < joint.deciding {
                return Some((joint.kind.decisive(), operand.negative));
            }
        }
        made.open.push(Open {
            joint: operand.joint,
            negative: operand.negative,
            next: range.start as u32,
            end: range.end as u32,
            nodes: made.nodes.len() as u32,
            leaves: made.leaves.len() as u32,
            is_met: false,
        });
        None
    }
}

#[cfg(test)]
mod tests;
