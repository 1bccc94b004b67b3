#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Sets up, builds and tests: scripts/test.sh [preset]   (preset: release unless given)
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

scripts/setup.sh
# A build from nothing compiles each file once: larger groups of files take less time, and so does gcc if it collects
# no garbage. Who changes files then waits longer for each; cmake --preset release --fresh makes small groups again.
once=()
[[ $preset != release || -e build/release/CMakeCache.txt ]] ||
    once=(-DTERRANE_UNITY_FACTOR=3 -DCMAKE_CXX_FLAGS="--param ggc-min-heapsize=1048576")
cmake --preset "$preset" "${once[@]}"
targets=(all)
[[ $preset == release ]] && targets+=(all_verify_interface_header_sets) # each public header alone
cmake --build --preset "$preset" --target "${targets[@]}"
# The test programs list their tests themselves. If a program listed none, ctest would pass with the rest.
listed=$(ctest --preset "$preset" -N | sed -n 's/^Total Tests: //p')
[[ $listed -ge 1000 ]] || { echo "test: only $listed tests are listed" >&2; exit 1; }
ctest --preset "$preset" && exit
# What failed is told again at the end, where it is looked for; it stays a failure.
ctest --preset "$preset" --rerun-failed --timeout 120 || true
exit 8
