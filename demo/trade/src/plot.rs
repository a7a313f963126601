//! The trade as a picture.

use super::measure::Measured;
use anyhow::{Result, anyhow};
use plotters::prelude::*;
use std::fmt::Display;

/// Errors below this are drawn there: a logarithmic scale has no zero.
const LEAST: f64 = 1e-9;

const TIER: RGBColor = RGBColor(30, 100, 200);
const TRACER: RGBColor = RGBColor(200, 80, 40);

/// A chart for each scene: time against error. A mark is at the error that one hit in a hundred exceeds, the thin line above
/// it reaches to the worst; the grey line joins those that no other one beats. Tracers go by their epsilon and most steps.
///
/// # Errors
/// Where it cannot be drawn.
pub fn svg(measured: &[Measured]) -> Result<String> {
    const PANEL: (u32, u32) = (560, 520);
    let mut scenes: Vec<&str> = Vec::new();
    for one in measured {
        if !scenes.contains(&one.scene.as_str()) {
            scenes.push(&one.scene);
        }
    }
    let mut text = String::new();
    {
        let size = (PANEL.0 * scenes.len().max(1) as u32, PANEL.1);
        let area = SVGBackend::with_string(&mut text, size).into_drawing_area();
        area.fill(&WHITE).map_err(undrawn)?;
        for (scene, panel) in scenes.iter().zip(area.split_evenly((1, scenes.len().max(1)))) {
            let own: Vec<&Measured> = measured.iter().filter(|one| one.scene == *scene).collect();
            draw(&panel, scene, &own)?;
        }
        area.present().map_err(undrawn)?;
    }
    Ok(text)
}

fn undrawn(error: impl Display) -> anyhow::Error {
    anyhow!("cannot draw the chart: {error}")
}

type Panel<'a> = DrawingArea<SVGBackend<'a>, plotters::coord::Shift>;

fn draw(panel: &Panel<'_>, scene: &str, measured: &[&Measured]) -> Result<()> {
    let fastest = measured.iter().map(|one| one.ns).fold(f64::INFINITY, f64::min);
    let slowest = measured.iter().map(|one| one.ns).fold(0.0, f64::max);
    let mut chart = ChartBuilder::on(panel)
        .margin(10)
        .caption(
            format!("{scene}: filled marks are packets and tiles, hollow ones single rays"),
            ("sans-serif", 14),
        )
        .x_label_area_size(40)
        .y_label_area_size(56)
        // Room for the names beside the marks.
        .build_cartesian_2d((fastest / 2.0..slowest * 6.0).log_scale(), (LEAST / 2.0..10.0).log_scale())
        .map_err(undrawn)?;
    chart
        .configure_mesh()
        .light_line_style(WHITE)
        .x_desc("ns per ray")
        .y_desc("relative error: p99, up to the worst")
        .x_label_formatter(&|ns| format!("{ns:.0}"))
        .y_label_formatter(&|error| format!("1e{:.0}", error.log10()))
        .draw()
        .map_err(undrawn)?;
    let place = |error: f64| error.clamp(LEAST, 5.0);
    let mut best: Vec<(f64, f64)> = measured
        .iter()
        .filter(|one| one.is_best)
        .map(|one| (one.ns, place(one.p99)))
        .collect();
    best.sort_by(|a, b| a.0.total_cmp(&b.0));
    chart
        .draw_series(LineSeries::new(best, BLACK.mix(0.3).stroke_width(4)))
        .map_err(undrawn)?;
    let mut labelled = Vec::new();
    for one in measured {
        let colour = if one.contender.starts_with("traced") { TRACER } else { TIER };
        let (p99, worst) = (place(one.p99), place(one.worst));
        let to_worst = PathElement::new(vec![(one.ns, p99), (one.ns, worst)], colour.mix(0.5));
        chart.draw_series([to_worst]).map_err(undrawn)?;
        let is_packet = !one.contender.ends_with("scalar");
        let style = if is_packet { colour.filled() } else { colour.stroke_width(2) };
        chart.draw_series([Circle::new((one.ns, p99), 4, style)]).map_err(undrawn)?;
        if labelled.iter().any(|&place| is_beside(place, (one.ns, p99))) {
            continue;
        }
        labelled.push((one.ns, p99));
        let name = one.contender.split(", ").next().unwrap_or_default();
        let wrong = if one.wrong > 0 {
            format!(" ({} wrong)", one.wrong)
        } else {
            String::new()
        };
        let label = Text::new(
            format!("  {}{wrong}", name.trim_start_matches("traced ")),
            (one.ns, p99),
            ("sans-serif", 11).into_font().color(&BLACK.mix(0.7)),
        );
        chart.draw_series([label]).map_err(undrawn)?;
    }
    Ok(())
}

/// Whether names beside two marks would be written over each other.
fn is_beside(a: (f64, f64), b: (f64, f64)) -> bool {
    (a.0 / b.0).log10().abs() < 0.25 && (a.1 / b.1).log10().abs() < 0.3
}
