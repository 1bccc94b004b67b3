#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Makes conforming meshes, blocks and tetrahedra from real surfaces: sets up, builds the library
# and the program, and runs it on models of tests/data. It writes into out/demo.
# scripts/demo.sh PROGRAM OUT runs a program that is built already, and writes into OUT.
set -euo pipefail
cd "$(dirname "$0")/.."

if [[ $# -eq 0 ]]; then
    scripts/setup.sh
    # This is built once: larger groups of files take less time, and so does gcc if it collects no garbage.
    cmake --preset release -DTERRANE_TESTS=OFF -DTERRANE_UNITY_FACTOR=3 \
        -DCMAKE_CXX_FLAGS="--param ggc-min-heapsize=1048576" -B build/demo >/dev/null
    cmake --build build/demo --target terrane_program
fi
terrane=${1:-build/demo/cli/terrane}
out=${2:-out/demo}
mkdir -p "$out"

say() { printf '\n==== %s\n' "$*"; }
run() {
    printf '$ %s\n' "$*"
    "$@"
}

# expect FILE.json PART.KEY NUMBER: checks one of the numbers that --stats wrote.
expect() {
    python3 - "$@" <<'END'
import json, sys
path, key, wanted = sys.argv[1:]
part, name = key.split(".")
found = json.load(open(path))[part][name]
if found != int(wanted):
    sys.exit(f"demo: {path}: {key} is {found}, not {wanted}")
END
}

say "32 faults and a topography, 3382 pairs of triangles cross: one conforming mesh"
model=(tests/data/arch-platform/faults.ts tests/data/arch-platform/mnt.ts)
run "$terrane" arrange "${model[@]}" -o "$out/faults-topography.vtp" \
    -o "$out/faults-topography.obj" --stats "$out/faults-topography.json"
expect "$out/faults-topography.json" search.improper_contacts 3382
run "$terrane" check "$out/faults-topography.obj"

say "modelA1, three horizons in a box; the model states 5 blocks, the outside included"
model=(tests/data/ringmesh/modelA1.ml)
run "$terrane" arrange "${model[@]}" -o "$out/modelA1.vtp" -o "$out/modelA1.obj" >/dev/null
run "$terrane" check "$out/modelA1.obj"
run "$terrane" tetrahedralize "${model[@]}" -o "$out/modelA1.vtu" --stats "$out/modelA1.json"
expect "$out/modelA1.json" tetrahedra.blocks 5

say "modelA2, three horizons and two faults; the model states 13 blocks, the outside included"
run "$terrane" tetrahedralize tests/data/ringmesh/modelA2.ml -o "$out/modelA2.vtu" \
    -o "$out/modelA2.msh" --stats "$out/modelA2.json"
expect "$out/modelA2.json" tetrahedra.blocks 13

say "the same model for a simulator: in a box, what is nearer than 60 m joined, its triangles improved"
rm -rf "$out/simulator"
page=() # a build without npm has no pages
[[ ! -e ${terrane%/cli/terrane}/page_bundle.cpp ]] || page=(--report "$out/model.html")
run "$terrane" build tests/data/projects/simulator.json -o "$out/simulator" "${page[@]}" |
    grep -E '^\$ |^[0-9]+ tetrahedra, |^dihedral angles|have an angle below|^SICN'

say "written"
find "$out" -type f -printf '  %9s bytes  %p\n' | sort -k3
cat <<END

To look at it:
  browser   open ${page[1]:-(this build has no pages)}: blocks, tetrahedra, sections
  ParaView  open $out/simulator/tetrahedra.vtu or $out/modelA2.vtu, Threshold on block from 1, Explode Data, colour by block
            open $out/faults-topography.vtp, colour by surface, "Surface With Edges"
  gmsh      gmsh $out/modelA2.msh
  picture   xvfb-run -a scripts/picture.py   (needs python3-vtk9, python3-numpy, xvfb)
END
