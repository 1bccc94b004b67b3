#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Sets up, builds and tests: scripts/test.sh [preset]   (preset: release unless given)
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

scripts/setup.sh
cmake --preset "$preset"
targets=(all)
[[ $preset == release ]] && targets+=(all_verify_interface_header_sets) # each public header alone
cmake --build --preset "$preset" --target "${targets[@]}"
# The test programs list their tests themselves. If a program listed none, ctest would pass with the rest.
listed=$(ctest --preset "$preset" -N | sed -n 's/^Total Tests: //p')
[[ $listed -ge 1000 ]] || { echo "test: only $listed tests are listed" >&2; exit 1; }
ctest --preset "$preset"
