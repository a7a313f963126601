//! What an image must not hold, each with its proof that it would be found.

use crate::attribution::Rooms;
use crate::image::Image;

/// The images that are measured, of which each holds what the next column of a table is about.
pub(crate) const MEASURED: [&str; 5] = ["baseline", "distance", "spheres", "block", "everything"];

/// The image that holds all that [`FORBIDDEN`] finds.
pub(crate) const CONTROL: &str = "forbidden";

/// The files of the folder of leaves that a sphere needs: itself, and what all leaves share.
const OF_SPHERES: [&str; 4] = ["sphere.rs", "solid.rs", "set.rs", "mod.rs"];

/// The folder of leaves.
const LEAVES: &str = "gsdf-nostd/src/leaf/";

/// Parts of the names of symbols, mangled or not, that show what an image must not hold.
const FORBIDDEN: [(&str, &[&str]); 3] = [
    (
        // Arm's names, then those of libgcc, which RISC-V uses: of arithmetic, of comparison, and of conversion.
        "arithmetic in f64",
        &[
            "__aeabi_dadd",
            "__aeabi_dsub",
            "__aeabi_drsub",
            "__aeabi_dmul",
            "__aeabi_ddiv",
            "__aeabi_dneg",
            "__aeabi_dcmp",
            "__aeabi_cdcmp",
            "__aeabi_cdrcmp",
            "__aeabi_d2",
            "__aeabi_f2d",
            "__aeabi_i2d",
            "__aeabi_ui2d",
            "__aeabi_l2d",
            "__aeabi_ul2d",
            "__adddf3",
            "__subdf3",
            "__muldf3",
            "__divdf3",
            "__negdf2",
            "__powidf2",
            "__cmpdf2",
            "__eqdf2",
            "__nedf2",
            "__ltdf2",
            "__ledf2",
            "__gtdf2",
            "__gedf2",
            "__unorddf2",
            "__extendsfdf2",
            "__truncdfsf2",
            "__fixdf",
            "__fixunsdf",
            "__floatsidf",
            "__floatdidf",
            "__floatunsidf",
            "__floatundidf",
        ],
    ),
    (
        "a panic or formatting",
        &[
            "core9panicking",
            "core3fmt",
            "panic_fmt",
            "unwrap_failed",
            "expect_failed",
            "rust_begin_unwind",
        ],
    ),
    (
        "an allocator",
        &[
            "__rust_alloc",
            "__rust_dealloc",
            "__rust_realloc",
            "__rg_",
            "__rdl_",
            "alloc5alloc",
            "alloc5boxed",
        ],
    ),
];

/// What in `image` must not be there, each a sentence.
pub(crate) fn forbidden_in(image: &Image) -> Vec<String> {
    let found = |(what, symbol)| format!("{} holds {what}: {symbol}", image.path().display());
    FORBIDDEN
        .iter()
        .filter_map(|(what, parts)| Some((*what, first(&image.symbols, parts)?)))
        .map(found)
        .collect()
}

/// Which guards do not find in `control`, which holds everything that is forbidden, what they guard against.
pub(crate) fn broken(control: &Image) -> Vec<String> {
    let path = control.path().display();
    let missed = |(what, _): &(&str, _)| format!("the guard against {what} is broken: it finds none in {path}");
    FORBIDDEN
        .iter()
        .filter(|(_, parts)| first(&control.symbols, parts).is_none())
        .map(missed)
        .collect()
}

fn first<'a>(symbols: &'a [String], parts: &[&str]) -> Option<&'a str> {
    symbols
        .iter()
        .map(String::as_str)
        .find(|symbol| parts.iter().any(|part| symbol.contains(part)))
}

/// What is wrong with an image that should know no leaves but spheres, by where its code comes from and that of an image
/// of all leaves, which proves that the code of other leaves would be found.
pub(crate) fn leaves_beside_spheres(board: &str, spheres: &Rooms, everything: &Rooms) -> Vec<String> {
    let others = |rooms: &Rooms| -> Vec<String> {
        let leaf = |room: &&String| room.strip_prefix(LEAVES).is_some_and(|file| !OF_SPHERES.contains(&file));
        rooms.keys().filter(leaf).cloned().collect()
    };
    let mut failures: Vec<String> = Vec::new();
    for room in others(spheres) {
        failures.push(format!(
            "{board}, spheres: {} bytes come from {room}, which no sphere needs",
            spheres[&room]
        ));
    }
    for needed in ["cone.rs", "capped_cone.rs"] {
        if !everything.contains_key(&format!("{LEAVES}{needed}")) {
            failures.push(format!(
                "{board}: the guard of leaves is broken: it finds no {needed} in everything"
            ));
        }
    }
    if !spheres.contains_key(&format!("{LEAVES}sphere.rs")) {
        failures.push(format!("{board}: the guard of leaves is broken: it finds no sphere.rs in spheres"));
    }
    failures
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rooms(files: &[&str]) -> Rooms {
        files.iter().map(|file| (format!("{LEAVES}{file}"), 10)).collect()
    }

    #[test]
    fn spheres_hold_no_other_leaf() {
        let everything = rooms(&["sphere.rs", "cone.rs", "capped_cone.rs", "nappe.rs"]);
        let failures = |spheres: &[&str]| leaves_beside_spheres("m", &rooms(spheres), &everything);
        assert!(failures(&["sphere.rs", "solid.rs", "set.rs", "mod.rs"]).is_empty());
        for file in ["cone.rs", "nappe.rs", "conical_side.rs", "capsule.rs", "anything_new.rs"] {
            assert_eq!(failures(&["sphere.rs", file]).len(), 1, "{file}");
        }
    }

    #[test]
    fn a_guard_that_finds_nothing_anywhere_is_broken() {
        let (spheres, none) = (rooms(&["sphere.rs"]), Rooms::new());
        assert_eq!(leaves_beside_spheres("m", &spheres, &rooms(&["sphere.rs", "cone.rs"])).len(), 1);
        assert_eq!(leaves_beside_spheres("m", &none, &rooms(&["cone.rs", "capped_cone.rs"])).len(), 1);
    }

    #[test]
    fn each_forbidden_thing_is_told_from_what_resembles_it() {
        let found = |symbol: &str| -> Vec<bool> {
            FORBIDDEN
                .iter()
                .map(|(_, parts)| first(&[symbol.to_owned()], parts).is_some())
                .collect()
        };
        for symbol in [
            "__aeabi_dmul",
            "__muldf3",
            "__truncdfsf2",
            "_RNvNtNtCsx_17compiler_builtins5float3mul8___muldf3",
        ] {
            assert_eq!(found(symbol), [true, false, false], "{symbol}");
        }
        for symbol in ["_ZN4core9panicking9panic_fmt17h0E", "_RNvNtCsx_4core9panicking18panic_bounds_check"] {
            assert_eq!(found(symbol), [false, true, false], "{symbol}");
        }
        for symbol in ["_RNvCsx_7___rustc12___rust_alloc", "_RNvNtCsx_5alloc5alloc18handle_alloc_error"] {
            assert_eq!(found(symbol), [false, false, true], "{symbol}");
        }
        for symbol in [
            "__aeabi_fmul",
            "__mulsf3",
            "__aeabi_uidiv",
            "__aeabi_lmul",
            "_ZN10gsdf_nostd3ray3Ray4line17h0E",
        ] {
            assert_eq!(found(symbol), [false, false, false], "{symbol}");
        }
    }
}
