#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Checks that the output does not depend on compiler, build type and number of threads: runs all
# commands on small models and compares what they print and all files that they write.
#   scripts/same_bytes.sh                    builds the presets release and asan, and compares those
#   scripts/same_bytes.sh PROGRAM PROGRAM    compares these builds of the program
# CASES (a regular expression) selects cases by name. The differences are listed; the status is 1 if
# there are any.
set -euo pipefail
cd "$(dirname "$0")/.."

# Each case has a name and a command; $D is tests/data, $E docs/data, $P a project, and $O the folder
# for results.
cases=(
    'arrange_cube arrange $D/ringmesh/split_cube.ml -o $O/a.obj -o $O/a.vtp -o $O/a.ts -o $O/a.ply -o $O/a.msh --exact $O/exact.json --certificate $O/c.json'
    'arrange_cubes arrange $D/arrangements/three_cubes.stl -o $O/a.obj -o $O/a.vtp -o $O/a.stl -o $O/a.off'
    'arrange_cray arrange $D/manifold/Cray_left.obj $D/manifold/Cray_right.obj -o $O/a.obj -o $O/a.vtp'
    'arrange_faults arrange $D/implicit-benchmark/Fault.ts $D/opengeode-geosciencesio/surf2d_multi.ts -o $O/a.obj -o $O/a.vtp'
    'box arrange $E/top.ts $E/base.ts $E/fault.ts -o $O/a.vtp --box 0,0,-1700,2000,1500,-700'
    'rotated_box arrange $E/top.ts $E/base.ts $E/fault.ts -o $O/a.vtp --rotated-box 1000,750,-1200,1500,1100,900,20,10,5'
    'polygon arrange $E/top.ts $E/base.ts $E/fault.ts -o $O/a.vtp --polygon $E/licence.txt --between -1700,-700'
    'within arrange $E/top.ts $E/base.ts $E/fault.ts -o $O/a.vtp --within $E/body.ts'
    'check check $D/ringmesh/split_cube.ml $E/fault.ts $E/top.ts --json'
    'volume volume $D/ringmesh/modelA1.ml -o $O/model'
    'extend volume $E/top.ts $E/base.ts $E/fault.ts -o $O/model --box -140,-140,-1700,2140,1640,-700 --extend 60 --seal 20'
    'seal volume $E/top.ts $E/base.ts $E/fault.ts -o $O/model --box 0,0,-1700,2000,1500,-700 --seal 20'
    'improve improve $E/top.ts $E/base.ts $E/fault.ts -o $O/a.vtp -o $O/a.obj --box 0,0,-1700,2000,1500,-700 --seal 20 --edge-length 200 --histogram $O/q.svg'
    'kriging fill --depth $E/seabed.asc -o $O/a.vtp -o $O/a.obj --map $O/map.svg --points $O/new.csv'
    'rbf fill $E/fold.ts -o $O/a.vtp -o $O/a.ts --method rbf'
    'kriging_gaussian fill --depth $E/seabed.asc -o $O/a.vtp --model gaussian --isotropic --rings 3'
    'rbf_smoothed fill --depth $E/seabed.asc -o $O/a.obj --method rbf --smoothing auto'
    'layer layer --hard $E/salt.ts --soft $E/shale.ts --keep upper -o $O/a.vtp -o $O/a.obj'
    'stack layer $E/salt.ts $E/shale.ts --layer shale=1 --layer salt=2 --min-thickness 5 -o $O/a.vtp'
    'tetrahedra tetrahedralize $D/ringmesh/split_cube.ml -o $O/a.vtu -o $O/a.msh --quality 2'
    'convert convert $E/top.ts $O/a.ply'
    'points convert $E/seabed.asc $O/a.ts'
    'build build $P -o $O/model'
)

if [[ $# -gt 0 ]]; then
    programs=("$@")
else
    presets=(release asan) # compares a debug build of clang with an optimised one of gcc
    programs=()
    for preset in "${presets[@]}"; do
        cmake --preset "$preset" >/dev/null
        cmake --build --preset "$preset" --target cli/terrane
        programs+=("$PWD/build/$preset/cli/terrane")
    done
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chosen=${CASES:-.}

# All paths are relative to the scratch folder, since messages and certificates name them.
ln -s "$PWD/tests/data" "$work/data"
ln -s "$PWD/docs/data" "$work/docs"
cat >"$work/project.json" <<'END'
{
  "format": "terrane-project 1",
  "surfaces": [
    {"file": "docs/top.ts", "role": "horizon"},
    {"file": "docs/base.ts", "role": "horizon"},
    {"file": "docs/fault.ts", "role": "fault"}
  ],
  "volume_of_interest": {"box": {"low": [0, 0, -1700], "high": [2000, 1500, -700]}},
  "seal": 20,
  "improve": {"edge_length": 200},
  "tetrahedra": {"split": ["fault"]},
  "outputs": {"surfaces": ["vtp", "ts"], "tetrahedra": ["vtu"], "blocks": "vtp"}
}
END

# run_cases DIR PROGRAM THREADS: runs all cases; DIR/NAME gets what they print and write. Status 1
# (findings, or rounding failed) is a result as well.
run_cases() {
    local case name status
    for case in "${cases[@]}"; do
        name=${case%% *}
        [[ $name =~ $chosen ]] || continue
        rm -rf "$work/out" && mkdir "$work/out"
        status=0
        (
            cd "$work"
            D=data E=docs P=project.json O=out
            eval "\"$2\" ${case#* }$(threads_option "$case" "$3")" >out/stdout 2>out/stderr
        ) || status=$?
        if [[ $status -gt 1 ]]; then
            echo "same_bytes: $name: exit status $status ($2)" >&2
            cat "$work/out/stderr" >&2
            return 1
        fi
        echo "$status" >"$work/out/status"
        rm -f "$work/out/model/log.txt" # has times
        without_times "$work/out/model/statistics.json"
        mkdir -p "$1" && mv "$work/out" "$1/$name"
    done
}

# without_times FILE: takes times and memory out of statistics, if there are any.
without_times() {
    [[ ! -e $1 ]] || /usr/bin/python3 - "$1" <<'END'
import json, sys
statistics = json.load(open(sys.argv[1]))
for key in ("seconds", "peak_rss_mb"):
    statistics.pop(key, None)
json.dump(statistics, open(sys.argv[1], "w"), indent=1)
END
}

# threads_option CASE THREADS: prints the option, except for convert, which has none.
threads_option() { [[ $1 == *' convert '* ]] || echo " --threads $2"; }

differences=0
run_cases "$work/expected" "${programs[0]}" 1
for i in "${!programs[@]}"; do
    for threads in 1 2; do
        [[ $i -gt 0 || $threads -gt 1 ]] || continue
        run_cases "$work/results" "${programs[$i]}" "$threads"
        if ! diff -rq "$work/expected" "$work/results"; then
            echo "same_bytes: ${programs[$i]} with $threads threads differs from ${programs[0]} with one" >&2
            differences=1
            [[ -z ${KEEP:-} ]] || { mkdir -p "$KEEP" && cp -r "$work/expected" "$KEEP/" && cp -r "$work/results" "$KEEP/$i-$threads"; }
        fi
        rm -rf "$work/results"
    done
done
[[ $differences -eq 0 ]] || exit 1
echo "same_bytes: ${#cases[@]} cases, ${#programs[@]} builds, 1 and 2 threads: all the same"
