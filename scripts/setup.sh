#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Installs the packages that Debian 12 needs to build and test Terrane. It may be run again: if all
# are installed it needs neither network nor root.
set -euo pipefail

packages=(
    ca-certificates git g++ lld clang-14 libclang-rt-14-dev clang-format-14 clang-tidy-14
    cmake ninja-build ccache pkgconf
    libcgal-dev libgmp-dev libmpfr-dev nettle-dev libeigen3-dev libnanoflann-dev libtbb-dev
    libcli11-dev libfmt-dev nlohmann-json3-dev libpugixml-dev zlib1g-dev libshp-dev liblzma-dev liblz4-dev
    libtet1.5-dev libgmsh-dev catch2
    libopenmpi-dev openmpi-bin                            # terrane-mpi
    python3-dev pybind11-dev python3-numpy                # the Python package
    python3-pytest python3-hypothesis mypy python3-pip python3-setuptools python3-wheel # its tests
    python3-dask python3-distributed python3-h5py         # ensembles: engine and HDF5, optional
    python3-matplotlib               # draws the figures of the examples
    python3-vtk9 python3-meshio gmsh # these read the written files back, in tests only
    python3-netcdf4                  # likewise, with python3-cftime: 2 MB
    gappa                            # checks the proofs of error bounds, in tests only
    chromium                         # opens report pages, in tests only
)
# Report pages are bundled with npm, whichever there is; Debian's brings some hundred packages along.
command -v npm >/dev/null || packages+=(nodejs npm)

is_installed() {
    [[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

fail() {
    echo "setup: $1" >&2
    echo "setup: please install by hand: ${missing[*]}" >&2
    exit 1
}

missing=()
command -v dpkg-query >/dev/null || { missing=("${packages[@]}"); fail "this is no Debian system"; }
for package in "${packages[@]}"; do
    is_installed "$package" || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
    echo "setup: everything is installed"
    exit 0
fi

as_root=()
if [[ $EUID -ne 0 ]]; then
    command -v sudo >/dev/null || fail "not root, and there is no sudo"
    as_root=(sudo)
    [[ -t 0 ]] || as_root=(sudo -n) # nobody can type a password
fi

echo "setup: installing ${missing[*]}"
apt_get() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get "$@"; }
apt_get update || fail "apt-get update failed"
apt_get install -y --no-install-recommends "${missing[@]}" || fail "apt-get install failed"
for package in "${packages[@]}"; do
    is_installed "$package" || fail "$package is still not installed"
done
echo "setup: done"
