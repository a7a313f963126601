# shellcheck shell=bash
# Finds or fetches a compiler for microcontrollers. Sourced by run, after debian.sh, which sets the
# cache; run sets the oldest version that will do.
#
# These targets need a core library of their own. rustup has one ready; where rustup cannot reach its server, core is
# compiled from Debian's packages of a compiler with its library sources.
# shellcheck disable=SC2154

compiler_packages=(rustc-web rust-web-src)
# What runs cargo for a target, and what it needs besides.
cross=(cargo)
cross_flags=(--quiet --locked)

# cross_cargo COMMAND ARGUMENT...: runs cargo with the compiler that was found.
cross_cargo() { "${cross[@]}" "$1" "${cross_flags[@]}" "${@:2}"; }

# has_targets TARGET...: whether the active toolchain has a core library for each.
has_targets() {
    local target
    for target in "$@"; do
        compgen -G "$(rustc --print target-libdir --target "$target")/libcore-*.rlib" >/dev/null || return
    done
}

# has_sources RUSTC: whether it runs, is recent enough and has the library sources that -Zbuild-std compiles.
has_sources() {
    local version
    version=$("$1" --version 2>/dev/null | cut -d ' ' -f 2) &&
        printf '%s\n' "$minimum" "$version" | sort -C -V &&
        [ -d "$("$1" --print sysroot)/lib/rustlib/src/rust/library/core" ]
}

# find_sources: prints the path of a compiler with sources, which it fetches if there is none.
find_sources() {
    local installed=/usr/bin/rustc unpacked=$cache/rustc/wrapped/rustc
    if has_sources "$installed"; then
        echo "$installed"
    else
        has_sources "$unpacked" || { unpack rustc "${compiler_packages[@]}" >&2 && wrap rustc rustc; } || return
        has_sources "$unpacked" && echo "$unpacked"
    fi
}

# find_compiler TARGET...: sets up cross_cargo for them.
find_compiler() {
    local linkers compiler
    if has_targets "$@" || rustup target add "$@" >/dev/null 2>&1; then
        say "$(rustc --version) with its own core"
        return
    fi
    say "rustup cannot add $*"
    # Debian's compiler comes without a linker for these targets, rustup's has one.
    linkers=$(rustc --print sysroot)/lib/rustlib/$(rustc -vV | sed -n 's/^host: //p')/bin
    [ -x "$linkers/rust-lld" ] || fail "the toolchain has no rust-lld, which links for these targets"
    compiler=$(find_sources) ||
        fail "need a network, for rustup's $* or for Debian's ${compiler_packages[*]} $minimum or later"
    cross=(env "RUSTC=$compiler" RUSTC_BOOTSTRAP=1 "PATH=$linkers:$PATH" cargo)
    cross_flags+=('-Zbuild-std=core,alloc')
    say "$("$compiler" --version) with core from its sources"
}
