#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Makes Debian packages, judges them with lintian, and uses them in a clean Debian 12:
#   scripts/packages.sh [BUILD]
# BUILD is a build tree with the prefix /usr; without it the preset package is built. The packages are put
# into out/packages. TERRANE_MAINTAINER, "NAME <ADDRESS>", is who answers for them; nothing is made without it, or
# without the same CMake variable in BUILD. Needs dpkg-dev and lintian; as root, with debootstrap and a mirror of Debian, also a
# root of its own, into which the packages are installed as apt does it. MIRROR, SUITE and ROOT say from where, what and where; BASE names a clean root that
# was made before, which is copied. NO_ROOT=1 leaves that out.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-}
packages=$PWD/out/packages
root=${ROOT:-$PWD/out/package-root}
suite=${SUITE:-bookworm}

fail() { echo "packages: $1" >&2; exit 1; }

# Whether a text is a name and an address. One that can't exist would be worse than none.
is_contact() { [[ $1 =~ ^[^\<\>]+\ \<[^\<\>@\ ]+@[^\<\>@\ ]+\>$ && $1 != *.invalid\> ]]; }
needed='TERRANE_MAINTAINER="NAME <ADDRESS>" must name who answers for the packages'

if [[ -z $build ]]; then
    build=build/package
    is_contact "${TERRANE_MAINTAINER:-}" || fail "$needed"
    cmake --preset package -DTERRANE_MAINTAINER="$TERRANE_MAINTAINER" >/dev/null
    cmake --build --preset package
fi
grep -qx 'CMAKE_INSTALL_PREFIX:PATH=/usr' "$build/CMakeCache.txt" ||
    fail "$build is not for the prefix /usr: configure with -DCMAKE_INSTALL_PREFIX=/usr"

contact=$(sed -n 's/^TERRANE_MAINTAINER:STRING=//p' "$build/CMakeCache.txt")
is_contact "$contact" || fail "$needed: configure $build with -DTERRANE_MAINTAINER=..."

rm -rf "$packages"
(cd "$build" && cpack -G DEB -B "$packages" >/dev/null)
rm -rf "$packages/_CPack_Packages"
for deb in "$packages"/*.deb; do
    echo "$(basename "$deb"): $(($(stat -c %s "$deb") / 1024)) KiB, needs $(dpkg-deb -f "$deb" Depends)"
done

# What is left out, and why, is in this file.
command -v lintian >/dev/null || fail "install lintian"
lintian --allow-root --fail-on error,warning --suppress-tags-from-file scripts/packaging/debian/lintian-suppressed \
    "$packages"/*.deb
echo "lintian: no errors and warnings but those of scripts/packaging/debian/lintian-suppressed"

[[ -z ${NO_ROOT:-} ]] || exit 0
[[ $EUID -eq 0 ]] || fail "root is needed for a clean root; NO_ROOT=1 leaves it out"
command -v debootstrap >/dev/null || fail "install debootstrap"
rm -rf "$root"
if [[ -n ${BASE:-} ]]; then
    cp -a "$BASE" "$root"
else
    debootstrap --variant=minbase "$suite" "$root" ${MIRROR:+"$MIRROR"} >/dev/null
fi
trap 'rm -rf "$root"' EXIT
mkdir "$root/packages" "$root/example"
cp "$packages"/*.deb "$root/packages"
cp docs/data/{top,base,fault,body}.ts docs/examples/c/* "$root/example"
# apt of the machine knows the way to the mirror; its sources and settings are those of the clean root, too.
cp -r /etc/apt/. "$root/etc/apt"
inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
inside apt-get update >/dev/null
inside sh -c 'apt-get install -y --no-install-recommends /packages/*.deb gcc libc6-dev pkgconf cmake make' >/dev/null
inside sh -ec 'cd /example
    terrane arrange top.ts base.ts fault.ts -o model.vtp >/dev/null
    terrane tetrahedralize body.ts -o body.vtu | grep tetrahedra
    cc -std=c11 blocks.c $(pkg-config --cflags --libs terrane_c) -o by_pkg_config
    ./by_pkg_config top.ts base.ts fault.ts | grep "is in block 2"
    cmake -S . -B build >/dev/null && cmake --build build >/dev/null
    build/blocks top.ts base.ts fault.ts | grep "is in block 2"
    if [ -e /packages/python3-terrane_*.deb ]; then python3 -c "import terrane"; fi'
inside sh -c 'apt-get purge -y "*terrane*" >/dev/null && ! find /usr -name "*terrane*" | grep .' ||
    fail "files of a package stay after it is removed"
echo "packages: installed, used and removed in a clean $suite"
