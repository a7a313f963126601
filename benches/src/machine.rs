//! Where and from what a report comes: the processor, the system, the compiler and its flags, the day.

use std::fmt;
use std::time::{SystemTime, UNIX_EPOCH};

/// What must stand beside a number that depends on a machine.
#[derive(Clone, Debug)]
pub struct Machine {
    /// The processor's name for itself, where the system tells.
    pub processor: String,
    /// How many threads it runs at a time.
    pub cores: usize,
    /// How many were at work before, on average over a minute, where the system tells.
    pub load: Option<f64>,
    /// The day, as ISO 8601 has it, in UTC.
    pub date: String,
}

/// The compiler that built this.
pub const COMPILER: &str = env!("GSDF_COMPILER");
/// The target it built for.
pub const TARGET: &str = env!("GSDF_TARGET");
/// The flags it was given beyond the profile's.
pub const FLAGS: &str = env!("GSDF_FLAGS");
/// The optimisation level.
pub const OPT_LEVEL: &str = env!("GSDF_OPT_LEVEL");
/// The processor's abilities it was allowed to use.
pub const TARGET_FEATURES: &str = env!("GSDF_TARGET_FEATURES");

impl Machine {
    /// This one, now.
    #[must_use]
    pub fn here() -> Self {
        let days = SystemTime::now()
            .duration_since(UNIX_EPOCH)
            .map_or(0, |elapsed| elapsed.as_secs() / 86_400);
        Self {
            processor: processor().unwrap_or_else(|| "unknown".to_owned()),
            cores: std::thread::available_parallelism().map_or(1, usize::from),
            load: load(),
            date: date(days),
        }
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "date      {}", self.date)?;
        write!(f, "machine   {}, {} threads, {}", self.processor, self.cores, std::env::consts::OS)?;
        match self.load {
            Some(load) => writeln!(f, ", load before {load:.2}")?,
            None => writeln!(f)?,
        }
        writeln!(f, "compiler  {COMPILER}, {TARGET}, opt-level {OPT_LEVEL}")?;
        writeln!(f, "flags     {}", if FLAGS.is_empty() { "none" } else { FLAGS })?;
        write!(f, "features  {TARGET_FEATURES}")
    }
}

/// The processor's name, as Linux tells it.
fn processor() -> Option<String> {
    let facts = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let named = facts.lines().find(|line| line.starts_with("model name"))?;
    Some(named.split_once(':')?.1.trim().to_owned())
}

/// The load, as Linux tells it.
fn load() -> Option<f64> {
    std::fs::read_to_string("/proc/loadavg")
        .ok()?
        .split_whitespace()
        .next()?
        .parse()
        .ok()
}

/// The most bytes of memory that this process had at a time so far, as Linux tells it.
#[must_use]
pub fn most_memory() -> Option<u64> {
    let facts = std::fs::read_to_string("/proc/self/status").ok()?;
    let most = facts.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(most.trim().strip_suffix("kB")?.trim().parse::<u64>().ok()? << 10)
}

/// The date so many days after 1 January 1970, in the calendar's cycles of 400 years that begin on 1 March 2000.
fn date(days: u64) -> String {
    // Counted from 1 March of the year 0, leap days come last in a year, a century and a cycle.
    let day = days + 719_468;
    let (cycle, day) = (day / 146_097, day % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (month, next) = if month < 10 { (month + 3, 0) } else { (month - 9, 1) };
    format!("{:04}-{month:02}-{day:02}", 400 * cycle + year + next)
}

#[cfg(test)]
mod tests {
    use super::{COMPILER, Machine, TARGET, date};

    #[test]
    fn days_become_dates() {
        let known = [
            (0, "1970-01-01"),
            (59, "1970-03-01"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_088, "2024-12-31"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
        ];
        for (days, expected) in known {
            assert_eq!(date(days), expected);
        }
    }

    #[test]
    fn a_report_says_what_built_it() {
        assert!(COMPILER.starts_with("rustc") && !TARGET.is_empty());
        let head = Machine::here().to_string();
        assert!(head.contains(COMPILER) && head.contains(TARGET), "{head}");
    }
}
