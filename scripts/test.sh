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
ctest --preset "$preset"
