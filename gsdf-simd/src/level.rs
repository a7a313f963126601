//! The levels of vector instructions: which of them this machine has, and which is used.

#[cfg(all(feature = "std", target_arch = "x86_64"))]
use crate::lanes::{Avx2x8, Avx512x16};
use crate::lanes::{F32x8, Lanes};
use core::fmt;
use core::str::FromStr;

/// How wide the vectors are that packets are computed in: which of the [lane types](Lanes) is used.
///
/// A level that the machine lacks cannot be had, so that there is nothing to check where one is used. All levels give
/// the same bits.
///
/// ```
/// use gsdf_simd::Level;
///
/// assert!(Level::available().any(|level| level == Level::best()));
/// assert_eq!("portable".parse(), Ok(Level::PORTABLE));
/// assert!("mmx".parse::<Level>().is_err());
/// ```
#[derive(Clone, Copy)]
pub struct Level(Kind);

#[derive(Clone, Copy)]
enum Kind {
    Portable,
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Avx2(<Avx2x8 as Lanes>::Token),
    #[cfg(all(feature = "std", target_arch = "x86_64"))]
    Avx512(<Avx512x16 as Lanes>::Token),
}

/// What is done in lanes, of whatever type: a function of one generic parameter, as a value.
pub trait Work {
    /// What comes of it.
    type Output;

    /// Does it in lanes of a type, whose values are made from `token`.
    ///
    /// This is not yet compiled for the type's instructions: the part of it that computes belongs into
    /// [`Lanes::vectorize`].
    fn run<T: Lanes>(self, token: T::Token) -> Self::Output;
}

impl Level {
    /// Eight lanes in the vectors of the build's own target, such as SSE2, NEON, simd128 or, in a build for the native
    /// processor, AVX2: there on every machine.
    pub const PORTABLE: Self = Self(Kind::Portable);

    /// The levels that this machine has, from the narrowest to the widest.
    ///
    /// Besides the [portable](Self::PORTABLE) one these are, on x86-64 and with the feature `std`: `avx2`, eight lanes,
    /// for processors from Haswell and Zen on (x86-64-v3); `avx512`, sixteen lanes, from Ice Lake and Zen 4 on.
    pub fn available() -> impl Iterator<Item = Self> {
        #[cfg(all(feature = "std", target_arch = "x86_64"))]
        let wider = [Avx2x8::detect().map(Kind::Avx2), Avx512x16::detect().map(Kind::Avx512)];
        #[cfg(not(all(feature = "std", target_arch = "x86_64")))]
        let wider: [Option<Kind>; 0] = [];
        core::iter::once(Self::PORTABLE).chain(wider.into_iter().flatten().map(Self))
    }

    /// The widest level that this machine has.
    #[must_use]
    pub fn best() -> Self {
        Self::available().last().unwrap_or(Self::PORTABLE)
    }

    /// The level that the environment variable `GSDF_LEVEL` names; the [best](Self::best) where it is not set or empty.
    ///
    /// # Errors
    /// Where it names none of this machine's.
    #[cfg(feature = "std")]
    pub fn chosen() -> Result<Self, LevelError> {
        Self::of_variable(&std::env::var_os("GSDF_LEVEL").unwrap_or_default())
    }

    /// The level that the variable has for its value.
    #[cfg(feature = "std")]
    fn of_variable(value: &std::ffi::OsStr) -> Result<Self, LevelError> {
        if value.is_empty() {
            return Ok(Self::best());
        }
        let name = value.to_string_lossy();
        name.parse().map_err(|_| LevelError::Variable(name.into_owned()))
    }

    /// What the level is called.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self.0 {
            Kind::Portable => "portable",
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Kind::Avx2(_) => "avx2",
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Kind::Avx512(_) => "avx512",
        }
    }

    /// How many rays a packet has.
    #[must_use]
    pub fn lanes(self) -> usize {
        self.run(CountLanes)
    }

    /// Does work in lanes of the level's type.
    pub fn run<W: Work>(self, work: W) -> W::Output {
        match self.0 {
            Kind::Portable => work.run::<F32x8>(()),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Kind::Avx2(token) => work.run::<Avx2x8>(token),
            #[cfg(all(feature = "std", target_arch = "x86_64"))]
            Kind::Avx512(token) => work.run::<Avx512x16>(token),
        }
    }
}

struct CountLanes;

impl Work for CountLanes {
    type Output = usize;

    fn run<T: Lanes>(self, _: T::Token) -> usize {
        T::LANES
    }
}

impl PartialEq for Level {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Level {}

impl fmt::Display for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl fmt::Debug for Level {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Level({})", self.name())
    }
}

impl FromStr for Level {
    type Err = LevelError;

    fn from_str(name: &str) -> Result<Self, LevelError> {
        Self::available().find(|level| level.name() == name).ok_or(LevelError::Lacking)
    }
}

/// Why there is no such level.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LevelError {
    /// No level of this machine has that name.
    Lacking,
    /// Nor has one this, which is the value of the environment variable `GSDF_LEVEL`.
    #[cfg(feature = "std")]
    Variable(std::string::String),
}

impl fmt::Display for LevelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Lacking => {}
            #[cfg(feature = "std")]
            Self::Variable(value) => write!(f, "GSDF_LEVEL is `{value}`: ")?,
        }
        f.write_str("the levels of this machine are")?;
        for (number, level) in Level::available().enumerate() {
            write!(f, "{} {level}", if number > 0 { "," } else { "" })?;
        }
        Ok(())
    }
}

impl core::error::Error for LevelError {}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::{Level, LevelError};

    #[test]
    fn levels_are_found_by_their_names() {
        for level in Level::available() {
            assert_eq!(level.name().parse(), Ok(level));
            assert_eq!(format!("{level:>9}").trim(), level.name());
        }
        assert_eq!("".parse::<Level>(), Err(LevelError::Lacking));
        assert_eq!("AVX2".parse::<Level>(), Err(LevelError::Lacking));
    }

    #[test]
    fn levels_ascend_from_the_portable_one_to_the_best() {
        let levels: Vec<_> = Level::available().collect();
        assert_eq!((levels.first(), levels.last()), (Some(&Level::PORTABLE), Some(&Level::best())));
        assert!(levels.is_sorted_by_key(|level| level.lanes()));
        assert!(levels.windows(2).all(|pair| pair[0] != pair[1]));
    }

    #[test]
    fn a_variable_that_is_not_set_leaves_the_best() {
        assert_eq!(Level::of_variable("".as_ref()), Ok(Level::best()));
        for level in Level::available() {
            assert_eq!(Level::of_variable(level.name().as_ref()), Ok(level));
        }
    }

    #[test]
    fn what_the_machine_lacks_is_refused_with_what_it_has() {
        let error = Level::of_variable("mmx".as_ref()).unwrap_err();
        assert_eq!(error, LevelError::Variable("mmx".into()));
        let message = error.to_string();
        assert!(message.contains("GSDF_LEVEL is `mmx`"), "{message}");
        for level in Level::available() {
            assert!(message.contains(level.name()), "{message}");
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[test]
    fn the_processor_is_asked() {
        let names: Vec<_> = Level::available().map(Level::name).collect();
        // Every processor that has these was made with the rest of its level, except under odd hypervisors.
        assert_eq!(names.contains(&"avx2"), std::arch::is_x86_feature_detected!("avx2"));
        assert_eq!(names.contains(&"avx512"), std::arch::is_x86_feature_detected!("avx512vbmi2"));
    }
}
