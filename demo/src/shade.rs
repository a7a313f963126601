//! The light: one sun with hard shadows, the sky above and the ground below, and some haze.

use crate::scenes::Look;
use glam::{Vec3, vec3};
use gsdf_nostd::{Departure, Hit, Program, Ray, Span};

/// Towards the sun: over the right shoulder of the cameras, so that three faces of a box get three different lights.
const SUN: Vec3 = vec3(0.56, 0.74, -0.372_6);
/// What the sun gives to a surface it meets squarely.
const SUNLIGHT: Vec3 = vec3(0.92, 0.85, 0.74);
/// What the sky gives to a surface that faces up.
const SKYLIGHT: Vec3 = vec3(0.24, 0.29, 0.36);
/// What the ground throws back to a surface that faces down.
const GROUND_LIGHT: Vec3 = vec3(0.12, 0.11, 0.10);
/// How strong the glint of the sun is, and how narrow.
const GLINT: (f32, i32) = (0.14, 90);
/// The background at the top of the picture, and at the bottom.
const BACKDROP: [Vec3; 2] = [vec3(0.22, 0.34, 0.48), vec3(0.78, 0.79, 0.77)];

/// The background at a height of the picture, from 0 at the top to 1 at the bottom.
#[must_use]
pub fn backdrop(height: f32) -> Vec3 {
    // Smooth at both ends.
    let eased = height * height * (3.0 - 2.0 * height);
    BACKDROP[0].lerp(BACKDROP[1], eased)
}

/// The light that comes back along a ray from what it has hit. `behind` is what would be seen without it, `spans` scratch memory for one ray.
///
/// No epsilon anywhere: the way to the sun is a [`Departure`], which knows the surface it starts on.
#[must_use]
pub fn shade(program: &Program<'_>, spans: &mut [Span<f32>], look: &Look, ray: &Ray, hit: &Hit, behind: Vec3) -> Vec3 {
    let view = ray.direction().normalize();
    let albedo = (look.paint)(hit.leaf);

    let facing = hit.normal.dot(SUN);
    let sun = if facing > 0.0 && sees_the_sun(program, spans, hit) {
        facing
    } else {
        0.0
    };
    let sky = SKYLIGHT.lerp(GROUND_LIGHT, 0.5 - 0.5 * hit.normal.y);
    let mut light = albedo * (SUNLIGHT * sun + sky);
    if sun > 0.0 {
        let half = (SUN - view).normalize();
        light += SUNLIGHT * GLINT.0 * hit.normal.dot(half).max(0.0).powi(GLINT.1);
    }

    let distance = ray.origin().distance(hit.point) / look.haze;
    behind.lerp(light, (-distance * distance).exp())
}

/// Whether nothing stands between a hit and the sun.
fn sees_the_sun(program: &Program<'_>, spans: &mut [Span<f32>], hit: &Hit) -> bool {
    // Neither can fail: the sun is a direction, and the scratch memory served the hit already.
    Departure::new(hit, SUN)
        .ok()
        .and_then(|departure| program.along(departure, spans).ok())
        .is_some_and(|sight| sight.march().t == f32::INFINITY)
}

#[cfg(test)]
mod tests {
    use super::{BACKDROP, SUN, backdrop, sees_the_sun};
    use crate::scenes::s1;
    use anyhow::{Context, Result};
    use glam::{Vec3, vec3};
    use gsdf_nostd::{Ray, Span};

    #[test]
    fn the_sun_is_a_direction() {
        assert!((SUN.length() - 1.0).abs() < 1e-3);
    }

    #[test]
    fn the_backdrop_runs_from_end_to_end() {
        assert_eq!([backdrop(0.0), backdrop(1.0)], BACKDROP);
    }

    #[test]
    fn the_ball_throws_its_shadow_away_from_the_sun_and_none_on_its_lit_side() -> Result<()> {
        let scene = s1();
        let program = scene.program()?;
        let mut spans = vec![Span::EMPTY; program.leaves()];
        let mut lit = |from: Vec3, to: Vec3| {
            let ray = Ray::new(from, to - from)?;
            let hit = program.along(ray, &mut spans)?.cast().context("a miss")?;
            anyhow::Ok(sees_the_sun(&program, &mut spans, &hit))
        };
        let ball = vec3(0.0, 1.0, 0.0);
        let shadow = ball - SUN / SUN.y;
        assert!(!lit(shadow + vec3(-2.0, 1.0, 0.0), shadow)?);
        assert!(lit(vec3(5.0, 5.0, -5.0), vec3(3.0, 0.0, 0.0))?);
        assert!(lit(ball + 4.0 * SUN, ball)?);
        Ok(())
    }
}
