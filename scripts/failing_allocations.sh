#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Lets each allocation of each stage fail: scripts/failing_allocations.sh [preset] [start of names of stages]
# Of more than 10 000 allocations of a stage, 10 000 are tried: with the stages simplify and write_model_folder that takes
# three and eight minutes each. With the preset asan, leaks are looked for in C, too.
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target failing_allocations
"build/$preset/tests/failing_allocations" 10000 "${2:-}"
