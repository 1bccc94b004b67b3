#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Lets each allocation of each stage fail: scripts/failing_allocations.sh [preset] [name of a stage]
# Of more than 10 000 allocations of a stage, 10 000 are tried. With the preset asan, leaks are looked for in C, too.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target failing_allocations
"build/$preset/tests/failing_allocations" 10000 "${2:-}"
