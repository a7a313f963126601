//! Error against distance, as a chart.

use super::trial::{Arithmetic, Placed, Reference, Trial};
use crate::shape::{Shape, across};
use glam::Vec3;
use plotters::prelude::*;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use std::error::Error;

/// Rays at each distance.
const RAYS: usize = 1000;

/// The solids of the chart, of radius 1 or with a side at 45 degrees.
fn exhibits() -> [(&'static str, Shape); 3] {
    let (point, axis) = (Vec3::new(0.3, -0.2, 0.1), Vec3::new(0.6, 0.0, 0.8));
    [
        (
            "sphere",
            Shape::Sphere {
                center: point,
                radius: 1.0,
            },
        ),
        ("cylinder", Shape::Cylinder { point, axis, radius: 1.0 }),
        (
            "cone",
            Shape::Nappe {
                apex: point,
                axis,
                radius: 1.0,
                height: 1.0,
            },
        ),
    ]
}

/// The distances, in radii: four in each octave from 1 to 1e7.
fn distances() -> impl Iterator<Item = f64> {
    (0..=93_i32)
        .map(|step| (f64::from(step) / 4.0).exp2())
        .filter(|distance| *distance <= 1e7)
}

/// For each distance, the error of the first crossing that one ray in a hundred exceeds, in radii; a ray that should hit
/// and does not is off by the distance.
fn errors(shape: &Shape, arithmetic: Arithmetic) -> Vec<(f64, f64)> {
    let leaf = shape.leaf().expect("the exhibits are valid shapes");
    let distances: Vec<f64> = distances().collect();
    let at = |(number, &distance): (usize, &f64)| {
        let reference = Reference::new(Placed::in_world(*shape));
        let mut rng = Pcg64::seed_from_u64(number as u64);
        let mut errors = Vec::new();
        while errors.len() < RAYS {
            let (point, normal) = shape.surface(&mut rng);
            // From where the point is seen, at any angle but a grazing one.
            let lean: f64 = rng.random_range(0.0..0.9);
            let away = normal * (1.0 - lean * lean).sqrt() + across(&mut rng, normal) * lean;
            let origin = (point + away * distance).as_vec3();
            let direction = (point - origin.as_dvec3()).normalize().as_vec3();
            let trial = Trial {
                solid: Placed::in_world(*shape),
                origin,
                direction,
            };
            let truth = reference
                .swift(origin, direction)
                .unwrap_or_else(|| reference.slow(origin, direction));
            let Some(t) = truth.and_then(|[enter, _]| enter) else { continue };
            let off = trial
                .computed(&leaf, arithmetic)
                .map_or(distance, |[enter, _]| t.distance_to(enter).abs());
            errors.push(off.min(distance));
        }
        errors.sort_by(f64::total_cmp);
        // On a logarithmic scale there is no zero.
        (distance, errors[RAYS - RAYS / 100].max(1e-17))
    };
    distances.par_iter().enumerate().map(at).collect()
}

/// The chart as an SVG file.
///
/// # Errors
/// Where it cannot be drawn.
pub fn svg() -> Result<String, Box<dyn Error>> {
    const SIZE: (u32, u32) = (960, 360);
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        for ((name, shape), panel) in exhibits().iter().zip(area.split_evenly((1, 3))) {
            let mut chart = ChartBuilder::on(&panel)
                .margin(8)
                .caption(*name, ("sans-serif", 16))
                .x_label_area_size(36)
                .y_label_area_size(52)
                .build_cartesian_2d((1.0..1e7).log_scale(), (1e-17..1e8).log_scale())?;
            let power = |value: &f64| format!("1e{:.0}", value.log10());
            chart
                .configure_mesh()
                .disable_mesh()
                .x_desc("distance / radius")
                .y_desc("error / radius, p99")
                .x_labels(8)
                .y_labels(14)
                .x_label_formatter(&power)
                .y_label_formatter(&power)
                .draw()?;
            for (arithmetic, colour) in [
                (Arithmetic::Plain, RGBColor(200, 80, 40)),
                (Arithmetic::Robust, RGBColor(30, 100, 200)),
                (Arithmetic::Double, RGBColor(20, 130, 60)),
            ] {
                let line = LineSeries::new(errors(shape, arithmetic), colour.stroke_width(2));
                chart
                    .draw_series(line)?
                    .label(arithmetic.name())
                    .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 16, y)], colour.stroke_width(2)));
            }
            chart
                .configure_series_labels()
                .position(SeriesLabelPosition::UpperLeft)
                .border_style(BLACK.mix(0.3))
                .draw()?;
        }
        area.present()?;
    }
    Ok(text)
}

/// A line of Markdown that shows an SVG file it holds.
#[must_use]
pub fn markdown(svg: &str) -> String {
    let data = base64::engine::Engine::encode(&base64::prelude::BASE64_STANDARD, svg);
    format!("<img alt=\"Error against distance, of plain f32, robust f32 and f64\" src=\"data:image/svg+xml;base64,{data}\">\n")
}

#[cfg(test)]
mod tests {
    use super::distances;

    #[test]
    fn the_chart_goes_from_one_radius_to_ten_million() {
        let distances: Vec<f64> = distances().collect();
        assert_eq!(distances[0], 1.0);
        assert!(distances.last().is_some_and(|last| *last > 8e6));
    }
}
