#!/bin/sh
# SPDX-License-Identifier: LGPL-3.0-or-later
# Builds with benchmarks and prints the table of required speeds: medians, and ratios to CGAL and to
# the floor, all from one run. With --memory the memory use follows.
# With --degenerate it prints how the costs of inputs in which everything coincides grow instead, with
# --many those of very many surfaces.
# Other arguments:
#   --repeats N   --large   NAME...
set -eu
cd "$(dirname "$0")/.."
memory=
[ "${1-}" = --memory ] && { memory=1; shift; }
cmake --preset bench >/dev/null
if [ "${1-}" = --degenerate ]; then
    shift
    cmake --build --preset bench --target terrane_bench_degenerate >/dev/null
    exec build/bench/tests/bench/terrane_bench_degenerate "$@"
fi
if [ "${1-}" = --many ]; then
    cmake --build --preset bench --target terrane_program >/dev/null
    exec tests/oracles/many.py --terrane build/bench/cli/terrane --bench
fi
cmake --build --preset bench --target terrane_bench_table terrane_bench_memory >/dev/null
echo "load: $(cut -d' ' -f1-3 /proc/loadavg) on $(nproc) cores"
build/bench/tests/bench/terrane_bench_table "$@"
[ -z "$memory" ] || build/bench/tests/bench/terrane_bench_memory
