//! The square root of the FPU, where stable Rust has no safe name for it.

use core::ops::{Add, Div, Mul, Neg, Sub};
use gsdf_nostd::{Lane, Real};

/// An `f32` whose square root is one instruction of the FPU: `vsqrt.f32` on Arm targets with hard floats, `fsqrt.s` on
/// RISC-V targets with the extension F. Elsewhere, and in all else, it is `f32` as `gsdf-nostd` has it.
///
/// The bits are those of `f32`: IEEE 754 rounds square roots correctly, and so do these instructions while the FPU
/// rounds to nearest and keeps subnormal numbers, as it does from reset on and as Rust requires of every program. The
/// cost is that of the instruction (14 cycles on a Cortex-M4F) instead of some fifty instructions of `libm`.
///
/// ```
/// use gsdf_nostd::{Ray, Span, Sphere, csg};
/// use gsdf_parts::Fpu;
/// use glam::{Vec3, vec3};
///
/// csg! { const BALL = Sphere::new(Vec3::ZERO, 1.0) }
/// let mut scratch = [Span::empty_like(Fpu(0.0)); 1];
/// let ray = Ray::new(vec3(0.0, 0.6, 3.0), Vec3::NEG_Z)?;
/// let distance: Fpu = BALL.program().along(ray, &mut scratch)?.gsdf();
/// assert_eq!(distance.0, BALL.gsdf(ray.origin(), ray.direction()));
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
#[repr(transparent)]
pub struct Fpu(pub f32);

impl Fpu {
    /// Whether this target has the instruction.
    pub const HAS_ROOT: bool = cfg!(root_instruction);
}

impl From<f32> for Fpu {
    #[inline(always)]
    fn from(value: f32) -> Self {
        Self(value)
    }
}

impl From<Fpu> for f32 {
    #[inline(always)]
    fn from(value: Fpu) -> Self {
        value.0
    }
}

macro_rules! operator {
    ($operator:ident $function:ident) => {
        impl $operator for Fpu {
            type Output = Self;
            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0.$function(other.0))
            }
        }
    };
}

operator!(Add add);
operator!(Sub sub);
operator!(Mul mul);
operator!(Div div);

impl Neg for Fpu {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Real for Fpu {
    type Mask = bool;
    type Scalar = Self;
    const LANES: usize = 1;

    #[inline(always)]
    fn splat_like(self, value: f32) -> Self {
        Self(value)
    }
    #[inline(always)]
    fn lift_like(self, value: Self) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(root(self.0))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(Real::abs(self.0))
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(Real::copysign(self.0, sign.0))
    }
    #[inline(always)]
    fn next_up(self) -> Self {
        Self(Real::next_up(self.0))
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        Real::lt(self.0, other.0)
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        Real::le(self.0, other.0)
    }
    #[inline(always)]
    fn eq(self, other: Self) -> bool {
        Real::eq(self.0, other.0)
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        Self(Real::select(mask, yes.0, no.0))
    }
}

impl Lane for Fpu {
    #[inline(always)]
    fn to_f32(self) -> f32 {
        self.0
    }
    #[inline(always)]
    fn to_index(self) -> u32 {
        self.0.to_index()
    }
}

#[cfg(not(root_instruction))]
#[inline(always)]
fn root(value: f32) -> f32 {
    Real::sqrt(value)
}

#[cfg(root_instruction)]
#[inline(always)]
#[allow(unsafe_code, reason = "the instruction has no safe name in stable Rust without a standard library")]
fn root(value: f32) -> f32 {
    // SAFETY: the build script sets `root_instruction` only for targets whose every processor has these instructions.
    // They change the registers that are named, touch neither memory nor stack, do not trap, and depend on nothing else
    // but the rounding mode, which Rust forbids to change: `pure`. They may raise the FPU's exception flags, which is
    // why `preserves_flags` is not claimed.
    unsafe {
        #[cfg(target_arch = "arm")]
        {
            let bits: u32;
            // By way of a core register: stable Rust does not let the FPU's be operands on these targets.
            core::arch::asm!(
                "vmov s0, {bits}",
                "vsqrt.f32 s0, s0",
                "vmov {bits}, s0",
                bits = inlateout(reg) value.to_bits() => bits,
                out("s0") _,
                options(pure, nomem, nostack)
            );
            f32::from_bits(bits)
        }
        #[cfg(any(target_arch = "riscv32", target_arch = "riscv64"))]
        {
            let root;
            core::arch::asm!("fsqrt.s {}, {}", lateout(freg) root, in(freg) value, options(pure, nomem, nostack));
            root
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Fpu;
    use gsdf_nostd::{Lane, Real};

    const NUMBERS: [f32; 19] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.1,
        3.0,
        -7.5,
        1e-20,
        1e20,
        16_777_216.0,
        5e9,
        f32::MIN_POSITIVE,
        1e-45,
        -1e-45,
        f32::MAX,
        f32::MIN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
    ];

    /// All NaN alike: their payloads are nobody's promise.
    fn bits(value: f32) -> u32 {
        if value.is_nan() { f32::NAN.to_bits() } else { value.to_bits() }
    }

    #[test]
    fn every_operation_is_that_of_f32() {
        type Pair<T> = (fn(T, T) -> T, &'static str);
        fn operations<T: Real<Mask = bool>>() -> [Pair<T>; 15] {
            [
                (|a, b| a + b, "sum"),
                (|a, b| a - b, "difference"),
                (|a, b| a * b, "product"),
                (|a, b| a / b, "quotient"),
                (|a, _| -a, "negation"),
                (|a, _| a.sqrt(), "root"),
                (|a, _| a.abs(), "magnitude"),
                (|a, b| a.copysign(b), "sign"),
                (|a, _| a.next_up(), "next"),
                (|a, b| a.min(b), "minimum"),
                (|a, b| a.max(b), "maximum"),
                (|a, b| T::select(a.lt(b), a, b.splat_like(2.0)), "less"),
                (|a, b| T::select(a.le(b), a, b.splat_like(2.0)), "at most"),
                (|a, b| T::select(a.eq(b), a, b.splat_like(2.0)), "equal"),
                (|a, b| a.squared() - b, "square"),
            ]
        }
        for ((ours, name), (theirs, _)) in operations::<Fpu>().into_iter().zip(operations::<f32>()) {
            for a in NUMBERS {
                for b in NUMBERS {
                    assert_eq!(bits(ours(Fpu(a), Fpu(b)).0), bits(theirs(a, b)), "{name} of {a} and {b}");
                }
            }
        }
    }

    #[test]
    fn conversions_are_those_of_f32() {
        for a in NUMBERS {
            assert_eq!(Fpu::from(a).to_index(), a.to_index(), "{a}");
            for b in [
                Fpu::from(a).to_f32(),
                Fpu(a).into(),
                Fpu(1.0).lift_like(Fpu(a)).0,
                Fpu(1.0).splat_like(a).0,
            ] {
                assert_eq!(bits(b), bits(a));
            }
        }
    }
}
