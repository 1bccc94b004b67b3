#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Tests the fuzz targets: scripts/fuzz_mutations.sh [SECONDS [SCRATCH [NAME...]]]
# It plants a bug in a copy of the sources, builds the target concerned and runs it from the
# committed seeds until the bug is found, at most for SECONDS (default 300). It prints a table of
# the times; the status is 1 if a bug was not found, or can no longer be planted. SCRATCH keeps the
# copy and its build for the next run; NAME selects bugs.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-300}
scratch=${2:-$(mktemp -d)}
shift $(($# < 2 ? $# : 2))
chosen=" $* "
jobs=${FUZZ_JOBS:-$(nproc)}

# Each line has the name of the bug, the target, the file and the change in Perl, separated by ~.
mutations=(
    'orientation-sign~predicates~kernel/predicates.cpp~s/return \{p\.y, p\.z\};/return {p.z, p.y};/'
    'filter-bound~predicates~kernel/predicates.cpp~s/, 9 \* unit \* u \* v\)/, 0.25 * unit * u * v)/'
    'rounding-mode~predicates~kernel/nearest.cpp~s/exponent, MPFR_RNDN\)/exponent, MPFR_RNDZ)/'
    'coplanar-class~tri_tri~algorithms/intersection/intersection.cpp~s/j < 3; \+\+j\)(\s+if \(opposite\(inside)/j < 2; ++j)$1/'
    'corner-on-edge~tri_tri~algorithms/intersection/intersection.cpp~s/if \(inside\[j\] == Sign::Negative\) return std::nullopt;/if (inside[j] != Sign::Positive) return std::nullopt;/'
    'grid-widening~search~algorithms/search/detail/grid.cpp~s/largest\[k\] \* 0\.5 \* \(1 \+ 0x1p-40\)/largest[k] * 0/'
    'unsorted-threads~search~algorithms/search/search.cpp~s/return search::bvh_pairs\(source, groups, run\);/{ auto pairs = search::bvh_pairs(source, groups, run); if (run.threads > 1) std::reverse(pairs.begin(), pairs.end()); return pairs; }/'
    'dropped-constraint~arrange~algorithms/arrangement/retriangulation.cpp~s/i \+ 1 < chain\.size\(\)/i + 2 < chain.size()/'
    'merged-points~arrange~kernel/point_store.cpp~s/(const Enclosure a = enclosure\(p\), b = enclosure\(q\);)/$1 if (std::fabs(a.low[0] - b.low[0]) + std::fabs(a.low[1] - b.low[1]) + std::fabs(a.low[2] - b.low[2]) < 1e-12) return std::strong_ordering::equal;/'
    'wrong-parent~arrange~algorithms/arrangement/retriangulation.cpp~s/for \(const std::uint32_t f : faces\) block\.faces_of\.values\.push_back\(f\);/block.faces_of.values.push_back(faces.front());/'
    'edge-of-three~corefine~algorithms/arrangement/detail/intersection_edges.cpp~s/sides\.size\(\) > 2 \|\|/sides.size() > 3 ||/'
    'refusal~rounding~algorithms/rounding/rounding.cpp~s/report\.clean = pairs\.empty\(\)/report.clean = pairs.size() < 2/'
    'parted-region~regions~algorithms/regions/regions.cpp~s/else if \(sides\.size\(\) == 2\)/else if (sides.size() == 2 && sides[0] % 3 != 2)/'
    'radial-order~volumes~algorithms/volumes/detail/radial_sort.cpp~s/opposite\(ahead\(sheets, low, next\)\)/ahead(sheets, low, next)/'
    'nesting~volumes~algorithms/volumes/detail/shell_nesting.cpp~s/first \? outside/first || i > 0 ? outside/'
    'face-of-triangle~tetrahedra~algorithms/tetgen/detail/assembly.cpp~s/face_triangle\.push_back\(face\.facet\)/face_triangle.push_back(face.facet \/ 2)/'
    'obj-index~read_obj~io/surfaces/obj.cpp~s/if \(vertex >= vertices_\.size\(\)\)/if (vertex > vertices_.size())/'
    'ply-index~read_ply~io/surfaces/ply.cpp~s/index < 0 \|\| index >= limit/index < 0 || index > limit/'
)

mkdir -p "$scratch/findings"
# Copy only changed files, with new times, since the build in SCRATCH may have a planted bug.
git ls-files | while read -r file; do
    cmp -s "$file" "$scratch/$file" || cp --parents "$file" "$scratch"
done
cmake -S "$scratch" --preset fuzz >/dev/null

build() { cmake --build "$scratch/build/fuzz" -j "$jobs" --target "fuzz_$1" >"$scratch/build.log" 2>&1; }

# Prints the seconds until the target ends with a finding; nothing if it does not.
time_to_find() {
    local start options=(-max_len=400 -entropic=0)
    [[ $1 != read_* ]] || options=(-max_len=4096 "-dict=$scratch/fuzz/dictionaries/${1#read_}.dict")
    rm -rf "$scratch/corpus" && mkdir -p "$scratch/corpus"
    start=$(date +%s.%N)
    if ! "$scratch/build/fuzz/fuzz/fuzz_$1" "${options[@]}" -max_total_time="$seconds" -timeout=20 \
        -rss_limit_mb=2048 -artifact_prefix="$scratch/findings/$1-" "$scratch/corpus" \
        "$scratch/fuzz/corpus/$1" >"$scratch/$1.log" 2>&1; then
        awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f", b - a }'
    fi
}

missed=0
printf '| planted bug | target | found after | as |\n|---|---|---|---|\n'
for line in "${mutations[@]}"; do
    IFS='~' read -r name target file change <<<"$line"
    [[ $chosen == "  " || $chosen == *" $name "* ]] || continue
    cp -p "$file" "$scratch/$file.kept"
    perl -0pi -e "$change" "$scratch/$file"
    found=
    if cmp -s "$file" "$scratch/$file"; then
        what="can no longer be planted"
    elif ! build "$target"; then
        what="does not compile: see $scratch/build.log"
    else
        found=$(time_to_find "$target")
        what=$(grep -aE '^FOUND|ERROR: |runtime error' "$scratch/$target.log" | head -1 |
            sed -E 's/^FOUND: //; s/^==[0-9]+== *ERROR: //; s/.*runtime error/runtime error/' | cut -c1-70)
    fi
    mv "$scratch/$file.kept" "$scratch/$file"
    touch "$scratch/$file"
    printf '| %s | %s | %s | %s |\n' "$name" "$target" "${found:+$found s}" "$what"
    [[ -n $found ]] || missed=$((missed + 1))
done
[[ $missed -eq 0 ]] || { echo "fuzz_mutations: $missed not found" >&2; exit 1; }
