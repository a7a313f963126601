//! The language in which programs are written at compile time.

/// Writes a `const` [`Csg`](crate::Csg) from a nested expression, counting its nodes.
///
/// An expression is one of
/// - `Solid::constructor(arguments)`: a leaf; any fallible `const` constructor of a type that is a variant, of the
///   same name, of the leaf type;
/// - `BoxFrame::new(arguments)`, or a constructor of the other solids that are programs of the default leaf type
///   ([`DoubleCone`](crate::DoubleCone), [`WideSolidAngle`](crate::WideSolidAngle)): all of its nodes;
/// - `NAME`: another `const` program with the same leaf type;
/// - `union(a, b, ...)`, `intersection(a, b, ...)`: of two or more;
/// - `difference(a, b, ...)`: the first without all the others;
/// - `complement(a)`: all that is not in `a`: the same surface, the other side;
/// - `posed(frame, a)`: `a` in a frame of its own, 1 or above, posed at run time by
///   [`Program::posed`](crate::Program::posed).
///
/// A leaf type other than [`Leaf`](crate::Leaf) is named as in `const NAME: Type = ...`. A parameter that is refused
/// is a compile error that says why.
///
/// ```
/// use gsdf_nostd::{CappedCylinder, Cuboid, Sphere, csg};
/// use glam::{Vec3, vec3};
///
/// csg! { const BLOCK = intersection(Cuboid::new(Vec3::NEG_ONE, Vec3::ONE), Sphere::new(Vec3::ZERO, 1.35)) }
/// csg! {
///     /// A block with a hole.
///     pub const NUT = difference(BLOCK, CappedCylinder::new(vec3(0.0, -1.5, 0.0), vec3(0.0, 1.5, 0.0), Vec3::Y, 0.6))
/// }
///
/// assert_eq!(NUT.leaves(), 3);
/// assert_eq!(NUT.gsdf(vec3(0.0, 0.0, 4.0), Vec3::NEG_Z), 3.0);
/// assert_eq!(NUT.gsdf(vec3(0.0, 9.0, 0.0), Vec3::NEG_Y), f32::INFINITY);
/// ```
///
/// ```compile_fail
/// use gsdf_nostd::{Sphere, csg};
/// use glam::Vec3;
///
/// csg! { const NOTHING = union(Sphere::new(Vec3::ZERO, 1.0), Sphere::new(Vec3::ZERO, f32::NAN)) }
/// # let _ = NOTHING;
/// ```
#[macro_export]
macro_rules! csg {
    ($(#[$attribute:meta])* $visibility:vis const $name:ident = $($expression:tt)+) => {
        $crate::csg! { @flat [$(#[$attribute])* $visibility $name] ($crate::Leaf) [] ($($expression)+) }
    };
    ($(#[$attribute:meta])* $visibility:vis const $name:ident : $leaf:path = $($expression:tt)+) => {
        $crate::csg! { @flat [$(#[$attribute])* $visibility $name] ($leaf) [] ($($expression)+) }
    };

    // @flat: turns a list of expressions (..) and operators {..} into a list of postfix steps [..].
    (@flat $item:tt $leaf:tt $done:tt (union($($operands:tt)+)) $($rest:tt)*) => {
        $crate::csg! { @split $item $leaf $done {operator Union} [] [] [$($operands)+] $($rest)* }
    };
    (@flat $item:tt $leaf:tt $done:tt (intersection($($operands:tt)+)) $($rest:tt)*) => {
        $crate::csg! { @split $item $leaf $done {operator Intersection} [] [] [$($operands)+] $($rest)* }
    };
    (@flat $item:tt $leaf:tt $done:tt (difference($($operands:tt)+)) $($rest:tt)*) => {
        $crate::csg! { @split $item $leaf $done {operator Difference} [] [] [$($operands)+] $($rest)* }
    };
    (@flat $item:tt $leaf:tt $done:tt (complement($($operand:tt)+)) $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf $done ($($operand)+) {operator Complement} $($rest)* }
    };
    (@flat $item:tt $leaf:tt $done:tt (posed($frame:tt, $($operand:tt)+)) $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf $done ($($operand)+) {posed $frame} $($rest)* }
    };
    (@flat $item:tt $leaf:tt [$($done:tt)*] (BoxFrame :: $constructor:ident $arguments:tt) $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf [$($done)* {shape BoxFrame $constructor $arguments}] $($rest)* }
    };
    (@flat $item:tt $leaf:tt [$($done:tt)*] (DoubleCone :: $constructor:ident $arguments:tt) $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf [$($done)* {shape DoubleCone $constructor $arguments}] $($rest)* }
    };
    (@flat $item:tt $leaf:tt [$($done:tt)*] (WideSolidAngle :: $constructor:ident $arguments:tt) $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf [$($done)* {shape WideSolidAngle $constructor $arguments}] $($rest)* }
    };
    (@flat $item:tt $leaf:tt [$($done:tt)*] ($solid:ident :: $constructor:ident $arguments:tt) $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf [$($done)* {leaf $solid $constructor $arguments}] $($rest)* }
    };
    (@flat $item:tt $leaf:tt [$($done:tt)*] ($program:path) $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf [$($done)* {program $program}] $($rest)* }
    };
    (@flat $item:tt $leaf:tt [$($done:tt)*] {$($step:tt)+} $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf [$($done)* {$($step)+}] $($rest)* }
    };
    (@flat [$(#[$attribute:meta])* $visibility:vis $name:ident] ($leaf:path) [$($step:tt)+]) => {
        $(#[$attribute])*
        $visibility const $name: $crate::Csg<{ 0 $(+ $crate::csg!(@count $leaf, $step))+ }, $leaf> = $crate::valid!(
            $crate::csg!(@chain $leaf, $crate::Draft::new(), $($step)+).finish()
        );
    };

    // @split: operands at the commas; then the first, and each other followed by the operator.
    (@split $item:tt $leaf:tt $done:tt $operator:tt [$($operands:tt)*] [$($operand:tt)+] [, $($more:tt)*] $($rest:tt)*) => {
        $crate::csg! { @split $item $leaf $done $operator [$($operands)* ($($operand)+)] [] [$($more)*] $($rest)* }
    };
    (@split $item:tt $leaf:tt $done:tt $operator:tt $operands:tt [$($operand:tt)*] [$token:tt $($more:tt)*] $($rest:tt)*) => {
        $crate::csg! { @split $item $leaf $done $operator $operands [$($operand)* $token] [$($more)*] $($rest)* }
    };
    (@split $item:tt $leaf:tt $done:tt $operator:tt [$($operands:tt)+] [$($operand:tt)+] [] $($rest:tt)*) => {
        $crate::csg! { @split $item $leaf $done $operator [$($operands)+ ($($operand)+)] [] [] $($rest)* }
    };
    (@split $item:tt $leaf:tt $done:tt $operator:tt [$first:tt $($other:tt)+] [] [] $($rest:tt)*) => {
        $crate::csg! { @flat $item $leaf $done $first $($other $operator)+ $($rest)* }
    };

    // @count: the nodes of one step.
    (@count $leaf:path, {program $program:path}) => { $program.nodes().len() };
    (@count $leaf:path, {shape $shape:ident $constructor:ident $arguments:tt}) => { $shape::NODES };
    (@count $leaf:path, {posed $frame:tt}) => { 0 };
    (@count $leaf:path, {$($step:tt)+}) => { 1 };

    // @chain: the steps, as calls on a draft.
    (@chain $leaf:path, $draft:expr,) => { $draft };
    (@chain $leaf:path, $draft:expr, {operator $operator:ident} $($rest:tt)*) => {
        $crate::csg!(@chain $leaf, $draft.operator($crate::Node::$operator), $($rest)*)
    };
    (@chain $leaf:path, $draft:expr, {posed $frame:tt} $($rest:tt)*) => {
        $crate::csg!(@chain $leaf, $draft.posed($frame), $($rest)*)
    };
    (@chain $leaf:path, $draft:expr, {program $program:path} $($rest:tt)*) => {
        $crate::csg!(@chain $leaf, $draft.program($program.nodes()), $($rest)*)
    };
    (@chain $leaf:path, $draft:expr, {shape $shape:ident $constructor:ident $arguments:tt} $($rest:tt)*) => {
        $crate::csg!(@chain $leaf, $draft.program($crate::valid!($shape::$constructor $arguments).program().nodes()), $($rest)*)
    };
    (@chain $leaf:path, $draft:expr, {leaf $solid:ident $constructor:ident $arguments:tt} $($rest:tt)*) => {
        $crate::csg!(@chain $leaf, $draft.leaf(<$leaf>::$solid($crate::valid!($solid::$constructor $arguments))), $($rest)*)
    };
}
