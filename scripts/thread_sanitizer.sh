#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Runs the stages that use threads under ThreadSanitizer: scripts/thread_sanitizer.sh [FOLDER]
# TBB is built for it from Debian's source package, as ThreadSanitizer takes what it does not see of TBB's
# synchronisation for races. Ranges of loops are short there, so that small models are shared out as well.
# The folder (default: build/thread) keeps that and the build.
set -euo pipefail
cd "$(dirname "$0")/.."
folder=$(mkdir -p "${1:-build/thread}" && cd "${1:-build/thread}" && pwd)

# ---- TBB ----------------------------------------------------------------------------------------
# The sources of packages are where the packages are, in lists of the same form.
fetch_tbb() {
    local apt=$folder/apt
    mkdir -p "$apt/parts" "$apt/lists/partial"
    for list in /etc/apt/sources.list.d/*.sources; do
        [[ ! -e $list ]] || sed -E 's/^Types:.*/Types: deb-src/' "$list" >"$apt/parts/$(basename "$list")"
    done
    [[ ! -e /etc/apt/sources.list ]] || sed -E 's/^deb /deb-src /' /etc/apt/sources.list >"$apt/parts/main.list"
    local options=(-o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$apt/parts"
                   -o "Dir::State::Lists=$apt/lists" -o APT::Sandbox::User=root)
    apt-get "${options[@]}" update >/dev/null
    (cd "$apt" && apt-get "${options[@]}" source --download-only onetbb >/dev/null)
    rm -rf "$folder/tbb-source"
    dpkg-source -x "$apt"/onetbb_*.dsc "$folder/tbb-source" >/dev/null
}

flags="-fsanitize=thread -g1 -O1 -fno-omit-frame-pointer"
if [[ ! -e $folder/tbb/lib/cmake/TBB/TBBConfig.cmake ]]; then
    command -v dpkg-source >/dev/null || { echo "thread_sanitizer: please install dpkg-dev" >&2; exit 1; }
    fetch_tbb
    cmake -G Ninja -S "$folder/tbb-source" -B "$folder/tbb-build" -DCMAKE_BUILD_TYPE=None -DTBB_TEST=OFF \
        -DTBB_STRICT=OFF -DTBBMALLOC_BUILD=OFF -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_C_COMPILER=clang-14 \
        -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_INSTALL_PREFIX="$folder/tbb" -DCMAKE_INSTALL_LIBDIR=lib >/dev/null
    cmake --build "$folder/tbb-build" --target install >/dev/null
fi

# ---- Terrane ------------------------------------------------------------------------------------
cmake -G Ninja -S . -B "$folder/terrane" -DCMAKE_CXX_COMPILER=clang++-14 -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="$flags -DTERRANE_LEAST_RANGE=16" -DTBB_DIR="$folder/tbb/lib/cmake/TBB" -DTERRANE_UNITY=ON \
    -DTERRANE_UNITY_FACTOR=3 -DTERRANE_HARDEN=OFF >/dev/null
cmake --build "$folder/terrane" --target terrane_tests soak
ldd "$folder/terrane/tests/terrane_tests" | grep -q "libtbb.*$folder/tbb" ||
    { echo "thread_sanitizer: the tests do not use the TBB that was built" >&2; exit 1; }

# ---- Tests --------------------------------------------------------------------------------------
export TSAN_OPTIONS="halt_on_error=0 exitcode=66 second_deadlock_stack=1 ${TSAN_OPTIONS:-}"
failed=0
"$folder/terrane/tests/soak" 4000 || failed=1 # with two threads in each second call
"$folder/terrane/tests/terrane_tests" "*threads*" || failed=1
exit $failed
