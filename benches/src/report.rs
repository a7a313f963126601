//! The race as a table to read and as CSV to publish.

use crate::arena::{EPSILON, MAX_STEPS};
use crate::frame::DEPTH_TOLERANCE;
use crate::machine::{self, Machine};
use crate::race::{Outcome, Rules, Side};
use std::fmt::Write;

/// What stands above the table: everything that must be known to repeat it.
#[must_use]
pub fn head(machine: &Machine, rules: &Rules, ceiling: f64) -> String {
    let Rules {
        rounds, threads, level, ..
    } = rules;
    format!(
        "{machine}\n\
         threads   {threads} do {ceiling:.2} times the work of one here and now, at a loop without memory: the ceiling of any picture\n\
         rules     {rounds} rounds, A and B by turns in one process; medians; intervals of the ratios from order statistics\n\
         level     {level}: packets of {} rays\n\
         tiles     of 16 x 16 pixels; only what a tile's beam may meet is looked at. The scene is prepared before the clock starts; what depends on\n          \
         the camera, and finding what the beams meet, is within. Stored tile by tile: distance, normal and leaf; bare: distance and leaf\n\
         packets   and rays: every leaf along every ray and at every step; stored as records, row by row\n\
         marcher   distance alone stored; epsilon {EPSILON:e} relative, {MAX_STEPS} steps, the faster relaxation, ends just beyond the farthest\n          \
         thing in the picture\n\
         sizes     both sides of a line render the same picture; lines of different sizes are not to be compared\n\
         wrong     pixels where the marcher hits and the closed form does not + misses + depths off by more than {DEPTH_TOLERANCE:e}\n\
         seeds     none: each ray goes through the centre of its pixel\n",
        level.lanes()
    )
}

/// The names of the columns.
#[must_use]
pub fn columns() -> String {
    format!(
        "{:<7} {:>5} {:<25} {:<25} {:>9} {:>9} {:>7}  {:<19} {}",
        "scene", "size", "A", "B", "A ns/px", "B ns/px", "B/A", "interval", "wrong of B"
    )
}

/// One outcome as a line of the table.
#[must_use]
pub fn line(outcome: &Outcome) -> String {
    let Outcome { ratio, .. } = outcome;
    let interval = format!("{:.2}..{:.2} ({:.0} %)", ratio.interval.0, ratio.interval.1, 100.0 * ratio.coverage);
    let mut line = format!(
        "{:<7} {:>5} {:<25} {:<25} {:>9.2} {:>9.2} {:>7.2}  {interval:<19}",
        outcome.scene,
        outcome.size,
        side(outcome.a),
        side(outcome.b),
        outcome.a_ns,
        outcome.b_ns,
        ratio.median,
    );
    if let (Some(wrong), Some(relaxation)) = (outcome.wrong, outcome.relaxation) {
        // Writing to a string cannot fail.
        let _ = write!(
            line,
            " {} + {} + {}, relaxation {relaxation:.1}",
            wrong.false_hits, wrong.false_misses, wrong.misplaced
        );
    }
    line.truncate(line.trim_end().len());
    line
}

fn side(side: Side) -> String {
    match side.threads {
        1 => side.contender.name().to_owned(),
        threads => format!("{}, {threads} threads", side.contender.name().replace("closed form, ", "closed ")),
    }
}

/// The first line of the CSV.
pub const CSV_HEAD: &str = "date,processor,processor_threads,load,os,compiler,target,opt_level,flags,target_features,thread_ceiling,\
scene,leaves,level,size,hit_rate,a,a_threads,b,b_threads,rounds,a_ns_per_pixel,b_ns_per_pixel,ratio,ratio_low,ratio_high,coverage,\
relaxation,false_hits,false_misses,misplaced";

/// One outcome as a line of CSV, which needs no other to be understood.
#[must_use]
pub fn csv_line(machine: &Machine, ceiling: f64, outcome: &Outcome) -> String {
    let optional = |value: Option<String>| value.unwrap_or_default();
    let wrong = outcome.wrong;
    let fields = [
        machine.date.clone(),
        machine.processor.clone(),
        machine.cores.to_string(),
        optional(machine.load.map(|load| load.to_string())),
        std::env::consts::OS.to_owned(),
        machine::COMPILER.to_owned(),
        machine::TARGET.to_owned(),
        machine::OPT_LEVEL.to_owned(),
        machine::FLAGS.to_owned(),
        machine::TARGET_FEATURES.to_owned(),
        ceiling.to_string(),
        outcome.scene.to_owned(),
        outcome.leaves.to_string(),
        outcome.level.to_string(),
        outcome.size.to_string(),
        outcome.hit_rate.to_string(),
        outcome.a.contender.name().to_owned(),
        outcome.a.threads.to_string(),
        outcome.b.contender.name().to_owned(),
        outcome.b.threads.to_string(),
        outcome.rounds.to_string(),
        outcome.a_ns.to_string(),
        outcome.b_ns.to_string(),
        outcome.ratio.median.to_string(),
        outcome.ratio.interval.0.to_string(),
        outcome.ratio.interval.1.to_string(),
        outcome.ratio.coverage.to_string(),
        optional(outcome.relaxation.map(|relaxation| relaxation.to_string())),
        optional(wrong.map(|wrong| wrong.false_hits.to_string())),
        optional(wrong.map(|wrong| wrong.false_misses.to_string())),
        optional(wrong.map(|wrong| wrong.misplaced.to_string())),
    ];
    fields.map(|field| quoted(&field)).join(",")
}

/// A field as RFC 4180 has it: in quotes where it holds a comma, a quote or an end of a line.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::{CSV_HEAD, columns, csv_line, head, line, quoted};
    use crate::contender::Contender;
    use crate::frame::Wrong;
    use crate::machine::Machine;
    use crate::race::{Outcome, Rules, Side};
    use crate::stats::Estimate;
    use gsdf_simd::Level;

    fn outcome() -> Outcome {
        let alone = |contender| Side { contender, threads: 1 };
        Outcome {
            scene: "s1",
            leaves: 2,
            level: Level::PORTABLE,
            size: 64,
            hit_rate: 0.75,
            a: alone(Contender::ClosedPackets),
            b: alone(Contender::TracedPackets),
            a_ns: 2.5,
            b_ns: 25.0,
            ratio: Estimate {
                median: 10.0,
                interval: (9.5, 10.5),
                coverage: 0.965,
            },
            rounds: 15,
            relaxation: Some(1.2),
            wrong: Some(Wrong {
                false_hits: 1,
                false_misses: 2,
                misplaced: 3,
            }),
        }
    }

    #[test]
    fn fields_are_quoted_where_they_must_be() {
        assert_eq!(quoted("plain"), "plain");
        assert_eq!(quoted("a, \"b\""), "\"a, \"\"b\"\"\"");
    }

    #[test]
    fn every_line_has_as_many_fields_as_the_head() {
        let machine = Machine {
            processor: "no commas".to_owned(),
            ..Machine::here()
        };
        let line = csv_line(&machine, 2.0, &outcome());
        // The features of the target are one field with commas in it.
        let (mut fields, mut within) = (1, false);
        for c in line.chars() {
            within ^= c == '"';
            fields += usize::from(c == ',' && !within);
        }
        assert_eq!(fields, CSV_HEAD.split(',').count());
        assert!(line.ends_with(",10,9.5,10.5,0.965,1.2,1,2,3"), "{line}");
    }

    #[test]
    fn the_table_shows_ratio_interval_and_wrong_pixels() {
        let line = line(&outcome());
        assert!(
            line.contains("10.00  9.50..10.50 (96 %)") && line.ends_with("1 + 2 + 3, relaxation 1.2"),
            "{line}"
        );
        assert!(columns().starts_with("scene"));
        let rules = Rules {
            rounds: 15,
            size: 64,
            threads: 2,
            level: Level::PORTABLE,
        };
        let head = head(&Machine::here(), &rules, 1.97);
        assert!(head.contains("15 rounds") && head.contains("2 do 1.97 times"), "{head}");
        assert!(head.contains("portable: packets of 8 rays"), "{head}");
    }
}
