//! The box frame.

use super::readings;
use crate::csg::{Csg, Node};
use crate::invalid::{Fault, Invalid, length};
use crate::leaf::{Bounds, Cuboid, Leaf};
use crate::real::Real;
use crate::vec3::V3;
use glam::Vec3;

/// The twelve edges of a box as bars of square section, with faces parallel to the coordinate planes of its frame: a
/// box less three tunnels, each of which goes through two opposite faces.
///
#[cfg_attr(doc, doc = include_str!("../../pictures/box_frame.md"))]
///
/// - Standard: outside, the distance to the nearest of the bars; inside, to the nearest of the box's faces and of the
///   tunnels; exact on both sides. Sources: I. Quilez, Distance functions (box frame), which inside is exact along the
///   bars but not where three of them meet; there it is our own.
/// - Along a ray: that of the [program](Self::program): the tunnels end in the box's own faces, to the bit, and leave
///   no skin.
/// - Accuracy: that of [`Cuboid`]. Cost: four of them and three differences.
///
/// ```
/// use gsdf_nostd::{BoxFrame, Sphere, csg};
/// use glam::{Vec3, vec3};
///
/// csg! {
///     /// A ball in a cage.
///     const CAGED = union(Sphere::new(Vec3::ZERO, 0.75), posed(1, BoxFrame::new(Vec3::NEG_ONE, Vec3::ONE, 0.25)))
/// }
///
/// assert_eq!(CAGED.leaves(), 5);
/// assert_eq!(CAGED.gsdf(vec3(0.0, 0.0, 5.0), Vec3::NEG_Z), 4.25); // through a window
/// assert_eq!(CAGED.gsdf(vec3(0.0, 0.9, 5.0), Vec3::NEG_Z), 4.0); // onto a bar
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxFrame {
    hull: Cuboid,
    /// Along x, y and z.
    tunnels: [Cuboid; 3],
    thickness: f32,
}

readings!(BoxFrame of 7 nodes);

impl BoxFrame {
    /// The frame of the box from corner `min` to corner `max` whose bars are `thickness` wide.
    ///
    /// # Errors
    /// Where a coordinate is not finite or out of range, the thickness is not from 2^-20 to 2^30, or it leaves less
    /// than 2^-20 open between two bars along some axis.
    pub const fn new(min: Vec3, max: Vec3, thickness: f32) -> Result<Self, Invalid> {
        let thickness = match length("box frame thickness", thickness) {
            Ok(thickness) => thickness,
            Err(error) => return Err(error),
        };
        let low = Vec3::new(min.x + thickness, min.y + thickness, min.z + thickness);
        let high = Vec3::new(max.x - thickness, max.y - thickness, max.z - thickness);
        let hull = match Cuboid::new(min, max) {
            Ok(hull) => hull,
            Err(error) => return Err(error),
        };
        match (
            Cuboid::new(Vec3::new(min.x, low.y, low.z), Vec3::new(max.x, high.y, high.z)),
            Cuboid::new(Vec3::new(low.x, min.y, low.z), Vec3::new(high.x, max.y, high.z)),
            Cuboid::new(Vec3::new(low.x, low.y, min.z), Vec3::new(high.x, high.y, max.z)),
        ) {
            (Ok(x), Ok(y), Ok(z)) if is_between(min, low) && is_between(high, max) => Ok(Self {
                hull,
                tunnels: [x, y, z],
                thickness,
            }),
            // Lost in the rounding of the coordinates.
            (Ok(_), Ok(_), Ok(_)) => Err(Invalid::new("box frame thickness", thickness, Fault::TooSmall)),
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => {
                Err(Invalid::new("box frame: opening between bars", error.found(), error.fault()))
            }
        }
    }

    /// The corner with the least coordinates.
    #[must_use]
    pub const fn min(&self) -> Vec3 {
        self.hull.min()
    }

    /// The corner with the greatest coordinates.
    #[must_use]
    pub const fn max(&self) -> Vec3 {
        self.hull.max()
    }

    /// The width of the bars.
    #[must_use]
    pub const fn thickness(&self) -> f32 {
        self.thickness
    }

    /// The frame as a program: leaf 0 is the box, 1 to 3 are the tunnels along x, y and z.
    ///
    /// Its own [`sdf`](Csg::sdf) has the sign of [`sdf`](Self::sdf), and is a lower bound of its magnitude.
    #[must_use]
    pub const fn program(&self) -> Csg<{ Self::NODES }> {
        let [x, y, z] = self.tunnels;
        Csg::from_binary([
            Node::leaf(Leaf::Cuboid(self.hull)),
            Node::leaf(Leaf::Cuboid(x)),
            Node::Difference,
            Node::leaf(Leaf::Cuboid(y)),
            Node::Difference,
            Node::leaf(Leaf::Cuboid(z)),
            Node::Difference,
        ])
    }

    /// The standard signed distance from `p`, in any arithmetic.
    #[inline(always)]
    pub fn distance<T: Real>(&self, p: V3<T>) -> T {
        let zero = p.x.splat_like(0.0);
        let [along_x, along_y, _] = self.tunnels;
        let low = Vec3::new(along_y.min().x, along_x.min().y, along_x.min().z);
        let high = Vec3::new(along_y.max().x, along_x.max().y, along_x.max().z);
        // How far outside the box's slabs, and how far within the tunnels', by components.
        let outside = furthest(V3::splat(p.x, self.min()) - p, p - V3::splat(p.x, self.max()));
        let open = nearest(p - V3::splat(p.x, low), V3::splat(p.x, high) - p);
        // How far outside the bars' slabs.
        let beside = furthest(outside, open);
        let bars = [
            V3::new(outside.x, beside.y, beside.z),
            V3::new(beside.x, outside.y, beside.z),
            V3::new(beside.x, beside.y, outside.z),
        ];
        let [to_x, to_y, to_z] = bars.map(|bar| positive(bar).norm());
        let to_bars = to_x.min(to_y).min(to_z);
        let [in_x, in_y, in_z] = bars.map(|bar| bar.x.max(bar.y).max(bar.z));
        let inside = in_x.min(in_y).min(in_z).lt(zero);

        let solid = positive(-open);
        let to_tunnel = |first: T, second: T| (first.squared() + second.squared()).sqrt();
        let to_tunnels = to_tunnel(solid.y, solid.z)
            .min(to_tunnel(solid.x, solid.z))
            .min(to_tunnel(solid.x, solid.y));
        let to_faces = -outside.x.max(outside.y).max(outside.z);
        T::select(inside, -to_faces.min(to_tunnels), to_bars)
    }

    /// The box.
    #[must_use]
    pub const fn bounds(&self) -> Option<Bounds> {
        Some(Bounds {
            min: self.min(),
            max: self.max(),
        })
    }
}

/// Whether every coordinate of the one is below that of the other.
const fn is_between(low: Vec3, high: Vec3) -> bool {
    low.x < high.x && low.y < high.y && low.z < high.z
}

#[inline(always)]
fn furthest<T: Real>(a: V3<T>, b: V3<T>) -> V3<T> {
    V3::new(a.x.max(b.x), a.y.max(b.y), a.z.max(b.z))
}

#[inline(always)]
fn nearest<T: Real>(a: V3<T>, b: V3<T>) -> V3<T> {
    V3::new(a.x.min(b.x), a.y.min(b.y), a.z.min(b.z))
}

/// The vector with its negative coordinates taken as zero.
#[inline(always)]
fn positive<T: Real>(v: V3<T>) -> V3<T> {
    furthest(v, V3::splat(v.x, Vec3::ZERO))
}

#[cfg(test)]
mod tests {
    use super::BoxFrame;
    use glam::{Vec3, vec3};

    #[test]
    fn by_hand() {
        let rack = BoxFrame::new(vec3(-4.0, -5.0, -6.0), vec3(4.0, 5.0, 6.0), 1.0).unwrap();
        // Beyond a corner, before an open face, in the middle, in the middle of a bar and where three meet.
        assert_eq!(rack.sdf(vec3(4.0, 8.0, 10.0)), 5.0);
        assert_eq!(rack.sdf(vec3(0.0, 0.0, 10.0)), 5.0);
        assert_eq!(rack.sdf(Vec3::ZERO), 5.0);
        assert_eq!(rack.sdf(vec3(0.0, 4.5, 5.5)), -0.5);
        assert_eq!(rack.sdf(vec3(3.75, 4.75, 5.75)), -0.25);
        let inner = rack.sdf(vec3(3.125, 4.125, 5.125));
        assert!((inner + 0.125 * 2.0_f32.sqrt()).abs() < 1e-6, "{inner}");
        // Through a tunnel without a skin, onto a bar, out of it.
        assert_eq!(rack.gsdf(vec3(0.0, 0.0, 9.0), Vec3::NEG_Z), f32::INFINITY);
        assert_eq!(rack.gsdf(vec3(0.0, 4.5, 9.0), Vec3::NEG_Z), 3.0);
        assert_eq!(rack.gsdf(vec3(0.0, 4.5, 5.5), Vec3::NEG_Z), -0.5);
        assert_eq!(rack.gsdf(vec3(0.0, 4.5, 4.5), Vec3::NEG_Z), 9.5);
        assert_eq!(rack.gsdf(vec3(2.5, 9.0, 4.5), Vec3::NEG_Y), f32::INFINITY);
        assert_eq!(rack.gsdf(vec3(3.5, 9.0, 0.0), Vec3::NEG_Y), 4.0);
    }

    #[test]
    fn bars_that_fill_the_box_or_vanish_are_refused() {
        let frame = |thickness| BoxFrame::new(Vec3::ZERO, vec3(2.0, 3.0, 4.0), thickness);
        assert!(frame(0.999).is_ok() && frame(1.0).is_err() && frame(1.5).is_err());
        assert!(frame(0.0).is_err() && frame(-1.0).is_err() && frame(f32::NAN).is_err());
        let far = Vec3::splat(1e8);
        assert!(BoxFrame::new(far, far + Vec3::splat(100.0), 0.5).is_err());
    }
}
