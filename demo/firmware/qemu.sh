# shellcheck shell=bash
# Finds or fetches the emulators. Sourced by run, after debian.sh, which sets the cache.
# shellcheck disable=SC2154

qemu_programs=(qemu-system-arm qemu-system-riscv32)
qemu_packages=(qemu-system-arm qemu-system-misc)

# Whether the emulators run: one whose libraries went away does not.
has_qemu() {
    local program
    for program in "${qemu_programs[@]}"; do
        "$program" --version >/dev/null || return
    done
}

# Puts the emulators into PATH. Their packages are not installed, which would remove those of a newer QEMU's tools.
find_qemu() {
    local program
    has_qemu 2>/dev/null && return
    PATH=$cache/qemu/wrapped:$PATH
    has_qemu 2>/dev/null && return
    unpack qemu "${qemu_packages[@]}" || return
    for program in "${qemu_programs[@]}"; do wrap qemu "$program" || return; done
    has_qemu
}
