//! Files that are either whole or not there, and a standard output that may go away.

use anyhow::{Context, Result};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{EncodableLayout, ImageBuffer, PixelWithColorType, RgbImage};
use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::time::Duration;

/// The age from which on an unfinished file is one that nobody writes any more.
const STALE: Duration = Duration::from_secs(600);

/// Makes sure of a directory that can be written to, before any work is put into what shall lie in it, and removes what runs that were killed left unfinished there.
///
/// # Errors
/// Where it cannot be made, or no file can be made in it.
pub fn prepare(directory: &Path) -> Result<()> {
    fs::create_dir_all(directory).with_context(|| format!("cannot make the directory {}", directory.display()))?;
    let probe = temporary(&directory.join("probe.png"));
    File::create(&probe)
        .and_then(|_| fs::remove_file(&probe))
        .with_context(|| format!("cannot write to the directory {}", directory.display()))?;
    for entry in fs::read_dir(directory).into_iter().flatten().flatten() {
        let age = entry
            .metadata()
            .and_then(|data| data.modified())
            .map(|time| time.elapsed().unwrap_or_default());
        if is_temporary(&entry.file_name().to_string_lossy()) && age.is_ok_and(|age| age >= STALE) {
            // Somebody else may have been faster.
            let _ = fs::remove_file(entry.path());
        }
    }
    Ok(())
}

/// Writes a picture as PNG: under a temporary name beside its own, which it gets when it is whole.
///
/// # Errors
/// Where the file cannot be written or renamed. Then nothing is left of it.
pub fn write_png(image: &RgbImage, path: &Path) -> Result<()> {
    let bytes = encode(image, CompressionType::Best).with_context(|| format!("cannot write {}", path.display()))?;
    write_whole(&bytes, path)
}

/// Writes bytes to a file: under a temporary name beside its own, which it gets when it is whole.
///
/// # Errors
/// Where the file cannot be written or renamed. Then nothing is left of it.
pub fn write_whole(bytes: &[u8], path: &Path) -> Result<()> {
    let temporary = temporary(path);
    // Whole in memory first: a run that is interrupted is hardly ever interrupted while it writes.
    let written = fs::write(&temporary, bytes).and_then(|()| fs::rename(&temporary, path));
    if written.is_err() {
        // What matters is the error above; there may be nothing to remove.
        let _ = fs::remove_file(&temporary);
    }
    written.with_context(|| format!("cannot write {}", path.display()))
}

/// A picture as the bytes of a PNG file.
///
/// # Errors
/// Where it is larger than a file can be.
pub fn encode<P>(image: &ImageBuffer<P, Vec<P::Subpixel>>, compression: CompressionType) -> Result<Vec<u8>>
where
    P: PixelWithColorType,
    [P::Subpixel]: EncodableLayout,
{
    let mut bytes = Vec::new();
    image.write_with_encoder(PngEncoder::new_with_quality(&mut bytes, compression, FilterType::Adaptive))?;
    Ok(bytes)
}

/// A file that is written bit by bit and gets its name when it is whole; before that it has a temporary one beside it, and is
/// removed where it does not come so far.
#[derive(Debug)]
pub struct WholeFile {
    path: PathBuf,
    temporary: PathBuf,
    file: File,
}

impl WholeFile {
    /// Begins a file.
    ///
    /// # Errors
    /// Where it cannot be made.
    pub fn create(path: &Path) -> Result<Self> {
        let temporary = temporary(path);
        let file = File::create(&temporary).with_context(|| format!("cannot write {}", path.display()))?;
        Ok(Self {
            path: path.to_owned(),
            temporary,
            file,
        })
    }

    /// Gives it its name.
    ///
    /// # Errors
    /// Where that cannot be done.
    pub fn finish(self) -> Result<()> {
        fs::rename(&self.temporary, &self.path).with_context(|| format!("cannot write {}", self.path.display()))
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for WholeFile {
    fn drop(&mut self) {
        // It is not there any more if it was finished.
        let _ = fs::remove_file(&self.temporary);
    }
}

/// A name in the same directory, so that renaming is one step, and another one for each process.
fn temporary(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}.part", process::id()))
}

/// Whether a file name is one that [`temporary`] makes, in whatever process.
fn is_temporary(name: &str) -> bool {
    let number = name
        .strip_prefix('.')
        .and_then(|rest| rest.strip_suffix(".part"))
        .and_then(|rest| rest.rsplit_once(".png."));
    number.is_some_and(|(_, number)| number.parse::<u32>().is_ok())
}

/// Writes a line to standard output. That nobody reads it any more is no error: the pictures are the result.
///
/// # Errors
/// Where standard output is there and cannot be written to.
pub fn say(line: &str) -> Result<()> {
    say_bytes(format!("{line}\n").as_bytes()).map(|_| ())
}

/// Writes bytes to standard output, and tells whether somebody still reads them.
///
/// # Errors
/// Where standard output is there and cannot be written to.
pub fn say_bytes(bytes: &[u8]) -> Result<bool> {
    let mut output = io::stdout().lock();
    match output.write_all(bytes).and_then(|()| output.flush()) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(false),
        Err(error) => Err(error).context("cannot write to standard output"),
    }
}

/// The directory of a file, that of a bare name being the current one.
#[must_use]
pub fn directory_of(file: &Path) -> &Path {
    let directory = file.parent().filter(|path| !path.as_os_str().is_empty());
    directory.unwrap_or(Path::new("."))
}

#[cfg(test)]
mod tests {
    use super::{STALE, is_temporary, prepare, temporary, write_png};
    use anyhow::Result;
    use image::{Rgb, RgbImage};
    use std::path::{Path, PathBuf};
    use std::time::SystemTime;
    use std::{env, fs, process};

    /// A directory of its own for a test.
    fn directory(name: &str) -> PathBuf {
        env::temp_dir().join(format!("gsdf-{name}-{}", process::id()))
    }

    #[test]
    fn a_picture_comes_back_and_nothing_lies_beside_it() -> Result<()> {
        let directory = directory("picture");
        prepare(&directory.join("deep"))?;
        let path = directory.join("deep/one.png");
        let image = RgbImage::from_pixel(3, 2, Rgb([1, 2, 3]));
        // Twice: a picture that is there is replaced.
        write_png(&image, &path)?;
        write_png(&image, &path)?;
        assert_eq!(image::open(&path)?.into_rgb8(), image);
        assert_eq!(fs::read_dir(directory.join("deep"))?.count(), 1);
        fs::remove_dir_all(directory)?;
        Ok(())
    }

    #[test]
    fn what_a_killed_run_left_is_removed_and_nothing_else() -> Result<()> {
        let directory = directory("stale");
        prepare(&directory)?;
        let files = [".s1.png.77.part", ".s2.png.78.part", ".mine.part", "s1.png"];
        for name in files {
            fs::write(directory.join(name), "")?;
        }
        for name in [files[0], files[2], files[3]] {
            let file = fs::File::options().write(true).open(directory.join(name))?;
            file.set_modified(SystemTime::now() - 2 * STALE)?;
        }
        prepare(&directory)?;
        assert_eq!(files.map(|name| directory.join(name).exists()), [false, true, true, true]);
        fs::remove_dir_all(directory)?;
        Ok(())
    }

    #[test]
    fn temporary_names_are_known_again() {
        let name = temporary(Path::new("gallery/s1.png"));
        assert!(name.file_name().is_some_and(|name| is_temporary(&name.to_string_lossy())));
        assert!(!is_temporary(".s1.png.part") && !is_temporary("s1.png.7.part"));
    }

    #[test]
    fn what_cannot_be_written_is_named_and_leaves_nothing() -> Result<()> {
        let directory = directory("failure");
        fs::create_dir_all(directory.join("taken.png"))?;
        let image = RgbImage::new(1, 1);
        // A directory is in the way of the file.
        let error = write_png(&image, &directory.join("taken.png")).expect_err("something is in the way");
        assert!(error.to_string().contains("taken.png"), "{error}");
        assert_eq!(fs::read_dir(&directory)?.count(), 1);
        // And a file in the way of the directory.
        fs::write(directory.join("file"), "")?;
        let error = prepare(&directory.join("file/gallery")).expect_err("something is in the way");
        assert!(error.to_string().contains("file/gallery"), "{error}");
        fs::remove_dir_all(directory)?;
        Ok(())
    }
}
