#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Checks that the output does not depend on compiler, build type and number of threads: arranges a
# few files of tests/data with each and compares the written files.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ ! -e cli/CMakeLists.txt ]]; then
    echo "same_bytes: there is no program yet, nothing is compared"
    exit 0
fi

presets=(release asan) # compares a debug build of clang with an optimised one of gcc
data=tests/data
cases=(
    "$data/ringmesh/split_cube.ml"
    "$data/arrangements/three_cubes.stl"
    "$data/manifold/Cray_left.obj $data/manifold/Cray_right.obj"
    "$data/implicit-benchmark/Fault.ts $data/opengeode-geosciencesio/surf2d_multi.ts"
)

for preset in "${presets[@]}"; do
    cmake --preset "$preset" >/dev/null
    cmake --build --preset "$preset" --target cli/terrane
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# arrange DIR PRESET THREADS: arranges all cases and writes all formats. Status 1 (rounding failed)
# is a result as well.
arrange() {
    local number=0 inputs format status
    mkdir -p "$1"
    for inputs in "${cases[@]}"; do
        for format in obj vtp; do
            status=0
            # shellcheck disable=SC2086 # a case is a list of files
            "build/$2/cli/terrane" arrange $inputs -o "$1/$number.$format" --threads "$3" \
                >/dev/null || status=$?
            if [[ $status -gt 1 ]]; then
                echo "same_bytes: terrane arrange $inputs: exit status $status ($2)" >&2
                return 1
            fi
            echo "$status" >"$1/$number.$format.status"
        done
        number=$((number + 1))
    done
}

arrange "$work/expected" "${presets[0]}" 1
for preset in "${presets[@]}"; do
    for threads in 1 2; do
        arrange "$work/$preset-$threads" "$preset" "$threads"
        for file in "$work/expected"/*; do
            cmp "$file" "$work/$preset-$threads/${file##*/}"
        done
        diff <(ls "$work/expected") <(ls "$work/$preset-$threads")
    done
done
echo "same_bytes: ${#cases[@]} cases, ${presets[*]}, 1 and 2 threads: all the same"
