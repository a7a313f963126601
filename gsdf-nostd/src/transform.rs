//! Motions and other affine maps, applied to the ray instead of to the solid.

use crate::invalid::{Fault, Invalid, point};
use crate::range::{MAX_STRETCH, unit_scale};
use crate::ray::Line;
use crate::real::Real;
use crate::span::Span;
use crate::toward::Toward;
use crate::vec3::V3;
use glam::{Mat3, Vec3};

/// An affine map from a local frame to the world, stored as its inverse.
///
/// A ray keeps its parameter under an affine map, up to a power of two that is chosen here: the solid stays as it is, in
/// numbers as round as its author wrote them, and the ray comes to it. Solids that share a face in their local frame share
/// it in every pose, to the bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform {
    /// The rows of the matrix that takes world vectors to local ones.
    to_local: [Vec3; 3],
    /// The local origin, in the world.
    translation: Vec3,
    /// A lower bound on the factor by which the map stretches any length.
    stretch: f32,
    /// The power of two from half of that to it: times this no vector is longer in the frame than in the world.
    slow: f32,
}

/// A line of the world in the frame of a [`Transform`].
///
/// Its direction is that of the world's line in the frame times a power of two, so that nothing of it is larger than four or
/// all of it less than 2^-12, however much the transform stretches: products of the formulas stay in range. What the line
/// says of its parameter is taken back exactly.
#[derive(Clone, Copy, Debug)]
pub struct LocalLine<T> {
    /// The line.
    pub line: Line<T>,
    /// The power of two: a parameter of the line times it is that of the world's line.
    pub scale: T,
}

impl<T: Real> LocalLine<T> {
    /// The world's line itself.
    #[inline(always)]
    pub(crate) fn of_world(world: &Line<T>) -> Self {
        Self {
            line: *world,
            scale: world.toward.vv.splat_like(1.0),
        }
    }

    /// A span of this line in the parameter of the world's; exact unless it overflows, or falls below the normal numbers.
    #[inline(always)]
    pub fn span_in_world(&self, span: Span<T>) -> Span<T> {
        Span {
            enter: span.enter.times_power(self.scale),
            exit: span.exit.times_power(self.scale),
        }
    }

    /// The parameter on this line that belongs to one of the world's, as exact.
    #[inline(always)]
    pub fn parameter(&self, t: T) -> T {
        t / self.scale
    }
}

/// By what a direction is lengthened that a transform shrinks so much more than others that it is still shorter than the
/// inverse.
const LENGTHENED: f32 = 1024.0;

impl Transform {
    /// The map that moves nothing.
    pub const IDENTITY: Self = Self {
        to_local: [Vec3::X, Vec3::Y, Vec3::Z],
        translation: Vec3::ZERO,
        stretch: 1.0,
        slow: 0.5,
    };

    /// The map that takes the local origin to `translation`.
    ///
    /// # Errors
    /// Where a coordinate is not finite or beyond ±2^30.
    pub const fn translation(translation: Vec3) -> Result<Self, Invalid> {
        match point("translation", translation) {
            Ok(_) => Ok(Self {
                translation,
                ..Self::IDENTITY
            }),
            Err(error) => Err(error),
        }
    }

    /// The map `x -> matrix x + translation`: a rotation, a scaling, a shear or all of them, followed by a
    /// translation.
    ///
    /// The inverse is computed in double precision and rounded once; the rounded inverse *is* the map from then on.
    ///
    /// # Errors
    /// Where a number is not finite, the translation is beyond ±2^30, or the matrix has no inverse or stretches some
    /// length by more than 2^20 or less than 2^-20, or one 2^20 times as much as another: of a direction that is shrunk so
    /// much more than others rounding leaves nothing.
    pub const fn affine(matrix: Mat3, translation: Vec3) -> Result<Self, Invalid> {
        if let Err(error) = point("translation", translation) {
            return Err(error);
        }
        let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
        let m = match (
            point("matrix.x_axis", columns[0]),
            point("matrix.y_axis", columns[1]),
            point("matrix.z_axis", columns[2]),
        ) {
            (Ok(x), Ok(y), Ok(z)) => [wide(x), wide(y), wide(z)],
            (Err(error), _, _) | (_, Err(error), _) | (_, _, Err(error)) => return Err(error),
        };
        // The rows of the inverse are the cross products of the columns over the determinant.
        let rows = [cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])];
        let determinant = dot(m[0], rows[0]);
        let singular = Err(Invalid::new("matrix", determinant as f32, Fault::Singular));
        if determinant == 0.0_f64 {
            return singular;
        }
        let to_local = [
            narrow(rows[0], determinant),
            narrow(rows[1], determinant),
            narrow(rows[2], determinant),
        ];
        let inverse_stretch = spectral_norm([wide(to_local[0]), wide(to_local[1]), wide(to_local[2])]);
        // A little more than 2^20, so that rounding does not refuse an exact 2^20.
        let most = MAX_STRETCH as f64 * 1.001_f64;
        let stretch = spectral_norm(m);
        if !(inverse_stretch <= most && stretch <= most && inverse_stretch * stretch <= most) {
            return singular;
        }
        Ok(Self {
            to_local,
            translation,
            stretch: (1.0 / inverse_stretch) as f32,
            slow: 0.5 * unit_scale(inverse_stretch as f32),
        })
    }

    /// A lower bound on the factor by which the map stretches any length: its smallest singular value, exact up to
    /// rounding for rigid maps and uniform or axis-aligned scalings, at most 1 % too small for others.
    #[must_use]
    pub const fn stretch(&self) -> f32 {
        self.stretch
    }

    /// The rows of the matrix that takes world vectors to local ones.
    #[must_use]
    pub const fn to_local(&self) -> [Vec3; 3] {
        self.to_local
    }

    /// The local origin, in the world.
    #[must_use]
    pub const fn origin(&self) -> Vec3 {
        self.translation
    }

    /// A world point in the local frame.
    #[inline(always)]
    pub fn point_to_local<T: Real>(&self, point: V3<T>) -> V3<T> {
        self.vector_to_local(point - V3::splat(point.x, self.translation))
    }

    /// A world vector in the local frame.
    #[inline(always)]
    pub fn vector_to_local<T: Real>(&self, vector: V3<T>) -> V3<T> {
        let [x, y, z] = self.to_local;
        V3::new(
            V3::splat(vector.x, x).dot(vector),
            V3::splat(vector.x, y).dot(vector),
            V3::splat(vector.x, z).dot(vector),
        )
    }

    /// A world line in the local frame.
    #[inline(always)]
    pub fn line_to_local<T: Real>(&self, line: &Line<T>) -> LocalLine<T> {
        let like = line.toward.vv;
        let v = self.vector_to_local(line.toward.v);
        let largest = v.x.abs().max(v.y.abs()).max(v.z.abs());
        let longer = like.splat_like(self.slow * LENGTHENED);
        let is_short = (largest * longer).le(like.splat_like(1.0));
        // Either will do.
        let scale = T::select(is_short, longer, like.splat_like(self.slow)).given();
        LocalLine {
            line: Line {
                origin: self.point_to_local(line.origin),
                toward: Toward::new(v.times_power(scale)),
            },
            scale,
        }
    }

    /// By how much rounding in `f32` may move a ray that it takes to the local frame, in that frame: a ray that starts within
    /// `reach` of the origin of the world, as far as it is within `farthest` of the local one.
    ///
    /// Counted: the origin is rounded five times and the direction four, each by a share of as much as the magnitudes of the
    /// inverse's numbers may make of it, which is at the most the square root of three times what the inverse makes of any vector.
    pub(crate) fn off(&self, reach: f32, farthest: f32) -> f32 {
        const SIXTEEN_ROUNDOFFS: f32 = 16.0 / 16_777_216.0;
        let origin = Vec3::length(self.translation);
        SIXTEEN_ROUNDOFFS * (reach + 2.0 * origin + farthest * self.greatest_stretch()) / self.stretch
    }

    /// By how much the map may stretch a length, at the most.
    fn greatest_stretch(&self) -> f32 {
        let rows = self.to_local.map(wide);
        let columns = [cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])];
        let determinant = dot(rows[0], columns[0]);
        let square: f64 = columns.iter().map(|column| dot(*column, *column)).sum();
        (libm::sqrt(square) / determinant.abs()) as f32
    }

    /// The unit normal in the world of a surface whose normal in the local frame is `normal`.
    #[inline(always)]
    pub fn normal_to_world<T: Real>(&self, normal: V3<T>) -> V3<T> {
        let [x, y, z] = self.to_local;
        let like = normal.x;
        (V3::splat(like, x).scaled(normal.x) + V3::splat(like, y).scaled(normal.y) + V3::splat(like, z).scaled(normal.z))
            .normalized_or(normal)
    }
}

const fn wide(v: Vec3) -> [f64; 3] {
    [v.x as f64, v.y as f64, v.z as f64]
}

const fn narrow(v: [f64; 3], divisor: f64) -> Vec3 {
    // The +0.0 keeps negative zeros out of the stored inverse.
    Vec3::new(
        (v[0] / divisor + 0.0) as f32,
        (v[1] / divisor + 0.0) as f32,
        (v[2] / divisor + 0.0) as f32,
    )
}

const fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

const fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// An upper bound on the largest singular value of a matrix given by rows (or columns), in `const`.
///
/// Gershgorin's bound on the largest eigenvalue of `G = M Mᵀ`, taken on `G^64` to bring the factor 3 by which it may
/// exceed down to `3^(1/64)`, and its square root.
const fn spectral_norm(rows: [[f64; 3]; 3]) -> f64 {
    const SQUARINGS: u32 = 6;
    let mut g = [[0.0_f64; 3]; 3];
    let mut i = 0;
    while i < 9 {
        g[i / 3][i % 3] = dot(rows[i / 3], rows[i % 3]);
        i += 1;
    }
    // `scale` collects what was divided out, at the power the current `g` has.
    let mut scale = 1.0_f64;
    let mut round = 0;
    while round < SQUARINGS {
        let trace = g[0][0] + g[1][1] + g[2][2];
        let mut square = [[0.0_f64; 3]; 3];
        let mut i = 0;
        while i < 9 {
            // `g` is symmetric: a row is a column.
            square[i / 3][i % 3] = dot(g[i / 3], g[i % 3]) / (trace * trace);
            i += 1;
        }
        g = square;
        // scale^(2^-round) is what the bound must be multiplied by; kept as a plain factor.
        scale *= root(trace, round);
        round += 1;
    }
    let mut bound = 0.0_f64;
    let mut i = 0;
    while i < 3 {
        let sum = g[i][0].abs() + g[i][1].abs() + g[i][2].abs();
        if sum > bound {
            bound = sum;
        }
        i += 1;
    }
    sqrt(scale * root(bound, SQUARINGS))
}

/// The 2^`times`-th root.
const fn root(value: f64, times: u32) -> f64 {
    let mut value = value;
    let mut i = 0;
    while i < times {
        value = sqrt(value);
        i += 1;
    }
    value
}

/// The square root of a positive number in `const`, where neither `std` nor `libm` has one: Newton's iteration from a
/// guess that halves the exponent.
const fn sqrt(value: f64) -> f64 {
    if value <= 0.0_f64 {
        return 0.0_f64;
    }
    let mut guess = f64::from_bits((value.to_bits() >> 1) + (1023 << 51));
    let mut i = 0_u32;
    while i < 6 {
        guess = 0.5_f64 * (guess + value / guess);
        i += 1;
    }
    guess
}

#[cfg(test)]
mod tests {
    use super::{Transform, sqrt};
    use crate::invalid::Fault;
    use crate::vec3::V3;
    use glam::{Mat3, Vec3, vec3};

    #[test]
    fn square_roots_are_those_of_the_hardware() {
        for value in [1e-300_f64, 2.0_f64.powi(-40), 0.1, 0.5, 1.0, 2.0, 3.0, 1e10, 1e300] {
            let error = (sqrt(value) - value.sqrt()).abs() / value.sqrt();
            assert!(error <= 2.3e-16, "{value}: {error}");
        }
    }

    #[test]
    fn stretch_bounds_the_smallest_singular_value_from_below() {
        let stretch = |matrix| Transform::affine(matrix, Vec3::ZERO).unwrap().stretch();
        assert_eq!(stretch(Mat3::IDENTITY), 1.0);
        assert_eq!(stretch(Mat3::from_diagonal(vec3(2.0, 0.5, 8.0))), 0.5);
        for angle in [0.1_f32, 1.0, 2.5] {
            let rotation = Mat3::from_axis_angle(vec3(0.6, 0.0, 0.8), angle);
            assert!((stretch(rotation * 3.0) - 3.0).abs() < 2e-6, "{}", stretch(rotation * 3.0));
        }
        // A shear by k has smallest singular value (sqrt(k² + 4) - k) / 2.
        let shear = Mat3::from_cols(Vec3::X, vec3(1.5, 1.0, 0.0), Vec3::Z);
        let found = stretch(shear);
        assert!(found <= 0.5 && found > 0.495, "{found}");
    }

    #[test]
    fn points_come_home() {
        let matrix = Mat3::from_cols(vec3(1.0, 0.5, 0.0), vec3(-0.25, 2.0, 0.0), vec3(0.0, 0.125, 4.0));
        let transform = Transform::affine(matrix, vec3(3.0, -2.0, 1.0)).unwrap();
        let local = vec3(0.25, -1.5, 2.0);
        let world = matrix * local + vec3(3.0, -2.0, 1.0);
        let back: Vec3 = transform.point_to_local(V3::from(world)).into();
        assert!((back - local).length() < 1e-6);
    }

    #[test]
    fn maps_without_an_inverse_are_refused() {
        for matrix in [
            Mat3::ZERO,
            Mat3::from_cols(Vec3::X, Vec3::X, Vec3::Z),
            Mat3::from_diagonal(vec3(1.0, 1.0, 9e-7)),
            Mat3::from_diagonal(vec3(1.1e6, 1.0, 1.0)),
            Mat3::from_diagonal(vec3(1100.0, 1.0, 9e-4)),
            Mat3::from_diagonal(Vec3::splat(1.1e6)),
            Mat3::from_diagonal(Vec3::splat(9e-7)),
        ] {
            let error = Transform::affine(matrix, Vec3::ZERO).unwrap_err();
            assert_eq!(error.fault(), Fault::Singular);
        }
        assert!(Transform::affine(Mat3::from_diagonal(vec3(f32::NAN, 1.0, 1.0)), Vec3::ZERO).is_err());
        assert!(Transform::affine(Mat3::IDENTITY, vec3(f32::INFINITY, 0.0, 0.0)).is_err());
        let most = 1_048_576.0;
        for diagonal in [
            vec3(1024.0, 1.0 / 1024.0, 1.0),
            vec3(most, 1.0, 1.0),
            Vec3::splat(most),
            Vec3::splat(1.0 / most),
        ] {
            assert!(Transform::affine(Mat3::from_diagonal(diagonal), Vec3::ZERO).is_ok(), "{diagonal}");
        }
    }
}
