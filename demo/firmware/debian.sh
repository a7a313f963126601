# shellcheck shell=bash
# Debian packages without root: unpacked into a cache; nothing is installed, upgraded or removed. Sourced by run.

# Where tools are kept between runs.
cache=${XDG_CACHE_HOME:-$HOME/.cache}/gsdf-firmware

# unpack DIR PACKAGE...: the packages, and those they need that are not installed, into $cache/DIR. The package lists are
# fetched anew and kept apart from the system's.
unpack() (
    folder=$cache/$1 work=$cache/$1.partial
    shift
    command -v apt-get >/dev/null && command -v dpkg-deb >/dev/null || return
    say "unpacking Debian's $* and what they need into $folder"
    rm -rf "$folder" "$work" && mkdir -p "$work/lists/partial" "$work/debs" && cd "$work/debs" || return
    # As root, apt would drop to a user of its own, who cannot write here.
    apt=(apt-get -qq -o "Dir::State::Lists=$work/lists" -o "Dir::Cache=$work" -o APT::Sandbox::User=root)
    "${apt[@]}" update || return
    # A simulated installation names them; what it would remove does not matter. Installed ones are asked for, too: they
    # are of use only together.
    plan=$("${apt[@]}" -s install --reinstall --no-install-recommends "$@") || return
    mapfile -t needed < <(awk '/^Inst/ { print $2 }' <<<"$plan")
    "${apt[@]}" download "${needed[@]}" >/dev/null || return
    for deb in *.deb; do dpkg-deb -x "$deb" "$work/unpacked" || return; done
    mv "$work/unpacked" "$folder" && rm -rf "$work"
)

# wrap DIR PROGRAM: writes $cache/DIR/wrapped/PROGRAM, which runs the unpacked program with the libraries unpacked
# beside it.
wrap() {
    local libraries
    libraries=$(find "$cache/$1" -name '*.so*' -printf '%h\n' | sort -u | paste -s -d :)
    mkdir -p "$cache/$1/wrapped"
    printf '#!/bin/sh\nLD_LIBRARY_PATH="%s" exec "%s" "$@"\n' "$libraries" "$cache/$1/usr/bin/$2" >"$cache/$1/wrapped/$2"
    chmod +x "$cache/$1/wrapped/$2"
}
