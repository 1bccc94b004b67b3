#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Tests the fuzz targets: scripts/fuzz_mutations.sh [--record] [SECONDS [SCRATCH [NAME...]]]
# It plants the bugs of fuzz/plants.txt, one after the other, in a copy of the sources, builds the
# target concerned and runs it from the committed seeds until the bug is found, at most for SECONDS
# (default 300). It prints a table of the times; the status is 1 if a bug was not found, or can no
# longer be planted. SCRATCH keeps the copy and its build for the next run; NAME selects bugs.
# With --record, which needs all bugs, fuzz/README.md gets the table if each bug was found.
set -euo pipefail
cd "$(dirname "$0")/.."

record=
[[ ${1:-} != --record ]] || { record=yes && shift; }
seconds=${1:-300}
scratch=${2:-$(mktemp -d)}
shift $(($# < 2 ? $# : 2))
chosen=" $* "
jobs=${FUZZ_JOBS:-$(nproc)}
[[ -z $record || $chosen == "  " ]] || { echo "fuzz_mutations: --record needs all bugs" >&2; exit 2; }

mkdir -p "$scratch/findings"
# Copy only changed files, with new times, since the build in SCRATCH may have a planted bug.
git ls-files | while read -r file; do
    cmp -s "$file" "$scratch/$file" || cp --parents "$file" "$scratch"
done
# The target `regression` is one of the tests.
cmake -S "$scratch" --preset fuzz -DTERRANE_TESTS=ON -DTERRANE_REPLAY=OFF >/dev/null

# build TARGET: builds a fuzz target, or the test `regression`.
build() {
    local name=fuzz_$1
    [[ $1 != regression ]] || name=$1
    cmake --build "$scratch/build/fuzz" -j "$jobs" --target "$name" >"$scratch/build.log" 2>&1
}

# run_target TARGET: runs it; the status is 0 if it finds nothing.
run_target() {
    local options=(-max_len=400 -entropic=0)
    if [[ $1 == regression ]]; then
        "$scratch/build/fuzz/tests/regression" "$scratch/tests/data/regression"
        return
    fi
    [[ $1 != read_* ]] || options=(-max_len=4096 "-dict=$scratch/fuzz/dictionaries/${1#read_}.dict")
    rm -rf "$scratch/corpus" && mkdir -p "$scratch/corpus"
    "$scratch/build/fuzz/fuzz/fuzz_$1" "${options[@]}" -max_total_time="$seconds" -timeout=20 \
        -rss_limit_mb=2048 -artifact_prefix="$scratch/findings/$1-" "$scratch/corpus" \
        "$scratch/fuzz/corpus/$1"
}

# time_to_find TARGET: prints the seconds until the target ends with a finding; nothing if it does not.
time_to_find() {
    local start
    start=$(date +%s.%N)
    run_target "$1" >"$scratch/$1.log" 2>&1 ||
        awk -v a="$start" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f", b - a }'
}

missed=0
longest=0
rows=$scratch/rows.md
: >"$rows"
printf '| planted bug | target | found after | as |\n|---|---|---|---|\n'
while IFS='~' read -r -u 3 name target file change breaks; do
    [[ -n $name && $name != '#'* ]] || continue
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
        what="not found"
        [[ -z $found ]] ||
            what=$(grep -aE '^FOUND|ERROR: |runtime error|\.obj: R[0-9]' "$scratch/$target.log" | head -1 |
                sed -E 's/^FOUND: //; s/^==[0-9]+== *ERROR: //; s/.*runtime error/runtime error/' |
                cut -c1-70)
    fi
    mv "$scratch/$file.kept" "$scratch/$file"
    touch "$scratch/$file"
    printf '| %s | %s | %s | %s |\n' "$name" "$target" "${found:+$found s}" "$what"
    printf '| `%s`: %s | `%s` | %s |\n' "$name" "$breaks" "$target" "${found:+$found s}" >>"$rows"
    [[ -n $found ]] || missed=$((missed + 1))
    longest=$(awk -v a="$longest" -v b="${found:-0}" 'BEGIN { print (b > a ? b : a) }')
done 3<fuzz/plants.txt
[[ $missed -eq 0 ]] || { echo "fuzz_mutations: $missed not found" >&2; exit 1; }

[[ -n $record ]] || exit 0
{
    printf 'The longest of %d took %s seconds, with %d processors:\n\n' "$(wc -l <"$rows")" "$longest" \
        "$(nproc)"
    printf '| planted bug | target | found after |\n|---|---|---|\n'
    cat "$rows"
} >"$scratch/table.md"
awk -v table="$scratch/table.md" '
    /^<!-- end of planted bugs -->/ { inside = 0 }
    !inside { print }
    /^<!-- planted bugs / { inside = 1; while ((getline line < table) > 0) print line }
' fuzz/README.md >"$scratch/README.md"
cp "$scratch/README.md" fuzz/README.md
