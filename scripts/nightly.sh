#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Repeats what takes too long for each commit: scripts/nightly.sh [FOLDER [PART...]]
# The parts, all of them unless some are named; with two cores they take some thirteen hours together:
#   cases      all tests of the library, with four times the random cases of a commit
#   soups      20 000 random soups and more, judged by the verifier and by rational numbers; 5 000 certified ones
#   decimals   2 000 soups on decimal lattices: how far surfaces moved, in rational numbers
#   mpi        all certified cases in 1, 2, 3, 4 and 7 processes
#   models     5 000 random block models against an oracle; 300 improved ones; 100 with tetrahedra
#   stacks     2 000 random stacks of layers, judged in rational numbers
#   signals    2 000 interrupts at random times
#   memory     each allocation fails once; limits on the memory of the program; 100 000 calls in one process
#   arguments  each argument of C, of Python and of the program at nonsense: an hour
#   kept       kept stages that were changed, exchanged and cut: an hour
#   many       surfaces and parts in number: an hour
#   threads    ThreadSanitizer
#   corpus     all answers of tests/corpus, derived by brute force and found by Terrane
#   engine     a small engine with 18 planted bugs: terrane::fuzzing finds each from 20 seeds, and nothing in the sound one
#   fuzz       all fuzz targets, FUZZ_SECONDS (default 540) each: six hours of one core
# FOLDER (default: build/nightly) gets a log for each part, and keeps the fuzz corpora. It ends with a
# table; the status is 1 if a part found something.
set -uo pipefail
cd "$(dirname "$0")/.."
folder=${1:-build/nightly}
shift || true
parts=("$@")
[[ ${#parts[@]} -gt 0 ]] || parts=(cases soups decimals mpi models stacks signals memory arguments kept many threads corpus engine fuzz)
mkdir -p "$folder"

cmake --preset release >/dev/null && cmake --build --preset release || exit 2
terrane=build/release/cli/terrane
tests=build/release/tests

run_part() {
    case $1 in
    cases) TERRANE_EFFORT=4 "$tests/terrane_tests" ;;
    soups)
        # 800 soups for each unit of effort, of seven shapes; also nudged, shifted and scaled.
        TERRANE_EFFORT=28 "$tests/terrane_tests" "random soups*" &&
            TERRANE_EFFORT=40 "$tests/terrane_tests" "rounding: random soups*" &&
            TERRANE_EFFORT=80 "$tests/terrane_tests" "pair check: the same where*" &&
            /usr/bin/python3 tests/oracles/certified_soups.py --terrane $terrane --count 5000 ;;
    decimals)
        for kind in "" --turned --box; do
            /usr/bin/python3 tests/oracles/rounded_soups.py --terrane $terrane --count 700 $kind || return 1
        done ;;
    models)
        TERRANE_RANDOM_MODELS=5000 "$tests/terrane_tests" "volumes: random models*" &&
            /usr/bin/python3 tests/oracles/improved.py --terrane $terrane &&
            /usr/bin/python3 tests/oracles/moved_vertices.py --terrane $terrane || return 1
        # The example that takes a model from beside the repository.
        local archive=../shared/data/SCECcode+GFM_web/GFM2020-inputs-dev.tar.xz
        [[ ! -e $archive ]] || TERRANE_GFM2020=$(realpath "$archive") PYTHONPATH=build/release/python \
            /usr/bin/python3 -m pytest -q python/tests/test_examples.py ;;
    stacks) "$tests/stacks" random 2000 1 ;;
    signals) scripts/interrupts.py --runs 2000 ;;
    memory)
        scripts/failing_allocations.sh && scripts/memory_limits.py && "$tests/soak" 100000 ;;
    arguments)
        local folder=tests/arguments
        export TERRANE_PROGRAM=$PWD/$terrane TERRANE_TETGEN=$PWD/build/release/libexec/terrane/terrane-tetgen TERRANE_EFFORT=1
        /usr/bin/python3 $folder/program_arguments.py --program $terrane --data docs/data --seconds 1200 &&
            /usr/bin/python3 $folder/c_arguments.py --library build/release/capi/libterrane_c.so --seconds 1200 &&
            PYTHONPATH=$PWD/build/release/python /usr/bin/python3 $folder/python_arguments.py --seconds 1200 ;;
    mpi)
        /usr/bin/python3 tests/mpi/run_mpi.py --all --terrane $terrane --terrane-mpi build/release/cli/terrane-mpi \
            --mpirun "$(command -v mpiexec)" --certified tests/certified ;;
    kept) scripts/kept_stages.py --terrane $terrane --seconds 3600 ;;
    many) /usr/bin/python3 tests/oracles/many.py --terrane $terrane --seconds 3600 ;;
    threads) scripts/thread_sanitizer.sh ;;
    corpus)
        /usr/bin/python3 -B docs/examples/python/check_case.py tests/corpus/*.json &&
            PYTHONPATH=$PWD/build/release/python /usr/bin/python3 -B tests/corpus/make.py --compare ;;
    engine) # which the test consumer leaves behind
        ctest --test-dir build/release -R '^consumer$' || return 1
        for seed in $(seq 20); do
            $tests/consumer/fuzzing/fuzz_engine 50000 "$seed" || return 1
        done ;;
    fuzz)
        fuzz/check_plants.py build/release/compile_commands.json &&
            FUZZ_CORPUS=$PWD/$folder/corpus scripts/fuzz.sh "${FUZZ_SECONDS:-540}" ;;
    *) echo "nightly: there is no part $1" && return 2 ;;
    esac
}

failed=0
table=
for part in "${parts[@]}"; do
    start=$SECONDS
    if (run_part "$part") >"$folder/$part.log" 2>&1; then verdict=right; else verdict=WRONG && failed=1; fi
    printf -v row '%-10s %-6s %6d s   %s\n' "$part" $verdict $((SECONDS - start)) "$(tail -n 1 "$folder/$part.log" | cut -c 1-90)"
    printf '%s' "$row"
    table+=$row
done
printf '%s' "$table" >"$folder/table.txt"
exit $failed
