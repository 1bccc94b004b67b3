#!/usr/bin/env bash
# SPDX-License-Identifier: LGPL-3.0-or-later
#
# Makes what engines.json calls in build/scorecard: CGAL's program and the packages of npm. Of Debian's packages
# openscad, blender, freecad and python3-vtk9 it tells which are missing; calls of these are refused then.
set -euo pipefail
cd "$(dirname "$0")"
made=../../build/scorecard
mkdir -p "$made"
g++ -O2 -std=c++17 -DCGAL_USE_GMP -DCGAL_USE_MPFR cgal.cpp -o "$made/cgal" -lgmp -lmpfr
npm install --silent --no-fund --no-audit --prefix "$made" manifold-3d@3.5 three@0.187 three-bvh-csg@0.0.18 @jscad/modeling@2.13
cp csg.mjs "$made"
for program in openscad blender freecadcmd; do
    command -v "$program" >/dev/null || echo "scorecard: $program is not installed"
done
/usr/bin/python3 -c "import vtk" 2>/dev/null || echo "scorecard: python3-vtk9 is not installed"
