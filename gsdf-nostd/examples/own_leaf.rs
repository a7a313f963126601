//! A solid of one's own as a leaf: the inside of a paraboloid, and a dish made of two. Rays that fall in along its axis are
//! mirrored; all of them meet in the focus.
//!
//! `cargo run --release --package gsdf-nostd --example own_leaf`

use core::error::Error;
use glam::{Vec3, vec3};
use gsdf_nostd::{Bounds, Ground, HalfSpace, Ray, Real, Solid, Span, Surface, Toward, V3, csg, leaf_set, roots};

/// The points `p` with `x² + y² < 4 f z`, seen from the apex: nearer to the focus than to the plane `f` below the apex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Paraboloid {
    apex: Vec3,
    focal_length: f32,
}

/// A [`Paraboloid`] seen from a point.
#[derive(Clone, Copy, Debug)]
pub struct SeenParaboloid<T> {
    /// From the apex to the origin.
    w: V3<T>,
    /// `x² + y² - 4 f z` there.
    c: T,
}

/// Why there is no such paraboloid.
#[derive(Clone, Copy, Debug)]
pub struct Flat;

impl Flat {
    /// What the compiler says where a `const` program asks for one.
    #[must_use]
    pub const fn message(&self) -> &'static str {
        "a paraboloid's apex must be finite and its focal length positive"
    }
}

impl Paraboloid {
    /// The paraboloid that opens upward from `apex`.
    const fn new(apex: Vec3, focal_length: f32) -> Result<Self, Flat> {
        let is_point = apex.x.is_finite() && apex.y.is_finite() && apex.z.is_finite();
        if is_point && focal_length > 0.0 && focal_length.is_finite() {
            Ok(Self { apex, focal_length })
        } else {
            Err(Flat)
        }
    }
}

impl Solid for Paraboloid {
    type Seen<T: Real> = SeenParaboloid<T>;

    /// Half of how much farther the focus is than the plane: a point moved by `s` changes either by `s` at most, so this
    /// is never too large, which is all that a marcher needs. The true distance is the root of a cubic.
    fn distance<T: Real>(&self, p: V3<T>) -> T {
        let (f, half) = (p.x.splat_like(self.focal_length), p.x.splat_like(0.5));
        let w = p - V3::splat(p.x, self.apex);
        half * (V3::new(w.x, w.y, w.z - f).norm() - (w.z + f))
    }

    fn seen_from<T: Real>(&self, origin: V3<T>) -> SeenParaboloid<T> {
        let w = origin - V3::splat(origin.x, self.apex);
        let c = (w.x * w.x + w.y * w.y) - w.x.splat_like(4.0 * self.focal_length) * w.z;
        SeenParaboloid { w, c }
    }

    fn lift<T: Real>(seen: &SeenParaboloid<T::Scalar>, like: T) -> SeenParaboloid<T> {
        SeenParaboloid {
            w: V3::lift(like, seen.w),
            c: like.lift_like(seen.c),
        }
    }

    /// On the surface `c` is 0, and grows with the distance by the length of its gradient.
    fn grounded<T: Real>(&self, seen: SeenParaboloid<T>, ground: &Ground<T>) -> SeenParaboloid<T> {
        let two = seen.c.splat_like(2.0);
        let reach = seen.c.splat_like(self.apex.abs().max_element() + self.focal_length);
        let gradient = two * outward(self, seen.w).norm();
        SeenParaboloid {
            c: ground.settle(0.0, seen.c, gradient, reach),
            ..seen
        }
    }

    /// Along the ray `x² + y² - 4 f z` is `A t² + 2 B t + C`. Parallel to the axis `A` is 0, and one of the roots infinite.
    fn span<T: Real>(&self, seen: &SeenParaboloid<T>, toward: &Toward<T>) -> Span<T> {
        let v = toward.v;
        let zero = seen.c.splat_like(0.0);
        let a = v.x * v.x + v.y * v.y;
        let b = outward(self, seen.w).dot(v);
        let d = b * b - a * seen.c;
        let (enter, exit) = roots(a.splat_like(1.0) / a, b, seen.c, d);
        // A ray that only touches has D = 0, and misses.
        Span::between_where(zero.lt(d), enter, exit)
    }

    fn surface<T: Real>(&self, seen: &SeenParaboloid<T>, toward: &Toward<T>, t: T) -> Surface<T> {
        Surface {
            normal: outward(self, seen.w + toward.v.scaled(t)).normalized_or(-toward.v),
            face: t.splat_like(0.0),
        }
    }

    /// It goes on for ever upward.
    fn bounds(&self) -> Option<Bounds> {
        None
    }
}

/// Half the gradient of `x² + y² - 4 f z`: where the surface goes through a point, this points out of it.
fn outward<T: Real>(paraboloid: &Paraboloid, w: V3<T>) -> V3<T> {
    V3::new(w.x, w.y, w.x.splat_like(-2.0 * paraboloid.focal_length))
}

leaf_set! {
    /// What an antenna is made of.
    enum Part { Paraboloid(Paraboloid), HalfSpace(HalfSpace) }
}

csg! {
    /// A dish of focal length 1, cut off at a height of 0.5.
    const DISH: Part = difference(
        intersection(Paraboloid::new(vec3(0.0, 0.0, -0.05), 1.0), HalfSpace::new(vec3(0.0, 0.0, 0.5), Vec3::Z)),
        Paraboloid::new(Vec3::ZERO, 1.0)
    )
}

fn main() -> Result<(), Box<dyn Error>> {
    let focus = Vec3::Z;
    println!("   x  distance  misses the focus by");
    for tenth in 0..14_u8 {
        let x = f32::from(tenth) / 10.0;
        let fall = Vec3::NEG_Z;
        let Some(hit) = DISH.cast(&Ray::new(vec3(x, 0.3, 4.0), fall)?) else {
            println!("{x:.2}  beside the dish");
            continue;
        };
        let mirrored = fall.reflect(hit.normal);
        assert!(
            DISH.cast_from(&hit, mirrored)?.is_none_or(|next| next.t > 1.0),
            "it leaves the surface it stands on"
        );
        let miss = (focus - hit.point).reject_from(mirrored).length();
        println!("{x:.2}  {:>8.5}  {miss:.1e}", hit.t);
    }
    Ok(())
}
