#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Runs the fuzz targets: scripts/fuzz.sh [SECONDS [TARGET...]]
# It builds the preset fuzz (or FUZZ_PRESET) and runs each target (all, unless some are named) for
# SECONDS (default 60), two at a time (or FUZZ_JOBS), from the committed seeds. FUZZ_SEED makes a
# run repeatable as far as timing allows (0, the default, is different each time); FUZZ_CORPUS
# names a folder that keeps the corpora from one run to the next, merged: what adds no coverage goes.
# With FUZZ_RESUME=1 each target goes on from where the last run was stopped.
# A target goes on after a finding, up to ten. Of findings of one property the shortest is kept, and its
# file, the property and the number are listed after a table; the status is 1 then.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
shift || true
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] ||
    targets=(corefine arrange rounding crowded tiles known judge tetrahedra predicates tri_tri search regions volumes select pieces kept
             forge_arrangement forge_volumes forge_tetrahedra forge_improved forge_filled
             forge_layered forge_cut forge_sealed
             read_ts read_ml read_obj read_off read_stl read_ply read_irap read_zmap read_cps3
             read_asc read_xyz read_vs read_vtp read_vtu read_vts read_vtk read_msh read_dxf read_grdecl read_sticks
             read_landxml read_geojson read_shp)

preset=${FUZZ_PRESET:-fuzz}
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target fuzzers

binaries=$PWD/build/$preset/fuzz
results=$PWD/build/$preset/campaign
findings=$PWD/build/$preset/findings
corpora=${FUZZ_CORPUS:-$results/corpus}
[[ -n ${FUZZ_RESUME:-} ]] || rm -rf "$results"
mkdir -p "$results" "$findings" "$corpora"

# Record only the innermost caller of each allocation: whole stacks took a third of the time.
export ASAN_OPTIONS=malloc_context_size=1${ASAN_OPTIONS:+:$ASAN_OPTIONS}

# The target pieces writes files for each input.
[[ ! -w /dev/shm ]] || export TMPDIR=/dev/shm

# Keeps the shortest finding of each property: a sentence without its numbers. Lists them in TARGET.found.
keep_finding() {
    local target=$1 log=$2 file property kept
    property=$(grep -aoE -m1 '^FOUND: .*' "$log" || grep -aoE -m1 '(SUMMARY|ERROR): .*' "$log" || echo "no reason given")
    kept=$findings/$target-$(sed -E 's/[-+.0-9]+//g; s/0x[0-9a-f]+//g' <<<"$property" | sha256sum | cut -c1-8)
    for file in "$results/new-$target-"*; do
        [[ -e $file ]] || continue
        if [[ -e $kept && $(stat -c %s "$kept") -le $(stat -c %s "$file") ]]; then rm "$file"; else mv "$file" "$kept"; fi
    done
    printf '%s\t%s\n' "$kept" "$property" >>"$results/$target.found"
}

# Runs a target in slices, after each of which the seconds spent are noted.
run_target() {
    local target=$1 spent start status merged options=(-max_len=400 -len_control=10 -entropic=0)
    local seed=${FUZZ_SEED:-0}
    local seeds=$PWD/fuzz/corpus/$target
    mkdir -p "$corpora/$target"
    if [[ $target == read_* ]]; then
        options=(-max_len=4096 -malloc_limit_mb=256 "-dict=$PWD/fuzz/dictionaries/${target#read_}.dict")
    fi
    [[ $target != forge_arrangement && $target != pieces ]] || options[0]=-max_len=4096 # with files in them
    [[ ! -x $binaries/minimise_$target ]] || options[0]=-max_len=1500 # literal meshes: 24 bytes per point
    # len_control lets inputs grow sooner. entropic is off, as its cost is linear in the features of
    # a run and took two thirds of the time.
    spent=$(cat "$results/$target.spent" 2>/dev/null || echo 0)
    while ((spent < seconds)) && [[ $(grep -c . "$results/$target.found" 2>/dev/null) -lt 10 ]]; do
        start=$SECONDS status=0
        "$binaries/fuzz_$target" "${options[@]}" -seed=$((seed == 0 ? 0 : seed + spent)) \
            -max_total_time=$((seconds - spent < 300 ? seconds - spent : 300)) -timeout=20 \
            -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$results/new-$target-" \
            "$corpora/$target" "$seeds" >"$results/$target.slice" 2>&1 || status=$?
        cat "$results/$target.slice" >>"$results/$target.log"
        spent=$((spent + (SECONDS > start ? SECONDS - start : 1)))
        echo "$spent" >"$results/$target.spent"
        [[ $status == 0 ]] || keep_finding "$target" "$results/$target.slice"
    done
    [[ -n ${FUZZ_CORPUS:-} ]] || return 0
    merged=$corpora/$target.merged
    rm -rf "$merged" && mkdir "$merged"
    if "$binaries/fuzz_$target" "${options[@]}" -merge=1 "$merged" "$corpora/$target" >>"$results/$target.log" 2>&1; then
        rm -r "${corpora:?}/$target" && mv "$merged" "$corpora/$target"
    fi
}

for target in "${targets[@]}"; do
    [[ $target != read_shp || -x $binaries/fuzz_read_shp ]] || continue # a build without shapelib
    while [[ $(jobs -rp | wc -l) -ge ${FUZZ_JOBS:-2} ]]; do wait -n || true; done
    run_target "$target" &
done
wait

printf '%-17s %12s %9s %9s %9s\n' target executions per_second edges features
for target in "${targets[@]}"; do
    log=$results/$target.log
    progress=$(grep -aE '^#[0-9]+.* cov: ' "$log" | tail -1) || true # no line if the first seed failed
    printf '%-17s %12s %9s %9s %9s\n' "$target" \
        "$(awk '/^stat::number_of_executed_units:/ { sum += $2 } END { print sum }' "$log")" \
        "$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log" | tail -1)" \
        "$(sed -nE 's/.* cov: ([0-9]+).*/\1/p' <<<"$progress")" \
        "$(sed -nE 's/.* ft: ([0-9]+).*/\1/p' <<<"$progress")"
done

# One line for each property: how often, the file, the sentence.
cat "$results"/*.found 2>/dev/null | awk -F'\t' '{ ++n[$1]; what[$1] = $2 }
    END { for (file in n) print n[file] "\t" file "\t" what[file] }' | sort -k2 >"$results/findings" || true
[[ -s $results/findings ]] || exit 0
echo "fuzz: found, by property:" >&2
cat "$results/findings" >&2
exit 1
