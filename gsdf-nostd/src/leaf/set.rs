//! Leaf types: the choice of solids a program is made of.

use super::{
    CappedCone, CappedCylinder, Capsule, Cone, Cuboid, Cylinder, HalfSpace, HexagonalPrism, Nappe, Octahedron, Pyramid, Quad, Rhombus,
    RoundedCone, SolidAngle, Sphere, Triangle, TriangularPrism,
};

/// Makes a leaf type of just the solids a program uses.
///
/// A program links the formulas of its leaf type's solids and no others, so that a scene of spheres carries no cone.
/// Any type that implements [`Solid`](crate::Solid) can be among them, also one of your own.
///
/// ```
/// use gsdf_nostd::{Cuboid, Csg, Sphere, csg, leaf_set};
/// use glam::{Vec3, vec3};
///
/// leaf_set! {
///     /// All that my device has to recognise.
///     pub enum Obstacle { Sphere(Sphere), Cuboid(Cuboid) }
/// }
///
/// csg! { const ROOM: Obstacle = union(Sphere::new(Vec3::ZERO, 1.0), Cuboid::new(vec3(2.0, 0.0, 0.0), vec3(3.0, 1.0, 1.0))) }
///
/// assert_eq!(ROOM.gsdf(vec3(5.0, 0.5, 0.5), Vec3::NEG_X), 2.0);
/// ```
#[macro_export]
macro_rules! leaf_set {
    ($(#[$attribute:meta])* $visibility:vis enum $name:ident { $($(#[$inner:meta])* $variant:ident($solid:ty)),+ $(,)? }) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        $visibility enum $name {
            $(
                $(#[$inner])*
                #[doc = concat!("A [`", stringify!($solid), "`].")]
                $variant($solid),
            )+
        }

        const _: () = {
            use $crate::{Bounds, Ground, HalfSpace, Line, Real, Solid, Span, Surface, Toward, V3};

            /// One of the solids, seen from a point.
            #[derive(Clone, Copy)]
            pub enum Seen<T: Real> {
                $(#[doc = "Seen."] $variant(<$solid as Solid>::Seen<T>),)+
            }

            impl Solid for $name {
                type Seen<T: Real> = Seen<T>;

                #[inline(always)]
                fn distance<T: Real>(&self, p: V3<T>) -> T {
                    match self {
                        $(Self::$variant(solid) => solid.distance(p),)+
                    }
                }

                #[inline(always)]
                fn seen_from<T: Real>(&self, origin: V3<T>) -> Seen<T> {
                    match self {
                        $(Self::$variant(solid) => Seen::$variant(solid.seen_from(origin)),)+
                    }
                }

                #[inline(always)]
                fn lift<T: Real>(seen: &Seen<T::Scalar>, like: T) -> Seen<T> {
                    match seen {
                        $(Seen::$variant(seen) => Seen::$variant(<$solid as Solid>::lift(seen, like)),)+
                    }
                }

                #[inline(always)]
                fn grounded<T: Real>(&self, seen: Seen<T>, ground: &Ground<T>) -> Seen<T> {
                    match (self, seen) {
                        $((Self::$variant(solid), Seen::$variant(seen)) => Seen::$variant(solid.grounded(seen, ground)),)+
                        // A view of another solid: there is nothing to stand on.
                        #[allow(unreachable_patterns)]
                        (_, seen) => seen,
                    }
                }

                #[inline(always)]
                fn span<T: Real>(&self, seen: &Seen<T>, toward: &Toward<T>) -> Span<T> {
                    match (self, seen) {
                        $((Self::$variant(solid), Seen::$variant(seen)) => solid.span(seen, toward),)+
                        #[allow(unreachable_patterns)]
                        _ => Span::empty_like(toward.vv),
                    }
                }

                #[inline(always)]
                fn surface<T: Real>(&self, seen: &Seen<T>, toward: &Toward<T>, t: T) -> Surface<T> {
                    match (self, seen) {
                        $((Self::$variant(solid), Seen::$variant(seen)) => solid.surface(seen, toward, t),)+
                        #[allow(unreachable_patterns)]
                        _ => Surface { normal: -toward.v, face: t.splat_like(0.0) },
                    }
                }

                fn bounds(&self) -> Option<Bounds> {
                    match self {
                        $(Self::$variant(solid) => solid.bounds(),)+
                    }
                }

                fn grown(&self, by: f32) -> Option<Self> {
                    match self {
                        $(Self::$variant(solid) => solid.grown(by).map(Self::$variant),)+
                    }
                }

                fn as_half_space(&self) -> Option<HalfSpace> {
                    match self {
                        $(Self::$variant(solid) => solid.as_half_space(),)+
                    }
                }

                #[inline(always)]
                fn spans<T: Real>(
                    &self,
                    seen: Option<&Seen<T::Scalar>>,
                    lines: &[Line<T>; u32::BITS as usize],
                    which: u32,
                    each: impl FnMut(usize, Span<T>),
                ) {
                    match self {
                        $(Self::$variant(solid) => {
                            let seen = match seen {
                                Some(Seen::$variant(seen)) => Some(seen),
                                _ => None,
                            };
                            solid.spans(seen, lines, which, each);
                        })+
                    }
                }

                #[inline(always)]
                fn surface_on<T: Real>(&self, seen: Option<&Seen<T::Scalar>>, line: &Line<T>, t: T) -> Surface<T> {
                    match self {
                        $(Self::$variant(solid) => {
                            let seen = match seen {
                                Some(Seen::$variant(seen)) => Some(seen),
                                _ => None,
                            };
                            solid.surface_on(seen, line, t)
                        })+
                    }
                }

                fn divides_by_components(&self) -> bool {
                    match self {
                        $(Self::$variant(solid) => solid.divides_by_components(),)+
                    }
                }

                #[inline(always)]
                fn span_along<T: Real>(&self, line: &Line<T>) -> Span<T> {
                    match self {
                        $(Self::$variant(solid) => solid.span_along(line),)+
                    }
                }

                #[inline(always)]
                fn span_lifted<T: Real>(&self, seen: &Seen<T::Scalar>, toward: &Toward<T>) -> Span<T> {
                    match (self, seen) {
                        $((Self::$variant(solid), Seen::$variant(seen)) => solid.span_lifted(seen, toward),)+
                        #[allow(unreachable_patterns)]
                        _ => Span::empty_like(toward.vv),
                    }
                }

                #[inline(always)]
                fn surface_lifted<T: Real>(&self, seen: &Seen<T::Scalar>, toward: &Toward<T>, t: T) -> Surface<T> {
                    match (self, seen) {
                        $((Self::$variant(solid), Seen::$variant(seen)) => solid.surface_lifted(seen, toward, t),)+
                        #[allow(unreachable_patterns)]
                        _ => Surface { normal: -toward.v, face: t.splat_like(0.0) },
                    }
                }

                #[inline(always)]
                fn surface_along<T: Real>(&self, line: &Line<T>, t: T) -> Surface<T> {
                    match self {
                        $(Self::$variant(solid) => solid.surface_along(line, t),)+
                    }
                }
            }

            $(
                impl From<$solid> for $name {
                    fn from(solid: $solid) -> Self {
                        Self::$variant(solid)
                    }
                }
            )+
        };
    };
}

leaf_set! {
    /// Every solid of this crate: the default leaf type.
    #[cfg_attr(feature = "defmt", derive(defmt::Format))]
    pub enum Leaf {
        HalfSpace(HalfSpace),
        Sphere(Sphere),
        Cylinder(Cylinder),
        Nappe(Nappe),
        Cuboid(Cuboid),
        CappedCylinder(CappedCylinder),
        Cone(Cone),
        CappedCone(CappedCone),
        Capsule(Capsule),
        HexagonalPrism(HexagonalPrism),
        TriangularPrism(TriangularPrism),
        Octahedron(Octahedron),
        Pyramid(Pyramid),
        Rhombus(Rhombus),
        RoundedCone(RoundedCone),
        SolidAngle(SolidAngle),
        Triangle(Triangle),
        Quad(Quad),
    }
}

#[cfg(test)]
mod tests {
    use super::Leaf;

    #[test]
    fn no_solid_makes_the_others_pay_for_its_size() {
        assert_eq!(size_of::<Leaf>(), 52);
    }
}
