//! Where in the world a solid can be met: boxes that hold every point at which rounding lets a ray hit it.

use glam::Vec3;
use gsdf_nostd::{Bounds, Node, Program, Solid, Transform, V3};

/// A box by its centre and its half extents, which reach beyond everything that rays can hit of what it holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reach {
    pub(crate) center: Vec3,
    pub(crate) half: Vec3,
}

/// By what a box is widened, for the rounding of whoever computes with the coordinates of what is in it: a share of the
/// largest of them.
const OF_COORDINATES: f32 = 1.0 / (1 << 18) as f32;

/// Stands for no bound at all: beyond all coordinates and far below overflow in any product with an axis.
const EVERYWHERE: f32 = 1e30;

impl Reach {
    /// The whole world.
    pub(crate) const EVERYWHERE: Self = Self {
        center: Vec3::ZERO,
        half: Vec3::splat(EVERYWHERE),
    };

    /// Whether it holds the whole world.
    pub(crate) fn is_everywhere(&self) -> bool {
        self.half.x >= EVERYWHERE
    }

    /// The box around given bounds, widened.
    fn new(bounds: Bounds) -> Self {
        let farthest = bounds.min.abs().max(bounds.max.abs()).max_element();
        Self {
            center: (bounds.min + bounds.max) * 0.5,
            half: ((bounds.max - bounds.min) * 0.5).max(Vec3::ZERO) + Vec3::splat(farthest * OF_COORDINATES),
        }
    }

    fn bounds(&self) -> Bounds {
        Bounds {
            min: self.center - self.half,
            max: self.center + self.half,
        }
    }

    /// The least box around both.
    pub(crate) fn joined(self, other: Self) -> Self {
        if self.is_everywhere() || other.is_everywhere() {
            return Self::EVERYWHERE;
        }
        Self::new(self.bounds().joined(other.bounds()))
    }

    /// A box around all that is in both.
    pub(crate) fn common(self, other: Self) -> Self {
        match (self.is_everywhere(), other.is_everywhere()) {
            (true, _) => other,
            (_, true) => self,
            _ => {
                let (a, b) = (self.bounds(), other.bounds());
                // Boxes that do not meet leave an empty one between them; what is tested against it is then rarely met.
                Self::new(Bounds {
                    min: a.min.max(b.min),
                    max: a.max.min(b.max),
                })
            }
        }
    }

    /// Where a solid in its frame can be met.
    pub(crate) fn of_solid<L: Solid>(solid: &L, pose: Option<&Transform>) -> Self {
        match (solid.bounds(), pose) {
            (None, _) => Self::EVERYWHERE,
            (Some(bounds), None) => Self::new(bounds),
            (Some(bounds), Some(pose)) => Self::posed(bounds, pose),
        }
    }

    /// Where the bounds in a frame lie in the world, around the errors of a ray that is taken there.
    fn posed(local: Bounds, pose: &Transform) -> Self {
        let (rows, columns) = (pose.to_local().map(V3::<f64>::from), columns(pose));
        let of = |coordinates: [f64; 3]| {
            let [x, y, z] = [
                columns[0].scaled(coordinates[0]),
                columns[1].scaled(coordinates[1]),
                columns[2].scaled(coordinates[2]),
            ];
            x + y + z
        };
        let reach = |coordinates: [f64; 3]| {
            let [x, y, z] = [0, 1, 2].map(|column| magnitudes(columns[column]).scaled(coordinates[column]));
            x + y + z
        };
        let (min, max) = (local.min.to_array().map(f64::from), local.max.to_array().map(f64::from));
        let middle = core::array::from_fn(|axis| (min[axis] + max[axis]) * 0.5);
        let half = reach(core::array::from_fn(|axis| (max[axis] - min[axis]) * 0.5));
        let center = of(middle) + V3::from(pose.origin());
        // The error of a local coordinate is one of the world's coordinates as the frame stretches them; it comes back to
        // the world stretched the other way.
        let farthest = greatest(magnitudes(center) + half) + greatest(magnitudes(V3::from(pose.origin())));
        let stretched = rows.map(magnitudes).map(|row| row.x + row.y + row.z);
        let local_error = f64::from(OF_COORDINATES) * farthest * stretched[0].max(stretched[1]).max(stretched[2]);
        let error = reach([local_error; 3]);
        let to_f32 = |v: V3<f64>| Vec3::new(v.x as f32, v.y as f32, v.z as f32);
        Self {
            center: to_f32(center),
            half: to_f32(half + error) + Vec3::splat(farthest as f32 * OF_COORDINATES),
        }
    }

    /// By how much a solid in a frame is met beside where it is, for each unit by which the origin of a ray may be off a surface
    /// that it leaves: surfaces as near as that are moved to the origin. In the frame that is as much as the frame shrinks it
    /// least; it comes back to the world as it stretches it most. Twice as much as that, since near a tip a surface is moved a
    /// little more.
    pub(crate) fn off_per_slack(pose: Option<&Transform>) -> f32 {
        let stretched = pose.map_or(1.0, |pose| {
            let columns = columns(pose);
            let reach = magnitudes(columns[0]) + magnitudes(columns[1]) + magnitudes(columns[2]);
            (greatest(reach) / f64::from(pose.stretch())) as f32
        });
        2.0 * stretched
    }

    /// Where the solid that a range of nodes makes can be met: those of its leaves' boxes that bound it.
    pub(crate) fn of_nodes<L: Solid>(program: &Program<'_, L>, nodes: &[Node<L>]) -> Self {
        let mut stack: Vec<Self> = Vec::new();
        for node in nodes {
            let made = match node {
                Node::Leaf { solid, frame } => Self::of_solid(solid, program.pose(*frame)),
                Node::Complement => {
                    stack.pop();
                    Self::EVERYWHERE
                }
                _ => {
                    let (second, first) = (stack.pop(), stack.pop());
                    let (Some(first), Some(second)) = (first, second) else {
                        return Self::EVERYWHERE;
                    };
                    match node {
                        Node::Union => first.joined(second),
                        Node::Intersection => first.common(second),
                        _ => first,
                    }
                }
            };
            stack.push(made);
        }
        stack.pop().unwrap_or(Self::EVERYWHERE)
    }
}

/// The columns of the matrix that leads back to the world, from the rows of its inverse.
fn columns(pose: &Transform) -> [V3<f64>; 3] {
    let rows = pose.to_local().map(V3::<f64>::from);
    let crosses = [rows[1].cross(rows[2]), rows[2].cross(rows[0]), rows[0].cross(rows[1])];
    crosses.map(|cross| cross.scaled(1.0 / rows[0].dot(crosses[0])))
}

fn magnitudes(v: V3<f64>) -> V3<f64> {
    V3::new(v.x.abs(), v.y.abs(), v.z.abs())
}

fn greatest(v: V3<f64>) -> f64 {
    v.x.max(v.y).max(v.z)
}
