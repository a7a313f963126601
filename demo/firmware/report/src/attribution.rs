//! Which source file each byte of code comes from, by the image's line tables.
//!
//! A row of a line table names the file of the innermost inlined function, so the code of a leaf is found under the
//! leaf's file wherever the compiler put it. What belongs to no row, such as constants between functions, stays
//! unattributed.

use std::collections::BTreeMap;
use std::ops::Range;

use anyhow::{Context as _, Result, ensure};
use gimli::{AttributeValue, Dwarf, EndianSlice, LittleEndian, Unit};

use crate::image::Image;

/// The code that no line table mentions.
pub(crate) const UNATTRIBUTED: &str = "unattributed";

type Slice<'a> = EndianSlice<'a, LittleEndian>;

/// The bytes of code of each room, where a room is a file of `gsdf-nostd/src/` or else a whole crate or so.
pub(crate) type Rooms = BTreeMap<String, u64>;

/// The bytes of code of each room. They add up to [`Image::code`].
pub(crate) fn rooms(image: &Image) -> Result<Rooms> {
    let rooms = attribute(image).with_context(|| format!("{}: its line tables", image.path().display()))?;
    let named: u64 = rooms.iter().filter(|(room, _)| *room != UNATTRIBUTED).map(|(_, bytes)| bytes).sum();
    ensure!(
        named > 0,
        "{}: no byte has a source file: built without line tables?",
        image.path().display()
    );
    Ok(rooms)
}

fn attribute(image: &Image) -> Result<Rooms> {
    let load = |id: gimli::SectionId| -> Result<Slice<'_>> { Ok(EndianSlice::new(image.section(id.name())?, LittleEndian)) };
    let dwarf = Dwarf::load(load)?;
    let mut owners = Owners::new(&image.executable);
    let mut units = dwarf.units();
    while let Some(header) = units.next()? {
        let unit = dwarf.unit(header)?;
        let Some(program) = unit.line_program.clone() else { continue };
        let mut rows = program.rows();
        // Where the code of the last row starts and whose it is, while inside a sequence.
        let mut last: Option<(u64, String)> = None;
        let mut kept = false;
        while let Some((header, row)) = rows.next_row()? {
            if let Some((start, room)) = last.take() {
                if kept {
                    owners.claim(start..row.address(), &room);
                }
            } else {
                // The linker leaves the sequences of functions it dropped at an address where there is no code.
                kept = owners.holds(row.address());
            }
            if !row.end_sequence() && kept {
                let path = match row.file(header) {
                    Some(file) => path(&dwarf, &unit, header, file)?,
                    None => String::new(),
                };
                last = Some((row.address(), room(&path)));
            } else if !row.end_sequence() {
                last = Some((row.address(), String::new()));
            }
        }
    }
    Ok(owners.sum())
}

/// The path of a file of a line table, from the root if the table goes so far.
fn path<'a>(
    dwarf: &Dwarf<Slice<'a>>,
    unit: &Unit<Slice<'a>>,
    header: &gimli::LineProgramHeader<Slice<'a>>,
    file: &gimli::FileEntry<Slice<'a>>,
) -> Result<String> {
    let string =
        |value: AttributeValue<Slice<'a>>| -> Result<String> { Ok(dwarf.attr_string(unit, value)?.to_string_lossy().into_owned()) };
    let mut path = string(file.path_name())?;
    if let Some(directory) = file.directory(header) {
        path = format!("{}/{path}", string(directory)?);
    }
    if let Some(folder) = unit.comp_dir
        && !path.starts_with('/')
    {
        path = format!("{}/{path}", folder.to_string_lossy());
    }
    Ok(path)
}

/// The room of the source file at `path`.
fn room(path: &str) -> String {
    // In this order: the compiler's run-time library is within the standard library and holds a copy of libm.
    const ROOMS: [(&str, &str); 15] = [
        ("compiler-builtins", "compiler-builtins"),
        ("compiler_builtins", "compiler-builtins"),
        ("/library/", "core"),
        ("/glam-", "glam"),
        ("/libm-", "libm"),
        ("/cortex-m", "runtime"),
        ("/riscv", "runtime"),
        ("/semihosting-", "runtime"),
        ("/bare-metal-", "runtime"),
        ("/vcell-", "runtime"),
        ("/volatile-register-", "runtime"),
        ("/critical-section-", "runtime"),
        ("demo/workload/", "workload"),
        ("demo/firmware/parts/", "parts"),
        ("demo/firmware/images/", "image"),
    ];
    if let Some((_, file)) = path.split_once("gsdf-nostd/src/") {
        return format!("gsdf-nostd/src/{file}");
    }
    match ROOMS.iter().find(|(part, _)| path.contains(part)) {
        Some((_, room)) => (*room).to_owned(),
        None if path.is_empty() => UNATTRIBUTED.to_owned(),
        None => "other".to_owned(),
    }
}

/// Whose each byte of the executable sections is.
struct Owners {
    sections: Vec<(Range<u64>, Vec<Option<usize>>)>,
    rooms: Vec<String>,
}

impl Owners {
    fn new(sections: &[Range<u64>]) -> Self {
        let nobodys = |range: &Range<u64>| (range.clone(), vec![None; (range.end - range.start) as usize]);
        Self {
            sections: sections.iter().map(nobodys).collect(),
            rooms: Vec::new(),
        }
    }

    /// Whether there is code at `address`.
    fn holds(&self, address: u64) -> bool {
        self.sections.iter().any(|(range, _)| range.contains(&address))
    }

    /// Gives `room` those bytes of `range` that are code and nobody's yet, so that none counts twice.
    fn claim(&mut self, range: Range<u64>, room: &str) {
        let index = self.rooms.iter().position(|known| known == room).unwrap_or_else(|| {
            self.rooms.push(room.to_owned());
            self.rooms.len() - 1
        });
        for (section, owners) in &mut self.sections {
            let (start, end) = (range.start.max(section.start), range.end.min(section.end));
            if start < end {
                let bytes = &mut owners[(start - section.start) as usize..(end - section.start) as usize];
                bytes.iter_mut().for_each(|owner| _ = owner.get_or_insert(index));
            }
        }
    }

    fn sum(&self) -> Rooms {
        let mut sums = Rooms::new();
        for owner in self.sections.iter().flat_map(|(_, owners)| owners) {
            let room = owner.map_or(UNATTRIBUTED, |index| &self.rooms[index]);
            match sums.get_mut(room) {
                Some(bytes) => *bytes += 1,
                None => _ = sums.insert(room.to_owned(), 1),
            }
        }
        sums
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums(claims: &[(Range<u64>, &str)]) -> Vec<(String, u64)> {
        let mut owners = Owners::new(&[100..200, 300..310]);
        claims.iter().for_each(|(range, room)| owners.claim(range.clone(), room));
        owners.sum().into_iter().collect()
    }

    fn expected(sums: &[(&str, u64)]) -> Vec<(String, u64)> {
        sums.iter().map(|(room, bytes)| ((*room).to_owned(), *bytes)).collect()
    }

    #[test]
    fn unclaimed_bytes_are_unattributed() {
        assert_eq!(sums(&[]), expected(&[(UNATTRIBUTED, 110)]));
    }

    #[test]
    fn claims_are_clipped_to_the_sections() {
        assert_eq!(
            sums(&[(0..101, "a"), (199..302, "b")]),
            expected(&[("a", 1), ("b", 3), (UNATTRIBUTED, 106)])
        );
        assert_eq!(
            sums(&[(0..100, "a"), (200..300, "a"), (310..999, "a")]),
            expected(&[(UNATTRIBUTED, 110)])
        );
    }

    #[test]
    fn a_byte_belongs_to_whoever_claims_it_first() {
        assert_eq!(
            sums(&[(110..120, "a"), (100..150, "b")]),
            expected(&[("a", 10), ("b", 40), (UNATTRIBUTED, 60)])
        );
    }

    #[test]
    fn an_empty_or_reversed_range_claims_nothing() {
        #[allow(clippy::reversed_empty_ranges)]
        let claims = [(150..150, "a"), (160..140, "a")];
        assert_eq!(sums(&claims), expected(&[(UNATTRIBUTED, 110)]));
    }

    #[test]
    fn code_is_only_within_sections() {
        let owners = Owners::new(&[100..200, 300..310]);
        assert!(owners.holds(100) && owners.holds(199));
        assert!(!owners.holds(0) && !owners.holds(200) && !owners.holds(u64::from(u32::MAX)));
    }

    #[test]
    fn rooms_are_told_by_path() {
        for (path, expected) in [
            ("/home/me/gsdf/gsdf-nostd/src/leaf/cone.rs", "gsdf-nostd/src/leaf/cone.rs"),
            ("/cargo/registry/src/x/libm-0.2.16/src/math/sqrt.rs", "libm"),
            ("/rustc/abc/library/compiler-builtins/libm/src/math/sqrt.rs", "compiler-builtins"),
            ("/rustc/abc/library/core/src/num/f32.rs", "core"),
            ("/cargo/registry/src/x/glam-0.34.2/src/f32/vec3.rs", "glam"),
            ("/home/me/gsdf/demo/firmware/images/src/query.rs", "image"),
            ("/somewhere/else.rs", "other"),
            ("", UNATTRIBUTED),
        ] {
            assert_eq!(room(path), expected, "{path}");
        }
    }
}
