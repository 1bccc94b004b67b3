#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Runs the fuzz targets: scripts/fuzz.sh [SECONDS [TARGET...]]
# It builds the preset fuzz (or FUZZ_PRESET) and runs each target (all, unless some are named) for
# SECONDS (default 60), two at a time (or FUZZ_JOBS), from the committed seeds. FUZZ_SEED makes a
# run repeatable as far as timing allows (0, the default, is different each time); FUZZ_CORPUS
# names a folder that keeps the corpora from one run to the next. It ends with a table; for each
# finding the table names the file that reproduces it, and the status is 1.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
shift || true
targets=("$@")
[[ ${#targets[@]} -gt 0 ]] ||
    targets=(corefine arrange rounding crowded tiles known judge tetrahedra predicates tri_tri search regions volumes pieces kept
             forge_arrangement forge_volumes forge_tetrahedra forge_improved forge_filled
             forge_layered forge_cut forge_sealed
             read_ts read_ml read_obj read_off read_stl read_ply read_irap read_zmap read_cps3
             read_asc read_xyz read_vs read_vtp read_vtu read_vtk read_msh read_dxf read_grdecl read_sticks read_geojson
             read_shp)

preset=${FUZZ_PRESET:-fuzz}
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" --target fuzzers

binaries=$PWD/build/$preset/fuzz
results=$PWD/build/$preset/campaign
findings=$PWD/build/$preset/findings
corpora=${FUZZ_CORPUS:-$results/corpus}
rm -rf "$results" && mkdir -p "$results" "$findings" "$corpora"

# Record only the innermost caller of each allocation: whole stacks took a third of the time.
export ASAN_OPTIONS=malloc_context_size=1${ASAN_OPTIONS:+:$ASAN_OPTIONS}

# The target pieces writes files for each input.
[[ ! -w /dev/shm ]] || export TMPDIR=/dev/shm

# A finding ends the target, as the first finding is to be fixed first.
run_target() {
    local target=$1 options=(-max_len=400 -len_control=10 -entropic=0)
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
    "$binaries/fuzz_$target" "${options[@]}" -seed="$seed" -max_total_time="$seconds" -timeout=20 \
        -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="$findings/$target-" \
        "$corpora/$target" "$seeds" >"$results/$target.log" 2>&1 ||
        echo "$target" >>"$results/failed"
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
        "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" \
        "$(sed -n 's/^stat::average_exec_per_sec: *//p' "$log")" \
        "$(sed -nE 's/.* cov: ([0-9]+).*/\1/p' <<<"$progress")" \
        "$(sed -nE 's/.* ft: ([0-9]+).*/\1/p' <<<"$progress")"
done

[[ -e $results/failed ]] || exit 0
while read -r target; do
    echo "fuzz: $target found something:" >&2
    grep -aE '^FOUND|ERROR: |SUMMARY: |Test unit written to' "$results/$target.log" >&2 || true
done <"$results/failed"
exit 1
