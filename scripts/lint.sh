#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Checks format and names: scripts/lint.sh [since [most]]
# It runs clang-format over all sources, and clang-tidy over the library and the program, or only
# over the files that changed since a commit if one is given: over `most` of them, drawn anew for
# each commit, where there are more. It changes nothing.
set -euo pipefail
cd "$(dirname "$0")/.."

git ls-files -z '*.hpp' '*.cpp' '*.h' '*.c' | xargs -0 -r clang-format-14 --dry-run -Werror
echo "lint: formatted"

tidied=('fuzzing/*.cpp' 'kernel/*.cpp' 'algorithms/*.cpp' 'io/*.cpp' 'capi/*.cpp' 'cli/*.cpp')
if [[ $# -gt 0 ]]; then
    mapfile -t files < <(git diff --name-only --diff-filter=d "$1" -- "${tidied[@]}")
else
    mapfile -t files < <(git ls-files "${tidied[@]}")
fi
changed=${#files[@]}
if [[ $# -gt 1 && $changed -gt $2 ]]; then
    mapfile -t files < <(printf '%s\n' "${files[@]}" |
        shuf -n "$2" --random-source=<(yes "$(git rev-parse HEAD)"))
fi
if [[ ${#files[@]} -gt 0 ]]; then
    cmake --preset tidy >/dev/null
    printf '%s\0' "${files[@]}" | xargs -0 -n1 -P2 clang-tidy-14 --quiet -p build/tidy
fi
echo "lint: ${#files[@]} of $changed files tidied"
