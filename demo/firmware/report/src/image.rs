//! What is in an image: the bytes of its sections and the names of its symbols.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, ensure};
use object::elf::{EM_ARM, EM_RISCV, SHF_ALLOC, SHF_EXECINSTR, SHF_WRITE, SHT_NOBITS, SectionFlags};
use object::read::elf::{ElfFile32, FileHeader as _, SectionHeader as _};
use object::{Endianness, Object as _, ObjectSection as _, ObjectSymbol as _};

/// Sections that stand for the memory left over, of which the program itself claims nothing.
const LEFT_OVER: [&str; 2] = [".stack", ".heap"];

/// An image as the linker left it: an ELF file for a 32-bit Arm or RISC-V processor.
pub(crate) struct Image {
    path: PathBuf,
    data: Vec<u8>,
    /// Bytes it takes in flash: code, constants and the initial values of variables.
    pub(crate) flash: u64,
    /// Of these, code.
    pub(crate) code: u64,
    /// Bytes of its variables, without the stack.
    pub(crate) ram: u64,
    /// Where its code is.
    pub(crate) executable: Vec<std::ops::Range<u64>>,
    /// The names of its functions and variables.
    pub(crate) symbols: Vec<String>,
    /// The compiler that made it, in its own words, if it says so.
    pub(crate) compiler: Option<String>,
}

impl Image {
    /// Reads the image at `path`.
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let data = fs::read(path).with_context(|| format!("missing image {}", path.display()))?;
        Self::parse(path, data).with_context(|| format!("{} is not an image", path.display()))
    }

    fn parse(path: &Path, data: Vec<u8>) -> Result<Self> {
        let mut image = Self {
            path: path.to_owned(),
            data: Vec::new(),
            flash: 0,
            code: 0,
            ram: 0,
            executable: Vec::new(),
            symbols: Vec::new(),
            compiler: None,
        };
        let file = ElfFile32::<Endianness>::parse(&*data)?;
        let endian = file.endian();
        let machine = file.elf_header().e_machine(endian);
        ensure!(
            machine == EM_ARM || machine == EM_RISCV,
            "it is for machine {machine:?}, neither Arm nor RISC-V"
        );
        for section in file.sections() {
            let header = section.elf_section_header();
            let has = |flag: SectionFlags| header.sh_flags(endian).0 & flag.0 != 0;
            let (name, size) = (section.name()?, section.size());
            if name == ".comment" {
                image.compiler = compiler(section.data()?);
            }
            if !has(SHF_ALLOC) || size == 0 || LEFT_OVER.contains(&name) {
                continue;
            }
            let in_file = header.sh_type(endian) != SHT_NOBITS;
            if in_file {
                image.flash += size;
            }
            if has(SHF_WRITE) {
                image.ram += size;
            }
            if in_file && has(SHF_EXECINSTR) {
                image.code += size;
                image.executable.push(section.address()..section.address() + size);
            }
        }
        ensure!(image.code > 0, "it holds no code");
        for symbol in file.symbols().filter(|symbol| !symbol.is_undefined()) {
            let name = symbol.name()?;
            // File names and the marks of the assembler are no parts of the program.
            if symbol.kind() != object::SymbolKind::File && !name.is_empty() && !name.starts_with(['$', '.']) {
                image.symbols.push(name.to_owned());
            }
        }
        ensure!(
            !image.symbols.is_empty(),
            "its symbols are stripped, without which there is nothing to look for"
        );
        image.data = data;
        Ok(image)
    }

    /// Where it was read from.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// The bytes of the section `name`; none if there is no such section.
    pub(crate) fn section(&self, name: &str) -> Result<&[u8]> {
        let file = ElfFile32::<Endianness>::parse(&*self.data)?;
        Ok(match file.section_by_name(name) {
            Some(section) => section.data()?,
            None => &[],
        })
    }
}

/// What rustc says of itself in the section `.comment`, a list of strings that end in zeros.
fn compiler(comment: &[u8]) -> Option<String> {
    let mut lines = comment.split(|&byte| byte == 0).map(String::from_utf8_lossy);
    lines.find_map(|line| line.strip_prefix("rustc version ").map(|version| format!("rustc {version}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_image_is_an_error() {
        for data in [
            &b""[..],
            b"\x7fELF",
            b"not an image, but longer than a header of an ELF file is, by far",
        ] {
            let result = Image::parse(Path::new("x.elf"), data.to_vec());
            assert!(result.is_err(), "{data:?}");
        }
    }

    #[test]
    fn an_image_for_the_host_is_an_error() {
        let host = std::env::current_exe().expect("this test is a file");
        assert!(Image::read(&host).is_err());
    }

    #[test]
    fn the_compiler_is_the_comment_of_rustc() {
        let comment = b"Linker: LLD 22.1\0rustc version 1.95.0 (abc 2026-04-14)\0";
        assert_eq!(compiler(comment).as_deref(), Some("rustc 1.95.0 (abc 2026-04-14)"));
        assert_eq!(compiler(b"GCC: 12\0"), None);
    }
}
