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
programs=()
for program in "$@"; do programs+=("$(realpath "$program")"); done
cd "$(dirname "$0")/.."

# Each case has a name and a command, which runs in a scratch folder: data is tests/data, docs is docs/data,
# out is for results. Messages and certificates name these paths.
cases=(
    'arrange_cube arrange data/ringmesh/split_cube.ml -o out/a.obj -o out/a.vtp -o out/a.ts -o out/a.ply -o out/a.msh --exact out/exact.json --certificate out/c.json'
    'arrange_cubes arrange data/arrangements/three_cubes.stl -o out/a.obj -o out/a.vtp -o out/a.stl -o out/a.off'
    'arrange_cray arrange data/manifold/Cray_left.obj data/manifold/Cray_right.obj -o out/a.obj -o out/a.vtp'
    'arrange_faults arrange data/implicit-benchmark/Fault.ts data/opengeode-geosciencesio/surf2d_multi.ts -o out/a.obj -o out/a.vtp'
    'box arrange docs/top.ts docs/base.ts docs/fault.ts -o out/a.vtp --box 0,0,-1700,2000,1500,-700 --certificate out/c.json'
    'rotated_box arrange docs/top.ts docs/base.ts docs/fault.ts -o out/a.vtp --rotated-box 1000,750,-1200,1500,1100,900,20,10,5'
    'polygon arrange docs/top.ts docs/base.ts docs/fault.ts -o out/a.vtp --polygon docs/licence.txt --between -1700,-700'
    'within arrange docs/top.ts docs/base.ts docs/fault.ts -o out/a.vtp --within docs/body.ts'
    'check check data/ringmesh/split_cube.ml docs/fault.ts docs/top.ts --json'
    'volume volume data/ringmesh/modelA1.ml -o out/model'
    'extend volume docs/top.ts docs/base.ts docs/fault.ts -o out/model --box -140,-140,-1700,2140,1640,-700 --extend 60 --seal 20'
    'seal volume docs/top.ts docs/base.ts docs/fault.ts -o out/model --box 0,0,-1700,2000,1500,-700 --seal 20'
    'improve improve docs/top.ts docs/base.ts docs/fault.ts -o out/a.vtp -o out/a.obj --box 0,0,-1700,2000,1500,-700 --seal 20 --edge-length 200 --histogram out/q.svg'
    'resolution improve data/ringmesh/modelA1.ml -o out/a.obj --box -3000,-2500,-2500,9000,4500,1200 --edge-length 800 --resolution 150'
    'kriging fill --depth docs/seabed.asc -o out/a.vtp -o out/a.obj --map out/map.svg --points out/new.csv'
    'rbf fill docs/fold.ts -o out/a.vtp -o out/a.ts --method rbf'
    'kriging_gaussian fill --depth docs/seabed.asc -o out/a.vtp --model gaussian --isotropic --rings 3'
    'rbf_smoothed fill --depth docs/seabed.asc -o out/a.obj --method rbf --smoothing auto'
    'layer layer --hard docs/salt.ts --soft docs/shale.ts --keep upper -o out/a.vtp -o out/a.obj --certificate out/c.json'
    'stack layer docs/salt.ts docs/shale.ts --layer shale=1 --layer salt=2 --min-thickness 5 -o out/a.vtp --certificate out/c.json'
    'tetrahedra tetrahedralize data/ringmesh/split_cube.ml -o out/a.vtu -o out/a.msh --quality 2'
    'convert convert docs/top.ts out/a.ply'
    'points convert docs/seabed.asc out/a.ts'
    'build build project.json -o out/model'
)

if [[ $# -eq 0 ]]; then
    presets=(release asan) # compares a debug build of clang with an optimised one of gcc
    for preset in "${presets[@]}"; do
        cmake --preset "$preset" >/dev/null
        cmake --build --preset "$preset" --target cli/terrane
        programs+=("$PWD/build/$preset/cli/terrane")
    done
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chosen=${CASES:-.}

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

# run_cases DIR PROGRAM THREADS: runs all cases in DIR; DIR/results/NAME gets what they print and write. Status
# 1 (findings, or rounding failed) is a result as well.
run_cases() {
    local case name status words
    mkdir -p "$1/results"
    ln -s "$PWD/tests/data" "$1/data"
    ln -s "$PWD/docs/data" "$1/docs"
    cp "$work/project.json" "$1/project.json"
    for case in "${cases[@]}"; do
        name=${case%% *}
        [[ $name =~ $chosen ]] || continue
        mkdir "$1/out"
        status=0
        read -ra words <<<"${case#* }"
        [[ ${words[0]} == convert ]] || words+=(--threads "$3")
        (
            cd "$1"
            "$2" "${words[@]}" >out/stdout 2>out/stderr
        ) || status=$?
        if [[ $status -gt 1 ]]; then
            echo "same_bytes: $name: exit status $status ($2)" >&2
            cat "$1/out/stderr" >&2
            return 1
        fi
        echo "$status" >"$1/out/status"
        rm -f "$1/out/model/log.txt" # has times
        without_times "$1/out/model/statistics.json"
        mv "$1/out" "$1/results/$name"
    done
    touch "$1/done"
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

# The first program runs all cases with one thread and with two, the others with two; as many runs as there are
# processors go on at a time, and the slow builds are last in the list, so they start first.
runs=(0-1 0-2)
for i in "${!programs[@]}"; do
    [[ $i -eq 0 ]] || runs+=("$i-2")
done
for ((r = ${#runs[@]} - 1; r >= 0; --r)); do
    i=${runs[r]%-*}
    while [[ $(jobs -rp | wc -l) -ge $(nproc) ]]; do wait -n || true; done
    run_cases "$work/${runs[r]}" "${programs[$i]}" "${runs[r]#*-}" &
done
wait
for run in "${runs[@]}"; do
    [[ -e $work/$run/done ]] || exit 1
done

differences=0
for run in "${runs[@]:1}"; do
    if ! (cd "$work" && diff -rq "${runs[0]}/results" "$run/results"); then
        echo "same_bytes: ${programs[${run%-*}]} with ${run#*-} threads differs from ${programs[0]} with one" >&2
        differences=1
        [[ -z ${KEEP:-} ]] || { mkdir -p "$KEEP" && cp -r "$work/${runs[0]}/results" "$KEEP/${runs[0]}" && cp -r "$work/$run/results" "$KEEP/$run"; }
    fi
done
[[ $differences -eq 0 ]] || exit 1
echo "same_bytes: ${#cases[@]} cases, ${#programs[@]} builds, 1 and 2 threads: all the same"
