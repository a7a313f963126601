//! The query of the images that are measured: written once, so that only what it links makes them differ.

use core::hint::black_box;

use glam::Vec3;
use gsdf_nostd::{Csg, Ray, Solid, Span};
use gsdf_parts::Fpu;

/// One ray cast at a scene in flash, for distance, normal and leaf. Neither scene nor ray nor result is known to the
/// compiler, or it would compute the result itself.
#[inline(never)]
pub fn ask<const N: usize, L: Solid>(scene: &Csg<N, L>) {
    let (origin, direction) = black_box((Vec3::new(0.0, 0.0, -3.0), Vec3::Z));
    if let Ok(ray) = Ray::new(origin, direction)
        && let Some(hit) = black_box(scene).cast(&ray)
    {
        black_box((hit.t, hit.normal, hit.leaf));
    }
}

/// The same for the distance alone, in scratch memory for `LEAVES` spans, with the square root of the FPU where there is
/// one: what is left of [`ask`] for who asks for no more than he needs.
#[inline(never)]
pub fn ask_distance<const LEAVES: usize, const N: usize, L: Solid>(scene: &Csg<N, L>) {
    let (origin, direction) = black_box((Vec3::new(0.0, 0.0, -3.0), Vec3::Z));
    let mut scratch = [Span::empty_like(Fpu(0.0)); LEAVES];
    if let Ok(ray) = Ray::new(origin, direction)
        && let Ok(sight) = black_box(scene).program().along(ray, &mut scratch)
    {
        black_box::<Fpu>(sight.gsdf());
    }
}
